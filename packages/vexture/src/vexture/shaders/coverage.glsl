// Coverage of a pixel by a shape in a packed texture: the exact area of the shape in the pixel's footprint.
// Exports: vextureCoverage.
#include "flat.glsl"
#include "pixel.glsl"

// A box as a parallelogram in the footprint's frame.
struct VextureCorner {
    vec2 origin;
    vec2 x;  // its sides
    vec2 y;
};

// Corner of the box at which a piece's coordinates, which may be mirrored, begin.
VextureCorner vexture_corner(bvec2 falls, VextureBox box, VextureFrame frame) {
    vec2 low = vec2(falls.x ? box.low.x + box.size.x : box.low.x, falls.y ? box.low.y + box.size.y : box.low.y);
    float x = falls.x ? -box.size.x : box.size.x;
    float y = falls.y ? -box.size.y : box.size.y;
    vec2 origin = vexture_into_frame(frame, low);
    return VextureCorner(origin, vec2(frame.right.x, frame.up.x) * x, vec2(frame.right.y, frame.up.y) * y);
}

vec2 vexture_from_corner(VextureCorner corner, float x, float y) {
    return corner.origin + corner.x * x + corner.y * y;
}

// Number of parts into which a piece is divided because of its bend.
int vexture_piece_parts(VexturePiece piece, VextureEnds ends, VextureCorner corner) {
    vec2 slope = vexture_slope(piece, ends.start);
    vec2 first = corner.x * slope.x + corner.y * slope.y;
    slope = vexture_slope(piece, ends.end);
    vec2 last = corner.x * slope.x + corner.y * slope.y;
    vec2 p = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    vec2 chord = vexture_from_corner(corner, ends.leave.x, ends.leave.y) - p;
    float bend = (ends.end - ends.start) * (abs(vexture_cross(first, chord)) + abs(vexture_cross(last, chord)));
    return 1 + int(min(VEXTURE_BEND * bend, VEXTURE_MOST_PARTS - 1.0));
}

// Area of the pixel beside a piece between its ends, summed over parts: the area beside each part's chord, plus the area
// between part and chord times the share of the chord in the pixel.
float vexture_curve_area(VexturePiece piece, VextureEnds ends, VextureCorner corner) {
    int parts = vexture_piece_parts(piece, ends, corner);
    float step_t = (ends.end - ends.start) / float(parts);
    vec2 p = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    vec2 slope = vexture_slope(piece, ends.start);
    vec2 first = corner.x * slope.x + corner.y * slope.y;
    float area = 0.0;
    float t = ends.start;
    while (parts > 0) {
        parts--;
        t = parts == 0 ? ends.end : t + step_t;
        vec2 next = parts == 0 ? ends.leave : vexture_at(piece, t);
        slope = vexture_slope(piece, t);
        vec2 q = vexture_from_corner(corner, next.x, next.y);
        vec2 last = corner.x * slope.x + corner.y * slope.y;
        area += vexture_beside(p, q) + vexture_bulge(step_t / 3.0, first, last, q - p) * vexture_part_inside(p, q);
        p = q;
        first = last;
    }
    return area;
}

// Path along the box's sides that closes a piece: the box's left side while the piece is left of the box, and back on the
// box's right side.
struct VexturePath {
    VextureCorner corner;
    vec2 l0;
    vec2 l1;
    vec2 r0;
    vec2 r1;
    vec2 e0;
    vec2 e1;
};

// If the piece `turns`, an end of it lies on the leaf's left edge and in the box, and the part of the box above that end is
// included with the sign of its winding.
VexturePath vexture_path_of(
    uvec4 texel, bool turns, VexturePiece piece, VextureEnds ends, VextureBox box, VextureFrame frame
) {
    VextureCorner corner = vexture_corner(piece.falls, box, frame);
    bool falls = piece.falls.x;
    float top = piece.falls.y ? 0.0 : 1.0;
    float y0 = clamp(piece.d.y, 0.0, 1.0);
    float y3 = clamp(piece.d.y + piece.way.y, 0.0, 1.0);
    y0 = turns && (texel.x & 0xffffu) == 0u ? top : y0;
    y3 = turns && (texel.w & 0xffffu) == 0u ? top : y3;
    float left = falls ? 1.0 : 0.0;
    float right = 1.0 - left;
    float left_end = falls ? y3 : ends.enter.y;
    float right_end = falls ? ends.enter.y : y0;
    float left_start = falls ? ends.leave.y : y0;
    float right_start = falls ? y3 : ends.leave.y;
    vec2 l0 = vexture_from_corner(corner, left, left_start);
    vec2 l1 = vexture_from_corner(corner, left, left_end);
    vec2 r0 = vexture_from_corner(corner, right, right_start);
    vec2 r1 = vexture_from_corner(corner, right, right_end);
    vec2 e0 = vexture_from_corner(corner, ends.enter.x, right_end);
    vec2 e1 = vexture_from_corner(corner, ends.leave.x, right_start);
    return VexturePath(corner, l0, l1, r0, r1, e0, e1);
}

// Area on the right of a piece inside the box; negative if the piece goes up.
float vexture_piece_area(
    uvec4 texel, bool turns, VexturePiece piece, VextureEnds ends, VextureBox box, VextureFrame frame
) {
    VexturePath path = vexture_path_of(texel, turns, piece, ends, box, frame);
    vec2 level = vexture_slopes(frame.right.x, frame.up.x);
    vec2 upright = vexture_slopes(frame.right.y, frame.up.y);
    float area = vexture_beside_sloped(path.l0, path.l1.y, upright) + vexture_beside_sloped(path.r0, path.r1.y, upright);
    area += vexture_beside_sloped(path.e1, path.r0.y, level) + vexture_beside_sloped(path.r1, path.e0.y, level);
    return area + vexture_curve_area(piece, ends, path.corner);
}

// Centre of the part of a quad in the footprint, in the quad's own unit square: the quad's mean near this point is nearly
// the mean over that part.
vec2 vexture_cut_place(VextureCell cell, VextureBox box, VextureFrame frame) {
    vec2 middle = box.low + 0.5 * box.size;
    vec2 at = vexture_into_frame(frame, middle);
    vec2 x = abs(vec2(frame.right.x, frame.up.x)) * box.size.x;
    vec2 y = abs(vec2(frame.right.y, frame.up.y)) * box.size.y;
    vec2 reach = 0.5 * (x + y);
    vec2 low = max(at - reach, -0.5);
    vec2 high = min(at + reach, 0.5);
    vec2 moved = VEXTURE_DRAWN * (0.5 * (low + high) - at);
    // back from the frame
    vec2 dx = vec2(frame.up.y, -frame.up.x) * frame.size;
    vec2 dy = vec2(-frame.right.y, frame.right.x) * frame.size;
    middle += dx * moved.x + dy * moved.y;
    float side = uintBitsToFloat(uint(127 - cell.bit) << 23);
    vec2 place = (box.way + box.part * box.size + (middle - box.low)) * side;
    return clamp(place, 0.0, 1.0);
}

// Share of the box above the ends of a piece that lie on the leaf's left edge, with the sign of their windings.
float vexture_above_ends(vec2 p0, vec2 p3, float y0, float y3) {
    return (p0.x == 0.0 ? 1.0 - y0 : 0.0) - (p3.x == 0.0 ? 1.0 - y3 : 0.0);
}

// Result from the ends of a piece alone.
struct VextureLook {
    float filled;  // share of the box that the piece fills, without the part that only a close look finds
    bool turns;    // an end lies on the leaf's left edge and in the box
    bool crosses;  // the piece may cross the box, and needs a close look
};

VextureLook vexture_first_look(uvec4 texel, VextureBox box) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p3 = vexture_word(texel.w);
    vec2 r0 = vexture_in_box(p0, box);
    vec2 r3 = vexture_in_box(p3, box);
    float y0 = clamp(r0.y, 0.0, 1.0);
    float y3 = clamp(r3.y, 0.0, 1.0);
    bool is_left = max(r0.x, r3.x) <= 0.0;
    bool is_right = min(r0.x, r3.x) >= 1.0;
    float passed = is_left ? y0 - y3 : 0.0;
    bool crosses = fract(passed) != 0.0 || (!is_left && !is_right && y0 != y3);
    VextureLook look = VextureLook(crosses ? 0.0 : passed, false, crosses);
    if (p0.x * p3.x == 0.0) {
        float above = vexture_above_ends(p0, p3, y0, y3);
        bool cancels = p0.x == p3.x;  // a piece on the left edge, with its ends there
        look.turns = fract(above) != 0.0;
        look.crosses = (look.turns || crosses) && !cancels;
        look.filled = (look.turns && !cancels ? 0.0 : above) + (look.crosses ? 0.0 : passed);
    }
    return look;
}

// Filled area of the pixel within one cell.
float vexture_cell_area(VextureCell cell, VextureBox box, VextureFrame frame) {
    bool is_cut = any(greaterThan(box.low, -frame.extent)) || any(lessThan(box.low + box.size, frame.extent));
    float whole = 1.0;
    if (is_cut) {
        whole = vexture_box_area(frame, box.low, box.size);
    }
    if (cell.is_quad) {
        return whole * vexture_mean(cell.texel.w, vexture_cut_place(cell, box, frame));
    }
    int code = vexture_winding_code(cell);
    uint curve = vexture_first_curve(cell);
    int count = whole > 0.0 ? vexture_count(cell) : 0;
    float filled = code == 0 ? vexture_stored_coverage(cell) : float(code - VEXTURE_WINDING_OFFSET);
    int crossing = 0;  // a bit for each piece that may cross the footprint's box,
    int turning = 0;   // and for each with an end on the leaf's left edge and in the box
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_first_look(vexture_texel(curve + uint(i)), box);
        filled += look.filled;
        turning |= look.turns ? 1 << i : 0;
        crossing |= look.crosses ? 1 << i : 0;
    }
    float area = filled * whole;
    while (crossing != 0) {
        int lowest = crossing & -crossing;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        crossing ^= lowest;
        uvec4 texel = vexture_texel(curve + uint(i));
        VexturePiece piece = vexture_piece(texel, box);
        area += vexture_piece_area(texel, (turning & lowest) != 0, piece, vexture_ends(piece), box, frame);
    }
    return area;
}

// Whether a square of cells lies beside the footprint, though not beside its box.
bool vexture_is_beside(VextureSquare square, VexturePlace place, VextureFrame frame) {
    int side = 1 << square.bit;
    vec2 way = vec2((square.position & -side) - place.point) - place.rest;
    vec2 at = vexture_into_frame(frame, way + 0.5 * float(side));
    vec2 reach = 0.5 + 0.5 * float(side) * (abs(vec2(frame.right.x, frame.up.x)) + abs(vec2(frame.right.y, frame.up.y)));
    return any(greaterThan(abs(at), reach));
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it; the
// steps to the next pixels (dFdx, dFdy of the position), taken in uniform control flow.
float vextureCoverage(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.extent);
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    int finest = vexture_finest_bit(frame.size, frame.longer);
    VextureTop top = vexture_top(root);
    float area = 0.0;
    bool beside = false;
    while (square.position.x < VEXTURE_NO_CELL) {
        VextureCell cell = vexture_descend(top, shared_bit, beside ? VEXTURE_NO_CELL : finest, square.position);
        cell.bit = beside ? square.bit : cell.bit;
        ivec2 origin = square.position & -(1 << cell.bit);
        float more = vexture_cell_area(cell, vexture_box(origin, cell.bit, place, frame.extent), frame);
        area += beside ? 0.0 : more;
        square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
        if (square.position.x < VEXTURE_NO_CELL) {
            beside = vexture_is_beside(square, place, frame);
        }
    }
    return area > 0.0 ? min(area, 1.0) : 0.0;  // also 0 if a parameter is NaN
}

float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy) {
    return vextureCoverage(root, uvec2(0u), uv, dx, dy);
}
