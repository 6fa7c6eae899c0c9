"""Lines under, over and through texts."""

from pathlib import Path

import pytest
from svg_texts import drawn


@pytest.mark.parametrize(
    "words",
    ["dashed 1e-9px", "wavy 1e-9px", "dotted -3px", "double 0", "red blue", "wavy 1e9px", "x(" * 200_000],
)
def test_any_decoration_leaves_the_letters(tmp_path: Path, words: str) -> None:
    drawing = drawn(tmp_path, f'<text y="50" text-decoration="underline {words}">ship</text>')
    assert len(drawing.paths) == 2
    assert sum(len(contour) for path in drawing.paths for contour in path.contours) < 1_000
