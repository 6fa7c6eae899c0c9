"""Conversion of geographic data into the texture of a map, and the table of its attributes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np

from vexture.base.content import about
from vexture.base.deadline import DEFAULT_SECONDS, within
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.layout import MOST_PAINTS
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import Conversion, run
from vexture.drawing.drawing import Drawing, Path
from vexture_geo.maps.coverage import clean_coverage, ranks
from vexture_geo.maps.paths import area_paths
from vexture_geo.maps.place import MERCATOR, unit_of
from vexture_geo.maps.prepare import FILL, INK, MapLayer, Prepared, in_memory, prepare_layers

if TYPE_CHECKING:
    import pyarrow

DEFAULT_SIZE: Final = 1024
"""Pixels of the map's larger side, to which widths in pixels refer."""


@dataclass(frozen=True, eq=False)
class Map:
    """A map.

    Parameters
    ----------
    conversion : Conversion
        Conversion that holds the texture.
    table : pyarrow.Table
        Attributes of all features.
    legends : tuple of dict
        Legend of each coloured layer.
    times : dict, optional
        Only for a map that changes with time, ready for JSON: ``times``, the names of the steps; ``ids`` of features;
        ``colors``, at each step those of all these features; ``legend``.
    """

    conversion: Conversion[Any]
    table: "pyarrow.Table"
    legends: tuple[dict[str, Any], ...]
    times: dict[str, Any] | None = None


def convert_map(
    layers: Sequence[MapLayer],
    *,
    crs: str = MERCATOR,
    snap: float | None = None,
    size: int = DEFAULT_SIZE,
    restyle: bool = True,
    tolerance: float | Literal["auto"] = "auto",
    name: str | None = None,
    max_seconds: float = DEFAULT_SECONDS,
) -> Map:
    """Convert layers, drawn in this order, into one texture whose elements are features.

    Parameters
    ----------
    layers : sequence of MapLayer
    crs : str
        Reference system of the map; Web Mercator by default.
    snap : float, optional
        Largest width of gaps that are closed and distance of borders that become one, as a fraction of the map's larger
        side; 3e-6 by default.
    size : int
        Pixels of the larger side of the map, for widths in pixels.
    restyle : bool
        Keep the ids of features, so that they can be recoloured and picked.
    tolerance, max_seconds
        As in `vexture.convert`.
    name : str, optional
        Name of the map; by default that of the first layer.

    Raises
    ------
    SourceError, ParameterError, LimitError
        Each message is one line that says what to do.
    """
    ready = prepare_layers(layers, crs=crs, size=size, name=name, max_seconds=max_seconds)
    return convert_prepared(ready, snap=snap, restyle=restyle, tolerance=tolerance, max_seconds=max_seconds)


def convert_prepared(
    ready: Prepared,
    *,
    snap: float | None = None,
    restyle: bool = True,
    tolerance: float | Literal["auto"] = "auto",
    max_seconds: float = DEFAULT_SECONDS,
    capacity: int | None = None,
) -> Map:
    """Convert prepared layers; see `convert_map` and `vexture.convert` for parameters and errors."""
    if ready.steps is not None and not restyle:
        raise ParameterError("colours change with `times` only where features can be recoloured; leave `restyle` on")
    with in_memory():
        with within(max_seconds):
            drawing = _drawing(ready, snap)
            _check_count(drawing, restyle)
        parameters = Parameters(
            "faces", restyle=restyle, tolerance=tolerance, capacity=capacity, max_seconds=max_seconds
        )
        done = run(replace(drawing, notes=ready.notes.in_order), parameters)
    return Map(done, ready.table, ready.legends, _times(ready, done.texture.roots))


def _times(ready: Prepared, roots: Sequence[Any]) -> dict[str, Any] | None:
    """Colours of features at each step, without features that lie wholly below others."""
    if ready.steps is None:
        return None
    one, steps = ready.steps
    drawn = {name for root in roots for name in (root.style.names if root.style else ())}
    rows = [row for row, name in enumerate(one.names.tolist()) if name in drawn]
    legend = next(legend for legend in ready.legends if "times" in legend)
    return replace(steps, rgba=steps.rgba[:, rows]).as_json(one.names[rows].tolist(), legend)


def _drawing(ready: Prepared, snap: float | None) -> Drawing:
    """Draw all layers in the unit square."""
    fit, paths = ready.fit, list[Path]()
    for one in ready.layers:
        with about(one.layer.name):
            rank = ranks(one.features, one.layer.order)
        ordered = one.layer.order is not None
        known: dict[str, Any] = {"names": one.names, "unit": unit_of(ready.crs), "is_ordered": ordered}
        rings = clean_coverage(one.features.rings, rank, fit.scale, snap, ready.notes, **known)
        paths += area_paths(rings, one.names, one.colours(FILL), rank, fit)
        border = one.outline
        paths += area_paths(border.rings, np.array([border.name], object), border.rgba, np.zeros(1, np.int64), fit)
        paths += area_paths(one.lines, one.names, one.colours(INK), np.arange(len(one.features)), fit)
        paths += one.symbols.seen_paths(fit) if one.symbols is not None else ()
    if not paths:
        raise SourceError("its features enclose no area; correct them")
    return Drawing(tuple(paths), fit.to_source, ready.name, ready.crs, sides=fit.sides)


def _check_count(drawing: Drawing, restyle: bool) -> None:
    """Raise a `LimitError` if a map to be restyled has more features than it can store colours for."""
    count = len({path.element for path in drawing.paths})
    if restyle and count >= MOST_PAINTS:
        raise LimitError(
            f"it has {count:,} features, and one map that can be restyled holds {MOST_PAINTS - 1:,}; draw colours of "
            "classes only (`restyle` off), fewer features by `where`, or make a pyramid by vexture tiles"
        )
