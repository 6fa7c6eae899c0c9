"""The globe of three.js: what it shows, loads, colours and finds."""

import base64
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import map_truth
import numpy as np
import pytest
import tile_pyramid
from numpy.typing import NDArray

from chromium import bundle

PAGE = Path(__file__).parent / "pages" / "globe.js"
SIZE = 256
HTML = """<!doctype html><link rel="icon" href="data:,"><body style="margin:0">
<script type="module" src="page.js"></script>"""
CENTRE = tile_pyramid.meeting()
MIDDLE = (CENTRE[0] + 0.01, CENTRE[1] + 0.02)


@pytest.fixture(scope="module")
def folder(tile_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("globe")
    for name, three in (("page", "three"), ("floor", "three-floor")):
        bundle(PAGE, folder / f"{name}.js", three)
        (folder / f"{name}.html").write_text(HTML.replace("page.js", f"{name}.js"), encoding="utf-8")
    for name in ("tiles.json", "map.pmtiles", *map(str, tile_pyramid.ZOOMS)):
        os.symlink(tile_folder / name, folder / name)
    tile_pyramid.write_land(folder / "land")
    tile_pyramid.write_land(folder / "band", 85.0)
    return folder


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    with tile_pyramid.serve_tiles(folder) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    opened = open_page(f"{address}/page.html", (SIZE, SIZE))
    opened.wait_for_function("window.globe")
    return opened


@pytest.fixture(params=["page", "floor"])
def each_page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    """With the newest three.js, and with the oldest that the package promises to work with."""
    opened = open_page(f"{address}/{request.param}.html", (SIZE, SIZE))
    opened.wait_for_function("window.globe")
    return opened


def _look(page: Any, lng: float, lat: float, height: float) -> NDArray[np.float64]:
    data = np.frombuffer(base64.b64decode(page.evaluate("given => look(...given)", [lng, lat, height])), np.uint8)
    return data.reshape(SIZE, SIZE, 4)[::-1, :, :3] / 255.0


def _truth(page: Any, pixel: tuple[float, float]) -> tuple[float, float] | None:
    """Where the ray of a pixel meets the sphere, in Web Mercator of 0..1."""
    found = page.evaluate(
        """([x, y]) => { const from = camera.position.clone(); const to = from.clone().set(x, y, 0.5).unproject(camera)
        .sub(from).normalize(); const b = from.dot(to); const d = b * b - from.dot(from) + 1; if (d < 0) return null;
        return globe.lngLatOf(from.addScaledVector(to, -b - Math.sqrt(d))) }""",
        [2 * pixel[0] / SIZE - 1, 1 - 2 * pixel[1] / SIZE],
    )
    if not found:
        return None
    y = 0.5 - np.arcsinh(np.tan(np.radians(found[1]))) / (2 * np.pi)
    return found[0] / 360 + 0.5, float(np.clip(y, 1e-9, 1 - 1e-9))  # caps have what is at the grid's ends


@pytest.mark.slow
@pytest.mark.parametrize(("place", "height"), [(CENTRE, 2.0), (CENTRE, 1e-5), ((0.3, 0.1), 1.0), ((0.0, 0.4), 1.0)])
def test_each_pixel_has_the_colour_of_its_place(
    place: tuple[float, float], height: float, page: Any, screenshot: Callable[..., Path]
) -> None:
    picture = _look(page, *tile_pyramid.lng_lat(*place), height)
    screenshot(page)
    rng = np.random.default_rng(5)
    wrong, checked = 0, 0
    for x, y in rng.integers(0, SIZE, (150, 2)):
        corners = [_truth(page, (x + a, y + b)) for a in (0, 1) for b in (0, 1)]
        names = {None if corner is None else tile_pyramid.name_at(*corner) for corner in corners}
        if len(names) > 1:
            continue  # a border crosses it
        name = names.pop()
        checked += 1
        wrong += np.abs(picture[y, x] - (tile_pyramid.colour(name) if name else (1, 1, 1))).max() > 0.01
    assert wrong == 0
    assert checked > 50


@pytest.mark.parametrize("height", [0.5, 0.3, 0.01])
def test_edges_are_exact(height: float, page: Any) -> None:
    picture = _look(page, *tile_pyramid.lng_lat(*CENTRE), height)
    project = """some => some.map(([lng, lat]) => {
        const [a, b] = [lng, lat].map((degrees) => degrees * Math.PI / 180);
        const place = camera.position.clone().set(Math.cos(b) * Math.sin(a), Math.sin(b), Math.cos(b) * Math.cos(a));
        const { x, y } = place.project(camera);
        return [(x + 1) * innerWidth / 2, (1 - y) * innerHeight / 2];
    })"""
    unproject = """some => some.map(([x, y]) =>
        globe.placeUnder({ x: 2 * x / innerWidth - 1, y: 1 - 2 * y / innerHeight }, camera))"""
    truth = map_truth.draw_exactly(
        SIZE, lambda some: page.evaluate(project, some), lambda some: page.evaluate(unproject, some), is_curved=True
    )
    assert map_truth.edges(picture, truth) < 0.3


@pytest.mark.slow
def test_no_frame_is_blank_once_the_parent_is_there(folder: Path, open_page: Callable[..., Any]) -> None:
    chance = np.random.default_rng(20)
    path = [
        [
            *tile_pyramid.lng_lat(0.8 + 0.06 * np.sin(0.4 * k), 0.42 + 0.03 * np.cos(0.3 * k)),
            0.3 * 2 ** (1.3 * np.cos(0.5 * k)),
        ]
        for k in range(24)
    ]
    with tile_pyramid.serve_tiles(folder, iter(lambda: float(chance.uniform(0.0, 0.2)), None)) as url:
        page = open_page(f"{url}/page.html?tiles.json", (SIZE, SIZE))
        page.wait_for_function("window.globe")
        blank, waited, last = page.evaluate(
            """async (places) => {
                renderer.setClearColor(0xff00ff);
                await look(...places[0]);
                let [blank, waited] = [0, 0];
                for (const place of places) {
                    aim(...place);
                    blank += await count(255, 0, 255);
                    waited += globe.stats.running > 0;
                }
                await look(...places.at(-1));
                return [blank, waited, globe.stats.shown.map(({ quad, tile }) => [quad.z, tile.z])];
            }""",
            path,
        )
    assert blank == 0
    assert waited > 5, "tiles have come at once"
    assert {tile for quad, tile in last if quad >= 3} == {3}, "a stale tile"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lat", "height", "seen"),
    [
        (90, 3.0, 0.6),
        (-90, 0.5, 2),
        (90, 0.2, 2),
        (-80, 0.3, 1),
        (85.05, 0.01, 2),
        (-85.05, 0.001, 2),
        (85.05, 1e-5, 2),
    ],
)
def test_the_caps_of_the_poles_have_no_rim(
    lat: float, height: float, seen: float, address: str, open_page: Callable[..., Any]
) -> None:
    page = open_page(f"{address}/page.html?land/tiles.json", (SIZE, SIZE))
    page.wait_for_function("window.globe")
    picture = _look(page, 20.0, lat, height)
    along = (np.arange(SIZE) + 0.5) / (SIZE / 2) - 1
    far = np.hypot(*np.meshgrid(along, along))
    assert 255 * np.abs(picture - tile_pyramid.COLOURS[0])[far < seen].max() < tile_pyramid.RIM


@pytest.mark.parametrize(("lat", "height"), [(90, 0.2), (-90, 0.4)])
def test_a_cap_is_as_the_end_of_the_grid(
    lat: float, height: float, address: str, open_page: Callable[..., Any]
) -> None:
    page = open_page(f"{address}/page.html?band/tiles.json", (SIZE, SIZE))
    page.wait_for_function("window.globe")
    picture = _look(page, 20.0, lat, height)
    for y, x in np.ndindex(16, 16):
        pointer = {"x": x / 8 - 15 / 16, "y": 15 / 16 - y / 8}
        place, found = page.evaluate("one => [globe.placeUnder(one, camera), globe.featureUnder(one, camera)]", pointer)
        if place and abs(abs(place[1]) - 85) > 0.1:
            assert (picture[16 * y + 8, 16 * x + 8] < 1).any() == bool(found) == (abs(place[1]) < 85)
    assert page.evaluate("[90, -90].map((lat) => globe.featureAt([20, lat]))") == [None, None]


def test_the_end_of_the_grid_is_picked_at_the_poles(address: str, open_page: Callable[..., Any]) -> None:
    page = open_page(f"{address}/page.html?land/tiles.json", (SIZE, SIZE))
    page.wait_for_function("window.globe")
    _look(page, 20.0, 90, 3)
    assert page.evaluate("[90, -90].map((lat) => globe.featureAt([20, lat])?.id)") == ["land", "land"]


def test_a_linear_target_has_linear_colours(each_page: Any) -> None:
    picture = _look(each_page, *tile_pyramid.lng_lat(*MIDDLE), 0.01)[SIZE // 2, SIZE // 2]
    linear = each_page.evaluate(
        """size => {
            const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });
            renderer.setRenderTarget(target);
            renderer.render(scene, camera);
            renderer.setRenderTarget(null);
            const pixel = new Float32Array(4);
            renderer.readRenderTargetPixels(target, size / 2, size / 2, 1, 1, pixel);
            return [...pixel];
        }""",
        SIZE,
    )
    assert linear[:3] == pytest.approx(((picture + 0.055) / 1.055) ** 2.4, abs=0.01)
    assert linear[3] == 1


def test_a_logarithmic_depth_buffer_shows_it_too(each_page: Any) -> None:
    first = _look(each_page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)
    each_page.evaluate(
        """() => {
            replaceRenderer(new THREE.WebGLRenderer({ preserveDrawingBuffer: true, logarithmicDepthBuffer: true }));
            const sea = new THREE.MeshBasicMaterial({ color: 0 });
            scene.add(new THREE.Mesh(new THREE.SphereGeometry(0.998, 128, 64), sea));
        }"""
    )
    second = _look(each_page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)
    assert np.allclose(second[SIZE // 2, SIZE // 2], first[SIZE // 2, SIZE // 2])
    seen = (first < 1).any(axis=-1)
    assert (second == first).all(axis=-1)[seen].mean() > 0.99


def test_features_are_found_and_coloured_without_loading(page: Any) -> None:
    before = _look(page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)
    places = tile_pyramid.points(300)
    found = page.evaluate(
        "some => some.map((one) => globe.featureAt(one)?.id ?? null)", [tile_pyramid.lng_lat(*one) for one in places]
    )
    assert found == [tile_pyramid.name_at(*one) for one in places]
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    name = tile_pyramid.name_at(*MIDDLE)
    page.evaluate("name => { globe.setPaint({ [name]: '#00ffff' }); }", name)
    after = _look(page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)
    assert np.allclose(after[SIZE // 2, SIZE // 2], (0, 1, 1))
    assert not np.allclose(before[SIZE // 2, SIZE // 2], (0, 1, 1))
    page.evaluate("name => { globe.setFilter((id) => id !== name); }", name)
    assert np.allclose(_look(page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)[SIZE // 2, SIZE // 2], 1)
    assert page.evaluate("place => globe.featureAt(place)", tile_pyramid.lng_lat(*MIDDLE)) is None
    assert asked == []


def test_all_is_freed(page: Any) -> None:
    _look(page, *tile_pyramid.lng_lat(*MIDDLE), 0.5)
    assert page.evaluate("renderer.info.memory.textures") > 0
    page.evaluate("globe.dispose(); globe.update(camera, innerHeight); globe.retry();")
    assert page.evaluate("[renderer.info.memory.textures, renderer.info.memory.geometries, globe.children.length]") == [
        0,
        0,
        0,
    ]


@pytest.mark.parametrize(
    ("act", "message"),
    [
        ("new globe.constructor()", "the source is undefined; give the address of a .pmtiles or a TileJSON, or "),
        ("new globe.constructor({ source: 'a.pmtiles', radius: 0 })", "the radius is 0; give a number above 0"),
        ("globe.featureAt([4, NaN])", "the place is [4,null]; give [lng, lat] or { lng, lat } in degrees, "),
        ("globe.featureUnder(null, camera)", "the pointer is null; give { x, y }, -1 to 1"),
        ("globe.update(undefined, 5)", "the camera is no PerspectiveCamera; give one"),
        ("globe.update(new THREE.OrthographicCamera(), 5)", "the camera is no PerspectiveCamera; give one"),
        ("globe.update(camera, Infinity)", "the height is Infinity; give that of the picture in pixels, 16384 at most"),
        ("globe.placeUnder({ x: 0, y: 0 })", "the camera is no PerspectiveCamera; give one"),
        (
            "globe.featureUnder({ x: 0, y: 0 }, new THREE.OrthographicCamera())",
            "the camera is no PerspectiveCamera; give one",
        ),
        ("globe.lngLatOf()", "the point is undefined; give a Vector3"),
        ("scene.clone()", "a VectorGlobe cannot be cloned; make another one of the same source"),
        ("textureSource('world.ktx2')", 'the texture is "world.ktx2"; give the contents of its file, an ArrayBuffer'),
    ],
)
def test_what_cannot_be_is_refused(act: str, message: str, page: Any) -> None:
    said = page.evaluate(f"() => {{ try {{ {act} }} catch (error) {{ return `${{error}}` }} }}")
    assert said.startswith(f"VextureError: {message}")


def test_a_function_that_throws_is_told_once(page: Any) -> None:
    place = tile_pyramid.lng_lat(*MIDDLE)
    first = _look(page, *place, 0.5)
    told = page.evaluate(
        """async (place) => {
            const errors = [];
            replace({ source: 'map.pmtiles', onError: (error) => errors.push(error.message) });
            globe.setPaint(() => { throw new Error('no') });
            await look(...place, 0.5);
            return errors.map((message) => message.replace(/".*"/, '...'));
        }""",
        place,
    )
    assert told == ["the paint function throws for ... (no); mend it; such features are drawn without it"]
    assert np.array_equal(_look(page, *place, 0.5), first)
