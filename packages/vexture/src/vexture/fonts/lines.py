"""Lines of text: the face of each character, and the positions of its glyphs."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, takewhile
from typing import Final
from unicodedata import category

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.base.notes import Notes, format_character
from vexture.fonts.face import Face
from vexture.fonts.levels import levels, scripts, visual_order
from vexture.fonts.shaping import Glyph, shape

SELECTORS: Final = frozenset(map(chr, (*range(0xFE00, 0xFE10), *range(0xE0100, 0xE01F0))))
"""Variation selectors, which choose a form of the preceding character."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A glyph in a line: its origin on the baseline, in ems, y up, and the characters that it stands for."""

    glyph: Glyph
    x: float
    y: float
    text: str


@dataclass(frozen=True, slots=True)
class Typesetting:
    """Settings for lines.

    Parameters
    ----------
    base : int
        Embedding level of the text: 0 from left to right, 1 from right to left.
    language : str or None
    features : sequence of str
    """

    base: int = 0
    language: str | None = None
    features: Sequence[str] = ()


@dataclass(slots=True)
class FaceChoice:
    """The available faces in order; each character gets the first one that has it."""

    faces: Iterator[Face]
    notes: Notes
    is_asked: bool  # the first face was requested, so that a note names any other face
    tried: list[Face] = field(default_factory=list)
    others: dict[str, str] = field(default_factory=dict)  # families of other faces, each with an example character

    @property
    def first(self) -> Face:
        """First face of all; raises a `SourceError` if there is none."""
        for face in self._all():
            return face
        raise SourceError("there is no font; give `font`, or install the default one: pip install 'vexture[text]'")

    def of(self, character: str, last: Face | None) -> Face:
        """Return the face of a character; `last` is the face of the character before, which it may have to share."""
        if last is not None and belongs(character, last):
            return last
        for face in self._all():
            check_time()
            if face.has(ord(character)):
                if self.is_asked and not self.is_first(face) and not character.isspace():
                    example = self.others.setdefault(face.family, describe_character(character))
                    self.notes.simplification(f"{example}, which {self.first.family} lacks, and such in {face.family}")
                return face
        if is_seen(character):
            self.notes.missing_character(character)
        return last or self.first

    def subsets(self) -> Iterator[Face]:
        """Yield the first face, and other subsets of the same font."""
        return takewhile(self.is_first, self._all())

    def is_first(self, face: Face) -> bool:
        """Return whether a face is the first one, or another subset of the same font."""
        return face.full_names == self.first.full_names

    def _all(self) -> Iterator[Face]:
        at = 0
        while True:
            if at == len(self.tried):
                face = next(self.faces, None)
                if face is None:
                    return
                self.tried.append(face)
            yield self.tried[at]
            at += 1


def belongs(character: str, last: Face) -> bool:
    """Return whether a character must share the face of the one before: selectors, and marks that this face has."""
    kind = category(character)
    return kind == "Cf" or character in SELECTORS or (kind[0] == "M" and last.has(ord(character)))


def is_seen(character: str) -> bool:
    """Return whether a character is visible by itself."""
    return category(character) not in ("Cc", "Cf", "Zs") and character not in SELECTORS


def describe_character(character: str) -> str:
    """Describe a character for a message."""
    return f"character {format_character(character)}"


def line_of_glyphs(text: str, choice: FaceChoice, setting: Typesetting) -> tuple[list[Placed], float]:
    """Return the glyphs of a line from left to right, starting at 0, and the line's width; all in ems."""
    if not text:
        return [], 0.0
    embedding = levels(text, setting.base, ())
    kinds: list[tuple[Face, int, str]] = []
    for character, level, script in zip(text, embedding, scripts(text), strict=True):
        kinds.append((choice.of(character, kinds[-1][0] if kinds else None), level, script))
    edges = [0, *(k for k in range(1, len(text)) if kinds[k] != kinds[k - 1]), len(text)]
    runs = list(pairwise(edges))
    found: list[Placed] = []
    x = 0.0
    for place in visual_order([kinds[start][1] for start, _ in runs]):
        start, end = runs[place]
        for glyph, shown in shape_run(text[start:end], *kinds[start], setting):
            scale = 1.0 / glyph.face.units_per_em
            found.append(Placed(glyph, x + glyph.offset[0] * scale, glyph.offset[1] * scale, shown))
            x += glyph.advance[0] * scale
    return found, x


def shape_run(text: str, face: Face, level: int, script: str, setting: Typesetting) -> Iterator[tuple[Glyph, str]]:
    """Yield the glyphs of a run in visual order, each with the characters of its cluster."""
    direction = "rtl" if level % 2 else "ltr"
    glyphs = shape(face, text, direction=direction, script=script, language=setting.language, features=setting.features)
    starts = sorted({glyph.cluster for glyph in glyphs})
    ends = dict(pairwise([*starts, len(text)]))
    for glyph in glyphs:
        yield glyph, text[glyph.cluster : ends[glyph.cluster]]
