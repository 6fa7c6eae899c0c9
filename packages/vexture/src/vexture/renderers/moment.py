"""The mirror of ``shaders/moment.glsl``: area and moments of the part of a pixel that a piece fills.

See `vexture.renderers.cpu`.
"""

from typing import NamedTuple

from vexture.base.kernels import kernel
from vexture.renderers.cells import Texel, Vec2, clamp
from vexture.renderers.cpu import VextureCorner, from_corner, path_of, piece_parts
from vexture.renderers.method import GAUSS, NOTHING
from vexture.renderers.piece import (
    VextureBox,
    VextureEnds,
    VextureFrame,
    VexturePiece,
    at,
    bulge,
    in_box,
    into_frame,
    part_inside,
    slope,
    word,
)


class VextureShare(NamedTuple):
    """Area of a part of a pixel, and its moments about the pixel's centre, in units of the pixel's sides."""

    area: float
    x: float
    y: float
    xx: float
    xy: float
    yy: float


@kernel(allocates=False)
def area_share(area: float) -> VextureShare:
    """Share with an area but without moments."""
    return VextureShare(area, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel(allocates=False)
def whole_share() -> VextureShare:
    """Share of a whole pixel."""
    return VextureShare(1.0, 0.0, 0.0, 1.0 / 12.0, 0.0, 1.0 / 12.0)


@kernel(allocates=False)
def plus_share(a: VextureShare, b: VextureShare, times: float) -> VextureShare:
    """Return ``a + times * b``."""
    return VextureShare(
        a.area + times * b.area,
        a.x + times * b.x,
        a.y + times * b.y,
        a.xx + times * b.xx,
        a.xy + times * b.xy,
        a.yy + times * b.yy,
    )


@kernel(allocates=False)
def moved_share(share: VextureShare, sides: Vec2, middle: Vec2) -> VextureShare:
    """Convert a share of a box to one of its pixel; `sides` and `middle` are the box's, in the pixel."""
    size = sides[0] * sides[1]
    area = size * share.area
    x, y = size * sides[0] * share.x, size * sides[1] * share.y
    xx = size * sides[0] * sides[0] * share.xx + 2.0 * x * middle[0] + area * middle[0] * middle[0]
    xy = size * sides[0] * sides[1] * share.xy + x * middle[1] + y * middle[0] + area * middle[0] * middle[1]
    yy = size * sides[1] * sides[1] * share.yy + 2.0 * y * middle[1] + area * middle[1] * middle[1]
    return VextureShare(area, x + area * middle[0], y + area * middle[1], xx, xy, yy)


@kernel(allocates=False)
def share_at(place: Vec2) -> VextureShare:
    """Area and moments, per unit of height, of the part of the pixel to the right of a point at its height."""
    x, y = place
    wide, first = 0.5 - x, 0.5 * (0.25 - x * x)
    return VextureShare(wide, first, y * wide, (0.125 - x * x * x) / 3.0, y * first, y * y * wide)


@kernel(allocates=False)
def stretch_share(p: Vec2, q: Vec2) -> VextureShare:
    """Share to the right of a straight line inside the pixel; negative if the line goes up."""
    way = (GAUSS * (q[0] - p[0]), GAUSS * (q[1] - p[1]))
    middle = (0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]))
    one = share_at((middle[0] - way[0], middle[1] - way[1]))
    other = share_at((middle[0] + way[0], middle[1] + way[1]))
    fall = 0.5 * (p[1] - q[1])
    return plus_share(plus_share(area_share(0.0), one, fall), other, fall)


@kernel(allocates=False)
def share_beside(p: Vec2, q: Vec2) -> VextureShare:
    """Share to the right of any straight line."""
    rise = q[1] - p[1]
    rise = rise if abs(rise) > NOTHING else NOTHING
    start, end = clamp((-0.5 - p[1]) / rise, 0.0, 1.0), clamp((0.5 - p[1]) / rise, 0.0, 1.0)
    start, end = min(start, end), max(start, end)
    way = (q[0] - p[0], q[1] - p[1])
    run = way[0] if abs(way[0]) > NOTHING else NOTHING
    left, right = clamp((-0.5 - p[0]) / run, start, end), clamp((0.5 - p[0]) / run, start, end)
    outside = (start, left) if run > 0.0 else (left, end)
    inside = (min(left, right), max(left, right))
    low, high = p[1] + outside[0] * way[1], p[1] + outside[1] * way[1]
    share = stretch_share((-0.5, clamp(low, -0.5, 0.5)), (-0.5, clamp(high, -0.5, 0.5)))
    one = (clamp(p[0] + inside[0] * way[0], -0.5, 0.5), clamp(p[1] + inside[0] * way[1], -0.5, 0.5))
    other = (clamp(p[0] + inside[1] * way[0], -0.5, 0.5), clamp(p[1] + inside[1] * way[1], -0.5, 0.5))
    return plus_share(share, stretch_share(one, other), 1.0)


@kernel(allocates=False)
def box_share(frame: VextureFrame, low: Vec2, size: Vec2) -> VextureShare:
    """Share of the pixel in a box."""
    right, up = frame.right, frame.up
    p = into_frame(frame, low)
    q = (p[0] + right[0] * size[0], p[1] + up[0] * size[0])
    r = (q[0] + right[1] * size[1], q[1] + up[1] * size[1])
    s = (p[0] + right[1] * size[1], p[1] + up[1] * size[1])
    share = plus_share(share_beside(p, q), share_beside(q, r), 1.0)
    share = plus_share(share, share_beside(r, s), 1.0)
    return plus_share(share, share_beside(s, p), 1.0)


@kernel(allocates=False)
def curve_share(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> VextureShare:
    """Share beside a piece between its ends."""
    along, above = corner.x, corner.y
    parts = piece_parts(piece, ends, corner)
    step_t = (ends.end - ends.start) / parts
    p = from_corner(corner, ends.enter[0], ends.enter[1])
    way = slope(piece, ends.start)
    first = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
    share = area_share(0.0)
    t = ends.start
    while parts > 0:
        parts -= 1
        t = ends.end if parts == 0 else t + step_t
        there = ends.leave if parts == 0 else at(piece, t)
        way = slope(piece, t)
        q = from_corner(corner, there[0], there[1])
        last = (along[0] * way[0] + above[0] * way[1], along[1] * way[0] + above[1] * way[1])
        more = bulge(step_t / 3.0, first, last, (q[0] - p[0], q[1] - p[1])) * part_inside(p, q)
        x, y = clamp(0.5 * (p[0] + q[0]), -0.5, 0.5), clamp(0.5 * (p[1] + q[1]), -0.5, 0.5)
        share = plus_share(share, share_beside(p, q), 1.0)
        share = plus_share(share, VextureShare(1.0, x, y, x * x, x * y, y * y), more)
        p = q
        first = last
    return share


@kernel(allocates=False)
def piece_share(
    texel: Texel, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame
) -> VextureShare:
    """Share like `piece_area`, with moments."""
    path = path_of(texel, turns, piece, ends, box, frame)
    share = curve_share(piece, ends, path.corner)
    share = plus_share(share, share_beside(path.l0, path.l1), 1.0)
    share = plus_share(share, share_beside(path.r0, path.r1), 1.0)
    share = plus_share(share, share_beside(path.e1, path.r0), 1.0)
    return plus_share(share, share_beside(path.r1, path.e0), 1.0)


@kernel(allocates=False)
def flat_piece_share(piece: VexturePiece, ends: VextureEnds) -> VextureShare:
    """Share like `flat_piece_area`, with moments."""
    falls = piece.falls
    x, y = 0.5 if falls[0] else -0.5, 0.5 if falls[1] else -0.5
    corner = VextureCorner((x, y), (-2.0 * x, 0.0), (0.0, -2.0 * y))
    y0 = clamp(piece.d[1], 0.0, 1.0) if not falls[0] else ends.leave[1]
    y3 = clamp(piece.d[1] + piece.way[1], 0.0, 1.0) if falls[0] else ends.enter[1]
    left = (-0.5, y - 2.0 * y * y0), (-0.5, y - 2.0 * y * y3)
    return plus_share(curve_share(piece, ends, corner), stretch_share(left[0], left[1]), 1.0)


@kernel(allocates=False)
def share_above(y: float) -> VextureShare:
    """Share of a box above a height in 0..1."""
    return stretch_share((-0.5, 0.5), (-0.5, y - 0.5))


@kernel(allocates=False)
def flat_ends_share(texel: Texel, crosses: bool, box: VextureBox) -> VextureShare:
    """Share that the ends of a piece alone show to be filled, as `VextureLook.filled`."""
    p0, p3 = word(texel[0]), word(texel[3])
    r0, r3 = in_box(p0, box), in_box(p3, box)
    passed = 1.0 if not crosses and max(r0[0], r3[0]) <= 0.0 else 0.0
    first = (1.0 if p0[0] == 0.0 else 0.0) - passed
    last = (1.0 if p3[0] == 0.0 else 0.0) - passed
    share = plus_share(area_share(0.0), share_above(clamp(r0[1], 0.0, 1.0)), first)
    return plus_share(share, share_above(clamp(r3[1], 0.0, 1.0)), -last)
