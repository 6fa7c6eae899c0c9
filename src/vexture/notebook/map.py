"""`vexture.map`: features in the colours of an attribute, in a notebook, with a legend, hovering and picking."""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from vexture.errors import DeviceError

if TYPE_CHECKING:
    from vexture.notebook.map_widget import MapWidget

__all__ = ["map"]


def map(
    source: Any,
    column: str | None = None,
    *,
    tooltip: bool | Sequence[str] = True,
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
        Or several, of which the later ones lie over the earlier ones.
    column : str, optional
        Attribute that colours show.
    tooltip : bool or sequence of str
        Attributes that are told of the feature under the pointer; by default all.
    legend : bool
    width, height, background, view
        As of `vexture.show`.
    **options
        As of `vexture.cartography.convert.convert_map`: ``scale``, ``classes``, ``breaks``, ``palette``, ``crs``,
        ``where``, ``id`` and others.

    Returns
    -------
    MapWidget
        Its traits `column`, `selected`, `hovered`, `picked` and `view` change the picture, and tell what users do.

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
    >>> shown = map(fields, "yield", crs="EPSG:28992")
    >>> shown.selected = "b"
    >>> [entry["label"] for entry in shown.legend["entries"]]
    ['4 – 9', '9 – 9']
    """
    try:
        from vexture.notebook.map_widget import MapWidget
    except ModuleNotFoundError as error:
        raise DeviceError(f"map needs the package {error.name}: pip install 'vexture[notebook,map]'") from None
    from vexture.cartography.convert import convert_map

    named = None if isinstance(source, str | os.PathLike) else "map"
    made = convert_map(source, named, color=column, **options)
    given = {"width": width, "height": height, "background": background, "view": view}
    traits = {name: value for name, value in given.items() if value is not None}
    scale: dict[str, Any] = {
        name: options[name] for name in ("scale", "classes", "breaks", "palette", "no_data") if name in options
    }
    return MapWidget(made, column, tooltip=tooltip, has_legend=legend, scale=scale, **traits)
