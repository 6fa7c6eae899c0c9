"""A texture with the glyphs of a font as its shapes, and the metrics that programs need to lay out text."""

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.base.deadline import DEFAULT_SECONDS, check_time, within
from vexture.base.errors import LimitError, ParameterError, SourceError, format_count
from vexture.base.notes import Note, Notes, warn_of
from vexture.conversion.pipeline import atlas
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import BLACK
from vexture.fonts.face import Face
from vexture.fonts.levels import LATIN, scripts
from vexture.fonts.lines import FaceChoice, Placed, describe_character
from vexture.fonts.shaping import Glyph, shape
from vexture.fonts.text import Places, TextCanvas, TextOptions

if TYPE_CHECKING:
    from vexture.texture.texture import Texture

PRINTABLE: Final = "".join(map(chr, range(0x20, 0x7F)))
"""The printable characters of ASCII."""

MOST_CHARACTERS: Final = 4096

MOST_KERNED: Final = 1024
"""Kerning is left out above this number of characters, because every pair is shaped: here a million pairs."""

UNKERNED: Final = f"kerning: there are more than {MOST_KERNED:,} characters, so that there are too many pairs"

LINE_METRICS: Final = ("ascender", "descender", "line_gap", "x_height", "cap_height")

DIGITS: Final = 6
"""Decimals of metrics: a millionth of an em."""


@dataclass(frozen=True, slots=True, eq=False)
class FontAtlas:
    """A texture with a shape for each glyph, and the metrics of the font.

    Parameters
    ----------
    texture : Texture
        `Root.to_source` maps the unit square of a shape to ems, y up, from the origin of its glyph.
    metrics : dict
        Ready for JSON, as the guide to fonts describes it; all lengths are in ems.
    notes : tuple of Note
        Characters that the font lacks, and everything else that was left out.
    """

    texture: "Texture"
    metrics: dict[str, Any]
    notes: tuple[Note, ...] = ()

    def files(self, path: Path, *, deflate: bool = True) -> dict[Path, bytes]:
        """Return the contents of two files: the texture, and next to it the metrics, with the suffix ``.json``."""
        text = json.dumps(self.metrics, ensure_ascii=False, separators=(",", ":")) + "\n"
        return {path: self.texture.to_ktx2(deflate=deflate), path.with_suffix(".json"): text.encode()}

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the texture's file and the metrics next to it; return its path; raise as `Texture.save` does."""
        from vexture.texture.files import target_of, write_together

        target = target_of(path, self.texture.name)
        write_together(self.files(target))
        return target


def font_atlas(
    font: Places = (),
    characters: Iterable[str] = PRINTABLE,
    *,
    weight: float = 400,
    style: str = "normal",
    stretch: float = 100.0,
    name: str | None = None,
    **parameters: Any,
) -> FontAtlas:
    """Convert characters of a font into the shapes of one texture, with their metrics.

    Parameters
    ----------
    font : path or sequence of path
        A font file, or a folder of the faces of a font; by default the default font, Noto Sans.
    characters : iterable of str
        By default the printable characters of ASCII. Each shape is named after its character; characters with the
        same glyph share a shape. One more shape, named ``.notdef``, is the font's glyph for characters that it lacks.
        Ligatures and the joined forms of cursive scripts are not characters: draw them with `vexture.text`.
    weight, style, stretch
        Selects the face, as in `vexture.text`.
    name : str, optional
        Name of the texture; by default the font's family.
    **parameters
        Parameters of `vexture.atlas`, such as `tolerance`.

    Returns
    -------
    FontAtlas

    Raises
    ------
    SourceError
        If the font cannot be read, or has none of the characters.
    ParameterError
        If `characters` is empty, or holds more than one character in an entry.
    LimitError
        If there are too many characters.
    DeviceError
        If ``vexture[text]`` is not installed.

    Warns
    -----
    SourceWarning
        Once, with all notes.

    Examples
    --------
    >>> made = font_atlas(characters="AV ")
    >>> [root.name for root in made.texture.roots]
    ['A', 'V', '.notdef']
    >>> made.metrics["kerning"]["A"]
    {'V': -0.04}
    """
    result = made_atlas(TextOptions(font, (), weight, style, stretch, name=name), characters, **parameters)
    warn_of(result.texture.name, result.notes)
    return result


def made_atlas(
    options: TextOptions, characters: Iterable[str], optional: Iterable[int] = (), **parameters: Any
) -> FontAtlas:
    """Make an atlas as `font_atlas` does, but without a warning.

    Of `options`, only the font and its style are used. The font may lack the characters whose codes are `optional`.
    """
    notes = Notes()
    required, ranged = [*characters], [*optional]
    if not required and not ranged:
        raise ParameterError("`characters` is empty; give some, such as a text that holds them")
    for each in required:
        if not (isinstance(each, str) and len(each) == 1):
            raise ParameterError(f"`characters` holds {each!r}, which is not one character; give them one by one")
    with within(parameters.get("max_seconds", DEFAULT_SECONDS)):
        unique = [*dict.fromkeys([*required, *map(chr, ranged)])]
        choice = options.choice(notes, unique)
        face = choice.first
        faces = faces_of_characters(choice, unique)
        found = {character: faces[character] for character in unique if character in faces}
        missing = [character for character in dict.fromkeys(required) if character not in found]
        if len(found) + len(missing) > MOST_CHARACTERS:
            many = f"{len(found) + len(missing):,} characters, of at most {MOST_CHARACTERS:,}"
            raise LimitError(f"{many}; make several atlases")
        for character in missing:
            notes.left_out(f"{describe_character(character)}, which {face.family} lacks")
        if not found:
            number = format_count(len(required) + len(ranged), "character")
            raise SourceError(f"{face.family} has none of what is asked for ({number}); give others as `characters`")
        glyphs = {character: shape(of, character, features=PLAIN)[0] for character, of in found.items()}
        box = missing_glyph(face)
        shapes = drawn(glyphs | {NOTDEF: box}, notes)
        if not shapes.keys() - {key_of(box)}:
            raise SourceError(f"the characters of {face.family} show nothing; give others as `characters`")
        texture = atlas([each.drawing for each in shapes.values()], name=options.name or face.family, **parameters)
        uncoloured = tuple(replace(root, paint=None) for root in texture.roots)  # programs colour them
        texture = replace(texture, roots=uncoloured)
        entries = {character: entry(glyph, shapes) for character, glyph in glyphs.items()}
        pairs = kerning(glyphs) if len(found) <= MOST_KERNED else {}
    if len(found) > MOST_KERNED:
        notes.left_out(UNKERNED)
    metrics = {
        "font": facts(face),
        "lines": lines(face),
        "glyphs": entries,
        "notdef": entry(box, shapes),
        "kerning": pairs,
        "missing": missing,
    }
    return FontAtlas(texture, metrics, notes.in_order)


def faces_of_characters(choice: FaceChoice, characters: Iterable[str]) -> dict[str, Face]:
    """Map each character to the first face or other subset of the font that has it; leave out those of neither."""
    left = dict.fromkeys(characters)
    found: dict[str, Face] = {}
    for face in choice.subsets():
        check_time()
        found |= {character: face for character in left if face.has(ord(character))}
        left = {character: None for character in left if character not in found}
        if not left:
            break
    return found


PLAIN: Final = ("-liga", "-clig", "-calt", "-rlig")
"""Switch off the features that make one glyph of several characters."""


NOTDEF: Final = ".notdef"
"""Name of the glyph that stands for characters that a font lacks; fonts call it that, too."""


def missing_glyph(face: Face) -> Glyph:
    """Return the glyph that a font shows for characters that it lacks."""
    privates = map(chr, range(0x10FFFD, 0xF0000, -1))
    lacked = next(character for character in privates if not face.has(ord(character)))
    return shape(face, lacked, features=PLAIN)[0]


@dataclass(frozen=True, slots=True, eq=False)
class GlyphShape:
    """A glyph that has an outline: its drawing, and its box (left, bottom, right, top); both in ems, y up."""

    drawing: Drawing
    box: tuple[float, float, float, float]


def key_of(glyph: Glyph) -> tuple[Face, int]:
    """Return a key for a glyph that includes the face, as several faces may be subsets of one font."""
    return glyph.face, glyph.glyph


def drawn(glyphs: dict[str, Glyph], notes: Notes) -> dict[tuple[Face, int], GlyphShape]:
    """Draw each distinct glyph once, and name its shape after the first of its characters."""
    found: dict[tuple[Face, int], GlyphShape] = {}
    for character, glyph in glyphs.items():
        if key_of(glyph) in found:
            continue
        canvas = TextCanvas(1.0, BLACK, notes)
        canvas.draw(Placed(glyph, 0.0, 0.0, character), 0.0, 0.0)
        left, top, right, bottom = canvas.painted_box
        if left < right and top < bottom:
            drawing = canvas.drawing(canvas.painted_box, character)
            upwards = np.array([[1.0], [-1.0]]) * drawing.to_source + 0.0  # no -0.0
            found[key_of(glyph)] = GlyphShape(replace(drawing, to_source=upwards), (left, -bottom, right, -top))
    return found


def entry(glyph: Glyph, shapes: dict[tuple[Face, int], GlyphShape]) -> dict[str, Any]:
    """Return the metrics of one character."""
    advance = glyph.advance[0] / glyph.face.units_per_em
    if key_of(glyph) not in shapes:
        return {"shape": None, "advance": round_length(advance)}
    found = shapes[key_of(glyph)]
    (side, _, x), (_, _, y) = found.drawing.to_source.tolist()
    left, _, right, _ = found.box
    return {
        "shape": [*shapes].index(key_of(glyph)),
        "advance": round_length(advance),
        "bearings": [round_length(left), round_length(advance - right)],
        "box": [round_length(part) for part in found.box],
        "square": [round_length(x), round_length(y), round_length(side)],
    }


def kerning(glyphs: dict[str, Glyph]) -> dict[str, dict[str, float]]:
    """Return the nonzero kerning of pairs of characters of one face: first character, second character, ems."""
    kinds = {character: scripts([character])[0] for character in glyphs}  # a script that several share counts as Latin
    groups: dict[Face, dict[str, list[str]]] = {}
    for character, script in kinds.items():
        groups.setdefault(glyphs[character].face, {}).setdefault(script, []).append(character)
    found: dict[str, dict[str, float]] = {}
    for first, one in glyphs.items():
        check_time()
        pairs = {}
        for group, seconds in groups[one.face].items():
            script = group if kinds[first] == LATIN else kinds[first]
            line = "".join(first + second for second in seconds)
            row = shape(one.face, line, direction="ltr", script=script, features=PLAIN)
            clusters = {glyph.cluster: glyph for glyph in row}
            for place, second in enumerate(seconds):
                glyph = clusters.get(2 * place)
                if glyph is not None and glyph.glyph == one.glyph and glyph.advance != one.advance:
                    pairs[second] = round_length((glyph.advance[0] - one.advance[0]) / one.face.units_per_em)
        if pairs:
            found[first] = pairs
    return found


def facts(face: Face) -> dict[str, Any]:
    """Return the properties that identify the font."""
    return {"family": face.family, "weight": face.weight, "style": face.style, "stretch": face.stretch}


def lines(face: Face) -> dict[str, Any]:
    """Return the metrics of lines, in ems."""
    em = face.units_per_em
    heights = {name: round_length(getattr(face, name) / em) for name in LINE_METRICS}
    places = {name: [round_length(part / em) for part in getattr(face, name)] for name in ("underline", "strikeout")}
    return heights | places


def round_length(length: float) -> float:
    """Round a length to the precision of the metrics."""
    return round(length, DIGITS)
