"""Detect undeclared fill values: the largest integers of packed data, rows of nines, and -1.

Water can be 99 m deep, so a small number counts only if many cells have it and it is far above all others.
"""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from vexture.base.notes import Notes
from vexture_geo.depth.series import FARTHEST, MISSING, Values

NINES: Final = tuple(float(10**digits - 1) for digits in range(3, 8))
"""Numbers that programs write for missing values, also with a minus sign."""

FAR: Final = 2.0
"""Least ratio of such a number to any other; a sea can be 999 m deep at a place."""

SMALL_NINES: Final = (99.0, *(float(f"{nines}.{'9' * decimals}") for nines in (99, 999) for decimals in (1, 2, 3)))
"""Like `NINES`, but only in grids of depths: a bed of -99 m is as usual as one of -98 m."""

CLEARLY_FAR: Final = 10.0
"""Least ratio of one of `SMALL_NINES` to any depth; 99 m is no depth if the next is 9 m."""

LEAST_METRES: Final = 25.0
"""Least value of `SMALL_NINES` in metres: 99 ft is more, but 99 cm of water is usual."""

LEAST_CELLS, LEAST_SHARE = 10, 0.01
"""Fewest cells, and smallest fraction of all known cells, with such a number; a pit may have a few."""

BELOW: Final = (-1.0, *(-nines for nines in SMALL_NINES))
"""Fill values of grids of depths, if they are the only negative number."""

BYTES: Final = 2
"""Fewest bytes of integers with fill values: in 8 bits, 255 is as often a value that was too large."""

ROUNDING: Final = 1e-6


def codes_of(variable: Any) -> tuple[float, ...]:
    """Possible fill values of a packed variable that declares none."""
    about = {**variable.attrs, **variable.encoding}
    if any(key in about for key in ("_FillValue", "missing_value")):
        return ()
    scale, offset = float(about.get("scale_factor", 1.0)), float(about.get("add_offset", 0.0))
    return codes_of_integers(about.get("dtype", variable.dtype), scale, offset)


def codes_of_integers(dtype: Any, scale: float, offset: float) -> tuple[float, ...]:
    """Scale the extreme integers of a type; the second lowest is the default fill value of NetCDF.

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
    """Replace undeclared fill values by NaN, and name them in a note; values have a unit of `metres` metres.

    Depths have more fill values than levels or a bed; a note also names values that may be fill values.
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
    """Remove small fill values from depths."""
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
    """Find a number of nines among values that is far from all others."""
    with np.errstate(invalid="ignore"):
        known = values[np.abs(values) <= FARTHEST / abs(metres)]
    if metres == 1.0:
        known = known[~np.isin(known, MISSING)]  # these are unknown in any case
    if not known.size:
        return None
    number = float(known[np.argmax(np.abs(known))])
    others = np.abs(known[known != number])
    return number if abs(number) in NINES and abs(number) > FAR * others.max(initial=0.0) else None
