"""A drawing taken apart by paint: the layers, stacked, are the flat-coloured drawing."""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from plainer import plainer
from svg_reference import render_drawing, render_file

from corpora import flags
from vexture.base.errors import SourceError, SourceWarning, VextureError
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.drawing import Path as Filled
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"
TOPICS = ("strokes", "structure", "style")
NOT_BY_RESVG = ("important", "selectors")
"""Style sheets that PyPI's resvg reads otherwise."""

RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))


def square(x: float, y: float, side: float, paint: Paint) -> Filled:
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    return replace(Drawing.polygon(corners).paths[0], paint=paint)


def stacked(layers: tuple[Drawing, ...], height: int, width: int) -> np.ndarray:
    """Source-over of flat layers, premultiplied RGBA, of a drawing that fills a rectangle."""
    size = max(height, width)
    picture: np.ndarray = np.zeros((size, size, 4))
    for layer in layers:
        (paint,) = {path.paint for path in layer.paths}
        alpha = render_exact(layer, (size, size))[..., None] * paint.opacity
        picture = np.append(paint.color, 1.0) * alpha + picture * (1.0 - alpha)
    top, left = (size - height) // 2, (size - width) // 2
    return picture[top : top + height, left : left + width]


def read_quietly(path: Path) -> Drawing:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path)


def gap(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Mean difference over the touched pixels."""
    touched = (theirs[..., 3] > 0) | (ours[..., 3] > 0)
    return float(np.abs(ours - theirs).max(axis=2)[touched].mean())


def coloured_fixtures() -> list[Path]:
    files = [path for topic in TOPICS for path in sorted((FIXTURES / topic).glob("*.svg"))]
    return [path for path in files if len(read_quietly(path).layers()) > 1 and path.stem not in NOT_BY_RESVG]


@pytest.mark.parametrize("path", coloured_fixtures(), ids=lambda path: path.stem)
def test_layers_of_a_fixture_look_like_the_file(path: Path) -> None:
    theirs = render_file(plainer(f"{path.parent.name}/{path.stem}") or path.read_text())
    assert gap(stacked(read_quietly(path).layers(), *theirs.shape[:2]), theirs) < 0.02


@pytest.mark.parametrize("count", [8, pytest.param(20, marks=pytest.mark.slow)])
def test_layers_of_flags_look_like_their_flat_colours(count: int) -> None:
    try:
        files = flags(count, 4)
    except VextureError as error:
        pytest.skip(str(error))
    for file in files:
        drawing = read_quietly(file)
        layers = drawing.layers()
        assert len({layer.name for layer in layers}) == len(layers)
        assert gap(stacked(layers, 240, 320), render_drawing(drawing, 240, 320)) < 0.01, file


LOGO = """<svg xmlns="http://www.w3.org/2000/svg" width="120" height="80" viewBox="0 0 12 8"><g fill-opacity="{}">
<rect width="12" height="8" fill="#00f"/><circle cx="4" cy="4" r="3" fill="red"/>
<circle cx="7" cy="4" r="3" fill="red"/>
<path d="M1 1h10v6h-10zM2 2h8v3h-8z" fill="#fff" fill-rule="evenodd"/>
<path d="M0 3h12v1h-12zM2 2h8v3h-8z" fill="red" fill-rule="evenodd"/></g></svg>"""


@pytest.mark.parametrize(("opacity", "paths"), [("1", [1, 2, 1, 1]), ("0.5", [1, 1, 1, 1, 1])])
def test_translucent_paint_shows_twice_where_paths_overlap(tmp_path: Path, opacity: str, paths: list[int]) -> None:
    file = tmp_path / "logo.svg"
    file.write_text(LOGO.format(opacity))
    drawing = read_svg(file)
    layers = drawing.layers()
    assert [len(layer.paths) for layer in layers] == paths
    assert sum((layer.paths for layer in layers), ()) == drawing.paths
    assert gap(stacked(layers, 80, 120), render_file(file.read_text())) < 0.006


def test_order_names_and_map_are_kept() -> None:
    paths = tuple(square(0.2 * k, 0.2, 0.5, paint) for k, paint in enumerate((RED, BLUE, RED)))
    drawing = Drawing(paths, np.array([[2.0, 0.0, 1.0], [0.0, -2.0, 3.0]]), "logo")
    layers = drawing.layers()
    assert [layer.name for layer in layers] == ["logo/1-#ff0000", "logo/2-#0000ff", "logo/3-#ff0000"]
    assert all((layer.to_source == drawing.to_source).all() for layer in layers)


def test_fill_rules_are_kept() -> None:
    paths = tuple(replace(square(0.1, 0.1, 0.5, RED), fill_rule=rule) for rule in FillRule)
    (layer,) = Drawing(paths).layers()
    assert [path.fill_rule for path in layer.paths] == list(FillRule)


@pytest.mark.parametrize(("x", "layers"), [(0.4, 1), (0.3, 2), (0.29, 2)])
def test_translucent_paths_share_a_layer_only_if_they_are_apart(x: float, layers: int) -> None:
    glass = Paint((1.0, 0.0, 0.0), 0.5)
    drawing = Drawing((square(0.1, 0.1, 0.2, glass), square(0.7, 0.1, 0.2, glass), square(x, 0.1, 0.2, glass)))
    assert len(drawing.layers()) == layers
    assert np.abs(stacked(drawing.layers(), 40, 40) - render_drawing(drawing, 40, 40)).max() < 0.01


@pytest.mark.parametrize(("color", "opacity"), [((0.0, 0.0, 1.5), 1.0), ((0.0, 0.0, 0.0), -0.1), ((np.nan, 0, 0), 1.0)])
def test_paint_out_of_range_is_refused(color: tuple[float, float, float], opacity: float) -> None:
    with pytest.raises(SourceError, match=r"must be in 0\.\.1"):
        Paint(color, opacity)


def test_nothing_painted_has_no_layers() -> None:
    assert Drawing(()).layers() == ()
