"""Painted paths of a drawing: fills and strokes, and how many segments they have."""

from pathlib import Path

import numpy as np
import pytest

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg


def drawing_of(folder: Path, body: str, root: str = 'viewBox="0 0 100 100"') -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    return read_svg(file)


def test_segments_are_counted_honestly(tmp_path: Path) -> None:
    """A closing line counts if it draws something; a step without length never does."""
    assert drawing_of(tmp_path, '<path d="M10 10h50v50z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M10 10h50v50L10 10z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M10 10h50l0 0v50c0 0 0 0 0 0z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M.1 .1l.2 0 0 .2 -.2 0 0 -.2z"/>').segments == 4
    with pytest.warns(SourceWarning, match="nothing in it is painted"):
        assert drawing_of(tmp_path, '<path d="M10 10L50 50"/><line x1="9" x2="50"/>').segments == 0


def test_colors_and_opacity(tmp_path: Path) -> None:
    drawing = drawing_of(
        tmp_path, '<g opacity="0.5"><rect width="9" height="9" fill="#f80" fill-opacity="50%" opacity="0.4"/></g>'
    )
    paint = drawing.paths[0].paint
    assert paint.color == pytest.approx((1, 136 / 255, 0))
    assert paint.opacity == pytest.approx(0.1)


def test_a_stroke_is_a_path_of_its_own(tmp_path: Path) -> None:
    body = '<path d="M10 10H90V90z" fill="red" fill-rule="evenodd" stroke="blue" stroke-width="5"/>'
    fill, stroke = drawing_of(tmp_path, body).paths
    assert (fill.paint.color, stroke.paint.color) == ((1, 0, 0), (0, 0, 1))
    assert (fill.fill_rule.name, stroke.fill_rule.name) == ("EVENODD", "NONZERO")


def test_a_stroke_of_too_many_dashes_is_solid_and_named(tmp_path: Path) -> None:
    """The rest of the drawing is as it would be without this stroke."""
    rest = '<path d="M0 50h100" stroke="blue" stroke-width="4" stroke-dasharray="10"/><rect width="9" height="9"/>'
    fine = '<path id="fine" d="M0 9H100" stroke="red" stroke-width="2" stroke-dasharray="{}"/>'
    with pytest.warns(SourceWarning, match="lengthen stroke-dasharray"):
        drawing = drawing_of(tmp_path, fine.format("1e-9") + rest)
    (note,) = drawing.notes
    assert note.kind == "simplified"
    assert note.message == (
        'stroke of <path id="fine"> in line 1 read as solid: '
        "50,000,000,000 dashes; the limit is 100,000; lengthen stroke-dasharray"
    )
    plain = drawing_of(tmp_path, fine.format("none") + rest)
    assert [path.paint for path in drawing.paths] == [path.paint for path in plain.paths]
    for ours, other in zip(drawing.paths, plain.paths, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(ours.contours, other.contours, strict=True))
