"""Colours of features by an attribute: classes, a continuous scale or categories; and their legend."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, ParameterError
from vexture.base.labels import texts_of
from vexture.base.notes import Notes
from vexture_geo.maps.measures import BREAKS, Measure, breaks_of, distinct, measure_of

if TYPE_CHECKING:
    import pyarrow

DEFAULT_CLASSES: Final = 5
MOST_CLASSES: Final = 64

NO_DATA: Final = "#d9d9d9"
SEQUENTIAL: Final = "viridis"
QUALITATIVE: Final = "okabeito:okabeito"
"""Default palettes, whose colours can be told apart with any kind of colour blindness."""

FURTHER: Final = (
    *("#552200", "#0000aa", "#884444", "#9966ff", "#aabb99"),
    *("#7700ee", "#332255", "#bb1188", "#aaffaa"),
)
"""Colours after the seven of that palette, for more categories. With any kind of colour blindness, no two of all these
are closer to each other than two of the seven."""

OTHER: Final = "other"
GREYS: Final = ("#777777", "#a8a8a8", "#404040")
"""Greys for categories without a colour of their own: the first that differs from the whole palette is used."""

STOPS: Final = 9
"""Colours in the legend of a continuous scale."""

RANGE: Final = " \N{EN DASH} "
"""Separator between the ends of a class."""

NAMED: Final = ("quantiles", "equal", "continuous")
"""Scales of numbers and of times."""

KINDS: Final = f"give {', '.join(NAMED)}, categories or {BREAKS}"

TRIED: Final = (0.0, 1.0, None)
"""Values that suit any scale of numbers."""

Rgba = NDArray[np.float64]


@dataclass(frozen=True)
class Scale:
    """Colours of a column's values.

    Parameters
    ----------
    column : str
    kind : str
        ``quantiles`` or ``equal`` (classes), ``continuous``, ``categories``, or the inner breaks of classes, such as
        ``10,20,50``, ``2001-01-01,2011-01-01`` or a list. ``auto`` means ``categories`` for text, truth values, and
        dates or times with no more distinct values than classes; it means ``quantiles`` for numbers and for more dates.
        Categories have the order of the column, such as a `pandas.Categorical`, or else they rise.
    palette : str, optional
        Name of a palette of cmap; colour-blind-safe by default.
    classes : int
    no_data : str
        CSS colour of features without a value.
    """

    column: str
    kind: str = "auto"
    palette: str | None = None
    classes: int = DEFAULT_CLASSES
    no_data: str = NO_DATA

    def __post_init__(self) -> None:
        if isinstance(self.kind, Sequence | np.ndarray) and not isinstance(self.kind, str):
            object.__setattr__(self, "kind", ",".join(str(each) for each in self.kind))
        if not isinstance(self.kind, str) or not self.kind:
            raise ParameterError(f"`scale` is {self.kind!r}; {KINDS}")
        whole = str(self.classes).strip().removesuffix(".0")
        if not whole.isdecimal() or not 2 <= int(whole) <= MOST_CLASSES:
            raise ParameterError(f"`classes` is {self.classes!r}; it must be in 2..{MOST_CLASSES}")
        object.__setattr__(self, "classes", int(whole))
        object.__setattr__(self, "column", str(self.column))


def colours_of(table: "pyarrow.Table", scale: Scale, notes: Notes) -> tuple[Rgba, dict[str, Any]]:
    """Colour of each row, (f, 4), not premultiplied, and the legend, ready for JSON."""
    if scale.column not in table.column_names:
        raise ParameterError(
            f"it has no column {scale.column!r} for `color`; there are: {', '.join(table.column_names)}"
        )
    column = table.column(scale.column)
    measure, kind = measure_of(column), scale.kind
    if kind == "auto":
        few = measure is None or (measure.unit != "" and len(np.unique(_known(measure))) <= scale.classes)
        kind = "categories" if few else "quantiles"
    if kind == "categories":
        values = column.to_pylist()
        names = texts_of(values)
        rgba, entries = _categories(names, _order(column, dict(zip(names, values, strict=True))), scale, notes)
    else:
        breaks = None if kind in NAMED else breaks_of(kind, None if measure is None else measure.unit)
        if measure is None and column.null_count < len(column):
            raise ParameterError(f"`color` {scale.column!r} holds {column.type}, not numbers; give `scale` categories")
        measure = measure or Measure(np.full(len(column), np.nan))
        infinite = int(np.isinf(measure.values).sum())
        notes.remark(f"a value of {scale.column!r} is infinite, and has the colour of no data", infinite)
        if not len(_known(measure)):
            rgba, entries = np.full((len(column), 4), np.nan), []
        elif kind == "continuous":
            rgba, entries = _continuous(measure, scale)
        else:
            rgba, entries = _classes(measure, kind, breaks, scale)
    missing = np.isnan(rgba[:, 0])
    if len(missing) and missing.all():
        notes.remark(f"no feature has a value in {scale.column!r}, so all have the colour of no data")
    rgba[missing] = rgba_of(scale.no_data, "no_data")
    legend: dict[str, Any] = {"column": scale.column, "scale": "breaks" if kind[:1] in "-+.0123456789" else kind}
    legend["entries"] = entries
    if missing.any():
        legend["no_data"] = {"color": hex_of(rgba_of(scale.no_data, "no_data")), "count": int(missing.sum())}
    return rgba, legend


def check_scale(scale: Scale) -> None:
    """Raise a `ParameterError` if no column could have this scale; the column need not be known yet."""
    import pyarrow as pa

    if scale.kind not in ("auto", "categories", *NAMED) and len(breaks_of(scale.kind)):
        scale = replace(scale, kind="quantiles")
    colours_of(pa.table({scale.column: TRIED}), scale, Notes())


def _known(measure: Measure) -> NDArray[np.float64]:
    return measure.values[np.isfinite(measure.values)]


def rgba_of(text: str, parameter: str) -> Rgba:
    """Parse a CSS colour."""
    from vexture.drawing.colors import parse_color

    found = parse_color(text) if isinstance(text, str) else None
    if found is None or isinstance(found, str):
        raise ParameterError(f"`{parameter}` is {text!r}; give a CSS colour, such as white or #f4f1e8")
    return np.array([*found.rgb, found.alpha])


def hex_of(rgba: Rgba) -> str:
    """Format a colour as CSS."""
    from vexture.drawing.paint import Paint

    red, green, blue, opacity = (float(part) for part in rgba)
    return Paint((red, green, blue), opacity).hex


def _palette(name: str | None, default: str) -> Any:
    try:
        import cmap
    except ModuleNotFoundError:
        raise DeviceError("palettes need the package cmap: pip install 'vexture[map]'") from None
    try:
        return cmap.Colormap(_full(name or default, cmap.Colormap.catalog()))
    except (ValueError, TypeError):
        raise ParameterError(
            f"the `palette` {name!r} is unknown; choose one of cmap, such as viridis or tab10"
        ) from None


def _full(name: Any, catalog: Any) -> Any:
    """Full name of a palette, because cmap warns about a short name that several palettes have."""
    stem = str(name).removesuffix("_r")
    try:
        return catalog.resolve(stem) + str(name)[len(stem) :]
    except KeyError:
        return name


def _sample_palette(palette: Any, at: NDArray[np.float64]) -> Rgba:
    return np.clip(np.asarray(palette(at), np.float64).reshape(-1, 4), 0.0, 1.0)


def _classes(
    measure: Measure, kind: str, breaks: NDArray[np.float64] | None, scale: Scale
) -> tuple[Rgba, list[dict[str, Any]]]:
    """Colour classes, each of which includes its lower break and excludes its upper one."""
    values, known = measure.values, _known(measure)
    are_whole = breaks is None and measure.are_whole
    breaks = distinct(_found_breaks(measure, kind, scale.classes) if breaks is None else breaks)
    colours = _sample_palette(_palette(scale.palette, SEQUENTIAL), np.linspace(0.0, 1.0, len(breaks) + 1))
    number = np.searchsorted(breaks, values, side="right")
    rgba = colours[number]
    rgba[~np.isfinite(values)] = np.nan
    edges = [float(min(known.min(), breaks[0])) if len(breaks) else float(known.min()), *breaks.tolist()]
    edges.append(float(max(known.max(), edges[-1])))
    counts = np.bincount(number[np.isfinite(values)], minlength=len(colours))
    labels = _of_whole(measure, edges) if are_whole else _ranges(measure, edges, counts)
    told = [measure.json_value(edge) for edge in edges]
    entries = [
        {"color": hex_of(colour), "label": label, "from": low, "to": high, "count": int(count)}
        for colour, label, (low, high), count in zip(colours, labels, pairwise(told), counts, strict=True)
    ]
    return rgba, entries


def _found_breaks(measure: Measure, kind: str, classes: int) -> NDArray[np.float64]:
    """Inner breaks of quantiles without empty classes, or of equal steps; whole numbers get whole breaks."""
    parts, known = np.linspace(0.0, 1.0, classes + 1)[1:-1], _known(measure)
    low, high = known.min(), known.max()
    breaks = np.quantile(known, parts) if kind == "quantiles" else low + (high - low) * parts
    above = known[known > low]
    if kind == "quantiles" and len(above):  # many that are equal to the least are a class of their own
        breaks = np.where(breaks <= low, above.min(), breaks)
    breaks = np.unique(np.ceil(breaks.round(6)) if measure.are_whole else breaks)
    breaks = distinct(np.append(low, breaks))[1:]
    if kind == "quantiles":
        _, first = np.unique(np.searchsorted(np.sort(known), breaks), return_index=True)
        breaks = breaks[first]
    return breaks


def _of_whole(measure: Measure, edges: list[float]) -> list[str]:
    """Labels of classes of whole numbers: only the last one includes its upper break."""
    lows, highs = edges[:-1], [*(above - 1 for above in edges[1:-1]), edges[-1]]
    ends = measure.texts([*lows, *highs])
    pairs = zip(lows, highs, ends[: len(lows)], ends[len(lows) :], strict=True)
    return [first if low >= high else f"{first}{RANGE}{last}" for low, high, first, last in pairs]


def _ranges(measure: Measure, edges: list[float], counts: NDArray[np.int64]) -> list[str]:
    """Labels of classes; a first or last class without data names only one end."""
    pairs = list(pairwise(measure.texts(edges)))
    labels = [low if low == high else f"{low}{RANGE}{high}" for low, high in pairs]
    for place, sign in ((0, "<"), (-1, ">=")):
        low, high = pairs[place]
        if low == high and not counts[place]:
            labels[place] = f"{sign} {low}"
    return labels


def _continuous(measure: Measure, scale: Scale) -> tuple[Rgba, list[dict[str, Any]]]:
    values, known = measure.values, _known(measure)
    low, high = float(known.min()), float(known.max())
    palette = _palette(scale.palette, SEQUENTIAL)
    part = np.where(np.isfinite(values), (values - low) / ((high - low) or 1.0), 0.0)
    rgba = _sample_palette(palette, part)
    rgba[~np.isfinite(values)] = np.nan
    at = np.linspace(low, high, STOPS)
    held: list[float] = (np.unique(np.rint(at)) if measure.are_whole else at).tolist()
    shown = {label: at for at, label in reversed(list(enumerate(measure.texts(held))))}  # the first of each
    colours = _sample_palette(palette, (np.array(held) - low) / ((high - low) or 1.0))
    return rgba, [
        {"color": hex_of(colours[at]), "label": label, "value": measure.json_value(held[at])}
        for label, at in sorted(shown.items(), key=lambda item: item[1])
    ]


def _order(column: "pyarrow.ChunkedArray", values: dict[str | None, Any]) -> list[str]:
    """Names of categories in the order of a dictionary, or else rising as numbers, days or texts."""
    import pyarrow as pa

    if pa.types.is_dictionary(column.type):
        chunks = column.unify_dictionaries().chunks
        return [name for name in texts_of(chunks[0].dictionary.to_pylist()) if name is not None] if chunks else []
    found = {name: value for name, value in values.items() if name is not None}
    try:
        return sorted(found, key=found.__getitem__)
    except TypeError:  # lists of several kinds of things
        return sorted(found)


def _categories(
    values: list[str | None], order: list[str], scale: Scale, notes: Notes
) -> tuple[Rgba, list[dict[str, Any]]]:
    """Colour categories in their order; if there are too many, the less common ones share a grey."""
    palette = _palette(scale.palette, QUALITATIVE)
    stops = np.array([tuple(color.rgba) for color in palette.iter_colors()], np.float64)
    if scale.palette is None:
        further = np.array([rgba_of(colour, "palette") for colour in FURTHER])
        stops = np.concatenate([stops[1:], further])  # black is for lines and words
    counts = Counter(value for value in values if value is not None)
    own = [value for value in order if value in counts]
    if palette.interpolation == "linear":
        stops = _sample_palette(palette, np.linspace(0.0, 1.0, max(len(own), 1)))
    if rare := max(len(own) - len(stops), 0):
        notes.remark(
            f"{len(own)} categories of {scale.column!r}, but {len(stops)} colours: the {rare} least common ones share "
            "a grey; give a larger `palette`"
        )
        common = set(sorted(own, key=lambda value: -counts[value])[: len(stops)])
        own = [value for value in own if value in common]
    place = {value: number for number, value in enumerate(own)}
    grey = _grey(stops)
    none = np.full(4, np.nan)
    rgba = np.array([none if v is None else stops[place[v]] if v in place else grey for v in values]).reshape(-1, 4)
    entries = [{"color": hex_of(stops[k]), "label": value, "count": counts[value]} for k, value in enumerate(own)]
    if rare:
        rest = counts.total() - sum(counts[value] for value in own)
        label = f"{rare} more" if OTHER in place else OTHER
        entries.append({"color": hex_of(grey), "label": label, "count": rest})
    return rgba, entries


def _grey(stops: Rgba) -> Rgba:
    """Choose a grey that differs from all of some colours."""
    greys = [rgba_of(grey, "palette") for grey in GREYS]
    return max(greys, key=lambda grey: min(float(np.linalg.norm((stops - grey)[:, :3], axis=1).min()), 0.2))
