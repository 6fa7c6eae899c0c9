"""Fonts for texts, from files, the drawing, the system and the default font, and the choice among them."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from string import ascii_letters
from typing import Final, TypeAlias

from vexture.base.content import about
from vexture.base.errors import SourceError
from vexture.fonts.face import Face, faces_in, faces_of
from vexture.fonts.files import SUFFIXES
from vexture.fonts.matching import NORMAL_STRETCH, REGULAR, Traits, preference

Place: TypeAlias = str | os.PathLike[str]

SANS: Final = ("Noto Sans", "DejaVu Sans", "Liberation Sans", "Arial", "Helvetica", "Segoe UI")
LATIN: Final = frozenset(map(ord, ascii_letters))
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
"""Generic families, with families that can replace them if fontconfig offers none."""

DEFAULT_PACKAGE: Final = "fontpkg_noto_sans"
"""Package that contains the default font, Noto Sans, in its folder ``files``."""

PATIENCE: Final = 20.0
"""Time limit in seconds for a program of fontconfig, which may have to build its caches."""

LINUX: Final = ("/usr/share/fonts", "/usr/local/share/fonts", "~/.fonts", "~/.local/share/fonts")
MACOS: Final = ("/System/Library/Fonts", "/Library/Fonts", "~/Library/Fonts")
WINDOWS: Final = ("%WINDIR%/Fonts", "%LOCALAPPDATA%/Microsoft/Windows/Fonts")
"""Usual font folders of each system."""


@dataclass(frozen=True, slots=True)
class EmbeddedFont:
    """A font of a drawing, from an ``@font-face`` rule; what the rule leaves out is taken from the font itself."""

    family: str
    content: bytes | Face
    weights: tuple[float, float] | None = None
    stretches: tuple[float, float] | None = None
    style: str | None = None
    ranges: tuple[tuple[int, int], ...] = ()  # first and last characters of its ranges; empty for all


@dataclass(frozen=True)
class Listed:
    """An available face."""

    names: frozenset[str]
    traits: Traits
    face: Face
    place: int = 0  # index of the file or folder that it comes from
    file: Path | None = None  # None for a font of the drawing


@dataclass(frozen=True, slots=True)
class FontRequest:
    """Request for a face: a style, and the codes of characters that need glyphs."""

    weight: float
    style: str
    stretch: float
    codes: frozenset[int] = frozenset()

    def rank(self, listed: Listed) -> tuple[float, ...]:
        """Return a sort key that puts the best style first."""
        return preference(listed.traits, self.weight, self.style, self.stretch)

    def best_of(self, faces: Sequence[Listed]) -> list[Listed]:
        """Return the best face, or all subsets of it if the font is split, those with most of the characters first.

        Many subsets contain a few Latin letters. Among subsets with equally many of the characters, the one with most
        Latin letters comes first, so that pairs of letters are kerned.
        """
        best = min(faces, key=self.rank)
        name, rank = best.face.full_names, self.rank(best)
        subsets = [one for one in faces if one.face.full_names == name and self.rank(one) == rank]
        if len(subsets) > 1:
            subsets.sort(
                key=lambda one: (len(self.codes & (own := one.face.characters)), len(LATIN & own)), reverse=True
            )
        return subsets


class Fonts:
    """Fonts for texts, from files, a drawing, the system and a default font.

    Parameters
    ----------
    files : iterable of path
        Font files, and folders of font files.
    embedded : iterable of EmbeddedFont
        Fonts of the drawing.
    system : bool
        True to use the system's fonts, too.

    Raises
    ------
    SourceError
        If a file cannot be read or is not a font, or a folder contains none.
    DeviceError
        If uharfbuzz is not installed.
    """

    def __init__(self, files: Iterable[Place] = (), embedded: Iterable[EmbeddedFont] = (), system: bool = True) -> None:
        self.files = tuple(Path(file) for file in files)
        self.embedded = tuple(embedded)
        self.system = system

    def faces(
        self,
        families: Sequence[str],
        weight: int = 400,
        style: str = "normal",
        stretch: float = 100.0,
        characters: Iterable[str] = ascii_letters,
    ) -> Iterator[Face]:
        """Yield the faces for a text, the best first: each character uses the first face that has it.

        Faces of `families` come first, then one of each other family: from the files, the default font and the system.
        `Face.family` names the family. A font may be split into subsets, as web fonts are: all subsets of a face are
        consecutive, those with most of the `characters` first.
        """
        seen: set[int] = set()
        for listed in self._candidates(families, FontRequest(weight, style, stretch, frozenset(map(ord, characters)))):
            if id(listed) not in seen:
                seen.add(id(listed))
                yield listed.face.with_style(weight, stretch, style)

    def substitute(
        self, families: Sequence[str], weight: int = 400, style: str = "normal", stretch: float = 100.0
    ) -> Path | None:
        """Return the file of the first of `faces` if it lacks the requested weight, width or upright style, else None.

        Also return None if there is no choice: only one face exists, and the normal weight and width are requested. A
        missing slope is ignored.
        """
        request = FontRequest(weight, style, stretch)
        first = next(self._candidates(families, request), None)
        if first is None or first.traits.offers(weight, style if style == "normal" else None, stretch):
            return None
        is_one = len({one.traits for one in self._beside(first)}) == 1
        return None if is_one and (weight, stretch) == (REGULAR, NORMAL_STRETCH) else first.file

    def _beside(self, listed: Listed) -> Iterator[Listed]:
        """Yield the alternatives to a chosen face: the faces in the same file or folder, or else of the same family."""
        for source in self._sources():
            if listed in source:
                if source is self._given_faces:
                    yield from (one for one in source if one.place == listed.place)
                else:
                    yield from (one for one in source if one.names & listed.names)
                return

    def _candidates(self, families: Sequence[str], request: FontRequest) -> Iterator[Listed]:
        """Yield the candidate faces, the best first, with repetitions."""
        return chain(self._named(families, request), self._others(request))

    def count_named(
        self, families: Sequence[str], weight: int = 400, style: str = "normal", stretch: float = 100.0
    ) -> int:
        """Return how many of the first `faces` belong to the families; the others are substitutes."""
        return len({id(listed) for listed in self._named(families, FontRequest(weight, style, stretch))})

    def _named(self, families: Sequence[str], request: FontRequest) -> Iterator[Listed]:
        """Yield the best face of each family."""
        for name in self._family_names(families):
            yield from self._chosen(name, request)

    def _family_names(self, families: Sequence[str]) -> Iterator[str]:
        """Yield family names; a generic one is replaced by those of the files, of fontconfig, and common ones."""
        for family in families:
            yield family
            if family.lower() in GENERIC:
                available = {name for listed in (*self._given_faces, *self._embedded) for name in listed.names}
                yield from (name for name in GENERIC[family.lower()] if name.casefold() in available)
                yield from filter(None, [generic_family(family.lower()) if self.system else ""])
                yield from GENERIC[family.lower()]

    def local(self, name: str) -> Face | None:
        """Return the face with a full or PostScript name, but none of the drawing's; None if there is none."""
        found = (
            listed.face
            for source in self._sources()
            if source is not self._embedded
            for listed in source
            if name.casefold() in listed.face.full_names
        )
        return next(found, None)

    def _chosen(self, name: str, request: FontRequest) -> Iterator[Listed]:
        """Yield the best face of a family from the first source that has the family.

        For a family of the drawing, yield all equally good faces, the last first: each is for its own characters (CSS
        Fonts 4, 5.3).
        """
        for source in self._sources():
            named = [listed for listed in source if name.casefold() in listed.names]
            if named:
                if source is self._embedded:
                    best = min(map(request.rank, named))
                    yield from (one for one in reversed(named) if request.rank(one) == best)
                else:
                    yield from request.best_of(named)
                return

    def _others(self, request: FontRequest) -> Iterator[Listed]:
        """Yield the best face of each family of each source; fonts of the drawing are no substitutes.

        Of the families in a given folder, those with the style come first: fonts with nine weights often have a family
        for each weight.
        """
        for source in self._sources():
            if source is self._embedded:
                continue
            families: dict[str, list[Listed]] = {}
            for listed in source:
                families.setdefault(listed.face.family, []).append(listed)
            ordered = [*families.values()]
            if source is self._given_faces:
                ordered.sort(key=lambda named: (named[0].place, min(map(request.rank, named))))
            for named in ordered:
                yield from request.best_of(named)

    def _sources(self) -> Iterator[tuple[Listed, ...]]:
        yield self._given_faces
        yield self._embedded
        yield of_files(default_files())
        if self.system:
            yield of_files(system_files())

    @cached_property
    def _given_faces(self) -> tuple[Listed, ...]:
        found: list[Listed] = []
        for place, path in enumerate(self.files):
            if path.is_dir():
                in_it = of_files(tuple(font_files(path)))
                if not in_it:
                    kinds = ", ".join(SUFFIXES)
                    raise SourceError(f"{path}: the folder holds no font that can be read; give one with {kinds}")
                found += (replace(listed, place=place) for listed in in_it)
                continue
            with about(os.fspath(path)):
                found += (replace(listed_of(face, path), place=place) for face in faces_of(path))
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
    """Return all faces of files, without unreadable files."""
    found: list[Listed] = []
    for path in paths:
        try:
            found += (listed_of(face, path) for face in faces_of(path))
        except SourceError:
            continue
    return tuple(found)


def listed_of(face: Face, file: Path | None = None) -> Listed:
    """Return a face with its names, its traits, and its file."""
    axes = face.axes
    slopes = [style for style, axis in (("italic", "ital"), ("oblique", "slnt")) if axis in axes]
    traits = Traits(
        axes.get("wght", (face.weight, face.weight)),
        axes.get("wdth", (face.stretch, face.stretch)),
        (face.style, *slopes),
    )
    return Listed(frozenset(name.casefold() for name in face.names), traits, face, file=file)


def font_files(folder: Path) -> Iterator[Path]:
    """Yield all font files in a folder and its subfolders, sorted by name.

    A WOFF next to a WOFF2 of the same name is left out: packages of web fonts contain each font as both.
    """
    found = [path for path in sorted(folder.rglob("*")) if path.suffix.lower() in SUFFIXES and path.is_file()]
    newer = {path.with_suffix("") for path in found if path.suffix.lower() == ".woff2"}
    yield from (path for path in found if path.suffix.lower() != ".woff" or path.with_suffix("") not in newer)


@cache
def system_files() -> tuple[Path, ...]:
    """Return the system's font files: those that fontconfig lists, or else those in the usual folders."""
    listed = run_program("fc-list", "--format", "%{file}\n")
    if listed:
        paths = {Path(line) for line in listed.splitlines()}
        return tuple(sorted(path for path in paths if path.suffix.lower() in SUFFIXES))
    folders = {"darwin": MACOS, "win32": WINDOWS}.get(sys.platform, LINUX)
    places = (Path(os.path.expandvars(folder)).expanduser() for folder in folders)
    return tuple(path for place in places if place.is_dir() for path in font_files(place))


@cache
def generic_family(name: str) -> str:
    """Return the family that fontconfig chooses for a generic one; empty without fontconfig."""
    return run_program("fc-match", "--format", "%{family[0]}", name)


def run_program(program: str, *arguments: str) -> str:
    """Return the output of a program of fontconfig; empty if it is missing or fails."""
    found = shutil.which(program)
    if found is None:
        return ""
    try:
        done = subprocess.run([found, *arguments], capture_output=True, timeout=PATIENCE, check=True)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.decode("utf-8", "replace")


def default_files() -> tuple[Path, ...]:
    """Return the files of the default font; none if ``vexture[text]`` is not installed."""
    spec = find_spec(DEFAULT_PACKAGE)
    places = () if spec is None else spec.submodule_search_locations or ()
    return tuple(path for place in places for path in font_files(Path(place) / "files"))
