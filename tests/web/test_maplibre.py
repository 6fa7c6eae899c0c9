"""The layer for MapLibre: its pixels, what it loads and keeps, colours, picking."""

import base64
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import map_truth
import numpy as np
import pytest
import tile_pyramid
from browser import WEB, bundle
from numpy.typing import NDArray

from vexture.renderers.exact import render_exact_colours

PAGE = Path(__file__).parent / "pages" / "maplibre.js"
SIZE = (256, 256)
CENTRE = tile_pyramid.meeting()
"""Of most views, in Web Mercator of 0..1."""

MIDDLE = (CENTRE[0] + 0.01, CENTRE[1] + 0.02)
"""A place in a cell."""

EXACT = 0.3
"""Most that edges may be off on average, in steps of a byte."""

HTML = """<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="maplibre-gl.css">
<style>html, body, #map { margin: 0; width: 100%; height: 100% }</style><div id="map"></div>
<script type="module">import * as maplibregl from './maplibre-gl.mjs'; import './page.js';
window.start = (...given) => open_(maplibregl, ...given); window.loaded = true;</script>"""

FLOOR = """<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="floor/maplibre-gl.css">
<style>html, body, #map { margin: 0; width: 100%; height: 100% }</style><div id="map"></div>
<script src="floor/maplibre-gl.js"></script><script type="module">import './page.js';
window.start = (...given) => open_(maplibregl, ...given); window.loaded = true;</script>"""
"""The oldest MapLibre that the package promises to work with."""

MAGENTA = {"version": 8, "sources": {}, "layers": [
    {"id": "ground", "type": "background", "paint": {"background-color": "#ff00ff"}},
]}  # fmt: skip
"""A style whose ground shows in no cell's colour."""

MARKED = {
    "version": 8,
    "sources": {"middle": {"type": "geojson", "data": {"type": "Point", "coordinates": tile_pyramid.lng_lat(*MIDDLE)}}},
    "layers": [
        *MAGENTA["layers"],
        {"id": "mark", "type": "circle", "source": "middle", "paint": {"circle-radius": 20, "circle-color": "#000000"}},
    ],
}


@pytest.fixture(scope="module")
def folder(tile_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    library = WEB / "node_modules" / "maplibre-gl" / "dist"
    if not library.is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    folder = tmp_path_factory.mktemp("maplibre")
    for name in ("tiles.json", "map.pmtiles", *map(str, tile_pyramid.ZOOMS)):
        (folder / name).symlink_to(tile_folder / name)
    tile_pyramid.write_land(folder / "land")
    tile_pyramid.write_land(folder / "band", 85.0)
    bundle(PAGE, folder / "page.js")
    for file in library.iterdir():
        (folder / file.name).symlink_to(file)
    (folder / "floor").symlink_to(WEB / "node_modules" / "maplibre-gl-floor" / "dist")
    (folder / "page.html").write_text(HTML, encoding="utf-8")
    (folder / "floor.html").write_text(FLOOR, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    with tile_pyramid.served(folder) as url:
        yield url


@pytest.fixture(scope="module")
def slow_address(folder: Path) -> Iterator[str]:
    chance = np.random.default_rng(20)
    with tile_pyramid.served(folder, iter(lambda: float(chance.uniform(0.0, 0.2)), None)) as url:
        yield url


@pytest.fixture
def opened(address: str, open_page: Callable[..., Any]) -> Callable[..., Any]:
    def opener(
        view: dict[str, Any],
        layer: dict[str, Any] | None = None,
        size: Any = SIZE,
        url: str = address,
        name: str = "page",
        **options: Any,
    ) -> Any:
        page = open_page(f"{url}/{name}.html", size, **options)
        page.wait_for_function("window.loaded")
        view = {"center": tile_pyramid.lng_lat(*CENTRE), **view}
        page.evaluate("async ([view, layer]) => { await start(view, layer) }", [view, layer or {}])
        return page

    return opener


def _pixels(page: Any) -> NDArray[np.float64]:
    shot = page.evaluate("pixels()")
    data = np.frombuffer(base64.b64decode(shot["data"]), np.uint8).reshape(shot["height"], shot["width"], 4)
    return data[::-1, :, :3] / 255.0


def _exact(zoom: float, colours: Any = tile_pyramid.colour) -> NDArray[np.float64]:
    """The exact picture of a view from above, on white."""
    side = SIZE[0] / (512 * 2**zoom)
    seen = tile_pyramid.drawing((CENTRE[0] - side / 2, CENTRE[1] - side / 2), side, colours)
    picture = render_exact_colours(seen, size=SIZE[0])
    return np.asarray(picture[..., :3] + 1 - picture[..., 3:])


@pytest.mark.parametrize("zoom", [1.0, 3.0, 5.3, 7.0])
def test_a_flat_map_is_the_exact_one(zoom: float, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": zoom})
    truth = _exact(zoom)
    assert map_truth.edges(_pixels(page), truth) < EXACT
    assert {one["tile"]["z"] for one in page.evaluate("tiles.stats.shown")} == {1 if zoom < 2 else 3}


@pytest.mark.parametrize("projection", ["mercator", "globe"])
def test_the_oldest_maplibre_shows_what_the_newest_does(projection: str, opened: Callable[..., Any]) -> None:
    pictures = []
    for name in ("page", "floor"):
        page = opened({"zoom": 2.7, "projection": projection}, name=name)
        pictures.append(_pixels(page))
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
    zoom: float, view: dict[str, Any], opened: Callable[..., Any]
) -> None:
    page = opened({"zoom": zoom, **view})

    def asked(script: str) -> Callable[[Any], Any]:
        return lambda places: page.evaluate(f"some => some.map((one) => {{ {script} }})", places)

    project = asked("const { x, y } = map.project(one); return [x, y];")
    unproject = asked("const { lng, lat } = map.unproject(one); return [lng, lat];")
    truth = map_truth.seen(SIZE[0], project, unproject, is_curved="projection" in view)
    assert map_truth.edges(_pixels(page), truth) < EXACT


@pytest.mark.parametrize(("lat", "zoom"), [(90, 2), (-90, 3), (85.05, 8)])
def test_the_caps_of_the_poles_have_no_rim(lat: float, zoom: float, opened: Callable[..., Any]) -> None:
    view = {"zoom": zoom, "center": [20, lat], "projection": "globe"}
    page = opened(view, {"source": "land/tiles.json"})
    assert 255 * np.abs(_pixels(page) - tile_pyramid.COLOURS[0]).max() < 3


@pytest.mark.parametrize(("lat", "zoom"), [(80, 0.5), (-80, 0)])
def test_a_cap_is_as_the_end_of_the_grid(lat: float, zoom: float, opened: Callable[..., Any]) -> None:
    view = {"zoom": zoom, "center": [150, lat], "projection": "globe"}
    page = opened(view, {"source": "band/tiles.json"})
    picture = _pixels(page)
    latitudes = (83.0, 84.0, *np.arange(86, 90, 0.25).tolist())
    places = [(150 + turn, at if lat > 0 else -at) for turn in (-40, 0, 40) for at in latitudes]
    asked = "some => some.map((at) => { const { x, y } = map.project(at); return [x, y, !!tiles.featureAt(at)]; })"
    for (_, at), (x, y, is_found) in zip(places, page.evaluate(asked, places), strict=True):
        assert (picture[int(y), int(x)] < 1).any() == is_found == (abs(at) < 85), (at, x, y)


@pytest.mark.parametrize(
    "colour",
    [
        "rgb(255 0 0 / 0.5)",
        "color(display-p3 1 0 0)",
        "color(srgb 1 0 0 / 0.5)",
        "oklch(0.7 0.1 200)",
        "oklch(0.7 0.1 200 / 0.9)",
        "lab(50 20 20 / 0.5)",
        "color-mix(in srgb, red, blue)",
    ],
)
def test_colours_of_any_space_are_as_the_browser_has_them(colour: str, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    page.evaluate("colour => tiles.setPaint(() => colour)", colour)
    said = page.evaluate(
        """colour => { document.body.style.color = `color-mix(in srgb, ${colour}, ${colour})`;
        return getComputedStyle(document.body).color.match(/[-\\d.]+(e-?\\d+)?/g).map(Number) }""",
        colour,
    )
    red, green, blue, opacity = [*said, 1.0][:4]
    seen = np.clip((red, green, blue), 0, 1) * opacity + 1 - opacity
    assert _pixels(page)[128, 128] == pytest.approx(seen, abs=1.5 / 255)


@pytest.mark.parametrize("count", [2_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_features_are_found_coloured_and_hidden_without_loading(count: int, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
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
        return _pixels(page)[128, 128].tolist()

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
def test_no_frame_is_blank_once_the_parent_is_there(projection: str, opened: Any, slow_address: str) -> None:
    style = {**MAGENTA, "projection": {"type": projection}}
    view = {"zoom": 2.5, "style": style, "center": tile_pyramid.lng_lat(0.8, 0.42)}
    page = opened(view, {"source": "tiles.json"}, url=slow_address)
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


def test_the_layer_comes_back_below_its_labels(opened: Callable[..., Any]) -> None:
    style = {**MARKED, "projection": {"type": "globe"}}
    page = opened({"zoom": 4, "style": style, "center": tile_pyramid.lng_lat(*MIDDLE)}, {"before": "mark"})
    name = tile_pyramid.name_at(*MIDDLE)
    page.evaluate("async (name) => { tiles.setPaint({ [name]: '#00ffff' }); await frame(); }", name)
    first = _pixels(page)
    assert np.allclose(first[128, 128], 0)
    assert np.allclose(first[128, 128 + 30], (0, 1, 1))
    page.evaluate("() => { map.removeLayer('tiles'); }")
    assert page.evaluate("count(255, 0, 255)") > 0.9 * first.shape[0] * first.shape[1]
    page.evaluate("async () => { map.addLayer(tiles, 'mark'); await tiles.ready(); await settled(); }")
    assert np.array_equal(_pixels(page), first)
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
    assert np.array_equal(_pixels(page), first)


def test_what_is_not_wanted_is_aborted_and_all_is_freed(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 5}, {"budget": 1, "source": "tiles.json"})
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
    label: str, view: dict[str, Any], size: Any, opened: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = opened(view, size=size)
    screenshot(page, label)
    assert page.evaluate("events.filter(([type]) => type === 'error')") == []


def _restyled(page: Any, style: dict[str, Any], diff: bool) -> list[str]:
    """The order of the layers after another style."""
    page.evaluate(
        """async ([style, diff]) => {
            const there = new Promise((resolve) => map.once('style.load', resolve));
            map.setStyle(style, { diff });
            await there;
            await settled();
        }""",
        [style, diff],
    )
    order: list[str] = page.evaluate("map.getLayersOrder()")
    return order


def _style(*names: str) -> dict[str, Any]:
    """Grounds of magenta, and marks in the middle."""
    ground, mark = MARKED["layers"]
    layers = [{**(mark if name.startswith("mark") else ground), "id": name} for name in names]
    return {**MARKED, "layers": layers}


@pytest.mark.parametrize("diff", [True, False])
def test_another_style_leaves_the_layer_where_it_was(diff: bool, opened: Callable[..., Any]) -> None:
    page = opened(
        {"zoom": 4, "style": _style("ground", "mark"), "center": tile_pyramid.lng_lat(*MIDDLE)}, {"before": "mark"}
    )
    name = tile_pyramid.name_at(*MIDDLE)
    page.evaluate("async (name) => { tiles.setPaint({ [name]: '#00ffff' }); await frame(); }", name)
    first = _pixels(page)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    assert _restyled(page, _style("sea", "land", "mark"), diff) == ["sea", "land", "tiles", "mark"]
    assert np.array_equal(_pixels(page), first)
    assert [url for url in asked if "map.pmtiles" in url] == []
    page.evaluate("map.addLayer({ id: 'other', type: 'background', paint: { 'background-opacity': 0 } })")
    page.mouse.move(100, 100)
    page.mouse.move(110, 100)
    assert len(page.evaluate("events.filter(([type]) => type === 'hover')")) == 1
    # nothing of what was above is there, and then nothing at all
    assert _restyled(page, _style("sea", "land", "more", "top"), diff) == ["sea", "land", "tiles", "more", "top"]
    assert _restyled(page, _style("new", "mark 3"), diff) == ["new", "mark 3", "tiles"]
    page.evaluate("map.removeLayer('tiles')")
    assert _restyled(page, _style("sea", "mark"), diff) == ["sea", "mark"]
    assert page.evaluate("[tiles.stats.tiles, tiles.stats.held]") == [0, 0]


@pytest.mark.parametrize("diff", [True, False])
def test_layers_keep_their_order_in_another_style(diff: bool, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "style": _style("ground")})
    for name, before in (("below", "tiles"), ("over", None)):  # all three hear of a style in the order of their coming
        page.evaluate("id => { window.more = new tiles.constructor({ id, source: 'map.pmtiles' }); }", name)
        page.evaluate("before => { map.addLayer(more, before ?? undefined); }", before)
    page.evaluate("settled()")
    assert _restyled(page, _style("sea", "land"), diff) == ["sea", "land", "below", "tiles", "over"]


def test_a_page_that_adds_the_layer_to_each_style_itself_may(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "style": _style("ground", "mark")}, {"before": "mark"})
    page.evaluate("""() => { map.removeLayer('tiles');
        map.on('style.load', () => map.getLayer('tiles') || map.addLayer(tiles, 'land'));
        map.addLayer(tiles, 'mark'); }""")
    page.evaluate("settled()")
    assert _restyled(page, _style("sea", "land", "mark"), False) == ["sea", "tiles", "land", "mark"]
    page.evaluate("tiles.ready().then(settled)")
    assert page.evaluate("tiles.stats.shown.length") > 0


def test_a_layer_is_for_one_map(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2})
    first = _pixels(page)
    said, names = page.evaluate(
        """async (style) => {
            const container = document.body.appendChild(document.createElement('div'));
            container.style = 'position: fixed; inset: 0 128px 128px 0; opacity: 0';
            window.other = new maplibregl.Map({ container, style, zoom: 1 });
            await new Promise((resolve) => other.once('load', resolve));
            let said = '';
            try { other.addLayer(tiles); } catch (error) { said = String(error); }
            return [said, other.getLayersOrder()];
        }""",
        MAGENTA,
    )
    assert said == 'VextureError: the layer "tiles" is on another map; make another VectorTileLayer for this one'
    assert names == ["ground"]
    assert np.array_equal(_pixels(page), first)
    # until the map is gone
    page.evaluate(
        "() => { map.remove(); other.addLayer(tiles); window.map = other; return tiles.ready().then(settled); }"
    )
    assert page.evaluate("tiles.stats.shown.length") > 0


def test_a_function_that_throws_stops_no_frame(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    first = _pixels(page)
    name, failed = tile_pyramid.name_at(*MIDDLE), []
    page.on("pageerror", lambda error: failed.append(str(error)))
    page.evaluate("name => tiles.setPaint((id) => { if (id === name) throw new Error('no'); return '#0ff' })", name)
    for _ in range(3):
        picture = _pixels(page)
    assert np.array_equal(picture[128, 128], first[128, 128])
    assert (picture == (0, 1, 1)).all(axis=-1).mean() > 0.05
    assert page.evaluate("tiles.featureAt(map.getCenter())") == {"id": name}
    said = f'the paint function throws for "{name}" (no); mend it; such features are drawn without it'
    assert page.evaluate("events") == [["error", f"VextureError: {said}"]]
    assert failed == []


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("{ source: 'map.pmtiles' }", "the layer's id is undefined; give a text"),
        ("{ id: 'a', most: 0, source: 'map.pmtiles' }", "most is 0; give a number of 1 or more"),
        ("{ id: 'a', opacity: '0.5', source: 'map.pmtiles' }", 'the opacity is "0.5"; give 0 to 1'),
        ("{ id: 'a', opacity: null, source: 'map.pmtiles' }", "the opacity is null; give 0 to 1"),
        ("{ id: 'a' }", "the source is undefined; give the address of a .pmtiles or a TileJSON, or "),
    ],
)
def test_options_that_cannot_be_are_refused(options: str, message: str, opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2})
    said = page.evaluate(
        f"() => {{ try {{ new tiles.constructor({options}) }} catch (error) {{ return `${{error}}` }} }}"
    )
    assert said.startswith(f"VextureError: {message}")
    asked = page.evaluate("() => { try { tiles.on('hovered', () => {}) } catch (error) { return error.message } }")
    assert asked == 'the event is "hovered"; give one of hover, click, error'
    asked = page.evaluate("() => { try { tiles.on('click', 5) } catch (error) { return error.message } }")
    assert asked == "the listener is 5; give a function"


def test_a_hidden_layer_is_not_picked(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    name = tile_pyramid.name_at(*MIDDLE)
    found = "tiles.featureAt(map.getCenter())?.id ?? null"
    page.mouse.move(128, 128)
    page.evaluate("map.setLayoutProperty('tiles', 'visibility', 'none'); settled()")
    page.mouse.move(129, 128)
    page.mouse.click(129, 128)
    assert page.evaluate("events") == [["hover", name], ["hover", ""], ["click", ""]]
    assert page.evaluate(found) is None
    page.evaluate("map.setLayoutProperty('tiles', 'visibility', 'visible')")
    assert page.evaluate(found) == name
    page.evaluate("map.setLayerZoomRange('tiles', 4, 9)")
    assert page.evaluate(found) is None


def test_a_listener_that_throws_does_not_silence_the_others(opened: Callable[..., Any]) -> None:
    page = opened({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)}, errors=True)
    page.evaluate(
        """() => { window.heard = 0;
        tiles.on('click', () => { throw new Error('mine') }).on('click', () => heard++);
        map.on('click', () => heard++); }"""
    )
    page.mouse.click(128, 128)
    assert page.evaluate("heard") == 2
    assert page.errors == ["mine"]
