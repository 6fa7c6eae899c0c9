"""A map of counties in the colours of a statistic: converted once, coloured for each year, and asked for a county.

The counties and their numbers are invented: random places, each with the land that is nearest to it.

python examples/07_choropleth.py [FOLDER]
"""

import json
import sys
from pathlib import Path

import numpy as np
import shapely
from PIL import Image

import vexture

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/07")
folder.mkdir(parents=True, exist_ok=True)
rng = np.random.default_rng(7)
cells = shapely.voronoi_polygons(shapely.multipoints(rng.random((400, 2)))).geoms
island = shapely.Point(0.5, 0.5).buffer(0.5)
land = [cell.intersection(island) for cell in cells if cell.intersects(island)]
counties = [
    {"type": "Feature", "id": f"county {k}", "properties": {}, "geometry": shapely.geometry.mapping(area)}
    for k, area in enumerate(land)
]
(folder / "counties.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": counties}))

texture = vexture.convert(folder / "counties.geojson", split="faces", restyle=True)
middle = np.array([area.centroid.coords[0] for area in land])
for year in (2000, 2010, 2020):
    share = 0.5 + 0.4 * np.sin(7 * middle[:, 0] + (year - 2000) / 8) * np.cos(5 * middle[:, 1])
    colours = {f"county {k}": (s, 0.3, 1 - s) for k, s in enumerate(share)}  # from blue to red
    coloured = texture.with_paints(colours)
    image = coloured.render(size=400, renderer="cpu")  # "gpu" if this machine has OpenGL
    Image.fromarray(np.uint8(np.rint(255 * (image[..., :3] + 1 - image[..., 3:])))).save(folder / f"{year}.png")
print("in the middle:", texture.element_at([(0.5, 0.5)]).name[0])
print(f"open the pictures in {folder}")
