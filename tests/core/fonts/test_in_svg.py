"""Fonts in texts of SVG: glyphs in colour or without outlines, and which font is chosen."""

import pytest
from made import OWN, RED, composite_glyph, fill_shape, made_font, replace_glyphs, solid, stack_paints

import vexture
from vexture.base.errors import SourceError, SourceWarning
from vexture.svg.read import svg_drawing

ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'


def drawn(body, *fonts):
    return svg_drawing(f"<svg {ROOT}>{body}</svg>".encode(), "text.svg", fonts=fonts)


def test_glyphs_in_colour_are_painted_where_they_stand(tmp_path):
    file = tmp_path / "made.ttf"
    layers = stack_paints(fill_shape("square", solid(RED)), fill_shape("disc", solid(OWN)))
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


@pytest.mark.parametrize(
    "glyphs",
    [
        {"a": composite_glyph("u0061")},
        {"a": composite_glyph("u0062"), "b": composite_glyph("u0061")},
        {"a": composite_glyph(*["u0062"] * 3000), "b": composite_glyph(*["square"] * 3000)},
    ],
    ids=["itself", "circle", "huge"],
)
def test_glyphs_that_cannot_be_composed_are_named(tmp_path, glyphs):
    file = tmp_path / "made.ttf"
    content = made_font({"a": "square", "b": "square", "c": "disc"})
    file.write_bytes(replace_glyphs(content, glyphs))
    said = "left out: glyph 6 of font 'Made', which is composed of itself or of too many others"
    with pytest.warns(SourceWarning, match=said):
        word = vexture.text("c a", font=file)
    for drawing in (drawn('<text id="t" y="50" font-family="Made">c a</text>', file), word):
        assert [f"{note.kind}: {note.message}" for note in drawing.notes] == [said]
        assert len(drawing.paths) == 1
    file.write_bytes(replace_glyphs(content, {"a": composite_glyph("square", "disc")}))
    assert not drawn('<text y="50" font-family="Made">c a</text>', file).notes


def test_a_missing_character_is_one_that_the_font_in_use_lacks(tmp_path):
    for name, family, shapes in (("a.ttf", "Made", {"a": "square"}), ("b.ttf", "Other", {"b": "left"})):
        (tmp_path / name).write_bytes(made_font(shapes, family=family))
    drawing = drawn('<text y="50" font-family="No Such Font, Made">ab</text>', tmp_path)
    assert [str(note) for note in drawing.notes] == ["character 'b' (U+0062), which 'Made' lacks, drawn in Other"]


def test_a_folder_without_fonts_is_named(tmp_path):
    with pytest.raises(SourceError, match=f"{tmp_path}: the folder holds no font that can be read; give one with .ttf"):
        drawn('<text y="50">a</text>', tmp_path)
