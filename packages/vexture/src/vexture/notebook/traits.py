"""Traits of widgets that take what users write, such as a number of numpy, and refuse other values in a line."""

from collections.abc import Mapping
from typing import Any, ClassVar, Final

import numpy as np
import traitlets

from vexture.base.errors import ParameterError, shortened
from vexture.base.labels import texts_of

__all__ = ["Background", "Choice", "Colours", "Label", "Number", "Pixels", "Rectangle", "pixels", "told"]

PIXELS: Final = "give a whole number of pixels, 1 or more"
LONGEST: Final = 60
"""Letters of a value in a message."""


def told(value: Any) -> str:
    """A value as a message has it; of many values, their type only.

    Examples
    --------
    >>> told("100%"), told(np.arange(9))
    ("'100%'", 'a ndarray')
    """
    if getattr(value, "shape", ()):
        return f"a {type(value).__name__}"
    return shortened(" ".join(repr(value).split()), LONGEST)


def pixels(name: str, value: Any) -> int:
    """A whole number of pixels.

    Examples
    --------
    >>> pixels("width", np.int64(300))
    300
    >>> pixels("width", "100%")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `width` is '100%'; give a whole number of pixels, 1 or more
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        raise ParameterError(f"`{name}` is {told(value)}; {PIXELS}")
    return int(value)


def text_of(label: Any) -> str:
    """A label as the text by which a feature is known.

    Examples
    --------
    >>> text_of(11), text_of(np.float64(11.0)), text_of("a")
    ('11', '11', 'a')
    """
    return str(texts_of([label])[0])


class _Told(traitlets.TraitType[Any, Any]):
    """A trait that says what to give."""

    remedy: ClassVar[str]

    def _coerced(self, value: Any) -> Any:
        """The value as the trait has it, if it is of that kind."""
        return value

    def validate(self, obj: Any, value: Any) -> Any:
        try:
            return super().validate(obj, self._coerced(value))  # type: ignore[misc]
        except (traitlets.TraitError, TypeError, ValueError) as error:
            if isinstance(error, ParameterError):
                raise
            raise ParameterError(f"`{self.name}` is {told(value)}; {self.remedy}") from None


class Pixels(_Told, traitlets.Int):  # type: ignore[type-arg]
    """A number of pixels."""

    remedy = PIXELS

    def _coerced(self, value: Any) -> int:
        return pixels(str(self.name), value)


class Label(_Told, traitlets.Unicode):  # type: ignore[type-arg]
    """A name, which may be given as a number: ids and names of columns are texts."""

    remedy = "give one name, as of a feature or a column"

    def _coerced(self, value: Any) -> str:
        if not np.isscalar(value) and not hasattr(value, "isoformat"):
            raise TypeError
        return text_of(value)


class Choice(_Told, traitlets.Enum):  # type: ignore[type-arg]
    """One of some words."""

    @property
    def remedy(self) -> str:  # type: ignore[override]
        """The words."""
        return f"give {' or '.join(map(repr, self.values or ()))}"


class Number(_Told, traitlets.CFloat):  # type: ignore[type-arg]
    """A number."""

    remedy = "give a number"


class Background(_Told, traitlets.Unicode):  # type: ignore[type-arg]
    """A colour of a page."""

    remedy = "give a CSS colour, such as 'white' or 'transparent'"


class Rectangle(_Told, traitlets.Tuple):
    """Left, bottom, width and height."""

    remedy = "give four numbers: left, bottom, width and height"

    def __init__(self, **options: Any) -> None:
        super().__init__(*(traitlets.CFloat() for _ in range(4)), **options)

    def _coerced(self, value: Any) -> Any:
        return tuple(value)


class Colours(_Told, traitlets.Dict):
    """Colours by names."""

    remedy = "give a mapping of names, such as {'sun': 'red'}"

    def _coerced(self, value: Any) -> dict[str, Any]:
        if not isinstance(value, Mapping):
            raise TypeError
        return {text_of(name): colour for name, colour in value.items()}
