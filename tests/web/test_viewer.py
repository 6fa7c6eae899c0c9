"""The viewer's page: its pixels against exact coverage, and its controls as people use them."""

import io
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import ROOT, served
from numpy.typing import NDArray
from PIL import Image
from viewer_page import FIT, build_viewer, data_url, manifest, thesis_view, view_matrix, write_page

import vexture
from vexture.pictures import render_layers

SIZE = (512, 512)
PRECISION = 1e-7  # for views at 10,000x
SHAPES = ROOT / "examples" / "shapes"

FLAG = b"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="10 20 300 200">
  <rect x="10" y="20" width="300" height="200" fill="#d7e3f4"/>
  <path d="M10 220C90 60 190 240 310 20V220Z" fill="#b5121b"/>
  <circle cx="150" cy="120" r="71.3" fill="#0b6e4f" fill-opacity=".6"/>
  <ellipse cx="210" cy="90" rx="60" ry="13" fill="#ffd166" fill-opacity=".85"/>
</svg>"""


class Viewed:
    """A shape, its drawing and where its page is served."""

    def __init__(self, drawing: Any, texture: Any, url: str) -> None:
        self.drawing, self.texture, self.url = drawing, texture, url

    def expected(self, matrix: NDArray[np.float64], size: tuple[int, int] = SIZE) -> NDArray[np.float64]:
        """Picture on white in 0..255, from the drawing itself."""
        if self.texture.roots[0].paint is None:
            grey = 255.0 * (1.0 - vexture.render(self.drawing, size, matrix, renderer="exact").astype(np.float64))
            return np.repeat(grey[..., None], 3, axis=2)
        layers = render_layers(self.drawing, size, matrix, renderer="exact").astype(np.float64)
        return 255.0 * (layers[..., :3] + 1.0 - layers[..., 3:])


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Viewed]]:
    """The duck, all its rivals included; a drawing in colours; both in one page."""
    build_viewer()
    folder = tmp_path_factory.mktemp("viewer")
    (folder / "flag.svg").write_bytes(FLAG)
    duck, flag = vexture.read_svg(SHAPES / "duck.svg"), vexture.read_svg(folder / "flag.svg")
    textures = vexture.convert(duck, precision=PRECISION), vexture.convert(flag, split="paint", precision=PRECISION)
    thesis = vexture.convert(duck, encoding="thesis", bits=16)
    views = {
        "svg": data_url("image/svg+xml", (SHAPES / "duck.svg").read_bytes()),
        "thesis16": thesis_view(thesis, folder),
        "thesis8": {"error": "the duck is too fine for 8 bits"},
    }
    duck_manifest = manifest(textures[0], views=views)
    flag_manifest = manifest(textures[1], views={"svg": data_url("image/svg+xml", FLAG)})
    write_page(folder / "duck.html", duck_manifest)
    write_page(folder / "flag.html", flag_manifest)
    write_page(folder / "both.html", duck_manifest, flag_manifest)
    with served(folder) as url:
        yield {
            "duck": Viewed(duck, textures[0], f"{url}/duck.html"),
            "flag": Viewed(flag, textures[1], f"{url}/flag.html"),
            "thesis": Viewed(duck, thesis, f"{url}/duck.html"),
            "both": Viewed(duck, textures[0], f"{url}/both.html"),
        }


def pixels(page: Any) -> NDArray[np.float64]:
    """What is on the screen, 0..255."""
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(np.float64)


def show(page: Any, **patch: Any) -> None:
    """Set a state and wait for its picture."""
    page.evaluate(
        """async (patch) => {
          const { engine, state } = vexture.viewer;
          state.update(patch);
          engine.render();
          await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        }""",
        patch,
    )


def value(page: Any) -> dict[str, Any]:
    """State of the page."""
    found: dict[str, Any] = page.evaluate("vexture.viewer.state.value")
    return found


def ready(open_page: Callable[..., Any], url: str, size: tuple[int, int] = SIZE, **options: Any) -> Any:
    """Open a page and wait for its first picture."""
    page = open_page(url, size, **options)
    page.evaluate("vexture.viewer.ready")
    return page


def point_on_outline(drawing: Any) -> tuple[float, float]:
    """Middle of the longest cubic: a place where something is to be seen at any zoom."""
    cubics = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    bent = cubics[np.argmax(np.abs(cubics[:, 3] - cubics[:, 0]).min(axis=1))]
    middle = (bent[0] + 3 * bent[1] + 3 * bent[2] + bent[3]) / 8
    return float(middle[0]), float(middle[1])


@pytest.mark.parametrize("zoom", [1, 100, 1000, 10000])
@pytest.mark.parametrize("name", ["duck", "flag"])
def test_pixels_are_those_of_exact_coverage(
    pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path], name: str, zoom: int
) -> None:
    viewed = pages[name]
    page = ready(open_page, viewed.url + "?bare")
    center = (0.5, 0.5) if zoom == 1 else point_on_outline(viewed.drawing)
    show(page, center=center, zoom=zoom)
    expected = viewed.expected(view_matrix(center, zoom, SIZE))
    assert np.ptp(expected) > 20, "nothing is to be seen there"
    error = pixels(page) - expected
    mean, largest = np.abs(error).mean(), np.abs(error).max()
    contrast = np.ptp(expected, axis=(0, 1)).max()
    aside = error.mean(axis=2) / (np.ptp(expected.mean(axis=2)))
    beside = [aside.sum(axis=axis) for axis in (0, 1)]  # how far an outline across the view is moved, by column and row
    moved = min(np.abs(one).max() for one in beside)
    step = min(np.abs(np.diff(one)).max() for one in beside)
    print(f"\n{name} {zoom}x: MAE {mean:.4f}/255, largest {largest:.2f}, moved {moved:.4f} px, step {step:.4f} px")
    screenshot(page)
    assert mean <= 0.6
    if zoom >= 1000:
        assert step <= 0.1
        if contrast == 255.0:  # of other colours the rounding to 8 bits, summed up, is more than that
            assert moved <= PRECISION * zoom * FIT * SIZE[0] + 0.1
    else:
        assert largest <= 4 * contrast / 255


def test_pixels_of_a_fine_screen(pages: dict[str, Viewed], chromium: Any) -> None:
    context = chromium.new_context(viewport={"width": 256, "height": 256}, device_scale_factor=2, color_scheme="light")
    page = context.new_page()
    page.goto(pages["duck"].url + "?bare")
    page.evaluate("vexture.viewer.ready")
    error = pixels(page) - pages["duck"].expected(view_matrix((0.5, 0.5), 1, SIZE))
    context.close()
    assert np.abs(error).mean() <= 0.6
    assert np.abs(error).max() <= 4


def test_keys_move_and_zoom(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (1000, 700))
    stage = page.get_by_role("application")
    stage.focus()
    before = value(page)
    page.keyboard.press("ArrowLeft")
    assert value(page)["center"][0] < before["center"][0]
    page.keyboard.press("ArrowUp")
    assert value(page)["center"][1] > before["center"][1]
    page.keyboard.press("+")
    assert value(page)["zoom"] > 1
    page.keyboard.press("-")
    page.keyboard.press("-")
    assert value(page)["zoom"] < 1
    page.keyboard.press("0")
    assert value(page) == before


def test_wheel_zooms_towards_the_pointer(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url + "?bare")
    page.mouse.move(400, 100)
    before = page.evaluate("vexture.viewer.engine.toUnit(400, 100)")
    for _ in range(40):
        page.mouse.wheel(0, -100)
    page.wait_for_function("vexture.viewer.state.value.zoom > 1000")
    after = page.evaluate("vexture.viewer.engine.toUnit(400, 100)")
    assert after == pytest.approx(before, abs=1e-9)
    for _ in range(200):
        page.mouse.wheel(0, -200)
    page.wait_for_function("vexture.viewer.state.value.zoom === 50000")
    page.mouse.dblclick(256, 256)
    assert value(page)["zoom"] == 50000


def test_dragging_takes_the_picture_along(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url + "?bare")
    show(page, zoom=3)
    point = page.evaluate("vexture.viewer.engine.toUnit(200, 200)")
    page.mouse.move(200, 200)
    page.mouse.down()
    page.mouse.move(260, 170, steps=4)
    page.mouse.up()
    assert page.evaluate("vexture.viewer.engine.toUnit(260, 170)") == pytest.approx(point, abs=1e-12)
    page.mouse.move(10, 10)
    assert page.evaluate("vexture.viewer.engine.toUnit(260, 170)") == pytest.approx(point, abs=1e-12)


def test_two_fingers_zoom(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url + "?bare", has_touch=True)
    touch = page.context.new_cdp_session(page)

    def fingers(kind: str, *places: tuple[int, int]) -> None:
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    held = page.evaluate("vexture.viewer.engine.toUnit(256, 256)")
    fingers("touchStart", (236, 256), (276, 256))
    for spread in (40, 60, 80):
        fingers("touchMove", (256 - spread, 256), (256 + spread, 256))
    fingers("touchEnd")
    assert value(page)["zoom"] == pytest.approx(4, rel=0.02)
    assert page.evaluate("vexture.viewer.engine.toUnit(256, 256)") == pytest.approx(held, abs=0.01)


def test_buttons_zoom_and_reset(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (1000, 700))
    page.get_by_role("button", name="Zoom in").click()
    assert value(page)["zoom"] == 1.5
    page.get_by_role("button", name="Zoom out").click(click_count=1)
    page.get_by_role("button", name="Zoom out").click()
    assert value(page)["zoom"] == pytest.approx(1 / 1.5)
    page.get_by_role("button", name="Reset view").click()
    assert value(page)["zoom"] == 1


def test_nothing_is_drawn_while_nothing_happens(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (1000, 700))
    page.wait_for_timeout(1500)
    drawn = page.evaluate(
        """async () => {
          let frames = 0;
          vexture.viewer.engine.addEventListener('frame', () => { frames += 1; });
          await new Promise((done) => setTimeout(done, 600));
          return frames;
        }"""
    )
    assert drawn == 0


RIVALS = {
    "svg": ("Browser SVG", "Browser SVG", 0.6),
    "thesis16": ("Thesis 16 bit", "Thesis, 16 bit", 0.6),
}


@pytest.mark.parametrize("zoom", [1, 40])
@pytest.mark.parametrize("rival", RIVALS)
def test_rivals_stand_in_step_with_the_picture(
    pages: dict[str, Viewed],
    open_page: Callable[..., Any],
    screenshot: Callable[..., Path],
    rival: str,
    zoom: int,
) -> None:
    viewed = pages["duck"]
    choice, label, limit = RIVALS[rival]
    page = ready(open_page, viewed.url, (900, 600))
    center = (0.5, 0.5) if zoom == 1 else point_on_outline(viewed.drawing)
    show(page, center=center, zoom=zoom)
    page.get_by_role("combobox", name="Compare with").select_option(choice)
    page.locator(".half").get_by_text(label, exact=True).wait_for()
    page.wait_for_timeout(500)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    screenshot(page)
    seen = pixels(page)[60 : height - 60, width // 2 + 30 : width]
    matrix = view_matrix(center, zoom, (width, height))
    if rival == "thesis16":
        cover = vexture.render(pages["thesis"].texture, (width, height), matrix, renderer="cpu")
        expected = np.repeat(255.0 * (1.0 - cover[..., None]), 3, axis=2)
    else:
        expected = viewed.expected(matrix, (width, height))
    expected = expected[60 : height - 60, width // 2 + 30 : width]
    assert np.ptp(expected) > 200
    print(f"\n{rival} {zoom}x: {np.abs(seen - expected).mean():.3f}")
    assert np.abs(seen - expected).mean() <= limit


def test_raster_of_equal_bytes(
    pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    nbytes = page.evaluate("vexture.viewer.engine.texture.nbytes")
    side = int(np.sqrt(nbytes * 3 / 4))
    page.get_by_role("combobox", name="Compare with").select_option("Raster of equal bytes")
    page.locator(".half").get_by_text(f"Raster, {side} × {side}", exact=True).wait_for()
    page.wait_for_timeout(300)
    screenshot(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    exact = pages["duck"].expected(view_matrix((0.5, 0.5), 1, (width, height)), (width, height))
    error = np.abs(pixels(page)[60 : height - 60, :width] - exact[60 : height - 60])
    left, right = error[:, : width // 2 - 30].mean(), error[:, width // 2 + 30 :].mean()
    assert left <= 0.1
    assert 0.3 <= right <= 10  # blurred, but the same shape at the same place


def test_divider_moves_by_keys_and_pointer(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    divider = page.get_by_role("slider", name="Divider")
    assert divider.count() == 0
    page.get_by_role("combobox", name="Compare with").select_option("Thesis 16 bit")
    divider.wait_for()
    assert divider.get_attribute("aria-valuenow") == "50"
    divider.press("ArrowRight")
    assert divider.get_attribute("aria-valuenow") == "52"
    assert value(page)["center"] == [0.5, 0.5]
    divider.press("Home")
    assert value(page)["split"] == 0
    divider.press("PageUp")
    assert value(page)["split"] == pytest.approx(0.1)
    box = divider.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, 400)
    page.mouse.down()
    width = page.evaluate("vexture.viewer.engine.size.width")
    page.mouse.move(0.75 * width, 380, steps=3)
    page.mouse.up()
    assert value(page)["split"] == pytest.approx(0.75, abs=0.01)
    assert value(page)["center"] == [0.5, 0.5]


def test_a_comparison_that_is_not_there_says_why(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    choice = page.get_by_role("combobox", name="Compare with")
    choice.select_option("Thesis 8 bit")
    page.get_by_role("status").filter(has_text="too fine for 8 bits").wait_for()
    assert choice.input_value() == ""


@pytest.mark.parametrize("surface", ["Plane", "Sphere", "Cube"])
def test_surfaces_turn(
    pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path], surface: str
) -> None:
    page = ready(open_page, pages["flag"].url, (900, 600))
    flat = pixels(page)[:, :500]
    page.get_by_role("combobox", name="Surface").select_option(surface)
    page.wait_for_function("vexture.viewer.engine.toUnit(288, 300) !== null")
    page.wait_for_timeout(400)
    screenshot(page)
    solid = pixels(page)[:, :500]
    assert np.abs(solid - flat).mean() > 5
    assert page.get_by_role("combobox", name="Compare with").is_disabled()
    before = value(page)
    page.mouse.move(250, 300)
    page.mouse.down()
    page.mouse.move(330, 320, steps=3)
    page.mouse.up()
    page.get_by_role("application").press("ArrowLeft")
    page.mouse.wheel(0, -200)
    page.wait_for_function("vexture.viewer.state.value.distance > 1")
    after = value(page)
    assert after["yaw"] != before["yaw"]
    assert after["pitch"] != before["pitch"]
    assert after["center"] == before["center"]
    page.wait_for_timeout(300)
    assert np.abs(pixels(page)[:, :500] - solid).mean() > 2


def test_theme_changes_paper_and_ink(
    pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    button = page.get_by_role("button", name="Theme")
    seen = {}
    for _ in range(3):
        button.click()
        page.wait_for_timeout(200)
        theme = value(page)["theme"]
        seen[theme] = pixels(page)
        screenshot(page, theme)
    assert set(seen) == {"light", "dark", "system"}
    assert seen["light"][5, 5].tolist() == [255, 255, 255]
    assert seen["dark"][5, 5].tolist() == [0x14, 0x16, 0x1A]
    assert np.abs(seen["light"][:400, :500] - seen["system"][:400, :500]).max() == 0  # the system's is light


def test_a_link_opens_the_same_view(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["flag"].url, (900, 600), permissions=["clipboard-read", "clipboard-write"])
    page.mouse.move(200, 200)
    page.mouse.wheel(0, -700)
    page.get_by_role("combobox", name="Compare with").select_option("Browser SVG")
    page.get_by_role("slider", name="Divider").press("ArrowLeft")
    page.get_by_role("button", name="Theme").click()
    page.get_by_role("button", name="Theme").click()
    page.get_by_role("button", name="Copy link").click()
    page.get_by_role("status").filter(has_text="The link is copied").wait_for()
    link = page.evaluate("navigator.clipboard.readText()")
    page.wait_for_function("(link) => location.href === link", arg=link)
    other = ready(open_page, link, (900, 600))
    assert value(other) == value(page)
    for one in (page, other):
        one.evaluate("document.querySelector('.notes').textContent = ''")
        one.wait_for_timeout(500)
    assert np.abs(pixels(other)[:, :560] - pixels(page)[:, :560]).max() <= 1


@pytest.mark.parametrize(
    "link", ["#view=", "#view=1~duck~", "#view=%E0%A4%A", "#view=1~~~x~0~1~flat~0~0~1~system~~0~0~0"]
)
def test_a_damaged_link_is_ignored_with_a_note(
    pages: dict[str, Viewed], open_page: Callable[..., Any], link: str
) -> None:
    page = ready(open_page, pages["duck"].url + link, (900, 600))
    page.get_by_role("status").filter(has_text="link is damaged").wait_for()
    assert value(page)["zoom"] == 1


def test_copy_picture_gives_the_canvas_as_png(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["flag"].url, (900, 600), permissions=["clipboard-read", "clipboard-write"])
    show(page, zoom=1.7)
    page.get_by_role("button", name="Copy picture").click()
    page.get_by_role("status").filter(has_text="The picture is copied").wait_for()
    content = page.evaluate(
        """async () => {
          const [item] = await navigator.clipboard.read();
          return [...new Uint8Array(await (await item.getType('image/png')).arrayBuffer())];
        }"""
    )
    picture = np.asarray(Image.open(io.BytesIO(bytes(content))).convert("RGB")).astype(np.float64)
    height, width = picture.shape[:2]
    expected = pages["flag"].expected(view_matrix((0.5, 0.5), 1.7, (width, height)), (width, height))
    assert np.abs(picture - expected).mean() <= 0.6


def test_files_are_opened_or_refused_with_a_note(
    pages: dict[str, Viewed], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    before = pixels(page)[:380, :500]
    chosen = page.locator("input[type=file]")
    status = page.get_by_role("status")
    (tmp_path / "broken.ktx2").write_bytes(b"no texture")
    chosen.set_input_files(tmp_path / "broken.ktx2")
    status.filter(has_text="broken.ktx2:").wait_for()
    chosen.set_input_files(SHAPES / "cake.svg")
    status.filter(has_text="vexture view").wait_for()
    assert np.abs(pixels(page)[:380, :500] - before).max() == 0
    (tmp_path / "flag.ktx2").write_bytes(pages["flag"].texture.to_ktx2())
    chosen.set_input_files(tmp_path / "flag.ktx2")
    page.get_by_role("list", name="Shapes").get_by_role("button", name="flag").wait_for()
    page.wait_for_function("vexture.viewer.engine.texture.roots.length === 4")


def test_a_file_is_dropped_on_the_picture(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600))
    content = list(pages["flag"].texture.to_ktx2())
    page.evaluate(
        """(content) => {
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File([new Uint8Array(content)], 'dropped.ktx2'));
          document.querySelector('canvas').dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true }));
        }""",
        content,
    )
    page.get_by_role("heading", name="dropped", exact=True).wait_for()


def test_shapes_are_chosen_from_a_list(
    pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, pages["both"].url, (900, 600))
    flag = page.get_by_role("list", name="Shapes").get_by_role("button", name="flag")
    flag.focus()
    page.keyboard.press("Enter")
    page.get_by_role("heading", name="flag", exact=True).wait_for()
    assert flag.get_attribute("aria-current") == "true"
    page.wait_for_timeout(300)
    screenshot(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    expected = pages["flag"].expected(view_matrix((0.5, 0.5), 1, (width, height)), (width, height))
    assert np.abs(pixels(page)[:500, :width] - expected[:500]).mean() <= 0.6


def test_a_lost_context_is_said_and_restored(pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, pages["duck"].url, (900, 600), errors=True)
    before = pixels(page)[:380, :500]
    page.evaluate(
        """() => {
          globalThis.lose = vexture.viewer.engine.renderer.getContext().getExtension('WEBGL_lose_context');
          lose.loseContext();
        }"""
    )
    page.get_by_role("status").filter(has_text="graphics driver").wait_for()
    page.evaluate("lose.restoreContext()")
    page.wait_for_function("document.querySelector('.notes').textContent === ''")
    page.wait_for_timeout(1500)
    assert np.abs(pixels(page)[:380, :500] - before).max() <= 1


def test_without_webgl_the_page_says_so(pages: dict[str, Viewed], chromium: Any) -> None:
    context = chromium.new_context(viewport={"width": 900, "height": 600})
    page = context.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.goto(pages["duck"].url)
    page.get_by_role("alert").filter(has_text="WebGL 2").wait_for()
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1280, 800), (390, 844), (360, 640)])
def test_layout(
    pages: dict[str, Viewed],
    chromium: Any,
    screenshot: Callable[..., Path],
    size: tuple[int, int],
    scheme: str,
) -> None:
    narrow = size[0] < 720
    context = chromium.new_context(
        viewport={"width": size[0], "height": size[1]}, color_scheme=scheme, has_touch=narrow, is_mobile=narrow
    )
    page = context.new_page()
    page.goto(pages["both"].url)
    page.evaluate("vexture.viewer.ready")
    page.wait_for_timeout(300)
    screenshot(page)
    controls = page.get_by_role("button", name="Controls")
    assert controls.get_attribute("aria-expanded") == json.dumps(not narrow)
    controls.click()
    assert page.get_by_role("complementary", name="Controls").is_visible() == narrow
    page.wait_for_timeout(300)
    screenshot(page, "other")
    if narrow:
        for button in page.get_by_role("button").all():
            box = button.bounding_box()
            assert box is None or box["height"] >= 44, button.text_content()
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    context.close()
