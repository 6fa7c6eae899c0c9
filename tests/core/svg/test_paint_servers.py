"""Paints that a fill or a stroke refers to."""

from pathlib import Path

import pytest

from vexture.base.errors import SourceWarning
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"


@pytest.mark.parametrize(
    ("name", "color"),
    [
        ("pattern", (0.5, 0.5, 0.5)),
        ("missing-paint", (1, 0, 0)),
    ],
)
def test_paint_servers_become_flat_colors(name: str, color: tuple[float, float, float]) -> None:
    with pytest.warns(SourceWarning):
        drawing = read_svg(FIXTURES / "unsupported" / f"{name}.svg")
    assert [path.paint.color for path in drawing.paths] == [color]
