"""Numbers that stand for no value without being declared so: largest integers of packed data, and rows of nines."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from vexture.geo.series import FARTHEST, MISSING, Values
from vexture.notes import Notes

__all__ = ["codes_of", "codes_of_integers", "without_undeclared"]

NINES: Final = tuple(float(10**digits - 1) for digits in range(3, 8))
"""Numbers that programs write where they have no value, also below 0."""

FAR: Final = 2.0
"""How much larger such a number is than any other; a sea can be 999 m deep at a place."""

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


def without_undeclared(values: Values, codes: Sequence[float], metres: float, name: str, notes: Notes | None) -> Values:
    """Values in a unit of so many `metres`, with NaN in place of those that stand for none, which a note names."""
    for code in codes:
        values = _without(values, code, name, notes)
    for _ in range(2 * len(NINES)):
        nine = _far(values, metres)
        if nine is None:
            break
        values = _without(values, nine, name, notes)
    return values


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
