"""From characters to clusters: choice of faces, division into runs, and shaping."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice, pairwise
from math import radians, tan
from typing import Final

from lxml import etree

from vexture.base.deadline import check_time
from vexture.fonts.face import Face
from vexture.fonts.levels import is_upright, levels, scripts
from vexture.fonts.library import Fonts
from vexture.fonts.lines import belongs, describe_character, is_seen
from vexture.fonts.shaping import Glyph, shape
from vexture.svg.report import Report
from vexture.svg.text.font_query import GENERIC, SMALL, FontQuery, query_of
from vexture.svg.text.tree import Characters, Span

SMALLER: Final = 0.7
"""Size of capitals that replace missing small capitals, as in browsers."""

SLANT: Final = tan(radians(14.0))
"""Slant of an oblique face that is made from an upright one (CSS Fonts 4, 2.4)."""

BOLD: Final = 600.0
"""Weight from which a lighter face is emboldened (CSS Fonts 4, 8.1)."""

EMBEDS: Final = {"embed": "\u202a\u202b", "isolate": "\u202a\u202b", "plaintext": "\u202a\u202b"}
OVERRIDES: Final = {"bidi-override": "\u202d\u202e", "isolate-override": "\u202d\u202e"}
POP: Final = "\u202c"


@dataclass(slots=True, eq=False)
class GlyphCluster:
    """Glyphs that belong together, with their position; lengths are in user units."""

    span: Span
    start: int  # first character
    end: int  # after the last character
    face: Face
    glyphs: tuple[Glyph, ...]
    scale: float  # user units per font unit
    advance: float  # to the next cluster
    width: float  # without spacing by styles
    level: int
    script: str
    upright: bool  # True if it is upright in vertical text
    slant: float = 0.0
    bolder: bool = False
    stretch: float = 1.0  # by `textLength`
    fitted: Span | None = None  # outermost element with a `textLength` that it is fitted into
    gap: float = 0.0  # part of the advance that `textLength` adds
    hidden: bool = False


@dataclass(frozen=True, slots=True)
class RunKind:
    """The properties that all characters of a run share."""

    wanted: FontQuery
    face: Face
    level: int
    script: str
    upright: bool
    small: bool  # True if its capitals replace small capitals


class TextFaces:
    """The faces that a drawing's texts use."""

    def __init__(self, fonts: Fonts, report: Report) -> None:
        self.fonts = fonts
        self.report = report
        self.known: dict[tuple[object, ...], tuple[list[Face], Iterator[Face]]] = {}
        self.found: dict[tuple[object, ...], Face | None] = {}
        self.counts: dict[tuple[object, ...], int] = {}  # number of faces that belong to the requested families
        self.small: dict[Face, bool] = {}
        self.noted: set[tuple[str, etree._Element]] = set()  # for the current text

    def of(self, want: FontQuery) -> Iterator[Face]:
        """Yield faces in the order in which a text tries them."""
        key = (want.families, want.weight, want.style, want.stretch, want.variations)
        if key not in self.known:
            faces = self.fonts.faces(*library_query(want))
            self.known[key] = ([], (with_variations(face, want.variations) for face in faces))
        listed, others = self.known[key]
        at = 0
        while True:
            if at == len(listed):
                face = next(others, None)
                if face is None:
                    return
                listed.append(face)
            yield listed[at]
            at += 1

    def choose(self, want: FontQuery, character: str) -> Face | None:
        """Return the first face that has a character; None if there is none."""
        key = (want.families, want.weight, want.style, want.stretch, want.variations, character)
        if key not in self.found:
            check_time()
            code = ord(character)
            self.found[key] = next((face for face in self.of(want) if face.has(code)), None)
        return self.found[key]

    def first(self, want: FontQuery) -> Face | None:
        """Return the first face."""
        return next(self.of(want), None)

    def has_small(self, face: Face) -> bool:
        """Return whether a face has its own small capitals."""
        if face not in self.small:
            plain, small = ([glyph.glyph for glyph in shape(face, "a", features=more)] for more in ((), (SMALL,)))
            self.small[face] = plain != small
        return self.small[face]

    def note(self, want: FontQuery, face: Face, character: str, element: etree._Element) -> None:
        """Note, once for each element, a family that is missing or lacks a character."""
        families = [family for family in want.families if family not in GENERIC]
        if library_query(want) not in self.counts:
            self.counts[library_query(want)] = self.fonts.count_named(*library_query(want))
        if not families or face in islice(self.of(want), self.counts[library_query(want)]):
            return
        if self.fonts.count_named(families, *library_query(want)[1:]):
            used = self.first(want)
            what = (
                f"{describe_character(character)}, which {families[0][:40] if used is None else used.family!r} lacks,"
            )
        else:
            what = f"font {families[0][:40]!r}"
            if (what, element) in self.noted:  # other characters of the element use another font
                return
            self.noted.add((what, element))
        self.note_once(self.report.simplification, f"{what} drawn in {face.family}", element)

    def note_once(self, report: Callable[[str, etree._Element], None], message: str, element: etree._Element) -> None:
        """Add a note only once for an element of a text."""
        if (message, element) not in self.noted:
            self.noted.add((message, element))
            report(message, element)


def library_query(want: FontQuery) -> tuple[tuple[str, ...], int, str, float]:
    """Return the arguments of `Fonts.faces` for a font query."""
    return want.families, round(want.weight), want.style, want.stretch


def with_variations(face: Face, variations: tuple[tuple[str, float], ...]) -> Face:
    """Return a face with values on its axes, clamped to the ranges of the axes."""
    axes = face.axes
    places = {tag: min(max(value, axes[tag][0]), axes[tag][1]) for tag, value in variations if tag in axes}
    return replace(face, variations=tuple(sorted((dict(face.variations) | places).items()))) if places else face


def clusters(found: Characters, faces: TextFaces, vertical: bool) -> list[GlyphCluster]:
    """Return the clusters of all characters, in logical order."""
    if not found.text:
        return []
    wants = queries_of(found.spans)
    kinds = kinds_of(found, [wants[span] for span in found.holders], faces, vertical)
    edges = [at for at in range(1, len(kinds)) if kinds[at] != kinds[at - 1] or found.starts_chunk(at)]
    result: list[GlyphCluster] = []
    for start, end in pairwise([0, *edges, len(kinds)]):
        kind = kinds[start]
        if kind is not None:
            result += shape_run(found, kind, start, end, faces, vertical)
    return sorted(result, key=lambda cluster: cluster.start)


def queries_of(spans: Sequence[Span]) -> dict[Span, FontQuery]:
    """Return the font query of each span; equal queries are one object."""
    same: dict[FontQuery, FontQuery] = {}
    found = {}
    for span in spans:
        want = query_of(span.place.style, span.element)
        found[span] = same.setdefault(want, want)
    return found


def kinds_of(found: Characters, wants: list[FontQuery], faces: TextFaces, vertical: bool) -> list[RunKind | None]:
    """Return the kind of each character; None for characters that show nothing: zero size, or no font."""
    heads = [characters[0] for characters in found.text]  # the first of the characters that each one becomes decides
    embedding = levels(heads, base_level(found.spans[0]), controls(found.spans))
    kinds: list[RunKind | None] = []
    last: Face | None = None
    for at, (character, script) in enumerate(zip(heads, scripts(heads), strict=True)):
        want = wants[at]
        before = last if at and wants[at - 1] is want else None
        face = face_of(want, character, faces, before, found.holders[at].element)
        last = face
        if face is None or want.size <= 0.0:
            kinds.append(None)
            continue
        style = found.holders[at].place.style
        small = (
            SMALL in want.features
            and "small-caps" in want.synthesis
            and (character.upper() != character or "c2sc" in want.features)
            and not faces.has_small(face)
        )
        kinds.append(RunKind(want, face, embedding[at], script, vertical and stands(character, style), small))
    return kinds


def stands(character: str, style: object) -> bool:
    """Return whether a character is upright in vertical text with a style."""
    if style["writing-mode"].lower().startswith("sideways"):  # type: ignore[index]
        return False
    orientation = style["text-orientation"].lower()  # type: ignore[index]
    older = style["glyph-orientation-vertical"].lower()  # type: ignore[index]
    if orientation == "upright" or older in ("0", "0deg"):
        return True
    if orientation.startswith("sideways") or older in ("90", "90deg"):
        return False
    return is_upright(character)


def face_of(
    want: FontQuery, character: str, faces: TextFaces, last: Face | None, element: etree._Element
) -> Face | None:
    """Return the face of a character; `last` is that of the one before, if both have the same query."""
    if last is not None and belongs(character, last):
        return last
    face = faces.choose(want, character)
    if face is not None:
        if not character.isspace():
            faces.note(want, face, character, element)
        return face
    face = last or faces.first(want)
    if face is not None and is_seen(character):
        faces.note_once(faces.report.missing_character, character, element)
    return face


def base_level(span: Span) -> int:
    """Return the embedding level of a whole text."""
    return int(span.place.style["direction"].lower() == "rtl")


def controls(spans: Sequence[Span]) -> list[tuple[int, str]]:
    """Return formatting characters for `direction` and `unicode-bidi` of spans (CSS Writing Modes 3, 2.4.2)."""
    opened: list[tuple[int, int, str]] = []
    for depth, span in enumerate(spans):
        style = span.place.style
        pair = (EMBEDS | OVERRIDES).get(style["unicode-bidi"].lower())
        if pair is None or span.start >= span.end or (depth == 0 and pair in EMBEDS.values()):
            continue
        opened.append((span.start, depth, pair[base_level(span)]))
        opened.append((span.end, -depth, POP))
    return [(at, control) for at, _, control in sorted(opened, key=lambda one: (one[0], one[2] != POP, one[1]))]


def ends_of(starts: Sequence[int], places: Sequence[int], end: int) -> dict[int, int]:
    """Return the end of each cluster in the text, by the start of the cluster in the shaped characters.

    `places` holds the text character of each shaped character. If one became several, the first cluster contains it,
    and the others end where they start.
    """
    ends: dict[int, int] = {}
    for at in reversed(starts):
        if at and places[at] == places[at - 1]:
            ends[at] = places[at]
        else:
            ends[at], end = end, places[at]
    return ends


def shape_run(
    found: Characters, kind: RunKind, start: int, end: int, faces: TextFaces, vertical: bool
) -> Iterator[GlyphCluster]:
    """Yield the clusters of characters of one kind, in logical order."""
    check_time()
    want, face = kind.wanted, kind.face
    text, places = "", list[int]()
    for at in range(start, end):
        character = found.text[at].upper() if kind.small else found.text[at]
        text += character
        places += [at] * len(character)
    size = want.size * (SMALLER if kind.small else 1.0)
    if want.adjust is not None and face.x_height > 0.0:
        size *= want.adjust * face.units_per_em / face.x_height
    scale = size / face.units_per_em
    direction = "ttb" if kind.upright else "rtl" if kind.level % 2 else "ltr"
    features = [feature for feature in want.features if not (kind.small and feature in (SMALL, "c2sc"))]
    glyphs = shape(face, text, direction=direction, script=kind.script, language=want.language, features=features)
    ends = ends_of(sorted({glyph.cluster for glyph in glyphs}), places, end)
    together: dict[int, list[Glyph]] = {}
    for glyph in glyphs:
        together.setdefault(glyph.cluster, []).append(glyph)
    oblique = want.style != "normal" and face.style == "normal" and "style" in want.synthesis
    bolder = want.weight >= BOLD and face.weight < BOLD and "weight" in want.synthesis
    for at, members in together.items():
        advance = sum(-glyph.advance[1] if kind.upright else glyph.advance[0] for glyph in members) * scale
        yield GlyphCluster(
            found.holders[places[at]],
            places[at],
            ends[at],
            face,
            tuple(members),
            scale,
            advance,
            advance,
            kind.level,
            kind.script,
            kind.upright,
            SLANT if oblique else 0.0,
            bolder,
        )
