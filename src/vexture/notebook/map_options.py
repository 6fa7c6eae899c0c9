"""What `vexture.map` is given, checked before anything is read: a cell that is wrong ends with its line."""

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any, Final

from vexture.errors import ParameterError
from vexture.geo.snap import MOST_SNAP

__all__ = ["attributes", "check_later", "check_looks", "column_of", "unknown"]

EXPLORE: Final = {
    "categorical": "scale='categories'",
    "classification_kwds": "scale",
    "cmap": "palette",
    "color": "fill",
    "k": "classes",
    "marker_type": "symbol",
    "missing_kwds": "no_data",
    "scheme": "scale",
    "vmax": "scale",
    "vmin": "scale",
}
"""What options of GeoPandas' ``explore`` are called here."""


def column_of(given: Any) -> Any:
    """The name of a column, or the names of those of steps: any list of names is one.

    Examples
    --------
    >>> column_of(0), column_of(("y1", "y2"))
    ('0', ['y1', 'y2'])
    """
    if given is None or isinstance(given, str):
        return given
    if not isinstance(given, Iterable):
        return str(given)  # of a GeoDataFrame it may be a number
    kind = type(given).__name__
    if kind == "Series" or getattr(getattr(given, "dtype", None), "kind", "U") in "biufcmM":
        raise ParameterError(f"`column` is values ({kind}); add them as a column of the source, and give its name")
    names = [str(name) for name in given]
    if not names:
        raise ParameterError("`column` is a list of no names; give one for each step of time")
    return names


def unknown(name: str, known: Sequence[str]) -> ParameterError:
    """The error of an option that there is not."""
    if name in EXPLORE:
        return ParameterError(f"map has no option {name!r}; give `{EXPLORE[name]}`")
    return ParameterError(f"map has no option {name!r}; its options are {', '.join(known)}")


def check_looks(looks: Mapping[str, Any], legend: Any) -> None:
    """Raise a `ParameterError` if a size, a background, a view or whether there is a legend cannot be."""
    for name in ("width", "height"):
        value = looks.get(name)
        if value is not None and (isinstance(value, bool) or not _is_whole(value) or value < 1):
            as_wide = ", or None: as wide as its cell" if name == "width" else ""
            raise ParameterError(f"`{name}` is {value!r:.60}; give a whole number of pixels, 1 or more{as_wide}")
    background, view = looks.get("background"), looks.get("view")
    if background is not None and not isinstance(background, str):
        raise ParameterError(f"`background` is {background!r:.60}; give a CSS colour, such as 'white' or 'transparent'")
    if view is not None and not (isinstance(view, Sequence) and len(view) == 4 and all(map(_is_number, view))):
        raise ParameterError(f"`view` is {view!r:.60}; give left, bottom, width and height in the unit square")
    if not isinstance(legend, bool):
        raise ParameterError(f"`legend` is {legend!r:.60}; give True or False")


def check_later(options: Mapping[str, Any]) -> None:
    """Raise a `ParameterError` if what only the conversion needs, beside the cells, cannot be."""
    snap, tolerance = options.get("snap"), options.get("tolerance", "auto")
    if snap is not None and not (_is_number(snap) and 0.0 <= snap <= MOST_SNAP):
        raise ParameterError(f"`snap` is {snap!r:.60}; it must be in 0..{MOST_SNAP}, in parts of the map's size")
    if tolerance != "auto" and not (_is_number(tolerance) and tolerance >= 0.0):
        raise ParameterError(
            f"`tolerance` is {tolerance!r:.60}; give a number of 0 or more in parts of the map, or 'auto'"
        )


def attributes(names: Sequence[str], tooltip: Any) -> list[str] | None:
    """Attributes that a tip tells; None: all.

    Raises a `ParameterError` where `tooltip` is neither true, false, None nor names.
    """
    if tooltip is True:
        return None
    if tooltip is False or tooltip is None:
        return []
    if not isinstance(tooltip, Iterable):
        raise ParameterError(f"`tooltip` is {tooltip!r:.60}; give names of columns, True or False")
    told = [tooltip] if isinstance(tooltip, str) else [str(name) for name in tooltip]
    for name in told:
        if name not in names:
            raise ParameterError(f"`tooltip`: there is no column {name!r}; the columns are {', '.join(names[:8])}")
    return told


def _is_whole(value: Any) -> bool:
    return hasattr(value, "__index__")


def _is_number(value: Any) -> bool:
    try:
        return not isinstance(value, str | bool) and isfinite(value)
    except TypeError:
        return False
