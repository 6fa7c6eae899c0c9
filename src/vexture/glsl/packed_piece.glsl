// What one piece of outline takes from a pixel: the part of it on the piece's right.
// Exports: VexturePiece, vexture_piece, vexture_piece_area.
#include "packed_pixel.glsl"

// Monotone in x and y; P0 to P3 relative to the pixel's centre, in lattice units of the leaf.
struct VexturePiece {
    vec2 p0;
    vec2 p1;
    vec2 p2;
    vec2 p3;
    bool starts_left;  // on the leaf's left edge
    bool ends_left;
};

vec2 vexture_lattice_point(uint word) {
    return vec2(float(word & 0xffffu), float(word >> VEXTURE_COORDINATE_BITS));
}

VexturePiece vexture_piece(uvec4 texel, vec2 center) {
    vec2 p0 = vexture_lattice_point(texel.x);
    vec2 p3 = vexture_lattice_point(texel.w);
    vec2 off = center + float(VEXTURE_CONTROL_OFFSET);
    vec2 p1 = vexture_lattice_point(texel.y) - off;
    vec2 p2 = vexture_lattice_point(texel.z) - off;
    return VexturePiece(p0 - center, p1, p2, p3 - center, p0.x == 0.0, p3.x == 0.0);
}

// Coefficients of t^3, t^2, t and 1.
vec4 vexture_polynomial(float p0, float p1, float p2, float p3) {
    return vec4(p3 - p0 + 3.0 * (p1 - p2), 3.0 * (p0 - 2.0 * p1 + p2), 3.0 * (p1 - p0), p0);
}

float vexture_evaluate(vec4 k, float t) {
    return ((k.x * t + k.y) * t + k.z) * t + k.w;
}

// t at which a monotone cubic, rising or falling by `way`, has a value; 0 or 1 if it has not.
//
// Starts from the quadratic that agrees with it at 0, 1/2 and 1, where t^3 is 3/2 t^2 - t/2, and goes on by Newton's
// steps, each kept between the bounds that the ones before have found.
float vexture_solve(vec4 k, float way, float value) {
    float a = k.y + 1.5 * k.x;
    float b = k.z - 0.5 * k.x;
    float c = k.w - value;
    float q = -0.5 * (b + (way > 0.0 ? 1.0 : -1.0) * sqrt(max(b * b - 4.0 * a * c, 0.0)));
    float t = q != 0.0 ? clamp(c / q, 0.0, 1.0) : 0.5;
    float low = 0.0;
    float high = 1.0;
    for (int i = 0; i < VEXTURE_STEPS; i++) {
        float error = vexture_evaluate(k, t) - value;
        float slope = (3.0 * k.x * t + 2.0 * k.y) * t + k.z;
        bool beyond = (error > 0.0) == (way > 0.0);
        low = beyond ? low : t;
        high = beyond ? t : high;
        float next = slope != 0.0 ? t - error / slope : low - 1.0;
        t = next >= low && next <= high ? next : 0.5 * (low + high);
    }
    return t;
}

// Minus the area on the right of a piece that goes up, plus that of one that goes down, inside the box from low to high.
float vexture_piece_area(VexturePiece piece, VextureFrame frame, vec2 low, vec2 high) {
    float y0 = clamp(piece.p0.y, low.y, high.y);
    float y3 = clamp(piece.p3.y, low.y, high.y);
    float left = min(piece.p0.x, piece.p3.x);
    float right = max(piece.p0.x, piece.p3.x);
    if (y0 == y3 || left >= high.x) {
        return 0.0;
    }
    vec2 side0 = vexture_into_frame(frame, vec2(high.x, y0));
    vec2 side3 = vexture_into_frame(frame, vec2(high.x, y3));
    float area = vexture_beside(side3, side0);
    vec2 before = vec2(low.x, y0);
    vec2 after = vec2(low.x, y3);
    if (right > low.x) {
        vec4 kx = vexture_polynomial(piece.p0.x, piece.p1.x, piece.p2.x, piece.p3.x);
        vec4 ky = vexture_polynomial(piece.p0.y, piece.p1.y, piece.p2.y, piece.p3.y);
        vec2 way = piece.p3 - piece.p0;
        float t0 = y0 == piece.p0.y ? 0.0 : vexture_solve(ky, way.y, y0);
        float t1 = y3 == piece.p3.y ? 1.0 : vexture_solve(ky, way.y, y3);
        vec2 start = vec2(way.x > 0.0 ? low.x : high.x, 0.0);
        // the part beyond the box's sides counts as if it lay on them
        if (way.x != 0.0) {
            float t_left = vexture_solve(kx, way.x, low.x);
            float t_right = vexture_solve(kx, way.x, high.x);
            t_left = left >= low.x ? (way.x > 0.0 ? 0.0 : 1.0) : t_left;
            t_right = right <= high.x ? (way.x > 0.0 ? 1.0 : 0.0) : t_right;
            float first = max(t0, min(t_left, t_right));
            float last = min(t1, max(t_left, t_right));
            t0 = min(first, t1);
            t1 = max(last, t0);
        }
        vec2 enter = vec2(clamp(vexture_evaluate(kx, t0), low.x, high.x), vexture_evaluate(ky, t0));
        vec2 leave = vec2(clamp(vexture_evaluate(kx, t1), low.x, high.x), vexture_evaluate(ky, t1));
        enter.y = clamp(enter.y, min(y0, y3), max(y0, y3));
        leave.y = clamp(leave.y, min(y0, y3), max(y0, y3));
        before = vec2(enter.x, y0);
        after = vec2(leave.x, y3);
        vec2 p = vexture_into_frame(frame, enter);
        for (int i = 1; i <= VEXTURE_CHORDS; i++) {
            float t = mix(t0, t1, float(i) / float(VEXTURE_CHORDS));
            vec2 point = i == VEXTURE_CHORDS ? leave : vec2(vexture_evaluate(kx, t), vexture_evaluate(ky, t));
            vec2 q = vexture_into_frame(frame, point);
            area += vexture_beside(p, q);
            p = q;
        }
        area += vexture_beside(vexture_into_frame(frame, before), vexture_into_frame(frame, enter));
        area += vexture_beside(p, vexture_into_frame(frame, after));
    } else {
        area += vexture_beside(vexture_into_frame(frame, before), vexture_into_frame(frame, after));
    }
#if VEXTURE_QUALITY == VEXTURE_EXACT
    area += vexture_beside(side0, vexture_into_frame(frame, before));
    area += vexture_beside(vexture_into_frame(frame, after), side3);
#endif
    return area;
}
