"""Water in a real browser: where it is, against the exact renderer; what it looks like, against three.js' own."""

from collections.abc import Callable, Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mask_page import NEWEST, THREES, decode, distance

import vexture
from chromium import bundle, serve_folder
from fold_reference import errors
from vexture.drawing.drawing import Drawing
from vexture.fold.fold import Fold
from vexture.fold.shore import shore_fold

PAGE = Path(__file__).parent / "pages" / "water.js"
FLAT = 0x2050A0
GROUND = 0xE0C890
KINDS = ("vector", "simple")
TEXEL = 1 / 256
"""Of the raster along the shore, where foam is wide."""


def bay(level: float) -> Drawing:
    """A wavy shore with the sea to the north of it, and two islands, one of them smaller than the strip of foam."""
    x = np.linspace(0, 1, 200)
    shore = np.column_stack([x, level + 0.08 * np.sin(5 * x + 0.5) + 0.03 * np.sin(17 * x)])
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    islands = [np.column_stack([0.5 + r * np.cos(turn), 0.8 + r * np.sin(turn)]) for r in (0.05, 0.004)]
    islands[1][:, 0] += 0.2
    sea = np.concatenate([shore, [[1, 1], [0, 1]]])
    return Drawing.polygon(sea, *islands)


def specks() -> Drawing:
    """A sea with an island, and land with a channel, both far narrower than the strip of foam."""
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    island = np.column_stack([0.25 + 4e-5 * np.cos(turn), SPECK_HEIGHT + 4e-5 * np.sin(turn)])
    sea = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)], island[::-1])
    channel = Drawing.polygon([(0.75, 0), (0.75003, 0), (0.7502, 1), (0.75017, 1)])
    return Drawing((*sea.paths, *channel.paths))


SPECK_HEIGHT = 0.512345
BAYS = {"bay": 0.35, "high": 0.25}
SWAY = 5.0


@cache
def swaying() -> Fold:
    return shore_fold(bay(BAYS["bay"]), amplitude=0.02, period=SWAY, size=32)


@pytest.fixture(scope="module")
def address(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("water")
    for name, level in BAYS.items():
        vexture.convert(bay(level), tolerance=0).save(folder / f"{name}.ktx2")
    vexture.convert(specks()).save(folder / "specks.ktx2")
    (folder / "bay.fold.ktx2").write_bytes(swaying().to_ktx2())
    for three in THREES:
        bundle(PAGE, folder / f"{three}.js", three)
        text = f'<!doctype html><link rel="icon" href="data:,"><script type="module" src="{three}.js"></script>'
        (folder / f"{three}.html").write_text(text, encoding="utf-8")
    with serve_folder(folder) as url:
        yield url


@pytest.fixture(params=NEWEST)
def page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    return open_page(f"{address}/{request.param}.html", keep=True)


@pytest.fixture(params=NEWEST)
def fresh_page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    """For tests that change the page's textures or count its programs."""
    return open_page(f"{address}/{request.param}.html")


def draw(page: Any, **config: Any) -> np.ndarray:
    return decode(page.evaluate("config => page.draw(config)", config)["picture"])


def rgb(color: int) -> np.ndarray:
    return np.array([color >> 16, color >> 8 & 255, color & 255]) / 255.0


def over_ground(coverage: np.ndarray) -> np.ndarray:
    """Flat water on flat ground: the canvas blends values as it holds them."""
    return rgb(GROUND) * (1.0 - coverage) + rgb(FLAT) * coverage


def exact(name: str, size: int = 512, to_unit: np.ndarray | None = None) -> np.ndarray:
    return vexture.coverage(bay(BAYS[name]), (size, size), to_unit, renderer="exact").astype(float)[..., None]


@pytest.mark.parametrize("kind", KINDS)
def test_flat_water_is_what_the_exact_renderer_draws(page: Any, kind: str, screenshot: Callable[..., Path]) -> None:
    for foam in ({"width": 0.0}, {"width": 0.05}):
        options = {"flat": FLAT, "foam": foam}
        flat = draw(page, water=kind, options=options, ground=GROUND, toneMapping="ACESFilmicToneMapping")
        screenshot(page.locator("canvas"), f"{foam['width']}")
        difference = 255 * np.abs(flat - over_ground(exact("bay")))
        assert difference.mean() <= 0.2
        assert difference.max() <= 2.5
    for size in (20, 33):  # pixels wider than the boxes along the shore
        config = {"water": kind, "width": size, "height": size, "ground": GROUND}
        flat = draw(page, **config, options={"flat": FLAT, "foam": {"width": 0.0}})
        assert 255 * np.abs(flat - over_ground(exact("bay", size))).max() <= 2.5
    config = {"water": kind, "camera": "coast", "options": options, "ground": GROUND}
    drawn = page.evaluate("config => page.draw(config)", config)
    clip = np.reshape(drawn["matrix"], (4, 4)).T[[0, 1, 3]][:, [0, 1, 3]]
    to_plane = np.array([[100.0, 0, -50], [0, 100, -50], [0, 0, 1]])
    to_unit = np.linalg.inv(np.array([[256.0, 0, 256], [0, -256, 256], [0, 0, 1]]) @ clip @ to_plane)
    x, y = np.meshgrid(np.arange(512) + 0.5, np.arange(512) + 0.5)
    below = (to_unit[2, 0] * x + to_unit[2, 1] * y + to_unit[2, 2]) * (to_unit[2] @ (256, 511, 1)) > 0
    to_unit *= np.sign(to_unit[2] @ (256, 511, 1))
    rows = slice(int(np.argmax(below.all(axis=1))) + 12, None)  # below the horizon
    shown = decode(drawn["picture"])[rows]
    below_horizon = to_unit @ np.array([[1, 0, 0], [0, 1, rows.start], [0, 0, 1.0]])
    seen = vexture.coverage(bay(BAYS["bay"]), (512, len(shown)), below_horizon, renderer="exact")
    assert ((seen > 0.01) & (seen < 0.99)).sum() > 100
    assert distance(shown, over_ground(seen.astype(float)[..., None])) <= 0.6


def test_away_from_the_shore_it_is_the_water_of_three(page: Any, screenshot: Callable[..., Path]) -> None:
    for camera in ("flat", "coast"):
        plain = draw(page, water="plain", camera=camera)
        none = draw(page, water="none", camera=camera)
        ours = draw(page, camera=camera, options={"foam": {"width": 0.0}})
        flat = draw(page, camera=camera, options={"flat": 0xFFFFFF})
        inside = (np.abs(flat - 1.0) < 1e-3).all(axis=2) & (np.abs(plain - none).max(axis=2) > 0)
        assert inside.mean() > 0.1
        assert 255 * np.abs(ours - plain)[inside].max() <= 2.0
        screenshot(page.locator("canvas"), camera)


@pytest.mark.parametrize("kind", KINDS)
def test_foam_and_shallows_are_near_the_shore_only(page: Any, kind: str, screenshot: Callable[..., Path]) -> None:
    width = 0.04
    bare = draw(page, water=kind, options={"foam": {"width": 0.0}, "shallow": 0x40C0B0}, ground=GROUND)
    foamy = draw(page, water=kind, options={"foam": {"width": width}, "shallow": 0x40C0B0}, ground=GROUND)
    later = draw(page, water=kind, options={"foam": {"width": width}, "shallow": 0x40C0B0}, ground=GROUND, time=5)
    screenshot(page.locator("canvas"))
    coverage = exact("bay")[..., 0]
    reach = round(512 * (width + 1.5 * TEXEL))
    land = np.pad((coverage < 1.0).astype(int), ((reach + 1, reach), (reach + 1, reach)), mode="edge")
    sums = land.cumsum(0).cumsum(1)
    side = 2 * reach + 1
    near = sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side] > 0
    changed = np.abs(foamy - bare).max(axis=2) > 2 / 255
    assert not (changed & ~near).any()
    assert changed[near & (coverage == 1.0)].mean() > 0.1
    assert np.abs(foamy - bare)[coverage == 0.0].max() <= 4 / 255  # fitted outlines may touch a pixel more
    assert (np.abs(later - foamy).max(axis=2) > 0.05)[near & (coverage == 1.0)].any()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("place", [(0.25, SPECK_HEIGHT), (0.75011, SPECK_HEIGHT)])
def test_what_is_far_narrower_than_the_foam_is_exact(page: Any, kind: str, place: tuple[float, float]) -> None:
    side = 512 * 4e-6
    transform = np.array([[side, 0, place[0] - side / 2], [0, side, place[1] - side / 2], [0, 0, 1]])
    to_unit = transform @ np.array([[1 / 512, 0, 0], [0, -1 / 512, 1], [0, 0, 1]])
    expected = vexture.coverage(vexture.convert(specks()), (512, 512), to_unit).astype(float)[..., None]
    assert expected.min() == 0.0
    assert expected.max() == 1.0
    for width in (0.0, 0.05, 0.003):
        config = {"water": kind, "texture": "specks", "transform": transform.ravel().tolist(), "ground": GROUND}
        flat = draw(page, **config, options={"flat": FLAT, "foam": {"width": width}})
        assert distance(flat, over_ground(expected)) <= 0.6


@pytest.mark.parametrize("kind", KINDS)
def test_it_moves_with_its_fold(page: Any, kind: str, screenshot: Callable[..., Path]) -> None:
    texture = vexture.convert(bay(BAYS["bay"]), tolerance=0)
    to_unit = np.array([[1 / 512, 0, 0], [0, -1 / 512, 1], [0, 0, 1.0]])
    options = {"flat": 0xFFFFFF, "foam": {"width": 0.05}}
    pictures = []
    for seconds in (0.0, 1.7, 8604.1):
        config = {"water": kind, "fold": "bay", "time": seconds, "ground": 0, "options": options}
        pictures.append(draw(page, **config)[..., 0])
        found = errors(pictures[-1], texture, swaying(), to_unit, seconds)
        assert len(found) > 200
        assert np.percentile(found, 99) <= 6.0
    screenshot(page.locator("canvas"))
    assert max(np.abs(pictures[0] - one).max() for one in pictures) > 0.5


@pytest.mark.parametrize("kind", KINDS)
def test_foam_follows_its_width_and_the_texture(fresh_page: Any, kind: str) -> None:
    def looks(name: str, width: float) -> dict[str, Any]:
        return {"water": kind, "texture": name, "ground": GROUND, "options": {"foam": {"width": width}}}

    fresh = [draw(fresh_page, **looks(name, width)) for name, width in (("bay", 0.1), ("bay", 0.04), ("high", 0.04))]
    assert min(np.abs(one - other).max() for one, other in pairwise(fresh)) > 0.1
    steps: list[dict[str, Any]] = [{}, {"foam": {"width": 0.04}}, {"replace": "high"}, {"replace": "bay"}]
    steps += [{"texture": "high"}, {"fadeTo": "bay"}, {"fade": 0.999}]
    found = fresh_page.evaluate("([config, steps]) => page.changes(config, steps)", [looks("bay", 0.1), steps])
    for text, expected in zip(found["pictures"], [*fresh, *fresh[1:], fresh[2], fresh[1]], strict=True):
        assert (np.abs(decode(text) - expected) > 4 / 255).mean() <= 1e-3  # a line's front moves a pixel at 0.999


@pytest.mark.parametrize("kind", KINDS)
def test_a_lost_driver_comes_back_with_its_foam(fresh_page: Any, kind: str) -> None:
    """What is drawn once and kept, along the shore, is lost with the driver."""
    config = {"water": kind, "ground": GROUND, "options": {"foam": {"width": 0.1}}}
    found = fresh_page.evaluate("([config, steps]) => page.changes(config, steps)", [config, [{}, {"lost": True}]])
    before, after = map(decode, found["pictures"])
    assert np.ptp(before) > 0.3
    assert np.abs(after - before).max() <= 1 / 255


def test_the_renderer_is_left_as_it_was(fresh_page: Any) -> None:
    """Rasters are drawn in the middle of a picture, into a part of the canvas that is not cleared."""
    config = {"options": {"flat": FLAT, "foam": {"width": 0.05}}, "part": [64, 32, 256, 256]}
    steps: list[dict[str, Any]] = [{}, {}, {"foam": {"width": 0.02}}, {"replace": "bay"}]
    found = fresh_page.evaluate("([config, steps]) => page.changes(config, steps)", [config, steps])
    first, *others = map(decode, found["pictures"])
    assert np.ptp(first[512 - 288 : 512 - 32, 64:320]) > 0.5
    assert np.ptp(first[:200]) == 0.0
    for other in others:
        assert np.abs(other - first).max() <= 1 / 255


@pytest.mark.parametrize("kind", KINDS)
def test_one_water_turns_into_another_without_a_blank_picture(fresh_page: Any, kind: str) -> None:
    config = {"water": kind, "options": {"flat": FLAT, "foam": {"width": 0.03}}, "ground": GROUND}
    steps: list[dict[str, Any]] = [{}, {"fadeTo": "high"}, {"fade": 0.5}, {"fade": 1}, {"texture": "high"}]
    steps += [{"fadeTo": "bay"}, {"fade": 0.25}, {"texture": "high"}]
    steps += [{"replace": "bay"}, {"texture": None}, {"fadeTo": "bay"}, {"fade": 0.25}, {"texture": "bay"}]
    found = fresh_page.evaluate("([config, steps]) => page.changes(config, steps)", [config, steps])
    bay_there, high_there = exact("bay"), exact("high")
    mean = 0.5 * (bay_there + high_there)
    expected = [bay_there, bay_there, mean, high_there, high_there]
    expected += [high_there, 0.5 * (mean + high_there), high_there]
    expected += [bay_there, 0 * mean, 0 * mean, 0.25 * bay_there, bay_there]
    for text, coverage in zip(found["pictures"], expected, strict=True):
        assert distance(decode(text), over_ground(coverage)) <= 0.6
    assert found["programs"] == 1
