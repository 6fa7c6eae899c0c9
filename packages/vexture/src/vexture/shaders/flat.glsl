// Coverage of a pixel with horizontal and vertical sides in the drawing, in views in which all pixels are equal: the
// result of vextureCoverage, with less work and half its registers.
// Exports: VextureFlat, vextureFlat, vextureFlatCoverage.
#include "piece.glsl"

// Values that all pixels of a view share.
struct VextureFlat {
    vec2 extent;  // half a pixel, in positions
    float inverse;  // of its area
    int finest;   // bit of the finest cells
};

// Parameters: the steps to the next pixels, each along one axis.
VextureFlat vextureFlat(vec2 dx, vec2 dy) {
    vec2 extent = max(0.5 * (abs(dx) + abs(dy)), 0.5 * VEXTURE_SMALLEST_PIXEL) * float(1 << VEXTURE_POSITION_BITS);
    float area = 4.0 * extent.x * extent.y;
    float longer = 2.0 * max(extent.x, extent.y);
    return VextureFlat(extent, 1.0 / area, vexture_finest_bit(area, longer * longer));
}

// Area of the box to the right of a piece; negative if the piece rises.
float vexture_flat_piece_area(VexturePiece piece, VextureEnds ends) {
    vec2 chord = ends.leave - ends.enter;
    vec2 first = vexture_slope(piece, ends.start);
    vec2 last = vexture_slope(piece, ends.end);
    float bulge = vexture_bulge((ends.end - ends.start) / 3.0, first, last, chord);
    float left = 0.5 * (ends.enter.x + ends.leave.x) * chord.y + bulge;
    float y0 = clamp(piece.d.y, 0.0, 1.0);
    float y3 = clamp(piece.d.y + piece.way.y, 0.0, 1.0);
    float area = piece.falls.x ? y3 - ends.leave.y + left : ends.leave.y - y0 - left;
    return piece.falls.y ? area : -area;
}

// Filled share of the box.
float vexture_flat_cell_area(VextureCell cell, VextureBox box) {
    if (cell.is_quad) {
        float side = uintBitsToFloat(uint(127 - cell.bit) << 23);
        return vexture_mean(cell.texel.w, (box.way + (box.part + 0.5) * box.size) * side);
    }
    int code = vexture_winding_code(cell);
    uint curve = vexture_first_curve(cell);
    int count = vexture_count(cell);
    float filled = code == 0 ? vexture_stored_coverage(cell) : float(code - VEXTURE_WINDING_OFFSET);
    int crossing = 0;  // a bit for each piece that may cross the box
    for (int i = 0; i < count; i++) {
        uvec4 texel = vexture_texel(curve + uint(i));
        vec2 p0 = vexture_word(texel.x);
        vec2 p3 = vexture_word(texel.w);
        vec2 r0 = vexture_in_box(p0, box);
        vec2 r3 = vexture_in_box(p3, box);
        float y0 = clamp(r0.y, 0.0, 1.0);
        float y3 = clamp(r3.y, 0.0, 1.0);
        filled += p0.x == 0.0 ? 1.0 - y0 : 0.0;
        filled -= p3.x == 0.0 ? 1.0 - y3 : 0.0;
        float right = max(r0.x, r3.x);
        filled += right <= 0.0 ? y0 - y3 : 0.0;
        float left = right > 0.0 ? min(r0.x, r3.x) : 1.0;
        crossing |= left < 1.0 && y0 != y3 ? 1 << i : 0;
    }
    while (crossing != 0) {
        int lowest = crossing & -crossing;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        crossing ^= lowest;
        VexturePiece piece = vexture_piece(vexture_texel(curve + uint(i)), box);
        filled += vexture_flat_piece_area(piece, vexture_ends(piece));
    }
    return filled;
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it.
float vextureFlatCoverage(uint root, uvec2 base, vec2 offset, VextureFlat view) {
    VexturePlace place = vexture_place(base, offset, view.extent);
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    VextureTop top = vexture_top(root);
    float area = 0.0;
    while (square.position.x < VEXTURE_NO_CELL) {
        VextureCell cell = vexture_descend(top, shared_bit, view.finest, square.position);
        ivec2 origin = square.position & -(1 << cell.bit);
        VextureBox box = vexture_box(origin, cell.bit, place, view.extent);
        area += vexture_flat_cell_area(cell, box) * (box.size.x * box.size.y);
        square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
    }
    area *= view.inverse;
    return area > 0.0 ? min(area, 1.0) : 0.0;  // also 0 if a parameter is NaN
}
