"""Columns as numbers, and numbers as the texts of a legend; dates are numbers of days."""

import re
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    import pyarrow

DIGITS: Final = range(6, 13)
"""Significant digits of numbers in a legend: as few as tell them apart. Differences beyond the last are noise."""

MOST_WHOLE: Final = 1e15
"""Numbers below this are written without an exponent, and whole ones are exact to the last digit."""

GROUPED: Final = 1e4
"""If any number of a legend reaches this, all get thousands separators. Years are below it and get none."""

UNITS: Final = {"D": 86_400, "m": 60, "s": 1}
"""Seconds in each unit of time: days, minutes and seconds."""

PLAIN: Final = re.compile(r"(-?)(\d+)(\.\d+)?")

BREAKS: Final = "rising breaks such as 10,20,50 or 2001-01-01,2011-01-01"


@dataclass(frozen=True, eq=False)
class Measure:
    """Values of a column as numbers, (f,); NaN where there is none.

    `unit` is that of times since 1970: ``D``, ``m`` or ``s``, the longest in which all are whole. Numbers have none.
    """

    values: NDArray[np.float64]
    unit: str = ""

    @property
    def are_whole(self) -> bool:
        """True if all numbers are whole, as counts, years and days are; pandas stores floats if one is missing."""
        known = self.values[np.isfinite(self.values)]
        return bool((known == np.rint(known)).all() and np.abs(known).max() < MOST_WHOLE)

    def json_value(self, number: float) -> float | str:
        """Return a number for JSON, or a time in ISO 8601."""
        return self._time(number) if self.unit else number

    def texts(self, numbers: list[float]) -> list[str]:
        """Format numbers with as few digits as tell them apart and thousands separators, and times in ISO 8601.

        Examples
        --------
        >>> plain, days = Measure(np.zeros(1)), Measure(np.zeros(1), "D")
        >>> plain.texts([1990, 2000]), plain.texts([1500.25, 39056177]), days.texts([0, 18262])
        (['1990', '2000'], ['1,500.25', '39,056,177'], ['1970-01-01', '2020-01-01'])
        """
        if self.unit:
            return [self._time(number) for number in numbers]
        most = len(distinct(np.array(numbers)))
        tried = ([_text(number, digits) for number in numbers] for digits in DIGITS)
        found = next(texts for texts in tried if len(set(texts)) == most)
        return [_group_digits(text) for text in found] if max(map(abs, numbers), default=0.0) >= GROUPED else found

    def _time(self, number: float) -> str:
        return str(np.array(round(number)).astype(f"datetime64[{self.unit}]")).replace("T", " ")


def measure_of(column: "pyarrow.ChunkedArray") -> Measure | None:
    """Convert a column of numbers, dates or times; None for other columns."""
    import pyarrow as pa
    import pyarrow.compute as pc

    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    column = column.cast(kind)
    if any(test(kind) for test in (pa.types.is_integer, pa.types.is_floating, pa.types.is_decimal)):
        return Measure(np.asarray(column.cast(pa.float64(), safe=False).to_numpy(), np.float64))
    if not (pa.types.is_date(kind) or pa.types.is_timestamp(kind)):
        return None
    if pa.types.is_timestamp(kind) and kind.tz is not None:
        with suppress(pa.ArrowInvalid):  # an unknown time zone
            column = pc.local_timestamp(column)
    whole = column.cast(pa.timestamp("s"), safe=False).cast(pa.int64()).cast(pa.float64(), safe=False)
    seconds = np.asarray(whole.to_numpy(), np.float64)
    known = seconds[np.isfinite(seconds)]
    unit = next(unit for unit, length in UNITS.items() if not np.any(known % length))
    return Measure(seconds / UNITS[unit], unit)


def breaks_of(text: str, unit: str | None = None) -> NDArray[np.float64]:
    """Parse inner breaks of classes: numbers if `unit` is empty, times if it is a unit, either if it is None.

    Raises a `ParameterError` if they are not rising numbers or times.
    """
    for own in ("", "s") if unit is None else (unit,):
        try:
            found = np.array([_second_of(part) if own else float(part) for part in text.split(",")])
            found = np.ceil(found / UNITS[own]) if own else found
        except ValueError:
            continue
        if np.isfinite(found).all() and (np.diff(found) > 0).all():
            return found
    raise ParameterError(f"`scale` is {text!r}; give quantiles, equal, continuous, categories or {BREAKS}")


def _second_of(text: str) -> float:
    """Parse a time in ISO 8601 as seconds since 1970."""
    return float(np.datetime64(text.strip(), "s").astype(np.int64)) if text.strip().count("-") >= 2 else np.nan


def distinct(rising: NDArray[np.float64]) -> NDArray[np.float64]:
    """Keep the first of numbers that read the same."""
    _, first = np.unique([_text(value, DIGITS[-1]) for value in rising.tolist()], return_index=True)
    return np.asarray(rising[np.sort(first)])


def _text(number: float, digits: int) -> str:
    """Format a number with `digits` significant digits; its integer part is always complete."""
    return f"{number:.0f}" if 10**digits <= abs(number) < MOST_WHOLE else f"{number:.{digits}g}"


def _group_digits(text: str) -> str:
    """Add thousands separators to a number, unless it has an exponent."""
    found: Any = PLAIN.fullmatch(text)
    return text if found is None else f"{found[1]}{int(found[2]):,}{found[3] or ''}"
