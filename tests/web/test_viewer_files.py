"""Files that the viewer's page gives back: a PNG with opacity, of any size, and an SVG."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from viewed import FLAG, SHAPES, Viewed, ready, show
from viewer_page import data_url, manifest, view_matrix, write_page
from walk_node import by_node

import vexture

GLASS = b"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 200">
  <defs><radialGradient id="g">
    <stop offset="0" stop-color="#ffd23f"/><stop offset="1" stop-color="#0b6e4f" stop-opacity="0"/>
  </radialGradient></defs>
  <circle cx="100" cy="100" r="71.3" fill="#b5121b" fill-opacity=".35"/>
  <circle cx="170" cy="90" r="63.7" fill="#1f77d0" fill-opacity=".6"/>
  <ellipse cx="220" cy="120" rx="70" ry="55" fill="url(#g)"/>
  <path d="M10 190 L290 183" stroke="#e8b100" stroke-width=".6"/>
</svg>"""
"""Nothing is opaque, and a line is thinner than a pixel."""

BOX = (0.0, 1 / 6, 1.0, 5 / 6)
"""Of the drawing in the unit square."""


@pytest.fixture(scope="module")
def glass(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, str]:
    """The drawing as a planar map, and its page, which does not know its source."""
    folder = tmp_path_factory.mktemp("glass")
    (folder / "glass.svg").write_bytes(GLASS)
    texture = vexture.convert(folder / "glass.svg")
    assert texture.roots[0].is_map
    page = write_page(folder / "glass.html", manifest(texture, facts={"box": BOX}))
    return texture, page.as_uri()


def saved(page: Any, button: str, path: Path) -> str:
    """Save a file with a button of the page; the name that it is given."""
    with page.expect_download() as download:
        page.get_by_role("button", name=button).click()
    download.value.save_as(path)
    return str(download.value.suggested_filename)


def check(path: Path, expected: NDArray[np.float32]) -> None:
    """Whether the colours of a PNG are straight, and its opacity is right, as those that Python renders."""
    with Image.open(path) as picture:
        assert picture.mode == "RGBA"
        found = np.asarray(picture).astype(np.float64)
    assert found.shape == expected.shape
    opacity = expected[..., 3].astype(np.float64)
    assert np.abs(found[..., 3] - 255 * opacity).max() <= 1
    some = opacity > 2 / 255
    assert (some & (opacity < 0.5)).sum() > 100, "little is translucent"
    straight = 255 * expected[some][:, :3] / opacity[some][:, None]
    off = np.abs(found[some][:, :3] - straight).max(axis=1)
    assert (off * opacity[some]).max() <= 1.0
    assert off[opacity[some] > 8 / 255].max() <= 3.0


def test_png_of_the_whole_drawing_is_what_python_renders(
    glass: tuple[Any, str], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    texture, url = glass
    page = ready(open_page, url, (900, 600))
    page.get_by_label("PNG, pixels").fill("450")
    assert saved(page, "Save PNG", tmp_path / "glass.png") == "glass.png"
    check(tmp_path / "glass.png", texture.render((450, 300), np.array([[1 / 450, 0, 0], [0, -1 / 450, BOX[3]]])))


def test_png_of_the_view_and_of_more_pixels_than_are_drawn_at_once(
    glass: tuple[Any, str], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    texture, url = glass
    page = ready(open_page, url, (900, 600))
    show(page, center=(0.45, 0.5), zoom=2)
    size = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    page.get_by_label("PNG, pixels").fill("1200")
    page.get_by_label("Part").select_option("This view")
    saved(page, "Save PNG", tmp_path / "view.png")
    strip = tmp_path / "strip.png"
    with Image.open(tmp_path / "view.png") as picture:
        (width, height), longer = picture.size, max(size)
        top = 2**20 // width - 20  # where one band ends and the next begins
        assert top + 40 < height
        picture.crop((0, top, width, top + 40)).save(strip)
    scale = 1200 / longer
    moved = (size[0] - width / scale) / 2, (size[1] - height / scale) / 2 + top / scale
    matrix = view_matrix((0.45, 0.5), 2, (size[0], size[1])) @ np.array(
        [[1 / scale, 0, moved[0]], [0, 1 / scale, moved[1]], [0, 0, 1]]
    )
    check(strip, texture.render((width, 40), matrix))


def test_a_size_that_cannot_be_drawn_is_one_line(glass: tuple[Any, str], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, glass[1], (900, 600))
    most = page.evaluate("vexture.viewer.engine.renderer.capabilities.maxTextureSize")
    for size in (15, most + 1):
        page.get_by_label("PNG, pixels").fill(str(size))
        page.get_by_role("button", name="Save PNG").click()
        line = f"No PNG: a side of {size:,} pixels cannot be drawn here; choose 16 to {most:,}"
        page.get_by_role("status").filter(has_text=line).wait_for()


def test_svg_is_the_source_where_it_is_known(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    page = ready(open_page, viewer_pages["map"].url, (900, 600))
    assert saved(page, "Save SVG", tmp_path / "flag.svg") == "flag.svg"
    assert (tmp_path / "flag.svg").read_bytes() == FLAG


def test_svg_of_a_map_without_its_source_is_refused_with_the_reason(
    glass: tuple[Any, str], open_page: Callable[..., Any]
) -> None:
    page = ready(open_page, glass[1], (900, 600))
    button = page.get_by_role("button", name="Save SVG")
    assert button.is_disabled()
    assert "one map, which has no outlines" in button.get_attribute("title")


def test_svg_of_what_was_selected_is_not_the_whole_source(open_page: Callable[..., Any], tmp_path: Path) -> None:
    texture = vexture.convert(SHAPES / "duck.svg")
    views = {"svg": data_url("image/svg+xml", FLAG)}
    write_page(tmp_path / "page.html", manifest(texture, views=views, facts={"select": "#duck"}))
    page = ready(open_page, (tmp_path / "page.html").as_uri(), (900, 600))
    assert saved(page, "Save SVG", tmp_path / "duck.svg") == "duck.svg"
    check_area(texture, (tmp_path / "duck.svg").read_bytes(), tmp_path)


def check_area(texture: Any, svg: bytes, folder: Path) -> None:
    """Whether an SVG that is read again covers what the texture does, in its colours."""
    (folder / "again.svg").write_bytes(svg)
    again = vexture.read_svg(folder / "again.svg")
    if texture.roots[0].paint is None:
        found, expected = vexture.coverage(again, 128, renderer="exact"), texture.coverage(128)
    else:  # layer by layer, as the texture is
        found, expected = vexture.convert(again, split="paint").render(128), texture.render(128)
    assert np.ptp(expected) > 0.3
    assert np.abs(found - expected).max() <= 1 / 255


@pytest.mark.parametrize("name", ["duck", "crossings", "holes", "hairline", "flag", "upwards", "atlas"])
def test_svg_of_a_texture_is_that_of_python_and_covers_the_same(name: str, tmp_path: Path) -> None:
    (tmp_path / "flag.svg").write_bytes(FLAG)
    upwards = vexture.Drawing.polygon([(0.1, 0.2), (0.9, 0.4), (0.3, 0.8)])
    texture = {
        "flag": lambda: vexture.convert(tmp_path / "flag.svg", split="paint"),
        "upwards": lambda: vexture.convert(upwards),
        "atlas": lambda: vexture.atlas([SHAPES / "duck.svg", SHAPES / "cusp.svg"], name="a & <b>"),
    }.get(name, lambda: vexture.convert(SHAPES / f"{name}.svg", split=None))()
    texture.save(tmp_path / "texture.ktx2")
    text = by_node("svg_text.mjs", tmp_path / "texture.ktx2")
    ours, theirs = (re.split(r"(-?\d+(?:\.\d+)?)", one) for one in (text, texture.to_svg()))
    assert ours[::2] == theirs[::2]
    digits = 2e-9 * np.abs(texture.roots[0].to_source).max()  # of the last one, which may be rounded elsewhere
    np.testing.assert_allclose(np.array(ours[1::2], float), np.array(theirs[1::2], float), rtol=0, atol=digits)
    if name != "atlas":  # two drawings, of two windows
        check_area(texture, text.encode(), tmp_path)
