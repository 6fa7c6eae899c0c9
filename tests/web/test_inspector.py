"""The viewer's inspector of cells, its contents of textures and its facts, against what Python reads and solves."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from overlay_page import Shown

from vexture.texture.texture import Texture
from vexture.texture.walk import walk


def leaf_at(texture: Texture, u: float, v: float) -> tuple[int, float, float, float, int, NDArray[np.float64]]:
    """Depth, corner, coverage, corner winding and curves, (n, 4, 2) in unit-square units, by FORMAT.md B.3 and B.4."""
    flat = texture.texels.reshape(-1, 4).astype(np.int64)
    quad, x, y, side, depth = texture.roots[0].quad, 0.0, 0.0, 1.0, 0
    while True:
        side, depth = side / 2, depth + 1
        k = int(u >= x + side) + 2 * int(v >= y + side)
        x, y = x + side * (k & 1), y + side * (k >> 1)
        cells = [(flat[quad, 2] >> 8 * i) & 255 for i in range(4)]
        if cells[k] == 128:
            quad = flat[quad, 0] + sum(cell == 128 for cell in cells[:k])
            continue
        first = flat[quad, 1] + sum(cell >> 3 for cell in cells[:k] if cell != 128)
        words = flat[first : first + (cells[k] >> 3)]
        points = np.stack([words & 0xFFFF, words >> 16], axis=-1) - np.array([0, 16384, 16384, 0])[:, None]
        coverage = ((flat[quad, 3] >> 8 * k) & 255) / 255
        return depth, x, y, coverage, int((cells[k] & 7) - 4) if cells[k] else 0, points / 32768 * side + [x, y]


def crossings(curves: NDArray[np.float64], u: float) -> list[tuple[int, float, float]]:
    """Number from 1, t and height where each curve has the x of a point, the lowest first: roots of polynomials."""
    found = []
    for number, curve in enumerate(curves, 1):
        cubic = np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 3, 0, 0], [1, 0, 0, 0]]) @ curve
        if not min(curve[0, 0], curve[3, 0]) <= u <= max(curve[0, 0], curve[3, 0]) or curve[0, 0] == curve[3, 0]:
            continue
        side = np.abs(curve[:, 0] - u).max()
        roots = np.roots((cubic[:, 0] - [0, 0, 0, u]) / side)
        t = min((root.real for root in roots if abs(root.imag) < 1e-5), key=lambda t: max(-t, t - 1.0, 0.0))
        found.append((number, t, np.polyval(cubic[:, 1], t)))
    return sorted(found, key=lambda one: one[2])


def read_inspector(page: Any) -> tuple[dict[str, str], list[list[str]], str]:
    """Terms, rows of the table and the verdict in the panel."""
    region = page.get_by_role("region", name="Cell")
    terms = dict(zip(region.locator("dt").all_inner_texts(), region.locator("dd").all_inner_texts(), strict=True))
    rows = [row.locator("td").all_inner_texts() for row in region.locator("tbody tr").all()]
    return terms, rows, region.locator(".verdict").inner_text()


@pytest.mark.parametrize(
    ("name", "zoom"),
    [
        pytest.param("duck", 1.0, marks=pytest.mark.slow),
        pytest.param("ocean", 100.0, marks=pytest.mark.slow),
        ("duck", 10_000.0),
    ],
)
def test_the_inspector_says_what_numpy_solves(
    show: Callable[..., Shown], screenshot: Callable[..., Path], name: str, zoom: float
) -> None:
    shown = show(name)
    page, texture = shown.page, shown.texture
    shown.press("Inspect cell")
    generator = np.random.default_rng(5)
    outline = np.concatenate([leaf_at(texture, *generator.random(2))[5] for _ in range(40)])
    seen = 0
    for curve in outline[:: max(1, len(outline) // 6)]:
        u, v = np.array([1, 3, 3, 1]) / 8 @ curve
        if zoom > 1.0:
            shown.look((float(u), float(v)), zoom)
        x, y = shown.point(u, v)
        page.mouse.move(round(x) + 9, round(y) - 13)
        matrix = shown.matrix()
        pointed = matrix[:2] @ [round(x) + 9 - shown.box["x"], round(y) - 13 - shown.box["y"], 1.0]
        written_of(page, pointed)
        terms, rows, verdict = read_inspector(page)
        depth, left, low, coverage, winding, curves = leaf_at(texture, *pointed)
        assert terms["Depth"] == str(depth)
        assert terms["Side"] == f"1/{2**depth}"
        assert float(terms["Coverage"]) == pytest.approx(coverage, abs=6e-4)
        assert terms["Corner winding"] == (str(winding) if len(curves) else "none: constant")
        expected = crossings(curves, pointed[0])
        assert [int(row[0]) for row in rows] == [number for number, _, _ in expected]
        for row, (_, t, height) in zip(rows, expected, strict=True):
            assert float(row[1]) == pytest.approx(t, abs=2e-5)
            assert float(row[2]) == pytest.approx(height, abs=2e-8)
        inside = bool(texture.contains(pointed[None])[0])
        assert verdict == f"The point is {'inside' if inside else 'outside'}."
        check_drawing(shown, (left, low, 0.5**depth), curves)
        seen += len(rows)
    assert seen >= 3
    screenshot(page)
    page.mouse.move(shown.box["x"] + shown.box["width"] + 40, 20)  # to the panel, where the table is read
    page.wait_for_timeout(400)  # in which another text would have been written
    assert read_inspector(page)[0] == terms


def written_of(page: Any, point: NDArray[np.float64]) -> None:
    """Wait until the panel tells of a point: it does so a little after the point, all at once."""
    page.wait_for_function(
        """(point) => {
          const [x, y] = document.querySelectorAll('.inspected dd');
          return x && Math.max(Math.abs(x.textContent - point[0]), Math.abs(y.textContent - point[1])) <= 1e-8;
        }""",
        arg=[float(part) for part in point],
    )


def check_drawing(shown: Shown, cell: tuple[float, float, float], curves: NDArray[np.float64]) -> None:
    """The layer over the picture has the cell's borders and the curves' points where they are on the canvas."""
    layer = shown.page.locator(".inspector-layer")
    rect = layer.locator("rect")
    left, top = (float(rect.get_attribute(name)) for name in ("x", "y"))
    width = float(rect.get_attribute("width"))
    x, y, side = cell
    box = shown.box
    corner = np.array(shown.point(x, y + side)) - [box["x"], box["y"]]
    assert np.abs(corner - (left, top)).max() < 1e-3 * max(1.0, width / 1000)
    drawn = sorted(
        [float(part) for part in re.findall(r"-?[\d.]+(?:e-?\d+)?", path.get_attribute("d"))]
        for path in layer.locator("path").all()
    )
    expected = sorted(
        [float(part) for point in curve for part in np.array(shown.point(*point)) - [box["x"], box["y"]]]
        for curve in curves
    )
    assert np.abs(np.array(drawn) - np.array(expected)).max(initial=0.0) < 1e-3 * max(1.0, width / 1000)


def test_keys_inspect_the_middle_of_the_picture(show: Callable[..., Shown]) -> None:
    shown = show("duck")
    shown.press("Inspect cell")
    shown.page.locator(".stage").focus()
    shown.page.keyboard.press("ArrowLeft")
    shown.page.wait_for_function("vexture.viewer.state.value.center[0] !== 0.5")
    center = shown.page.evaluate("vexture.viewer.state.value.center")
    written_of(shown.page, center)
    assert center != [0.5, 0.5]
    assert shown.page.get_by_role("region", name="Cell").locator("[aria-live=polite]").count() == 1


def test_texture_contents_show_each_texel_and_where_it_is(
    show: Callable[..., Shown], screenshot: Callable[..., Path]
) -> None:
    shown = show("ocean")
    page, texture = shown.page, shown.texture
    shown.press("Texture contents")
    image = page.locator("canvas.texels")
    pixels = np.array(
        image.evaluate("""canvas => {
      const { width, height } = canvas;
      return [width, height, ...canvas.getContext('2d').getImageData(0, 0, width, height).data];
    }""")
    )
    columns = pixels[0] // 2
    grid = pixels[2:].reshape(pixels[1], pixels[0], 4)[::2, ::2, :3].reshape(-1, 3)
    levels = walk(texture.texels.reshape(-1, 4), np.array([texture.roots[0].quad]))
    quads = np.concatenate([level.quads for level in levels])
    curves = np.concatenate([level.curves for level in levels])
    blue = np.flatnonzero(grid[:, 2] > grid[:, 0] + 20)
    orange = np.flatnonzero(grid[:, 0] > grid[:, 2] + 20)
    assert sorted(quads) == blue.tolist()
    assert sorted(curves) == orange.tolist()
    image.scroll_into_view_if_needed()
    box = image.bounding_box()
    texel = box["width"] / columns
    index = int(curves[3])
    page.mouse.move(box["x"] + (index % columns + 0.5) * texel, box["y"] + (index // columns + 0.5) * texel)
    region = page.get_by_role("region", name="Texture")
    region.get_by_text(f"Texel {index}: a curve").wait_for()
    word = int(texture.texels.reshape(-1, 4)[index, 0])
    said = f"P0 ({(word & 0xFFFF) / 32768:.4f}, {(word >> 16) / 32768:.4f}) of the cell"
    assert region.locator("li").first.inner_text() == said
    depth = next(d for d, level in enumerate(levels, 1) if index in level.curves)
    assert f"depth {depth}" in region.locator(".texel p").inner_text()
    side = 0.5**depth / abs(shown.matrix()[0, 0])
    assert float(page.locator(".texel-cell").get_attribute("width")) == pytest.approx(side, rel=1e-9)
    screenshot(page)
    image.focus()
    page.keyboard.press("ArrowRight")
    region.get_by_text(f"Texel {index + 1}: a curve").wait_for()


def test_the_thesis_pair_is_shown_while_it_is_compared_with(show: Callable[..., Shown]) -> None:
    shown = show("duck")
    shown.press("Texture contents")
    images = shown.page.get_by_role("region", name="Texture").get_by_role("img")
    assert images.count() == 0
    shown.page.get_by_role("combobox", name="Compare with").select_option("16-bit original method (2018)")
    images.nth(1).wait_for()
    widths = images.evaluate_all("all => Promise.all(all.map(async (one) => (await one.decode(), one.naturalWidth)))")
    assert widths == [4, 2]


def test_facts_are_the_textures(show: Callable[..., Shown]) -> None:
    shown = show("duck")
    region = shown.page.get_by_role("region", name="Facts")
    facts = dict(zip(region.locator("dt").all_inner_texts(), region.locator("dd").all_inner_texts(), strict=True))
    levels = walk(shown.texture.texels.reshape(-1, 4), np.array([shown.texture.roots[0].quad]))
    assert facts["Segments"] == "31"
    assert facts["Quads"] == str(sum(len(level.quads) for level in levels))
    assert facts["Curves"] == str(sum(len(level.curves) for level in levels))
    assert facts["Deepest leaf"] == str(len(levels))
    sizes = shown.page.get_by_role("region", name="Size").get_by_role("row").all_inner_texts()
    assert sizes[1:] == [f"This texture\t12.3\xa0kB\t{shown.texture.texels.nbytes:,}\xa0B"]
    assert facts["Conversion"] == "8.25 ms"
    assert facts["Deviation, of side"] == "1/100,000"
    assert region.get_by_role("list", name="Remarks").inner_text() == "it swims"
    assert region.get_by_role("status").inner_text() == "not measured"
    shown.press("Measure")
    shown.page.wait_for_function("/^[\\d.]+ ms$/.test(document.querySelector('.measured output').value)")


def test_it_tells_the_paints_of_a_map(show: Callable[..., Shown], screenshot: Callable[..., Path]) -> None:
    shown = show("map")
    shown.press("Inspect cell")
    shown.look((0.5, 0.5), 1)
    words = {}
    for u, v in ((0.72, 0.72), (0.2, 0.9), (0.4, 0.22), (0.05, 0.1)):
        shown.page.mouse.move(*shown.point(u, v))
        verdict = shown.page.get_by_role("region", name="Cell").locator(".verdict")
        verdict.filter(has_text=POINTS[u, v]).wait_for()
        words[u, v] = verdict.inner_text()
    screenshot(shown.page)
    assert len({re.search(r"paint (\d+)", text).group(1) for text in words.values()}) == 4  # type: ignore[union-attr]
    terms, _, _ = read_inspector(shown.page)
    assert {"Mean colour", "Base paint"} <= set(terms)
    assert "Corner winding" not in terms
    shown.page.mouse.move(*shown.point(0.72, 0.57))
    shown.page.get_by_role("columnheader", name="Paints").wait_for()
    assert re.fullmatch(r"\d+ over \d+", read_inspector(shown.page)[1][0][3])


POINTS = {(0.72, 0.72): "#ffd23f", (0.2, 0.9): "#bfe3ff", (0.4, 0.22): "#b5322e", (0.05, 0.1): "#3a7d44"}
