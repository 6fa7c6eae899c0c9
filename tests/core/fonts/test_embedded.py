"""Fonts in a drawing, by rules `@font-face`."""

import base64

from made import made_font

from vexture.svg.read import svg_drawing

ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'


def drawn(body, *fonts):
    return svg_drawing(f"<svg {ROOT}>{body}</svg>".encode(), "text.svg", fonts=fonts)


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
