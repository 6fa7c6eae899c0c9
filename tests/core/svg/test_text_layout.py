"""Texts that are laid out: their lengths, and characters that stay together."""

from pathlib import Path

from svg_texts import drawn


def test_selectors_stay_with_their_character(tmp_path: Path) -> None:
    plain, chosen = (
        drawn(tmp_path, f'<text y="50" font-family="cmr10">a{selector}</text>') for selector in ("", "\U000e0101")
    )
    assert not chosen.notes
    assert (plain.paths[0].box == chosen.paths[0].box).all()


def test_a_length_of_zero_does_not_squeeze(tmp_path: Path) -> None:
    bodies = [f'<text y="50" {length} lengthAdjust="spacingAndGlyphs">ab</text>' for length in ("", 'textLength="0"')]
    natural, zero = (drawn(tmp_path, body).paths[0] for body in bodies)
    assert (natural.box == zero.box).all()
