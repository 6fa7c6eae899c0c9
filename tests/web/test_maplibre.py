"""The layer for MapLibre: its pixels, what it loads and keeps, colours, picking."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import map_truth
import numpy as np
import pytest
import tile_pyramid
from maplibre_page import CENTRE, MAGENTA, MARKED, MIDDLE, SIZE, pixels
from numpy.typing import NDArray

from vexture.renderers.exact import render_exact_colours

EXACT = 0.3
"""Most that edges may be off on average, in steps of a byte."""


@pytest.fixture(scope="module")
def slow_address(map_folder: Path) -> Iterator[str]:
    chance = np.random.default_rng(20)
    with tile_pyramid.serve_tiles(map_folder, iter(lambda: float(chance.uniform(0.0, 0.2)), None)) as url:
        yield url


def _exact(zoom: float, colours: Any = tile_pyramid.colour) -> NDArray[np.float64]:
    """The exact picture of a view from above, on white."""
    side = SIZE[0] / (512 * 2**zoom)
    seen = tile_pyramid.drawing((CENTRE[0] - side / 2, CENTRE[1] - side / 2), side, colours)
    picture = render_exact_colours(seen, size=SIZE[0])
    return np.asarray(picture[..., :3] + 1 - picture[..., 3:])


@pytest.mark.parametrize("zoom", [1.0, 3.0, 5.3, 7.0])
def test_a_flat_map_is_the_exact_one(zoom: float, opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": zoom})
    truth = _exact(zoom)
    assert map_truth.edges(pixels(page), truth) < EXACT
    assert {one["tile"]["z"] for one in page.evaluate("tiles.stats.shown")} == {1 if zoom < 2 else 3}


@pytest.mark.parametrize("projection", ["mercator", "globe"])
def test_the_oldest_maplibre_shows_what_the_newest_does(projection: str, opened_map: Callable[..., Any]) -> None:
    pictures = []
    for name in ("page", "floor"):
        page = opened_map({"zoom": 2.7, "projection": projection}, name=name)
        pictures.append(pixels(page))
    assert page.evaluate("maplibregl.getVersion()").startswith("5.7.")
    assert np.abs(pictures[0] - pictures[1]).mean() < EXACT / 255
    assert len(np.unique(pictures[1].reshape(-1, 3), axis=0)) > len(tile_pyramid.COLOURS)


@pytest.mark.parametrize(
    ("zoom", "view"),
    [
        (4.4, {"pitch": 60, "bearing": 30}),
        (2.7, {"projection": "globe"}),
        (3.0, {"projection": "globe"}),
        (5.3, {"projection": "globe"}),
        (7.0, {"projection": "globe", "pitch": 50, "bearing": 20}),
    ],
)
def test_a_tilted_map_and_a_globe_have_exact_edges(
    zoom: float, view: dict[str, Any], opened_map: Callable[..., Any]
) -> None:
    page = opened_map({"zoom": zoom, **view})

    def asked(script: str) -> Callable[[Any], Any]:
        return lambda places: page.evaluate(f"some => some.map((one) => {{ {script} }})", places)

    project = asked("const { x, y } = map.project(one); return [x, y];")
    unproject = asked("const { lng, lat } = map.unproject(one); return [lng, lat];")
    truth = map_truth.draw_exactly(SIZE[0], project, unproject, is_curved="projection" in view)
    assert map_truth.edges(pixels(page), truth) < EXACT


@pytest.mark.parametrize(("lat", "zoom"), [(90, 2), (-90, 3), (85.05, 8)])
def test_the_caps_of_the_poles_have_no_rim(lat: float, zoom: float, opened_map: Callable[..., Any]) -> None:
    view = {"zoom": zoom, "center": [20, lat], "projection": "globe"}
    page = opened_map(view, {"source": "land/tiles.json"})
    assert 255 * np.abs(pixels(page) - tile_pyramid.COLOURS[0]).max() < tile_pyramid.RIM


@pytest.mark.parametrize(("lat", "zoom"), [(80, 0.5), (-80, 0)])
def test_a_cap_is_as_the_end_of_the_grid(lat: float, zoom: float, opened_map: Callable[..., Any]) -> None:
    view = {"zoom": zoom, "center": [150, lat], "projection": "globe"}
    page = opened_map(view, {"source": "band/tiles.json"})
    picture = pixels(page)
    latitudes = (83.0, 84.0, *np.arange(86, 90, 0.25).tolist())
    places = [(150 + turn, at if lat > 0 else -at) for turn in (-40, 0, 40) for at in latitudes]
    asked = "some => some.map((at) => { const { x, y } = map.project(at); return [x, y, !!tiles.featureAt(at)]; })"
    for (_, at), (x, y, is_found) in zip(places, page.evaluate(asked, places), strict=True):
        assert (picture[int(y), int(x)] < 1).any() == is_found == (abs(at) < 85), (at, x, y)


COLOURS = (
    "rgb(255 0 0 / 0.5)",
    "color(display-p3 1 0 0)",
    "color(srgb 1 0 0 / 0.5)",
    "oklch(0.7 0.1 200)",
    "oklch(0.7 0.1 200 / 0.9)",
    "lab(50 20 20 / 0.5)",
    "color-mix(in srgb, red, blue)",
)


def test_colours_of_any_space_are_as_the_browser_has_them(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    for colour in COLOURS:
        page.evaluate("colour => tiles.setPaint(() => colour)", colour)
        said = page.evaluate(
            """colour => { document.body.style.color = `color-mix(in srgb, ${colour}, ${colour})`;
            return getComputedStyle(document.body).color.match(/[-\\d.]+(e-?\\d+)?/g).map(Number) }""",
            colour,
        )
        red, green, blue, opacity = [*said, 1.0][:4]
        seen = np.clip((red, green, blue), 0, 1) * opacity + 1 - opacity
        assert pixels(page)[128, 128] == pytest.approx(seen, abs=1.5 / 255), colour


@pytest.mark.parametrize("count", [2_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_features_are_found_coloured_and_hidden_without_loading(count: int, opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    places, names = tile_pyramid.named_points(count)
    given = np.transpose(tile_pyramid.lng_lat(*places.T)).tolist()
    found = page.evaluate("some => some.map((one) => tiles.featureAt(one)?.id ?? null)", given)
    assert found == names
    page.mouse.move(128, 128)
    page.mouse.click(128, 128)
    name = tile_pyramid.name_at(*MIDDLE)
    assert page.evaluate("events") == [["hover", name], ["click", name]]
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    sent = page.evaluate("tiles.stats.rowsSent")

    def middle(script: str) -> list[float]:
        page.evaluate(f"name => {{ {script} }}", name)
        return pixels(page)[128, 128].tolist()

    assert middle("tiles.setPaint({ [name]: 'rgb(0, 255, 255)' })") == [0, 1, 1]
    assert middle("tiles.setPaint((id) => id === name ? '#f0f' : undefined)") == [0, 1, 1]  # a table comes first
    assert middle("tiles.setPaint(null); tiles.setFilter((id) => id !== name)") == [1, 1, 1]
    assert middle("tiles.setFilter([name, `none`])") != [1, 1, 1]
    assert middle("tiles.setFilter([`none`])") == [1, 1, 1]
    assert page.evaluate("tiles.featureAt(map.getCenter())") is None
    times = "{ ids: [name], colors: [['#000000'], ['#ff0000']] }"
    assert middle(f"tiles.setFilter(null); tiles.setTimes({times}); tiles.setTime(1)") == [1, 0, 0]
    assert middle("tiles.setTime(0.5)")[0] == pytest.approx(0.5, abs=0.01)
    assert asked == []
    texels = page.evaluate("tiles.stats.bytes") / (2048 * 16)
    assert page.evaluate("tiles.stats.rowsSent") - sent <= 6 * 4 * (texels + 16)


@pytest.mark.parametrize("projection", ["mercator", "globe"])
def test_no_frame_is_blank_once_the_parent_is_there(projection: str, opened_map: Any, slow_address: str) -> None:
    style = {**MAGENTA, "projection": {"type": projection}}
    view = {"zoom": 2.5, "style": style, "center": tile_pyramid.lng_lat(0.8, 0.42)}
    page = opened_map(view, {"source": "tiles.json"}, url=slow_address)
    path = [
        [*tile_pyramid.lng_lat(0.8 + 0.06 * np.sin(0.4 * k), 0.42 + 0.03 * np.cos(0.3 * k)), 4 - 1.5 * np.cos(0.5 * k)]
        for k in range(24)
    ]
    blank, waited, last = page.evaluate(
        """async (places) => {
            let [blank, waited] = [0, 0];
            for (const [lng, lat, zoom] of places) {
                map.jumpTo({ center: [lng, lat], zoom });
                blank += await count(255, 0, 255);
                waited += tiles.stats.running > 0;
            }
            await settled();
            return [blank, waited, tiles.stats.shown.map(({ tile }) => tile.z)];
        }""",
        path,
    )
    assert blank == 0
    assert waited > 5, "tiles have come at once"
    assert set(last) == {3 if path[-1][2] >= 3 - 0.25 else 1}, "a stale tile"


def test_the_layer_comes_back_below_its_labels(opened_map: Callable[..., Any]) -> None:
    style = {**MARKED, "projection": {"type": "globe"}}
    page = opened_map({"zoom": 4, "style": style, "center": tile_pyramid.lng_lat(*MIDDLE)}, {"before": "mark"})
    name = tile_pyramid.name_at(*MIDDLE)
    page.evaluate("async (name) => { tiles.setPaint({ [name]: '#00ffff' }); await frame(); }", name)
    first = pixels(page)
    assert np.allclose(first[128, 128], 0)
    assert np.allclose(first[128, 128 + 30], (0, 1, 1))
    page.evaluate("() => { map.removeLayer('tiles'); }")
    assert page.evaluate("count(255, 0, 255)") > 0.9 * first.shape[0] * first.shape[1]
    page.evaluate("async () => { map.addLayer(tiles, 'mark'); await tiles.ready(); await settled(); }")
    assert np.array_equal(pixels(page), first)
    page.evaluate(
        """async () => {
            const lost = map.getCanvas().getContext('webgl2').getExtension('WEBGL_lose_context');
            const back = new Promise((resolve) => map.once('webglcontextrestored', resolve));
            lost.loseContext();
            await new Promise((resolve) => setTimeout(resolve, 50));
            lost.restoreContext();
            await back;
        }"""
    )
    page.evaluate(
        """async () => {
            for (let k = 0; k < 200 && !(map.getLayer('tiles') && (await count(0, 0, 0)) > 900); k++) {
                await new Promise((resolve) => setTimeout(resolve, 20));
            }
            await settled();
        }"""
    )
    assert page.evaluate("map.getLayersOrder()") == ["ground", "tiles", "mark"]
    assert np.array_equal(pixels(page), first)


def test_what_is_not_wanted_is_aborted_and_all_is_freed(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 5}, {"budget": 1, "source": "tiles.json"})
    assert {one["tile"]["z"] for one in page.evaluate("tiles.stats.shown")} == {3}
    page.evaluate("async (place) => { map.jumpTo({ center: place, zoom: 0 }); await settled(); }", [0, 0])
    assert page.evaluate("[tiles.stats.tiles, tiles.stats.held]") == [1, 1]
    page.route("**/3/**", lambda route: None)
    page.evaluate("async (place) => { map.jumpTo({ center: place, zoom: 5 }); }", tile_pyramid.lng_lat(*CENTRE))
    page.wait_for_function("frame().then(() => tiles.stats.tiles >= 2 && tiles.stats.running > 0)")
    assert {one["tile"]["z"] for one in page.evaluate("tiles.stats.shown")} <= {0, 1}
    page.evaluate("async () => { map.jumpTo({ zoom: 0 }); await frame(); }")
    assert page.evaluate("tiles.stats.running") == 0
    page.evaluate("map.removeLayer('tiles')")
    assert page.evaluate("[tiles.stats.tiles, tiles.stats.held]") == [0, 0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("label", "view", "size"),
    [
        ("tilted", {"zoom": 4, "pitch": 60, "bearing": 30}, (512, 384)),
        ("globe", {"zoom": 1, "projection": "globe"}, (512, 512)),
        ("phone", {"zoom": 2}, (390, 844)),
        ("deep", {"zoom": 13}, (512, 384)),
        ("pole", {"zoom": 1, "projection": "globe", "center": (0, 85)}, (512, 512)),
        ("antimeridian", {"zoom": 1, "center": (180, 20)}, (512, 512)),
    ],
)
def test_views_have_no_errors(
    label: str, view: dict[str, Any], size: Any, opened_map: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = opened_map(view, size=size)
    screenshot(page, label)
    assert page.evaluate("events.filter(([type]) => type === 'error')") == []
