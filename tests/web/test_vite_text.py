"""A text in projects of real Vite: its worker, HarfBuzz and the kernels are found in development and from a build."""

import json
import shutil
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import fontpkg_noto_sans
import pytest
from test_vite import VITE, Project, answered, need_kernels

from chromium import WEB, serve_folder
from viewing import until

SANS = next(Path(fontpkg_noto_sans.__file__).parent.glob("files/NotoSans[[]*.ttf"))
WRITTEN = """
import * as THREE from 'three';
import { Text } from 'vexture/text';
import font from './font.ttf?url';

const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(64, 64);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
const place = { anchorX: 'center', anchorY: 'middle' };
const text = new Text({ text: '\\u2014', font, fontSize: 2, color: 'red', outlineWidth: 0.01, ...place });
scene.add(text);
await text.sync();
renderer.render(scene, new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1));
const gl = renderer.getContext(), pixels = new Uint8Array(4 * 64 * 64);
gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
window.red = pixels.filter((value, k) => k % 4 === 0 && value === 255).length;
"""
LENIENT = (
    "import vexture from 'vexture/vite';\nexport default { plugins: [vexture()], server: { fs: { strict: false } } };\n"
)
"""The packages that the package depends on are links to folders elsewhere."""


@pytest.fixture
def text_project(tmp_path: Path) -> Project:
    """A project that shows a text; the package is in it as npm would install it."""
    need_kernels()
    if not VITE.is_file():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    project = Project(tmp_path / "project")
    modules = project.folder / "node_modules"
    (modules / "vexture").unlink()
    for name in ("src", "generated", "kernels", "fonts"):
        shutil.copytree(WEB / name, modules / "vexture" / name)
    shutil.copy(WEB / "package.json", modules / "vexture")
    dependencies = json.loads((WEB / "package.json").read_text())["dependencies"]
    for name in ("three", *dependencies):
        (modules / name).symlink_to(WEB / "node_modules" / name)
    shutil.copy(SANS, project.folder / "font.ttf")
    (project.folder / "main.js").write_text(WRITTEN, encoding="utf-8")
    page = '<!doctype html><link rel="icon" href="data:,"><body><script type="module" src="/main.js"></script>'
    (project.folder / "index.html").write_text(page, encoding="utf-8")
    (project.folder / "vite.config.js").write_text(LENIENT, encoding="utf-8")
    return project


@pytest.mark.slow
@pytest.mark.parametrize("place", ["development", "build"])
def test_a_text_finds_its_worker_and_kernels(
    text_project: Project, open_page: Callable[..., Any], screenshot: Callable[..., Path], place: str
) -> None:
    with ExitStack() as stack:
        if place == "build":
            outcome = text_project.build()
            assert outcome.returncode == 0, outcome.stdout + outcome.stderr
            address = stack.enter_context(serve_folder(text_project.folder / "dist"))
        else:
            client = stack.enter_context(text_project.served())
            until(lambda: answered(client, "/"))
            address = str(client.base_url)
        page = open_page(address)
        page.wait_for_function("window.red !== undefined")
        screenshot(page.locator("canvas"))
        assert page.evaluate("red") > 100
