"""Water in a real browser: where it is, against the exact renderer; what it looks like, against three.js' own."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import bundle, served
from mask_page import THREES, decode, distance

import vexture
from vexture.drawing import Drawing

PAGE = Path(__file__).parent / "pages" / "water.js"
FLAT = 0x2050A0
GROUND = 0xE0C890
KINDS = ("vector", "simple")


def bay(level: float) -> Drawing:
    """A wavy shore with the sea to the north of it, and two islands, one of them smaller than the strip of foam."""
    x = np.linspace(0, 1, 200)
    shore = np.column_stack([x, level + 0.08 * np.sin(5 * x + 0.5) + 0.03 * np.sin(17 * x)])
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    islands = [np.column_stack([0.5 + r * np.cos(turn), 0.8 + r * np.sin(turn)]) for r in (0.05, 0.004)]
    islands[1][:, 0] += 0.2
    sea = np.concatenate([shore, [[1, 1], [0, 1]]])
    return Drawing.polygon(sea, *islands)


BAYS = {"bay": 0.35, "high": 0.25}


@pytest.fixture(scope="module")
def address(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("water")
    for name, level in BAYS.items():
        vexture.convert(bay(level)).save(folder / f"{name}.ktx2")
    for three in THREES:
        bundle(PAGE, folder / f"{three}.js", three)
        text = f'<!doctype html><link rel="icon" href="data:,"><script type="module" src="{three}.js"></script>'
        (folder / f"{three}.html").write_text(text, encoding="utf-8")
    with served(folder) as url:
        yield url


@pytest.fixture(params=THREES)
def page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    return open_page(f"{address}/{request.param}.html")


def draw(page: Any, **config: Any) -> np.ndarray:
    return decode(page.evaluate("config => page.draw(config)", config)["picture"])


def rgb(color: int) -> np.ndarray:
    return np.array([color >> 16, color >> 8 & 255, color & 255]) / 255.0


def over_ground(coverage: np.ndarray) -> np.ndarray:
    """Flat water on flat ground: the canvas blends values as it holds them."""
    return rgb(GROUND) * (1.0 - coverage) + rgb(FLAT) * coverage


def exact(name: str, size: int = 512, to_unit: np.ndarray | None = None) -> np.ndarray:
    return vexture.render(bay(BAYS[name]), (size, size), to_unit, renderer="exact").astype(float)[..., None]


@pytest.mark.parametrize("kind", KINDS)
def test_flat_water_is_what_the_exact_renderer_draws(page: Any, kind: str, screenshot: Callable[..., Path]) -> None:
    for foam in ({"width": 0.0}, {"width": 0.05}):
        options = {"flat": FLAT, "foam": foam}
        flat = draw(page, water=kind, options=options, ground=GROUND, toneMapping="ACESFilmicToneMapping")
        screenshot(page.locator("canvas"), f"{foam['width']}")
        difference = 255 * np.abs(flat - over_ground(exact("bay")))
        assert difference.mean() <= 0.6
        assert difference.max() <= 6.0
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
    seen = vexture.render(bay(BAYS["bay"]), (512, len(shown)), below_horizon, renderer="exact")
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
    reach = round(3 * 512 * width)  # the wide footprint sees outlines by cells as large as itself
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
def test_one_water_turns_into_another_without_a_blank_picture(page: Any, kind: str) -> None:
    config = {"water": kind, "options": {"flat": FLAT}, "ground": GROUND}
    steps: list[dict[str, Any]] = [{}, {"fadeTo": "high"}, {"fade": 0.5}, {"fade": 1}, {"texture": "high"}]
    steps += [{"replace": "bay"}, {"texture": None}, {"fadeTo": "bay"}, {"fade": 0.25}, {"texture": "bay"}]
    found = page.evaluate("([config, steps]) => page.changes(config, steps)", [config, steps])
    bay_there, high_there = exact("bay"), exact("high")
    mean = 0.5 * (bay_there + high_there)
    expected = [bay_there, bay_there, mean, high_there, high_there]
    expected += [bay_there, 0 * mean, 0 * mean, 0.25 * bay_there, bay_there]
    for text, coverage in zip(found["pictures"], expected, strict=True):
        assert distance(decode(text), over_ground(coverage)) <= 0.6
    assert found["programs"] == 1
