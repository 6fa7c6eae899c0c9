"""Datasets and arrays of xarray that a program holds open, read like a NetCDF file."""

from typing import Any, Final

import numpy as np

SINCE: Final = "microseconds since 1970-01-01"
"""Units of times that xarray has decoded."""


def is_dataset(source: object) -> bool:
    """Return whether an object is a dataset or an array of xarray, which need not be installed."""
    kinds = {f"{kind.__module__.partition('.')[0]}.{kind.__name__}" for kind in type(source).__mro__}
    return not kinds.isdisjoint({"xarray.Dataset", "xarray.DataArray"})


def dataset_of(source: Any) -> Any:
    """Convert a dataset or array to a dataset whose times are numbers, as in a file; no other values are read."""
    dataset = source if hasattr(source, "data_vars") else source.to_dataset(name=source.name or "depth")
    times = {
        name: coordinate.copy(data=numbers).drop_encoding().assign_attrs(units=SINCE, **calendar)
        for name, coordinate in dataset.coords.items()
        if coordinate.ndim == 1
        for numbers, calendar in _numbers(coordinate)
    }
    return dataset.assign_coords(times)


def _numbers(coordinate: Any) -> list[tuple[Any, dict[str, str]]]:
    """Convert times to numbers, with their calendar; return nothing for a coordinate without times."""
    if coordinate.dtype.kind == "M":
        return [(coordinate.values.astype("datetime64[us]").astype(np.int64), {})]
    first = coordinate.values[0] if coordinate.dtype.kind == "O" and coordinate.size else None
    calendar = getattr(first, "calendar", None)
    if calendar is None:
        return []
    import cftime

    return [(cftime.date2num(coordinate.values, SINCE, calendar=calendar), {"calendar": calendar})]
