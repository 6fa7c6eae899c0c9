"""Pictures of drawings from nearby: what a view shows is converted as exactly as the view needs it."""

import numpy as np
import pytest
from PIL import Image
from test_cli import run

import vexture
from vexture.conversion.images import close_up
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Group, Mask

SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100">
<defs><linearGradient id="g" gradientTransform="rotate(20)"><stop stop-color="red"/><stop offset="1" stop-color="blue"/>
</linearGradient><clipPath id="c"><circle cx="60" cy="50" r="30"/></clipPath></defs>
<rect width="200" height="100" fill="#eef"/>
<g clip-path="url(#c)"><path fill="url(#g)" d="M40 20Q90 0 100 70T20 90z"/></g>
<g opacity=".5"><circle cx="150" cy="50" r="40" fill="url(#g)"/><circle cx="170" cy="50" r="20"/></g></svg>"""

PLACES = {"clip": (0.45, 0.5), "circle": (0.95, 0.5), "both": (0.75, 0.5), "side": (0.5, 0.75)}
"""Points on outlines."""


@pytest.fixture(scope="module")
def drawing():
    return vexture.read(SVG.encode(), name="a.svg")


@pytest.mark.parametrize("times", [10, 10_000, 10_000_000])
@pytest.mark.parametrize("place", PLACES)
def test_a_picture_is_exact_at_any_magnification(drawing, place, times):
    side = 1.0 / times
    x, y = (coordinate - 0.4 * side for coordinate in PLACES[place])
    view = vexture.window(x, y, side, side, 17)
    exact = vexture.render(drawing, 60, view, "exact")
    assert np.ptp(exact, axis=(0, 1)).max() > 0.2, "an outline is seen"
    assert np.abs(vexture.render(drawing, 60, view) - exact).max() < 3 / 255
    plain = drawing.without_masks()
    exact = vexture.coverage(plain, 60, view, "exact")
    assert np.abs(vexture.coverage(plain, 60, view) - exact).max() < 3 / 255


def test_a_large_picture_is_as_exact_as_its_pixels():
    thin = Drawing.polygon([(0.5, 0.1), (0.5 + 1e-5, 0.9), (0.3, 0.9)])
    view = [[1 / 8000, 0, 0.45], [0, -1 / 8000, 0.9]]
    part = close_up(thin, (800, 800), view)
    assert part.precision is None, "an eighth of the square at 800 pixels"
    whole = close_up(thin, (8000, 1), [[1 / 8000, 0, 0], [0, -1 / 8000, 0.5]])
    assert whole.precision == pytest.approx(0.04 / 8000)


def test_the_part_leads_to_the_source_and_keeps_what_is_said(drawing):
    view = vexture.window(0.4, 0.4, 0.001, 0.001)
    part = close_up(drawing, 100, view)
    assert (part.drawing.name, part.drawing.notes, part.drawing.crs) == ("a", drawing.notes, None)
    pixel = (30.0, 40.0, 1.0)
    there = part.drawing.to_source @ part.view @ pixel
    assert there == pytest.approx(drawing.to_source @ view.matrix((100, 100)) @ pixel, abs=1e-9)


def test_nothing_is_seen_beside_the_square_and_below_an_empty_mask(drawing):
    assert not vexture.render(drawing, 9, vexture.window(1.5, 0.5, 1e-4, 1e-4)).any()
    assert not vexture.coverage(drawing.without_masks(), 9, vexture.window(1.5, 0.5, 1e-4, 1e-4)).any()
    square = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]).paths[0]
    mask = Drawing.polygon([(0.1, 0.1), (0.2, 0.1), (0.2, 0.2), (0.1, 0.2)]).paths[0]
    paths = tuple(vexture.drawing.drawing.Path(path.contours, group=group) for group, path in enumerate((square, mask)))
    masked = Drawing(paths, groups=(Group(), Group(0, mask=Mask.OPACITY)))
    assert vexture.render(masked, 9, vexture.window(0.15, 0.15, 1e-4, 1e-4)).all(axis=(0, 1))[3]
    assert not vexture.render(masked, 9, vexture.window(0.5, 0.5, 1e-4, 1e-4)).any()


@pytest.mark.parametrize(
    ("options", "size"),
    [
        ((), (512, 171)),
        (("--width", 600), (600, 200)),
        (("--height", 60), (180, 60)),
        (("--width", 60, "--height", 60), (60, 60)),
        (("--view", "0,0,1,1", "--size", 60), (60, 60)),
    ],
)
def test_a_picture_has_the_shape_of_the_drawing(tmp_path, options, size):
    (tmp_path / "wide.svg").write_text('<svg viewBox="0 0 30 10"><path fill="red" d="M0 0h30v10h-30z"/></svg>')
    assert run("render", tmp_path / "wide.svg", "-o", tmp_path / "a.png", *options).exit_code == 0
    picture = Image.open(tmp_path / "a.png")
    assert picture.size == size
    red = (np.asarray(picture) == (255, 0, 0)).all(axis=2)
    assert red.mean() == pytest.approx(1.0 if size[0] > 2 * size[1] else 1 / 3, abs=0.02)
