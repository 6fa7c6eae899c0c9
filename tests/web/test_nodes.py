"""Materials and nodes of `vexture/webgpu` in a real browser, on WebGPU and on its WebGL 2 fallback."""

import base64
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import vexture
from chromium import ROOT, bundle, serve_folder
from fold_reference import errors
from vexture.fold.fold import Fold
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.cpu import render_cpu
from vexture.renderers.view import fit, window
from vexture.texture.texture import Texture

Picture = NDArray[np.float64]

SHAPES = ROOT / "examples" / "shapes"
FIXTURES = ROOT / "tests" / "core" / "svg" / "fixtures"
PAGE = Path(__file__).parent / "pages" / "nodes.js"
ATLAS = ("holes", "flame", "cake", "thumb")
BACKENDS = ("webgpu", "webgl")
SIZE = (100, 100)
CLOSE = 0.1 / 255  # the aim of each shader against the mirror
INK = 0xC03020
RED = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path d="M1 1H7L4 6z" fill="#f00"/></svg>"""
ELEMENTS = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path id="one" d="M0 0H4V8H0z" fill="#00bc00"/>
<path id="two" d="M5 1H8V7H5z" fill="#0000ff"/></svg>"""


@cache
def texture(name: str) -> Texture:
    if name == "atlas":
        return vexture.atlas([SHAPES / f"{one}.svg" for one in ATLAS])
    if name == "red":
        return vexture.convert(vexture.read(RED.encode()))
    if name == "blended":
        return vexture.convert(FIXTURES / "gradients" / "blended.svg")
    if name == "ring":
        rng = np.random.default_rng(1)
        angles, reach = np.sort(rng.uniform(0, 2 * np.pi, 3000)), rng.uniform(0.05, 0.49, 3000)
        corners = np.stack([0.5 + reach * np.cos(angles), 0.5 + reach * np.sin(angles)], axis=1)
        return vexture.convert(vexture.Drawing.polygon(corners))
    return vexture.convert(SHAPES / f"{name}.svg")


@cache
def fold() -> Fold:
    rng = np.random.default_rng(5)
    shape = (10, 12)
    begin, duration = rng.uniform(0, 4, shape), rng.uniform(2, 5, shape)
    return Fold(rng.uniform(-0.012, 0.012, (*shape, 2)), rng.integers(0, 5, shape), begin, duration, 5.0)


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    def fill(folder: Path) -> None:
        for name in ("duck", "atlas", "blended", "ring", "cake", "red"):
            texture(name).save(folder / f"{name}.ktx2")
        bundle(PAGE, folder / "nodes.js")
        (folder / "wild.fold.ktx2").write_bytes(fold().to_ktx2())
        vexture.convert(vexture.read(ELEMENTS.encode()), restyle=True).save(folder / "elements.ktx2")
        icon = '<!doctype html><link rel="icon" href="data:,"><body>'
        (folder / "nodes.html").write_text(f'{icon}<script type="module" src="nodes.js"></script>', encoding="utf-8")

    with serve_folder(made_once("nodes", fill)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    page = open_page(f"{address}/nodes.html", keep=True)
    page.wait_for_function("globalThis.drawn")
    return page


def drawn(page: Any, scene: str, size: tuple[int, int] = SIZE, **options: Any) -> Picture:
    """A picture in linear light, the top row first."""
    found = page.evaluate(f"(options) => drawn.{scene}(options)", {"size": list(size), **options})
    assert found["complaints"] == []
    pixels = np.frombuffer(base64.b64decode(found["pixels"]), np.float32)
    return pixels.reshape(size[1], size[0], 4).astype(float)


def linear(encoded: Any) -> Any:
    encoded = np.asarray(encoded, float)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def over_white(coverage: Any, color: int) -> Picture:
    rgb = linear(np.array([color >> 16, color >> 8 & 255, color & 255]) / 255.0)
    return np.asarray(1.0 - coverage[..., None] + coverage[..., None] * rgb)


def mirror(name: str, view: Any = None, root: int = 0) -> Picture:
    return render_cpu(texture(name), SIZE, view, root=root).astype(float)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", ["duck", "ring"])
def test_a_node_of_coverage_is_the_mirrors(page: Any, backend: str, name: str) -> None:
    row, column = np.argwhere(np.abs(mirror(name) - 0.5) < 0.2)[20]
    near = ((column - 5.5) / 100, 1.0 - (row + 6.5) / 100, 0.125, 0.125)
    for place in ((0.0, 0.0, 1.0, 1.0), near):
        view = window(*place).matrix(SIZE)
        picture = drawn(page, "node", backend=backend, texture=name, what="vectorCoverage", place=place)
        expected = mirror(name, view)
        assert 0.0 < expected.mean() < 1.0
        assert np.abs(picture[..., 0] - expected).max() < (0.5 / 255 if name == "ring" else CLOSE)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_node_of_colour_is_the_mirrors(page: Any, backend: str) -> None:
    for is_linear in (False, True):
        options = {"linear": is_linear}
        picture = drawn(page, "node", backend=backend, texture="blended", what="vectorColor", options=options)
        expected = render_cpu_colours(texture("blended"), SIZE, is_linear=is_linear).astype(float)
        alpha = expected[..., 3:]
        straight = expected[..., :3] / np.maximum(alpha, 1e-9)
        light = straight if is_linear else linear(straight)
        assert np.ptp(alpha) > 0.5
        assert np.abs(picture[..., :3] * picture[..., 3:] - light * alpha).max() < CLOSE
        assert np.abs(picture[..., 3:] - alpha).max() < CLOSE


@pytest.mark.parametrize("backend", BACKENDS)
def test_beyond_the_square_a_node_goes_on(page: Any, backend: str) -> None:
    place = (-0.5, -0.5, 2.0, 2.0)
    view = window(*place).matrix(SIZE)
    once = mirror("duck", view)
    none = drawn(page, "node", backend=backend, texture="duck", what="vectorCoverage", place=place)[..., 0]
    assert np.abs(none - once).max() < CLOSE
    options = {"wrap": "repeat", "flat": True}
    picture = drawn(page, "node", backend=backend, texture="duck", what="vectorCoverage", place=place, options=options)
    tiles = [np.roll(once, (50 * i, 50 * j), (0, 1)) for i in range(2) for j in range(2)]
    inside = np.s_[25:75, 25:75]
    assert np.abs(picture[..., 0][inside] - once[inside]).max() < CLOSE
    assert np.abs(picture[..., 0] - np.max(tiles, axis=0)).max() < 2 / 255  # a seam has a part of each tile


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_material_shows_a_shape_and_its_options_are_live(page: Any, backend: str) -> None:
    def material(name: str = "duck", **options: Any) -> Picture:
        options = {"backend": backend, "texture": name, "type": "VectorNodeMaterial", **options}
        return drawn(page, "material", **options)[..., :3]

    ink = {"color": INK}
    assert np.abs(material(parameters=ink) - over_white(mirror("duck"), INK)).max() < CLOSE
    inverted = material(parameters=ink, changes={"invert": True})
    assert np.abs(inverted - over_white(1.0 - mirror("duck"), INK)).max() < CLOSE
    other = material("atlas", parameters={**ink, "root": "cake"}, changes={"root": "flame"}, clone=True)
    assert np.abs(other - over_white(mirror("atlas", root=1), INK)).max() < CLOSE
    swapped = material(parameters=ink, changes={"texture": "cake"})
    assert np.abs(swapped - over_white(mirror("cake"), INK)).max() < CLOSE
    cut = material(parameters=ink, changes={"mode": "cut", "threshold": 0.25})
    assert np.abs(cut - over_white((mirror("duck") >= 0.25).astype(float), INK)).max() < CLOSE
    painted = material("blended", parameters={"mode": "paint"})
    expected = render_cpu_colours(texture("blended"), SIZE).astype(float)
    light = linear(expected[..., :3] / np.maximum(expected[..., 3:], 1e-9)) * expected[..., 3:] + 1 - expected[..., 3:]
    assert np.abs(painted - light).max() < CLOSE
    tilted = material(parameters={"color": 0}, camera="tilted", clone=True)
    expected = drawn(page, "webglTilted", texture="duck")[..., :3]
    assert np.ptp(expected) > 0.5
    # SwiftShader's corners are at 16ths of a pixel, so that its plane lies up to a 32nd beside
    assert np.abs(tilted - expected).max() < (10 / 255 if backend == "webgpu" else CLOSE)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_colour_that_is_set_after_a_frame_is_shown_in_the_next_one(page: Any, backend: str) -> None:
    def recolored(name: str, **options: Any) -> Picture:
        options = {"backend": backend, "texture": name, "type": "VectorNodeMaterial", "recolor": INK, **options}
        return drawn(page, "material", **options)[..., :3]

    expected = over_white(mirror("red"), INK)
    assert 0.0 < mirror("red").mean() < 1.0
    for given in ({}, {"color": 0x0000FF}, {"mode": "alpha"}):
        assert np.abs(recolored("red", parameters=given) - expected).max() < CLOSE, given
    assert np.abs(recolored("red", clone=True) - expected).max() < CLOSE
    own = recolored("red", parameters={"mode": "paint"})
    assert np.abs(own - over_white(mirror("red"), 0xFF0000)).max() < CLOSE
    opacity = render_cpu_colours(texture("blended"), SIZE)[..., 3].astype(float)
    assert np.abs(recolored("blended") - over_white(opacity, INK)).max() < CLOSE


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
def test_every_node_material_can_be_masked(page: Any, backend: str) -> None:
    basic = {"backend": backend, "texture": "duck", "type": "MeshBasicNodeMaterial", "parameters": {"color": 0x2050A0}}
    duck = mirror("duck")
    ground, ink = (over_white(np.ones(SIZE), color) for color in (0x2050A0, INK))
    for mask, expected in (
        ({}, over_white(duck, 0x2050A0)),
        ({"mode": "cut", "invert": True}, over_white((duck <= 0.5).astype(float), 0x2050A0)),
        ({"mode": "mix", "color": INK}, ground + duck[..., None] * (ink - ground)),
        ({"mode": "mix", "color": INK, "invert": True}, ink + duck[..., None] * (ground - ink)),
        ({"transform": [0, 1, 0, 1, 0, 0, 0, 0, 1]}, over_white(duck[::-1, ::-1].T, 0x2050A0)),
    ):
        for clone in (False, True):
            picture = drawn(page, "material", **basic, mask=mask, clone=clone)[..., :3]
            assert np.abs(picture - expected).max() < CLOSE, (mask, clone)
    for kind in (
        "MeshLambertNodeMaterial",
        "MeshStandardNodeMaterial",
        "MeshPhysicalNodeMaterial",
        "MeshToonNodeMaterial",
        "MeshPhongNodeMaterial",
        "MeshMatcapNodeMaterial",
        "SpriteNodeMaterial",
    ):
        picture = drawn(page, "material", **{**basic, "type": kind}, mask={})[..., :3]
        assert np.abs(picture[duck == 0] - 1.0).max() < CLOSE
        assert (picture[duck == 1].min(axis=1) < 0.9).all()
        edge = (duck > 0.3) & (duck < 0.7)
        assert (picture[edge].min(axis=1) < 0.97).all()
        assert (picture[edge].max(axis=1) > 0.2).all()
    picture = drawn(page, "material", **{**basic, "texture": "blended"}, mask={"mode": "paint"})[..., :3]
    paint = render_cpu_colours(texture("blended"), SIZE).astype(float)
    light = linear(paint[..., :3] / np.maximum(paint[..., 3:], 1e-9)) * paint[..., 3:] + (1 - paint[..., 3:]) * ground
    assert np.abs(picture - light).max() < CLOSE


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_fold_moves_and_elements_get_other_colours(page: Any, backend: str) -> None:
    for kind, how in (("VectorNodeMaterial", "changes"), ("MeshBasicNodeMaterial", "mask")):
        options = {"type": kind, "parameters": {"color": 0}, "fold": "wild", how: {"time": 1.7}}
        picture = 1.0 - drawn(page, "material", backend=backend, texture="duck", **options)[..., 0]
        found = errors(picture, texture("duck"), fold(), fit(SIZE), 1.7)
        assert found.mean() < 2.0  # the footprint of a pixel is bent, and taken for straight
        still = errors(picture, texture("duck"), fold(), fit(SIZE), 0.3)
        assert still.mean() > 5.0
    options = {"type": "VectorNodeMaterial", "parameters": {"mode": "paint"}}
    red = dict.fromkeys(("one", "two"), "#f00")
    before = drawn(page, "material", backend=backend, texture="elements", **options)
    after = drawn(page, "material", backend=backend, texture="elements", paints=red, **options)
    assert np.abs(before[50, 25, :3] - linear([0, 188 / 255, 0])).max() < 0.01
    assert np.abs(after[50, 25, :3] - [1, 0, 0]).max() < 0.01


@pytest.mark.parametrize("backend", BACKENDS)
def test_new_data_are_shown_without_a_new_program(page: Any, backend: str) -> None:
    picture = drawn(page, "live", backend=backend)[..., 0]
    assert np.abs(picture - (1.0 - mirror("cake"))).max() < CLOSE


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_node_shows_new_data_of_another_kind(page: Any, backend: str) -> None:
    for first, then in (("duck", "blended"), ("blended", "duck")):
        expected = drawn(page, "node", backend=backend, texture=then, what="vectorColor")
        picture = drawn(page, "liveNode", backend=backend, first=first, then=then, what="vectorColor")
        assert np.abs(picture - expected).max() < CLOSE


@pytest.mark.parametrize("backend", BACKENDS)
def test_each_instance_has_its_shape(page: Any, backend: str) -> None:
    mask = {"instanced": True, "root": None}
    options = {"backend": backend, "texture": "atlas", "type": "MeshBasicNodeMaterial", "parameters": {"color": 0}}
    picture = drawn(page, "material", **options, mask=mask, roots=list(ATLAS))[..., 0]
    for place in range(4):
        row, column = divmod(place, 2)
        tile = picture[50 * row : 50 * row + 50, 50 * column : 50 * column + 50]
        expected = 1.0 - render_cpu(texture("atlas"), (50, 50), root=place)
        assert np.abs(tile - expected).max() < CLOSE


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_shadow_has_the_shape(page: Any, backend: str) -> None:
    light = drawn(page, "shadow", (200, 200), backend=backend, texture="duck")[..., 0]
    duck = render_cpu(texture("duck"), (200, 200))
    assert light.max() > 0.9
    assert ((light < 0.5) == (duck > 0.5)).mean() > 0.985
    assert 0.1 < (light < 0.5).mean() < 0.9


def test_a_material_says_when_it_meets_the_wrong_renderer(page: Any) -> None:
    for backend in BACKENDS:
        found = page.evaluate("(options) => drawn.wrong(options)", {"backend": backend, "texture": "duck"})
        every = " | ".join(found["said"] + found["complaints"])
        assert "'vexture/webgpu'" in every
        assert "WebGPURenderer" in every
        assert "MeshStandardMaterial is no node material" in every
        assert "MeshStandardNodeMaterial is a material of WebGPURenderer" in every
        assert 'wrap is "mirror"; it must be one of none, clamp, repeat' in every
        assert "fold is {}; load one by FoldTexture.parse" in every
        assert 'an option is "colour"; it must be one of root, uv' in every
    found = page.evaluate("(options) => drawn.wrong(options)", {"backend": "webgl only", "texture": "duck"})
    assert "is drawn by WebGLRenderer" in " | ".join(found["said"] + found["complaints"])
