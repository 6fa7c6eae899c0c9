"""Restore the outlines of a shape from its packed leaves, and write them as SVG in the units of the source.

The filled part of a leaf has a closed boundary: its pieces, and stretches of the leaf's edges, whose multiplicity at
each height follows from the windings. In the sum over all leaves, stretches between neighbours that agree cancel. The
rest is the boundary of the whole shape, which is closed for any texels. All coordinates are integers on the lattice of
the smallest leaf, so that stretches cancel and ends meet exactly. Horizontal parts change no winding, and at each
height they can close the boundary in only one way.
"""

import math
import re
from collections.abc import Iterable
from typing import NamedTuple
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import COVERAGE_ONE, LATTICE, MOST_DEPTH
from vexture.bezier.convert import line_cubics, straight
from vexture.drawing.paint import Paint
from vexture.texture.curves import curve_points
from vexture.texture.root import Root
from vexture.texture.walk import HALVES, walk

SIDE = int(LATTICE) << MOST_DEPTH
"""Side of the unit square, in units of the finest lattice."""

STRAIGHT = 1.0
"""Lattice units of the leaf. A cubic is a rounded line if its inner control points are this close to a line's."""


class OutlineLeaves(NamedTuple):
    """The n leaves that are not empty, and their m pieces, in units of the finest lattice."""

    low: NDArray[np.int64]  # (n, 2): bottom-left corner
    side: NDArray[np.int64]  # (n,)
    corner: NDArray[np.int64]  # (n,): corner winding; 1 for full leaves
    pieces: NDArray[np.int64]  # (m, 4, 2)
    owner: NDArray[np.int64]  # (m,): leaf of each piece
    on_left: NDArray[np.bool_]  # (m, 2): does the piece start, and does it end, on its leaf's left edge
    is_line: NDArray[np.bool_]  # (m,)


def outlines(flat: NDArray[np.uint32], root: int) -> list[NDArray[np.float64]]:
    """Closed contours of a shape: cubics (n, 4, 2) in unit-square units, with the filled side on their left.

    `root` is the index of its root quad. Raises a `FormatError` if the texels (n, 4) are not a tree.
    """
    leaves = _leaves(flat, root)
    steep = leaves.pieces[:, 0, 1] != leaves.pieces[:, 3, 1]
    upright = _edges(leaves)
    ends: NDArray[np.int64] = np.concatenate([leaves.pieces[steep][:, [0, 3]], upright])
    level = _closing(ends)
    ends = np.concatenate([ends, level])
    arcs = np.concatenate([leaves.pieces[steep] / SIDE, _lines(upright) / SIDE, _lines(level) / SIDE])
    is_line = np.ones(len(arcs), np.bool_)
    is_line[: steep.sum()] = leaves.is_line[steep]
    return [_merge_lines(arcs[cycle], is_line[cycle]) for cycle in _cycles(ends)]


def _leaves(flat: NDArray[np.uint32], root: int) -> OutlineLeaves:
    origins: NDArray[np.int64] = np.zeros((1, 2), np.int64)
    low, sides, corner, pieces, owner, on_left, is_line = [], [], [], [], [], [], []
    total = 0
    for depth, level in enumerate(walk(flat, np.array([root]))):
        cells = (2 * origins[:, None] + HALVES).reshape(-1, 2)
        full = ~level.is_quad & (level.counts == 0) & (2 * level.coverages > COVERAGE_ONE)
        counts = level.counts.ravel()
        is_filled = (counts > 0) | full.ravel()
        unit = 1 << (MOST_DEPTH - depth - 1)
        side = int(LATTICE) * unit
        points = curve_points(flat[level.curves]).astype(np.int64)
        leaf = np.repeat(np.arange(is_filled.sum()), counts[is_filled])
        low.append(cells[is_filled] * side)
        sides.append(np.full(is_filled.sum(), side))
        corner.append(np.where(full, 1, level.windings).ravel()[is_filled])
        pieces.append(points * unit + low[-1][leaf][:, None])
        owner.append(leaf + total)
        on_left.append(points[:, [0, 3], 0] == 0)
        is_line.append(abs(points - _lines(points[:, [0, 3]])).max(axis=(1, 2)) <= STRAIGHT)
        total += is_filled.sum()
        origins = cells[level.is_quad.ravel()]
    return OutlineLeaves(*map(np.concatenate, (low, sides, corner, pieces, owner, on_left, is_line)))


def _lines(ends: NDArray[np.int64]) -> NDArray[np.float64]:
    """Straight cubics between ends (n, 2, 2)."""
    start, stop = np.moveaxis(ends.astype(np.float64), 1, 0)
    return line_cubics(start, stop)


def _edges(leaves: OutlineLeaves) -> NDArray[np.int64]:
    """Stretches of the leaves' left and right edges that bound the filled part, (n, 2, 2).

    In the code, `change` is added to the number of times that the edge at x runs upwards above y.
    """
    left, bottom = leaves.low.T
    right, top = left + leaves.side, bottom + leaves.side
    piece, end = np.nonzero(leaves.on_left)
    owner, event = leaves.owner[piece], 1 - 2 * end
    height = leaves.pieces[piece, 3 * end, 1]
    at_top = leaves.corner + np.bincount(owner, event, len(left)).astype(np.int64)
    start, stop = leaves.pieces[:, 0, 1], leaves.pieces[:, 3, 1]
    sign = np.sign(stop - start)
    x = np.concatenate([left, left[owner], left, right, right[owner], right, *2 * [right[leaves.owner]]])
    y = np.concatenate([bottom, height, top, bottom, height, top, np.minimum(start, stop), np.maximum(start, stop)])
    change = np.concatenate([-leaves.corner, -event, at_top, leaves.corner, event, -at_top, -sign, sign])
    return _stretches(x, y, change)


def _closing(ends: NDArray[np.int64]) -> NDArray[np.int64]:
    """Horizontal lines (n, 2, 2) that close a boundary, from the starts and ends of its other parts."""
    start, stop = ends[:, 0], ends[:, 1]
    change = np.repeat([1, -1], len(ends))  # a line starts where another part ends
    x, y = np.concatenate([stop, start]).T
    return _stretches(y, x, change)[:, :, ::-1]


def _stretches(along: NDArray[np.int64], place: NDArray[np.int64], change: NDArray[np.int64]) -> NDArray[np.int64]:
    """Parts (n, 2, 2) of the lines at `along`, between the places where their multiplicity changes.

    The multiplicity is the sum of the changes so far; each part is repeated that many times, and reversed if it is
    negative. On each line the changes add up to 0.
    """
    order = np.lexsort((place, along))
    points = np.stack([along[order], place[order]], axis=1)
    last = np.append((points[1:] != points[:-1]).any(axis=1), True)[: len(points)]
    times = np.cumsum(change[order])[last][:-1]
    points = points[last]
    stretches = np.stack([points[:-1], points[1:]], axis=1)
    stretches[times < 0] = stretches[times < 0, ::-1]
    return np.repeat(stretches, abs(times), axis=0)


def _cycles(ends: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Indices of the arcs in closed cycles: each arc starts where the one before it ends."""
    starting = np.lexsort(ends[:, 0].T)
    after = np.empty(len(ends), np.int64)
    after[np.lexsort(ends[:, 1].T)] = starting  # as many arcs end in a point as start there
    following = after.tolist()
    done = bytearray(len(ends))
    cycles = []
    for first in range(len(ends)):
        if not done[first]:
            cycle, arc = [], first
            while not done[arc]:
                done[arc] = 1
                cycle.append(arc)
                arc = following[arc]
            cycles.append(np.array(cycle))
    return cycles


def _merge_lines(arcs: NDArray[np.float64], is_line: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Merge consecutive vertical or horizontal lines of a contour, and make its other lines exactly straight."""
    step = np.sign(arcs[:, 3] - arcs[:, 0])
    aligned = is_line & (step == 0.0).any(axis=1)
    before = np.roll(step, 1, axis=0), np.roll(aligned, 1)
    begins = ~(aligned & before[1] & (step == before[0]).all(axis=1))
    turned = np.roll(arcs, -begins.argmax(), axis=0)
    begins, is_line = np.roll(begins, -begins.argmax()), np.roll(is_line, -begins.argmax())
    merged: NDArray[np.float64] = turned[begins]
    is_line = is_line[begins]
    merged[:, 3] = np.roll(merged[:, 0], -1, axis=0)
    merged[is_line] = line_cubics(merged[is_line, 0], merged[is_line, 3])
    return merged


DIGITS = 9
"""Decimal digits of a coordinate in unit-square units: finer than the lattice of all but the smallest leaves."""

NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def svg_document(shapes: Iterable[tuple[Root, list[NDArray[np.float64]]]], name: str) -> str:
    """SVG document with the title `name` and a path for each shape, from its closed contours in unit-square units.

    The view box contains the unit square of every shape. A `transform` flips a source whose y points up.
    """
    paths, corners, digits = [], [], 0
    for root, contours in shapes:
        matrix = root.to_source
        places = _places(matrix)
        digits = max(digits, places)
        upwards = np.linalg.det(matrix[:, :2]) > 0.0
        square = np.array([(0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]) @ matrix.T
        corners.append(square * (1, -1) if upwards else square)
        turn = ' transform="scale(1 -1)"' if upwards else ""
        data = "".join(
            _contour(contour @ matrix[:, :2].T + matrix[:, 2], straight(contour), places) for contour in contours
        )
        paths.append(f'<path{_fill(root.paint)}{turn} d="{data}"><title>{_text(root.name)}</title></path>\n')
    low, high = np.concatenate(corners).min(axis=0), np.concatenate(corners).max(axis=0)
    box = " ".join(_number(value, digits) for value in (*low, *(high - low)))
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">\n<title>{_text(name)}</title>\n'
    return head + "".join(paths) + "</svg>\n"


def _places(matrix: NDArray[np.float64]) -> int:
    """Digits after the decimal point of a coordinate in source units."""
    scale = float(abs(matrix[:, :2]).max())
    return max(DIGITS - math.floor(math.log10(scale)), 0) if scale > 0.0 else 0


def _number(value: float, places: int) -> str:
    text = f"{value:.{places}f}"
    text = text.rstrip("0").rstrip(".") if places else text
    return "0" if text == "-0" else text


def _contour(cubics: NDArray[np.float64], is_line: NDArray[np.bool_], places: int) -> str:
    """Path data of one contour."""
    (x, y), data = cubics[0, 0], []
    for cubic, line in zip(cubics, is_line, strict=True):
        points = cubic[3:] if line else cubic[1:]
        data.append(("L" if line else "C") + " ".join(_number(value, places) for value in points.flat))
    if is_line[-1]:
        data.pop()  # Z draws the last line
    return f"M{_number(x, places)} {_number(y, places)}{''.join(data)}Z"


def _fill(paint: Paint | None) -> str:
    if paint is None:
        return ""
    levels = [255.0 * part for part in paint.color]
    if all(abs(level - round(level)) < 1e-9 for level in levels):
        color = "#" + "".join(f"{round(level):02x}" for level in levels)
    else:
        color = "rgb(" + ",".join(f"{_number(100.0 * part, DIGITS)}%" for part in paint.color) + ")"
    opacity = "" if paint.opacity == 1.0 else f' fill-opacity="{_number(paint.opacity, DIGITS)}"'
    return f' fill="{color}"{opacity}'


def _text(text: str) -> str:
    """Escape XML's special characters and replace forbidden ones."""
    return escape(NOT_IN_XML.sub("\ufffd", text))
