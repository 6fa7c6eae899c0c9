"""The parameters of a conversion, as one value."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, get_args

from vexture.deadline import DEFAULT_SECONDS
from vexture.errors import ParameterError

if TYPE_CHECKING:  # imported at run time when needed: compiler and parser take long
    from vexture.drawing import Drawing

__all__ = ["READING", "Fonts", "Parameters", "Split"]

Split: TypeAlias = Literal["auto", "faces", "paint"] | None
"""How a drawing becomes shapes; see `vexture.convert`."""

SPLITS = get_args(get_args(Split)[0])

READING: Final = ("select", "names", "snap", "fonts", "trace_images")
"""Parameters of the source's reader."""

Fonts: TypeAlias = "Sequence[str | os.PathLike[str]] | None"
"""Font files, and folders of them, for the texts of SVG."""


@dataclass(frozen=True, slots=True)
class Parameters:
    """Parameters of a conversion, as `vexture.convert` describes them; None is the default.

    Examples
    --------
    >>> Parameters(split="colour")
    Traceback (most recent call last):
    vexture.errors.ParameterError: `split` is 'colour'; it must be 'auto', 'faces', 'paint' or None
    """

    split: Split = "auto"
    select: str | None = None
    tolerance: float | Literal["auto"] = "auto"
    max_depth: int | None = None
    capacity: int | None = None
    precision: float | None = None
    max_seconds: float = DEFAULT_SECONDS
    names: str | None = None
    snap: float | None = None
    restyle: bool = False
    fonts: "Fonts" = None
    trace_images: bool = False

    def __post_init__(self) -> None:
        if self.split is not None and self.split not in SPLITS:
            raise ParameterError(f"`split` is {self.split!r}; it must be {', '.join(map(repr, SPLITS))} or None")
        if self.restyle and self.split is None:
            raise ParameterError("`restyle` is for a drawing in its colours, and a silhouette has none; leave it out")
        if self.restyle and self.split not in ("auto", "faces"):
            raise ParameterError(
                f"`split` is {self.split!r}, but `restyle` is for a whole drawing in its colours: 'faces'"
            )

    @property
    def reading(self) -> dict[str, Any]:
        """Those of the source's reader that are given."""
        values = ((name, getattr(self, name)) for name in READING)
        return {name: value for name, value in values if value is not None and value is not False}

    def split_of(self, drawing: "Drawing") -> Split:
        """How a drawing becomes shapes: "auto" decided.

        A drawing of one colour is a silhouette in that colour, unless it is translucent and may overlap itself.
        """
        if self.split != "auto":
            return self.split
        return "faces" if self.restyle or drawing.is_coloured or len(drawing.layers()) > 1 else None
