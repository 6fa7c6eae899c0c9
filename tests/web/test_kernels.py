"""Kernels in WebAssembly return what Python's return, bit by bit."""

import base64
import json
import shutil
import subprocess
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from walk_node import by_node

import corpora
import vexture
from build_wasm import OUTPUT, is_current, retarget
from chromium import ROOT
from vexture.base.errors import SourceWarning, VextureError
from vexture.base.tolerance import UNSEEN
from vexture.drawing.drawing import Drawing
from vexture.texture.silhouette import silhouette_texels
from vexture.tree.bounds import DEFAULT_CAPACITY, DEFAULT_DEPTH, bounds_of
from vexture.tree.cubics import outlines_of
from vexture.tree.tree import MOST_QUADS

SHAPES = sorted((ROOT / "examples" / "shapes").glob("*.svg"))
BOUNDS = bounds_of(UNSEEN, DEFAULT_DEPTH, DEFAULT_CAPACITY, None, MOST_QUADS)
ENDLESS = 2**53 - 1
GLYPHS = "ABCDEGQRSWXYabcdefgkmqswxy0123456789&@%$#ßæŒΩλЖд"

Case = dict[str, Any]


@pytest.fixture(scope="module")
def module() -> Path:
    """The module of silhouettes."""
    return built("silhouettes")


def built(name: str) -> Path:
    """A module that is built."""
    file = OUTPUT / f"{name}.wasm"
    if not file.is_file():
        pytest.skip(f"no {file.relative_to(ROOT)} (make wasm)")
    assert is_current(file), f"{file.relative_to(ROOT)} is of other kernels: make wasm"
    return file


def encoded(value: Any) -> Any:
    """A value as `kernel_cases.mjs` reads it."""
    if isinstance(value, np.ndarray):
        numbers = base64.b64encode(np.ascontiguousarray(value).tobytes()).decode()
        return {"numbers": numbers, "type": value.dtype.str, "shape": value.shape}
    return [encoded(part) for part in value] if isinstance(value, tuple) else value


def case(name: str, kernel: Any, *arguments: Any) -> Case:
    """A call of a kernel, with Python's results."""
    given, results = [encoded(value) for value in arguments], [encoded(value) for value in kernel(*arguments)]
    return {"name": name, "kernel": kernel.__name__, "given": given, "results": results}


def silhouette(drawing: Drawing, first: int = 0) -> Case:
    """The silhouette of a drawing."""
    return case(drawing.name, silhouette_texels, *outlines_of(drawing), BOUNDS, first, ENDLESS)


def compare(module: Path, cases: Iterable[Case], folder: Path) -> int:
    """Compare results; return the number of cases."""
    listed = folder / "cases.jsonl"
    with listed.open("w", encoding="utf-8") as file:
        file.writelines(json.dumps(each) + "\n" for each in cases)
    found = by_node("kernel_cases.mjs", module, listed)
    assert found["different"] == []
    count: int = found["cases"]
    return count


def test_texels_of_examples_and_glyphs_are_those_of_python(module: Path, tmp_path: Path) -> None:
    drawings = [*(vexture.read(file) for file in SHAPES), *corpora.glyphs(corpora.dejavu_sans(), GLYPHS)]
    cases = [silhouette(drawing, 7 * place) for place, drawing in enumerate(drawings)]
    assert compare(module, cases, tmp_path) == len(SHAPES) + len(GLYPHS)


def test_room_on_the_stack_is_that_of_addresses_of_8_bytes() -> None:
    text = """%x = alloca { ptr, i64, ptr }, align 8
  store ptr @.const.picklebuf.1f.2, ptr %excinfo, align 8
@.const.picklebuf.1f.2 = internal constant { ptr, i32 } zeroinitializer"""
    first, second, third = retarget(text, "").splitlines()
    assert first == "%x = alloca { i64, i64, i64 }, align 8"
    assert second == "  store ptr null, ptr %excinfo, align 8"
    assert third == text.splitlines()[2]


def test_limits_are_reported_as_in_python(module: Path, tmp_path: Path) -> None:
    outlines = outlines_of(Drawing.polygon(np.random.default_rng(1).random((60, 2))))
    far = outlines.cubics.copy()
    far[3, 1, 0] = 7.0
    cases = [
        case("quads", silhouette_texels, *outlines, BOUNDS._replace(most_quads=40), 0, ENDLESS),
        case("work", silhouette_texels, *outlines, BOUNDS, 0, 100),
        case("outside", silhouette_texels, far, *outlines[1:], BOUNDS, 0, ENDLESS),
        case("nothing", silhouette_texels, *outlines_of(Drawing(())), BOUNDS, 0, ENDLESS),
    ]
    assert compare(module, cases, tmp_path) == len(cases)


def test_the_tests_in_javascript_that_need_the_kernels() -> None:
    """`make test` runs the tests of web/ while the kernels are compiled, so that some of those are skipped there."""
    for name in ("silhouettes", "maps", "strokes"):
        built(name)
    web = ROOT / "web"
    vitest = web / "node_modules" / ".bin" / "vitest"
    if not vitest.exists() or shutil.which("node") is None:
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    files = [file for file in sorted((web / "test").glob("*.test.js")) if "describeWithKernels(" in file.read_text()]
    assert files
    command = [vitest, "run", *files, "--project", "three", "--reporter", "json"]
    outcome = subprocess.run(command, cwd=web, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    assert json.loads(outcome.stdout)["numPendingTests"] == 0, outcome.stdout


def readable(files: Iterable[Path]) -> Iterator[Drawing]:
    """Drawings of files that can be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        for file in files:
            try:
                yield vexture.read(file).without_masks()
            except VextureError:
                continue


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize(
    ("package", "count"),
    [(corpora.MDI, 500), (corpora.SIMPLE_ICONS, 500), (corpora.LUCIDE, 400), (corpora.FLAG_ICONS, 250)],
    ids=["mdi", "simple-icons", "lucide", "flags"],
)
def test_texels_of_published_drawings(module: Path, tmp_path: Path, package: corpora.Package, count: int) -> None:
    cases = (silhouette(drawing) for drawing in readable(package.files(count, 1)))
    assert compare(module, cases, tmp_path) > 0.95 * count
