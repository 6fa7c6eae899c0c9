"""Texts of `vexture/text` and `vexture/webgpu` in a real browser, against the exact renderer."""

import base64
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from text_site import fill_text_site, font

import vexture
from chromium import serve_folder
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact

WORD = "Hafen &ĝ5"
BACKENDS = ("webgl", "fallback", "webgpu")
SIZE = (160, 60)
CLOSE = 1.0 / 255
"""At least; what differs is the tolerance of outlines and their rounding."""

STEEP = 4.0 / 255
"""In perspective, pixels are parallelograms only nearly."""

SNAPPED = 1 / 16
"""The software adapter of WebGPU puts vertices on sixteenths of a pixel, and a glyph's edges with them."""

Picture = NDArray[np.float64]


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    with serve_folder(made_once("text", fill_text_site)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    page = open_page(f"{address}/text.html", keep=True)
    page.wait_for_function("globalThis.drawn")
    return page


@cache
def letters(word: str) -> Drawing:
    return vexture.text(word)


def exact_letters(word: str, clip: list[list[float]], size: tuple[int, int]) -> Picture:
    """Coverage of the letters of a word, each exact, and composited as a renderer composites what it draws.

    `clip` maps x, y and 1 of the text, in ems from the start of its baseline, to clip space.
    """
    drawing = letters(word)
    (a, b, c), (d, e, f) = np.asarray(drawing.to_source)
    ems = np.array([[a, b, c], [-d, -e, -f], [0.0, 0.0, 1.0]])  # y up
    columns = np.array(clip).T[[0, 1, 3]]
    width, height = size
    pixels = np.array([[width / 2, 0, width / 2], [0, -height / 2, height / 2], [0, 0, 1]]) @ columns @ ems
    view = np.linalg.inv(pixels)
    view /= np.abs(view).max() * np.sign((view @ (width / 2, height / 2, 1))[2])
    rest = np.ones((height, width))
    for path in drawing.paths:
        rest *= 1.0 - render_exact(Drawing((path,)), size, view)
    return 1.0 - rest


def picture(seen: dict[str, Any], size: tuple[int, int]) -> Picture:
    values = np.frombuffer(base64.b64decode(seen["pixels"]), np.float32)
    return values.reshape(size[1], size[0], 4).astype(float)


def turned(angle: float, axis: str) -> list[float]:
    """A rotation around an axis, column by column."""
    c, s = float(np.cos(angle)), float(np.sin(angle))
    matrix = np.eye(4)
    i, j = {"z": (0, 1), "x": (1, 2)}[axis]
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return [float(value) for value in matrix.T.ravel()]


def level(em: float) -> dict[str, Any]:
    """A camera in which an em is so many pixels; the baseline begins near the picture's lower left corner."""
    left, bottom = -8.3 / em, -17.6 / em
    return {"left": left, "right": left + SIZE[0] / em, "bottom": bottom, "top": bottom + SIZE[1] / em}


SLANTED = {"perspective": True, "fov": 40, "aspect": SIZE[0] / SIZE[1], "eye": [1, -3, 2], "at": [2, 0.3, 0]}

VIEWS = {
    "upright, 9 px": (level(9), None),
    "upright, 20 px": (level(20), None),
    "upright, 200 px": (level(200), None),
    "turned": (level(21), turned(0.4, "z")),
    "tilted": (level(30), turned(-1.2, "x")),
    "in perspective": (SLANTED, None),
}


def drawn(page: Any, **described: Any) -> dict[str, Any]:
    seen: dict[str, Any] = page.evaluate("described => draw(described)", described)
    return seen


def word_options(**more: Any) -> dict[str, Any]:
    return {"text": WORD, "font": "font.ttf", "anchorY": "top-baseline", "color": 0xFFFFFF} | more


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", VIEWS)
def test_a_word_is_exact_in_every_view(page: Any, name: str, backend: str) -> None:
    camera, matrix = VIEWS[name]
    seen = drawn(page, backend=backend, options=word_options(), camera=camera, matrix=matrix, size=SIZE)
    found, wanted = picture(seen, SIZE)[..., 3], exact_letters(WORD, seen["clip"], SIZE)
    assert wanted.max() > 0.9
    close = SNAPPED if backend == "webgpu" else STEEP if name == "in perspective" else CLOSE
    assert np.abs(found - wanted).max() < close
    assert seen["flat"] is (name not in ("turned", "in perspective"))


WHOLE = {"left": 0, "right": 320, "bottom": -120, "top": 0}


def ink(seen: dict[str, Any], size: tuple[int, int] = (320, 120)) -> Picture:
    """Picture of a text, straight colours weighted by their opacity."""
    return picture(seen, size)


def bounds(shown: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """First and last column and row."""
    rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    return int(columns[0]), int(columns[-1]), int(rows[0]), int(rows[-1])


def test_a_clipped_text_ends_at_its_rectangle(page: Any) -> None:
    options = word_options(fontSize=60, anchorY="top", clipRect=[30, -60, 120, -30])
    seen = ink(drawn(page, options=options, camera=WHOLE, size=(320, 120)))[..., 3]
    assert bounds(seen > 0.3) == (30, 119, 30, 59)
    whole = ink(drawn(page, options=options | {"clipRect": None}, camera=WHOLE, size=(320, 120)))[..., 3]
    inside = (slice(31, 59), slice(31, 119))
    assert np.abs(seen[inside] - whole[inside]).max() < CLOSE


def test_ranges_of_characters_have_colours_of_their_own(page: Any) -> None:
    options = word_options(text="AB CD", fontSize=60, colorRanges={0: 0xFF0000, 3: 0x0000FF})
    seen = drawn(page, options=options, camera=WHOLE | {"bottom": -80, "top": 40}, size=(320, 120))
    pixels = ink(seen)
    start = int(seen["layout"]["carets"][4 * 3])
    assert pixels[:, : start - 1, 2].max() == 0.0
    assert pixels[:, : start - 1, 0].max() > 0.9
    assert pixels[:, start + 1 :, 0].max() == 0.0
    assert pixels[:, start + 1 :, 2].max() > 0.9


@pytest.mark.parametrize("backend", BACKENDS)
def test_labels_are_drawn_by_one_call_as_texts_are(page: Any, backend: str) -> None:
    """Each in its place, size, turn and colour; what is hidden, or has left, is not there."""
    angle = 0.3
    quaternion = [0, 0, np.sin(angle / 2), np.cos(angle / 2)]
    label = {"text": WORD, "position": [40, -70, 0], "scale": 30, "quaternion": quaternion}
    hidden = {"text": "hidden", "position": [0, -30, 0], "scale": 30, "visible": False}
    options = {"font": "font.ttf", "anchorY": "top-baseline"}
    seen = drawn(page, backend=backend, options=options, labels=[label, hidden], camera=WHOLE, size=(320, 120))
    matrix = np.array(turned(angle, "z")).reshape(4, 4).T @ np.diag([30, 30, 30, 1.0])
    matrix[:3, 3] = label["position"]
    alone = drawn(
        page, backend=backend, options=word_options(), matrix=[*matrix.T.ravel()], camera=WHOLE, size=(320, 120)
    )
    assert np.abs(ink(seen) - ink(alone)).max() < CLOSE
    assert ink(seen)[..., 3].max() > 0.9
    if backend == "webgl":
        assert seen["calls"] == 1


@pytest.mark.parametrize("backend", BACKENDS)
def test_sprites_have_their_size_in_pixels_at_any_depth_and_angle(page: Any, backend: str) -> None:
    camera = {"perspective": True, "fov": 50, "aspect": 320 / 120, "eye": [3, 2, 4], "at": [0, 0, 0]}
    options = {"font": "font.ttf", "anchorX": "center", "anchorY": "middle", "fontSize": 40, "text": "Hx"}
    sizes = []
    for place in ([0.0, 0.0, 0.0], [-1.5, -1.0, -2.0]):
        described = {"options": options | {"sprites": True, "pixels": True}, "labels": [{"position": place}]}
        seen = ink(drawn(page, backend=backend, camera=camera, size=(320, 120), **described))[..., 3]
        left, right, top, bottom = bounds(seen > 0.5)
        sizes.append((right - left, bottom - top))
    assert abs(sizes[0][1] - 0.714 * 40) <= 1.5  # the height of capitals
    assert np.abs(np.subtract(*sizes)).max() <= 1


def test_the_last_of_several_changes_is_shown(page: Any) -> None:
    shown = page.evaluate("""async () => {
        const text = new Text({ glyphs, font: 'font.ttf', text: 'one' });
        const first = text.sync();
        text.text = 'seventeen';
        await first;
        text.text = 'two';
        text.text = 'to';
        const counts = [text.geometry.instanceCount];
        await text.sync();
        counts.push(text.geometry.instanceCount, text.layout.shapes.length);
        text.text = '';
        await text.sync();
        counts.push(text.geometry.instanceCount);
        text.dispose();
        return counts;
    }""")
    assert shown == [9, 2, 2, 0]


def test_rays_and_clicks_find_characters(page: Any) -> None:
    found = page.evaluate("""async () => {
        const text = new Text({ glyphs, font: 'font.ttf', text: 'AV ffi', fontSize: 10, anchorY: 'top-baseline' });
        await text.sync();
        text.position.set(3, 0, 0);
        text.updateMatrixWorld();
        const ray = new THREE.Raycaster(), { carets } = text.layout;
        const middle = (index) => 3 + (carets[4 * index] + carets[4 * index + 1]) / 2;
        const at = (x, y) => {
          ray.set(new THREE.Vector3(x, y, 5), new THREE.Vector3(0, 0, -1));
          return ray.intersectObject(text).map(({ charIndex, distance }) => [charIndex, distance]);
        };
        return {
          letters: [0, 1, 3].map((index) => at(middle(index), 3)), blank: at(middle(2), 3), beside: at(2, 3),
          caret: getCaretAtPoint(text.layout, carets[4 * 4] - 0.1, 3).charIndex,
          rectangles: getSelectionRects(text.layout, 0, 2), width: carets[4 * 1 + 1],
        };
    }""")
    assert [hits[0][0] for hits in found["letters"]] == [0, 1, 3]
    assert found["letters"][0][0][1] == pytest.approx(5)
    assert found["blank"][0][0] == -1
    assert found["beside"] == []
    assert found["caret"] == 4
    (rectangle,) = found["rectangles"]
    assert (rectangle["left"], rectangle["right"]) == (0, pytest.approx(found["width"]))


WRONG = {
    "no address": ({"text": "a", "font": 7}, "a font is 7; give the address"),
    "not there": ({"text": "a", "font": "nothing.ttf"}, "nothing.ttf"),
    "no font file": ({"text": "a", "font": "text.js"}, "text.js"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_text_that_cannot_be_set_says_why_in_one_line(address: str, open_page: Callable[..., Any], name: str) -> None:
    options, words = WRONG[name]
    page = open_page(f"{address}/text.html", errors=True)
    page.wait_for_function("globalThis.drawn")
    message = page.evaluate(
        """async (options) => {
        const text = new Text({ glyphs: makeGlyphs(), ...options });
        return text.sync().then(() => 'shown', (error) => [error.name, error.message, text.error.message]);
    }""",
        options,
    )
    assert message[0] == "VextureError"
    assert message[1] == message[2]
    assert words in message[1]
    assert "\n" not in message[1]
    assert ";" in message[1]


@pytest.mark.parametrize("option", ["fontsize", "fontSize", "anchorX", "textAlign", "clipRect", "lineHeight"])
def test_a_wrong_option_is_refused_with_its_name(page: Any, option: str) -> None:
    message = page.evaluate(
        "option => { try { new Text({ glyphs, [option]: 'wide' }); } catch (error) { return error.message; } }", option
    )
    assert option in message
    assert ";" in message


def test_a_baked_font_sets_the_same_text_without_a_worker(page: Any) -> None:
    characters = "".join(sorted(set("AVWA Tolé, wrapped at blanks")))
    words, centred = "AVWA Tolé,\nwrapped at blanks", {"anchorY": "middle", "anchorX": "center", "textAlign": "center"}
    options = word_options(text=words, fontSize=30, maxWidth=180, **centred)
    size, camera = (320, 180), {"left": -160, "right": 160, "bottom": -90, "top": 90}
    described = {"characters": characters, "options": options, "camera": camera, "size": size}
    seen = page.evaluate("described => bake(described)", described)
    baked, full = (picture({"pixels": pixels}, size) for pixels in seen["pixels"])
    assert full[..., 3].max() > 0.9
    assert np.abs(baked - full).max() < CLOSE
    for name in ("blockBounds", "visibleBounds", "carets", "clusters", "lineHeight"):
        assert seen["layouts"][0][name] == pytest.approx(seen["layouts"][1][name], abs=1e-3), name
    assert seen["metrics"]["kerning"]["A"]["V"] < -0.01


def test_a_font_that_python_bakes_is_set_as_well(page: Any, address: str) -> None:
    atlas = vexture.font_atlas(font=font(), characters="AVWé o")
    metrics = page.evaluate("metrics => { globalThis.baked = metrics; return Object.keys(metrics); }", atlas.metrics)
    assert {"glyphs", "kerning", "lines", "notdef"} <= set(metrics)
    carets = page.evaluate("""async () => {
        const text = new Text({ glyphs, font: 'font.ttf', text: 'AVWéo', anchorY: 'top-baseline' });
        await text.sync();
        const font = new AtlasFont({ roots: Array(99).fill({}), isVectorTexture: true }, baked);
        const layout = font.typeset({ ...request, text: 'AVWéo' });
        return [[...text.layout.carets], [...layout.carets]];
    }""")
    assert carets[0] == pytest.approx(carets[1], abs=1e-3)


def test_texts_stay_as_they_are_when_glyphs_are_forgotten(page: Any) -> None:
    shown = page.evaluate("""async () => {
        const own = makeGlyphs({ budget: 20000 });
        const keep = new Text({ glyphs: own, font: 'font.ttf', text: 'Keep me ABC' });
        await keep.sync();
        const names = () => [...keep.layout.shapes].map((shape) => own.texture.roots[shape].name);
        const before = names();
        let most = 0;
        for (let k = 0; k < 12; k++) {
            const word = Array.from({ length: 30 }, (_, n) => String.fromCodePoint(0x100 + 30 * k + n)).join('');
            const other = new Text({ glyphs: own, font: 'font.ttf', text: word });
            await other.sync();
            most = Math.max(most, own.texture.roots.length);
            other.dispose();
        }
        await keep.sync();
        own.dispose();
        return { before, after: names(), most, last: own.texture.roots.length };
    }""")
    assert shown["after"] == shown["before"]
    assert shown["last"] < shown["most"], "nothing was forgotten"


def test_a_copy_shows_the_same_and_is_independent(page: Any) -> None:
    found = page.evaluate("""async () => {
        const material = new THREE.MeshStandardMaterial(), group = new THREE.Group();
        const text = new Text({ glyphs, font: 'font.ttf', text: 'one', color: 0xff0000, outlineWidth: 0.05, material });
        group.add(text);
        await text.sync();
        const copy = group.clone().children[0];
        copy.text = 'three';
        await copy.sync();
        const seen = [text, copy].map((one) => [one.text, one.geometry.instanceCount, one.material.type,
            one.material.color.getHex(), one.children.length, one.customDepthMaterial?.type]);
        copy.dispose();
        text.dispose();
        return seen;
    }""")
    standard = ["MeshStandardMaterial", 0xFF0000, 1, "MeshDepthMaterial"]
    assert found == [["one", 3, *standard], ["three", 5, *standard]]


def test_ranges_of_colours_can_be_set_and_taken_back_later(page: Any) -> None:
    """Programs with and without colours of vertices are two."""
    pixels = page.evaluate("""async () => {
        const renderer = new THREE.WebGLRenderer(), scene = new THREE.Scene(), seen = [];
        renderer.setSize(64, 32);
        const camera = new THREE.OrthographicCamera(0, 2, 0, -1, -1, 1), gl = renderer.getContext();
        const text = new Text({ glyphs, font: 'font.ttf', text: '\u2588\u2588', color: 0x0000ff, letterSpacing: 0.2 });
        scene.add(text);
        const look = async () => {
            await text.sync();
            renderer.render(scene, camera);
            const bytes = new Uint8Array(4 * 64 * 32), colors = new Set();
            gl.readPixels(0, 0, 64, 32, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
            for (let k = 0; k < bytes.length; k += 4) {
                if (bytes[k] > 200) colors.add('red');
                else if (bytes[k + 2] > 200) colors.add('blue');
            }
            seen.push([...colors].sort().join());
        };
        text.text = 'MM';
        await look();
        text.colorRanges = { 1: 0xff0000 };
        await look();
        text.color = 0xff0000;
        await look();
        text.colorRanges = null;
        text.color = 0x0000ff;
        await look();
        text.dispose();
        renderer.dispose();
        return seen;
    }""")
    assert pixels == ["blue", "blue,red", "red", "blue"]
