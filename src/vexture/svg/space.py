"""Where an element stands: its user units, the viewports around it that clip, and what it inherits."""

from dataclasses import dataclass, replace

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.bezier.clip import clip_contour
from vexture.errors import SourceError
from vexture.svg.affine import Identity, Transform
from vexture.svg.style import INITIAL, Style
from vexture.svg.transform import mapped
from vexture.svg.values import LARGEST, Viewport
from vexture.svg.viewport import Rectangle

__all__ = ["Place", "Space"]

SMALLEST = 1 / LARGEST**4
"""Of a determinant: with anything smaller, sizes in user units would be no numbers to compute with."""


@dataclass(frozen=True, slots=True, eq=False)
class Space:
    """A coordinate system inside nested viewports.

    Parameters
    ----------
    matrix : Transform
        To the coordinates of `outer`, or of the drawing if there is none.
    clip : Rectangle or None
        What is visible, in those coordinates.
    outer : Space or None
        The coordinate system around the nearest viewport that clips.
    whole : Transform
        To the coordinates of the drawing.
    """

    matrix: Transform = Identity
    clip: Rectangle | None = None
    outer: "Space | None" = None
    whole: Transform = Identity

    @property
    def flat(self) -> bool:
        """Whether everything in it has no area in the drawing (or so little that floats cannot hold it)."""
        a, b, c, d = self.whole[:4]
        return bool(abs(a * d - b * c) < SMALLEST)

    def moved(self, matrix: Transform) -> "Space":
        """Coordinate system of an element with a transform."""
        whole = self.whole.transform(matrix)
        if not max(map(abs, whole)) <= LARGEST:
            raise SourceError(f"the transforms multiply to {max(map(abs, whole)):g}; the limit is {LARGEST:g}")
        return replace(self, matrix=self.matrix.transform(matrix), whole=whole)

    def window(self, visible: Rectangle, matrix: Transform) -> "Space":
        """Coordinate system inside a viewport of which only `visible`, in these coordinates, is seen."""
        return replace(self.moved(matrix), matrix=matrix, clip=visible, outer=self)

    def to_drawing(self, contour: NDArray[np.float64]) -> NDArray[np.float64]:
        """Map a contour to the drawing's coordinates, clipped on its way; empty if nothing is left."""
        space: Space | None = self
        while space is not None:
            if space.matrix != Identity:
                contour = mapped(contour, space.matrix)
            if space.clip is not None and len(contour):
                x, y, width, height = space.clip
                contour = clip_contour(contour, (x, y), (x + width, y + height))
            space = space.outer
        return contour


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """What an element finds where it stands in the drawing; `use` puts the same element in several places.

    Parameters
    ----------
    viewport : Viewport
        What percentages relate to.
    space : Space
        The user units.
    style : Style
        What it inherits.
    opacity : float
        Product of the opacities around it.
    element : lxml element or None
        The parent, or the `use` that shows it.
    outer : Place or None
        Where that stands.
    depth : int
        How many elements are around it.
    used : bool
        Whether one of them is a `use`.
    use : Style or None
        Style of the `use` whose very target stands here.
    chosen : bool
        Whether what stands here is painted: all of it, unless only a part of the document was asked for.
    """

    viewport: Viewport
    space: Space
    style: Style = INITIAL
    opacity: float = 1.0
    element: etree._Element | None = None
    outer: "Place | None" = None
    depth: int = 0
    used: bool = False
    use: Style | None = None
    chosen: bool = True

    def inside(self, element: etree._Element) -> bool:
        """Tell whether an element is around this place."""
        place: Place | None = self
        while place is not None:
            if place.element is element:
                return True
            place = place.outer
        return False
