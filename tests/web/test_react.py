"""Components of React Three Fiber in a real browser, against the exact renderer's colours."""

import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mask_page import Picture, decode, distance, exact

import vexture
from chromium import WEB, bundle, serve_folder
from vexture.fold.fold import Fold, Kind

SIZE = 256
HALF_STEP = 0.6  # of 255: an 8-bit framebuffer rounds
FIXTURES = WEB / "test" / "fixtures"
PAINTED = {"texture": "elements.ktx2", "mode": "paint"}


def prepare(folder: Path) -> None:
    """Write the page and its textures."""
    bundle(Path(__file__).parent / "pages" / "react.jsx", folder / "react.js")
    for name in ("elements", "drawings", "duck"):
        shutil.copy(FIXTURES / f"{name}.ktx2", folder)
    swing = Fold(np.full((1, 1, 2), (0.25, 0.0)), Kind.PERIODIC, duration=4.0, cycle=4.0)  # type: ignore[arg-type]
    (folder / "swing.fold.ktx2").write_bytes(swing.to_ktx2())
    icon = '<!doctype html><link rel="icon" href="data:,"><body>'
    (folder / "index.html").write_text(f'{icon}<script type="module" src="react.js"></script>', encoding="utf-8")


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    with serve_folder(made_once("react", prepare)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    opened = open_page(f"{address}/index.html", (SIZE, SIZE), keep=True)
    opened.evaluate("page.ready()")
    return opened


def draw(page: Any, *items: dict[str, Any]) -> Picture:
    """Show some meshes, each of a kind with its props, and nothing else."""
    return decode(page.evaluate("items => page.draw(items)", list(items)))


def shared(**props: Any) -> dict[str, Any]:
    return {"kind": "shared", "props": props}


def failures(page: Any) -> str:
    """What error boundaries have caught; React and the browser repeat it."""
    page.errors.clear()
    return "\n".join(page.evaluate("page.failures.splice(0)"))


@cache
def painted() -> Picture:
    """The drawing with elements, on white."""
    colors = vexture.render(vexture.read_svg(FIXTURES / "elements.svg"), (SIZE, SIZE), renderer="exact").astype(float)
    return colors[..., :3] + 1.0 - colors[..., 3:]


def over_white(coverage: Picture, color: int = 0) -> Picture:
    """Flat colour on white: blending happens in sRGB."""
    return 1.0 - coverage * (1.0 - np.array([color >> 16, color >> 8 & 255, color & 255]) / 255.0)


def test_colours_are_those_of_the_drawing(page: Any, screenshot: Callable[..., Path]) -> None:
    assert page.evaluate("page.toneMapping()"), "the canvas maps tones, as it does by default"
    picture = draw(page, shared(**PAINTED))
    screenshot(page.locator("canvas"))
    assert distance(picture, painted()) <= HALF_STEP
    assert distance(draw(page, shared(**PAINTED, toneMapped=True)), painted()) > 10.0


def test_every_prop_is_live(page: Any) -> None:
    """One element with other props each time; what is gone is the default again."""
    duck = exact("duck", SIZE)
    twice = {"transform": [2, 0, 0, 0, 2, 0, 0, 0, 1], "wrap": "repeat"}
    star: dict[str, Any] = {"texture": "drawings.ktx2", "root": "badge/1-#1d4ed8"}
    steps: list[tuple[dict[str, Any], Picture]] = [
        ({"color": "#c03020"}, over_white(duck, 0xC03020)),
        ({"color": "#c03020", "invert": True}, over_white(1.0 - duck, 0xC03020)),
        ({"color": "black", "mode": "cut", "threshold": 1}, over_white(np.float64(duck > 0.9999))),
        ({"color": "black", "opacity": 0.5, "flat": True}, over_white(0.5 * duck)),
        ({"color": "black", "opacity": 1, **twice}, over_white(np.tile(exact("duck", SIZE // 2), (2, 2, 1)))),
        (PAINTED, painted()),
        ({"color": "black", "invert": True, **star}, over_white(1 - disc())),
        ({"color": "black", "background": "own", "fold": "swing.fold.ktx2", "time": 1}, over_white(moved())),
        ({"color": "#c03020"}, over_white(duck, 0xC03020)),
    ]
    for props, expected in steps:
        picture = draw(page, {"kind": "shared", "name": "one", "props": {"texture": "duck.ktx2", **props}})
        assert distance(picture, expected) <= HALF_STEP, props


def test_a_change_of_an_option_alone_asks_for_a_frame(page: Any) -> None:
    duck = exact("duck", SIZE)
    black = draw(page, {**shared(texture="duck.ktx2", color="black"), "name": "alone"})
    assert distance(black, over_white(duck)) <= HALF_STEP
    inverted = decode(page.evaluate("page.alter({ invert: true })"))
    assert distance(inverted, over_white(1.0 - duck)) <= HALF_STEP
    draw(page, {**shared(**PAINTED), "name": "other"})
    red = decode(page.evaluate("page.alter({ colors: { sky: '#ff0000' } })"))
    np.testing.assert_array_equal(red[4, 4], [1, 0, 0])


def disc() -> Picture:
    """The first layer of the drawing with a star."""
    badge = vexture.read_svg(FIXTURES / "badge.svg")
    first = replace(badge, paths=badge.paths[:1])
    return vexture.coverage(first, (SIZE, SIZE), renderer="exact").astype(float)[..., None]


def moved() -> Picture:
    """A duck a quarter to the left, as the fold has it after a second."""
    return exact("duck", SIZE, np.array([[1 / SIZE, 0, 0.25], [0, -1 / SIZE, 1]]))


def test_elements_have_colours_of_their_own_and_others_keep_theirs(page: Any, screenshot: Callable[..., Path]) -> None:
    def halves(one: dict[str, Any], other: dict[str, Any]) -> list[Picture]:
        items = [
            {"kind": "shared", "name": str(x), "x": x, "width": 1, "props": {**PAINTED, **props}}
            for x, props in ((-0.5, one), (0.5, other))
        ]
        picture = draw(page, *items)
        return [picture[:, : SIZE // 2], picture[:, SIZE // 2 :]]

    plain, _ = halves({}, {})
    red, blue = halves({"colors": {"sky": "#ff0000"}}, {"colors": {"sky": "#0000ff", "sail": "#000"}})
    screenshot(page.locator("canvas"))
    np.testing.assert_array_equal([red[10, 4], blue[10, 4], blue[140, 80]], [[1, 0, 0], [0, 0, 1], [0, 0, 0]])
    assert np.all(red[140, 80] == 1.0)
    other, back = halves({"colors": {"sea": "#00ff00"}}, {"colors": {}})
    np.testing.assert_array_equal([other[10, 4], other[250, 120]], [plain[10, 4], [0, 1, 0]])
    assert distance(back, plain) == 0.0
    assert distance(halves({}, {"colors": None})[0], plain) == 0.0
    page.evaluate("items => page.draw(items)", [shared(**PAINTED, colors={"skye": "red"})])
    assert 'VextureError: elements has no element "skye"; near names are "sky", ' in failures(page)


def test_what_loads_suspends_and_what_is_missing_is_said(page: Any) -> None:
    draw(page, shared(texture="duck.ktx2"))
    page.evaluate("page.clear('duck.ktx2')")
    before = page.evaluate("page.fallbacks()")
    for waits, source in ((True, "duck.ktx2"), (True, "duck.ktx2?2"), (False, "duck.ktx2")):
        picture = draw(page, {"kind": "loading", "name": "l", "props": {"src": source, "color": "black"}})
        assert distance(picture, over_white(exact("duck", SIZE))) <= HALF_STEP
        after = page.evaluate("page.fallbacks()")
        assert (after > before) == waits
        before = after
    page.evaluate("items => page.draw(items)", [{"kind": "loading", "name": "none", "props": {"src": "none.ktx2"}}])
    page.evaluate("page.patiently(() => page.failures.length)")
    failure = failures(page)
    assert "Could not load none.ktx2" in failure
    assert "404" in failure


@pytest.mark.parametrize("place", [False, True], ids=["in a material", "in a mesh"])
def test_a_mask_comes_changes_and_goes(page: Any, *, place: bool) -> None:
    def masked(**props: Any) -> Picture:
        return draw(page, {"kind": "masked", "name": "m", "inMesh": place, "props": {"color": "black", **props}})

    duck = over_white(exact("duck", SIZE))
    assert distance(masked(src="duck.ktx2"), duck) <= HALF_STEP
    assert page.evaluate("page.held()")["cut"] == [[True, True]]
    assert distance(masked(src="duck.ktx2", invert=True), 1.0 - duck) <= HALF_STEP
    if place:
        return
    assert distance(masked(src="duck.ktx2", invert=True, fresh=1), 1.0 - duck) <= HALF_STEP
    assert page.evaluate("page.held()")["cut"] == [[True, True]]
    assert distance(masked(src="duck.ktx2", fresh=1), duck) <= HALF_STEP
    assert page.evaluate("page.held()")["cut"] == [[True, True]]
    assert np.all(masked(fresh=1) == 0.0)
    held = page.evaluate("page.held()")
    assert (held["masks"], held["cut"]) == ([False], [[False, False]])


def test_what_is_unmounted_frees_what_it_had(address: str, open_page: Callable[..., Any]) -> None:
    page = open_page(f"{address}/index.html", (SIZE, SIZE))
    page.evaluate("page.ready()")
    draw(page, shared(**PAINTED))
    before = page.evaluate("page.held()")["textures"]
    draw(page, shared(**PAINTED), shared(**PAINTED, colors={"sky": "#ff0000"}))
    page.evaluate("page.wait(0)")
    page.evaluate("page.settled()")  # in strict mode effects end and begin again after the first frame
    held = page.evaluate("page.held()")
    assert (held["textures"], held["masks"], held["cut"]) == (before + 1, [True, True], [[True, True]] * 2)
    draw(page, shared(**PAINTED))
    page.evaluate("before => page.patiently(() => page.held().textures === before)", before)
    draw(page)
    page.evaluate("page.patiently(() => page.held().programs === 0)")
    assert page.evaluate("page.held()")["masks"] == []


def test_a_ray_meets_the_shape_and_its_elements_only(page: Any) -> None:
    draw(page, shared(texture="duck.ktx2"))
    covered = exact("duck", SIZE)[..., 0]
    for row, column in (np.argwhere(covered == 1.0)[2000], np.argwhere(covered == 0.0)[2000]):
        page.mouse.click(column + 0.5, row + 0.5)
    assert len(page.evaluate("page.clicks.splice(0)")) == 1
    draw(page, shared(**PAINTED))
    for x, y in ((240, 8), (104, 104)):
        page.mouse.click(x, y)
    assert page.evaluate("page.clicks.splice(0)") == ["sky", "hill"]


def test_a_fold_moves_with_the_clock(page: Any) -> None:
    item = shared(texture="duck.ktx2", color="black", fold="swing.fold.ktx2")
    still = draw(page, item)
    later = []
    for _ in range(2):  # quarters of its period: in one of them it may stand where it stood
        page.evaluate("page.wait(1)")
        later.append(decode(page.evaluate("page.settled()")))
    assert max(distance(picture, still) for picture in later) > 5.0
