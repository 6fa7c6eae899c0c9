"""The fonts that a text may use, and which of them it gets."""

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import chain
from pathlib import Path
from typing import Final, TypeAlias

from vexture.content import about
from vexture.errors import SourceError
from vexture.fonts.face import Face, faces_in, faces_of
from vexture.fonts.files import SUFFIXES
from vexture.fonts.matching import Traits, preference
from vexture.fonts.system import default_files, font_files, generic_family, system_files

__all__ = ["GENERIC", "EmbeddedFont", "Fonts"]

Place: TypeAlias = str | os.PathLike[str]

SANS: Final = ("Noto Sans", "DejaVu Sans", "Liberation Sans", "Arial", "Helvetica", "Segoe UI")
GENERIC: Final = {
    "serif": ("Noto Serif", "DejaVu Serif", "Liberation Serif", "Times New Roman", "Times"),
    "sans-serif": SANS,
    "monospace": ("Noto Sans Mono", "DejaVu Sans Mono", "Liberation Mono", "Menlo", "Consolas", "Courier New"),
    "cursive": ("Comic Neue", "Comic Sans MS", "Apple Chancery"),
    "fantasy": ("Impact", "Papyrus"),
    "system-ui": SANS,
    "emoji": ("Noto Color Emoji", "Apple Color Emoji", "Segoe UI Emoji", "Twemoji Mozilla"),
    "math": ("Noto Sans Math", "STIX Two Math", "Cambria Math"),
}
"""Generic families, and what may stand for them where fontconfig does not say."""


@dataclass(frozen=True, slots=True)
class EmbeddedFont:
    """A font of a drawing, as an ``@font-face`` rule describes it; where it says nothing, the font itself does."""

    family: str
    content: bytes | Face
    weights: tuple[float, float] | None = None
    stretches: tuple[float, float] | None = None
    style: str | None = None
    ranges: tuple[tuple[int, int], ...] = ()  # first and last characters that it is used for; all without any


@dataclass(frozen=True)
class Listed:
    """A face that may be used."""

    names: frozenset[str]
    traits: Traits
    face: Face


class Fonts:
    """Fonts for texts, from files, a drawing, the system and a default font.

    Parameters
    ----------
    files : iterable of path
        Font files, and folders of them.
    embedded : iterable of EmbeddedFont
        Fonts of the drawing.
    system : bool
        Whether the system's fonts are used too.

    Raises
    ------
    SourceError
        If a file cannot be read or is no font, or a folder holds none.
    DeviceError
        If uharfbuzz is not installed.
    """

    def __init__(self, files: Iterable[Place] = (), embedded: Iterable[EmbeddedFont] = (), system: bool = True) -> None:
        self.files = tuple(Path(file) for file in files)
        self.embedded = tuple(embedded)
        self.system = system

    def faces(
        self, families: Sequence[str], weight: int = 400, style: str = "normal", stretch: float = 100.0
    ) -> Iterator[Face]:
        """Faces for a text, the best first: use for each character the first that has it.

        Those of the families come first, and then one of each other family: of the given files, of the default font,
        of the system. `Face.family` tells what a face is of.
        """
        shown: set[int] = set()
        for listed in chain(self._named(families, weight, style, stretch), self._others(weight, style, stretch)):
            if id(listed) not in shown:
                shown.add(id(listed))
                yield listed.face.varied(weight, stretch, style)

    def count_named(
        self, families: Sequence[str], weight: int = 400, style: str = "normal", stretch: float = 100.0
    ) -> int:
        """Number of the first `faces` that are of the families; the others stand in for these."""
        return len({id(listed) for listed in self._named(families, weight, style, stretch)})

    def _named(self, families: Sequence[str], weight: float, style: str, stretch: float) -> Iterator[Listed]:
        """The best face of each of some families."""
        for name in self._asked(families):
            yield from self._chosen(name, weight, style, stretch)

    def _asked(self, families: Sequence[str]) -> Iterator[str]:
        """Names of families, with those that stand for generic ones: given ones, the system's choice, and others."""
        for family in families:
            yield family
            if family.lower() in GENERIC:
                given = {name for listed in (*self._given, *self._embedded) for name in listed.names}
                yield from (name for name in GENERIC[family.lower()] if name.casefold() in given)
                yield from filter(None, [generic_family(family.lower()) if self.system else ""])
                yield from GENERIC[family.lower()]

    def local(self, name: str) -> Face | None:
        """The face of a full or PostScript name among the given fonts and those of the system; None without it."""
        found = (
            listed.face
            for source in self._sources()
            if source is not self._embedded
            for listed in source
            if name.casefold() in listed.face.full_names
        )
        return next(found, None)

    def _chosen(self, name: str, weight: float, style: str, stretch: float) -> Iterator[Listed]:
        """The best face of a family in the first source that has the family.

        Of a family of the drawing all that are as good come, the last one first: each is for characters of its own
        (CSS Fonts 4, 5.3).
        """

        def rank(listed: Listed) -> tuple[float, ...]:
            return preference(listed.traits, weight, style, stretch)

        for source in self._sources():
            named = [listed for listed in source if name.casefold() in listed.names]
            if named:
                best = min(named, key=rank)
                is_own = source is self._embedded
                yield from [one for one in reversed(named) if rank(one) == rank(best)] if is_own else [best]
                return

    def _others(self, weight: float, style: str, stretch: float) -> Iterator[Listed]:
        """The best face of each family of each source; a font of the drawing stands in for no other one."""
        for source in self._sources():
            if source is self._embedded:
                continue
            families: dict[str, list[Listed]] = {}
            for listed in source:
                families.setdefault(listed.face.family, []).append(listed)
            for named in families.values():
                yield min(named, key=lambda listed: preference(listed.traits, weight, style, stretch))

    def _sources(self) -> Iterator[tuple[Listed, ...]]:
        yield self._given
        yield self._embedded
        yield of_files(default_files())
        if self.system:
            yield of_files(system_files())

    @cached_property
    def _given(self) -> tuple[Listed, ...]:
        found: list[Listed] = []
        for path in self.files:
            if path.is_dir():
                in_it = of_files(tuple(font_files(path)))
                if not in_it:
                    kinds = ", ".join(SUFFIXES)
                    raise SourceError(f"{path}: the folder holds no font that can be read; give one with {kinds}")
                found += in_it
                continue
            with about(os.fspath(path)):
                found += map(listed_of, faces_of(path))
        return tuple(found)

    @cached_property
    def _embedded(self) -> tuple[Listed, ...]:
        found = []
        for font in self.embedded:
            with about(f"the font {font.family!r} of the drawing"):
                face = font.content if isinstance(font.content, Face) else faces_in(font.content)[0]
                own = listed_of(replace(face, ranges=font.ranges))
            traits = Traits(
                font.weights or own.traits.weights,
                font.stretches or own.traits.stretches,
                own.traits.styles if font.style is None else (font.style,),
            )
            found.append(Listed(frozenset([font.family.casefold()]), traits, own.face))
        return tuple(found)


@cache
def of_files(paths: tuple[Path, ...]) -> tuple[Listed, ...]:
    """All faces of files; those that cannot be read are passed over."""
    found: list[Listed] = []
    for path in paths:
        try:
            found += map(listed_of, faces_of(path))
        except SourceError:
            continue
    return tuple(found)


def listed_of(face: Face) -> Listed:
    """A face with its names and what it offers."""
    axes = face.axes
    slopes = [style for style, axis in (("italic", "ital"), ("oblique", "slnt")) if axis in axes]
    traits = Traits(
        axes.get("wght", (face.weight, face.weight)),
        axes.get("wdth", (face.stretch, face.stretch)),
        (face.style, *slopes),
    )
    return Listed(frozenset(name.casefold() for name in face.names), traits, face)
