"""Numbers that stand for no value without being declared so: largest integers of packed data, rows of nines, and -1.

Water can be 99 m deep. So a small number counts only if it is the depth of many cells, and far above all others.
"""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from vexture.base.notes import Notes
from vexture_geo.depth.series import FARTHEST, MISSING, Values

NINES: Final = tuple(float(10**digits - 1) for digits in range(3, 8))
"""Numbers that programs write where they have no value, also below 0."""

FAR: Final = 2.0
"""How much larger such a number is than any other; a sea can be 999 m deep at a place."""

SMALL_NINES: Final = (99.0, *(float(f"{nines}.{'9' * decimals}") for nines in (99, 999) for decimals in (1, 2, 3)))
"""As `NINES`, in grids of depths alone: a bed of -99 m is as usual as one of -98 m."""

CLEARLY_FAR: Final = 10.0
"""How much larger one of `SMALL_NINES` is than any depth: 9 m of water beside 99 m, and nothing between, is none."""

LEAST_METRES: Final = 25.0
"""Of `SMALL_NINES`: 99 ft is as much, and 99 cm of water is usual."""

LEAST_CELLS, LEAST_SHARE = 10, 0.01
"""Cells, and their part of all known ones, that have such a number: a pit may have a few."""

BELOW: Final = (-1.0, *(-nines for nines in SMALL_NINES))
"""What grids of depths have where nothing is known, if it is their only number below 0."""

BYTES: Final = 2
"""Integers of fewer bytes use all their numbers: 255 is as often a value that was too large."""

ROUNDING: Final = 1e-6


def codes_of(variable: Any) -> tuple[float, ...]:
    """Values by which a packed variable may say that there is none: it declares no fill value."""
    about = {**variable.attrs, **variable.encoding}
    if any(key in about for key in ("_FillValue", "missing_value")):
        return ()
    scale, offset = float(about.get("scale_factor", 1.0)), float(about.get("add_offset", 0.0))
    return codes_of_integers(about.get("dtype", variable.dtype), scale, offset)


def codes_of_integers(dtype: Any, scale: float, offset: float) -> tuple[float, ...]:
    """The outermost integers of a type, scaled; the lowest but one is the default fill value of NetCDF.

    Examples
    --------
    >>> codes_of_integers(np.uint16, 0.001, 0.0), codes_of_integers(np.float32, 1.0, 0.0)
    ((65.535,), ())
    """
    kind = np.dtype(dtype)
    if kind.kind not in "iu" or kind.itemsize < BYTES:
        return ()
    limits = np.iinfo(kind)
    ends = (limits.max,) if kind.kind == "u" else (limits.max, limits.min, limits.min + 1)
    return tuple(float(end) * scale + offset for end in ends)


def without_undeclared(
    values: Values, codes: Sequence[float], metres: float, name: str, notes: Notes | None, *, are_depths: bool = False
) -> Values:
    """Values in a unit of so many `metres`, with NaN in place of those that stand for none, which a note names.

    Those of depths, rather than of levels or a bed, have more of them; a note names what may be one, too.
    """
    for code in codes:
        values = _without(values, code, name, notes)
    for _ in range(2 * len(NINES)):
        nine = _far(values, metres)
        if nine is None:
            break
        values = _without(values, nine, name, notes)
    return _depths(values, metres, name, notes) if are_depths else values


def _depths(values: Values, metres: float, name: str, notes: Notes | None) -> Values:
    """Depths without small numbers that stand for none."""
    known = values[np.isfinite(values)]
    below = known[known < 0.0]
    if below.size and (below == below[0]).all() and (known > 0.0).any() and _is_among(float(below[0]), BELOW):
        values, known = _without(values, float(below[0]), name, notes), known[known >= 0.0]
    most = float(known.max(initial=0.0))
    if metres * most < LEAST_METRES or not _is_among(most, SMALL_NINES):
        return values
    others = known[known != most]
    next_most, count = float(others.max(initial=0.0)), known.size - others.size
    if next_most > 0.0 and most > CLEARLY_FAR * next_most and count >= max(LEAST_CELLS, LEAST_SHARE * known.size):
        return _without(values, most, name, notes)
    if most > FAR * next_most and notes is not None:
        notes.remark(
            f"{name} has values of {most:g}, read as depths; if they stand for none, declare them, as _FillValue or "
            "nodata"
        )
    return values


def _is_among(number: float, numbers: Sequence[float]) -> bool:
    return bool(np.isclose(number, numbers, rtol=ROUNDING, atol=0.0).any())


def _without(values: Values, code: float, name: str, notes: Notes | None) -> Values:
    found = np.isclose(values, code, rtol=ROUNDING, atol=0.0)
    if not found.any():
        return values
    if notes is not None:
        notes.remark(f"{name} has values of {code:g}, taken as unknown; declare them, as _FillValue or nodata")
    return np.where(found, np.nan, values)


def _far(values: Values, metres: float) -> float | None:
    """The number of nines among values from which all others are far, if there is one."""
    with np.errstate(invalid="ignore"):
        known = values[np.abs(values) <= FARTHEST / abs(metres)]
    if metres == 1.0:
        known = known[~np.isin(known, MISSING)]  # which are unknown in any case
    if not known.size:
        return None
    number = float(known[np.argmax(np.abs(known))])
    others = np.abs(known[known != number])
    return number if abs(number) in NINES and abs(number) > FAR * others.max(initial=0.0) else None
