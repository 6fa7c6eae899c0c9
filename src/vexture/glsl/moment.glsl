// Where in a box the area lies that a piece fills: first moments about the box's middle, in its sides. An area and its moment
// give the middle of a paint's part of a cell, about which its gradients are averaged.
// Exports: vexture_lift, vexture_moment.
#include "piece.glsl"

// Moment upwards of the box between two heights, of which this is the difference.
float vexture_between(float y) {
    return 0.5 * y * (1.0 - y);
}

// Moment upwards of what `vexture_first_look` or `vexture_flat_look` find filled: the box above ends of the piece on the
// leaf's left edge and, unless the piece crosses the box, beside a piece on the box's left. It is 0 across.
float vexture_lift(uvec4 texel, bool crosses, VextureBox box) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p3 = vexture_word(texel.w);
    vec2 r0 = vexture_in_box(p0, box);
    vec2 r3 = vexture_in_box(p3, box);
    float passed = !crosses && max(r0.x, r3.x) <= 0.0 ? 1.0 : 0.0;
    float first = (p0.x == 0.0 ? 1.0 : 0.0) - passed;
    float last = (p3.x == 0.0 ? 1.0 : 0.0) - passed;
    return first * vexture_between(clamp(r0.y, 0.0, 1.0)) - last * vexture_between(clamp(r3.y, 0.0, 1.0));
}

// Moment of the area on the right of a piece in the box, negative for one that rises; the area beyond its chord counts as
// if it lay in the chord's middle.
vec2 vexture_moment(VexturePiece piece, VextureEnds ends) {
    vec2 p = ends.enter;
    vec2 q = ends.leave;
    float rise = q.y - p.y;
    vec2 first = vexture_slope(piece, ends.start);
    vec2 last = vexture_slope(piece, ends.end);
    float bulge = vexture_bulge((ends.end - ends.start) / 3.0, first, last, q - p);
    vec2 middle = 0.5 * (p + q) - 0.5;
    // of the trapezoid between the chord and the left side
    float across = rise * (p.x * p.x + p.x * q.x + q.x * q.x) / 6.0 - 0.5 * rise * (middle.x + 0.5);
    float up = rise * (p.x * (2.0 * p.y + q.y) + q.x * (p.y + 2.0 * q.y)) / 6.0 - 0.5 * rise * (middle.x + 0.5);
    across += bulge * middle.x;
    up += bulge * middle.y;
    float y0 = clamp(piece.d.y, 0.0, 1.0);
    float y3 = clamp(piece.d.y + piece.way.y, 0.0, 1.0);
    float after = vexture_between(q.y) - vexture_between(y3) + up;
    float before = vexture_between(y0) - vexture_between(q.y) - up;
    return vec2(piece.falls.y ? -across : across, -(piece.falls.x ? after : before));
}
