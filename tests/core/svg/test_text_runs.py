"""Runs of a text: which font shows each character."""

import base64
from pathlib import Path

from svg_texts import drawn

from same_fonts import FONTS
from vexture.drawing.drawing import Drawing


def notes(drawing: Drawing) -> list[str]:
    return [f"{note.kind}: {note}" for note in drawing.notes]


def test_missing_fonts_and_characters_are_named_with_what_is_used(tmp_path: Path) -> None:
    body = '<text y="50" font-family="No Such Font">ab</text><text y="70" font-family="cmr10">a\u0634</text>'
    found = notes(drawn(tmp_path, body))
    assert any(note.startswith("simplified: font 'No Such Font' drawn in ") for note in found)
    assert any(
        note.startswith("simplified: character '\u0634' (U+0634), which 'cmr10' lacks, drawn in ") for note in found
    )
    assert len(found) == 2
    for family in ("No Such Font, DejaVu Sans", "serif", ""):
        assert not notes(drawn(tmp_path, f'<text y="50" font-family="{family}">ab</text>'))


def test_a_font_in_the_drawing(tmp_path: Path) -> None:
    data = base64.b64encode((FONTS / "cmr10.ttf").read_bytes()).decode()
    style = f"<style>@font-face {{ font-family: 'My Own'; src: url('data:font/ttf;base64,{data}') }}</style>"
    own = drawn(tmp_path, '<text y="50" font-family="My Own">Ship</text>', style)
    known = drawn(tmp_path, '<text y="50" font-family="cmr10">Ship</text>')
    assert not own.notes
    assert all((a == b).all() for a, b in zip(own.paths[0].contours, known.paths[0].contours, strict=True))
