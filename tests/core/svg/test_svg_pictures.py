"""Every one-issue fixture looks like what resvg draws, or like a plainer file that says the same."""

import warnings
from pathlib import Path

import pytest
from plainer import PLAINER, plainer
from svg_reference import difference

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"
TOPICS = (
    "animation",
    "background",
    "filters",
    "gradients",
    "groups",
    "images",
    "markers",
    "masks",
    "paths",
    "patterns",
    "shapes",
    "strokes",
    "structure",
    "style",
    "transform",
    "viewport",
)


def read_quietly(path: Path) -> Drawing:
    """Read a file some of whose values are invalid on purpose."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path)


def fixture_names() -> list[str]:
    return [f"{topic}/{path.stem}" for topic in TOPICS for path in sorted((FIXTURES / topic).glob("*.svg"))]


@pytest.mark.parametrize("name", fixture_names())
def test_looks_like_the_reference(name: str) -> None:
    path = FIXTURES / f"{name}.svg"
    mean, most = difference(path, read_quietly(path), plainer(name))
    assert mean < 0.04
    assert most < 0.5


def test_fixtures_are_all_there() -> None:
    assert len(fixture_names()) > 380
    assert [name for name in PLAINER if not (FIXTURES / f"{name}.svg").is_file()] == []
