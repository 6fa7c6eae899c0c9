"""Real drawings: every file of three npm packages is read, a sample of them looks like resvg's picture.

Run ``npm install @mdi/svg simple-icons flag-icons`` anywhere and set ``VEXTURE_CORPORA`` to the ``node_modules`` there.
"""

import os
import random
import warnings
from pathlib import Path

import pytest
from lxml import etree
from svg_reference import difference

from vexture.errors import SourceWarning
from vexture.sources.svg import read_svg

CORPORA = Path(os.environ.get("VEXTURE_CORPORA", "node_modules"))
ICONS = {"@mdi/svg": "svg/*.svg", "simple-icons": "icons/*.svg"}
SHOWN = 200
"""Pixels across a compared picture."""


def files_of(package: str, pattern: str) -> list[Path]:
    files = sorted((CORPORA / package).glob(pattern))
    if not files:
        pytest.skip(f"npm package {package} is not in {CORPORA} (set VEXTURE_CORPORA to a node_modules folder)")
    return files


@pytest.mark.parametrize("package", ICONS)
def test_every_icon_is_read_without_a_warning(package: str) -> None:
    for file in files_of(package, ICONS[package]):
        assert read_svg(file).segments > 0, file


def test_every_flag_is_read() -> None:
    for file in files_of("flag-icons", "flags/4x3/*.svg"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SourceWarning)
            assert read_svg(file).segments > 0, file


@pytest.mark.parametrize("package", ICONS)
def test_a_sample_looks_like_the_reference(package: str) -> None:
    for file in random.Random(2).sample(files_of(package, ICONS[package]), 150):
        root = etree.parse(file).getroot()
        root.set("width", str(SHOWN))
        root.set("height", str(SHOWN))
        mean, most = difference(file, read_svg(file), etree.tostring(root).decode())
        assert mean < 0.05, file
        assert most < 0.9, file
