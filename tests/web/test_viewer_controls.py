"""The viewer's page: its controls, as people use them."""

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from viewed import SHAPES, Viewed, pixels, ready, show, value
from viewer_page import view_matrix
from waiting import drawn


def test_divider_moves_by_keys_and_pointer(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    divider = page.get_by_role("slider", name="Divider")
    assert divider.count() == 0
    page.get_by_role("combobox", name="Compare with").select_option("16-bit original method (2018)")
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


def test_a_comparison_that_is_not_there_says_why(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    choice = page.get_by_role("combobox", name="Compare with")
    choice.select_option("8-bit original method (2018)")
    page.get_by_role("status").filter(has_text="too fine for 8 bits").wait_for()
    assert choice.input_value() == ""


@pytest.mark.parametrize("surface", ["Plane", "Sphere", "Cube"])
def test_surfaces_turn(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path], surface: str
) -> None:
    page = ready(open_page, viewer_pages["flag"].url, (900, 600))
    flat = pixels(page)[:, :500]
    page.get_by_role("combobox", name="Surface").select_option(surface)
    page.wait_for_function("vexture.viewer.engine.toUnit(288, 300) !== null")
    drawn(page)
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
    drawn(page)
    assert np.abs(pixels(page)[:, :500] - solid).mean() > 2


def test_theme_changes_the_page_and_never_the_picture(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    button = page.get_by_role("button", name="Theme")
    seen = {}
    for _ in range(3):
        button.click()
        drawn(page)
        theme = value(page)["theme"]
        seen[theme] = pixels(page)
        screenshot(page, theme)
    assert set(seen) == {"light", "dark", "system"}
    assert np.abs(seen["light"] - seen["system"])[:380, :500].max() == 0  # the system's is light
    assert np.abs(seen["light"] - seen["dark"])[:380, :500].max() == 0
    assert seen["dark"][5, 890].max() < 50
    assert seen["light"][5, 890].min() > 200


BACKGROUNDS = {
    "White": {(255, 255, 255)},
    "Black": {(0, 0, 0)},
    "Checkerboard": {(255, 255, 255), (0xD9, 0xD9, 0xD9)},
    "As the page": {(0x14, 0x16, 0x1A)},
    "A colour…": {(0x33, 0x99, 0xCC)},
}
"""Colours of each, in the dark."""

GOLD = [0xE8, 0xB1, 0x00]
"""Colour of the duck."""


def test_background_is_chosen_on_every_surface_and_stays_in_a_link(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    page.emulate_media(color_scheme="dark")

    def colors() -> set[tuple[int, ...]]:
        drawn(page)
        return {tuple(map(int, color)) for color in pixels(page)[2:40, 2:60].reshape(-1, 3)}

    for name, expected in BACKGROUNDS.items():
        page.get_by_role("combobox", name="Background").select_option(name)
        if name.endswith("…"):
            page.get_by_label("Colour of the background").fill("#3399cc")
        assert colors() == expected
        assert pixels(page)[340, 200].tolist() == GOLD, "the duck keeps its colour"
    page.get_by_role("combobox", name="Surface").select_option("Plane")
    page.wait_for_function("vexture.viewer.engine.toUnit(288, 300) !== null")
    assert colors() == BACKGROUNDS["A colour…"]
    page.get_by_role("combobox", name="Background").select_option("Checkerboard")
    assert colors() == BACKGROUNDS["Checkerboard"]
    page.wait_for_function("location.hash.endsWith('~checks')")
    page.reload()
    page.evaluate("vexture.viewer.ready")
    assert value(page)["background"] == "checks"


def test_what_is_compared_with_stands_on_the_same_background_in_the_same_colour(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    page.emulate_media(color_scheme="dark")
    page.get_by_role("combobox", name="Background").select_option("A colour…")
    page.get_by_label("Colour of the background").fill("#3399cc")
    for rival in ("Raster of equal bytes", "16-bit original method (2018)", "Browser SVG"):
        page.get_by_role("combobox", name="Compare with").select_option(rival)
        label = page.locator(".half.right").get_by_text(rival.removesuffix(" of equal bytes"))
        label.wait_for()
        page.get_by_role("slider", name="Divider").press("Home")
        if rival == "Browser SVG":
            page.locator(".browser-svg img").wait_for()
        drawn(page)
        seen = pixels(page)
        assert seen[340, 250].tolist() == GOLD
        assert seen[560, 300].tolist() == [0x33, 0x99, 0xCC]


READ = """() => {
  const unread = new Set(['class', 'id', 'src', 'href', 'value']);
  const attributes = (one) => [...one.attributes].filter(({ name }) => !unread.has(name)).map(({ value }) => value);
  return [...document.querySelectorAll('#app *')].flatMap((one) => [one.textContent, ...attributes(one)]);
}"""
"""All that people read on the page, shown or not, or hear."""


def test_newcomers_read_what_they_know(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    page.get_by_role("combobox", name="Compare with").select_option("16-bit original method (2018)")
    page.get_by_role("button", name="Texture contents").click()
    page.get_by_role("img", name="Curves of the 16-bit original method (2018)").wait_for()
    texts = page.evaluate(READ)
    assert len(texts) > 100
    assert [text for text in texts if "thesis" in text.lower()] == []


def test_a_link_opens_the_same_view(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["flag"].url, (900, 600), permissions=["clipboard-read", "clipboard-write"])
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
        # the corners of what lies on the picture are rounded by the browser, not alike on two pages
        one.add_style_tag(content=".notes, .tools, .fold { visibility: hidden }")
        drawn(one)
    assert np.abs(pixels(other)[:, :560] - pixels(page)[:, :560]).max() <= 1


def test_a_link_to_a_shape_that_is_gone_shows_another(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]
) -> None:
    link = "#view=1~nobody~~0.5~0.5~1~flat~0~0~1~system~~0.5~0~0"
    page = ready(open_page, viewer_pages["both"].url + link, (900, 600))
    page.get_by_role("status").filter(has_text="no shape nobody").wait_for()
    page.wait_for_function("() => document.title.startsWith('duck')")
    assert page.get_by_role("button", name="duck").get_attribute("aria-current") == "true"


LATE = """() => {
  const { renderer } = vexture.viewer.engine;
  const compile = renderer.compileAsync.bind(renderer);
  let release;
  const others = new Promise((done) => { release = done; });
  let calls = 0;
  window.compiled = 0;
  renderer.compileAsync = async (...given) => {
    const isLate = calls++ === 0;
    await compile(...given);
    if (isLate) await others;
    else setTimeout(release);
    window.compiled += 1;
  };
}"""
"""The next program is compiled slowly, as by a busy driver: the one after it is in use before."""


def test_a_surface_chosen_while_another_is_made(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["flag"].url, (900, 600))
    page.evaluate(LATE)
    for surface in ("Plane", "Sphere"):
        page.get_by_role("combobox", name="Surface").select_option(surface)
    page.wait_for_function("compiled === 2 && location.hash.includes('~sphere~')")
    anew = ready(open_page, page.evaluate("location.href"), (900, 600))
    anew.wait_for_function("vexture.viewer.engine.toUnit(288, 300) !== null")
    page.get_by_role("application").press("ArrowLeft")  # it can still be turned
    anew.get_by_role("application").press("ArrowLeft")
    drawn(page)
    drawn(anew)
    assert np.abs(pixels(page) - pixels(anew))[:, :500].mean() < 0.1


@pytest.mark.parametrize(
    "link", ["#view=", "#view=1~duck~", "#view=%E0%A4%A", "#view=1~~~x~0~1~flat~0~0~1~system~~0~0~0"]
)
def test_a_damaged_link_is_ignored_with_a_note(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], link: str
) -> None:
    page = ready(open_page, viewer_pages["duck"].url + link, (900, 600))
    page.get_by_role("status").filter(has_text="link is damaged").wait_for()
    assert value(page)["zoom"] == 1


def test_copy_picture_gives_the_canvas_as_png(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["flag"].url, (900, 600), permissions=["clipboard-read", "clipboard-write"])
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
    expected = viewer_pages["flag"].expected_picture(view_matrix((0.5, 0.5), 1.7, (width, height)), (width, height))
    assert np.abs(picture - expected).mean() <= 0.6


def test_files_are_opened_or_refused_with_a_note(
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    before = pixels(page)[:380, :500]
    chosen = page.locator("input[type=file]")
    status = page.get_by_role("status")
    (tmp_path / "broken.ktx2").write_bytes(b"no texture")
    chosen.set_input_files(tmp_path / "broken.ktx2")
    status.filter(has_text="broken.ktx2:").wait_for()
    chosen.set_input_files(SHAPES / "cake.svg")
    status.filter(has_text="vexture view").wait_for()
    assert np.abs(pixels(page)[:380, :500] - before).max() == 0
    (tmp_path / "flag.ktx2").write_bytes(viewer_pages["flag"].texture.to_ktx2())
    chosen.set_input_files(tmp_path / "flag.ktx2")
    page.get_by_role("list", name="Shapes").get_by_role("button", name="flag").wait_for()
    page.wait_for_function("vexture.viewer.engine.texture.roots.length === 4")


def test_a_file_is_dropped_on_the_picture(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600))
    content = list(viewer_pages["flag"].texture.to_ktx2())
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
    viewer_pages: dict[str, Viewed], open_page: Callable[..., Any], screenshot: Callable[..., Path]
) -> None:
    page = ready(open_page, viewer_pages["both"].url, (900, 600))
    show(page, center=(0.2, 0.3), zoom=30)  # of the first shape; the next is seen whole
    flag = page.get_by_role("list", name="Shapes").get_by_role("button", name="flag")
    flag.focus()
    page.keyboard.press("Enter")
    page.wait_for_function("vexture.viewer.engine.document?.name === 'flag'")
    page.get_by_role("heading", name="flag", exact=True).wait_for()
    assert flag.get_attribute("aria-current") == "true"
    drawn(page)
    screenshot(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    expected = viewer_pages["flag"].expected_picture(view_matrix((0.5, 0.5), 1, (width, height)), (width, height))
    assert np.abs(pixels(page)[:500, :width] - expected[:500]).mean() <= 0.6


def test_a_lost_context_is_said_and_restored(viewer_pages: dict[str, Viewed], open_page: Callable[..., Any]) -> None:
    page = ready(open_page, viewer_pages["duck"].url, (900, 600), errors=True)
    page.evaluate(
        """() => {
          globalThis.lose = vexture.viewer.engine.renderer.getContext().getExtension('WEBGL_lose_context');
          lose.loseContext();
        }"""
    )
    page.get_by_role("status").filter(has_text="graphics driver").wait_for()
    page.evaluate("vexture.viewer.state.update({ zoom: 2 })")  # so that what was seen before is not what is to be seen
    page.evaluate("lose.restoreContext()")
    page.wait_for_function("document.querySelector('.notes').textContent === ''")
    drawn(page)
    width, height = page.evaluate("[vexture.viewer.engine.size.width, vexture.viewer.engine.size.height]")
    expected = viewer_pages["duck"].expected_picture(view_matrix((0.5, 0.5), 2, (width, height)), (width, height))
    assert np.ptp(expected[:380, :500]) > 200
    assert np.abs(pixels(page)[:380, :500] - expected[:380, :500]).mean() <= 0.6


def test_without_webgl_the_page_says_so(viewer_pages: dict[str, Viewed], chromium: Any) -> None:
    context = chromium.new_context(viewport={"width": 900, "height": 600})
    page = context.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.goto(viewer_pages["duck"].url)
    page.get_by_role("alert").filter(has_text="WebGL 2").wait_for()
    context.close()


@pytest.mark.parametrize(
    ("size", "scheme"),
    [
        ((1280, 800), "dark"),
        ((360, 640), "light"),
        pytest.param((1280, 800), "light", marks=pytest.mark.slow),
        pytest.param((360, 640), "dark", marks=pytest.mark.slow),
        pytest.param((390, 844), "light", marks=pytest.mark.slow),
        pytest.param((390, 844), "dark", marks=pytest.mark.slow),
    ],
)
def test_layout(
    viewer_pages: dict[str, Viewed],
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
    page.goto(viewer_pages["both"].url)
    page.evaluate("vexture.viewer.ready")
    drawn(page)
    screenshot(page)
    controls = page.get_by_role("button", name="Controls")
    assert controls.get_attribute("aria-expanded") == json.dumps(not narrow)
    controls.click()
    assert page.get_by_role("complementary", name="Controls").is_visible() == narrow
    drawn(page)
    screenshot(page, "other")
    if narrow:
        for button in page.get_by_role("button").all():
            box = button.bounding_box()
            assert box is None or box["height"] >= 44, button.text_content()
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    context.close()
