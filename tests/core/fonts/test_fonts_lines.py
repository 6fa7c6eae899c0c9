"""Lines of text: the face of each character, and the places of its glyphs."""

import pytest
from made import made_font

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.fonts.face import faces_in
from vexture.fonts.lines import FaceChoice, Typesetting, belongs, is_seen, line_of_glyphs


def choice_of(*families, is_asked=True):
    faces = [face for content in families for face in faces_in(content)]
    return FaceChoice(iter(faces), Notes(), is_asked)


LATIN = made_font({"a": "square", "b": "left", "\u0301": "left"}, family="Latin")
MORE = made_font({"b": "square", "c": "square", "\u05d0": "left", "\u05d1": "square"}, family="More")


def test_each_character_has_the_first_face_that_has_it():
    choice = choice_of(LATIN, MORE)
    assert [choice.of(character, None).family for character in "abc"] == ["Latin", "Latin", "More"]
    assert [str(note) for note in choice.notes.in_order] == [
        "character 'c' (U+0063), which Latin lacks, and such in More"
    ]


def test_a_character_that_no_face_has_keeps_the_face_before_it():
    choice = choice_of(LATIN, MORE, is_asked=False)
    last = choice.of("c", None)
    assert choice.of("\u4e00", last) is last
    assert choice.of("\u4e00", None).family == "Latin"
    assert "\u4e00" in str(choice.notes.in_order[0])
    choice.of(" ", None)
    assert len(choice.notes.in_order) == 1, "a space shows nothing, and is not missed"


def test_marks_and_selectors_go_with_the_character_before_them():
    latin, more = faces_in(LATIN)[0], faces_in(MORE)[0]
    assert belongs("\u0301", latin)
    assert not belongs("\u0301", more)
    assert belongs("\ufe0f", more)
    assert belongs("\u200d", more)
    assert not belongs("a", latin)
    assert [is_seen(character) for character in "a\u0301 \u200d\ufe0f"] == [True, True, False, False, False]


def test_glyphs_follow_one_another_by_their_advances():
    glyphs, width = line_of_glyphs("acb", choice_of(LATIN, MORE), Typesetting())
    advances = [glyph.glyph.advance[0] / glyph.glyph.face.units_per_em for glyph in glyphs]
    assert [glyph.text for glyph in glyphs] == ["a", "c", "b"]
    assert [glyph.x for glyph in glyphs] == pytest.approx([0.0, advances[0], advances[0] + advances[1]])
    assert width == pytest.approx(sum(advances))
    assert line_of_glyphs("", choice_of(LATIN), Typesetting()) == ([], 0.0)


def test_letters_from_right_to_left_stand_in_visual_order():
    glyphs, _ = line_of_glyphs("a\u05d0\u05d1", choice_of(LATIN, MORE), Typesetting())
    assert [glyph.text for glyph in glyphs] == ["a", "\u05d1", "\u05d0"]
    glyphs, _ = line_of_glyphs("a\u05d0\u05d1", choice_of(LATIN, MORE), Typesetting(base=1))
    assert [glyph.text for glyph in glyphs] == ["\u05d1", "\u05d0", "a"]


def test_without_any_font_the_remedy_is_named():
    with pytest.raises(SourceError, match="there is no font; give `font`, or install the default one"):
        line_of_glyphs("a", choice_of(), Typesetting())
