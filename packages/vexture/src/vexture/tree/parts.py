"""Growing large trees in parts: the subtree of a cell needs nothing of the rest, and may grow in its own thread.

One thread divides the cells at the top, which takes little time because their pieces move in runs. Each cell with a
short list is set aside as the root of a part. Parts are joined in the order in which they were set aside, so the tree
does not depend on the number of threads.
"""

import multiprocessing
import os
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from contextvars import copy_context
from threading import Event
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import ALONE
from vexture.tree.growth import (
    CURVES,
    FIRST,
    FIRST_PATH,
    LAST,
    LAST_PATH,
    PIECES,
    QUAD,
    QUADS,
    UNRESOLVED,
    WAITING,
    Growth,
)

LARGE = 1 << 17
"""Cubics. Smaller drawings grow too fast for threads to help."""

PART = 2048
"""Longest list, of pieces and runs, in a cell that is the root of a part: about 10 ms of work."""

AHEAD = 2
"""Parts for each thread: one grows while the next is set aside."""

A = TypeVar("A")
P = TypeVar("P")

Step = Callable[[Growth, int], Growth]
"""Function that grows a tree for a while, down to cells with lists of at most a given length. It raises an error at a
limit."""


class TreePart(NamedTuple):
    """A part that has grown."""

    quad: int  # the number of its first quad in the whole tree
    cells: NDArray[np.float64]
    first: NDArray[np.int64]
    curves: NDArray[np.int32]
    deviation: float
    unresolved: int


def usual_threads() -> int:
    """Default number of threads: one for each processor, or 1 in one of several worker processes."""
    if multiprocessing.parent_process() is not None and multiprocessing.current_process().name != ALONE:
        return 1
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def new_part(tree: Growth) -> Growth:
    """Arrays for a part. One part after another uses them, because new pages of memory take time."""

    def fresh(rows: NDArray[Any]) -> NDArray[Any]:
        return np.empty((PART, *rows.shape[1:]), rows.dtype)

    own = {name: fresh(getattr(tree.pool, name)) for name in ("points", "path", "numbers", "child", "part")}
    return Growth(
        tree.pool._replace(**own),
        fresh(tree.present),
        np.zeros_like(tree.stack),
        np.zeros_like(tree.corner),
        fresh(tree.cells),
        fresh(tree.first),
        fresh(tree.curves),
        np.zeros_like(tree.counts),
        np.zeros(1),
        np.zeros_like(tree.needed),
    )


def set_aside(tree: Growth, part: Growth) -> int:
    """Move the cell on top of a tree's stack to a part; return the number of its quad."""
    tree.counts[WAITING] -= 1
    top = int(tree.counts[WAITING])
    row = tree.stack[top]
    listed = tree.pool.numbers[row[FIRST] : row[LAST]].copy()
    present = tree.present[row[FIRST_PATH] : row[LAST_PATH]]
    alone = listed >= 0
    pieces = listed[alone]
    part.pool.points[: len(pieces)] = tree.pool.points[pieces]
    part.pool.path[: len(pieces)] = tree.pool.path[pieces]
    listed[alone] = np.arange(len(pieces))
    part.pool.numbers[: len(listed)] = listed
    part.present[: len(present)] = present
    part.corner[0], part.stack[0] = tree.corner[top], row
    for column, value in {QUAD: 0, FIRST: 0, FIRST_PATH: 0, LAST: len(listed), LAST_PATH: len(present)}.items():
        part.stack[0, column] = value
    part.stack[0, PIECES] = len(pieces)
    part.counts[:], part.deviation[0], part.needed[:] = 0, 0.0, 0
    part.counts[QUADS] = part.counts[WAITING] = 1
    return int(row[QUAD])


def _grown(part: Growth, quad: int, step: Step, stopped: Event) -> tuple[TreePart, Growth]:
    """Grow a part; return it and its arrays, which the next part can use."""
    while part.counts[WAITING] > 0 and not stopped.is_set():
        part = step(part, 0)
    quads, curves = part.counts[QUADS], part.counts[CURVES]
    return TreePart(
        quad,
        part.cells[:quads].copy(),
        part.first[:quads].copy(),
        part.curves[:curves].copy(),
        float(part.deviation[0]),
        int(part.counts[UNRESOLVED]),
    ), part


def grow_in_threads(
    fresh: Callable[[], A], find: Callable[[A], int], grow: Callable[[A, int, Event], tuple[P, A]], threads: int
) -> Generator[P, None, None]:
    """Grow parts in threads; yield them in the order in which they were set aside.

    `fresh` makes arrays for a part. `find` sets a part aside in them and returns the number of its quad, or -1 if no
    part is left. `grow` returns the part and the arrays, for another part. The caller must consume all parts.
    """
    growing: deque[Future[tuple[P, A]]] = deque()
    free = [fresh() for _ in range(AHEAD * threads)]
    stopped = Event()
    executor = ThreadPoolExecutor(threads)
    try:
        while True:
            if not free:
                part, arrays = growing.popleft().result()
                free.append(arrays)
                yield part
            arrays = free.pop()
            quad = find(arrays)
            if quad < 0:
                break
            growing.append(executor.submit(copy_context().run, grow, arrays, quad, stopped))
        while growing:
            yield growing.popleft().result()[0]
    finally:
        stopped.set()
        executor.shutdown(cancel_futures=True)


def grow_parts(tree: Growth, step: Step, threads: int, check: Callable[[int], None]) -> Growth:
    """Grow a tree in parts.

    `check` is called with the number of quads so far, and may raise an error.
    """

    def find(part: Growth) -> int:
        nonlocal tree
        while tree.counts[WAITING] > 0:
            top = tree.stack[tree.counts[WAITING] - 1]
            if top[LAST] - top[FIRST] <= PART:
                return set_aside(tree, part)
            tree = step(tree, PART)
        return -1

    def grow(part: Growth, quad: int, stopped: Event) -> tuple[TreePart, Growth]:
        return _grown(part, quad, step, stopped)

    parts, quads = list[TreePart](), 0
    growing: Generator[TreePart, None, None] = grow_in_threads(lambda: new_part(tree), find, grow, threads)
    with closing(growing):
        for part in growing:
            parts.append(part)
            quads += len(part.cells)
            check(quads)
    tree, curves = joined_cells(tree, parts)
    return step(tree, 0)._replace(curves=curves)  # a step without a cell, which computes the means above the parts


def joined_cells(tree: Growth, parts: Sequence[TreePart]) -> tuple[Growth, NDArray[np.int32]]:
    """Join the cells at the top and in the parts, and all curves. The top has a row for each part's first quad."""
    quads, curves = int(tree.counts[QUADS]), int(tree.counts[CURVES])
    cells: list[NDArray[Any]] = [tree.cells[:quads].copy()]
    first: list[NDArray[Any]] = [tree.first[:quads].copy()]
    outlines: list[NDArray[Any]] = [tree.curves[:curves].copy()]
    for part in parts:
        part.first[:] += quads - 1, curves
        cells[0][part.quad], first[0][part.quad] = part.cells[0], part.first[0]
        cells.append(part.cells[1:])
        first.append(part.first[1:])
        outlines.append(part.curves)
        quads, curves = quads + len(part.cells) - 1, curves + len(part.curves)
    tree.counts[QUADS], tree.counts[CURVES] = quads, curves
    tree.counts[UNRESOLVED] += sum(part.unresolved for part in parts)
    tree.deviation[0] = max([float(tree.deviation[0]), *(part.deviation for part in parts)])
    tree.needed[:] = 0
    return tree._replace(cells=np.concatenate(cells), first=np.concatenate(first)), np.concatenate(outlines)
