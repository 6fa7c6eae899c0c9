"""Texts of `vexture/text` and `vexture/webgpu` in a real browser, against the exact renderer."""

import base64
import shutil
from collections.abc import Callable, Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import vexture
from build_wasm import OUTPUT
from chromium import WEB, bundle, serve_folder
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact

PAGE = Path(__file__).parent / "pages" / "text.js"
WORKER = WEB / "src" / "typeset" / "worker.js"
WORD = "Hafen &ĝ5"
BACKENDS = ("webgl", "fallback", "webgpu")
SIZE = (160, 60)
CLOSE = 1.0 / 255
"""At least; what differs is the tolerance of outlines and their rounding."""

SNAPPED = 1 / 16
"""The software adapter of WebGPU puts vertices on sixteenths of a pixel, and a glyph's edges with them."""

Picture = NDArray[np.float64]


def font() -> Path:
    """Noto Sans, a variable font, which `vexture.text` takes by default."""
    found = find_spec("fontpkg_noto_sans")
    assert found is not None and found.origin is not None, "the extra text is installed for tests"
    return Path(found.origin).parent / "files" / "NotoSans[wdth,wght].ttf"


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    def fill(folder: Path) -> None:
        bundle(PAGE, folder / "text.js")
        bundle(WORKER, folder / "worker.js")
        shutil.copy(WEB / "node_modules" / "harfbuzzjs" / "dist" / "harfbuzz.wasm", folder)
        shutil.copy(font(), folder / "font.ttf")
        for name in ("silhouettes", "maps", "strokes"):
            shutil.copy(OUTPUT / f"{name}.wasm", folder)
        icon = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><body>'
        (folder / "text.html").write_text(f'{icon}<script type="module" src="text.js"></script>', encoding="utf-8")

    with serve_folder(made_once("text", fill)) as url:
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
    assert np.abs(found - wanted).max() < (SNAPPED if backend == "webgpu" else CLOSE)
    assert seen["flat"] is (name not in ("turned", "in perspective"))
