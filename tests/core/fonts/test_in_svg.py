"""Fonts in texts of SVG: glyphs in colour or without outlines, and which font is chosen."""

import base64

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


def rule(content, family="Own", more=""):
    data = base64.b64encode(content).decode()
    return f"@font-face {{ font-family: {family}; src: url(data:font/ttf;base64,{data}); {more} }}"


def widths(drawing):
    """Of each path, in hundredths of its font size of 10."""
    return [round(1000 * (path.box[1, 0] - path.box[0, 0])) for path in drawing.paths]


def test_parts_of_a_font_are_used_for_their_characters():
    square, left = (made_font(dict.fromkeys("abcd", shape)) for shape in ("square", "left"))
    ranges = ("unicode-range: U+61, U+63-64", "unicode-range: u+6?; font-weight: 400")
    spans = "".join(f"<tspan>{letter}</tspan>" for letter in "abcd")
    text = f'<text y="50" font-size="10" font-family="Own">{spans}</text>'
    rules = [rule(square, more=ranges[0]), rule(left, more=ranges[1])]
    assert widths(drawn(f"<style>{rules[1]}{rules[0]}</style>{text}")) == [70, 40, 70, 70]
    assert widths(drawn(f"<style>{rules[0]}{rules[1]}</style>{text}")) == [40, 40, 40, 40]
    # a bold face is another one, not a part
    bold = rule(left, more="font-weight: 700")
    assert widths(drawn(f"<style>{rule(square, more='font-weight: 400')}{bold}</style>{text}")) == [70] * 4
    (note,) = drawn(f"<style>{rule(square, more='unicode-range: U+61-60')}</style>{text}").notes
    assert note.message == "unicode-range of font 'Own', which is used for all characters"


def test_a_font_of_a_rule_can_be_one_that_is_given(tmp_path):
    file = tmp_path / "made.ttf"
    file.write_bytes(made_font({"a": "left"}, family="Made"))
    text = '<text y="50" font-size="10" font-family="Own">a</text>'
    for name in ("'Made Regular'", "Made-Regular", "made regular"):
        style = f"<style>@font-face {{ font-family: Own; src: local('None'), local({name}), url(x.woff) }}</style>"
        drawing = drawn(style + text, file)
        assert widths(drawing) == [40]
        assert not drawing.notes
    drawing = drawn("<style>@font-face { font-family: Own; src: local(Made Bold) }</style>" + text, file)
    about = {note.message: [subject.name for subject in note.elements] for note in drawing.notes}
    assert about["font 'Own', which is not in the file; give it by `fonts`"] == ["<style> in line 1"]


def test_a_missing_character_is_one_that_the_font_in_use_lacks(tmp_path):
    for name, family, shapes in (("a.ttf", "Made", {"a": "square"}), ("b.ttf", "Other", {"b": "left"})):
        (tmp_path / name).write_bytes(made_font(shapes, family=family))
    drawing = drawn('<text y="50" font-family="No Such Font, Made">ab</text>', tmp_path)
    assert [str(note) for note in drawing.notes] == ["character 'b' (U+0062), which 'Made' lacks, drawn in Other"]


def test_a_folder_without_fonts_is_named(tmp_path):
    with pytest.raises(SourceError, match=f"{tmp_path}: the folder holds no font that can be read; give one with .ttf"):
        drawn('<text y="50">a</text>', tmp_path)
