"""Distance fields: single-channel textures of distances from the outline, drawn with a soft step.

C. Green, "Improved Alpha-Tested Magnification for Vector Textures and Special Effects", SIGGRAPH 2007. There the
distances are measured in a large picture. Here each texel holds the distance from its centre to the outline itself, so
that a distance field is compared at its best.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.bezier.points import points_at
from vexture_evidence.measures.raster import FULL, Footprint, MipMapped, mip_sides

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing

SPREAD: Final = 4.0
"""Texels, a common choice: greater distances are stored as this one."""

FINEST: Final = 9
"""Pixels per texel along a side, odd, in the larger picture that tells if a point is inside or outside."""

LARGEST: Final = 1365
"""Texels along a side; at three pixels per texel, the larger picture then has 4,095 pixels along a side."""

CHORD: Final = 0.25
"""Texels; longest piece of a curve that is treated as straight."""

BATCH: Final = 1 << 21
"""Pairs of a chord and a texel that are computed at a time."""


@dataclass(frozen=True, slots=True, eq=False)
class DistanceField(MipMapped):
    """A square picture of distances from the outline, with its mip-map.

    A texel holds the distance at its centre: 0 is `spread` or more outside the outline, 255 is `spread` or more inside.

    Parameters
    ----------
    spread : float
        Largest distance that is stored, in texels of the largest level.

    Examples
    --------
    >>> edge = DistanceField(np.array([[255, 0], [255, 0]], np.uint8), spread=0.5)
    >>> edge.sample((4, 1), [[0.25, 0, 0], [0, -0.25, 0.625]])
    array([[1., 1., 0., 0.]], dtype=float32)
    """

    spread: float = SPREAD

    def coverage(self, place: Footprint, *, mip: bool) -> NDArray[np.float64]:
        """A soft step across the outline, one pixel wide, 0..1."""
        stored = self.fetch(place, mip=mip, frame=False)
        # a point inside is no farther from the outline than from the unit square's border; nothing beyond it is inside
        border = self.side * np.minimum(np.minimum(place.u, 1.0 - place.u), np.minimum(place.v, 1.0 - place.v))
        distance = np.minimum((stored / FULL - 0.5) * 2.0 * self.spread, border)
        # no wider than the range of stored distances, so that points far inside are full and points far outside empty
        width = np.clip(place.reach * self.side, np.finfo(np.float64).tiny, 2.0 * self.spread)
        coverage: NDArray[np.float64] = np.clip(distance / width + 0.5, 0.0, 1.0)
        return coverage


def distance_from(drawing: "Drawing", side: int, spread: float = SPREAD, *, mips: bool = True) -> DistanceField:
    """Distance field of a drawing's silhouette.

    Parameters
    ----------
    drawing : Drawing
    side : int
        Texels along a side, at most `LARGEST`.
    spread : float
        Largest distance that is stored, in texels.
    mips : bool
        Make the mip-map too; its texels are distances in the same units.

    Raises
    ------
    LimitError
        If the side is out of range.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> half = Drawing.polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)])
    >>> distance_from(half, 4, 2.0, mips=False).texels[1]
    array([159, 159,  96,  32], dtype=uint8)
    """
    if not 1 <= side <= LARGEST:
        raise LimitError(f"a distance field of {side} texels a side; the limit is 1..{LARGEST}")
    reach = spread / side
    first, *others = (
        np.rint(FULL * np.clip(0.5 + 0.5 * signed_distances(drawing, n, reach) / reach, 0.0, 1.0)).astype(np.uint8)
        for n in [side, *(mip_sides(side) if mips else [])]
    )
    return DistanceField(first, tuple(others), spread)


def signed_distances(drawing: "Drawing", side: int, reach: float) -> NDArray[np.float64]:
    """Distance of each texel's centre from the outline, above 0 inside, (side, side), top row first.

    In unit-square units; greater distances than `reach` are replaced by it.
    """
    from vexture.renderers.exact import render_exact

    parts = max(1, (min(FINEST, 3 * LARGEST // side) - 1) | 1)
    fine = render_exact(drawing, (side * parts, side * parts))
    inside = fine[parts // 2 :: parts, parts // 2 :: parts] >= 0.5
    chords = border_chords(drawing, side, fine)
    far = nearest_distances(chords * side, side, reach * side)
    return np.where(inside, far, -far) / side


def border_chords(drawing: "Drawing", side: int, fine: NDArray[np.float32]) -> NDArray[np.float64]:
    """Short straight pieces of all curves, (n, 2, 2), x right and y down, without those inside the silhouette."""
    curves = [contour for path in drawing.paths for contour in path.contours]
    if not curves:
        return np.zeros((0, 2, 2))
    cubics = np.concatenate(curves) * (1.0, -1.0) + (0.0, 1.0)
    lengths = np.linalg.norm(np.diff(cubics, axis=1), axis=2).sum(axis=1)
    counts = np.maximum(1, np.ceil(lengths * side / CHORD)).astype(np.intp)
    owner = np.repeat(np.arange(len(cubics)), counts)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    ends = [points_at(cubics[owner], (number + step) / counts[owner]) for step in (0, 1)]
    chords = np.stack(ends, axis=1)
    # a piece is inside the silhouette if all pixels around its middle are full
    framed = np.pad(fine, 1)
    pixel = np.clip((chords.mean(axis=1) * len(fine)).astype(np.intp), 0, len(fine) - 1)
    around = np.stack([framed[pixel[:, 1] + down, pixel[:, 0] + right] for down in range(3) for right in range(3)])
    kept: NDArray[np.float64] = chords[around.min(axis=0) < 1.0 - 1.0 / FULL]
    return kept


def nearest_distances(chords: NDArray[np.float64], side: int, reach: float) -> NDArray[np.float64]:
    """Distance of each texel's centre from the nearest of the chords, at most `reach`; all in texels."""
    window = np.arange(-int(reach + CHORD + 1.0), int(reach + CHORD + 1.0) + 1)
    right, down = (axis.ravel() for axis in np.meshgrid(window, window))
    squares = np.full((side + 2 * len(window)) ** 2, reach * reach)  # with a frame, so that no window leaves it
    for start in range(0, len(chords), max(1, BATCH // len(right))):
        a, b = np.moveaxis(chords[start : start + max(1, BATCH // len(right))], 1, 0)
        home = np.floor(0.5 * (a + b))
        x, y = home[:, :1] + right + 0.5, home[:, 1:] + down + 0.5
        step = b - a
        length = np.maximum((step**2).sum(axis=1), np.finfo(np.float64).tiny)[:, None]
        t = np.clip(((x - a[:, :1]) * step[:, :1] + (y - a[:, 1:]) * step[:, 1:]) / length, 0.0, 1.0)
        far = (a[:, :1] + t * step[:, :1] - x) ** 2 + (a[:, 1:] + t * step[:, 1:] - y) ** 2
        index = (y.astype(np.intp) + len(window)) * (side + 2 * len(window)) + x.astype(np.intp) + len(window)
        np.minimum.at(squares, index.ravel(), far.ravel())
    framed = np.sqrt(squares).reshape(side + 2 * len(window), -1)
    inner: NDArray[np.float64] = framed[len(window) : len(window) + side, len(window) : len(window) + side]
    return inner
