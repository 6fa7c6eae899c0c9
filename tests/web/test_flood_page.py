"""The page of a flood in a real browser: water on a beach in a wooden box, its steps, its read-out, its bad days."""

import base64
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import served
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page, expect
from waiting import drawn

import flood_page

LEVELS = flood_page.LEVELS
PRESETS = ("Plan", "Overview", "Coast", "Shore", "Beach")
SMALL = (480, 320)
WIDE = (740, 500)
"""On which the panel is open."""
DEEP = (0.5, 0.3)
"""A place in the unit square that is always under water."""

PATIENCE = 60_000
"""Milliseconds: the first picture waits for a software renderer's compiler."""

WATER_SEEN = """() => {
    const { stage } = vexture.flood;
    const gl = stage.renderer.getContext();
    window.seen = [];
    stage.addEventListener('frame', () => {
        const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let water = 0;
        for (let at = 0; at < pixels.length; at += 4) water += pixels[at] > 127;
        seen.push(water);
    });
}"""
"""Counts the pixels of water in each picture, as it is drawn; the picture must be the flat one."""


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Addresses of pages on disk: in three steps, in one, and with a step at which all is dry."""
    folder = tmp_path_factory.mktemp("flood")
    dry = flood_page.scene(2)
    dry["flood"]["steps"][1] = flood_page.manifest("flood/01", -1e5, "07:00", "2026-01-05T07:00:00Z")
    scenes = {"series": flood_page.scene(3), "single": flood_page.scene(1), "dry": dry}
    return {name: flood_page.write_page(folder / f"{name}.html", scene).as_uri() for name, scene in scenes.items()}


@pytest.fixture
def opened(open_page: Callable[..., Any], pages: dict[str, str]) -> Iterator[Callable[..., Page]]:
    """Open a page, and wait until it is there."""

    def opener(
        name: str, size: tuple[int, int] = SMALL, query: str = "", *, bypass_csp: bool = True, **options: Any
    ) -> Page:
        page = open_page(pages[name] + query, size, bypass_csp=bypass_csp, **options)  # playwright's waits use eval
        page.set_default_timeout(PATIENCE)
        page.evaluate("vexture.flood.ready")
        page.evaluate("vexture.flood.freeze(2)")
        return page

    return opener


def view(page: Page, preset: str) -> None:
    """Look from a preset at once."""
    page.evaluate("(preset) => vexture.flood.view(preset, { fly: false })", preset)


def flat(page: Page) -> NDArray[np.uint8]:
    """Picture of the flat water, 0 where the ground is, 255 where the water is."""
    size = page.evaluate("""() => {
        vexture.flood.flat(true);
        const gl = vexture.flood.stage.renderer.getContext();
        window.flatPixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
        vexture.flood.render();
        gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, flatPixels);
        return [gl.drawingBufferHeight, gl.drawingBufferWidth];
    }""")
    pixels = page.evaluate("btoa(Array.from(flatPixels, (byte) => String.fromCharCode(byte)).join(''))")
    return np.frombuffer(base64.b64decode(pixels), np.uint8).reshape(*size, 4)[::-1]


def on_screen(page: Page, u: float, v: float) -> tuple[float, float]:
    """Pixel at which a place of the water is seen."""
    u0, v0, u1, v1 = flood_page.FRAME.box
    width, depth = 100.0, 75.0
    x, z = ((u - u0) / (u1 - u0) - 0.5) * width, (0.5 - (v - v0) / (v1 - v0)) * depth
    seen = page.evaluate(
        """([x, z]) => {
            const { camera, stage } = vexture.flood;
            camera.updateMatrixWorld();
            const at = camera.position.clone().set(x, 0, z).project(camera);
            if (Math.abs(at.z) > 1) return [-1, -1]; // behind the camera
            return [(at.x + 1) / 2 * stage.size.width, (1 - at.y) / 2 * stage.size.height];
        }""",
        [x, z],
    )
    return seen[0], seen[1]


@pytest.mark.long
@pytest.mark.parametrize("size", [(740, 420), pytest.param((390, 844), marks=pytest.mark.slow)])
def test_every_preset_shows_water_and_land(
    opened: Callable[..., Page], screenshot: Callable[..., Path], size: tuple[int, int]
) -> None:
    page = opened("series", size, bypass_csp=False)
    assert page.title() == "A bay of formulas"
    for preset in PRESETS:
        page.evaluate("vexture.flood.flat(false)")
        view(page, preset)
        picture = np.asarray(Image.open(screenshot(page, f"{size[0]}-{preset}")).convert("RGB"))
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 5000
        water = flat(page)[..., 0].mean() / 255
        assert 0.04 < water < 0.8, preset


def test_flat_water_is_where_the_texture_is(opened: Callable[..., Page]) -> None:
    page = opened("series", query="?bare")
    page.evaluate("vexture.flood.relief(0)")
    random = np.random.default_rng(3)
    for preset in ("Plan", "Shore"):
        view(page, preset)
        picture = flat(page)[..., :3]
        assert picture.max() == 255
        u0, v0, u1, v1 = flood_page.FRAME.box
        checked = 0
        for u, v in random.uniform((u0 + 0.01, v0 + 0.01), (u1 - 0.01, v1 - 0.01), (120, 2)):
            away = float(flood_page.height(np.array(u), np.array(v)))
            px, py = on_screen(page, u, v)
            if abs(away) < 3 or not (1 <= px < SMALL[0] - 1 and 1 <= py < SMALL[1] - 1):
                continue
            checked += 1
            assert np.all(picture[int(py), int(px)] == (255 if away < 0 else 0)), (preset, u, v)
        assert checked > 8, preset


def test_no_picture_is_without_water_while_stepping(opened: Callable[..., Page]) -> None:
    page = opened("series")
    flat(page)
    page.evaluate(WATER_SEEN)
    before = page.evaluate("vexture.flood.render(), seen.at(-1)")
    assert before > 1000
    for fading in (False, True):
        page.get_by_role("checkbox", name="Cross-fade").set_checked(fading)
        page.evaluate("async () => { const { player } = vexture.flood; player.speed = 4; await player.go(0); }")
        page.get_by_role("button", name="Play").click()
        page.wait_for_function("vexture.flood.player.index === 2 && !vexture.flood.player.playing")
    page.wait_for_function("vexture.flood.water.next === null || vexture.flood.water.fade === 1")
    page.evaluate("vexture.flood.render()")
    seen = page.evaluate("seen")
    assert len(seen) > 6
    assert min(seen) >= 0.95 * before
    assert seen[-1] > 1.01 * before  # the water has risen


def test_steps_by_hand(opened: Callable[..., Page]) -> None:
    page = opened("series")
    slider = page.get_by_role("slider", name="Time")
    before, after = (page.get_by_role("button", name=f"{which} step") for which in ("Previous", "Next"))
    expect(before).to_be_disabled()
    expect(slider).to_have_attribute("aria-valuetext", "06:00, step 1 of 3")
    after.click()
    expect(slider).to_have_attribute("aria-valuetext", "07:00, step 2 of 3")
    assert page.evaluate("vexture.flood.water.texture === vexture.flood.player.step.texture")
    slider.press("ArrowRight")
    expect(slider).to_have_attribute("aria-valuetext", "08:00, step 3 of 3")
    expect(after).to_be_disabled()
    before.click()
    expect(slider).to_have_value("1")
    page.get_by_role("button", name="Play").click()
    expect(page.get_by_role("button", name="Pause")).to_be_visible()
    expect(page.get_by_role("button", name="Play")).to_be_visible(timeout=PATIENCE)
    expect(slider).to_have_value("2")


def test_the_next_step_is_loaded_before_it_is_shown(opened: Callable[..., Page]) -> None:
    page = opened("series")
    uploaded = """async (at) => {
        const { player, stage } = vexture.flood;
        await new Promise((go) => setTimeout(go, 200));
        const { texture } = await player.steps.open(player.names[at]);
        return stage.renderer.properties.has(texture.textures.texels);
    }"""
    assert page.evaluate(uploaded, 1)
    assert not page.evaluate(uploaded, 2)


def test_one_step_has_no_time_bar(opened: Callable[..., Page]) -> None:
    page = opened("single")
    expect(page.get_by_role("slider", name="Time")).to_be_hidden()
    expect(page.get_by_role("button", name="Beach")).to_be_visible()


def test_all_dry_is_said(opened: Callable[..., Page]) -> None:
    page = opened("dry")
    status = page.locator("[role=status]")
    expect(status).to_be_empty()
    page.get_by_role("button", name="Next step").click()
    expect(status).to_have_text("Nothing is under water at this time.")
    assert flat(page)[..., :3].max() == 0
    page.get_by_role("button", name="Previous step").click()
    expect(status).to_be_empty()


def test_the_pointer_reads_the_water(opened: Callable[..., Page]) -> None:
    page = opened("series")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    region = page.get_by_role("region", name="Pointer")
    page.mouse.move(*on_screen(page, *DEEP))
    deep = -float(flood_page.height(*map(np.array, DEEP)))
    expect(region).to_contain_text("Wet")
    said = region.inner_text()
    metres = float(said.split("Wet, ")[1].split(" m deep")[0])
    assert abs(metres - deep) < 2
    ground = re.search(r"ground −([\d.]+) m", said)
    assert ground is not None
    assert abs(float(ground[1]) - deep) < 2
    assert "water +0.00 m" in said
    x, y = (int(word.replace(",", "")) for word in re.findall(r"([\d,]+) [EN]", said))
    expected = flood_page.FRAME.to_source @ (*DEEP, 1.0)
    assert np.hypot(x - expected[0], y - expected[1]) < 60
    assert said.endswith("EPSG:32610")
    page.mouse.move(*on_screen(page, 0.5, 0.75))
    expect(region).to_contain_text("Dry")
    page.mouse.move(SMALL[0] - 3, SMALL[1] // 3)
    expect(region).to_have_text("Point at the ground or the water.")


def test_a_finger_reads_the_water_on_a_phone(opened: Callable[..., Page], screenshot: Callable[..., Path]) -> None:
    page = opened("series", (360, 640), has_touch=True, is_mobile=True)
    assert page.evaluate("vexture.flood.water.constructor.name !== ''")
    assert page.evaluate("vexture.flood.water.material.uniforms.mirrorSampler === undefined")
    assert page.evaluate("document.documentElement.scrollWidth") == 360
    view(page, "Plan")
    page.touchscreen.tap(*on_screen(page, *DEEP))
    expect(page.get_by_role("region", name="Pointer")).to_contain_text("Wet")
    expect(page.get_by_role("slider", name="Relief")).to_be_hidden()
    page.get_by_role("button", name="Settings").tap()
    expect(page.get_by_role("slider", name="Relief")).to_be_visible()
    screenshot(page)


def test_views_by_key_and_flight(opened: Callable[..., Page]) -> None:
    page = opened("series")
    page.keyboard.press("5")
    expect(page.get_by_role("button", name="Beach")).to_have_attribute("aria-pressed", "true")
    page.wait_for_function("""() => {
        const { camera } = vexture.flood;
        const { from } = vexture.flood.pose('Beach');
        return Math.hypot(camera.position.x - from.x, camera.position.y - from.y, camera.position.z - from.z) < 0.5;
    }""")
    page.keyboard.press("1")
    page.wait_for_function("vexture.flood.camera.position.y > 5")
    box = page.locator("canvas").bounding_box()
    assert box is not None
    page.mouse.move(box["width"] * 0.8, box["height"] * 0.6)  # between the panels
    page.mouse.down()
    page.mouse.up()
    expect(page.get_by_role("button", name="Plan")).to_have_attribute("aria-pressed", "false")
    drawn(page)
    stands = page.evaluate("vexture.flood.camera.position.y")
    for _ in range(5):
        drawn(page)
    assert page.evaluate("vexture.flood.camera.position.y") == pytest.approx(stands, abs=1.0)


def test_the_camera_stays_above_the_ground(opened: Callable[..., Page]) -> None:
    page = opened("series")
    page.evaluate("""() => {
        const { stage } = vexture.flood;
        stage.controls.target.set(0, 0, -24);
        stage.camera.position.set(0, -3, -27);
        stage.render();
    }""")
    y, ground = page.evaluate("""() => {
        const { camera, stage } = vexture.flood;
        return [camera.position.y, stage.surface.height(camera.position.x, camera.position.z)];
    }""")
    assert ground > 0.5  # heights are real, so they are as they are
    assert y > ground


def test_less_motion(opened: Callable[..., Page]) -> None:
    page = opened("series", WIDE, reduced_motion="reduce")
    page.evaluate("vexture.flood.freeze(null)")
    waves = page.get_by_role("button", name="Waves")
    expect(waves).to_have_attribute("aria-pressed", "false")
    stands = page.evaluate("vexture.flood.stage.seconds")
    page.get_by_role("button", name="Coast").click()
    assert page.evaluate("""() => {
        const { camera } = vexture.flood;
        return camera.position.distanceTo(vexture.flood.pose('Coast').from);
    }""") == pytest.approx(0, abs=0.01)
    assert page.evaluate("vexture.flood.stage.seconds") == stands
    waves.click()
    page.wait_for_function("(before) => vexture.flood.stage.seconds > before", arg=stands)


def test_relief_is_raised(opened: Callable[..., Page]) -> None:
    page = opened("series", WIDE)
    slider = page.get_by_role("slider", name="Relief")
    before = page.evaluate("vexture.flood.stage.land.mesh.scale.z")
    slider.press("End")
    assert page.evaluate("vexture.flood.stage.land.mesh.scale.z") > 1.5 * before
    assert page.evaluate("vexture.flood.stage.sea.water.scale.z") > 1.5 * before


def test_a_lost_driver_comes_back(opened: Callable[..., Page]) -> None:
    page = opened("series", errors=True)
    before = flat(page)[..., 0].mean()
    page.evaluate("""() => {
        window.lose = vexture.flood.stage.renderer.getContext().getExtension('WEBGL_lose_context');
        lose.loseContext();
    }""")
    expect(page.locator("[role=status]")).to_contain_text("waiting for it")
    page.evaluate("lose.restoreContext()")
    expect(page.locator("[role=status]")).to_be_empty()
    assert flat(page)[..., 0].mean() == pytest.approx(before, abs=0.5)


def test_without_webgl_2_it_says_so(open_page: Callable[..., Any], chromium: Any, pages: dict[str, str]) -> None:
    context = chromium.new_context(viewport={"width": 480, "height": 320})
    page = context.new_page()
    page.add_init_script(
        "HTMLCanvasElement.prototype.getContext = ((get) => function (kind, ...more) {"
        " return kind.startsWith('webgl') ? null : get.call(this, kind, ...more); })"
        "(HTMLCanvasElement.prototype.getContext)"
    )
    page.goto(pages["single"])
    expect(page.get_by_role("alert")).to_contain_text("WebGL 2")
    context.close()


def test_new_steps_of_a_server_become_steps(open_page: Callable[..., Any], tmp_path: Path) -> None:
    from server import serving

    def texture(level: float) -> bytes:
        return flood_page.convert(flood_page.wet(level)).to_ktx2()

    shapes = tmp_path / "shapes"
    shapes.mkdir()
    site = tmp_path / "site"
    site.mkdir()
    with serving(shapes) as server, served(site) as address:
        for name in ("flood%2F00", "flood%2F01"):
            assert server.put(name, texture(0.0))[0] in (200, 201)
        scene = flood_page.scene(1)
        scene["flood"]["steps"] = ["flood/00", "flood/01"]
        flood_page.write_page(site / "index.html", {"server": server.url, **scene}, policy=False)
        page = open_page(f"{address}/index.html", SMALL)
        page.set_default_timeout(PATIENCE)
        page.evaluate("vexture.flood.ready")
        page.evaluate("vexture.flood.freeze(2)")
        before = flat(page)[..., 0].mean()
        first = page.evaluate("vexture.flood.player.step.manifest.version")
        server.put("flood%2F00", texture(9.0))  # that is shown
        page.wait_for_function("(first) => vexture.flood.player.step.manifest.version !== first", arg=first)
        assert flat(page)[..., 0].mean() > 1.02 * before
        slider = page.get_by_role("slider", name="Time")
        page.evaluate("vexture.flood.step(0)")  # by hand: who went back is not carried away
        server.put("flood%2F10", texture(0.0))
        expect(slider).to_have_attribute("max", "2")
        expect(slider).to_have_value("0")
        expect(page.locator("[role=status]")).to_contain_text("There is newer water: flood/10.")
        slider.press("End")
        expect(slider).to_have_attribute("aria-valuetext", "flood/10, step 3 of 3")
        server.put("flood%2F11", texture(9.0))
        expect(slider).to_have_attribute("aria-valuetext", "flood/11, step 4 of 4")  # it follows at the end
        assert flat(page)[..., 0].mean() > 1.02 * before


def test_depths_as_colours_with_a_legend(opened: Callable[..., Page], screenshot: Callable[..., Path]) -> None:
    page = opened("series", WIDE)
    view(page, "Plan")
    page.get_by_label("Colours").select_option("depth")
    legend = page.get_by_label("Legend", exact=True)
    expect(legend.get_by_role("listitem")).to_have_text(["0 to 2 m", "2 to 20 m", "over 20 m"])
    drawn(page)
    x, y = on_screen(page, *DEEP)
    pixel = np.asarray(Image.open(screenshot(page)).convert("RGB"))[int(y), int(x)].astype(int)
    named = legend.locator(".swatch").nth(2).evaluate("(one) => getComputedStyle(one).backgroundColor")
    wanted = [int(part) for part in named.removeprefix("rgb(").removesuffix(")").split(",")]
    assert np.abs(pixel - wanted).max() < 40  # it is not quite opaque
    page.get_by_label("Colours").select_option("water")
    expect(legend).to_be_hidden()


def test_times_of_arrival(opened: Callable[..., Page]) -> None:
    page = opened("series", WIDE)
    page.get_by_label("Colours").select_option("arrival")
    expect(page.get_by_label("Legend", exact=True)).to_contain_text("First under water after")
    values = page.evaluate("vexture.flood.water.depthColors.classes.map(({ from }) => from)")
    assert values == pytest.approx([k / 3 for k in range(6)])


def test_a_chart_of_the_area_and_of_a_clicked_place(opened: Callable[..., Page]) -> None:
    page = opened("series", (900, 640))
    expect(page.locator(".chart .of")).to_contain_text("Area under water")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    page.mouse.click(*on_screen(page, *DEEP))
    expect(page.locator(".chart .of")).to_have_text(f"Water level at the marked place: 0.00 m to {LEVELS[-1]:.2f} m")
    page.get_by_role("button", name="Chart of the area").click()
    expect(page.locator(".chart .of")).to_contain_text("Area under water")


def test_a_link_opens_the_same_view(opened: Callable[..., Page]) -> None:
    page = opened("series", WIDE)
    page.evaluate("vexture.flood.step(2)")
    view(page, "Coast")
    page.get_by_label("Colours").select_option("smooth")
    page.get_by_role("button", name="Link").click()
    page.wait_for_function("location.hash !== ''")
    hash_ = page.evaluate("location.hash")
    again = opened("series", WIDE, hash_)
    again.wait_for_function("vexture.flood.player.index === 2")
    expect(again.get_by_role("button", name="Coast")).to_have_attribute("aria-pressed", "true")
    expect(again.get_by_label("Colours")).to_have_value("smooth")


def test_a_picture_has_its_size_and_what_is_written_on_it(opened: Callable[..., Page], tmp_path: Path) -> None:
    page = opened("series", WIDE)
    page.get_by_label("Size of pictures").select_option("1920 × 1080")
    found = {}
    for name in ("decorated", "plain"):
        page.get_by_label("with title, legend and source").set_checked(name == "decorated")
        with page.expect_download() as download:
            page.get_by_role("button", name="Picture").click()
        assert download.value.suggested_filename == "A-bay-of-formulas.png"
        download.value.save_as(tmp_path / f"{name}.png")
        found[name] = np.asarray(Image.open(tmp_path / f"{name}.png").convert("RGB")).astype(int)
    assert found["plain"].shape == (1080, 1920, 3)
    off = np.abs(found["decorated"] - found["plain"]).max(axis=2) > 30
    assert off[:100, :400].any()
    assert off[-120:, -300:].any()
    assert not off[300:800, 500:1500].any()
    assert page.evaluate("[vexture.flood.stage.size.width, vexture.flood.stage.size.height]") == list(WIDE)
