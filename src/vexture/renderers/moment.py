"""The mirror of ``glsl/moment.glsl``: where in a box the area lies that a piece fills (see `vexture.renderers.cpu`)."""

from vexture.kernels import kernel
from vexture.renderers.cells import Texel, Vec2, clamp
from vexture.renderers.piece import Box, Ends, Piece, bulge, in_box, slope, word

__all__ = ["lift", "moment"]


@kernel(allocates=False)
def between(y: float) -> float:
    return 0.5 * y * (1.0 - y)


@kernel(allocates=False)
def lift(texel: Texel, crosses: bool, box: Box) -> float:
    """Moment upwards of what the look at a piece's ends finds filled."""
    p0, p3 = word(texel[0]), word(texel[3])
    r0, r3 = in_box(p0, box), in_box(p3, box)
    passed = 1.0 if not crosses and max(r0[0], r3[0]) <= 0.0 else 0.0
    first = (1.0 if p0[0] == 0.0 else 0.0) - passed
    last = (1.0 if p3[0] == 0.0 else 0.0) - passed
    return first * between(clamp(r0[1], 0.0, 1.0)) - last * between(clamp(r3[1], 0.0, 1.0))


@kernel(allocates=False)
def moment(piece: Piece, ends: Ends) -> Vec2:
    """Moment of the area on the right of a piece in the box, negative for one that rises."""
    p, q = ends.enter, ends.leave
    rise = q[1] - p[1]
    first, last = slope(piece, ends.start), slope(piece, ends.end)
    beyond = bulge((ends.end - ends.start) / 3.0, first, last, (q[0] - p[0], q[1] - p[1]))
    middle = (0.5 * (p[0] + q[0]) - 0.5, 0.5 * (p[1] + q[1]) - 0.5)
    across = rise * (p[0] * p[0] + p[0] * q[0] + q[0] * q[0]) / 6.0 - 0.5 * rise * (middle[0] + 0.5)
    up = rise * (p[0] * (2.0 * p[1] + q[1]) + q[0] * (p[1] + 2.0 * q[1])) / 6.0 - 0.5 * rise * (middle[0] + 0.5)
    across += beyond * middle[0]
    up += beyond * middle[1]
    y0 = clamp(piece.d[1], 0.0, 1.0)
    y3 = clamp(piece.d[1] + piece.way[1], 0.0, 1.0)
    after = between(q[1]) - between(y3) + up
    before = between(y0) - between(q[1]) - up
    return -across if piece.falls[1] else across, -(after if piece.falls[0] else before)
