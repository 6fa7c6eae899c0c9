"""A map of many polygons in a notebook: time until the first picture and the texture, and bytes that are sent.

    python packages/vexture-evidence/benchmarks/notebook_map.py [--polygons 200000] [--crs EPSG:3857] [--quick]

Polygons are Voronoi cells of random points, by a seed, in EPSG:28992. The first picture is what the cell's output
holds; what a page adds to it is not measured here. Kernels are compiled before.
"""

import argparse
import time
from typing import Any

import geopandas
import numpy as np
import shapely

import vexture
from report import write_figures

GOALS = {"first_picture_seconds": 3.0, "sent_megabytes": 12.0}
SIDE = 1e5
"""Metres across all polygons."""

ZOOMED = {"view": [0.2, 0.2, 0.3, 0.3], "size": [1200, 800]}


def cells(count: int, seed: int = 1) -> geopandas.GeoDataFrame:
    """Voronoi cells of random points, with a number and a word each."""
    random = np.random.default_rng(seed)
    shapes = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(random.random((count, 2)))))
    shapes = shapely.transform(shapely.clip_by_rect(shapes, 0, 0, 1, 1), lambda places: SIDE * places)
    words = np.where(shapely.get_x(shapely.centroid(shapes)) < SIDE / 2, "west", "east")
    return geopandas.GeoDataFrame({"value": random.random(count), "half": words}, geometry=shapes, crs="EPSG:28992")


def measure_map(frame: geopandas.GeoDataFrame, crs: str) -> dict[str, float]:
    """Measure the seconds since the call, and bytes."""
    start = time.perf_counter()
    chart = vexture.map(frame, "value", crs=crs)
    chart._repr_mimebundle_()
    first = time.perf_counter() - start
    sent = len(chart._picture["content"])
    begun = time.perf_counter()
    chart._wanted = ZOOMED
    moved = time.perf_counter() - begun
    chart.texture  # noqa: B018  # is waited for
    whole = time.perf_counter() - start
    source: Any = chart._source
    begun = time.perf_counter()
    chart.column = "half"
    recolored = time.perf_counter() - begun
    coloring = sum(map(len, chart._coloring.values()))
    chart.close()
    return {
        "first_picture_seconds": first,
        "moved_seconds": moved,
        "texture_seconds": whole,
        "recolored_seconds": recolored,
        "sent_megabytes": (sent + len(source.content)) / 1e6,
        "first_picture_megabytes": sent / 1e6,
        "column_megabytes": coloring / 1e6,
    }


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--polygons", type=int, default=200_000)
    parser.add_argument("--crs", default="EPSG:3857")
    parser.add_argument("--quick", action="store_true", help="few polygons")
    chosen = parser.parse_args()
    measure_map(cells(100), chosen.crs)
    figures = measure_map(cells(2_000 if chosen.quick else chosen.polygons), chosen.crs)
    write_figures("notebook_map", figures, GOALS)


if __name__ == "__main__":
    main()
