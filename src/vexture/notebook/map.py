"""`vexture.map`: features in the colours of an attribute, in a notebook, with a legend, hovering and picking."""

import os
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from vexture.content import renaming
from vexture.errors import DeviceError, ParameterError
from vexture.notebook.map_options import check_later, check_looks, column_of, unknown
from vexture.notes import place_of_caller, warn_at

if TYPE_CHECKING:
    from vexture.cartography import Times
    from vexture.notebook.map_widget import MapWidget

__all__ = ["map"]

OF_SCALE: Final = ("scale", "palette", "classes", "no_data")
OF_LAYER: Final = (
    *("layer", "where", "source_crs", "id", "columns", "fill", "order", "stroke"),
    *("outline", "outline_width", "symbol", "symbol_size"),
)
OF_MAP: Final = ("crs", "snap", "size", "tolerance", "max_seconds")
OPTIONS: Final = (*OF_SCALE, *OF_LAYER, *OF_MAP)
MARKS: Final = {"stroke": "2px"}
"""Lines that are hit and whose colours are told apart."""

CAPACITY: Final = 15
"""Pieces in a leaf: more than by default, as the bytes are sent to the page at once."""

NAMES: Final = {"source_crs": "crs"}
"""Options whose layers have another name for them."""

OF_STEPS: Final = {"times": "column", "labels": "times"}
"""Where `column` names those of steps, what it and their names are called by layers."""


def map(
    source: Any,
    column: str | Sequence[str] | None = None,
    *,
    times: Any = None,
    tooltip: bool | Sequence[str] | None = True,
    legend: bool = True,
    width: int | None = None,
    height: int | None = None,
    background: str | None = None,
    view: tuple[float, float, float, float] | None = None,
    **options: Any,
) -> "MapWidget":
    """Show features in a notebook: drag, zoom, hover and click, as with GeoPandas' ``explore``, sharp at every zoom.

    Parameters
    ----------
    source : GeoDataFrame or path
        A file that ``vexture map`` reads.
    column : str or sequence of str, optional
        Attribute that colours show; several, or a pattern such as ``y*``, are those of the steps of time.
    times : sequence of str, table, DataFrame or path, optional
        Names of the steps; or a table of ``id``, ``time`` and a value, in place of `column`. With steps a slider is
        shown, and the trait `time` is the step.
    tooltip : bool or sequence of str
        Attributes that are told of the feature under the pointer; by default the first twelve, and that of the colours.
    legend : bool
    width, height, background, view
        As of `vexture.show`.
    **options
        Of the colours (`vexture.cartography.Scale`): ``scale``, ``palette``, ``classes``, ``no_data``. Of what is drawn
        (`MapLayer`): ``layer``, ``where``, ``id``, ``columns``, ``fill``, ``order``, ``stroke``, ``outline``,
        ``outline_width``, ``symbol``, ``symbol_size``, ``source_crs``. Of the map (`convert_map`): ``crs``, ``snap``,
        ``size``, ``tolerance``. By default ``id`` is the index of a GeoDataFrame that has one of its own, lines are
        ``2px`` wide, and pixels are those of a map as large as the widget is high (``size``).

    Returns
    -------
    MapWidget
        Its traits `column`, `time`, `selected`, `hovered`, `picked` and `view` change the picture, and tell what users
        do.

    Raises
    ------
    DeviceError
        If the packages of ``vexture[notebook,map]`` are missing.
    ParameterError
        If there is no such column or option. For other errors see `convert_map`.

    Examples
    --------
    >>> import geopandas, shapely
    >>> fields = geopandas.GeoDataFrame(
    ...     {"id": ["a", "b"], "yield": [4.0, 9.0]},
    ...     geometry=[shapely.box(0, 0, 1, 1), shapely.box(1, 0, 2, 1)],
    ...     crs="EPSG:28992",
    ... )
    >>> shown = map(fields, "yield", id="id", crs="EPSG:28992", classes=2)
    >>> shown.selected = "b"
    >>> [entry["label"] for entry in shown.legend["entries"]]
    ['4 - 6', '7 - 9']
    """
    try:
        from vexture.notebook.map_widget import MapWidget
        from vexture.notebook.widget import HEIGHT
    except ModuleNotFoundError as error:
        raise DeviceError(f"map needs the package {error.name}: pip install 'vexture[notebook,map]'") from None
    from vexture.cartography import MapLayer, Scale, Times
    from vexture.cartography.convert import converted
    from vexture.cartography.place import MERCATOR
    from vexture.cartography.prepare import prepared
    from vexture.deadline import DEFAULT_SECONDS

    for name in options:
        if name not in OPTIONS:
            raise unknown(name, OPTIONS)
    shown = {"width": width, "height": height, "background": background, "view": view}
    check_looks(shown, legend)
    check_later(options)
    fields = {name: options.pop(name) for name in OF_SCALE if name in options}
    column = column_of(column)
    changing = _times(source, column, times, Times)
    column = None if column is None or changing is not None else str(column)
    scale = Scale(column or "", **{("kind" if name == "scale" else name): value for name, value in fields.items()})
    of_layer = MARKS | {NAMES.get(name, name): options.pop(name) for name in OF_LAYER if name in options}
    layer = MapLayer(source, color=None if column is None and changing is None else scale, times=changing, **of_layer)
    title = None if isinstance(source, str | os.PathLike) else "map"
    first: dict[str, Any] = {"crs": MERCATOR, "size": height or HEIGHT, "max_seconds": DEFAULT_SECONDS}
    first |= {given: value for given, value in options.items() if given in first}
    with renaming({"color": "column"} if changing is None or changing.is_table else OF_STEPS):
        ready = prepared([layer], name=title, **first)
    asked_at = place_of_caller(1)
    warn_at(asked_at, ready.name, ready.notes.listed)
    later = {given: value for given, value in options.items() if given not in ("crs", "size")}
    traits = {name: value for name, value in shown.items() if value is not None}
    conversion = partial(converted, ready, **later, capacity=CAPACITY)
    return MapWidget(ready, scale, conversion, asked_at=asked_at, tooltip=tooltip, has_legend=legend, **traits)


def _times(source: Any, column: Any, times: Any, kind: "type[Times]") -> "Times | None":
    """What changes with time, of the columns and the names of steps, or of a table."""
    names = {str(name) for name in getattr(source, "columns", ())}
    is_column = isinstance(column, str) and column in names  # whatever signs its name has
    several = column is not None and not is_column and (not isinstance(column, str) or kind(column).is_pattern)
    if several:
        if times is not None and kind(times).is_table:
            raise ParameterError("`times` is a table, and `column` names columns of steps; give one of them")
        with renaming(OF_STEPS):
            return kind(column, None if times is None else tuple(times))
    if times is None:
        return None
    if not kind(times).is_table:
        raise ParameterError("`times` names steps; give the `column` of each, or a table of id, time and a value")
    if column is not None:
        raise ParameterError(
            f"`times` has the values, so `column` {column!r} is not shown; leave it out, and set it later"
        )
    return kind(times)
