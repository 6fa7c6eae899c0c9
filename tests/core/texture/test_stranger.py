"""A decoder written from FORMAT.md alone: it shares no code with the package."""

from pathlib import Path

import numpy as np
import png
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from both_encodings import decode, encode
from strategies import cell_trees
from vexture.thesis.tree import CellKind, CellTree

Point = tuple[float, float]
STEPS = 100
SIDE = 32


def read(path: Path) -> tuple[list[list[tuple[float, float, float]]], dict[str, str]]:
    """Pixels as numbers v = c / M, and texts."""
    data = path.read_bytes()
    width, _, rows, told = png.Reader(bytes=data).asDirect()
    scale = float(2 ** told["bitdepth"] - 1)
    pixels = [[tuple(c / scale for c in row[3 * x : 3 * x + 3]) for x in range(width)] for row in map(list, rows)]
    bodies = [body for tag, body in png.Reader(bytes=data).chunks() if tag == b"tEXt"]
    return pixels, dict(body.decode("latin-1").split("\0", 1) for body in bodies)


def on_edge(v: float) -> Point:
    s = 4 * v
    f = s - int(s)
    return [(f, 1.0), (1.0, 1 - f), (1 - f, 0.0), (0.0, f)][int(s)]


def outline(row: list[tuple[float, float, float]], corner: bool) -> list[Point]:
    """The closed line: the leaf from P0 to P3, then the edge clockwise back to P0."""
    (e0, ax, bx), (e3, ay, by) = row
    (x0, y0), (x3, y3) = on_edge(e0), on_edge(e3)
    if corner:
        line = [(x0, y0), (ax, ay), (x3, y3)]
    else:
        x1, y1, x2, y2 = (-1.25 + 3.5 * v for v in (ax, ay, bx, by))
        line = []
        for i in range(STEPS + 1):
            t = i / STEPS
            b = (1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t * t, t**3
            line.append((b[0] * x0 + b[1] * x1 + b[2] * x2 + b[3] * x3, b[0] * y0 + b[1] * y1 + b[2] * y2 + b[3] * y3))
    last = e0 if e0 > e3 else e0 + 1
    return line + [on_edge(k / 4 % 1) for k in range(1, 8) if e3 < k / 4 < last]


def inside(closed: list[Point], x: float, y: float) -> bool:
    odd = False
    for (xa, ya), (xb, yb) in zip(closed, closed[1:] + closed[:1], strict=True):
        if (ya <= y) != (yb <= y) and xa + (y - ya) * (xb - xa) / (yb - ya) < x:
            odd = not odd
    return odd


def filled(
    quads: list[list[tuple[float, float, float]]], curves: list[list[tuple[float, float, float]]], x: float, y: float
) -> bool:
    q = 0
    while True:
        k = (x >= 0.5) + 2 * (y >= 0.5)
        x, y = 2 * x - k % 2, 2 * y - k // 2
        r, g, _ = quads[q][(2, 3, 0, 1)[k]]
        if r > 0.75:
            q = round(g * (len(quads) - 1))
            continue
        index = round(g * (len(curves) - 1))
        if index < 2:
            return index == 0
        return inside(outline(curves[index], r > 0.25), x, y)


@pytest.mark.slow
@settings(max_examples=30)
@given(cell_trees(max_depth=2, max_quads=4), st.sampled_from([8, 16]))
def test_a_stranger_sees_the_same_picture(tmp_path: Path, tree: CellTree, bits: int) -> None:
    """Of a grid of points, the part that the stranger finds filled is the coverage that the package computes."""
    texture = encode(tree, bits, to_source=np.eye(2, 3), name="x")
    quads, curves = (read(path)[0] for path in texture.save(f"{tmp_path}/"))
    grid = [(i + 0.5) / SIDE for i in range(SIDE)]
    for k, coverage in enumerate(decode(texture).coverage[0]):
        hits = [filled(quads, curves, (x + k % 2) / 2, (y + k // 2) / 2) for x in grid for y in grid]
        assert sum(hits) / len(hits) == pytest.approx(coverage, abs=2.0 / SIDE)


def test_a_stranger_reads_the_texts(tmp_path: Path) -> None:
    cells = np.full((1, 4), CellKind.FULL, np.uint8)
    full = CellTree(cells, np.full((1, 4), -1, np.int32), np.ones((1, 4)), np.zeros((0, 4, 2)), 0.0, 0)
    texture = encode(full, 8, to_source=np.array([[0.1, 0, 5], [0, -1e-7, 3]]), name="x", crs="EPSG:28992")
    expected = {
        "vexture.version": "1",
        "vexture.encoding": "thesis",
        "vexture.transform": "0.1 0 5 0 -1e-07 3",
        "vexture.crs": "EPSG:28992",
    }
    for path in texture.save(f"{tmp_path}/"):
        assert read(path)[1] == expected
