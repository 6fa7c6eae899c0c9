"""The parameters of a conversion, as one value."""

import os
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final, Literal, TypeAlias, get_args

from vexture.base.content import FileKind
from vexture.base.deadline import DEFAULT_SECONDS
from vexture.base.errors import ParameterError
from vexture.texture.registry import DEFAULT

if TYPE_CHECKING:  # imported at run time when needed: compiler and parser take long
    from vexture.drawing.drawing import Drawing
    from vexture.tree.bounds import TreeParameters

Split: TypeAlias = Literal["auto", "faces", "paint"] | None
"""Way in which a drawing is split into shapes; see `vexture.convert`."""

SPLITS = get_args(get_args(Split)[0])

ImageTreatment: TypeAlias = Literal["draw", "trace", "none"]
"""Treatment of pictures; see `vexture.read`."""

READING: Final = ("select", "names", "snap", "fonts", "images", "page_colors")
"""Parameters of the reader of the source."""

Fonts: TypeAlias = "Sequence[str | os.PathLike[str]] | None"
"""Font files, and folders of font files, for the texts of an SVG."""


@dataclass(frozen=True, slots=True)
class Parameters:
    """Parameters of a conversion, as `vexture.convert` describes them; None is the default.

    Examples
    --------
    >>> Parameters(split="colour")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `split` is 'colour'; it must be 'auto', 'faces', 'paint' or None
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
    images: ImageTreatment = "draw"
    page_colors: "Mapping[str, str] | None" = None

    def __post_init__(self) -> None:
        if self.split is not None and self.split not in SPLITS:
            raise ParameterError(f"`split` is {self.split!r}; it must be {', '.join(map(repr, SPLITS))} or None")
        check_images(self.images)
        if self.restyle and self.split is None:
            raise ParameterError("`restyle` is for a drawing in its colours, and a silhouette has none; leave it out")
        if self.restyle and self.split not in ("auto", "faces"):
            raise ParameterError(
                f"`split` is {self.split!r}, but `restyle` is for a whole drawing in its colours: 'faces'"
            )

    @classmethod
    def from_mapping(cls, values: "Mapping[str, Any]") -> "Parameters":
        """Make parameters from a mapping; raise a `TypeError` for an unknown name."""
        refuse_unknown(values, cls.__dataclass_fields__, DEFAULT)
        return cls(**values)

    @property
    def bounds(self) -> "TreeParameters":
        """Parameters of the tree that are not None, without the tolerance."""
        bounds: TreeParameters = {}
        if self.max_depth is not None:
            bounds["max_depth"] = self.max_depth
        if self.capacity is not None:
            bounds["capacity"] = self.capacity
        if self.precision is not None:
            bounds["precision"] = self.precision
        return bounds

    @property
    def overrides(self) -> dict[str, Any]:
        """Parameters that differ from their defaults, by name."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {name: value for name, value in values if value != getattr(DEFAULTS, name)}

    @property
    def reading(self) -> dict[str, Any]:
        """Parameters of the reader that are set, by name."""
        return {name: value for name, value in self.overrides.items() if name in READING}

    def split_of(self, drawing: "Drawing") -> Split:
        """Return the split of a drawing, with ``"auto"`` resolved.

        A drawing of one colour becomes a silhouette in that colour, unless it is translucent and may overlap itself.
        """
        if self.split != "auto":
            return self.split
        if self.restyle or drawing.is_coloured:
            return "faces"
        is_opaque = all(path.paint.opacity >= 1.0 for path in drawing.paths)  # then it is one layer
        return None if is_opaque or len(drawing.layers()) == 1 else "faces"


def check_images(images: object) -> None:
    """Raise a `ParameterError` unless a value is a treatment of pictures."""
    if images not in get_args(ImageTreatment):
        raise ParameterError(f"`images` is {images!r:.80}; it must be {', '.join(map(repr, get_args(ImageTreatment)))}")


DEFAULTS: Final = Parameters()


def refuse_unknown(values: "Mapping[str, Any]", known: "Container[str]", encoding: str) -> None:
    """Raise a `TypeError` for the first parameter that an encoding does not have."""
    for name, value in values.items():
        if name not in known:
            raise TypeError(f"`{name}` is {value!r}, but the encoding {encoding} has no such parameter; leave it out")


def check_reading(
    kind: FileKind,
    select: str | None,
    names: str | None,
    snap: float | None,
    fonts: "str | os.PathLike[str] | Sequence[str | os.PathLike[str]]",
    page_colors: "Mapping[str, str] | None",
    images: ImageTreatment,
) -> None:
    """Raise a `ParameterError` for a parameter of a reader that has no meaning for a kind of file."""
    if names is not None and kind not in (FileKind.GEOJSON, FileKind.SVG):
        raise ParameterError(f"`names` {names!r} is for the elements of GeoJSON and SVG; leave it out")
    if snap is not None and kind in (FileKind.SVG, FileKind.PICTURE):
        raise ParameterError(f"`snap` {snap} is for the borders of polygons in a map; leave it out")
    if kind in (FileKind.SVG, FileKind.TEXTURE):
        return
    if select is not None:
        raise ParameterError(f"`select` {select!r} chooses elements of an SVG; leave it out")
    if fonts:
        font = fonts if isinstance(fonts, str | os.PathLike) else fonts[0]
        raise ParameterError(f"`fonts` {os.fspath(font)!r} is for the texts of an SVG; leave it out")
    if images == "none" and kind is FileKind.PICTURE:
        raise ParameterError("`images` 'none' leaves nothing of a picture; leave it out")
    if images != "draw" and kind is not FileKind.PICTURE:
        raise ParameterError(f"`images` {images!r} is for pictures, and for those in an SVG; leave it out")
    if page_colors:
        name, color = next(iter(page_colors.items()))
        raise ParameterError(f"`page_colors` {name}={color} is for the colours of an SVG; leave it out")
