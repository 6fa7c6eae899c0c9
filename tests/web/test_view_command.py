"""`vexture view` and `vexture export` as a designer uses them: real processes, real files, a real browser."""

import io
import re
import subprocess

import httpx
import numpy as np
import pytest
from PIL import Image
from waiting import drawn

from viewing import PATIENCE, SHAPES, VEXTURE, until, viewing

RED, BLUE, GREEN = (208, 0, 0), (0, 0, 208), (0, 144, 0)
SIZE = (400, 400)
MIDDLE, CORNER = (200, 200), (60, 60)


def square(color):
    return drawing('<rect x="1" y="1" width="8" height="8" fill="rgb{}"/>', color)


def disc(color):
    return drawing('<circle cx="5" cy="5" r="4" fill="rgb{}"/>', color)


def drawing(element, color):
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{element.format(color)}</svg>'.encode()


def pixels(page):
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))


def color_at(page, place):
    return tuple(int(channel) for channel in pixels(page)[place[1], place[0]])


def shown(page, color, *, corner):
    """Whether the shape is of a colour, and reaches into the corner of the square or does not."""
    in_corner = color_at(page, CORNER)
    return color_at(page, MIDDLE) == color and (in_corner == color if corner else in_corner not in (color, RED, BLUE))


def note(page):
    return page.locator("[role=status]").text_content()  # where it is empty it is not shown, so has no role


def ready(page):
    page.wait_for_function("window.vexture?.viewer?.ready", timeout=1000 * PATIENCE)
    page.evaluate("window.vexture.viewer.ready")
    return page


def drop(page, name, content):
    """Let a file fall on the page."""
    data = page.evaluate_handle(
        "([name, text]) => { const data = new DataTransfer(); data.items.add(new File([text], name)); return data; }",
        [name, content.decode()],
    )
    for event in ("dragenter", "dragover", "drop"):
        page.dispatch_event("#app", event, {"dataTransfer": data})


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_bytes(square(RED))
    return file


def test_saving_a_drawing_shows_it(tmp_path, logo, open_page, screenshot):
    with viewing(tmp_path, logo, "--watch") as running:
        page = ready(open_page(f"{running.url}?bare", SIZE))
        until(lambda: shown(page, RED, corner=True))
        other = tmp_path / "logo.svg.new"
        other.write_bytes(disc(BLUE))
        other.replace(logo)
        until(lambda: shown(page, BLUE, corner=False))
        logo.write_bytes(square(BLUE))
        until(lambda: shown(page, BLUE, corner=True))
        screenshot(page)


WATCH = """() => {
  const { engine } = vexture.viewer;
  const gl = engine.renderer.getContext();
  const render = engine.render.bind(engine);
  window.middles = [];
  engine.render = () => {
    render();
    const pixel = new Uint8Array(4);
    gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    middles.push([...pixel.subarray(0, 3)].join());
  };
}"""
"""Write down the pixel in the middle of each picture, which is inside of every shape here."""


@pytest.mark.slow
def test_no_picture_is_blank_between_two_shapes(tmp_path, logo, open_page):
    with viewing(tmp_path, logo, "--watch") as running:
        page = ready(open_page(f"{running.url}?bare", SIZE))
        until(lambda: shown(page, RED, corner=True))
        page.evaluate(WATCH)
        for content, color in ((disc, BLUE), (square, RED), (disc, BLUE)):
            logo.write_bytes(content(color))
            until(lambda color=color, corner=content is square: shown(page, color, corner=corner))
        drawn(page)
        assert set(page.evaluate("middles")) == {",".join(map(str, color)) for color in (RED, BLUE)}


@pytest.mark.slow
def test_drawing_that_is_broken_becomes_a_note_and_the_picture_stays(tmp_path, logo, open_page, screenshot):
    with viewing(tmp_path, logo, "--watch") as running:
        page = ready(open_page(f"{running.url}?bare", SIZE))
        until(lambda: shown(page, RED, corner=True))
        logo.write_bytes(b"<svg")
        until(lambda: "not well-formed XML" in note(page))
        assert shown(page, RED, corner=True)
        screenshot(page)
        logo.write_bytes(disc(BLUE))
        until(lambda: shown(page, BLUE, corner=False))


@pytest.mark.slow
def test_every_page_is_told_and_one_opened_later_sees_the_note(tmp_path, logo, open_page):
    with viewing(tmp_path, logo, "--watch") as running:
        pages = [ready(open_page(f"{running.url}?bare", SIZE)) for _ in range(2)]
        logo.write_bytes(disc(BLUE))
        for page in pages:
            until(lambda page=page: shown(page, BLUE, corner=False))
        logo.write_bytes(b"<svg")
        for page in pages:
            until(lambda page=page: "not well-formed XML" in note(page))
        late = ready(open_page(f"{running.url}?bare", SIZE))
        until(lambda: "not well-formed XML" in note(late))
        assert shown(late, BLUE, corner=False)


def test_dropped_drawing_is_shown(tmp_path, logo, open_page, screenshot):
    with viewing(tmp_path, logo) as running:
        page = ready(open_page(running.url, (900, 400)))
        before = pixels(page)
        drop(page, "badge.svg", disc(GREEN))
        until(lambda: (pixels(page) == GREEN).all(axis=2).sum() > 10_000)
        assert not (before == GREEN).all(axis=2).any()
        assert page.get_by_role("heading", level=1).inner_text() == "badge"
        assert running.get("shapes").json()["shapes"] == ["logo", "badge"]
        screenshot(page)


def test_dropped_file_that_is_no_drawing_is_a_note(tmp_path, logo, open_page):
    with viewing(tmp_path, logo) as running:
        page = ready(open_page(f"{running.url}?bare", SIZE, errors=True))
        until(lambda: shown(page, RED, corner=True))
        drop(page, "notes.txt", b"no drawing")
        until(lambda: "notes.txt: holds nothing that can be read" in note(page))
        assert color_at(page, CORNER) == RED  # the note is over the middle
        assert running.get("shapes").json()["shapes"] == ["logo"]


def test_page_says_when_the_server_is_gone_and_keeps_its_picture(tmp_path, logo, open_page, screenshot):
    with viewing(tmp_path, logo, "--watch") as running:
        page = ready(open_page(f"{running.url}?bare", SIZE, errors=True))
        until(lambda: shown(page, RED, corner=True))
        running.process.kill()
        running.process.wait()
        until(lambda: "offline" in note(page).lower())
        assert shown(page, RED, corner=True)
        screenshot(page)
    logo.write_bytes(disc(BLUE))
    with viewing(tmp_path, logo, "--watch", "--port", httpx.URL(running.url).port):
        until(lambda: shown(page, BLUE, corner=False))
        until(lambda: "offline" not in note(page).lower())


def test_thesis_encoding_of_the_server_can_be_compared_with(tmp_path, open_page, screenshot):
    with viewing(tmp_path, SHAPES / "duck.svg") as running:
        page = ready(open_page(running.url, (900, 600)))
        with (
            page.expect_response(re.compile(r"/thesis8\.quads\.png$"), timeout=1000 * PATIENCE) as quads,
            page.expect_response(re.compile(r"/thesis8\.curves\.png$"), timeout=1000 * PATIENCE) as curves,
        ):
            page.get_by_label("Compare with").select_option("8-bit original method (2018)")
        assert (quads.value.status, curves.value.status) == (200, 200)
        until(lambda: page.get_by_role("slider", name="Divider").is_visible())
        screenshot(page)


def test_exported_page_shows_its_shapes_from_disk_and_fetches_nothing(tmp_path, logo, open_page, screenshot):
    other = tmp_path / "disc.svg"
    other.write_bytes(disc(BLUE))
    path = tmp_path / "logos.html"
    command = [*VEXTURE, "export", str(logo), str(other), "-o", str(path)]
    assert subprocess.run(command, capture_output=True, check=False).returncode == 0
    page = ready(open_page(f"{path.as_uri()}?bare", SIZE))
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.reload()
    ready(page)
    until(lambda: shown(page, RED, corner=True))
    page.evaluate("window.vexture.viewer.state.update({ shape: 'disc' })")
    until(lambda: shown(page, BLUE, corner=False))
    assert [url for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert len([url for url in asked if url.startswith("file:")]) == 1
    screenshot(page)
