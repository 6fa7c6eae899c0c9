"""Turns of a shader's loops by the waves of a GPU, their lanes in lockstep.

The packed shader's loops are counted by its mirror (`vexture.renderers.cpu`), whose functions run here with some of
their calls observed. A wave runs a turn of a loop if any lane does: lanes count turns from each turn of the loop
around it.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import Kernel
from vexture.renderers import cells, cpu, flat
from vexture.texture.texture import Texture
from vexture_evidence.measures.bands import COUNT_BITS, BandTexture, eligible_roots
from vexture_evidence.measures.gpu_model import LANES, ONCE, ScopeShape

SIDE = 8
"""A wave has SIDE x SIDE pixels."""

Lane = Callable[[tuple[float, float]], object]
"""Runs the shader for the pixel at a centre."""

Observer = Callable[..., None]


class Turns:
    """Turns of a program's scopes by the lanes of a wave, and of the waves before it.

    Examples
    --------
    >>> turns = Turns(ScopeShape("cells(pieces)"))
    >>> for wave in ((1, 3), (2,)):
    ...     for pieces in wave:
    ...         turns.next_lane()
    ...         turns.turn("cells")
    ...         turns.turn("pieces", pieces)
    ...     turns.next_wave()
    >>> turns.per_wave(), turns.per_pixel()
    ({'cells': 1.0, 'pieces': 2.5}, {'cells': 1.0, 'pieces': 2.0})
    """

    def __init__(self, shape: ScopeShape) -> None:
        self.parents = shape.parents
        self.inner = {one: [k for k, parent in self.parents.items() if parent == one] for one in (ONCE, *self.parents)}
        self.lanes: Counter[str] = Counter()
        self.waves: Counter[str] = Counter()
        self.counted = {"lanes": 0, "waves": 0}
        self.ran: set[tuple[str, tuple[int, ...]]] = set()
        self.at: dict[str, tuple[int, ...]] = {ONCE: ()}  # the present turn of each scope, after those around it
        self.done: dict[str, int] = {}

    def next_lane(self) -> None:
        """Begin the turns of another lane of the wave."""
        self.counted["lanes"] += 1
        for name in self.inner[ONCE]:
            self.done[name] = 0

    def next_wave(self) -> None:
        """End the wave, all of whose lanes have run."""
        self.counted["waves"] += 1
        self.waves.update(name for name, _ in self.ran)
        self.ran.clear()

    def turn(self, name: str, times: int = 1) -> None:
        """Begin the lane's next turns of a scope, within the present turn of the one around it."""
        self.lanes[name] += times
        around = self.at[self.parents[name]]
        for _ in range(times):
            self.at[name] = (*around, self.done[name])
            self.ran.add((name, self.at[name]))
            self.done[name] += 1
        for one in self.inner[name]:
            self.done[one] = 0

    def per_wave(self) -> dict[str, float]:
        """Mean turns of each scope in a wave."""
        return {name: self.waves[name] / self.counted["waves"] for name in self.parents}

    def per_pixel(self) -> dict[str, float]:
        """Mean turns of each scope by a lane."""
        return {name: self.lanes[name] / self.counted["lanes"] for name in self.parents}


def run_waves(turns: Turns, lane: Lane, corners: Iterable[tuple[int, int]]) -> None:
    """Run the waves whose first pixels are given, column and row."""
    for column, row in corners:
        for k in range(LANES):
            turns.next_lane()
            lane((column + k % SIDE + 0.5, row + k // SIDE + 0.5))
        turns.next_wave()


def observe_kernel(
    kernel: Any, observers: Mapping[str, Observer], functions: dict[str, Callable[..., Any]]
) -> Callable[..., Any]:
    """Make a function of Python from a kernel and those that it calls; those in `observers` also call their observer.

    `functions` collects the functions by name.
    """
    inner = kernel.py_func
    names = dict(inner.__globals__)
    function = FunctionType(inner.__code__, names, inner.__name__)
    functions[inner.__name__] = (
        with_observer(function, observers[inner.__name__]) if inner.__name__ in observers else function
    )
    for name in inner.__code__.co_names:
        if isinstance(names.get(name), Kernel):
            names[name] = functions.get(name) or observe_kernel(names[name], observers, functions)
    return functions[inner.__name__]


def with_observer(function: Callable[..., Any], observer: Observer) -> Callable[..., Any]:
    """Make a function that also calls an observer, with its result and its arguments."""

    def result(*arguments: Any) -> Any:
        found = function(*arguments)
        observer(found, *arguments)
        return found

    return result


def packed_observers(turns: Turns, is_flat: bool) -> dict[str, Observer]:
    """Observers of the mirror's functions, each of which counts turns of a scope."""

    def descend(found: tuple[cells.VextureCell, cells.VextureTop], texels: Any, top: cells.VextureTop, *_: Any) -> None:
        turns.turn("cells")
        cell = found[0]
        levels = top.bit - cell.bit
        for k in range(levels):
            turns.turn("descend")
            if k < levels - 1 or cell.is_quad:
                turns.turn("quads")

    def count(found: int, *_: Any) -> None:
        turns.turn("pieces", found)

    def better_t(found: Any, piece: Any, side: float, *_: Any) -> None:
        if side == 0.0:  # a step calls it for either side
            turns.turn("steps")

    def is_beside(found: bool, *_: Any) -> None:
        turns.turn("more")
        if found:  # the shader treats such a square as a quad of area 0; the mirror skips it
            for scope in ("cells", "cut", "quad"):
                turns.turn(scope)

    def noting(scope: str) -> Observer:
        return lambda *_: turns.turn(scope)

    notes: dict[str, Observer] = {
        "descend": descend,
        "count": count,
        "better_t": better_t,
        "mean": noting("quad"),
        "first_curve": noting("leaf"),
        "piece": noting("close"),
    }
    if is_flat:
        return notes
    of_any = {"box_area": "cut", "part_inside": "parts", "above_ends": "edge"}
    return {**notes, **{name: noting(scope) for name, scope in of_any.items()}, "is_beside": is_beside}


def packed_lane(turns: Turns, texture: Texture, to_unit: NDArray[np.float64], is_flat: bool) -> Lane:
    """Lane of a packed texture's first shape, with `vextureFlatCoverage` or with `vextureCoverage`.

    Raises
    ------
    LookupError
        If the mirror no longer calls the functions by which turns are counted.
    """
    notes = packed_observers(turns, is_flat)
    made: dict[str, Callable[..., Any]] = {}
    observe_kernel(flat.flat_coverage if is_flat else cpu.coverage, notes, made)
    if missing := notes.keys() - made.keys():
        raise LookupError(f"the mirror does not call {', '.join(sorted(missing))}; count turns by what it calls")
    coverage = observe_kernel(cpu.view_coverage, notes, made)
    return lambda pixel: coverage(texture.texels, is_flat, texture.roots[0].quad, (0, 0), to_unit, pixel)


def band_lane(turns: Turns, texture: BandTexture, to_unit: NDArray[np.float64]) -> Lane:
    """Lane of the band method, ``shaders/bands.glsl``."""
    eligible = eligible_roots()
    lists, outlines = texture.lists.tolist(), texture.outlines.astype(np.float64)
    curves = np.concatenate([outlines[:-1], outlines[1:, :2]], axis=1).reshape(-1, 3, 2)
    heads = {"level": 0, "upright": texture.bands}

    def lane(pixel: tuple[float, float]) -> None:
        h = to_unit @ (*pixel, 1.0)
        uv = h[:2] / h[2]
        size = np.abs((to_unit[:2, :2] - uv[:, None] * to_unit[2, :2]) / h[2]).sum(axis=1)
        place, margin = (uv - texture.box[:2]) * texture.box[2:], 0.5 * size * texture.box[2:]
        if (place < -margin).any() or (place > texture.bands + margin).any():
            return
        turns.turn("inside")
        band = np.clip(place.astype(np.int64), 0, texture.bands - 1)
        for along, name in enumerate(heads):
            head = lists[heads[name] + band[1 - along]]
            first = head >> COUNT_BITS
            for at in lists[first : first + (head & (1 << COUNT_BITS) - 1)]:
                turns.turn(name)
                points = curves[at] - uv
                if points[:, along].max() / size[along] < -0.5:
                    break
                turns.turn(f"{name}_ahead")
                y1, y2, y3 = points[:, 1 - along] > 0.0
                if eligible >> (2 * y1 + 4 * y2 + 8 * y3) & 3:
                    turns.turn(f"{name}_crossed")

    return lane
