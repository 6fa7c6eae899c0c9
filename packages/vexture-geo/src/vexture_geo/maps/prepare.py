"""Layers of a map, ready for conversion: in the map's reference system, coloured, and fitted into a box."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import about, renaming
from vexture.base.deadline import within
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture_geo.base.crs import UNPLACED, choose_crs, gis_packages, same_system
from vexture_geo.base.rings import Rings
from vexture_geo.maps.colours import Scale, colours_of, rgba_of
from vexture_geo.maps.edges import move_together
from vexture_geo.maps.marks import outlines, strokes, width_of, widths_at
from vexture_geo.maps.paths import MapFit
from vexture_geo.maps.place import MERCATOR, place_features
from vexture_geo.maps.symbols import Symbols
from vexture_geo.maps.times import Steps, Times, colour_steps, with_steps
from vexture_geo.vector.features import ID, Features, read_features
from vexture_geo.vector.tables import with_legends
from vexture_geo.vector.vectors import is_memory

if TYPE_CHECKING:
    import pyarrow

FILL, INK, DOT = "#c3cdd6", "#404a54", "#d55e00"
"""Default colours of areas, lines and points."""

Box: TypeAlias = tuple[float, float]

NO_LINES: Final = Rings(np.empty((0, 2)), np.empty(0, np.intp), np.empty(0, np.intp), str, np.empty(0, np.intp))


@dataclass(frozen=True)
class MapLayer:
    """Source of a map, with the selection and the style of its features.

    Parameters
    ----------
    source : path, bytes or GeoDataFrame
    layer, where, id, columns
        As in `vexture_geo.vector.features.read_features`.
    source_crs : str, optional
        Reference system of the source, if it names none.
    color : Scale or str, optional
        Colours by an attribute; a text is the column of a scale with defaults.
    times : Times, optional
        Values that colours show at each step of time; the texture itself has the colours of the first step.
    fill : str, optional
        One CSS colour for all features.
    order : str, optional
        Column that orders overlapping polygons, the greatest on top; by default the smaller are on top.
    stroke : str
        Width of lines: ``500m`` on the ground, or ``1.5px`` of a map of the stated size.
    outline : str, optional
        CSS colour of the borders of polygons. Each is drawn once, above the polygons; the edge of the world is not.
    outline_width : str
        Width of borders, given as for lines.
    symbol : Drawing, optional
        Drawing at each point; a dot by default.
    symbol_size : str
        Width of symbols, given as for lines.
    """

    source: Any
    layer: str | None = None
    where: str | None = None
    source_crs: str | None = None
    id: str | None = None
    columns: tuple[str, ...] | None = None
    color: Scale | None = None
    times: Times | None = None
    fill: str | None = None
    order: str | None = None
    stroke: str = "1px"
    outline: str | None = None
    outline_width: str = "1px"
    symbol: Drawing | None = None
    symbol_size: str = "8px"

    def __post_init__(self) -> None:
        if isinstance(self.color, str):
            object.__setattr__(self, "color", Scale(self.color))
        elif not isinstance(self.color, Scale | None):
            raise ParameterError(f"`color` is a {type(self.color).__name__}; give a Scale, or the name of a column")
        if self.fill is not None and (self.color is not None or self.times is not None):
            raise ParameterError("colours by an attribute and `fill` exclude each other; leave one out")
        if not isinstance(self.symbol, Drawing | None):
            raise ParameterError(f"`symbol` is {self.symbol!r}; give a drawing, such as vexture.read('symbol.svg')")
        for name in ("id", "order"):  # columns of a GeoDataFrame may be numbers
            if isinstance(value := getattr(self, name), int):
                object.__setattr__(self, name, str(value))
        if self.columns is not None:
            columns = (self.columns,) if isinstance(self.columns, str | int) else self.columns
            object.__setattr__(self, "columns", tuple(str(column) for column in columns))

    @property
    def name(self) -> str:
        """Name of the layer, or else of the file."""
        named = isinstance(self.source, str | FilePath)
        return self.layer or (FilePath(self.source).name.partition(".")[0] if named else "map")


@dataclass(frozen=True, eq=False)
class LayerOutline:
    """Area of the borders of a layer, the name of its element, and its colour, (1, 4)."""

    rings: Rings
    name: str = ""
    rgba: NDArray[np.float64] = field(default_factory=lambda: np.zeros((1, 4)))


NO_OUTLINE: Final = LayerOutline(NO_LINES)


@dataclass(frozen=True, eq=False)
class PaintedLayer:
    """Features in the map's reference system, with their names in the texture, their colours, and areas of marks."""

    layer: MapLayer
    label: str
    """Unique name of the layer."""

    features: Features
    names: NDArray[Any]
    rgba: NDArray[np.float64] | None
    steps: Steps | None
    outline: LayerOutline
    lines: Rings
    symbols: Symbols | None

    def colours(self, default: str) -> NDArray[np.float64]:
        """Colour and opacity of each feature, (f, 4): by attribute, or one for all; `default` is a CSS colour."""
        if self.rgba is not None:
            return self.rgba
        return np.tile(rgba_of(self.layer.fill or default, "fill"), (len(self.features), 1))


@dataclass(frozen=True, eq=False)
class Prepared:
    """Layers of a map, ready to be drawn or converted.

    Parameters
    ----------
    layers : tuple of PaintedLayer
        In drawing order.
    fit : MapFit
        Place of the map's box in the unit square.
    legends : tuple of dict
    table : pyarrow.Table
        Attributes of all features.
    crs, name : str
    notes : Notes
        Notes on reading; the conversion adds to them.
    """

    layers: tuple[PaintedLayer, ...]
    fit: MapFit
    legends: tuple[dict[str, Any], ...]
    table: "pyarrow.Table"
    crs: str
    name: str
    notes: Notes

    @property
    def steps(self) -> tuple[PaintedLayer, Steps] | None:
        """The layer that changes with time, and its colours at each step."""
        return next(((one, one.steps) for one in self.layers if one.steps is not None), None)


@contextmanager
def in_memory() -> Iterator[None]:
    """Raise an error that says what to do if there is not enough memory."""
    import shapely

    try:
        yield
    except (MemoryError, shapely.errors.GEOSException) as error:
        if not (isinstance(error, MemoryError) or is_memory(error)):
            raise
        raise LimitError(
            "the map needs more memory than there is; choose fewer features by `where`, fewer `columns`, or make a "
            "pyramid by vexture tiles, which reads them in parts"
        ) from None


@gis_packages()
def prepare_layers(
    layers: Sequence[MapLayer], *, crs: str, size: int | Box, name: str | None, max_seconds: float
) -> Prepared:
    """Read layers; see `vexture_geo.maps.convert_map` for parameters and errors.

    `size` may also be the width and height in pixels of a box into which the map is fitted.
    """
    if not isinstance(layers, Sequence) or not all(isinstance(layer, MapLayer) for layer in layers):
        raise ParameterError("`layers` is no list of layers; give one, such as [MapLayer(source)]")
    if not layers:
        raise ParameterError("a map of no sources; give at least one")
    if not isinstance(size, tuple) and (not isinstance(size, int) or size < 1):
        raise ParameterError(f"`size` is {size!r}; it must be a whole number of pixels, 1 or more")
    notes = Notes()
    layers, crs = _planar(layers, choose_crs(crs, None), notes)
    with within(max_seconds), in_memory():
        placed_there = move_together([_read(layer, crs, notes) for layer in layers], crs)
        painted, legends = _colour_layers(list(zip(layers, placed_there, strict=True)), notes)
        marked, fit = _add_marks(painted, crs, size, notes)
    table = _table(painted, legends)
    return Prepared(marked, fit, tuple(legends), table, crs, name or layers[0].name, notes)


def _planar(layers: Sequence[MapLayer], crs: str, notes: Notes) -> tuple[Sequence[MapLayer], str]:
    """Return layers and the map's system: a plane, as GeoPandas plots, if no GeoDataFrame names its own."""
    frames = [layer.source for layer in layers if layer.source_crs is None and hasattr(layer.source, "geometry")]
    if len(frames) < len(layers) or not same_system(crs, MERCATOR):
        return layers, crs
    if any(getattr(frame, "crs", None) is not None for frame in frames):
        return layers, crs
    remedy = "name it by `source_crs`, or set it by set_crs"
    notes.remark(f"it names no reference system, so it is drawn as a plane; {remedy}")
    return [replace(layer, source_crs=UNPLACED) for layer in layers], UNPLACED


def _read(layer: MapLayer, crs: str, notes: Notes) -> Features:
    """Read the features of a layer in the map's reference system."""
    with about(str(layer.source) if isinstance(layer.source, str | FilePath) else layer.name):
        options = {"layer": layer.layer, "where": layer.where, "id": layer.id, "columns": _columns(layer)}
        with renaming({"crs": "source_crs"}):
            features = read_features(layer.source, crs=layer.source_crs, notes=notes, **options)  # type: ignore[arg-type]
        if not len(features):
            reason = f"no feature meets `where` {layer.where!r}" if layer.where else "it has no features"
            raise SourceError(f"{reason}; there is nothing to draw")
        if not (len(features.rings.ends) or len(features.lines.ends) or len(features.points.points)):
            raise SourceError("none of its features has a geometry that can be drawn; there is nothing to draw")
        return place_features(features, crs, notes)


def _columns(layer: MapLayer) -> tuple[str, ...] | None:
    """Columns that a layer keeps or needs; None, for all, if a pattern chooses some."""
    if layer.columns is None or (layer.times is not None and layer.times.is_pattern):
        return None
    stepped = layer.times is not None
    needed = (layer.color.column if layer.color and not stepped else None, layer.order)
    steps = layer.times.column_names() if layer.times is not None else ()
    own = (name for name in needed if name not in (None, ID))  # ids are always read
    return tuple(dict.fromkeys([*layer.columns, *steps, *own]))


def _colour_layers(
    read: list[tuple[MapLayer, Features]], notes: Notes
) -> tuple[list[PaintedLayer], list[dict[str, Any]]]:
    """Name and colour all features; ids that two layers share are prefixed with the layer's name."""
    if sum(layer.times is not None for layer, _ in read) > 1:
        raise ParameterError("`times` is given for several sources; give it for one, and '' for the others")
    every = np.concatenate([features.ids for _, features in read])
    clash = len(set(every.tolist())) < len(every)
    if clash:
        notes.remark("layers share ids, so elements are named LAYER:ID")
    painted, legends = [], []
    for label, (layer, features) in zip(_labels([layer for layer, _ in read]), read, strict=True):
        names = np.array([f"{label}:{one}" for one in features.ids], object) if clash else features.ids
        rgba, steps, legend = None, None, None
        with about(layer.name):
            if layer.times is not None:
                features, steps, legend = _add_steps(layer, layer.times, features, notes)
                rgba = steps.rgba[0]
            elif layer.color is not None:
                features.refuse_numbers(layer.color.column)
                rgba, legend = colours_of(features.table, layer.color, notes)
        if legend is not None:
            legends.append({"layer": label, **legend})
        painted.append(PaintedLayer(layer, label, features, names, rgba, steps, NO_OUTLINE, NO_LINES, None))
    return painted, legends


def _labels(layers: Sequence[MapLayer]) -> list[str]:
    """Names of layers; a repeated name gets a number."""
    labels = list[str]()
    for layer in layers:
        label, number = layer.name, 1
        while label in labels:
            number += 1
            label = f"{layer.name}#{number}"
        labels.append(label)
    return labels


def _add_steps(
    layer: MapLayer, times: Times, features: Features, notes: Notes
) -> tuple[Features, Steps, dict[str, Any]]:
    """Add the values of all steps to features; return them with their colours at each step and the legend."""
    features, columns, labels, title = with_steps(features, times, notes)
    scale = replace(layer.color or Scale(""), column=title)
    steps, legend = colour_steps(features.table, columns, labels, scale, notes)
    if layer.columns is not None and times.is_pattern:
        kept = {"id", *layer.columns, *columns, layer.order, layer.id}
        features = replace(features, table=features.table.select([n for n in features.table.column_names if n in kept]))
    return features, steps, legend


def _add_marks(
    painted: list[PaintedLayer], crs: str, size: int | Box, notes: Notes
) -> tuple[tuple[PaintedLayer, ...], MapFit]:
    """Add the areas of lines and points to layers, and fit the box of all."""
    boxes = [np.concatenate([f.rings.points, f.lines.points, f.points.points]) for f in (p.features for p in painted)]
    every = np.concatenate(boxes)
    if not len(every):
        raise SourceError("nothing of it lies on the map; choose another `crs`")
    reach = [every.min(axis=0), every.max(axis=0)]
    box = size if isinstance(size, tuple) else (size, size)
    pixel = float(((reach[1] - reach[0]) / box).max()) or 1.0 / max(box)
    marked, taken = [], {str(name) for one in painted for name in one.names}
    for one in painted:
        outline = _outline(one, len(painted) > 1, taken, crs, pixel, notes)
        taken.add(outline.name)
        lines = strokes(one.features.lines, width_of(one.layer.stroke, "stroke"), crs, pixel)
        symbols = _symbols(one, crs, pixel)
        own = [lines.points, outline.rings.points, symbols.corners if symbols is not None else NO_LINES.points]
        reach += [corner for points in own if len(points) for corner in (points.min(axis=0), points.max(axis=0))]
        marked.append(replace(one, outline=outline, lines=lines, symbols=symbols))
    low, high = np.min(reach, axis=0), np.max(reach, axis=0)
    if not (high > low).all():
        raise SourceError("it has no area on the map; give polygons, or points that differ")
    return tuple(marked), MapFit((*map(float, low), *map(float, high)))  # type: ignore[arg-type]


def _outline(
    one: PaintedLayer, is_named: bool, used_names: set[str], crs: str, pixel: float, notes: Notes
) -> LayerOutline:
    """Make the outline of a layer; no feature has the name of its element."""
    layer, rings = one.layer, one.features.rings
    width = width_of(layer.outline_width, "outline_width")
    if layer.outline is None or not len(rings.ends):
        return NO_OUTLINE
    name = f"{one.label}:outline" if is_named else "outline"
    while name in used_names:
        notes.remark(f"a feature is named {name!r} already, so the element of outlines is '{name}_'")
        name += "_"
    return LayerOutline(outlines(rings, width, crs, pixel), name, rgba_of(layer.outline, "outline")[None])


def _symbols(one: PaintedLayer, crs: str, pixel: float) -> Symbols | None:
    """Make the symbols of a layer's points, if it has any."""
    points, layer = one.features.points, one.layer
    if not len(points.points):
        return None
    sizes = widths_at(points.points, width_of(layer.symbol_size, "symbol_size"), crs, pixel)
    names = [str(one.names[feature]) for feature in points.feature.tolist()]
    own_colours = layer.symbol is not None and one.rgba is None and layer.fill is None
    colours = one.colours(DOT)[points.feature].tolist()
    known = {rgba: None if own_colours else Paint(rgba[:3], rgba[3]) for rgba in set(map(tuple, colours))}
    paints = [known[tuple(rgba)] for rgba in colours]
    return Symbols(layer.symbol or _dot(), points.points, sizes, names, paints)


def _dot() -> Drawing:
    """Make a round symbol that fills the unit square."""
    from vexture.conversion.reading import read

    return read(b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></svg>')


def _table(painted: list[PaintedLayer], legends: list[dict[str, Any]]) -> "pyarrow.Table":
    """Attributes of all layers: `id` names the element in the texture; with several layers, `layer` is its name."""
    import pyarrow as pa

    tables = []
    for one in painted:
        table = one.features.table.set_column(0, "id", pa.array(one.names.tolist(), pa.string()))
        if len(painted) > 1:
            names = [f"{name}_" if name == "layer" else name for name in table.column_names]
            table = table.rename_columns(names)
            table = table.add_column(1, "layer", pa.array([one.label] * len(table), pa.string()))
        tables.append(table)
    try:
        joined = pa.concat_tables(tables, promote_options="permissive")
    except (pa.ArrowInvalid, pa.ArrowTypeError) as error:
        raise ParameterError(f"the layers' columns differ in type ({error}); choose others by `columns`") from None
    return joined.cast(with_legends(joined.schema, legends))
