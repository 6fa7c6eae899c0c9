"""Growing large maps in parts, in several threads, as large trees grow. Each part has its own table of faces.

The tables are joined in the order of the parts, so that the map is the same, bit for bit, with any number of threads.
This holds only if faces of one paint have exactly one colour, as in maps to be restyled. Paints may be numbered in
another order than in a map that grows as a whole, because the order in which faces are met depends on when their table
is full.
"""

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from threading import Event
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.tree.growth import CURVES, FIRST, FIRST_PATH, LAST, LAST_PATH, QUADS, UNRESOLVED, WAITING
from vexture.tree.parts import PART, TreePart, grow_in_threads, joined_cells, new_part, set_aside
from vexture.tree.planar.faces import FaceTable, add_faces, faces_with, new_faces, trim_faces
from vexture.tree.planar.growth import BASE, PlanarGrowth, State

Step = Callable[[State, int], State]
"""Function that grows a map for a while, down to cells with lists of at most a given length. It raises an error at a
limit."""


class _Arrays:
    """Arrays that one part after another uses, and the number of faces met before the part."""

    def __init__(self, whole: State) -> None:
        tree = new_part(whole.growth.tree)
        rows = np.zeros((len(tree.cells), 4, 4)), np.zeros((len(tree.curves), 2), np.int64)
        growth = PlanarGrowth(tree, np.zeros_like(whole.growth.ground), *rows)
        layers = whole.layers._replace(hides=whole.layers.hides.copy())  # which threads must not share
        self.state, self.met = State(growth, layers, whole.faces), 0

    def set_aside(self, whole: State) -> int:
        """Move the cell on top of a map's stack to these arrays; return the number of its quad."""
        growth, layers, _ = self.state
        tree = whole.growth.tree
        top = tree.stack[tree.counts[WAITING] - 1]
        paths = int(top[LAST_PATH] - top[FIRST_PATH])
        present = growth.tree.present
        if paths > len(present):
            growth = growth._replace(tree=growth.tree._replace(present=np.empty((2 * paths, 2), np.int64)))
        ground = int(whole.growth.ground[tree.counts[WAITING] - 1])
        growth.ground[0], self.met = 1 if ground else 0, int(whole.faces.counts[0])
        self.state = State(growth, layers, faces_with(whole.faces, ground))
        return set_aside(tree, growth.tree)


class _MapPart(NamedTuple):
    """A part that has grown; its paints are the numbers of its own faces."""

    cells: TreePart
    mean: NDArray[np.float64]
    sides: NDArray[np.int64]
    faces: FaceTable
    met: int  # faces that the map had met when the part was set aside


def _grown(arrays: _Arrays, quad: int, step: Step, stopped: Event) -> tuple[_MapPart, _Arrays]:
    """Grow a part; return it and its arrays, which the next part can use."""
    while arrays.state.growth.tree.counts[WAITING] > 0 and not stopped.is_set():
        arrays.state = step(arrays.state, 0)
    growth, _, faces = arrays.state
    tree, quads, curves = growth.tree, growth.tree.counts[QUADS], growth.tree.counts[CURVES]
    cells = TreePart(
        quad,
        tree.cells[:quads].copy(),
        tree.first[:quads].copy(),
        tree.curves[:curves].copy(),
        float(tree.deviation[0]),
        int(tree.counts[UNRESOLVED]),
    )
    return _MapPart(
        cells, growth.mean[:quads].copy(), growth.sides[:curves].copy(), trim_faces(faces), arrays.met
    ), arrays


def grow_map_parts(state: State, step: Step, threads: int, check: Callable[[int, int], bool]) -> State | None:
    """Grow a map in parts; return it, or None if `check` returns False.

    `check` is called with the numbers of quads and curves so far, and may raise an error.
    """
    every: list[_Arrays] = []

    def fresh() -> _Arrays:
        every.append(_Arrays(state))
        return every[-1]

    def find(arrays: _Arrays) -> int:
        nonlocal state
        tree = state.growth.tree
        while tree.counts[WAITING] > 0:
            top = tree.stack[tree.counts[WAITING] - 1]
            if top[LAST] - top[FIRST] <= PART:
                return arrays.set_aside(state)
            state = step(state, PART)
            tree = state.growth.tree
        return -1

    def grow(arrays: _Arrays, quad: int, stopped: Event) -> tuple[_MapPart, _Arrays]:
        return _grown(arrays, quad, step, stopped)

    parts, quads, curves = list[_MapPart](), 0, 0
    growing: Generator[_MapPart, None, None] = grow_in_threads(fresh, find, grow, threads)
    with closing(growing):
        for part in growing:
            parts.append(part)
            quads, curves = quads + len(part.mean), curves + len(part.sides)
            if not check(quads, curves):
                return None
    for arrays in every:
        state.layers.hides[:] |= arrays.state.layers.hides
    return _join_parts(state, parts, step)


def _join_parts(state: State, parts: Sequence[_MapPart], step: Step) -> State:
    """Join the cells at the top and those of the parts, and all curves, with faces numbered by one table."""
    (tree, ground, mean, sides), layers, _ = state
    quads, curves = int(tree.counts[QUADS]), int(tree.counts[CURVES])
    tree.cells[[part.cells.quad for part in parts]] = 0.0
    faces, paints, of_parts = _one_table(state.faces, parts)
    _renumber(tree.cells[:quads], paints)
    means: list[NDArray[Any]] = [mean[:quads].copy()]
    beside: list[NDArray[Any]] = [paints[sides[:curves]]]
    for part, own in zip(parts, of_parts, strict=True):
        _renumber(part.cells.cells, own)
        means[0][part.cells.quad] = part.mean[0]
        means.append(part.mean[1:])
        beside.append(own[part.sides])
    tree, outlines = joined_cells(tree, [part.cells for part in parts])
    growth = PlanarGrowth(tree, ground, np.concatenate(means), np.concatenate(beside))
    growth, _, _ = step(
        State(growth, layers, faces), 0
    )  # a step without a cell, which computes the means above the parts
    return State(growth._replace(tree=growth.tree._replace(curves=outlines)), layers, faces)


def _renumber(cells: NDArray[np.float64], paints: NDArray[np.int64]) -> None:
    """Replace the numbers of cells' base paints."""
    cells[:, :, BASE] = paints[cells[:, :, BASE].astype(np.int64)]


def _one_table(
    top: FaceTable, parts: Sequence[_MapPart]
) -> tuple[FaceTable, NDArray[np.int64], list[NDArray[np.int64]]]:
    """Join the tables of faces in the order of the parts; also return the paint of each old table's faces."""
    tables = [top, *(part.faces for part in parts)]
    counts = [int(table.counts[0]) for table in tables]
    paths = sum(int(table.starts[count]) for table, count in zip(tables, counts, strict=True))
    faces = FaceTable(*new_faces(1 << sum(counts).bit_length(), paths + 1))
    numbers = [np.zeros(count, np.int64) for count in counts]
    done = 1
    for part, count, number in zip(parts, counts[1:], numbers[1:], strict=True):
        add_faces(faces, top, done, part.met, numbers[0])
        add_faces(faces, part.faces, 1, count, number)
        done = part.met
    add_faces(faces, top, done, counts[0], numbers[0])
    first, *others = (faces.paint[number] for number in numbers)
    return faces, first, others
