"""The files of the sweep, corpus by corpus: SVG files, glyphs as SVG, coastlines as GeoJSON."""

import json
import random
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

import netCDF4
import numpy as np
from fontTools.pens.svgPathPen import SVGPathPen
from fontTools.ttLib import TTFont
from numpy.typing import NDArray

import corpora
from judge import Case

W3C_GROUPS: Final = ("shapes-", "paths-", "coords-trans", "painting-", "struct-", "styling-")
"""Tests of SVG 1.1 that are not about text, filters, masks or animation."""

DRAWN: Final = 2000
"""Files of a corpus that are drawn from the seed, unless another number is asked for."""

LONGEST_COASTS: Final = 1000
"""Polygons of GSHHG at its intermediate resolution, those of most points."""

STEPS: Final = 65535
"""Of a coordinate across a bin of GSHHG."""


def sample_files(files: list[Path], seed: int, count: int | None) -> list[Path]:
    return files if count is None or count >= len(files) else random.Random(seed).sample(files, count)


def svg_cases(corpus: str, folder: Path, files: Iterable[Path]) -> list[Case]:
    """Cases of files, named by their places in a folder."""
    return [Case(corpus, file.relative_to(folder).as_posix(), file.read_bytes()) for file in files]


def w3c(seed: int, count: int | None) -> list[Case]:
    """W3C's tests of SVG 1.1 in the package of librsvg's tests."""
    folder = corpora.LIBRSVG_TESTS.home / "svg1.1"
    files = [file for file in sorted(folder.glob("*.svg")) if file.name.startswith(W3C_GROUPS)]
    return svg_cases("w3c", folder, sample_files(files, seed, count))


def librsvg(seed: int, count: int | None) -> list[Case]:
    """The other reference tests of librsvg, icons of Adwaita among them."""
    folder = corpora.LIBRSVG_TESTS.home
    files = [file for file in corpora.LIBRSVG_TESTS.files("*.svg") if file.parent.name != "svg1.1"]
    return svg_cases("librsvg", folder, sample_files(files, seed, count))


def openclipart(seed: int, count: int | None) -> list[Case]:
    files = sample_files(corpora.OPENCLIPART.files("*.svg"), seed, DRAWN if count is None else count)
    return svg_cases("openclipart", corpora.OPENCLIPART.home, files)


def icons(name: str, package: corpora.Package) -> Callable[[int, int | None], list[Case]]:
    """All icons of an npm package."""

    def cases(seed: int, count: int | None) -> list[Case]:
        folder = package.installed_folder() / package.folder
        return svg_cases(name, folder, sample_files(sorted(folder.glob("*.svg")), seed, count))

    return cases


def glyphs(name: str, font: Callable[[], Path]) -> Callable[[int, int | None], list[Case]]:
    """All glyphs of a font, each as an SVG file that fontTools writes."""

    def cases(seed: int, count: int | None) -> list[Case]:
        found = []
        with TTFont(font()) as opened:
            outlines, line = opened.getGlyphSet(), opened["hhea"]
            high = line.ascent - line.descent
            for glyph in opened.getGlyphOrder():
                pen = SVGPathPen(outlines)
                outlines[glyph].draw(pen)
                box = f"0 {-line.ascent} {max(outlines[glyph].width, high)} {high}"
                path = f'<path transform="scale(1 -1)" d="{pen.getCommands()}"/>'
                text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{path}</svg>'
                found.append(Case(name, f"{glyph}.svg", text.encode()))
        return found if count is None or count >= len(found) else random.Random(seed).sample(found, count)

    return cases


def noto() -> Path:
    return corpora.NOTO.home / "NotoSans-Regular.ttf"


def gshhg(seed: int, count: int | None) -> list[Case]:
    """The longest coastlines of GSHHG as GeoJSON, and as SVG for the references."""
    rings = coastlines(corpora.GSHHG.home / "binned_GSHHS_i.nc")
    longest = sorted(rings, key=lambda polygon: -len(rings[polygon]))[: count or LONGEST_COASTS]
    return [coast_case(polygon, rings[polygon]) for polygon in longest]


def coast_case(polygon: int, ring: NDArray[np.float64]) -> Case:
    geometry = {"type": "Polygon", "coordinates": [[*ring.tolist(), ring[0].tolist()]]}
    (west, south), (east, north) = ring.min(axis=0), ring.max(axis=0)
    data = " ".join(f"{x:.9g} {-y:.9g}" for x, y in ring.tolist())
    box = f"{west:.9g} {-north:.9g} {east - west:.9g} {north - south:.9g}"
    same = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><path d="M{data}z"/></svg>'
    return Case("gshhg", f"{polygon}.geojson", json.dumps(geometry).encode(), same.encode())


def coastlines(file: Path) -> dict[int, NDArray[np.float64]]:
    """Polygons, (n, 2) degrees east and north, joined from their segments in the bins; not those around a pole."""
    with netCDF4.Dataset(file) as data:
        values = {name: np.asarray(variable[:]) for name, variable in data.variables.items()}
    across = int(values["N_bins_in_360_longitude_range"][0])
    degrees = float(values["Bin_size_in_minutes"][0]) / 60.0
    bins = np.repeat(np.arange(len(values["N_segments_in_a_bin"])), values["N_segments_in_a_bin"])
    counts = values["Embedded_npts_levels_exit_entry_for_a_segment"] >> 9
    firsts = values["Id_of_first_point_in_a_segment"]
    x, y = (
        values[f"Relative_{axis}_from_SW_corner_of_bin"].astype(np.uint16).astype(np.int64)
        for axis in ("longitude", "latitude")
    )
    segments: dict[int, list[NDArray[np.int64]]] = {}
    for place, count, first, polygon in zip(bins, counts, firsts, values["Id_of_GSHHS_ID"], strict=True):
        points = np.stack([x[first : first + count], y[first : first + count]], axis=1)
        points += np.array([place % across, -1 - place // across]) * STEPS
        segments.setdefault(int(polygon), []).append(points)
    joined = {polygon: ring_of(parts, across * STEPS) for polygon, parts in segments.items()}
    return {polygon: ring * (degrees / STEPS) + (0.0, 90.0) for polygon, ring in joined.items() if ring is not None}


def ring_of(parts: list[NDArray[np.int64]], around: int) -> NDArray[np.int64] | None:
    """Closed ring of a polygon's segments, each of which starts where another one ends; None if it does not close."""
    starts = {(int(part[0, 0] % around), int(part[0, 1])): part for part in parts}
    ring: list[NDArray[np.int64]] = []
    part: NDArray[np.int64] | None = parts[0]
    while part is not None and len(ring) < len(parts):
        ring.append(part)
        part = starts.get((int(part[-1, 0] % around), int(part[-1, 1])))
    if part is not parts[0] or len(ring) != len(parts):
        return None
    points = np.concatenate(ring)
    steps = (np.diff(points[:, 0], append=points[0, 0]) + around // 2) % around - around // 2
    if steps.sum():
        return None
    points[1:, 0] = points[0, 0] + np.cumsum(steps[:-1])
    points[:, 0] -= around * round(points[:, 0].mean() / around)  # to 180 degrees west and east
    keep = (points != np.roll(points, 1, axis=0)).any(axis=1)
    return points[keep] if keep.sum() > 2 else None


CORPORA: Final[dict[str, Callable[[int, int | None], list[Case]]]] = {
    "w3c": w3c,
    "librsvg": librsvg,
    "openclipart": openclipart,
    "mdi": icons("mdi", corpora.MDI),
    "simple-icons": icons("simple-icons", corpora.SIMPLE_ICONS),
    "dejavu": glyphs("dejavu", corpora.dejavu_sans),
    "noto": glyphs("noto", noto),
    "gshhg": gshhg,
}
"""Makers of the cases of each corpus, of a seed and of how many: None for all that the corpus has in the sweep."""
