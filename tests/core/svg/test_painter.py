"""Painted paths of a drawing: fills and strokes, and how many segments they have."""

from pathlib import Path

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
