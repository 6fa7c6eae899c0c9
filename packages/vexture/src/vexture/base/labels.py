"""Labels of features, times and categories, made from their values."""

from collections.abc import Iterable
from typing import Any, Final

import numpy as np

MIDNIGHT: Final = " 00:00:00"


def texts_of(values: Iterable[Any]) -> list[str | None]:
    """Write values as texts: whole numbers without decimals, days without a time; None for a missing value or NaN.

    Examples
    --------
    >>> texts_of([2.0, 0.5, None, float("nan"), "a"])
    ['2', '0.5', None, None, 'a']
    """
    texts = [None if value is None or value != value else _text(value) for value in values]
    if all(text is None or text.endswith(MIDNIGHT) for text in texts):
        return [None if text is None else text.removesuffix(MIDNIGHT) for text in texts]
    return texts


def _text(value: Any) -> str:
    return str(int(value) if isinstance(value, float | np.floating) and value.is_integer() else value)
