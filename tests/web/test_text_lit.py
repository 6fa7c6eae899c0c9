"""Texts in light and colour: their shadows, their normals, and the rays that meet them, wherever they are bent to."""

import base64
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_color_glyphs import GREEN, color_font, glyph, layers, solid
from text_site import fill_text_site

from chromium import serve_folder

SHADOW = """async (kind) => {
    const renderer = new THREE.WebGLRenderer(), scene = new THREE.Scene(), side = 128;
    renderer.setSize(side, side);
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.BasicShadowMap;
    const camera = new THREE.OrthographicCamera(-2, 2, 2, -2, 0, 20);
    camera.position.z = 10;
    const wall = new THREE.Mesh(new THREE.PlaneGeometry(8, 8), new THREE.MeshLambertMaterial());
    wall.receiveShadow = true;
    const sun = new THREE.DirectionalLight(0xffffff, 3);
    sun.position.set(0, 6, 6);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    Object.assign(sun.shadow.camera, { left: -4, right: 4, top: 4, bottom: -4 });
    scene.add(wall, sun);
    const options = { glyphs, font: 'font.ttf', fontSize: 1.5, anchorX: 'center', anchorY: 'middle' }, text = 'oHo';
    const place = new THREE.Vector3(0, 4, 4); // out of sight
    let caster;
    if (kind === 'plane') caster = new THREE.Mesh(new THREE.PlaneGeometry(3, 1));
    else if (kind === 'text') caster = new Text({ ...options, text });
    else if (kind === 'outline') caster = new Text({ ...options, text, outlineWidth: '8%' });
    else {
        caster = new BatchedText(options);
        caster.addLabel({ text, position: place });
    }
    if (kind !== 'labels') caster.position.copy(place);
    caster.castShadow = true;
    scene.add(caster);
    await caster.sync?.();
    renderer.render(scene, camera);
    const gl = renderer.getContext(), bytes = new Uint8Array(4 * side * side);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    renderer.dispose();
    return [...bytes].filter((_, k) => k % 4 === 0);
}"""


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    def fill(folder: Path) -> None:
        fill_text_site(folder)
        color_font(folder / "ink.ttf", layers(glyph("left", solid(0xFFFF)), glyph("strip", solid(GREEN))))

    with serve_folder(made_once("text_lit", fill)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    page = open_page(f"{address}/text.html", keep=True)
    page.wait_for_function("globalThis.drawn")
    return page


def shadow(page: Any, kind: str) -> np.ndarray:
    """Whether each pixel of a wall is in the shadow of something."""
    picture = np.array(page.evaluate(SHADOW, kind)).reshape(128, 128)
    return picture < picture.max() / 2


def test_labels_cast_the_shadow_of_their_letters(page: Any) -> None:
    text, labels, outline = (shadow(page, kind) for kind in ("text", "labels", "outline"))
    assert 0.02 < text.mean() < 0.1
    assert (text != labels).mean() < 0.002
    assert outline.mean() > 1.2 * text.mean()
    assert outline[text].all()


NORMALS = """async ({ backend, options, label, sprites }) => {
    const isNodes = backend !== 'webgl', renderer = await rendererOf(backend);
    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
    camera.position.set(0, 0, 8);
    const material = isNodes ? new WEBGPU.MeshNormalNodeMaterial() : new THREE.MeshNormalMaterial();
    const all = { glyphs, font: 'font.ttf', fontSize: 2, anchorX: 'center', anchorY: 'middle', material, ...options };
    const { Text: OneText, BatchedText: Labels } = isNodes ? nodeTexts : { Text, BatchedText };
    const text = label ? new Labels({ ...all, sprites }) : new OneText(all);
    if (label) text.addLabel({ text: 'H', quaternion: new THREE.Quaternion(...label) });
    scene.add(text);
    await text.sync();
    const pixels = await pixelsOf(renderer, scene, camera, [64, 64]);
    text.dispose();
    return pixels;
}"""


def srgb(linear: np.ndarray) -> np.ndarray:
    return np.where(linear < 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055)


def normals(page: Any, backend: str, **described: Any) -> np.ndarray:
    """Normals of the pixels that a text fills, in the space of the camera."""
    values = np.frombuffer(base64.b64decode(page.evaluate(NORMALS, {"backend": backend, **described})), np.float32)
    picture = values.reshape(64, 64, 4).astype(float)
    if backend != "webgl":  # there normals are colours, which are written in linear light
        picture[..., :3] = srgb(picture[..., :3])
    return 2.0 * picture[picture[..., 3] > 0.99][:, :3] - 1.0


@pytest.mark.parametrize("backend", ["webgl", "fallback"])
def test_letters_are_lit_as_they_are_turned(page: Any, backend: str) -> None:
    angle = 0.6
    turn = [0.0, np.sin(angle / 2), 0.0, np.cos(angle / 2)]
    wanted = np.array([np.sin(angle), 0.0, np.cos(angle)])
    label = normals(page, backend, label=turn)
    assert np.abs(label - wanted).max() < 0.02
    sprite = normals(page, backend, label=turn, sprites=True)
    assert np.abs(sprite - (0.0, 0.0, 1.0)).max() < 0.02
    bent = normals(page, backend, options={"text": "HHHHHHH", "curveRadius": -3})
    assert bent[:, 0].min() < -0.5
    assert bent[:, 0].max() > 0.5
    assert np.abs(bent[:, 1]).max() < 0.02


def test_rays_meet_texts_where_they_are_bent_to(page: Any) -> None:
    found = page.evaluate("""async () => {
        const ray = new THREE.Raycaster(), text = 'H'.repeat(9);
        const shared = { glyphs, font: 'font.ttf', text, anchorY: 'middle' };
        const meet = (text, from, way) => {
            ray.set(new THREE.Vector3(...from), new THREE.Vector3(...way).normalize());
            return ray.intersectObject(text).map(({ charIndex, distance }) => [charIndex, distance]);
        };
        const bent = new Text({ ...shared, curveRadius: -1, anchorX: 'center' });
        await bent.sync();
        bent.updateMatrixWorld();
        const width = bent.layout.blockBounds[2] - bent.layout.blockBounds[0];
        const curve = new THREE.LineCurve3(new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, -20));
        const along = new Text({ ...shared, curve });
        await along.sync();
        along.updateMatrixWorld();
        const [start, end] = along.layout.carets.subarray(4 * 5, 4 * 5 + 2), middle = (start + end) / 2;
        return {
            front: meet(bent, [0.001, 0.1, 5], [0, 0, -1]), side: meet(bent, [5, 0.1, -1.001], [-1, 0, 0]),
            above: meet(bent, [0, 3, 5], [0, 0, -1]), beside: meet(bent, [1.5, 0.1, 5], [0, 0, -1]), width,
            along: [-5, 5].map((x) => meet(along, [x, 0.3, -middle], [-x, 0, 0])),
            flat: meet(along, [1, 0.1, 5], [0, 0, -1]),
        };
    }""")
    assert found["width"] > 2 * np.pi  # so that both sides have letters
    assert [round(distance, 5) for _, distance in found["front"]] == [5.0, 7.0]
    assert found["front"][0][0] == 4
    assert [round(distance, 5) for _, distance in found["side"]] == [4.0, 6.0]
    assert [index for index, _ in found["side"]] == [6, 2]
    assert found["above"] == found["beside"] == found["flat"] == []
    assert found["along"] == [[[5, 5.0]], [[5, 5.0]]]


INK = """async (areLabels) => {
    const renderer = new THREE.WebGLRenderer(), scene = new THREE.Scene(), seen = [];
    renderer.setSize(32, 32);
    const camera = new THREE.OrthographicCamera(0, 1, 1, 0, -1, 1), gl = renderer.getContext();
    const options = { glyphs, font: 'ink.ttf', anchorY: 'top-baseline' };
    const text = areLabels ? new BatchedText(options) : new Text({ ...options, text: 'A' });
    const colored = areLabels ? text.addLabel({ text: 'A' }) : text;
    scene.add(text);
    for (const color of ['red', 'white', 'red']) {
        colored.color = color;
        if (areLabels) renderer.render(scene, camera); // then its colour is seen
        await text.sync();
        renderer.render(scene, camera);
        const bytes = new Uint8Array(4);
        gl.readPixels(9, 6, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        seen.push([...bytes].slice(0, 3));
        gl.readPixels(9, 16, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        seen.push([...bytes].slice(0, 3));
    }
    text.dispose();
    renderer.dispose();
    return seen;
}"""


@pytest.mark.parametrize("are_labels", [False, True])
def test_parts_of_emoji_in_the_text_s_colour_follow_it(page: Any, are_labels: bool) -> None:
    red, white, green = [255, 0, 0], [255, 255, 255], [0, 128, 0]
    assert page.evaluate(INK, are_labels) == [red, green, white, green, red, green]
