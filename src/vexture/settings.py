"""The parameters of a conversion: what each may be, and which encoding each belongs to."""

from dataclasses import dataclass
from typing import Final, Literal

from vexture.errors import LimitError

__all__ = ["ENCODINGS", "Settings"]

ENCODINGS: Final = ("packed", "thesis")

BELONGS_TO: Final = {
    "split": "packed",
    "capacity": "packed",
    "precision": "packed",
    "bits": "thesis",
    "strategy": "thesis",
}
"""Encoding of each parameter that means nothing in the others."""


@dataclass(frozen=True, slots=True)
class Settings:
    """Parameters of a conversion, checked against one another; None is the encoding's own default.

    `vexture.convert` says what each of them is.

    Raises
    ------
    LimitError
        If the encoding is unknown, or a parameter belongs to another encoding.

    Examples
    --------
    >>> Settings(tolerance="auto").packed_tolerance
    0.0
    >>> Settings(bits=8)
    Traceback (most recent call last):
    vexture.errors.LimitError: bits=8 means nothing to the encoding packed; leave it out or use the encoding thesis
    """

    encoding: str = "packed"
    split: str | None = None
    select: str | None = None
    tolerance: float | Literal["auto"] = "auto"
    max_depth: int | None = None
    capacity: int | None = None
    precision: float | None = None
    bits: int | None = None
    strategy: Literal["direct", "sampled"] | None = None

    def __post_init__(self) -> None:
        if self.encoding not in ENCODINGS:
            raise LimitError(f"encoding {self.encoding!r} is not known; use {' or '.join(ENCODINGS)}")
        for name, encoding in BELONGS_TO.items():
            value = getattr(self, name)
            if value is not None and encoding != self.encoding:
                raise LimitError(
                    f"{name}={value} means nothing to the encoding {self.encoding}; "
                    f"leave it out or use the encoding {encoding}"
                )
        if self.split not in (None, "paint"):
            raise LimitError(f"split={self.split!r} is not known; drawings can be split by paint")

    @property
    def packed_tolerance(self) -> float:
        """Distance within which pieces may become one, in unit-square units; "auto" loses nothing."""
        return 0.0 if self.tolerance == "auto" else self.tolerance
