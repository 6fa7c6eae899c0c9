"""Data that a program holds open: datasets and arrays of xarray, read as a NetCDF file is."""

from typing import Any, Final

import numpy as np

SINCE: Final = "microseconds since 1970-01-01"
"""Units of times that xarray has decoded."""


def is_dataset(source: object) -> bool:
    """Whether something is a dataset or an array of xarray, which need not be installed."""
    kinds = {f"{kind.__module__.partition('.')[0]}.{kind.__name__}" for kind in type(source).__mro__}
    return not kinds.isdisjoint({"xarray.Dataset", "xarray.DataArray"})


def dataset_of(source: Any) -> Any:
    """Dataset of a dataset or array, with its times as numbers, as they are in a file; nothing else of it is read."""
    dataset = source if hasattr(source, "data_vars") else source.to_dataset(name=source.name or "depth")
    times = {
        name: coordinate.copy(data=numbers).drop_encoding().assign_attrs(units=SINCE, **calendar)
        for name, coordinate in dataset.coords.items()
        if coordinate.ndim == 1
        for numbers, calendar in _numbers(coordinate)
    }
    return dataset.assign_coords(times)


def _numbers(coordinate: Any) -> list[tuple[Any, dict[str, str]]]:
    """Times as numbers, and their calendar; nothing of a coordinate that holds no times."""
    if coordinate.dtype.kind == "M":
        return [(coordinate.values.astype("datetime64[us]").astype(np.int64), {})]
    first = coordinate.values[0] if coordinate.dtype.kind == "O" and coordinate.size else None
    calendar = getattr(first, "calendar", None)
    if calendar is None:
        return []
    import cftime

    return [(cftime.date2num(coordinate.values, SINCE, calendar=calendar), {"calendar": calendar})]
