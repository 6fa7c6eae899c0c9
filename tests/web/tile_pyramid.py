"""A small pyramid of tiles of a map, as `vexture tiles` lays it out, and a server that knows ranges."""

import functools
import http.server
import json
import re
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np
import shapely
from numpy.typing import NDArray

import vexture
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint

MARGIN: Final = 1 / 32
ZOOMS: Final = (0, 1, 3)
HALF: Final = 20037508.342789244
"""Half the world's side in EPSG:3857, metres."""

PRECISION: Final = 1e-7
"""Of the tiles: views come as near as metres."""

COLOURS: Final = ((0.9, 0.3, 0.2), (0.2, 0.5, 0.9), (0.3, 0.7, 0.3), (0.95, 0.8, 0.2), (0.5, 0.3, 0.7))

RIM: Final = 3
"""By which a colour may be off, of a byte's: an eye sees no rim of this."""

METADATA: Final = {"name": "cells", "attribution": "tests", "vexture": {"margin": MARGIN, "zooms": ZOOMS}}


@functools.cache
def cells(count: int = 60) -> dict[str, Any]:
    """Cells of a map by their names, in Web Mercator of 0..1, y downwards: all of the world but one of them."""
    sites = np.random.default_rng(20).uniform(0, 1, (count, 2))
    world = shapely.box(0, -0.1, 1, 1.1)  # to beyond the grid, as maps are
    found = shapely.voronoi_polygons(shapely.MultiPoint(sites), extend_to=world)
    clipped = [shapely.intersection(cell, world) for cell in found.geoms]
    return {f"cell {k}": cell for k, cell in enumerate(clipped) if k != count // 2}


@functools.cache
def meeting() -> tuple[float, float]:
    """Where three cells meet, near the middle of the world: what views look at."""
    corners = shapely.get_coordinates(list(cells().values()))
    return tuple(corners[np.abs(corners - (0.47, 0.44)).max(axis=1).argmin()].tolist())


def colour(name: str) -> tuple[float, float, float]:
    """Colour of a cell in the tiles."""
    return COLOURS[int(name.split()[1]) % len(COLOURS)]


def drawing(low: tuple[float, float], side: float, colours: Any = colour) -> Drawing:
    """What of the cells is in a square, given by its north-west corner."""
    box = shapely.box(*low, low[0] + side, low[1] + side)
    paths = []
    around = [(name, cell, turn) for name, cell in cells().items() for turn in (-1.0, 0.0, 1.0)]
    for name, cell, turn in around:
        part = shapely.intersection(shapely.transform(cell, lambda at, turn=turn: at + np.array([turn, 0])), box)
        if not isinstance(part, shapely.Polygon) or part.area < 1e-12 * side * side:
            continue
        ring = shapely.get_coordinates(shapely.orient_polygons(part).exterior)[:-1]
        ring = np.clip((ring - low) / side, 0.0, 1.0)
        points = [(float(x), float(1.0 - y)) for x, y in ring]
        paths += [replace(path, paint=Paint(colours(name)), element=name) for path in Drawing.polygon(points).paths]
    size = 2 * HALF * side
    to_source = np.array([[size, 0.0, 2 * HALF * low[0] - HALF], [0.0, size, HALF - 2 * HALF * (low[1] + side)]])
    return Drawing(tuple(paths), to_source=to_source, name="map", crs="EPSG:3857")


def write(folder: Path) -> None:
    """Write the pyramid twice: as a folder with a TileJSON, and as `map.pmtiles`."""
    from pmtiles.tile import Compression, TileType, zxy_to_tileid
    from pmtiles.writer import Writer

    tiles = {}
    for z in ZOOMS:
        side = 1 / 2**z
        for x, y in np.ndindex(2**z, 2**z):
            wide = drawing(((x - MARGIN) * side, (y - MARGIN) * side), side * (1 + 2 * MARGIN))
            if wide.paths:
                place = folder / str(z) / str(x) / f"{y}.ktx2"
                place.parent.mkdir(parents=True, exist_ok=True)
                vexture.convert(wide, split="faces", restyle=True, precision=PRECISION).save(place)
                tiles[zxy_to_tileid(z, x, y)] = place.read_bytes()
    told = {"tilejson": "3.0.0", "tiles": ["{z}/{x}/{y}.ktx2?v=1"], **METADATA}
    (folder / "tiles.json").write_text(json.dumps(told), encoding="utf-8")
    with (folder / "map.pmtiles").open("wb") as file:
        writer = Writer(file)
        for number in sorted(tiles):
            writer.write_tile(number, tiles[number])
        header = {
            "tile_type": TileType.UNKNOWN, "tile_compression": Compression.NONE, "min_zoom": 0, "max_zoom": ZOOMS[-1],
            "min_lon_e7": -1800000000, "min_lat_e7": -850000000, "max_lon_e7": 1800000000, "max_lat_e7": 850000000,
            "center_zoom": 0, "center_lon_e7": 0, "center_lat_e7": 0,
        }  # fmt: skip
        writer.finalize(header, METADATA)


def write_land(folder: Path, latitude: float = 85.0511287798066) -> None:
    """Write a pyramid of one tile: land to a latitude, or cut off where the grid ends, as `vexture tiles` does it."""
    reach = float(np.arcsinh(np.tan(np.radians(latitude)))) / (2 * np.pi)
    low, high = (0.5 - reach + MARGIN) / (1 + 2 * MARGIN), (0.5 + reach + MARGIN) / (1 + 2 * MARGIN)
    world = Drawing.polygon([(0.0, low), (1.0, low), (1.0, high), (0.0, high)])
    paths = tuple(replace(path, paint=Paint(COLOURS[0]), element="land") for path in world.paths)
    folder.mkdir()
    vexture.convert(Drawing(paths, name="land"), split="faces", restyle=True).save(folder / "0.ktx2")
    told = {"tiles": ["{z}.ktx2"], "vexture": {"margin": MARGIN, "zooms": [0]}}
    (folder / "tiles.json").write_text(json.dumps(told), encoding="utf-8")


def lng_lat(x: float, y: float) -> tuple[float, float]:
    """Degrees of a place in Web Mercator of 0..1."""
    return 360 * (x - 0.5), np.degrees(np.arctan(np.sinh(np.pi * (1 - 2 * y))))


def points(count: int, seed: int = 1) -> NDArray[np.float64]:
    """Random places."""
    return np.random.default_rng(seed).uniform(0.02, 0.98, (count, 2))


def named_points(count: int) -> tuple[NDArray[np.float64], list[str | None]]:
    """Random places that are on no border as far as the tiles know, and what shapely says of each."""
    places = points(count)
    tree = shapely.STRtree(list(cells().values()))
    known = list(cells())
    which, cell = tree.query(shapely.points(places), predicate="within")
    names: list[str | None] = [None] * count
    for place, one in zip(which.tolist(), cell.tolist(), strict=True):
        names[place] = known[one]
    borders = shapely.union_all([cell.boundary for cell in cells().values()])
    shapely.prepare(borders)
    off = ~shapely.dwithin(shapely.points(places), borders, 4 * PRECISION)
    return places[off], [name for name, is_off in zip(names, off.tolist(), strict=True) if is_off]


def name_at(x: float, y: float) -> str | None:
    """What shapely says of a place."""
    point = shapely.Point(x, y)
    return next((name for name, cell in cells().items() if cell.contains(point)), None)


class _Ranges(http.server.SimpleHTTPRequestHandler):
    extensions_map = {".js": "text/javascript", ".mjs": "text/javascript", ".html": "text/html"}  # noqa: RUF012
    protocol_version = "HTTP/1.1"
    delays: ClassVar[Iterator[float]] = repeat(0.0)

    def log_message(self, *arguments: object) -> None:
        """Say nothing."""

    def do_GET(self) -> None:
        """A part of a file, if one is asked for; tiles take their time."""
        if ".ktx2" in self.path:
            time.sleep(next(self.delays))
        found = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if not found:
            super().do_GET()
            return
        content = Path(self.translate_path(self.path)).read_bytes()
        first, last = int(found[1]), min(int(found[2]), len(content) - 1)
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{len(content)}")
        self.send_header("Content-Length", str(last + 1 - first))
        self.end_headers()
        with suppress(OSError):  # a page may abort
            self.wfile.write(content[first : last + 1])


@contextmanager
def serve_tiles(folder: Path, delays: Iterator[float] | None = None) -> Iterator[str]:
    """Address of a folder, with ranges; `delays` are the seconds after which each tile is sent."""
    slow = type("_Slow", (_Ranges,), {"delays": delays or repeat(0.0)})
    handler = functools.partial(slow, directory=str(folder))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()
