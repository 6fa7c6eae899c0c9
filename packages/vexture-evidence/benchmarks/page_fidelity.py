"""Pixels of the web, in Chromium, against exact coverage: of the viewer's page, and of a plane in perspective.

    python packages/vexture-evidence/benchmarks/page_fidelity.py [--quick] [--seed 1]

The page is the exported one, its panels hidden, at 512 x 512 pixels; what is compared is a screenshot, rounded to 8
bits as every page is. Whole view, 100 times at points of the outline, and steps of the outline where it crosses from
one cell into the next at 1,000 and 10,000 times (see seams.py); beside those how far it is displaced at all, which the
texture's precision bounds. The plane has a VectorMaterial and leans back so far that its pixels are 8:1.
"""

import argparse
import base64
import io
import math
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from chromium import ROOT, bundle, chromium, serve_folder
from report import cell, table, write_json
from seams import SIDE, crossings, displacements, is_straight, step_of
from targets import Target, target_facts, target_table
from vexture.conversion.pipeline import convert
from vexture.drawing.drawing import Drawing
from vexture.pages.page import exported_page
from vexture.renderers.exact import render_exact
from vexture.server.publish_file import VIEWER_PARAMETERS, shape_of
from vexture.svg.read import read_svg
from vexture.tree.build import build_tree
from vexture_evidence.measures.machine import machine_facts, machine_line

SHAPES: Final = ROOT / "examples" / "shapes"
NAMES: Final = ("duck", "font", "ocean", "flame", "holes")
PIXELS: Final = 512
POINTS: Final = 5
CROSSINGS: Final = 12
ROUNDED: Final = 0.1
"""Pixels that an outline may seem to be moved by because its picture has 8 bits."""

TILT: Final = math.degrees(math.acos(1.0 / 8.0))

SHOW: Final = """async (look) => {
    const { engine, state } = vexture.viewer;
    state.update(look);
    engine.render();
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const [left, bottom] = engine.toUnit(0, engine.size.height);
    const [right, top] = engine.toUnit(engine.size.width, 0);
    return [left, bottom, right, top];
}"""


def gray(png: bytes) -> NDArray[np.float64]:
    """Picture in 0..1 of its brightest and darkest grey: paper is 0, ink 1."""
    rgb = np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(np.float64)
    channel = rgb[..., np.ptp(rgb, axis=(0, 1)).argmax()]  # the channel in which ink and paper differ most
    low, high = channel.min(), channel.max()
    return (high - channel) / (high - low)


def view_matrix(corners: Sequence[float], size: int) -> NDArray[np.float64]:
    """From pixels, y down, to the unit square, of a view between two of its points.

    Examples
    --------
    >>> view_matrix((0.0, 0.0, 1.0, 1.0), 4) @ (2.0, 4.0, 1.0)
    array([0.5, 0. , 1. ])
    """
    left, bottom, right, top = corners
    across, up = (right - left) / size, (top - bottom) / size
    return np.array([[across, 0.0, left], [0.0, -up, top], [0.0, 0.0, 1.0]])


def plane_to_unit(matrix: Sequence[float], size: int) -> NDArray[np.float64]:
    """From pixels, y down, to the unit square of a plane from -1/2 to 1/2 that a 4 x 4 matrix, by columns, projects.

    Examples
    --------
    >>> plane_to_unit(np.eye(4).ravel(), 2) @ (1.0, 1.0, 1.0)
    array([0.5, 0.5, 1. ])
    """
    from_plane = np.array(matrix).reshape(4, 4).T[np.ix_([0, 1, 3], [0, 1, 3])]
    to_pixels = np.array([[0.5 * size, 0.0, 0.5 * size], [0.0, -0.5 * size, 0.5 * size], [0.0, 0.0, 1.0]])
    from_unit = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])
    found = np.linalg.inv(to_pixels @ from_plane @ from_unit)
    middle = found @ (0.5 * size, 0.5 * size, 1.0)
    return found / middle[2]


@contextmanager
def page_of(browser: Any, path: Path) -> Iterator[Any]:
    """Open the viewer's page with one drawing, bare."""
    shape = shape_of(path.read_bytes(), path.name, path.stem, VIEWER_PARAMETERS)
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "page.html"
        target.write_bytes(exported_page([shape], path.stem))
        page = browser.new_page(viewport={"width": PIXELS, "height": PIXELS}, color_scheme="light")
        page.goto(f"{target.as_uri()}?bare")
        page.evaluate("vexture.viewer.ready")
        yield page
        page.close()


def capture_view(page: Any, **look: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Capture a view; return the picture and the map from its pixels to the unit square."""
    corners = page.evaluate(SHOW, look)
    return gray(page.screenshot()), view_matrix(corners, PIXELS)


def mean_error(page: Any, drawing: Drawing, **look: Any) -> float:
    """Mean of |page - truth| in 1/255."""
    picture, to_unit = capture_view(page, **look)
    truth = render_exact(drawing, (PIXELS, PIXELS), to_unit)
    return float(255.0 * np.abs(picture - truth).mean())


def points_of(drawing: Drawing, count: int, seed: int) -> list[tuple[float, float]]:
    """Points of the outline."""
    rng = np.random.default_rng([seed, *drawing.name.encode()])
    cubics = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    chosen = cubics[rng.integers(len(cubics), size=count)]
    return [(float(x), float(y)) for x, y in np.tensordot(np.array([1, 3, 3, 1]) / 8, chosen, (0, 1))]


def borders(page: Any, drawing: Drawing, zoom: float, count: int, seed: int) -> tuple[list[float], list[float]]:
    """Steps, and displacements, in pixels, where the outline crosses cells' borders."""
    found = list(crossings(build_tree(drawing, precision=VIEWER_PARAMETERS.precision)))
    steps, moved = [], []
    middle = slice((PIXELS - SIDE) // 2, (PIXELS + SIDE) // 2)
    for k in np.random.default_rng(seed).permutation(len(found))[:count]:
        crossing = found[k]
        picture, to_unit = capture_view(page, center=crossing.point.tolist(), zoom=zoom)
        truth = render_exact(drawing, (PIXELS, PIXELS), to_unit)
        if is_straight(truth[middle, middle], crossing):
            direction = (float(crossing.tangent[0]), float(-crossing.tangent[1]))
            difference = (picture - truth)[middle, middle]
            steps.append(step_of(difference, direction))
            moved.append(max(map(abs, displacements(difference, direction)[:2])))
    return steps, moved


def drawing_facts(browser: Any, name: str, count: int, seed: int) -> dict[str, Any]:
    """Every figure of one drawing on the viewer's page."""
    path = SHAPES / f"{name}.svg"
    drawing = read_svg(path)
    with page_of(browser, path) as page:
        facts: dict[str, Any] = {"name": name, "whole": mean_error(page, drawing, zoom=1)}
        facts["100x"] = max(mean_error(page, drawing, center=p, zoom=100) for p in points_of(drawing, POINTS, seed))
        for zoom in (1_000, 10_000):
            steps, moved = borders(page, drawing, zoom, count, seed)
            _, to_unit = capture_view(page, zoom=zoom)
            facts |= {f"steps {zoom}x": steps, f"moved {zoom}x": moved, f"pixel {zoom}x": float(to_unit[0, 0])}
    return facts


def tilted_errors(browser: Any, names: Sequence[str]) -> dict[str, float]:
    """Mean of |page - truth| in 1/255 over the plane's pixels, by drawing."""
    found = {}
    with tempfile.TemporaryDirectory() as folder, serve_folder(Path(folder)) as address:
        bundle(Path(__file__).parent / "pages" / "plane.js", Path(folder) / "plane.js")
        (Path(folder) / "index.html").write_text('<!doctype html><script type="module" src="plane.js"></script>')
        page = browser.new_page()
        page.goto(address)
        page.wait_for_function("() => window.draw !== undefined")
        for name in names:
            drawing = read_svg(SHAPES / f"{name}.svg")
            packed = base64.b64encode(convert(drawing, split=None).to_ktx2()).decode()
            drawn = page.evaluate("(order) => draw(order)", {"packed": packed, "side": PIXELS, "tilt": TILT})
            picture = gray(base64.b64decode(drawn["picture"].partition(",")[2]))
            to_unit = plane_to_unit(drawn["matrix"], PIXELS)
            truth = render_exact(drawing, (PIXELS, PIXELS), to_unit)
            x, y = np.meshgrid(np.arange(PIXELS) + 0.5, np.arange(PIXELS) + 0.5)
            u, v, w = np.tensordot(to_unit, np.stack([x, y, np.ones_like(x)]), 1)
            on_plane = (w > 0.0) & (np.abs(u / w - 0.5) < 0.49) & (np.abs(v / w - 0.5) < 0.49)
            found[name] = float(255.0 * np.abs(picture - truth)[on_plane].mean())
        page.close()
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description="Pixels of the viewer's page against exact coverage.")
    parser.add_argument("--quick", action="store_true", help="two drawings, fewer crossings")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    names, count = (NAMES[:2], CROSSINGS // 3) if arguments.quick else (NAMES, CROSSINGS)
    with chromium() as browser:
        facts = [drawing_facts(browser, name, count, arguments.seed) for name in names]
        tilted = tilted_errors(browser, names)
    zooms = ("1000x", "10000x")
    head = (
        "drawing",
        "MAE whole",
        "100x",
        "8:1",
        *(f"{what} {z}" for z in zooms for what in ("step", "moved")),
    )
    rows = [
        [one["name"], cell(one["whole"], 3), cell(one["100x"], 3), cell(tilted[one["name"]], 3)]
        + [cell(max(one[f"{what} {zoom}"], default=None), 3) for zoom in zooms for what in ("steps", "moved")]
        for one in facts
    ]
    print(table(head, rows))
    reached = [
        Target("MAE of the whole view, 1/255", max(one["whole"] for one in facts), 0.6, 0.3),
        Target("MAE at 100x, 1/255", max(one["100x"] for one in facts), 0.6, 0.3),
        Target("MAE on a plane at 8:1, 1/255", max(tilted.values()), 1.0, 0.3),
    ]
    for zoom in zooms:
        steps, moved = (max(max(one[f"{what} {zoom}"], default=0.0) for one in facts) for what in ("steps", "moved"))
        allowed = (VIEWER_PARAMETERS.precision or math.nan) / facts[0][f"pixel {zoom}"]
        reached += [
            Target(f"largest step at {zoom}, px", steps, 0.1, 0.05),
            Target(f"largest displacement at {zoom}, px", moved, allowed + ROUNDED, allowed),
        ]
    machine = machine_facts()
    print("\n".join(["", target_table(reached), "", machine_line(machine)]))
    known = {"machine": machine, "seed": arguments.seed, "drawings": facts, "tilted": tilted}
    print(write_json("page_fidelity", {**known, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
