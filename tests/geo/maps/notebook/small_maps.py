"""Small maps in notebooks, and their pictures."""

import io

import numpy as np
import pytest
from PIL import Image

import vexture

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("cmap", reason="cmap is not installed (pip install 'vexture[map]')")
geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")

METRES = "EPSG:28992"
STEPS = ("y8", "y9", "y10")


def fields(count=300, seed=5):
    random = np.random.default_rng(seed)
    cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(random.uniform(0, 1000, (count, 2)))))
    cells = shapely.clip_by_rect(cells, 0, 0, 1000, 1000)
    columns = {"value": random.random(count), "kind": random.choice(["a", "b", "c"], count)}
    return geopandas.GeoDataFrame(columns, geometry=cells, crs=METRES)


def shown(frame=None, column="value", **options):
    return vexture.map(fields() if frame is None else frame, column, crs=METRES, width=300, height=200, **options)


def picture_of(chart):
    return np.asarray(Image.open(io.BytesIO(chart._picture["content"]))).astype(int)


def difference(one, other):
    return np.abs(one.astype(float) - other).max()


def timed(**options):
    frame = fields(60)
    for number, name in enumerate(STEPS):
        frame[name] = np.roll(np.arange(60.0), 20 * number)
    return shown(frame, "y*", classes=3, **options)
