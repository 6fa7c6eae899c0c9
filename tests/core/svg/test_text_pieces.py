"""The painted parts of a text, and the box around its cells."""

from pathlib import Path

from plainer_texts import advance
from svg_texts import drawn


def test_parts_with_an_opacity_are_groups_of_their_own(tmp_path: Path) -> None:
    body = '<text y="50">a<tspan opacity="0.5" stroke="red">b<tspan opacity="0.5" stroke="red">c</tspan></tspan></text>'
    drawing = drawn(tmp_path, body)
    assert not drawing.notes
    assert [(group.outer, group.opacity) for group in drawing.groups] == [(-1, 0.5), (0, 0.5)]
    assert [path.group for path in drawing.paths] == [-1, 0, 0, 1, 1]


def test_the_box_of_a_text_is_that_of_its_cells(tmp_path: Path) -> None:
    clip = '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="0.5" height="1"/></clipPath>'
    drawing = drawn(tmp_path, f'<text x="10" y="50" clip-path="url(#c)">{"h" * 4}</text>', clip)
    right = max(contour[..., 0].max() for path in drawing.paths for contour in path.contours)
    assert 100 * right <= 10 + 2 * advance("h") + 1e-9
    assert 100 * right > 10 + 2 * advance("h") - advance("h") / 2
