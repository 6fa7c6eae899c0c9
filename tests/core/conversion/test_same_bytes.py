"""The same drawing becomes the same bytes: in every run, in every thread and process, on every machine.

`python tests/core/conversion/test_same_bytes.py` writes `same_bytes.txt` again, for a change that is meant to change
what is made. The
file lists SHA-256 digests as `sha256sum` does. The digest named zlib is of the drawings' own text, deflated: zlib's
successors deflate the same texels to other bytes, and textures are not compared there.
"""

import hashlib
import os
import subprocess
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import vexture
from vexture.fold.shore import fold_of_shore

DRAWINGS = sorted((Path(__file__).parents[3] / "examples" / "shapes").glob("*.svg"))
KNOWN = Path(__file__).with_name("same_bytes.txt")
RENEW = f"python tests/core/conversion/{Path(__file__).name}"


def line(data, name):
    return f"{hashlib.sha256(data).hexdigest()}  {name}"


def made(drawing):
    """Line of a drawing's texture."""
    return line(vexture.convert(drawing).to_ktx2(), f"{drawing.stem}.ktx2")


def moved():
    """Line of a texture that moves an outline."""
    fold = fold_of_shore(vexture.read(DRAWINGS[0]), amplitude=0.01, period=8.0)
    return line(fold.to_ktx2(), f"{DRAWINGS[0].stem}.fold.ktx2")


def turned():
    """Line of a stroke that many transforms turn."""
    svg = b"""<svg viewBox="0 0 97 61"><g transform="rotate(17.3) scale(.77 1.13) skewX(3.1)">
    <path d="M10.3 5.1c11 7 22-3 33 17s5 11 22 3" fill="none" stroke="#000" stroke-dasharray="2.3 1.9"/></g></svg>"""
    return line(vexture.convert(vexture.read(svg)).to_ktx2(), "turned.ktx2")


def packer():
    return line(zlib.compress(b"".join(drawing.read_bytes() for drawing in DRAWINGS)), "zlib")


def table():
    """All lines."""
    return [*map(made, DRAWINGS), moved(), turned(), packer()]


@pytest.fixture(scope="module")
def known():
    lines = KNOWN.read_text().splitlines()
    if packer() not in lines:
        pytest.skip(f"zlib {zlib.ZLIB_RUNTIME_VERSION} deflates to other bytes than the one of {KNOWN.name}")
    return lines


@pytest.mark.parametrize("drawing", DRAWINGS, ids=[drawing.stem for drawing in DRAWINGS])
def test_a_drawing_becomes_the_bytes_that_are_known(known, drawing):
    assert made(drawing) in known, f"{drawing.name} becomes another texture; if it is meant to: {RENEW}"


def test_threads_of_one_process_make_the_same(known):
    with ThreadPoolExecutor(4) as threads:
        assert set(threads.map(made, 4 * DRAWINGS)) <= set(known)


GENERIC = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}


@pytest.mark.parametrize(
    "environment",
    [
        {"PYTHONHASHSEED": "1", "OPENBLAS_CORETYPE": "Prescott", "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"},
        {"PYTHONHASHSEED": "2", "NUMBA_DISABLE_JIT": "1"},
        pytest.param(GENERIC, marks=pytest.mark.slow),
    ],
    ids=["hash", "not compiled", "generic"],
)
def test_other_processes_make_the_same(known, environment):
    """With another order of sets, linear algebra of another processor, no compiled kernels, or those of any machine."""
    outcome = subprocess.run(
        [sys.executable, __file__, "-"], env=os.environ | environment, capture_output=True, text=True, check=True
    )
    assert outcome.stdout.splitlines() == known


if __name__ == "__main__":
    text = "\n".join(table()) + "\n"
    if sys.argv[1:] == ["-"]:
        sys.stdout.write(text)
    else:
        KNOWN.write_text(text)
