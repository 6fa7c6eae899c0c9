"""The browser, started once for each process of tests, and pages in it."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from page_pool import PagePool

from chromium import CHROMIUM, WEB
from chromium import chromium as started_chromium

SCREENSHOTS = Path(__file__).parent / "screenshots"


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """Debian's chromium, or a skip that says what is missing."""
    pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not Path(CHROMIUM).is_file():
        pytest.skip("no chromium (on Debian: apt-get install chromium)")
    if not (WEB / "node_modules" / "three").is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    # what is around a canvas is drawn in software: without a graphics card that takes a quarter less time
    with started_chromium("--disable-gpu-compositing", "--enable-unsafe-webgpu") as browser:
        yield browser


@pytest.fixture(scope="session")
def page_pool(chromium: Any) -> PagePool:
    """Pages that other tests have used before."""
    return PagePool(chromium)


@pytest.fixture
def open_page(page_pool: PagePool) -> Iterator[Callable[..., Any]]:
    """Open pages by their address; errors of their scripts fail the test, unless `errors=True` expects some.

    ``page.errors`` is the list of them. `keep` a page that draws what it is told: other tests find it as it is, and its
    program compiled. Further options are those of the page's context.
    """
    taken, checked = [], []

    def open_address(
        url: str, size: tuple[int, int] = (512, 512), *, errors: bool = False, keep: bool = False, **options: Any
    ) -> Any:
        page = page_pool.take(size, options, url if keep else "")
        taken.append(page)
        if not errors:
            checked.append(page)
        if not keep:
            page.goto(url)
        return page

    yield open_address
    found = [error for page in checked for error in page.errors]
    for page in taken:
        page_pool.give_back(page)
    assert found == []


@pytest.fixture
def screenshot(request: pytest.FixtureRequest) -> Callable[..., Path]:
    """Keep a picture of a page, or of an element of it, where people can look at it."""

    def save_picture(target: Any, label: str = "") -> Path:
        SCREENSHOTS.mkdir(exist_ok=True)
        name = request.node.name.replace("/", "_") + (f"-{label}" if label else "")
        path = SCREENSHOTS / f"{name}.png"
        target.screenshot(path=path)
        return path

    return save_picture


@pytest.fixture(scope="session")
def viewer_pages(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Any]]:
    """The viewer's pages with a silhouette, with a drawing in colours, with both."""
    from viewed import write_pages

    from chromium import serve_folder

    folder = tmp_path_factory.mktemp("viewer")
    with serve_folder(folder) as url:
        yield write_pages(folder, url)


@pytest.fixture(scope="session")
def overlay_pages(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, dict[str, Any]]]:
    """Address of the viewer's pages with one texture each, and the textures by name."""
    from overlay_page import write_pages

    from chromium import serve_folder

    folder = tmp_path_factory.mktemp("overlays")
    textures = write_pages(folder)
    with serve_folder(folder) as address:
        yield address, textures


@pytest.fixture
def show(overlay_pages: tuple[str, dict[str, Any]], open_page: Callable[..., Any]) -> Callable[[str], Any]:
    """Open the page of a texture."""
    from overlay_page import open_shape

    address, textures = overlay_pages
    return lambda name: open_shape(open_page, address, textures[name])


@pytest.fixture(scope="session")
def mask_folder(made_once: Callable[..., Path]) -> Path:
    """Textures, and the page of masked materials for each version of three.js."""
    from mask_page import prepare

    return made_once("mask", prepare)


@pytest.fixture(scope="session")
def tile_folder(made_once: Callable[..., Path]) -> Path:
    """A small pyramid of tiles."""
    from tile_pyramid import write

    return made_once("tiles", write)


@pytest.fixture(scope="session")
def flood_pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Addresses of pages of floods on disk: in three steps, in one, and with a step at which all is dry."""
    import flood_page

    folder = tmp_path_factory.mktemp("flood")
    dry = flood_page.scene(2)
    dry["flood"]["steps"][1] = flood_page.manifest("flood/01", -1e5, "07:00", "2026-01-05T07:00:00Z")
    scenes = {"series": flood_page.scene(3), "single": flood_page.scene(1), "dry": dry}
    return {name: flood_page.write_page(folder / f"{name}.html", scene).as_uri() for name, scene in scenes.items()}


@pytest.fixture
def opened_flood(open_page: Callable[..., Any], flood_pages: dict[str, str]) -> Callable[..., Any]:
    """Open a page of `flood_pages`, and wait until it is there."""
    import flood_seen

    def opener(
        name: str, size: tuple[int, int] = flood_seen.SMALL, query: str = "", *, bypass_csp: bool = True, **options: Any
    ) -> Any:
        # playwright's waits use eval
        page = open_page(flood_pages[name] + query, size, bypass_csp=bypass_csp, **options)
        page.evaluate("vexture.flood.ready")
        page.evaluate("vexture.flood.freeze(2)")
        return page

    return opener


@pytest.fixture(scope="session")
def map_folder(tile_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of a map of MapLibre, with its tiles."""
    import maplibre_page

    folder = tmp_path_factory.mktemp("maplibre")
    maplibre_page.write_page(folder, tile_folder)
    return folder


@pytest.fixture(scope="session")
def map_address(map_folder: Path) -> Iterator[str]:
    """Its address."""
    import tile_pyramid

    with tile_pyramid.serve_tiles(map_folder) as url:
        yield url


@pytest.fixture
def opened_map(map_address: str, open_page: Callable[..., Any]) -> Callable[..., Any]:
    """Open the page of a map with a layer of tiles, when all is there."""
    import maplibre_page
    import tile_pyramid

    def opener(
        view: dict[str, Any],
        layer: dict[str, Any] | None = None,
        size: Any = maplibre_page.SIZE,
        url: str = map_address,
        name: str = "page",
        **options: Any,
    ) -> Any:
        page = open_page(f"{url}/{name}.html", size, **options)
        page.wait_for_function("window.loaded")
        view = {"center": tile_pyramid.lng_lat(*maplibre_page.CENTRE), **view}
        page.evaluate("async ([view, layer]) => { await start(view, layer) }", [view, layer or {}])
        return page

    return opener
