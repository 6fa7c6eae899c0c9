"""Every pixel by WGSL beside the mirror, and beside GLSL where there is no mirror; on shallow and on deep trees."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from either_language import Given, Numbers, by_glsl, by_parameters, by_wgsl, device
from planar import widen_paints
from vexture import atlas, convert
from vexture.base.errors import DeviceError
from vexture.base.layout import MOST_DEPTH
from vexture.drawing.drawing import Drawing
from vexture.fold import layout as fold_layout
from vexture.fold.fold import Fold
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.cpu import render_cpu
from vexture.renderers.device import context
from vexture.renderers.shader import WRAPS, shader_text
from vexture.renderers.uniforms import uniforms_of
from vexture.renderers.view import fit, window
from vexture.texture.texture import Texture

ROOT = Path(__file__).parents[3]
SHAPES = ROOT / "examples" / "shapes"
FIXTURES = ROOT / "tests" / "core" / "svg" / "fixtures"
WIDENED = ", widened"
SIZE = (100, 100)
STEP = 1 / 255
CLOSE = 0.1 * STEP  # float32 in another order of operations; the aim of the shader against its mirror

ALL_NUMBERS = {"VEXTURE_FLAT": 0, "VEXTURE_WRAP": 0, "VEXTURE_GRADIENTS": 1, "VEXTURE_LINEAR": 0}
COVERAGE = "\nvec4 shown(vec2 pixel) { return vec4(view_coverage(pixel)); }\n"
COLOR = "\nvec4 shown(vec2 pixel) { return view_color(pixel); }\n"


@pytest.fixture(scope="module", autouse=True)
def needs_both() -> None:
    device()
    try:
        context()
    except DeviceError as error:
        pytest.skip(str(error))


def numbers(**changed: int) -> Numbers:
    return tuple({**ALL_NUMBERS, **{f"VEXTURE_{name}": value for name, value in changed.items()}}.items())


@cache
def ring() -> Texture:
    """A coast of 3,000 edges: a deep tree, in which a wrong level shows."""
    rng = np.random.default_rng(1)
    angles = np.sort(rng.uniform(0, 2 * np.pi, 3000))
    reach = rng.uniform(0.05, 0.49, 3000)
    corners = np.stack([0.5 + reach * np.cos(angles), 0.5 + reach * np.sin(angles)], axis=1)
    return convert(Drawing.polygon(corners))


@cache
def texture(name: str) -> Texture:
    if name == "ring":
        return ring()
    if name.endswith(WIDENED):
        return widen_paints(texture(name.removesuffix(WIDENED)))
    path = SHAPES / f"{name}.svg"
    return convert(str(path if path.is_file() else FIXTURES / f"{name}.svg"))


def tilted() -> Any:
    matrix = fit(SIZE)
    matrix[2] = [0.0, 1.5e-2, 0.1]
    return matrix


VIEWS = {
    "whole": fit(SIZE),
    "turned": window(0.1, 0.0, 0.9, 0.9, 30.0).matrix(SIZE),
    "small": window(-6.0, -6.0, 13.0, 13.0, 7.0).matrix(SIZE),
    "near": None,  # about the outline
    "tilted": tilted(),
}


def view_of(drawn: Texture, name: str) -> Any:
    """A view of a texture, into which an outline passes."""
    if name != "near":
        return VIEWS[name]
    whole = render_cpu(drawn, SIZE, VIEWS["whole"])
    row, column = np.argwhere((whole > 0.3) & (whole < 0.7))[20]
    x, y = (column + 0.5) / SIZE[0], 1.0 - (row + 0.5) / SIZE[1]
    return window(x - 0.01, y - 0.01, 0.02, 0.02).matrix(SIZE)


def given_of(drawn: Texture, view: Any, root: int = 0) -> tuple[Given, bool]:
    """Uniforms of `view.glsl`, and whether the view is flat."""
    uniforms = uniforms_of(drawn, SIZE, view, root)
    given = {"vextureTexels": drawn.texels, "to_unit": uniforms.to_unit, "base": uniforms.base, "root": uniforms.quad}
    return given, uniforms.is_flat


def off(one: Any, other: Any) -> float:
    return float(np.abs(one.astype(float) - other).max())


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", ["duck", "ring", "crossings"])
def test_coverage_is_the_mirrors(name: str, view: str) -> None:
    shown = view_of(texture(name), view)
    given, is_flat = given_of(texture(name), shown)
    mirror = render_cpu(texture(name), SIZE, shown)
    assert 0.0 < mirror.mean() < 1.0, "the view shows an outline"
    text = shader_text("view_coverage.glsl") + COVERAGE
    found = by_wgsl(text, numbers(FLAT=int(is_flat)), given, SIZE)[..., 0]
    assert off(found, mirror) < CLOSE
    assert off(found, by_glsl(text, numbers(FLAT=int(is_flat)), given, SIZE)[..., 0]) < CLOSE


@pytest.mark.parametrize(("view", "is_linear"), [*((name, 0) for name in VIEWS if name != "near"), ("whole", 1)])
@pytest.mark.parametrize("name", ["gradients/blended", "groups/nested", "groups/nested, widened"])
def test_colours_are_the_mirrors(name: str, is_linear: int, view: str) -> None:
    given, is_flat = given_of(texture(name), VIEWS[view])
    mirror = render_cpu_colours(texture(name), SIZE, VIEWS[view], is_linear=bool(is_linear))
    text = shader_text("view_color.glsl") + COLOR
    chosen = numbers(FLAT=int(is_flat), LINEAR=is_linear, GRADIENTS=int("gradients" in name))
    found = by_wgsl(text, chosen, given, SIZE)
    assert off(found, mirror) < CLOSE
    assert off(found, by_glsl(text, chosen, given, SIZE)) < CLOSE


WRAPPED = """
vec4 shown(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    return vec4(vextureWrapped(root, base, found.offset, found.dx, found.dy));
}
"""
SHEETS = """
vec4 shown(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    return found.seen ? vextureSheets(0, 3, base, found.offset, found.dx, found.dy) : vec4(0.0);
}
"""
LAYERS = """
vec4 shown(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    vec2 place = found.offset + vec2(base) * exp2(-32.0);
    return vextureLayers(0, 3, place, found.dx, found.dy);
}
"""
OVERLAY = """
vec4 shown(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    return vextureOverlay(vec4(0.25, 0.5, 0.75, 1.0), base, found.offset, found.dx, found.dy);
}
"""
FOLD = """
vec4 shown(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    VextureFolded there = vextureFold(base, found.offset, found.dx, found.dy);
    return vec4(there.uv - found.offset, there.dx);
}
"""


@cache
def sheets() -> Texture:
    """A map with gradients and two shapes of one colour, as layers of one drawing."""
    paths = [str(FIXTURES / "gradients" / "blended.svg"), str(SHAPES / "duck.svg"), str(SHAPES / "holes.svg")]
    return atlas(paths)


def layers_of(drawn: Texture) -> Any:
    """The texture `vexturePaints` (web/src/layers.js), with the whole square as bounds."""
    rows = []
    for place, quad in enumerate(drawn.quads):
        red, green, blue, alpha = (65535, 13107, 0, 52428) if place else (0, 0, 0, 65535)
        words = int(quad), red | green << 16, blue | alpha << 16, int(drawn.roots[place].is_map)
        rows.append([words, (0, 0, 65536, 65536)])
    return np.array(rows, np.uint32)


def everywhere(text: str, chosen: Numbers, given: Given, close: float = CLOSE) -> None:
    """The same picture, of more than one colour, in all three forms."""
    expected = by_glsl(text, chosen, given, SIZE)
    assert np.ptp(expected[..., 0]) > 0.001
    assert np.isfinite(expected).all()
    assert off(by_wgsl(text, chosen, given, SIZE), expected) < close
    assert off(by_parameters(text, chosen, given, SIZE), expected) < close


@pytest.mark.parametrize("view", ["small", "tilted", "turned"])
@pytest.mark.parametrize("wrap", WRAPS)
def test_beyond_the_square_it_goes_on_alike(wrap: str, view: str) -> None:
    given, _ = given_of(texture("duck"), VIEWS[view])
    everywhere(shader_text("wrap.glsl") + shader_text("view.glsl") + WRAPPED, numbers(WRAP=WRAPS[wrap]), given)


@pytest.mark.slow
@pytest.mark.parametrize("wrap", ["none", "repeat"])
def test_sheets_and_layers_are_composited_alike(wrap: str) -> None:
    given, _ = given_of(sheets(), VIEWS["turned"])
    given = {**given, "vexturePaints": layers_of(sheets())}
    view = shader_text("view.glsl")
    everywhere(shader_text("sheets.glsl") + view + SHEETS, numbers(WRAP=WRAPS[wrap]), given)
    everywhere(shader_text("layers.glsl") + view + LAYERS, numbers(WRAP=WRAPS[wrap]), given)


def test_overlays_are_drawn_alike() -> None:
    given, _ = given_of(texture("duck"), VIEWS["whole"])
    colours = {"vextureOverlayCoverage": [(1.0, 0.9, 0.8), (0.0, 0.2, 0.4)]}
    colours["vextureOverlayStored"] = colours["vextureOverlayCoverage"][::-1]
    colours["vextureOverlayDepth"] = [(k / MOST_DEPTH, 0.5, 0.0) for k in range(MOST_DEPTH + 1)]
    values = {
        "vextureOverlayRoot": given["root"],
        "vextureOverlayOfMap": False,
        "vextureOverlayMeans": (0, 0),
        "vextureOverlayShow": (1.0, 0.5, 0.25),
        "vextureOverlayCutoff": 2.0,
    }
    text = shader_text("overlay.glsl") + shader_text("view.glsl") + OVERLAY
    everywhere(text, numbers(), {**given, **values, **colours})


@pytest.mark.parametrize("wrap", ["none", "repeat"])
def test_a_fold_moves_alike(wrap: str) -> None:
    rng = np.random.default_rng(3)
    kinds, begin = rng.integers(0, 5, (9, 14)), rng.uniform(0.0, 3.9, (9, 14))
    fold = Fold(rng.uniform(-0.05, 0.05, (9, 14, 2)), kinds, begin, rng.uniform(0.5, 4.0, (9, 14)), 4.0)
    given, _ = given_of(texture("duck"), VIEWS["turned"])
    moved = {"vextureFolding": fold.texels, "vextureTime": fold.clock(1.3), "vextureCycle": fold.cycle}
    text = shader_text("fold.glsl", fold_layout) + shader_text("view.glsl") + FOLD
    everywhere(text, numbers(WRAP=WRAPS[wrap]), {**given, **moved}, 1e-5)
