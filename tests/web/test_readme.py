"""The README's lines for three.js run as they stand there."""

import io
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import vexture
from chromium import ROOT, bundle, serve_folder
from viewing import until

README = (ROOT / "README.md").read_text(encoding="utf-8")
DUCK, PAPER = (0xE8, 0xB1, 0x00), (0xF4, 0xF1, 0xE8)

SCENE = """
import * as THREE from 'three';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.style.margin = '0';
document.body.replaceChildren(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xf4f1e8);
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100);
camera.position.z = 4;
renderer.setAnimationLoop(() => renderer.render(scene, camera));
"""
"""What a page has before the README's lines."""


def shares(page: Any) -> list[float]:
    """Parts of the page that have the duck's colour, and the paper's."""
    seen = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB")).astype(int)
    return [float(np.mean(np.abs(seen - color).max(axis=2) <= 1)) for color in (DUCK, PAPER)]


@pytest.mark.parametrize("three", ["three", "three-floor"])
def test_the_readme_draws_a_duck(
    tmp_path: Path, open_page: Callable[..., Any], screenshot: Callable[..., Path], three: str
) -> None:
    program = next(block for block in re.findall(r"^```js\n(.*?)^```", README, re.M | re.S) if "loadAsync" in block)
    (tmp_path / "main.js").write_text(SCENE + program, encoding="utf-8")
    bundle(tmp_path / "main.js", tmp_path / "bundle.js", three)
    (tmp_path / "index.html").write_text(
        '<!doctype html><link rel="icon" href="data:,"><body><script type="module" src="bundle.js"></script>'
    )
    vexture.convert(ROOT / "examples" / "shapes" / "duck.svg").save(tmp_path / "duck.ktx2")
    with serve_folder(tmp_path) as address:
        page = open_page(address)
        page.wait_for_selector("canvas")
        # it turns: once in a while its edge is all that is seen
        duck, paper = until(lambda: seen if (seen := shares(page))[0] > 0.05 else None)
        screenshot(page)
    assert paper > 0.3
    assert duck + paper > 0.95
