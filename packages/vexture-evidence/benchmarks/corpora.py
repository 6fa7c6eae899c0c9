"""Input of the benchmarks and tests: real SVG files, glyphs of real fonts, a coastline of any size, a KTX2 reader.

SVG files and the reader come from npm packages of pinned versions, and from Debian packages of any version, unpacked on
first use into the folder named by the environment variable VEXTURE_CORPORA, by default `~/.cache/vexture/corpora`.
Everything drawn at random is drawn from a seed.
"""

import os
import random
import shutil
import string
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont
from numpy.typing import NDArray

from vexture.base.errors import LimitError, SourceError, VextureError
from vexture.drawing import drawing
from vexture.drawing.drawing import Drawing

FONTS = Path("/usr/share/fonts")
ALPHANUMERICS = string.ascii_letters + string.digits
HEXAGON_RADIUS = 0.4  # unit-square units
ROUGHNESS = 0.18  # standard deviation of a midpoint's way along the normal, in edge lengths


@dataclass(frozen=True, slots=True)
class Package:
    """A pinned npm package and the folder of its SVG files."""

    name: str
    version: str
    folder: str

    def all(self) -> list[Path]:
        """Return its SVG files, those in folders of the folder too, sorted."""
        return sorted((self.installed_folder() / self.folder).rglob("*.svg"))

    def files(self, count: int, seed: int) -> list[Path]:
        """Return `count` of its SVG files, drawn at random without repetition."""
        available = self.all()
        if count > len(available):
            raise LimitError(f"{count} files asked of {self.name}, which has {len(available)}; ask for fewer")
        return random.Random(seed).sample(available, count)

    @property
    def home(self) -> Path:
        """Return the folder that npm installs it into."""
        return cache() / f"{self.name.replace('/', '-')}-{self.version}"

    def installed_folder(self) -> Path:
        """Return the package's folder, installed first if it is missing."""
        home = self.home
        if not home.exists():
            npm = shutil.which("npm")
            if npm is None:
                raise VextureError(
                    f"npm is missing, which fetches {self.name} {self.version}; install Node.js with npm"
                )
            fill(home, lambda prefix: self.install(npm, prefix))
        return home / "node_modules" / self.name

    def install(self, npm: str, prefix: Path) -> None:
        """Let npm fetch the package, without running its scripts."""
        prefix.mkdir()
        wanted = f"{self.name}@{self.version}"
        command = [npm, "install", "--prefix", str(prefix), "--ignore-scripts", "--no-save", "--no-audit", wanted]
        outcome = subprocess.run(command, capture_output=True, text=True, check=False)
        if outcome.returncode:
            reason = next((line for line in outcome.stderr.splitlines() if "npm error" in line), "npm says nothing")
            raise VextureError(f"npm cannot install {wanted} ({reason}); check the network or the registry")


@dataclass(frozen=True, slots=True)
class DebianPackage:
    """A package of Debian and a folder in it; it is unpacked, not installed on the system."""

    name: str
    folder: str

    @property
    def home(self) -> Path:
        """Return the folder, with the package fetched first if it is missing."""
        return self.unpacked_folder() / self.folder

    def files(self, pattern: str) -> list[Path]:
        """Return its files that match, sorted."""
        return sorted(self.home.rglob(pattern))

    def unpacked_folder(self) -> Path:
        """Return the package's root, fetched and unpacked first if it is missing."""
        home = cache() / f"debian-{self.name}"
        if not home.exists():
            fill(home, self.unpack)
        return home

    def unpack(self, root: Path) -> None:
        """Let apt fetch the package."""
        apt = shutil.which("apt-get")
        if apt is None:
            raise VextureError(f"apt-get is missing, which fetches {self.name}; run this on Debian or Ubuntu")
        root.mkdir()
        command = [apt, "-o", "APT::Sandbox::User=root", "download", self.name]
        outcome = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        found = next(root.glob("*.deb"), None)
        if outcome.returncode or found is None:
            reason = next((line for line in outcome.stderr.splitlines() if line.startswith("E:")), "apt says nothing")
            raise VextureError(f"apt-get cannot download {self.name} ({reason}); run apt-get update, check the network")
        subprocess.run(["dpkg-deb", "-x", found, root], check=True)
        found.unlink()


def cache() -> Path:
    """Return the folder of everything fetched."""
    return Path(os.environ.get("VEXTURE_CORPORA", "~/.cache/vexture/corpora")).expanduser()


def fill(home: Path, make: Callable[[Path], None]) -> None:
    """Make a folder of the cache, completely or not at all."""
    home.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=home.parent) as scratch:
        make(Path(scratch) / "prefix")
        try:
            os.rename(Path(scratch) / "prefix", home)
        except OSError:
            if not home.exists():  # else another process was faster
                raise


MDI = Package("@mdi/svg", "7.4.47", "svg")
LUCIDE = Package("lucide-static", "1.62.0", "icons")
SIMPLE_ICONS = Package("simple-icons", "16.37.0", "icons")
FLAG_ICONS = Package("flag-icons", "7.5.0", "flags/4x3")
TWEMOJI = Package("@twemoji/svg", "15.0.0", ".")
OPENMOJI = Package("openmoji", "17.0.0", "color/svg")
FLUENT_FLAT = Package("fluentui-emoji", "1.3.0", "icons/flat")
FLUENT_MODERN = Package("fluentui-emoji", "1.3.0", "icons/modern")
FONT_AWESOME = Package("@fortawesome/fontawesome-free", "7.3.1", "svgs-full")
KTX_PARSE = Package("ktx-parse", "1.1.0", "dist")
LIBRSVG_TESTS = DebianPackage("librsvg2-tests", "usr/libexec/installed-tests/RSVG/fixtures/reftests")
OPENCLIPART = DebianPackage("openclipart-svg", "usr/share/openclipart/svg")
TANGO = DebianPackage("tango-icon-theme", "usr/share/icons/Tango/scalable")
DEVICON = Package("devicon", "2.17.0", "icons")
CIRCLE_FLAGS = Package("circle-flags", "2.8.3", "flags")
SUPER_TINY_ICONS = Package("super-tiny-icons", "0.6.0", "images/svg")
NOTO = DebianPackage("fonts-noto-core", "usr/share/fonts/truetype/noto")
GSHHG = DebianPackage("gmt-gshhg-low", "usr/share/gmt-gshhg")


def mdi(count: int, seed: int) -> list[Path]:
    """Return icons of Material Design Icons (Apache-2.0): one path each, many arcs."""
    return MDI.files(count, seed)


def lucide() -> list[Path]:
    """Return all icons of Lucide (ISC): strokes with round caps and joins."""
    return LUCIDE.all()


def simple_icons(count: int, seed: int) -> list[Path]:
    """Return logos of Simple Icons (CC0): one path each, fine detail."""
    return SIMPLE_ICONS.files(count, seed)


def flags(count: int, seed: int) -> list[Path]:
    """Return flags of flag-icons (MIT): many colours, transforms, `use`, clip paths, coats of arms."""
    return FLAG_ICONS.files(count, seed)


def coat_of_arms() -> Path:
    """Return the flag of flag-icons with the most paths but for two: 578, of a coat of arms and its supporters."""
    return FLAG_ICONS.installed_folder() / FLAG_ICONS.folder / "es.svg"


def emoji(count: int, seed: int) -> list[Path]:
    """Return emoji of Twemoji (CC BY 4.0): a few flat colours."""
    return TWEMOJI.files(count, seed)


def icons_logos_and_flags(seed: int) -> list[Path]:
    """Return 500 files of seven packages: icons of one path, strokes, logos with gradients, flags with clips."""
    counts = {
        MDI: 40,
        LUCIDE: 40,
        SIMPLE_ICONS: 60,
        FLAG_ICONS: 110,
        CIRCLE_FLAGS: 90,
        SUPER_TINY_ICONS: 80,
        DEVICON: 80,
    }
    found = list[Path]()
    for package, count in counts.items():
        found += package.files(count, seed)
    return found


def ktx_parse() -> Path:
    """Return the folder of ktx-parse (MIT), a KTX2 reader in JavaScript that shares nothing with ours."""
    return KTX_PARSE.installed_folder()


def dejavu_sans() -> Path:
    """Return the file of the font DejaVu Sans: TrueType, quadratics."""
    return installed_font("DejaVuSans.ttf", "fonts-dejavu-core")


def stix() -> Path:
    """Return the file of the font STIXGeneral: CFF, cubics, serifs."""
    return installed_font("STIXGeneral-Regular.otf", "fonts-stix")


def installed_font(file: str, package: str) -> Path:
    """Return a font's file, or say which Debian package brings it."""
    found = next(FONTS.rglob(file), None)
    if found is None:
        raise SourceError(f"no {file} under {FONTS}; install the Debian package {package}")
    return found


class ContourPen(BasePen):
    """Collects closed contours of cubics; BasePen resolves components and raises quadratics exactly."""

    def __init__(self, glyphs: object) -> None:
        super().__init__(glyphs)
        self.contours: list[NDArray[np.float64]] = []

    def _moveTo(self, point: tuple[float, float]) -> None:  # noqa: N802 (fontTools' names)
        self.start = point
        self.cubics: list[list[tuple[float, float]]] = []

    def _lineTo(self, point: tuple[float, float]) -> None:  # noqa: N802
        (x0, y0), (x3, y3) = self._getCurrentPoint(), point
        if (x0, y0) != (x3, y3):
            self._curveToOne((x0 + (x3 - x0) / 3, y0 + (y3 - y0) / 3), (x3 + (x0 - x3) / 3, y3 + (y0 - y3) / 3), point)

    def _curveToOne(self, *points: tuple[float, float]) -> None:  # noqa: N802
        self.cubics.append([self._getCurrentPoint(), *points])

    def _closePath(self) -> None:  # noqa: N802
        self._lineTo(self.start)
        if self.cubics:
            self.contours.append(np.array(self.cubics, dtype=np.float64))


def glyphs(font: Path, text: str) -> list[Drawing]:
    """Draw each character, its line height from descender to ascender as high as the unit square.

    Parameters
    ----------
    font : Path
        A TrueType or OpenType font.
    text : str
        Each character becomes a drawing of its own, centred by its advance width.

    Returns
    -------
    list of Drawing
        Their `to_source` maps the unit square to ems, baseline at 0: its first entry is the line height.

    Raises
    ------
    SourceError
        If the font lacks a character, or a glyph is larger than its line.
    """
    with TTFont(font) as opened:
        outlines, characters, header = opened.getGlyphSet(), opened.getBestCmap(), opened["hhea"]
        em = opened["head"].unitsPerEm
        height = header.ascent - header.descent
        drawings = []
        for character in text:
            if ord(character) not in characters:
                raise SourceError(f"{font} has no glyph for {character!r}; choose another font or text")
            glyph = outlines[characters[ord(character)]]
            pen = ContourPen(outlines)
            glyph.draw(pen)
            corner = np.array([(glyph.width - height) / 2, header.descent])
            path = drawing.Path(tuple((contour - corner) / height for contour in pen.contours))
            to_source = np.column_stack([np.eye(2) * height, corner]) / em
            drawings.append(Drawing((path,), to_source, character))
    return drawings


def round_shapes() -> list[Drawing]:
    """Draw a circle and a ribbon with the sides of an S, each counter-clockwise and clockwise.

    Examples
    --------
    >>> [shape.name for shape in round_shapes()]
    ['circle', 'circle, clockwise', 's-curve', 's-curve, clockwise']
    """
    arm = 0.4 * 4.0 / 3.0 * (np.sqrt(2.0) - 1.0)  # of a quarter circle
    quarter = np.array([[0.4, 0.0], [0.4, arm], [arm, 0.4], [0.0, 0.4]])
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    circle = np.stack([0.5 + quarter @ np.linalg.matrix_power(turn, k).T for k in range(4)])
    circle[:, 3] = np.roll(circle[:, 0], -1, axis=0)
    bend = np.array([[0.1, 0.15], [1.1, 0.35], [-0.3, 0.65], [0.7, 0.85]])
    side = np.array([0.2, 0.0])
    (upper, lower) = (
        [p, p + (q - p) / 3.0, q - (q - p) / 3.0, q] for p, q in ((bend[3] + side, bend[3]), (bend[0], bend[0] + side))
    )
    ribbon = np.stack([bend + side, np.array(upper), bend[::-1], np.array(lower)])
    shapes = []
    for name, contour in (("circle", circle), ("s-curve", ribbon)):
        shapes.append(Drawing((drawing.Path((contour,)),), name=name))
        shapes.append(Drawing((drawing.Path((contour[::-1, ::-1].copy(),)),), name=f"{name}, clockwise"))
    return shapes


def fractal_coastline(edges: int, seed: int) -> Drawing:
    """Draw an island of straight edges: a hexagon whose edges are broken in two, again and again.

    Parameters
    ----------
    edges : int
        Six times a power of two. The benchmarks use 768, 12,288 and 98,304.
    seed : int
        Of the normal deviates that move each midpoint along the normal of its edge.

    Raises
    ------
    LimitError
        If `edges` is another number.

    Examples
    --------
    >>> fractal_coastline(768, seed=1).segments
    768
    """
    if edges < 6 or edges % 6 or (edges // 6).bit_count() != 1:
        raise LimitError(f"a coastline of {edges} edges cannot be made; ask for six times a power of two")
    deviates = np.random.default_rng(seed)
    angles = np.arange(6) * (np.pi / 3)
    points = 0.5 + HEXAGON_RADIUS * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    while len(points) < edges:
        step = np.roll(points, -1, axis=0) - points
        normal = np.stack([-step[:, 1], step[:, 0]], axis=1)
        middle = points + step / 2 + normal * deviates.normal(0.0, ROUGHNESS, (len(points), 1))
        if middle.min() >= 0.0 and middle.max() <= 1.0:  # else draw again: one seed in ten leaves the unit square
            points = np.stack([points, middle], axis=1).reshape(-1, 2)
    return replace(Drawing.polygon(points), name=f"coastline-{edges}")
