"""The page of a flood in a real browser: water on a beach in a wooden box, its steps, its read-out, its bad days."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import flood_page
import numpy as np
import pytest
from flood_seen import DEEP, PATIENCE, SMALL, WIDE, flat, on_screen, view
from PIL import Image
from playwright.sync_api import Page, expect
from waiting import drawn

from chromium import serve_folder

PRESETS = ("Plan", "Overview", "Coast", "Shore", "Beach")
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


@pytest.mark.long
@pytest.mark.parametrize("size", [(740, 420), pytest.param((390, 844), marks=pytest.mark.slow)])
def test_every_preset_shows_water_and_land(
    opened_flood: Callable[..., Page], screenshot: Callable[..., Path], size: tuple[int, int]
) -> None:
    page = opened_flood("series", size, bypass_csp=False)
    assert page.title() == "A bay of formulas"
    for preset in PRESETS:
        page.evaluate("vexture.flood.flat(false)")
        view(page, preset)
        picture = np.asarray(Image.open(screenshot(page, f"{size[0]}-{preset}")).convert("RGB"))
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 5000
        water = flat(page)[..., 0].mean() / 255
        assert 0.04 < water < 0.8, preset


def test_flat_water_is_where_the_texture_is(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", query="?bare")
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


@pytest.mark.slow
def test_no_picture_is_without_water_while_stepping(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
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


def test_steps_by_hand(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
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


def test_the_next_step_is_loaded_before_it_is_shown(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
    uploaded = """async (at) => {
        const { player, stage } = vexture.flood;
        await new Promise((go) => setTimeout(go, 200));
        const { texture } = await player.steps.open(player.names[at]);
        return stage.renderer.properties.has(texture.textures.texels);
    }"""
    assert page.evaluate(uploaded, 1)
    assert not page.evaluate(uploaded, 2)


@pytest.mark.slow
def test_one_step_has_no_time_bar(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("single")
    expect(page.get_by_role("slider", name="Time")).to_be_hidden()
    expect(page.get_by_role("button", name="Beach")).to_be_visible()


def test_all_dry_is_said(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("dry")
    status = page.locator("[role=status]")
    expect(status).to_be_empty()
    page.get_by_role("button", name="Next step").click()
    expect(status).to_have_text("Nothing is under water at this time.")
    assert flat(page)[..., :3].max() == 0
    page.get_by_role("button", name="Previous step").click()
    expect(status).to_be_empty()


def test_the_pointer_reads_the_water(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
    page.evaluate("vexture.flood.relief(0)")
    view(page, "Plan")
    region = page.get_by_role("region", name="Pointer")
    page.mouse.move(*on_screen(page, *DEEP))
    deep = -float(flood_page.height(*map(np.array, DEEP)))
    expect(region).to_contain_text("Wet")
    said = region.inner_text()
    (metres,) = re.findall(r"Wet, ([\d.]+\.\d\d) m deep", said)
    assert abs(float(metres) - deep) < 0.5  # a pixel is 11 m wide there
    ground = re.search(r"ground −([\d.]+) m", said)
    assert ground is not None
    assert abs(float(ground[1]) - deep) < 2
    assert "water +0.00 m" in said
    x, y = (int(word.replace(",", "")) for word in re.findall(r"([\d,]+) [EN]", said))
    expected = flood_page.FRAME.to_source @ (*DEEP, 1.0)
    assert np.hypot(x - expected[0], y - expected[1]) < 60
    assert said.endswith("EPSG:32610")
    page.mouse.move(*on_screen(page, 0.5, 0.7))
    expect(region).to_contain_text("Dry")
    page.mouse.move(SMALL[0] - 3, SMALL[1] // 3)
    expect(region).to_have_text("Point at the ground or the water.")


@pytest.mark.slow
def test_a_finger_reads_the_water_on_a_phone(
    opened_flood: Callable[..., Page], screenshot: Callable[..., Path]
) -> None:
    page = opened_flood("series", (360, 640), has_touch=True, is_mobile=True)
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
    below, above = page.evaluate("""[document.querySelector('.panel').getBoundingClientRect().bottom,
        document.querySelector('.bearings').getBoundingClientRect().top]""")
    page.touchscreen.tap(30, (below + above) / 2)  # the map is what is looked at then
    expect(page.get_by_role("slider", name="Relief")).to_be_hidden()


@pytest.mark.slow
def test_nothing_covers_the_plan_on_a_phone(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", (390, 844), has_touch=True, is_mobile=True)
    page.evaluate("vexture.flood.colours('depth')")
    view(page, "Plan")
    panel, legend, bearings = page.evaluate("""['.panel', '.legend', '.bearings'].map((name) => {
        const { top, bottom } = document.querySelector(name).getBoundingClientRect();
        return { top, bottom };
    })""")
    corners = [on_screen(page, east, north) for east in (0.0, 1.0) for north in (0.0, 1.0)]
    assert legend["bottom"] > legend["top"]
    for _, y in corners:
        assert panel["bottom"] < y < min(legend["top"], bearings["top"])


@pytest.mark.slow
def test_nothing_stands_over_the_time_on_a_phone(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", (390, 640), has_touch=True, is_mobile=True)
    tops = """async () => {
        await new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)));
        const box = (name) => document.querySelector(name).getBoundingClientRect();
        return [box('.bearings').bottom, box('.time').top];
    }"""
    bearings, time = page.evaluate(tops)
    assert 0 < time - bearings < 20
    page.evaluate("document.querySelector('.when').textContent = 'Wednesday 23 September 2026 09:00 UTC'")
    lower, higher = page.evaluate(tops)
    assert higher < time - 10  # in more lines
    assert lower < higher


@pytest.mark.slow
def test_views_by_key_and_flight(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
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


def test_the_camera_stays_above_the_ground(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series")
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


@pytest.mark.slow
def test_less_motion(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", WIDE, reduced_motion="reduce")
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


@pytest.mark.slow
def test_the_mirror_is_smooth(opened_flood: Callable[..., Page]) -> None:
    """Hills in calm water would have steps: the mirror's image is smaller than the page, and seen at a slant."""
    page = opened_flood("series", WIDE)
    view(page, "Shore")
    size = page.evaluate("""() => {
        const { stage, water, render } = vexture.flood;
        const { renderTarget } = water.material.uniforms.mirrorSampler.value;
        stage.tray.group.visible = stage.land.sides.visible = stage.sea.walls.visible = false;
        Object.assign(stage.land.mesh.material, { map: null, needsUpdate: true }).color.set(0x000000);
        render();
        const { width, height } = renderTarget;
        window.halves = new Uint16Array(4 * width * height);
        stage.renderer.readRenderTargetPixels(renderTarget, 0, 0, width, height, halves);
        return [height, width, 4];
    }""")
    numbers = page.evaluate("Array.from(halves)")
    seen = np.array(numbers, np.uint16).view(np.float16).reshape(size)[..., 0].astype(float)
    edges = (seen[:-2] < 1e-3) & (seen[2:] > 0.05)  # black land, and two pixels from it the sky
    assert edges.sum() > 50
    assert ((seen[1:-1] > 1e-3) & (seen[1:-1] < 0.9 * seen[2:]))[edges].mean() > 0.3


@pytest.mark.slow
def test_relief_is_raised(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", WIDE)
    slider = page.get_by_role("slider", name="Relief")
    before = page.evaluate("vexture.flood.stage.land.mesh.scale.z")
    slider.press("End")
    assert page.evaluate("vexture.flood.stage.land.mesh.scale.z") > 1.5 * before
    assert page.evaluate("vexture.flood.stage.sea.water.scale.z") > 1.5 * before


def test_a_lost_driver_comes_back(opened_flood: Callable[..., Page]) -> None:
    page = opened_flood("series", errors=True)
    before = flat(page)[..., 0].mean()
    page.evaluate("""() => {
        window.lose = vexture.flood.stage.renderer.getContext().getExtension('WEBGL_lose_context');
        lose.loseContext();
    }""")
    expect(page.locator("[role=status]")).to_contain_text("waiting for it")
    page.evaluate("lose.restoreContext()")
    expect(page.locator("[role=status]")).to_be_empty()
    assert flat(page)[..., 0].mean() == pytest.approx(before, abs=0.5)


def test_without_webgl_2_it_says_so(open_page: Callable[..., Any], chromium: Any, flood_pages: dict[str, str]) -> None:
    context = chromium.new_context(viewport={"width": 480, "height": 320})
    page = context.new_page()
    page.add_init_script(
        "HTMLCanvasElement.prototype.getContext = ((get) => function (kind, ...more) {"
        " return kind.startsWith('webgl') ? null : get.call(this, kind, ...more); })"
        "(HTMLCanvasElement.prototype.getContext)"
    )
    page.goto(flood_pages["single"])
    expect(page.get_by_role("alert")).to_contain_text("WebGL 2")
    context.close()


@pytest.mark.slow
def test_new_steps_of_a_server_become_steps(open_page: Callable[..., Any], tmp_path: Path) -> None:
    from server import serving

    def texture(level: float) -> bytes:
        return flood_page.convert(flood_page.wet(level)).to_ktx2()

    shapes = tmp_path / "shapes"
    shapes.mkdir()
    site = tmp_path / "site"
    site.mkdir()
    with serving(shapes) as server, serve_folder(site) as address:
        for name in ("flood%2F00", "flood%2F01"):
            assert server.put(name, texture(0.0))[0] in (200, 201)
        scene = flood_page.scene(1)
        scene["flood"]["steps"] = ["flood/00", "flood/01"]
        flood_page.write_page(site / "index.html", {"server": server.url, **scene}, policy=False)
        page = open_page(f"{address}/index.html", SMALL)
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


@pytest.mark.slow
def test_ground_has_a_grain_where_its_picture_has_no_more_to_show(
    opened_flood: Callable[..., Page], screenshot: Callable[..., Path]
) -> None:
    """Next to the eye its colours differ from pixel to pixel; those of the picture alone do so by 0.04."""
    page = opened_flood("single", WIDE, "?bare")
    page.evaluate("vexture.flood.freeze(0)")
    view(page, "Beach")
    at_rest = np.asarray(Image.open(screenshot(page, "beach")).convert("L")).astype(float)
    ground = flat(page)[..., 0] == 0
    page.evaluate("vexture.flood.flat(false)")
    near = ground & (np.arange(WIDE[1])[:, None] > 0.75 * WIDE[1])
    assert near.sum() > 10_000
    change = np.abs(np.diff(at_rest, axis=1))[near[:, 1:] & near[:, :-1]]
    assert change.mean() > 0.5
