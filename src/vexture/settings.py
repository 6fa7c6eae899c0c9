"""The parameters of a conversion and their values' ranges."""

from dataclasses import dataclass
from typing import Literal

from vexture.errors import ParameterError

__all__ = ["Settings"]


@dataclass(frozen=True, slots=True)
class Settings:
    """Parameters of a conversion, checked; None is the default.

    `vexture.convert` says what each of them is.

    Raises
    ------
    ParameterError
        If `split` is not known.

    Examples
    --------
    >>> Settings(tolerance="auto").distance
    0.0
    >>> Settings(split="colour")
    Traceback (most recent call last):
    vexture.errors.ParameterError: `split` is 'colour'; it must be 'paint' or None
    """

    split: Literal["paint"] | None = None
    select: str | None = None
    tolerance: float | Literal["auto"] = "auto"
    max_depth: int | None = None
    capacity: int | None = None
    precision: float | None = None

    def __post_init__(self) -> None:
        if self.split not in (None, "paint"):
            raise ParameterError(f"`split` is {self.split!r}; it must be 'paint' or None")

    @property
    def distance(self) -> float:
        """Distance within which pieces may become one, in unit-square units; "auto" loses nothing."""
        return 0.0 if self.tolerance == "auto" else self.tolerance
