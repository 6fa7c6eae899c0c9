"""Draw the guide's picture of maps: `python tools/make_maps.py` writes docs/pictures/maps.png.

The countries of the world in Equal Earth and around the south pole, and the counties of the United States in Albers'
projection, in the colours of their areas, each from one texture. Needs npm and geopandas.
"""

import sys
from pathlib import Path
from typing import Any, Final

import geopandas
import numpy as np
import shapely
from PIL import Image

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "packages" / "vexture-evidence" / "benchmarks"), str(ROOT / "tools")]

from gallery_data import COUNTIES, WORLD  # noqa: E402
from vexture.base.notes import Notes  # noqa: E402
from vexture.renderers.view import window  # noqa: E402
from vexture_geo.maps import MapLayer, Scale, convert_map  # noqa: E402
from vexture_geo.maps.place import place_features  # noqa: E402
from vexture_geo.vector.features import read_features  # noqa: E402

TARGET: Final = ROOT / "docs" / "pictures" / "maps.png"
HEIGHT: Final = 330
"""Pixels."""
GAP: Final = 24
PAPER: Final = "#ffffff"
BREAKS: Final = "30000,100000,300000,1000000,3000000,10000000"
"""Square kilometres."""
MOST_COLOURS: Final = 128

EQUAL_AREA: Final = "EPSG:6933"
FAR_STATES: Final = ("02", "15", "60", "66", "69", "72", "78")
"""First digits of the counties that are not of the contiguous states."""


def areas(file: Path, layer: str) -> Any:
    """Features with their areas in square kilometres; those around a pole are closed, as in maps."""
    placed_there = place_features(read_features(file, layer=layer, notes=Notes()), EQUAL_AREA, Notes())
    square_metres = np.bincount(placed_there.feature, shapely.area(placed_there.rings.shapes), len(placed_there))
    frame = geopandas.read_file(file, layer=layer).set_crs("EPSG:4326", allow_override=True)
    return frame.assign(area=square_metres / 1e6)


def picture(source: Any, crs: str, scale: Scale) -> Image.Image:
    """A map, as high as all of them."""
    made = convert_map([MapLayer(source, color=scale, outline="white", outline_width="0.6px")], crs=crs)
    sides = made.conversion.drawing.sides
    size = (round(HEIGHT * sides[0] / sides[1]), HEIGHT)
    view = window((1.0 - sides[0]) / 2, (1.0 - sides[1]) / 2, *sides)
    drawn = made.conversion.texture.render(size, view, renderer="cpu")
    return Image.fromarray(np.uint8(np.rint(255.0 * (drawn[..., :3] + 1.0 - drawn[..., 3:]))))


def main() -> None:
    """Write the picture."""
    world = areas(WORLD.installed_folder() / "countries-50m.json", "countries")
    counties = areas(COUNTIES.installed_folder() / "counties-10m.json", "counties")
    contiguous = counties[~counties["id"].str[:2].isin(FAR_STATES)]
    by_size = Scale("area", BREAKS)
    maps = [
        picture(world, "EPSG:8857", by_size),
        picture(world[world["name"] == "Antarctica"], "EPSG:3031", by_size),
        picture(contiguous, "EPSG:5070", Scale("area", "quantiles", "magma", 7)),
    ]
    out = Image.new("RGB", (sum(one.width for one in maps) + GAP * (len(maps) + 1), HEIGHT + 2 * GAP), PAPER)
    left = GAP
    for one in maps:
        out.paste(one, (left, GAP))
        left += one.width + GAP
    out.quantize(MOST_COLOURS, dither=Image.Dither.NONE).save(TARGET, optimize=True)
    print(TARGET)


if __name__ == "__main__":
    main()
