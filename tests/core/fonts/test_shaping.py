"""Shaping: kerning, features, directions and clusters."""

import pytest
from made import made_font

from vexture.base.errors import ParameterError
from vexture.fonts.face import faces_in
from vexture.fonts.shaping import shape


@pytest.fixture(scope="module")
def face():
    kerning = [("u0041", "u0056", -80)]
    chars = {"A": "square", "V": "disc", "א": "left", "ב": "tall", "😀": "disc"}
    return faces_in(made_font(chars, kerning=kerning))[0]


def advances(face, text, **options):
    return [glyph.advance[0] for glyph in shape(face, text, **options)]


def test_pairs_are_kerned_unless_the_feature_is_off(face):
    assert advances(face, "AVA") == [820.0, 900.0, 900.0]
    assert advances(face, "AVA", features=["-kern"]) == advances(face, "AVA", features=["kern=0"]) == [900.0] * 3


def test_text_from_right_to_left_is_in_visual_order(face):
    found = shape(face, "אב")
    assert [glyph.cluster for glyph in found] == [1, 0]
    assert [glyph.cluster for glyph in shape(face, "אב", direction="ltr")] == [0, 1]


def test_clusters_are_places_of_characters_beyond_the_basic_plane(face):
    assert [glyph.cluster for glyph in shape(face, "A😀V")] == [0, 1, 2]


def test_vertical_text_goes_down(face):
    assert all(glyph.advance[0] == 0.0 and glyph.advance[1] < 0.0 for glyph in shape(face, "AV", direction="ttb"))


def test_a_character_that_is_missing_is_glyph_zero(face):
    assert [glyph.glyph for glyph in shape(face, "Z")] == [0]


@pytest.mark.parametrize("feature", ["ligature", "liga=x", "", "liga=-1", "li ga"])
def test_features_that_are_none_are_refused(face, feature):
    with pytest.raises(ParameterError, match="is no OpenType feature; write one as smcp, -liga or salt=2"):
        shape(face, "A", features=[feature])
