"""Traits of widgets that accept usual Python values, such as numbers of numpy, and explain an error in one line."""

from collections.abc import Mapping
from typing import Any, ClassVar, Final

import numpy as np
import traitlets

from vexture.base.errors import ParameterError, shorten_text
from vexture.base.labels import texts_of

PIXELS: Final = "give a whole number of pixels, 1 or more"
LONGEST: Final = 60
"""Longest value in a message, in letters."""


def format_value(value: Any) -> str:
    """Format a value for a message; an array is shown only as its type.

    Examples
    --------
    >>> format_value("100%"), format_value(np.arange(9))
    ("'100%'", 'a ndarray')
    """
    if getattr(value, "shape", ()):
        return f"a {type(value).__name__}"
    return shorten_text(" ".join(repr(value).split()), LONGEST)


def pixels(name: str, value: Any) -> int:
    """Check and return a positive whole number of pixels.

    Examples
    --------
    >>> pixels("width", np.int64(300))
    300
    >>> pixels("width", "100%")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `width` is '100%'; give a whole number of pixels, 1 or more
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        raise ParameterError(f"`{name}` is {format_value(value)}; {PIXELS}")
    return int(value)


def text_of(label: Any) -> str:
    """Convert a label to the text that identifies a feature.

    Examples
    --------
    >>> text_of(11), text_of(np.float64(11.0)), text_of("a")
    ('11', '11', 'a')
    """
    return str(texts_of([label])[0])


class _CheckedTrait(traitlets.TraitType[Any, Any]):
    """A trait whose error message says which values are valid."""

    remedy: ClassVar[str]

    def _coerce(self, value: Any) -> Any:
        """Convert a value to the trait's type."""
        return value

    def validate(self, obj: Any, value: Any) -> Any:
        try:
            return super().validate(obj, self._coerce(value))  # type: ignore[misc]
        except (traitlets.TraitError, TypeError, ValueError) as error:
            if isinstance(error, ParameterError):
                raise
            raise ParameterError(f"`{self.name}` is {format_value(value)}; {self.remedy}") from None


class PixelsTrait(_CheckedTrait, traitlets.Int):  # type: ignore[type-arg]
    """A number of pixels."""

    remedy = PIXELS

    def _coerce(self, value: Any) -> int:
        return pixels(str(self.name), value)


class LabelTrait(_CheckedTrait, traitlets.Unicode):  # type: ignore[type-arg]
    """A name, which may be given as a number: ids and column names are stored as text."""

    remedy = "give one name, as of a feature or a column"

    def _coerce(self, value: Any) -> str:
        if not np.isscalar(value) and not hasattr(value, "isoformat"):
            raise TypeError
        return text_of(value)


class ChoiceTrait(_CheckedTrait, traitlets.Enum):  # type: ignore[type-arg]
    """One of several words."""

    @property
    def remedy(self) -> str:  # type: ignore[override]
        """Message that lists the words."""
        return f"give {' or '.join(map(repr, self.values or ()))}"


class NumberTrait(_CheckedTrait, traitlets.CFloat):  # type: ignore[type-arg]
    """A number."""

    remedy = "give a number"


class BackgroundTrait(_CheckedTrait, traitlets.Unicode):  # type: ignore[type-arg]
    """A colour of a page."""

    remedy = "give a CSS colour, such as 'white' or 'transparent'"


class RectangleTrait(_CheckedTrait, traitlets.Tuple):
    """Left, bottom, width and height."""

    remedy = "give four numbers: left, bottom, width and height"

    def __init__(self, **options: Any) -> None:
        super().__init__(*(traitlets.CFloat() for _ in range(4)), **options)

    def _coerce(self, value: Any) -> Any:
        return tuple(value)


class ColoursTrait(_CheckedTrait, traitlets.Dict):
    """Colours by name."""

    remedy = "give a mapping of names, such as {'sun': 'red'}"

    def _coerce(self, value: Any) -> dict[str, Any]:
        if not isinstance(value, Mapping):
            raise TypeError
        return {text_of(name): colour for name, colour in value.items()}
