"""Tips of features: names and values of attributes, as texts."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from vexture.base.errors import ParameterError
from vexture.notebook.traits import format_value

if TYPE_CHECKING:
    import pyarrow

    from vexture_geo.maps.notebook.map_steps import MapSteps

MOST_TOLD: Final = 12
"""Most attributes in a tip."""

LONGEST: Final = 80
"""Most letters of a value in a tip."""

MOST_SAVED: Final = 5_000
"""Most features for which a saved page has tips: it stores the texts of all of them."""


class Tips:
    """The tips of a map's features.

    Parameters
    ----------
    table : pyarrow.Table
    tooltip : bool or names of columns
    steps : MapSteps, optional
        Steps of a map that changes with time.
    """

    def __init__(self, table: "pyarrow.Table", tooltip: Any, steps: "MapSteps | None") -> None:
        self._table, self._steps = table, steps
        self._chosen = _chosen_names(table.column_names, tooltip)

    def _names(self, column: str | None) -> list[str]:
        """Names of a tip's attributes: the shown column comes first, and columns of steps only if they are chosen."""
        if self._chosen is not None:
            return self._chosen
        steps = self._steps.columns if self._steps else ()
        every = [name for name in self._table.column_names if name not in steps and name != column]
        return [*([] if column is None else [column]), *every][:MOST_TOLD]

    def tip_of(self, row: int, column: str | None, time: float | None) -> list[list[str]]:
        """Names and values of a row; the shown column or the value at a time in steps comes first."""
        values = self._table.slice(row, 1).to_pylist()[0]
        tip = [[name, format_attribute(values[name])] for name in self._names(column)]
        if time is None or self._steps is None or self._chosen == []:
            return tip
        name, value = self._steps.value(self._table, row, time)
        return [[name, format_attribute(value)], *tip]

    def as_json(self, column: str | None, is_timed: bool) -> dict[str, Any] | None:
        """Tips of all features, by name, for a page without a kernel: their values, and those of steps."""
        if len(self._table) > MOST_SAVED or self._chosen == []:
            return None
        names = self._names(column)
        steps = list(self._steps.columns) if is_timed and self._steps else []
        columns = [
            [format_attribute(value) for value in self._table.column(name).to_pylist()]
            for name in ("id", *names, *steps)
        ]
        ids = self._table.column("id").to_pylist()
        return {"names": names, "values": dict(zip(ids, (row[1:] for row in zip(*columns, strict=True)), strict=True))}


def _chosen_names(names: Sequence[str], tooltip: Any) -> list[str] | None:
    """Attributes that `tooltip` chooses; None for the default."""
    if tooltip is True:
        return None
    if tooltip is None or tooltip is False:
        return []
    if not (isinstance(tooltip, str | int) or hasattr(tooltip, "__iter__")):
        raise ParameterError(f"`tooltip` is {format_value(tooltip)}; give True, False or names of columns")
    chosen = [str(name) for name in ([tooltip] if isinstance(tooltip, str | int) else tooltip)]
    for name in chosen:
        if name not in names:
            raise ParameterError(f"`tooltip`: there is no column {name!r}; the columns are {', '.join(names[:8])}")
    return chosen


def format_attribute(value: Any) -> str:
    """Format a value for a tip. A number has no thousands separators, as it may be a year or a code.

    Examples
    --------
    >>> format_attribute(3.0), format_attribute(36061), format_attribute(1234567.891), format_attribute(None)
    ('3', '36061', '1234567.89', '–')
    """
    if value is None or value != value:
        return "–"
    if isinstance(value, float):
        return f"{value:.2f}".removesuffix(".00") if 1e6 <= abs(value) < 1e15 else f"{value:.6g}"
    return str(value)[:LONGEST]
