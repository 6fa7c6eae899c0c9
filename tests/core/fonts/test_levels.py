"""Directions of characters: visual orders are those of another implementation of Unicode Annex 9."""

import bidi
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from vexture.fonts.levels import levels, scripts, visual_order


def in_visual_order(text, base):
    return "".join(text[place] for place in visual_order(levels(text, base, ())))


@given(st.text("aabאאבع12٣ (())[].,-+%:$", max_size=16), st.integers(0, 1))
@example("שלום (abc) 123", 1)
@example("a (ב) [א(b]) ", 0)
@example("אב(ab", 0)
def test_texts_are_in_the_order_of_unicode(text, base):
    assert in_visual_order(text, base) == bidi.get_display(text, base_dir="LR"[base])


@pytest.mark.parametrize(("text", "found"), [("a1б", "Latn Latn Cyrl"), ("1ا", "Arab Arab"), ("1", "Latn"), ("", "")])
def test_common_characters_have_the_script_of_their_neighbours(text, found):
    assert " ".join(scripts(text)) == found
