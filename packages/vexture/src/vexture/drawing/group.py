"""Groups of paths: opacity, blend modes and masks, as in SVG and CSS."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from vexture.base.errors import SourceError


class Blend(IntEnum):
    """Blend mode of a group, as in *Compositing and Blending Level 1* of the W3C."""

    NORMAL = 0
    MULTIPLY = 1
    SCREEN = 2
    OVERLAY = 3
    DARKEN = 4
    LIGHTEN = 5
    COLOR_DODGE = 6
    COLOR_BURN = 7
    HARD_LIGHT = 8
    SOFT_LIGHT = 9
    DIFFERENCE = 10
    EXCLUSION = 11
    HUE = 12
    SATURATION = 13
    COLOR = 14
    LUMINOSITY = 15
    PLUS_LIGHTER = 16


class Mask(IntEnum):
    """Property of a group that masks the group around it, which is hidden where that is 0.

    A clip is a mask by opacity whose paths are opaque. Luminance is that of premultiplied sRGB (CSS Masking 1, 7.10.1).
    """

    NONE = 0
    OPACITY = 1
    LUMINANCE = 2


@dataclass(frozen=True, slots=True)
class Group:
    """Paths that are composited with each other first, before the result is composited on what lies below.

    A mask is a group that is not shown itself. It may be anywhere in the group around it; several masks multiply.

    Parameters
    ----------
    outer : int
        Index of the group around it in `Drawing.groups`, which is less than its own; -1 if there is none.
    opacity : float
        Opacity of the whole group, 0..1.
    blend : Blend
    mask : Mask
        Property by which it masks the group around it, if it does.
    pattern : bool
        True if it is a pattern, masked by the shape that the pattern fills. Renderers without masks show that shape
        instead.
    """

    outer: int = -1
    opacity: float = 1.0
    blend: Blend = Blend.NORMAL
    mask: Mask = Mask.NONE
    pattern: bool = False

    def __post_init__(self) -> None:
        if not 0.0 <= self.opacity <= 1.0:
            raise SourceError(f"a group has opacity {self.opacity}; it must be in 0..1")
        if self.mask and self.outer < 0:
            raise SourceError("a group is a mask, but there is no group around it that it could mask")


def groups_around(groups: Sequence[Group], inner: int) -> list[int]:
    """Return the indices of the groups from the outermost to a given one, which may be -1."""
    found = []
    while inner >= 0:
        found.append(inner)
        inner = groups[inner].outer
    return found[::-1]
