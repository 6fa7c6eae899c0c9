"""Arguments of `vexture.map`: wrong ones are refused in one line, before anything is read."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final, Literal

from vexture.base.content import renaming
from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing
from vexture.notebook.picture import MARGIN
from vexture.notebook.traits import format_value, pixels
from vexture.notebook.widget import HEIGHT, PICTURE_WIDTH
from vexture_geo.base.snap import MOST_SNAP
from vexture_geo.maps import MapLayer, Scale, Times
from vexture_geo.maps.colours import DEFAULT_CLASSES, NO_DATA
from vexture_geo.maps.place import MERCATOR

STROKE: Final = "3px"
"""Default width of lines: visible in a widget at once, like those of GeoPandas' ``explore``."""

OF_STEPS: Final = {"times": "column", "labels": "times"}
"""Parameters of layers, and the arguments of `map` that they come from, where `column` names the steps' columns."""

THEIRS: Final = {
    "palette": ("cmap",),
    "scale": ("scheme", "categorical", "vmin", "vmax", "classification_kwds"),
    "classes": ("k",),
    "no_data": ("missing_kwds",),
    "tooltip": ("popup", "tooltip_kwds"),
    "fill": ("color", "facecolor"),
    "stroke": ("style_kwds", "linewidth"),
    "outline": ("edgecolor",),
    "symbol_size": ("marker_kwds", "markersize"),
    "view": ("location", "zoom_start"),
}
OWN: Final = {their: own for own, every in THEIRS.items() for their in every}
"""Options of GeoPandas' maps, and their equivalents here."""


@dataclass(frozen=True, slots=True)
class MapOptions:
    """Options of `vexture.map`: those of a `Scale` (`scale` is its `kind`), a `MapLayer` and `convert_map`."""

    scale: str = "auto"
    palette: str | None = None
    classes: int = DEFAULT_CLASSES
    no_data: str = NO_DATA
    layer: str | None = None
    where: str | None = None
    source_crs: str | None = None
    id: str | None = None
    columns: tuple[str, ...] | None = None
    fill: str | None = None
    order: str | None = None
    stroke: str = STROKE
    outline: str | None = None
    outline_width: str = "1px"
    symbol: Drawing | None = None
    symbol_size: str = "8px"
    crs: str = MERCATOR
    snap: float | None = None
    size: int | None = None
    tolerance: float | Literal["auto"] = "auto"
    max_seconds: float = DEFAULT_SECONDS

    def scale_of(self, column: str) -> Scale:
        """Make the scale of a column."""
        return Scale(column, self.scale, self.palette, self.classes, self.no_data)

    def layer_of(self, source: Any, color: Scale | None, times: Times | None) -> MapLayer:
        """Make the layer of a source, coloured by a scale, by steps, or by one fill."""
        return MapLayer(
            source,
            layer=self.layer,
            where=self.where,
            source_crs=self.source_crs,
            id=self.id,
            columns=self.columns,
            color=color,
            times=times,
            fill=self.fill,
            order=self.order,
            stroke=self.stroke,
            outline=self.outline,
            outline_width=self.outline_width,
            symbol=self.symbol,
            symbol_size=self.symbol_size,
        )


def parse_options(options: dict[str, Any], column: Any, legend: Any, *, has_colours: bool) -> MapOptions:
    """Check options, where None means the default; refuse unknown and impossible ones."""
    known = MapOptions.__dataclass_fields__
    for name in options:
        if name not in known:
            other = f"give `{OWN[name]}`" if name in OWN else f"there are {', '.join(known)}"
            raise ParameterError(f"map has no option {name!r}; {other}")
    given = {name: value for name, value in options.items() if value is not None}
    if not isinstance(legend, bool):
        raise ParameterError(f"`legend` is {format_value(legend)}; give True or False")
    if not isinstance(where := given.get("where", ""), str):
        remedy = "give a condition in SQL, such as 'people > 1000', or choose rows of the frame"
        raise ParameterError(f"`where` is a {type(where).__name__}; {remedy}")
    if "fill" in given and has_colours:
        shows = "`times` give" if column is None else f"`column` {format_value(column)} gives"
        raise ParameterError(f"`fill` is {format_value(given['fill'])}, and {shows} colours; leave one out")
    snap, tolerance = given.get("snap", 0.0), given.get("tolerance", "auto")
    if not (_is_number(snap) and 0.0 <= snap <= MOST_SNAP):
        raise ParameterError(
            f"`snap` is {format_value(snap)}; it must be in 0..{MOST_SNAP}, in parts of the map's larger side"
        )
    if tolerance != "auto" and not (_is_number(tolerance) and 0.0 <= tolerance < 1.0):
        raise ParameterError(f"`tolerance` is {format_value(tolerance)}; give 'auto' or a number from 0 to below 1")
    return MapOptions(**given)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def check_source(source: Any) -> None:
    """Raise a `ParameterError` for a table without geometries."""
    if not hasattr(source, "columns") or hasattr(source, "geometry"):
        return
    kind = type(source).__name__
    remedy = "choose it by set_geometry" if kind == "GeoDataFrame" else "keep that of the GeoDataFrame, or set_geometry"
    raise ParameterError(f"`source` is a {kind} without a column of geometries; {remedy}")


def size_of(size: Any, width: Any, height: Any) -> int | tuple[float, float]:
    """Pixels of the map's larger side; without `size`, the box that a widget has for it at first."""
    if size is not None:
        return pixels("size", size)
    box = (
        PICTURE_WIDTH if width is None else pixels("width", width),
        HEIGHT if height is None else pixels("height", height),
    )
    return (box[0] / (1.0 + 2 * MARGIN), box[1] / (1.0 + 2 * MARGIN))


def column_of(source: Any, column: Any) -> "str | list[str] | None":
    """Name of a column, or a list of names."""
    if column is None or isinstance(column, str):
        return column
    if not isinstance(column, Iterable):
        return str(column)  # a GeoDataFrame may name columns by numbers
    parts = list(column)
    if not parts:
        raise ParameterError("`column` is an empty list; name a column, or leave it out")
    there = {str(name) for name in getattr(source, "columns", ())}
    names = [str(part) for part in parts]
    is_values = hasattr(column, "dtype") or not all(isinstance(part, str | int) for part in parts)
    if not there.issuperset(names) and (is_values or (there and not isinstance(parts[0], str))):
        remedy = "add them as a column of the frame, and give its name"
        raise ParameterError(f"`column` is a {type(column).__name__} of values, not of names of columns; {remedy}")
    return names


def times_of(source: Any, column: str | list[str] | None, times: Any) -> Times | None:
    """Values that change with time: columns with the names of steps, or a table."""
    names = {str(name) for name in getattr(source, "columns", ())}
    is_column = isinstance(column, str) and column in names  # even if its name contains a wildcard
    several = column is not None and not is_column and (not isinstance(column, str) or Times(column).is_pattern)
    if times is not None and not isinstance(times, os.PathLike | Iterable):
        raise ParameterError(
            f"`times` is {format_value(times)}; give the names of the steps, or a table of id, time and a value"
        )
    if several:
        if times is not None and Times(times).is_table:
            raise ParameterError("`times` is a table, and `column` names columns of steps; give one of them")
        steps: Any = times.split(",") if isinstance(times, str) else times
        with renaming(OF_STEPS):
            return Times(column, None if steps is None else tuple(steps))
    if times is None:
        return None
    if not Times(times).is_table:
        raise ParameterError("`times` names steps; give the `column` of each, or a table of id, time and a value")
    if column is not None:
        raise ParameterError(
            f"`times` has the values, so `column` {format_value(column)} is not shown; leave it out, and set it later"
        )
    return Times(times)
