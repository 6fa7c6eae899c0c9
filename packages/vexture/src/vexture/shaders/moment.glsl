// Area and first and second moments of the part of a pixel that a piece fills. The moments give the centre and the extent
// of a paint's part of a cell, over which the paint's gradients are averaged.
//
// Each moment is an integral, over the heights of a straight line, of a polynomial of at most the third degree, so that
// Gauss-Legendre quadrature with two points is exact.
// VEXTURE_GRADIENTS is 0 if no map has programs: a share is then only an area.
// Exports: VextureShare, vexture_plus_share, vexture_box_share, vexture_piece_share, vexture_flat_piece_share.
#include "coverage.glsl"
#include "gradient.glsl"

// Share of a pixel: area, and moments about the pixel's centre, in units of its sides.
struct VextureShare {
    float area;
#if VEXTURE_GRADIENTS
    float x;
    float y;
    float xx;
    float xy;
    float yy;
#endif
};

// Share with an area but without moments.
VextureShare vexture_area_share(float area) {
#if VEXTURE_GRADIENTS
    return VextureShare(area, 0.0, 0.0, 0.0, 0.0, 0.0);
#else
    return VextureShare(area);
#endif
}

// Share of a whole pixel.
VextureShare vexture_whole_share() {
#if VEXTURE_GRADIENTS
    return VextureShare(1.0, 0.0, 0.0, 1.0 / 12.0, 0.0, 1.0 / 12.0);
#else
    return VextureShare(1.0);
#endif
}

// Sum of a share and a multiple of another.
VextureShare vexture_plus_share(VextureShare a, VextureShare b, float times) {
#if VEXTURE_GRADIENTS
    return VextureShare(
        a.area + times * b.area,
        a.x + times * b.x,
        a.y + times * b.y,
        a.xx + times * b.xx,
        a.xy + times * b.xy,
        a.yy + times * b.yy
    );
#else
    return VextureShare(a.area + times * b.area);
#endif
}

// Converts a share of a box to one of its pixel, given the box's sides and centre in the pixel.
VextureShare vexture_moved_share(VextureShare share, vec2 sides, vec2 middle) {
    float area = sides.x * sides.y * share.area;
#if VEXTURE_GRADIENTS
    vec2 first = sides.x * sides.y * sides * vec2(share.x, share.y);
    vec3 second = sides.x * sides.y * sides.xxy * sides.xyy * vec3(share.xx, share.xy, share.yy);
    second += vec3(2.0 * first.x * middle.x, first.x * middle.y + first.y * middle.x, 2.0 * first.y * middle.y);
    second += area * middle.xxy * middle.xyy;
    first += area * middle;
    return VextureShare(area, first.x, first.y, second.x, second.y, second.z);
#else
    return VextureShare(area);
#endif
}

#if VEXTURE_GRADIENTS

// Area and moments, per unit of height, of the part of the pixel to the right of a point at its height.
VextureShare vexture_share_at(vec2 place) {
    float wide = 0.5 - place.x;
    float first = 0.5 * (0.25 - place.x * place.x);
    float second = (0.125 - place.x * place.x * place.x) / 3.0;
    return VextureShare(wide, first, place.y * wide, second, place.y * first, place.y * place.y * wide);
}

// Share to the right of a straight line inside the pixel; negative if the line goes up.
VextureShare vexture_stretch_share(vec2 p, vec2 q) {
    vec2 middle = 0.5 * (p + q);
    vec2 way = VEXTURE_GAUSS * (q - p);
    float fall = 0.5 * (p.y - q.y);
    VextureShare share = vexture_plus_share(vexture_area_share(0.0), vexture_share_at(middle - way), fall);
    return vexture_plus_share(share, vexture_share_at(middle + way), fall);
}

// The same for any straight line: where it is left of the pixel, all of the pixel lies on its right.
VextureShare vexture_share_beside(vec2 p, vec2 q) {
    vec2 way = q - p;
    float run = abs(way.x) > VEXTURE_NOTHING ? way.x : VEXTURE_NOTHING;
    float rise = abs(way.y) > VEXTURE_NOTHING ? way.y : VEXTURE_NOTHING;
    float low = clamp((-0.5 - p.y) / rise, 0.0, 1.0);
    float high = clamp((0.5 - p.y) / rise, 0.0, 1.0);
    float start = min(low, high);
    float end = max(low, high);
    float left = clamp((-0.5 - p.x) / run, start, end);
    float right = clamp((0.5 - p.x) / run, start, end);
    vec2 outside = p.y + way.y * (run > 0.0 ? vec2(start, left) : vec2(left, end));
    outside = clamp(outside, -0.5, 0.5);
    vec2 enter = clamp(p + way * min(left, right), -0.5, 0.5);
    vec2 leave = clamp(p + way * max(left, right), -0.5, 0.5);
    VextureShare share = vexture_stretch_share(vec2(-0.5, outside.x), vec2(-0.5, outside.y));
    return vexture_plus_share(share, vexture_stretch_share(enter, leave), 1.0);
}

// Share of the pixel in a box.
VextureShare vexture_box_share(VextureFrame frame, vec2 low, vec2 size) {
    vec2 p = vexture_into_frame(frame, low);
    vec2 q = p + vec2(frame.right.x, frame.up.x) * size.x;
    vec2 r = q + vec2(frame.right.y, frame.up.y) * size.y;
    vec2 s = p + vec2(frame.right.y, frame.up.y) * size.y;
    VextureShare share = vexture_plus_share(vexture_share_beside(p, q), vexture_share_beside(q, r), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(r, s), 1.0);
    return vexture_plus_share(share, vexture_share_beside(s, p), 1.0);
}

// Like vexture_curve_area, with moments; the area between a part and its chord counts as if it lay at the chord's middle.
VextureShare vexture_curve_share(VexturePiece piece, VextureEnds ends, VextureCorner corner) {
    int parts = vexture_piece_parts(piece, ends, corner);
    float step_t = (ends.end - ends.start) / float(parts);
    vec2 p = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    vec2 slope = vexture_slope(piece, ends.start);
    vec2 first = corner.x * slope.x + corner.y * slope.y;
    VextureShare share = vexture_area_share(0.0);
    float t = ends.start;
    while (parts > 0) {
        parts--;
        t = parts == 0 ? ends.end : t + step_t;
        vec2 next = parts == 0 ? ends.leave : vexture_at(piece, t);
        slope = vexture_slope(piece, t);
        vec2 q = vexture_from_corner(corner, next.x, next.y);
        vec2 last = corner.x * slope.x + corner.y * slope.y;
        float more = vexture_bulge(step_t / 3.0, first, last, q - p) * vexture_part_inside(p, q);
        vec2 m = clamp(0.5 * (p + q), -0.5, 0.5);
        share = vexture_plus_share(share, vexture_share_beside(p, q), 1.0);
        share = vexture_plus_share(share, VextureShare(1.0, m.x, m.y, m.x * m.x, m.x * m.y, m.y * m.y), more);
        p = q;
        first = last;
    }
    return share;
}

// Like vexture_piece_area, with moments.
VextureShare vexture_piece_share(
    uvec4 texel, bool turns, VexturePiece piece, VextureEnds ends, VextureBox box, VextureFrame frame
) {
    VexturePath path = vexture_path_of(texel, turns, piece, ends, box, frame);
    VextureShare share = vexture_curve_share(piece, ends, path.corner);
    share = vexture_plus_share(share, vexture_share_beside(path.l0, path.l1), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(path.r0, path.r1), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(path.e1, path.r0), 1.0);
    return vexture_plus_share(share, vexture_share_beside(path.r1, path.e0), 1.0);
}

// Like vexture_flat_piece_area, with moments, for a box as the pixel.
VextureShare vexture_flat_piece_share(VexturePiece piece, VextureEnds ends) {
    vec2 origin = vec2(piece.falls.x ? 0.5 : -0.5, piece.falls.y ? 0.5 : -0.5);
    VextureCorner corner = VextureCorner(origin, vec2(-2.0 * origin.x, 0.0), vec2(0.0, -2.0 * origin.y));
    float from = piece.falls.x ? ends.leave.y : clamp(piece.d.y, 0.0, 1.0);
    float to = piece.falls.x ? clamp(piece.d.y + piece.way.y, 0.0, 1.0) : ends.enter.y;
    vec2 left = origin.y - 2.0 * origin.y * vec2(from, to);  // where it is left of the box
    VextureShare share = vexture_curve_share(piece, ends, corner);
    return vexture_plus_share(share, vexture_stretch_share(vec2(-0.5, left.x), vec2(-0.5, left.y)), 1.0);
}

// Share of a box above a height in 0..1.
VextureShare vexture_share_above(float y) {
    return vexture_stretch_share(vec2(-0.5, 0.5), vec2(-0.5, y - 0.5));
}

// Share that vexture_flat_look finds filled: the box above ends of the piece on the leaf's left edge and, unless the piece
// crosses the box, the box beside a piece on its left.
VextureShare vexture_flat_ends_share(uvec4 texel, bool crosses, VextureBox box) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p3 = vexture_word(texel.w);
    vec2 r0 = vexture_in_box(p0, box);
    vec2 r3 = vexture_in_box(p3, box);
    float passed = !crosses && max(r0.x, r3.x) <= 0.0 ? 1.0 : 0.0;
    float first = (p0.x == 0.0 ? 1.0 : 0.0) - passed;
    float last = (p3.x == 0.0 ? 1.0 : 0.0) - passed;
    VextureShare share = vexture_plus_share(vexture_area_share(0.0), vexture_share_above(clamp(r0.y, 0.0, 1.0)), first);
    return vexture_plus_share(share, vexture_share_above(clamp(r3.y, 0.0, 1.0)), -last);
}

#endif
