"""Real drawings of three npm packages: a sample is read, a smaller one looks like resvg's picture."""

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree
from svg_reference import difference

from corpora import flags, mdi, simple_icons
from vexture.base.errors import SourceWarning, VextureError
from vexture.svg.read import read_svg

Corpus = Callable[[int, int], list[Path]]

SHOWN = 200
"""Pixels across a compared picture."""


def sample(corpus: Corpus, count: int) -> list[Path]:
    """Files of a corpus, the same ones each time; without npm the test is skipped."""
    try:
        return corpus(count, 2)
    except VextureError as error:
        pytest.skip(str(error))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(("corpus", "count"), [(mdi, 2000), (simple_icons, 1000)])
def test_every_icon_is_read_without_a_warning(corpus: Corpus, count: int) -> None:
    for file in sample(corpus, count):
        assert read_svg(file).segments > 0, file


@pytest.mark.slow
def test_every_flag_is_read() -> None:
    for file in sample(flags, 100):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SourceWarning)
            assert read_svg(file).segments > 0, file


@pytest.mark.parametrize("count", [50, pytest.param(150, marks=pytest.mark.slow)])
@pytest.mark.parametrize("corpus", [mdi, simple_icons])
def test_a_sample_looks_like_the_reference(corpus: Corpus, count: int) -> None:
    for file in sample(corpus, count):
        root = etree.parse(file).getroot()
        root.set("width", str(SHOWN))
        root.set("height", str(SHOWN))
        mean, most = difference(file, read_svg(file), etree.tostring(root).decode())
        assert mean < 0.05, file
        assert most < 0.9, file
