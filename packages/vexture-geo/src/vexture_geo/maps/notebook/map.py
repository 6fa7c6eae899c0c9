"""`vexture.map`: show features coloured by an attribute in a notebook, with a legend, hovering and picking."""

import os
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from vexture.base.content import renaming
from vexture.base.errors import DeviceError
from vexture.base.notes import place_of_caller, warn_at

if TYPE_CHECKING:
    from vexture_geo.maps.notebook.map_widget import MapWidget

CAPACITY: Final = 15
"""Pieces in a leaf: more than by default, because the bytes are sent to the page at once."""


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
        Features, or a file that ``vexture map`` reads.
    column : str or sequence of str, optional
        Attribute that colours show. Several, or a pattern such as ``y*``, are the steps of time.
    times : sequence of str, table, DataFrame or path, optional
        Names of the steps; or a table of ``id``, ``time`` and a value, in place of `column`. With steps, the widget has
        a slider, and its trait `time` is the step.
    tooltip : bool or sequence of str, optional
        Attributes in the tip of the feature under the pointer; by default the one that is shown and some others. False
        or None shows no tip.
    legend : bool
    width, height, background, view
        See `vexture.show`.
    **options
        For colours (`vexture_geo.maps.Scale`): ``scale``, ``palette``, ``classes``, ``no_data``. For layers
        (`MapLayer`): ``layer``, ``where``, ``id``, ``columns``, ``fill``, ``order``, ``stroke``, ``outline``,
        ``outline_width``, ``symbol``, ``symbol_size``, ``source_crs``. For the map (`convert_map`): ``crs``, ``snap``,
        ``size``, ``tolerance``. By default ``id`` is the index of a GeoDataFrame that has its own index; lines are 3px
        wide and dots 8px. A px is a pixel of the widget that shows the whole map (640 wide, if it is as wide as its
        cell), and grows with the map when it is zoomed; with ``size`` it is a pixel of a map of that size.

    Returns
    -------
    MapWidget
        Its traits `column`, `time`, `selected`, `hovered`, `picked` and `view` change the picture and report what users
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
    ['4 – 6', '7 – 9']
    """
    try:
        from vexture_geo.maps.notebook.map_widget import MapWidget
    except ModuleNotFoundError as error:
        raise DeviceError(f"map needs the package {error.name}: pip install 'vexture[notebook,map]'") from None
    from vexture_geo.maps.colours import check_scale
    from vexture_geo.maps.convert import convert_prepared
    from vexture_geo.maps.notebook.map_arguments import (
        OF_STEPS,
        check_source,
        column_of,
        parse_options,
        size_of,
        times_of,
    )
    from vexture_geo.maps.prepare import prepare_layers

    column = column_of(source, column)
    changing = times_of(source, column, times)
    chosen = parse_options(options, column, legend, has_colours=column is not None or changing is not None)
    check_source(source)
    shown = column if isinstance(column, str) and changing is None else None
    scale = chosen.scale_of(shown or "")
    if shown is None and changing is None:
        check_scale(scale)
    layer = chosen.layer_of(source, None if shown is None and changing is None else scale, changing)
    title = None if isinstance(source, str | os.PathLike) else "map"
    size = size_of(chosen.size, width, height)
    with renaming({"color": "column"} if changing is None or changing.is_table else OF_STEPS):
        ready = prepare_layers([layer], name=title, crs=chosen.crs, size=size, max_seconds=chosen.max_seconds)
    asked_at = place_of_caller(1)
    warn_at(asked_at, ready.name, ready.notes.in_order)
    asked = {"width": width, "height": height, "background": background, "view": view}
    traits = {name: value for name, value in asked.items() if value is not None}
    conversion = partial(
        convert_prepared,
        ready,
        snap=chosen.snap,
        tolerance=chosen.tolerance,
        max_seconds=chosen.max_seconds,
        capacity=CAPACITY,
    )
    return MapWidget(ready, scale, conversion, asked_at=asked_at, tooltip=tooltip, has_legend=legend, **traits)
