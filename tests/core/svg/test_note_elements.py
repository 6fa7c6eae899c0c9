"""The elements that a note names, and where they are in the drawing."""

import warnings
from pathlib import Path

import pytest

from vexture import read
from vexture.base.errors import SourceWarning
from vexture.base.notes import MOST_SUBJECTS
from vexture.drawing.drawing import Drawing


def read_quietly(file: Path) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read(file)


def test_the_box_of_an_element_holds_all_its_uses_and_strokes_but_not_what_it_masks(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><defs><g id="a" rotate="1" scale="2">'
        '<path d="M10 10h10" stroke="red" stroke-width="2"/></g></defs>'
        '<use id="b" filter="url(#f)" href="#a"/><use href="#a" y="80"/>'
        '<mask id="m" filter="url(#f)"><path id="c" filter="url(#f)" d="M0 0h100v100h-100z"/></mask>'
        '<path filter="url(#f)" d="M40 40h10v10h-10z" mask="url(#m)"/>\n'
        f'<filter id="f" filterUnits="userSpaceOnUse">{"<feOffset/>" * 501}</filter></svg>'
    )
    (note,) = read_quietly(file).notes
    boxes = dict(note.elements)
    assert boxes["b"] == pytest.approx((0.1, 0.89, 0.2, 0.91))
    assert boxes["c"] is None
    assert boxes["the 3rd <path> in line 1"] == pytest.approx((0.4, 0.5, 0.5, 0.6))


def test_a_note_names_so_many_elements_and_counts_the_others(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    file.write_text(f'<svg viewBox="0 0 9 9">{"<foreignObject/>" * 40}</svg>')
    assert [(note.count, len(note.elements)) for note in read_quietly(file).notes] == [(40, MOST_SUBJECTS), (1, 0)]
