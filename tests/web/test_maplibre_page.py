"""The layer for MapLibre in the page around it: other styles, other maps, listeners, wrong arguments."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import tile_pyramid
from maplibre_page import MAGENTA, MARKED, MIDDLE, pixels


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


@pytest.mark.slow
@pytest.mark.parametrize("diff", [True, False])
def test_another_style_leaves_the_layer_where_it_was(diff: bool, opened_map: Callable[..., Any]) -> None:
    page = opened_map(
        {"zoom": 4, "style": _style("ground", "mark"), "center": tile_pyramid.lng_lat(*MIDDLE)}, {"before": "mark"}
    )
    name = tile_pyramid.name_at(*MIDDLE)
    page.evaluate("async (name) => { tiles.setPaint({ [name]: '#00ffff' }); await frame(); }", name)
    first = pixels(page)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    assert _restyled(page, _style("sea", "land", "mark"), diff) == ["sea", "land", "tiles", "mark"]
    assert np.array_equal(pixels(page), first)
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


@pytest.mark.slow
@pytest.mark.parametrize("diff", [True, False])
def test_layers_keep_their_order_in_another_style(diff: bool, opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "style": _style("ground")})
    for name, before in (("below", "tiles"), ("over", None)):  # all three hear of a style in the order of their coming
        page.evaluate("id => { window.more = new tiles.constructor({ id, source: 'map.pmtiles' }); }", name)
        page.evaluate("before => { map.addLayer(more, before ?? undefined); }", before)
    page.evaluate("settled()")
    assert _restyled(page, _style("sea", "land"), diff) == ["sea", "land", "below", "tiles", "over"]


def test_a_page_that_adds_the_layer_to_each_style_itself_may(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "style": _style("ground", "mark")}, {"before": "mark"})
    page.evaluate("""() => { map.removeLayer('tiles');
        map.on('style.load', () => map.getLayer('tiles') || map.addLayer(tiles, 'land'));
        map.addLayer(tiles, 'mark'); }""")
    page.evaluate("settled()")
    assert _restyled(page, _style("sea", "land", "mark"), False) == ["sea", "tiles", "land", "mark"]
    page.evaluate("tiles.ready().then(settled)")
    assert page.evaluate("tiles.stats.shown.length") > 0


def test_a_layer_is_for_one_map(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2})
    first = pixels(page)
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
    assert np.array_equal(pixels(page), first)
    # until the map is gone
    page.evaluate(
        "() => { map.remove(); other.addLayer(tiles); window.map = other; return tiles.ready().then(settled); }"
    )
    assert page.evaluate("tiles.stats.shown.length") > 0


def test_a_function_that_throws_stops_no_frame(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
    first = pixels(page)
    name, failed = tile_pyramid.name_at(*MIDDLE), []
    page.on("pageerror", lambda error: failed.append(str(error)))
    page.evaluate("name => tiles.setPaint((id) => { if (id === name) throw new Error('no'); return '#0ff' })", name)
    for _ in range(3):
        picture = pixels(page)
    assert np.array_equal(picture[128, 128], first[128, 128])
    assert (picture == (0, 1, 1)).all(axis=-1).mean() > 0.05
    assert page.evaluate("tiles.featureAt(map.getCenter())") == {"id": name}
    said = f'the paint function throws for "{name}" (no); mend it; such features are drawn without it'
    assert page.evaluate("events") == [["error", f"VextureError: {said}"]]
    assert failed == []


REFUSED = {
    "{ source: 'map.pmtiles' }": "the layer's id is undefined; give a text",
    "{ id: 'a', most: 0, source: 'map.pmtiles' }": "most is 0; give a number of 1 or more",
    "{ id: 'a', opacity: '0.5', source: 'map.pmtiles' }": 'the opacity is "0.5"; give 0 to 1',
    "{ id: 'a', opacity: null, source: 'map.pmtiles' }": "the opacity is null; give 0 to 1",
    "{ id: 'a' }": "the source is undefined; give the address of a .pmtiles or a TileJSON, or ",
}


def test_options_that_cannot_be_are_refused(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2})
    for options, message in REFUSED.items():
        said = page.evaluate(
            f"() => {{ try {{ new tiles.constructor({options}) }} catch (error) {{ return `${{error}}` }} }}"
        )
        assert said.startswith(f"VextureError: {message}"), options
    asked = page.evaluate("() => { try { tiles.on('hovered', () => {}) } catch (error) { return error.message } }")
    assert asked == 'the event is "hovered"; give one of hover, click, error'
    asked = page.evaluate("() => { try { tiles.on('click', 5) } catch (error) { return error.message } }")
    assert asked == "the listener is 5; give a function"


def test_a_hidden_layer_is_not_picked(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)})
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


def test_a_listener_that_throws_does_not_silence_the_others(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 2, "center": tile_pyramid.lng_lat(*MIDDLE)}, errors=True)
    page.evaluate(
        """() => { window.heard = 0;
        tiles.on('click', () => { throw new Error('mine') }).on('click', () => heard++);
        map.on('click', () => heard++); }"""
    )
    page.mouse.click(128, 128)
    assert page.evaluate("heard") == 2
    assert page.errors == ["mine"]


def test_a_terrain_is_told_as_what_the_layer_does_not_follow(opened_map: Callable[..., Any]) -> None:
    page = opened_map({"zoom": 4, "pitch": 50, "center": tile_pyramid.lng_lat(*MIDDLE)})
    page.evaluate(
        """async () => {
            const plateau = Object.assign(document.createElement('canvas'), { width: 256, height: 256 });
            map.addSource('dem', { type: 'raster-dem', tiles: [plateau.toDataURL()] });
            for (let times = 0; times < 2; times++) {
                map.setTerrain({ source: 'dem' });
                await map.once('idle');
                await frame();
            }
        }"""
    )
    (event,) = page.evaluate("events.filter(([type]) => type === 'error')")
    assert "map.setTerrain(null)" in event[1]
