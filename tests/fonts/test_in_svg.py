"""Fonts in texts of SVG: glyphs in colour, and which font stands for a generic family."""

import pytest
from made import OWN, RED, filled, made_font, solid, stacked

from vexture.errors import SourceError
from vexture.svg.read import svg_drawing

ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'


def drawn(body, *fonts):
    return svg_drawing(f"<svg {ROOT}>{body}</svg>".encode(), "text.svg", fonts=fonts)


def test_glyphs_in_colour_are_painted_where_they_stand(tmp_path):
    file = tmp_path / "made.ttf"
    layers = stacked(filled("square", solid(RED)), filled("disc", solid(OWN)))
    file.write_bytes(made_font({"a": "square", "b": "left"}, {"a": layers}))
    body = '<text id="t" x="10" y="50" font-size="20" font-family="Made" fill="blue" fill-opacity="0.5">ba</text>'
    drawing = drawn(body, file)
    assert [path.element for path in drawing.paths] == ["t", "t", "t"]
    assert [path.paint.hex for path in drawing.paths] == ["#0000ff80", "#ff0000", "#0000ff"]
    assert [path.group for path in drawing.paths] == [-1, 0, 0]
    assert [group.opacity for group in drawing.groups] == [0.5]
    sides = [100 * side for side in drawing.paths[1].box.ravel()]
    assert sides == pytest.approx([10 + 18 + 2, 50, 10 + 18 + 16, 50 + 14])
    assert drawn(body.replace('fill="blue"', 'fill="none"'), file).paths == ()


def test_generic_families_are_those_of_the_given_fonts_first(tmp_path):
    for name, family, shape in (("a.ttf", "Other", "square"), ("b.ttf", "Noto Serif", "left")):
        (tmp_path / name).write_bytes(made_font({"a": shape}, family=family))
    drawing = drawn('<text y="50" font-family="serif" font-size="10">a</text>', tmp_path)
    assert 100 * drawing.paths[0].box.ravel()[2] == pytest.approx(5)


def test_a_missing_character_is_one_that_the_font_in_use_lacks(tmp_path):
    for name, family, shapes in (("a.ttf", "Made", {"a": "square"}), ("b.ttf", "Other", {"b": "left"})):
        (tmp_path / name).write_bytes(made_font(shapes, family=family))
    drawing = drawn('<text y="50" font-family="No Such Font, Made">ab</text>', tmp_path)
    assert [str(note) for note in drawing.notes] == ["character 'b' (U+0062), which 'Made' lacks, drawn in Other"]


def test_a_folder_without_fonts_is_named(tmp_path):
    with pytest.raises(SourceError, match=f"{tmp_path}: the folder holds no font that can be read; give one with .ttf"):
        drawn('<text y="50">a</text>', tmp_path)
