"""Limits of a tree, from the parameters of a conversion."""

import math
from typing import Final, NamedTuple, TypedDict

import numpy as np

from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, ParameterError
from vexture.base.layout import LATTICE, MOST_CURVES, MOST_DEPTH

DEFAULT_CAPACITY: Final = 8
"""Pieces in a leaf."""

DEFAULT_DEPTH: Final = 16
"""Depth limit. Cells of this depth are 1.5e-5 of the drawing wide."""

DISPLACEMENT: Final = 2.0
"""Lattice units by which a curve may move, because its points are rounded when it is cut, and again in its leaf."""

COINCIDENT: Final = 0.25
"""Share of the largest shift within which the pieces of a crowded cell count as one. Rounding takes half of it."""


class Bounds(NamedTuple):
    """Limits of a tree."""

    capacity: int  # pieces in a leaf
    tolerance: float  # unit-square units
    near: float  # unit-square units within which pieces of a crowded cell count as one
    least_depth: int  # depth of the largest leaf with pieces
    max_depth: int
    most_quads: int


class TreeParameters(TypedDict, total=False):
    """Parameters of `build_tree` and `build_map`, for functions that pass them on."""

    tolerance: float
    max_depth: int
    capacity: int
    precision: float | None


def largest_shift(precision: float | None) -> float:
    """Largest shift of an outline by rounding, in unit-square units, at a `precision` of `build_tree`.

    Examples
    --------
    >>> largest_shift(1e-7), round(largest_shift(None), 7)
    (1e-07, 3.05e-05)
    """
    return 0.5 * DISPLACEMENT / LATTICE if precision is None else precision


def check_whole(name: str, value: object, most: int, default: int) -> None:
    """Raise a `ParameterError` unless a parameter is a whole number in 1..`most`."""
    if isinstance(value, bool) or not (isinstance(value, int | np.integer) and 1 <= value <= most):
        raise ParameterError(f"`{name}` {value!r} is no whole number in 1..{most}; the default is {default}")


def _is_number(value: object) -> bool:
    return isinstance(value, float | int | np.number) and not isinstance(value, bool)


def bounds_of(
    tolerance: float,
    max_depth: int,
    capacity: int,
    precision: float | None,
    most_quads: int,
    default_capacity: int = DEFAULT_CAPACITY,
) -> Bounds:
    """Bounds of a tree from the parameters of `build_tree`; raise a `ParameterError` if one is out of range."""
    check_whole("max_depth", max_depth, MOST_DEPTH, DEFAULT_DEPTH)
    check_whole("capacity", capacity, MOST_CURVES, default_capacity)
    finest = DISPLACEMENT * 0.5**max_depth / LATTICE
    if not (precision is None or (_is_number(precision) and finest <= precision <= 1.0)):
        raise ParameterError(
            f"`precision` {precision!r} is no number in {finest:.1e}..1 (unit-square units), at `max_depth` "
            f"{max_depth}; leave it out for views up to 1,000 times, or give 1e-7 for 10,000"
        )
    least_depth = 1 if precision is None else max(math.ceil(math.log2(DISPLACEMENT / (precision * LATTICE))), 1)
    if not (_is_number(tolerance) and 0.0 <= tolerance < 1.0):
        raise ParameterError(
            f"`tolerance` {tolerance!r} is no number from 0 to below 1 (unit-square units); 0 keeps every piece"
        )
    near = COINCIDENT * largest_shift(precision)
    return Bounds(capacity, float(tolerance), near, least_depth, max_depth, most_quads)


def check_growth(quads: int, most_quads: int, name: str) -> None:
    """Raise a `LimitError` if a tree has too many quads or has taken too long."""
    if quads > most_quads:
        raise LimitError(
            f"{name}: {quads} quads at least; the limit is {most_quads}; "
            "use a smaller `max_depth`, a larger `tolerance` or a larger `precision`"
        )
    check_time(name)
