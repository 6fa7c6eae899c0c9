"""Shaping: from characters to positioned glyphs."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from vexture.base.errors import ParameterError
from vexture.fonts.engine import harfbuzz
from vexture.fonts.face import Face


@dataclass(frozen=True, slots=True)
class Glyph:
    """A glyph in a line of text; lengths in font units of its face, y up.

    Parameters
    ----------
    face : Face
    glyph : int
        Its index in the face; 0 if the face lacks the character.
    cluster : int
        Index of the first character that it stands for. All glyphs of a cluster belong together.
    advance : (float, float)
        Vector from its origin to that of the next glyph; in vertical text it points down, so its y is negative.
    offset : (float, float)
        Vector from its origin to the position at which it is drawn.
    """

    face: Face
    glyph: int
    cluster: int
    advance: tuple[float, float]
    offset: tuple[float, float]


def shape(
    face: Face,
    text: str,
    *,
    direction: str | None = None,
    script: str | None = None,
    language: str | None = None,
    features: Sequence[str] = (),
) -> list[Glyph]:
    """Shape a text of one direction, script and face; return its glyphs from left to right, or from top to bottom.

    Parameters
    ----------
    face : Face
    text : str
    direction : {"ltr", "rtl", "ttb", "btt"}, optional
        By default the direction of the script.
    script : str, optional
        ISO 15924 code, such as ``"Arab"``; by default the script of the first character that has one.
    language : str, optional
        BCP 47 tag, such as ``"nl"``.
    features : sequence of str
        OpenType features: ``"smcp"`` or ``"smcp=1"`` turns on, ``"-liga"`` or ``"liga=0"`` off; ``"salt=2"`` chooses.
    """
    hb = harfbuzz()
    buffer = hb.Buffer()
    buffer.add_str(text)
    if direction is not None:
        buffer.direction = direction
    if script is not None:
        buffer.script = script
    if language is not None:
        buffer.language = language
    buffer.guess_segment_properties()
    hb.shape(face._font, buffer, dict(feature_of(feature) for feature in features))
    is_vertical = buffer.direction in ("ttb", "btt")
    return [
        Glyph(
            face,
            info.codepoint,
            info.cluster,
            place.position[2:],
            (place.position[0], place.position[1] + (face.vertical_offset(info.codepoint) if is_vertical else 0.0)),
        )
        for info, place in zip(buffer.glyph_infos, buffer.glyph_positions or (), strict=True)
    ]


@cache
def feature_of(text: str) -> tuple[str, int]:
    """Parse a feature into its tag and value.

    Examples
    --------
    >>> feature_of("smcp"), feature_of("-liga"), feature_of("salt=2")
    (('smcp', 1), ('liga', 0), ('salt', 2))
    """
    tag, equals, value = text.strip().lstrip("+-").partition("=")
    if len(tag) != 4 or not tag.isascii() or not tag.isalnum() or bool(equals) != value.isdecimal():
        raise ParameterError(f"`features` {text!r} is no OpenType feature; write one as smcp, -liga or salt=2")
    return tag, int(value) if equals else int(not text.strip().startswith("-"))
