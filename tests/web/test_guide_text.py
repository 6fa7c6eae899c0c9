"""The guides to texts, and from troika-three-text, read to their ends: each program does what the guide says."""

import io
import json
import re
import shlex
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fontpkg_noto_sans
import numpy as np
import pytest
from PIL import Image

import vexture
from build_wasm import OUTPUT
from chromium import WEB, bundle, serve_folder
from guides import GUIDES, blocks_of
from viewing import VEXTURE

SANS = next(Path(fontpkg_noto_sans.__file__).parent.glob("files/NotoSans[[]*.ttf"))
SIZE = (720, 480)
SCENE = """
import * as THREE from 'three';
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(720, 480);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('white');
const camera = new THREE.PerspectiveCamera(50, 1.5, 0.1, 100);
camera.position.z = 9;
const sun = new THREE.DirectionalLight(0xffffff, 1.5);
sun.position.set(1, 1, 2);
scene.add(sun, new THREE.AmbientLight(0xffffff, 2));
renderer.setAnimationLoop(() => renderer.render(scene, camera));
"""
ARRANGED = """
title.position.set(-5.6, 3.6, 0);
sign.position.set(0.6, 3.5, 0);
text.position.set(-3.8, 1.6, 0);
clock.position.set(-1.8, 2.2, 0);
road.position.set(3, 0.7, 0);
paragraph.position.set(-5.6, -0.2, 0);
labels.position.set(3.2, -1.8, 0);
renderer.setAnimationLoop(() => renderer.render(scene, camera));
await Promise.all([text, title, paragraph, sign, road, labels, clock].map((one) => one.sync()));
Object.assign(window, { caret, rectangles, layout: text.layout, faces: sans.length, count: [...labels.labels].length });
"""
"""Puts what the guide's program has shown side by side."""

REACT = """
import { Canvas } from '@react-three/fiber';
import { createRoot } from 'react-dom/client';
import { Score } from './Score.jsx';
import { Label } from './Label.jsx';
createRoot(document.body.appendChild(document.createElement('div'))).render(
  <div style={{ width: 400, height: 300 }}>
    <Canvas gl={{ preserveDrawingBuffer: true }}>
      <ambientLight intensity={3} />
      <Score points={42} onClick={() => (window.clicked = true)} />
      <Label>From drei</Label>
    </Canvas>
  </div>,
);
"""
CONFIGS = """
const plugged = (await import('./vite.config.js')).default;
const plain = (await import('./without-plugin.config.js')).default;
const config = plugged.plugins[0].config.call({ meta: { viteVersion: '8.1.0' } }, {});
console.log(JSON.stringify([config, plain]));
"""


@pytest.fixture(scope="module")
def site(made_once: Callable[..., Path]) -> Path:
    """Where the guide's files are, as its recipe for esbuild puts them."""

    def fill(folder: Path) -> None:
        (folder / "typeset").mkdir()
        bundle(WEB / "src" / "typeset" / "worker.js", folder / "typeset" / "worker.js")
        shutil.copy(WEB / "node_modules" / "harfbuzzjs" / "dist" / "harfbuzz.wasm", folder / "typeset")
        shutil.copytree(OUTPUT, folder / "kernels")
        shutil.copytree(WEB / "fonts", folder / "fonts")
        shutil.copy(SANS, folder / "fonts" / "NotoSans.ttf")
        (command,) = (block.text for block in blocks_of("text") if block.text.startswith("vexture font"))
        subprocess.run([*VEXTURE, *shlex.split(command)[1:]], cwd=folder / "fonts", check=True, capture_output=True)
        shutil.copytree(WEB / "node_modules" / "@fontsource" / "pacifico", folder / "fonts" / "pacifico")

    return made_once("guide-text", fill)


@pytest.fixture
def show(
    site: Path, tmp_path: Path, open_page: Callable[..., Any], chromium: Any
) -> Iterator[Callable[[dict[str, str]], Any]]:
    """Bundle a program, the first of some files, and open it."""
    folder = tmp_path / "public"
    shutil.copytree(site, folder)
    with serve_folder(folder) as address:

        def open_program(files: dict[str, str]) -> Any:
            for name, text in files.items():
                (tmp_path / name).write_text(text, encoding="utf-8")
            (folder / "js").mkdir(exist_ok=True)
            bundle(tmp_path / next(iter(files)), folder / "js" / "main.js")
            icon = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><body style="margin: 0">'
            page = f'{icon}<script type="module" src="js/main.js"></script>'
            (folder / "index.html").write_text(page, encoding="utf-8")
            return open_page(f"{address}/index.html", SIZE)

        yield open_program


def pixels(page: Any) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)


def share(picture: np.ndarray, color: tuple[int, int, int]) -> float:
    return float(np.mean(np.abs(picture - color).max(axis=2) <= 6))


def programs(guide: str) -> dict[str, str]:
    """Programs of a guide by their titles; those without one are one program, whose title is empty."""
    found: dict[str, str] = {}
    for block in blocks_of(guide):
        if block.language in ("js", "jsx"):
            title = block.title or ""
            assert not title or title not in found
            found[title] = found.get(title, "") + block.text
    return found


@pytest.mark.slow
def test_the_guide_to_texts_does_what_it_says(show: Callable[..., Any], screenshot: Callable[..., Path]) -> None:
    page = show({"main.js": SCENE + programs("text")[""] + ARRANGED})
    page.wait_for_function("window.caret")
    page.wait_for_timeout(300)
    screenshot(page)
    assert page.evaluate("caret.charIndex") in range(13)
    assert len(page.evaluate("rectangles")) == 1
    assert page.evaluate("faces") > 3
    assert page.evaluate("count") == 200
    picture = pixels(page)
    for color in ((255, 99, 71), (0, 128, 128), (0, 100, 0), (160, 82, 45), (128, 0, 128)):
        assert share(picture, color) > 0.00005, color
    red, green, blue = np.moveaxis(picture, 2, 0)
    assert np.mean((red > 150) & (green < 80) & (blue < 110)) > 0.005, "crimson, in the light"


@pytest.mark.slow
def test_what_replaces_troika_runs(show: Callable[..., Any]) -> None:
    near = "camera.position.z = 1;"
    page = show({"main.js": f"{SCENE}{near}\n{programs('from-troika')['after.js']}\nwindow.label = label;"})
    page.wait_for_function("window.label?.layout")
    page.wait_for_timeout(300)
    assert share(pixels(page), (0, 51, 102)) > 0.001


@pytest.mark.slow
def test_the_components_of_the_guides_run(show: Callable[..., Any], screenshot: Callable[..., Path]) -> None:
    components = {"Score.jsx": programs("text")["Score.jsx"], "Label.jsx": programs("from-troika")["Label.jsx"]}
    page = show({"main.jsx": REACT, **components})
    page.wait_for_selector("canvas")
    page.wait_for_timeout(2000)
    screenshot(page)
    picture = pixels(page)[:300, :400]
    orange = picture[..., 0] > picture[..., 2] + 100
    assert orange.mean() > 0.0005
    assert np.mean(picture.max(axis=2) < 60) > 0.001
    rows, columns = np.nonzero(orange)
    page.mouse.click(float(columns.mean()), float(rows.mean()))
    assert page.evaluate("clicked")


def test_the_configurations_of_vite_say_the_same(tmp_path: Path) -> None:
    found = programs("text")
    for name in ("vite.config.js", "without-plugin.config.js"):
        (tmp_path / name).write_text(found[name], encoding="utf-8")
    (tmp_path / "package.json").write_text('{"type": "module"}', encoding="utf-8")
    (tmp_path / "node_modules").mkdir()
    (tmp_path / "node_modules" / "vexture").symlink_to(WEB)
    (tmp_path / "compare.js").write_text(CONFIGS, encoding="utf-8")
    command = ["node", "compare.js"]
    outcome = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    plugged, plain = json.loads(outcome.stdout)
    assert plugged == plain


def test_the_program_that_bakes_a_font_writes_its_files(tmp_path: Path) -> None:
    (tmp_path / "bake.mjs").write_text(programs("text")["bake.mjs"], encoding="utf-8")
    (tmp_path / "node_modules").mkdir()
    (tmp_path / "node_modules" / "vexture").symlink_to(WEB)
    command = ["node", "bake.mjs"]
    outcome = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    metrics = json.loads((tmp_path / "digits.json").read_text(encoding="utf-8"))
    assert set("0123456789: points") <= set(metrics["glyphs"])
    texture = vexture.load(tmp_path / "digits.ktx2")
    assert {"0", "9", "p", ".notdef"} <= {root.name for root in texture.roots}


def test_every_property_of_troika_is_in_the_table() -> None:
    """Its names as its README has them, in the order of the alphabet."""
    text = (GUIDES / "from-troika.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(\w+)[`(]", text.partition("## Properties of a text")[2]))
    wanted = (
        "text anchorX anchorY clipRect color curveRadius depthOffset direction fillOpacity font fontSize fontStyle "
        "fontWeight glyphGeometryDetail gpuAccelerateSDF lang letterSpacing lineHeight material maxWidth orientation "
        "outlineBlur outlineColor outlineOffsetX outlineOffsetY outlineOpacity outlineWidth overflowWrap sdfGlyphSize "
        "strokeColor strokeOpacity strokeWidth styleRanges textAlign textIndent unicodeFontsUrl whiteSpace"
    )
    assert set(wanted.split()) - named == set()
