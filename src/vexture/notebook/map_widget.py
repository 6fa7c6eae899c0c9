"""The widget of a map: its column, its selection, and what is told of a feature, as traits."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import traitlets
from numpy.typing import NDArray

from vexture.cartography import Map, Scale
from vexture.cartography.colours import colours_of
from vexture.errors import ParameterError
from vexture.notebook.widget import HEIGHT, VectorWidget
from vexture.notes import Notes

__all__ = ["MapWidget"]

SELECTED: Final = (0.0, 0.9, 1.0, 1.0)
"""Colour of the selected feature: in no ramp of the default palettes."""

MOST_TOLD: Final = 12
"""Attributes in a tip."""

LONGEST: Final = 80
"""Letters of a value there."""


class MapWidget(VectorWidget):
    """A map that can be moved, pointed at and coloured by another column; `vexture.map` makes it.

    Attributes
    ----------
    column : str or None
        Attribute that colours show.
    selected : str or None
        Name of a feature, which is shown in another colour; a click selects.
    legend : dict or None
        What colours mean: ``title``, ``kind``, and ``entries`` of a ``label`` and a ``color``.
    tip : list
        Names and values of the attributes of the feature under the pointer.
    table : pyarrow.Table
        All attributes; the first column, ``id``, has the names.
    view, colors, picked, hovered, background, width, height
        As of `VectorWidget`.
    """

    column = traitlets.Unicode(None, allow_none=True)
    selected = traitlets.Unicode(None, allow_none=True).tag(sync=True)
    legend: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    tip: Any = traitlets.List().tag(sync=True)
    _marked = traitlets.Dict().tag(sync=True)
    saved_traits = ("legend", "selected", "_marked")

    def __init__(
        self,
        made: Map,
        scale: Scale,
        *,
        tooltip: bool | Sequence[str] = True,
        has_legend: bool = True,
        **traits: Any,
    ) -> None:
        self.table = made.table
        self._ids = [str(name) for name in made.table.column("id").to_pylist()]
        self._row = {name: row for row, name in enumerate(self._ids)}
        self._told = _told(made, tooltip)
        self._scale, self._has_legend = scale, has_legend
        texture = made.conversion.texture
        style = texture.roots[0].style
        assert style is not None
        self._rgba: NDArray[np.float64] = np.zeros((len(self._ids), 4))
        self._seen = frozenset(style.names)  # others lie wholly below them
        for name, rgba in zip(style.names, style.rgba, strict=True):
            self._rgba[self._row[name]] = rgba
        legend = _legend(made.legends[0]) if made.legends and has_legend else None
        super().__init__(texture, **{"height": HEIGHT, **traits}, column=scale.column or None, legend=legend)
        self.observe(self._recolour, "column")
        self.observe(self._mark, "selected")
        self.observe(self._tell, "hovered")
        self.observe(self._select, "picked")

    @traitlets.validate("column")
    def _checked_column(self, proposal: Any) -> Any:
        name = proposal["value"]
        if name is not None and name not in self.table.column_names:
            raise ParameterError(
                f"there is no column {name!r}; the columns are {', '.join(self.table.column_names[:8])}"
            )
        return name

    @traitlets.validate("selected")
    def _checked_selected(self, proposal: Any) -> Any:
        if proposal["value"] is not None and proposal["value"] not in self._row:
            raise ParameterError(f"there is no feature {proposal['value']!r}; names are in the column `id` of `table`")
        return proposal["value"]

    def _recolour(self, change: Any) -> None:
        if change["new"] is None:
            return
        scale = replace(self._scale, column=change["new"])
        try:
            rgba, legend = colours_of(self.table, scale, Notes())
        except ParameterError:  # a column of texts: the scale was chosen for another one
            rgba, legend = colours_of(self.table, replace(scale, kind="categories", palette=None), Notes())
        self._rgba = np.round(rgba, 4)
        with self.hold_sync():
            pairs = zip(self._ids, self._rgba.tolist(), strict=True)
            self.colors = {name: colour for name, colour in pairs if name in self._seen}
            selected = self.selected
            self._marked = {selected: SELECTED} if selected is not None and selected in self._seen else {}
            self.legend = _legend(legend) if self._has_legend else None

    def _mark(self, change: Any) -> None:
        """Colour what is selected, and give what was selected its own colour again."""
        marked = {name: self._rgba[self._row[name]].tolist() for name in self._marked}
        if change["new"] in self._seen:
            marked[change["new"]] = SELECTED
        self._marked = marked

    def _tell(self, change: Any) -> None:
        row = self._row.get((change["new"] or {}).get("element") or "")
        values = {} if row is None else self.table.slice(row, 1).to_pylist()[0]
        self.tip = [[name, shown(values[name])] for name in self._told if name in values]

    def _select(self, change: Any) -> None:
        found = (change["new"] or {}).get("element")
        self.selected = found if found in self._row else None


def _legend(found: dict[str, Any]) -> dict[str, Any]:
    """A legend as pages draw it."""
    entries = [{"label": each["label"], "color": each["color"]} for each in found["entries"]]
    if "no_data" in found:
        entries.append({"label": "no data", "color": found["no_data"]["color"]})
    return {"title": found["column"], "kind": found["scale"], "entries": entries}


def _told(made: Map, tooltip: bool | Sequence[str]) -> list[str]:
    """Attributes that a tip has."""
    names: list[str] = made.table.column_names
    if isinstance(tooltip, bool):
        return names[:MOST_TOLD] if tooltip else []
    for name in tooltip:
        if name not in names:
            raise ParameterError(f"`tooltip`: there is no column {name!r}; the columns are {', '.join(names[:8])}")
    return [*tooltip]


def shown(value: Any) -> str:
    """A value in a tip.

    Examples
    --------
    >>> shown(3.0), shown(1234567.891), shown(None)
    ('3', '1,234,567.89', '–')
    """
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:,.6g}" if abs(value) < 1e6 else f"{value:,.2f}"
    return f"{value:,}" if isinstance(value, int) and not isinstance(value, bool) else str(value)[:LONGEST]
