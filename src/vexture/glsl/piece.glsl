// The contribution of one piece of outline to a pixel's area: the part on the right of the piece.
// Exports: VexturePiece, vexture_piece, vexture_clear_side, vexture_piece_area.
#include "pixel.glsl"

// Monotone in x and y, in lattice units of the leaf.
struct VexturePiece {
    vec2 p0;  // relative to the pixel's centre
    vec2 p3;
    vec2 d1;  // P1 - P0, P2 - P1, P3 - P2: integers, so exact
    vec2 d2;
    vec2 d3;
    bool starts_left;  // on the leaf's left edge
    bool ends_left;
};

ivec2 vexture_lattice_point(uint word) {
    return ivec2(int(word & 0xffffu), int(word >> VEXTURE_COORDINATE_BITS));
}

// A piece relative to a point, given as whole lattice units and the rest.
VexturePiece vexture_piece(uvec4 texel, ivec2 whole, vec2 part) {
    ivec2 p0 = vexture_lattice_point(texel.x);
    ivec2 p1 = vexture_lattice_point(texel.y) - VEXTURE_CONTROL_OFFSET;
    ivec2 p2 = vexture_lattice_point(texel.z) - VEXTURE_CONTROL_OFFSET;
    ivec2 p3 = vexture_lattice_point(texel.w);
    vec2 r0 = vec2(p0 - whole) - part;
    vec2 r3 = vec2(p3 - whole) - part;
    return VexturePiece(r0, r3, vec2(p1 - p0), vec2(p2 - p1), vec2(p3 - p2), p0.x == 0, p3.x == 0);
}

// Coefficients of t^3, t^2, t and 1.
vec4 vexture_polynomial(float p0, float d1, float d2, float d3) {
    return vec4((d3 - d2) - (d2 - d1), 3.0 * (d2 - d1), 3.0 * d1, p0);
}

float vexture_evaluate(vec4 k, float t) {
    return ((k.x * t + k.y) * t + k.z) * t + k.w;
}

// Winding that a piece outside of the box adds to all of it: -1, 0 or 1; CROSSING if it may cross the box.
int vexture_clear_side(VexturePiece piece, vec2 low, vec2 high) {
    float bottom = min(piece.p0.y, piece.p3.y);
    float top = max(piece.p0.y, piece.p3.y);
    float left = min(piece.p0.x, piece.p3.x);
    float right = max(piece.p0.x, piece.p3.x);
    bool apart = top <= low.y || bottom >= high.y || left >= high.x;
    bool passes_left = bottom <= low.y && top >= high.y && right <= low.x;
    return apart ? 0 : !passes_left ? VEXTURE_CROSSING : piece.p3.y > piece.p0.y ? -1 : 1;
}

// Whether x rather than y is the coordinate in which a piece passes a corner of the box last (`later`), or first. Both
// coordinates rise, because they are mirrored. If one has passed, it decides; otherwise the slopes do.
bool vexture_x_decides(vec2 error, vec2 slope, bool later) {
    bool x_before = error.x < 0.0;
    bool x_slower = error.y * slope.x > error.x * slope.y;
    return (x_before != (error.y < 0.0) ? x_before : x_slower) == later;
}

vec2 vexture_slope(vec4 kx, vec4 ky, float t) {
    return vec2((3.0 * kx.x * t + 2.0 * kx.y) * t + kx.z, (3.0 * ky.x * t + 2.0 * ky.y) * t + ky.z);
}

// A Laguerre step, worth several Newton steps near a turning point, towards the t at which a piece has passed a corner in
// both coordinates (`later`), or in one. At a flat inflection there is no slope to follow: the step then goes to the end
// on the corner's side, unless the piece is less than a lattice unit away, as at a cusp on the corner.
float vexture_better_t(vec4 kx, vec4 ky, vec2 corner, bool later, float t) {
    vec2 errors = vec2(vexture_evaluate(kx, t), vexture_evaluate(ky, t)) - corner;
    vec2 slopes = vexture_slope(kx, ky, t);
    bool x_decides = vexture_x_decides(errors, slopes, later);
    float error = x_decides ? errors.x : errors.y;
    float slope = x_decides ? slopes.x : slopes.y;
    float bend = x_decides ? 6.0 * kx.x * t + 2.0 * kx.y : 6.0 * ky.x * t + 2.0 * ky.y;
    float divisor = slope + sqrt(max(4.0 * slope * slope - 6.0 * error * bend, 0.0));
    return clamp(t - (divisor > 0.0 ? 3.0 * error / divisor : trunc(error)), 0.0, 1.0);
}

// Point of a piece at the t where it passes a corner of the box from `from` to `to`. The coordinate that decides t becomes
// exactly the corner's, because one step of t may be a large part of a small pixel. It does not if t is an end of the
// piece, or if the coordinate is far from the corner's: the slopes decide nothing where a piece turns on the box's side.
vec2 vexture_passing_point(vec4 kx, vec4 ky, float t, vec2 corner, bool later, bool is_end, vec2 from, vec2 to) {
    vec2 point = vec2(vexture_evaluate(kx, t), vexture_evaluate(ky, t));
    bool x_decides = vexture_x_decides(point - corner, vexture_slope(kx, ky, t), later);
    bvec2 near = lessThan(abs(point - corner), VEXTURE_NEAR * (to - from));
    point.x = !is_end && x_decides && near.x ? corner.x : point.x;
    point.y = !is_end && !x_decides && near.y ? corner.y : point.y;
    return clamp(point, from, to);
}

// Area between a cubic with these differences of control points (P1 - P0, P3 - P2, P3 - P0) and its chord; positive where
// the curve lies on the right.
float vexture_bulge(vec2 first, vec2 last, vec2 chord) {
    float turned = first.x * chord.y - first.y * chord.x + chord.x * last.y - chord.y * last.x;
    return 0.15 * (2.0 * turned - (first.x * last.y - first.y * last.x));
}

// Point of a piece with mirrored coordinates, clamped to the box.
vec2 vexture_point(vec4 kx, vec4 ky, float t, vec2 mirror, vec2 low, vec2 high) {
    return clamp(vec2(vexture_evaluate(kx, t), vexture_evaluate(ky, t)) * mirror, low, high);
}

// Area beside a part of a piece: beside its chord, plus the area between the two for the share of the chord in the pixel.
// Parameters: the part's ends in the plane, and the derivatives there times a third of the part's interval of t.
float vexture_part_area(vec2 p, vec2 q, vec2 first, vec2 last, VextureFrame frame) {
    vec2 from = vexture_into_frame(frame, p);
    vec2 to = vexture_into_frame(frame, q);
    float scale = frame.turned / frame.size;
    return vexture_beside(from, to) + scale * vexture_bulge(first, last, q - p) * vexture_part_inside(from, to);
}

// Area beside a piece from p at t0 to q at t1. Quality fast: as one part; exact: as many parts as its bend requires.
float vexture_curve_area(
    vec4 kx, vec4 ky, float t0, float t1, vec2 p, vec2 q, vec2 mirror, VextureFrame frame, vec2 low, vec2 high
) {
    vec2 first = vexture_slope(kx, ky, t0) * mirror;
    vec2 last = vexture_slope(kx, ky, t1) * mirror;
    float step_t = t1 - t0;
#if VEXTURE_QUALITY == VEXTURE_EXACT
    float bend = abs(first.x * last.y - first.y * last.x) * step_t * step_t / frame.size;
    int parts = 1 + int(min(VEXTURE_BEND * bend, VEXTURE_MOST_PARTS - 1.0));
    step_t /= float(parts);
    float area = 0.0;
    float t = t0;
    while (parts > 0) {
        parts--;
        t += step_t;
        vec2 next = parts == 0 ? q : vexture_point(kx, ky, t, mirror, low, high);
        last = vexture_slope(kx, ky, t) * mirror;
        area += vexture_part_area(p, next, first * (step_t / 3.0), last * (step_t / 3.0), frame);
        p = next;
        first = last;
    }
    return area;
#else
    return vexture_part_area(p, q, first * (step_t / 3.0), last * (step_t / 3.0), frame);
#endif
}

// Area on the right of a piece inside the box from low to high, negative for a piece that goes up. If an end of it lies on
// the leaf's left edge and in the box, the area of the box above that end is included with the sign of its winding.
float vexture_piece_area(VexturePiece piece, VextureFrame frame, vec2 low, vec2 high) {
    vec2 way = piece.d1 + piece.d2 + piece.d3;
    vec2 mirror = vec2(way.x < 0.0 ? -1.0 : 1.0, way.y < 0.0 ? -1.0 : 1.0);
    vec4 kx = vexture_polynomial(piece.p0.x, piece.d1.x, piece.d2.x, piece.d3.x) * mirror.x;
    vec4 ky = vexture_polynomial(piece.p0.y, piece.d1.y, piece.d2.y, piece.d3.y) * mirror.y;
    vec2 from = vec2(way.x < 0.0 ? -high.x : low.x, way.y < 0.0 ? -high.y : low.y);
    vec2 to = vec2(way.x < 0.0 ? -low.x : high.x, way.y < 0.0 ? -low.y : high.y);
    vec2 size = max(abs(way), VEXTURE_NO_SIZE);
    vec2 begin = (from - vec2(kx.w, ky.w)) / size;
    vec2 end = (to - vec2(kx.w, ky.w)) / size;
    float t0 = clamp(max(begin.x, begin.y), 0.0, 1.0);
    float t1 = clamp(min(end.x, end.y), 0.0, 1.0);
    vec2 pixels = size.x * abs(vec2(frame.right.x, frame.up.x)) + size.y * abs(vec2(frame.right.y, frame.up.y));
    float pixels_most = max(pixels.x, pixels.y);
    int steps = VEXTURE_STEPS;
    while (steps > 0) {
        float better0 = vexture_better_t(kx, ky, from, true, t0);
        float better1 = vexture_better_t(kx, ky, to, false, t1);
        float moved = max(abs(better0 - t0), abs(better1 - t1)) * pixels_most;
        t0 = better0;
        t1 = better1;
        steps = moved > VEXTURE_CLOSE ? steps - 1 : 0;
    }
    bool misses = t0 >= t1;  // touches a side or a corner of the box
    t1 = max(t0, t1);

    float y0 = clamp(piece.p0.y, low.y, high.y);
    float y3 = clamp(piece.p3.y, low.y, high.y);
    vec2 enter = vexture_passing_point(kx, ky, t0, from, true, t0 == 0.0, from, to) * mirror;
    vec2 leave = vexture_passing_point(kx, ky, t1, to, false, t1 == 1.0, from, to) * mirror;
    leave = misses ? enter : leave;
    float area = vexture_curve_area(kx, ky, t0, t1, enter, leave, mirror, frame, low, high);

    // the path along the box's sides: its left side while the piece is left of the box, and back on its right side
    float left_start = way.x < 0.0 ? leave.y : y0;
    float left_end = way.x < 0.0 ? y3 : enter.y;
    float right_start = way.x < 0.0 ? y3 : leave.y;
    float right_end = way.x < 0.0 ? enter.y : y0;
    bool starts = piece.starts_left && piece.p0.y > low.y && piece.p0.y < high.y;
    bool ends = piece.ends_left && piece.p3.y > low.y && piece.p3.y < high.y;
    left_start = starts && way.x >= 0.0 ? high.y : left_start;
    right_end = starts && way.x >= 0.0 ? high.y : right_end;
    left_end = ends ? high.y : left_end;
    right_start = ends ? high.y : right_start;
    vec2 l0 = vexture_into_frame(frame, vec2(low.x, left_start));
    vec2 l1 = vexture_into_frame(frame, vec2(low.x, left_end));
    vec2 r0 = vexture_into_frame(frame, vec2(high.x, right_start));
    vec2 r1 = vexture_into_frame(frame, vec2(high.x, right_end));
    vec2 e0 = vexture_into_frame(frame, vec2(enter.x, right_end));
    vec2 e1 = vexture_into_frame(frame, vec2(leave.x, right_start));
    area += vexture_beside_sloped(l0, l1.y, frame.upright) + vexture_beside_sloped(r0, r1.y, frame.upright);
    area += vexture_beside_sloped(e1, r0.y, frame.level) + vexture_beside_sloped(r1, e0.y, frame.level);
    return area;
}
