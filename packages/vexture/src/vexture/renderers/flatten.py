"""Flattens a drawing to straight chords in the image: the first half of the exact renderer, its only approximation.

Every cubic becomes chords that deviate from it by less than a given *flatness* in pixels. Control points are
homogeneous, so that a chord remains a chord in projective views too. Chords above, below or right of the image are
dropped. Chords left of it count in the windings and become vertical chords on its left edge.

Heights are rounded to a lattice of `SCANLINE` pixels, the same for all chords that meet in a point, so that closed
contours remain closed.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.base.kernels import kernel
from vexture.base.tolerance import SCANLINE
from vexture.drawing.drawing import Drawing

CHORD_LIMIT: Final = 2**24
"""Most chords in one image; about 1.3 GB of memory."""

CHORDS_AT_ONCE: Final = 16.0
"""A curve that needs more chords is halved first: parts outside the image then need one chord, flat parts few."""

HALVINGS: Final = 64


class Chords(NamedTuple):
    """Chords within the image, as many as fit into the arrays, and their total number."""

    lines: NDArray[np.float64]  # (n, 4): y of the top, y of the bottom, x at the top, dx/dy
    owners: NDArray[np.int32]  # (n,): number of the path + 1, negative if the curve goes up the image
    used: NDArray[np.int64]  # (1,)

    @classmethod
    def room_for(cls, count: int) -> "Chords":
        """Empty arrays."""
        return cls(np.empty((count, 4)), np.empty(count, np.int32), np.zeros(1, np.int64))


class ImageFrame(NamedTuple):
    """The part of homogeneous pixel coordinates (X, Y, W) that the image shows, and the flatness.

    Points with W <= near are out of sight. They are moved along (lift_x, lift_y, 1) onto the line W = near, which does
    not cross the image, so that contours remain closed.
    """

    width: float
    height: float
    near: float
    lift_x: float
    lift_y: float
    flatness: float


class HomogeneousPoint(NamedTuple):
    """A point in homogeneous pixel coordinates (X, Y, W)."""

    x: float
    y: float
    w: float


def find_chords(drawing: Drawing, size: tuple[int, int], view: NDArray[np.float64], flatness: float) -> Chords:
    """All chords that an image of a drawing with segments needs; a first pass counts them.

    The view is a (3, 3) matrix from pixel coordinates to the unit square; the flatness is in pixels. Raises
    `LimitError` if there are more than `CHORD_LIMIT`.
    """
    cubics, paths = homogeneous(drawing, view)
    frame = frame_of(size, view, flatness)
    chords = Chords.room_for(0)
    flatten(cubics, paths, frame, chords)
    count = int(chords.used[0])
    if count > CHORD_LIMIT:
        raise LimitError(f"the image needs {count} chords, the limit is {CHORD_LIMIT}; render it smaller or in parts")
    chords = Chords.room_for(count)
    flatten(cubics, paths, frame, chords)
    return chords


def homogeneous(drawing: Drawing, view: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Control points of each cubic in homogeneous pixel coordinates, (n, 4, 3), and the number of its path, (n,)."""
    points = np.concatenate([contour for path in drawing.paths for contour in path.contours])
    counts = [sum(map(len, path.contours)) for path in drawing.paths]
    u, v = points[..., 0], points[..., 1]
    # element by element: a matrix product may round a point that two cubics share differently
    cubics = np.stack([u * row[0] + v * row[1] + row[2] for row in np.linalg.inv(view)], axis=-1)
    return cubics, np.repeat(np.arange(len(counts), dtype=np.int32), counts)


def frame_of(size: tuple[int, int], view: NDArray[np.float64], flatness: float) -> ImageFrame:
    """Frame of an image; `near` is half of the least W of its pixels, and W is 1/(third row of the view)."""
    width, height = size
    nearest = 1.0 / (view[2] @ ((0, width, 0, width), (0, 0, height, height), (1, 1, 1, 1))).max()
    to_pixel = np.linalg.inv(view)
    slope = to_pixel[2, :2]  # of W over the unit square
    steepness = slope @ slope
    lift_x, lift_y = to_pixel[:2, :2] @ slope / steepness if steepness > 0.0 else (0.0, 0.0)
    return ImageFrame(float(width), float(height), float(0.5 * nearest), float(lift_x), float(lift_y), flatness)


@kernel
def flatten(cubics: NDArray[np.float64], paths: NDArray[np.int32], frame: ImageFrame, chords: Chords) -> None:
    """Add the chords of all cubics."""
    stack = np.empty((HALVINGS, 4, 3))
    for i in range(len(cubics)):
        for k in range(4):  # element by element: numba spends seconds on the assignment of a whole array
            for axis in range(3):
                stack[0, k, axis] = cubics[i, k, axis]
        top = 0
        while top >= 0:
            needed = chords_needed(stack[top], frame)
            if needed > CHORDS_AT_ONCE and top + 1 < HALVINGS:
                halve(stack[top], stack[top + 1])
                top += 1
            else:
                add_curve(stack[top], int(needed), paths[i] + 1, frame, chords)
                top -= 1


@kernel
def chords_needed(curve: NDArray[np.float64], frame: ImageFrame) -> float:
    """Number of chords for a cubic; 1 if it is out of sight.

    A chord over 1/n of t deviates from the curve by at most max|B''|/(8 n^2), and |B''| is at most six times the larger
    second difference d of the control points. Seen at the pixel (x, y), that is |(dX, dY) - (x, y) dW|/W.
    """
    left = right = above = below = True
    least, most = curve[0, 2], curve[0, 2]
    for k in range(4):
        x, y, w = curve[k, 0], curve[k, 1], curve[k, 2]
        left, right = left and x <= 0.0, right and x >= frame.width * w
        above, below = above and y <= 0.0, below and y >= frame.height * w
        least, most = min(least, w), max(most, w)
    if most <= frame.near or (least > frame.near and (left or right or above or below)):
        return 1.0
    bend = 0.0
    for k in range(2):
        dx = curve[k, 0] - 2.0 * curve[k + 1, 0] + curve[k + 2, 0]
        dy = curve[k, 1] - 2.0 * curve[k + 1, 1] + curve[k + 2, 1]
        dw = curve[k, 2] - 2.0 * curve[k + 1, 2] + curve[k + 2, 2]
        bend = max(bend, np.hypot(dx, dy) + np.hypot(frame.width, frame.height) * abs(dw))
    return max(1.0, float(np.ceil(np.sqrt(6.0 / 8.0 * bend / (max(least, frame.near) * frame.flatness)))))


@kernel
def halve(curve: NDArray[np.float64], first: NDArray[np.float64]) -> None:
    """Write the first half of a cubic to `first`; keep the second half in place (de Casteljau)."""
    for axis in range(3):
        p0, p1, p2, p3 = curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis]
        a, b, c = 0.5 * (p0 + p1), 0.5 * (p1 + p2), 0.5 * (p2 + p3)
        d, e = 0.5 * (a + b), 0.5 * (b + c)
        f = 0.5 * (d + e)
        first[0, axis], first[1, axis], first[2, axis], first[3, axis] = p0, a, d, f
        curve[0, axis], curve[1, axis], curve[2, axis], curve[3, axis] = f, e, c, p3


@kernel
def add_curve(curve: NDArray[np.float64], pieces: int, owner: int, frame: ImageFrame, chords: Chords) -> None:
    """Add a cubic as chords of equal steps in t, split where they pass out of sight."""
    start = HomogeneousPoint(curve[0, 0], curve[0, 1], curve[0, 2])
    for k in range(1, pieces + 1):
        t = k / pieces
        s = 1.0 - t
        b0, b1, b2, b3 = s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t  # at t = 1 exactly 0, 0, 0, 1
        x = b0 * curve[0, 0] + b1 * curve[1, 0] + b2 * curve[2, 0] + b3 * curve[3, 0]
        y = b0 * curve[0, 1] + b1 * curve[1, 1] + b2 * curve[2, 1] + b3 * curve[3, 1]
        w = b0 * curve[0, 2] + b1 * curve[1, 2] + b2 * curve[2, 2] + b3 * curve[3, 2]
        end = HomogeneousPoint(x, y, w)
        if (start.w < frame.near) != (w < frame.near):
            f = (frame.near - start.w) / (w - start.w)
            between = HomogeneousPoint(start.x + f * (x - start.x), start.y + f * (y - start.y), frame.near)
            add_line(start, between, owner, frame, chords)
            start = between
        add_line(start, end, owner, frame, chords)
        start = end


@kernel
def snap(y: float) -> float:
    """Nearest height on the lattice."""
    return float(np.floor(y / SCANLINE + 0.5)) * SCANLINE


@kernel
def to_screen(point: HomogeneousPoint, frame: ImageFrame) -> tuple[float, float]:
    """Pixel coordinates of a homogeneous point; a point out of sight is moved first (see `ImageFrame`)."""
    hidden = max(frame.near - point.w, 0.0)
    w = max(point.w, frame.near)
    return (point.x + hidden * frame.lift_x) / w, snap((point.y + hidden * frame.lift_y) / w)


@kernel
def add_line(start: HomogeneousPoint, end: HomogeneousPoint, owner: int, frame: ImageFrame, chords: Chords) -> None:
    """Add the part of a line that the image needs: nothing right of the image, only the heights left of it."""
    x0, y0 = to_screen(start, frame)
    x1, y1 = to_screen(end, frame)
    if y0 > y1:
        x0, y0, x1, y1, owner = x1, y1, x0, y0, -owner
    if y0 == y1 or y1 <= 0.0 or y0 >= frame.height:
        return
    slope = (x1 - x0) / (y1 - y0)
    if y0 < 0.0:
        x0, y0 = x0 - slope * y0, 0.0
    if y1 > frame.height:
        x1, y1 = x1 - slope * (y1 - frame.height), frame.height
    if min(x0, x1) >= frame.width:
        return
    if max(x0, x1) <= 0.0:
        add_chord(0.0, y0, y1, 0.0, owner, chords)
        return
    if min(x0, x1) < 0.0:
        y = min(max(snap(y0 - x0 / slope), y0), y1)
        if x0 < 0.0:
            add_chord(0.0, y0, y, 0.0, owner, chords)
            x0, y0 = 0.0, y
        else:
            add_chord(0.0, y, y1, 0.0, owner, chords)
            x1, y1 = 0.0, y
    if max(x0, x1) > frame.width:
        y = min(max(snap(y0 + (frame.width - x0) / slope), y0), y1)
        if x0 > frame.width:
            x0, y0 = frame.width, y
        else:
            y1 = y
    add_chord(x0, y0, y1, slope, owner, chords)


@kernel
def add_chord(x: float, y0: float, y1: float, slope: float, owner: int, chords: Chords) -> None:
    """Add a chord from (x, y0) down to y1, unless it is level."""
    if y0 < y1:
        k = chords.used[0]
        if k < len(chords.owners):
            lines = chords.lines
            lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3] = y0, y1, x, slope
            chords.owners[k] = owner
        chords.used[0] = k + 1
