"""Colours by an attribute: classes, a continuous ramp, or categories; and the legend that explains them.

The palettes are those of the package cmap. The default ones, viridis and that of Okabe and Ito (Color Universal
Design, 2008), can be told apart by people who are colour-blind.
"""

from dataclasses import dataclass
from math import floor, log10
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from vexture.errors import DeviceError, ParameterError

__all__ = ["KINDS", "MARK", "PLAIN", "Kind", "Legend", "Scale", "colours_of", "values_of"]

Kind = Literal["auto", "quantiles", "equal", "continuous", "categories"]
KINDS: Final = get_args(Kind)

PLAIN: Final = (0.62, 0.68, 0.74, 1.0)
"""Without an attribute, and where there is no value unless another colour is given."""

MARK: Final = (0.15, 0.17, 0.2, 1.0)
"""Of lines and points without a value."""

NO_DATA: Final = (0.85, 0.85, 0.85, 1.0)
RAMP, SET = "viridis", "okabeito"
STEPS: Final = 9
"""Colours that a legend gives of a continuous ramp."""

OTHER: Final = "other"
NOTHING: Final = "no data"
MOST_CLASSES: Final = 64
EVEN: Final = "averaged_inverted_cdf"
"""Quantiles between values, or at them: none lies where no feature is on one side (Hyndman and Fan, 1996)."""

MOST_NAMED: Final = 8
"""Columns that a message lists."""


@dataclass(frozen=True, slots=True)
class Scale:
    """How values become colours.

    Parameters
    ----------
    kind : str
        ``quantiles`` and ``equal`` are classes of as many features, or of as long a range; ``continuous`` a ramp;
        ``categories`` a colour for each value. ``auto`` is quantiles of numbers and categories of texts.
    classes : int
    breaks : tuple of float
        Between classes, ascending; they replace `kind` and `classes`.
    palette : str or None
        A name of cmap, such as ``viridis``, ``cividis``, ``colorbrewer:blues``.
    no_data : tuple of float
        Red, green, blue and opacity where there is no value.
    """

    kind: Kind = "auto"
    classes: int = 5
    breaks: tuple[float, ...] = ()
    palette: str | None = None
    no_data: tuple[float, float, float, float] = NO_DATA

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ParameterError(f"`scale` is {self.kind!r}; it must be one of {', '.join(KINDS)}")
        if not 2 <= self.classes <= MOST_CLASSES:
            raise ParameterError(f"`classes` is {self.classes}; it must be in 2..{MOST_CLASSES}")
        if any(not a < b for a, b in zip(self.breaks, self.breaks[1:], strict=False)):
            raise ParameterError(f"`breaks` {self.breaks} must ascend")


@dataclass(frozen=True, slots=True)
class Legend:
    """What colours mean: pairs of a label and a CSS colour, from low to high; of a ramp at even steps."""

    title: str
    kind: Literal["classes", "continuous", "categories"]
    entries: tuple[tuple[str, str], ...]

    def facts(self) -> dict[str, Any]:
        """For JSON."""
        listed = [{"label": label, "color": color} for label, color in self.entries]
        return {"title": self.title, "kind": self.kind, "entries": listed}


def values_of(table: Any, name: str) -> NDArray[Any]:
    """Values of a column of a table of Arrow, (f,): float64 with NaN for none, or texts with None for none."""
    import pyarrow as pa

    if name not in table.column_names:
        known = ", ".join(map(repr, table.column_names[:MOST_NAMED]))
        raise ParameterError(f"there is no column {name!r}; the columns are {known}")
    values = table.column(name)
    kind = values.type
    if pa.types.is_integer(kind) or pa.types.is_floating(kind) or pa.types.is_decimal(kind):
        return np.asarray(values.cast(pa.float64()).to_numpy(zero_copy_only=False), np.float64)
    return np.array([None if value is None else str(value) for value in values.to_pylist()], object)


def colours_of(values: NDArray[Any], name: str, scale: Scale) -> tuple[NDArray[np.float64], Legend]:
    """Colours (f, 4) of the values of a column (f,), numbers or texts, and their legend.

    Raises
    ------
    ParameterError
        If texts are to be numbers, there is no value at all, or cmap does not know the palette.

    Examples
    --------
    >>> rgba, legend = colours_of(np.array([1.0, 2.0, 3.0, 4.0]), "people", Scale(classes=2))
    >>> [label for label, _ in legend.entries]
    ['1 – 2.5', '2.5 – 4']
    >>> (rgba[0] == rgba[1]).all(), (rgba[1] == rgba[2]).all()
    (np.True_, np.False_)
    """
    is_number = values.dtype.kind == "f"
    kind: str = scale.kind if scale.kind != "auto" else "quantiles" if is_number or scale.breaks else "categories"
    if kind != "categories" and not is_number:
        raise ParameterError(f"the column {name!r} holds texts, which have no order; give `scale` categories")
    known = np.isfinite(values) if is_number else np.array([value is not None for value in values], np.bool_)
    if not known.any():
        raise ParameterError(f"the column {name!r} has no values; choose another")
    rgba = np.tile(np.array(scale.no_data), (len(values), 1))
    if kind == "categories":
        rgba[known], legend = _categories(values[known], name, scale)
    elif kind == "continuous" and not scale.breaks:
        rgba[known], legend = _ramp(values[known], name, scale)
    else:
        rgba[known], legend = _classes(values[known], name, kind, scale)
    if not known.all():
        legend = Legend(legend.title, legend.kind, (*legend.entries, (NOTHING, css(scale.no_data))))
    return rgba, legend


def _categories(values: NDArray[Any], name: str, scale: Scale) -> tuple[NDArray[np.float64], Legend]:
    """The most frequent values first; those for which the palette has no colour share that of no data."""
    texts = np.array([f"{value:g}" if isinstance(value, float) else str(value) for value in values])
    found, number, count = np.unique(texts, return_inverse=True, return_counts=True)
    palette = _palette(scale.palette or SET)
    colours = (
        np.array([color.rgba for color in palette.color_stops.colors], np.float64)
        if palette.category == ("qualitative")
        else palette(np.linspace(0.0, 1.0, max(len(found), 2)))
    )
    if palette.name.lower().endswith(SET):
        colours = np.roll(colours, -1, axis=0)  # black, its first, is for text
    order = np.argsort(-count, kind="stable")
    shown = order[: len(colours)]
    table = np.tile(np.array(scale.no_data), (len(found), 1))
    table[shown] = colours[: len(shown)]
    entries = [(str(found[k]), css(table[k])) for k in shown]
    if len(found) > len(shown):
        entries.append((f"{OTHER} ({len(found) - len(shown)})", css(scale.no_data)))
    return table[number], Legend(name, "categories", tuple(entries))


def _ramp(values: NDArray[np.float64], name: str, scale: Scale) -> tuple[NDArray[np.float64], Legend]:
    low, high = float(values.min()), float(values.max())
    palette = _palette(scale.palette or RAMP)
    rgba = np.asarray(palette((values - low) / ((high - low) or 1.0)), np.float64)
    places = np.linspace(0.0, 1.0, STEPS)
    entries = tuple((written(low + t * (high - low), high - low), css(palette(t))) for t in places)
    return rgba, Legend(name, "continuous", entries)


def _classes(values: NDArray[np.float64], name: str, kind: str, scale: Scale) -> tuple[NDArray[np.float64], Legend]:
    low, high = float(values.min()), float(values.max())
    if scale.breaks:
        inner = np.array(scale.breaks)
    elif kind == "equal":
        inner = np.linspace(low, high, scale.classes + 1)[1:-1]
    else:
        inner = np.unique(np.quantile(values, np.linspace(0.0, 1.0, scale.classes + 1)[1:-1], method=EVEN))
    inner = inner[(inner > low) & (inner <= high)] if not scale.breaks else inner
    number = np.searchsorted(inner, values, side="right")
    colours = np.asarray(_palette(scale.palette or RAMP)(np.linspace(0.0, 1.0, max(len(inner) + 1, 2))), np.float64)
    edges = [min(low, inner[0]) if len(inner) else low, *inner, max(high, inner[-1]) if len(inner) else high]
    labels = [written(edge, edges[-1] - edges[0]) for edge in edges]
    entries = tuple(
        (f"{low} – {high}", css(color)) for low, high, color in zip(labels, labels[1:], colours, strict=False)
    )
    return colours[number], Legend(name, "classes", entries)


def _palette(name: str) -> Any:
    try:
        from cmap import Colormap
    except ModuleNotFoundError:
        raise DeviceError("colours by an attribute need the package cmap: pip install 'vexture[map]'") from None
    try:
        return Colormap(name)
    except (ValueError, KeyError, TypeError):
        raise ParameterError(
            f"`palette` {name[:60]!r} is none that cmap knows; give one such as viridis, cividis or okabeito"
        ) from None


def written(value: float, span: float) -> str:
    """A number with as many decimals as tell apart hundredths of a span.

    Examples
    --------
    >>> written(2.077413, 2.05), written(1234567.8, 2e6), written(0.00123, 0.01)
    ('2.08', '1,234,568', '0.0012')
    """
    decimals = 0 if span <= 0.0 else max(0, 2 - floor(log10(span)))
    text = f"{value:,.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def css(rgba: Any) -> str:
    """A colour as ``#rrggbb``."""
    return "#" + "".join(f"{round(255 * float(part)):02x}" for part in [*rgba][:3])
