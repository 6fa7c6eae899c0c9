"""Affine maps of the plane: fontTools' `Transform`, which has no types of its own."""

from typing import TYPE_CHECKING, NamedTuple

__all__ = ["Identity", "Transform"]

if TYPE_CHECKING:

    class Transform(NamedTuple):
        """The map (x, y) -> (xx x + yx y + dx, xy x + yy y + dy)."""

        xx: float = 1.0
        xy: float = 0.0
        yx: float = 0.0
        yy: float = 1.0
        dx: float = 0.0
        dy: float = 0.0

        def transform(self, other: "Transform") -> "Transform":
            """Map that applies the other one first."""

        def inverse(self) -> "Transform":
            """Map back."""

        def translate(self, x: float = 0.0, y: float = 0.0) -> "Transform":
            """Map that moves first."""

        def scale(self, x: float = 1.0, y: float | None = None) -> "Transform":
            """Map that scales first."""

        def rotate(self, angle: float) -> "Transform":
            """Map that turns first, by radians."""

    Identity: Transform
else:
    from fontTools.misc.transform import Identity, Transform
