"""An extent of 20,000 vertices as files of several kinds, and the time from file to texture."""

import json
import time
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.conversion.pipeline import convert
from vexture_geo.flood.conversion import WATER_PARAMETERS

VERTICES: Final = 20_000
KINDS: Final = ("GeoJSON", "FlatGeobuf", "GPKG")
SUFFIXES: Final = {"GeoJSON": ".geojson", "FlatGeobuf": ".fgb", "GPKG": ".gpkg"}
CRS: Final = {"GeoJSON": "EPSG:4326", "FlatGeobuf": "EPSG:32610", "GPKG": "EPSG:32610"}
PLACE: Final = {"EPSG:4326": (-122.0, 36.95, 0.05, 0.04), "EPSG:32610": (587_000.0, 4_090_000.0, 4500.0, 4500.0)}
"""Middle and radii."""


def island(vertices: int, seed: int, crs: str) -> NDArray[np.float64]:
    """Closed ring around a place, rough at every scale, (vertices + 1, 2)."""
    rng = np.random.default_rng(seed)
    waves = np.arange(1, vertices // 2)
    strength = rng.normal(size=(2, len(waves))) * waves**-1.2
    spectrum = np.zeros(vertices // 2 + 1, np.complex128)
    spectrum[1:-1] = 0.5 * (strength[0] + 1j * strength[1])
    noise = np.fft.irfft(spectrum, vertices) * vertices / 4
    radius = np.exp(np.tanh(noise) - 1.0)
    angles = 2 * np.pi * np.arange(vertices) / vertices
    x, y, across, up = PLACE[crs]
    ring = np.stack([x + across * radius * np.cos(angles), y + up * radius * np.sin(angles)], axis=1)
    return np.vstack([ring, ring[:1]])


def geojson(*rings: NDArray[np.float64]) -> bytes:
    """A polygon in WGS 84, the first ring its outer one."""
    coordinates = [np.round(ring, 7).tolist() for ring in rings]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": coordinates}}
    return json.dumps({"type": "FeatureCollection", "features": [feature]}, separators=(",", ":")).encode()


def island_files(folder: Path, seed: int) -> dict[str, Path]:
    """The island as each kind of file."""
    import pyogrio.raw
    import shapely

    files = {}
    for kind in KINDS:
        ring = island(VERTICES, seed, CRS[kind])
        files[kind] = path = folder / f"island{SUFFIXES[kind]}"
        if kind == "GeoJSON":
            path.write_bytes(geojson(ring))
            continue
        geometry = np.array([shapely.to_wkb(shapely.Polygon(ring))], dtype=object)
        pyogrio.raw.write(
            path, geometry, [np.array([1])], ["id"], driver=kind, geometry_type="Polygon", crs=CRS[kind]
        )  # fmt: skip
    return files


class ReadingTimes(NamedTuple):
    """Milliseconds from a file to each stage, one for each turn, and the bytes of the texture's file."""

    drawing: list[float]
    texture: list[float]
    file: list[float]
    size: int


def reading_times(path: Path, repeat: int) -> ReadingTimes:
    """Milliseconds from a file to its drawing, to its texture in memory, to the bytes of its texture's file."""
    from vexture_geo.readers import read_extent

    taken = ReadingTimes([], [], [], 0)
    for _ in range(repeat + 2):  # the first two include compilation
        start = time.perf_counter()
        extent = read_extent(path, path.name)
        taken.drawing.append(1000 * (time.perf_counter() - start))
        texture = convert(extent.steps[0].drawing, split=None, precision=WATER_PARAMETERS.precision)
        taken.texture.append(1000 * (time.perf_counter() - start))
        size = len(texture.to_ktx2())
        taken.file.append(1000 * (time.perf_counter() - start))
    return ReadingTimes(taken.drawing[2:], taken.texture[2:], taken.file[2:], size)
