// Coverage of a pixel by a shape in a packed texture: the exact area of the shape in the pixel's footprint.
// Exports: vextureCoverage.
#include "tree.glsl"
#include "piece.glsl"

// Position of a cell's lattice relative to the pixel.
struct VextureLattice {
    ivec2 whole;  // the pixel's centre in lattice units: the whole units
    vec2 part;    // and the rest; one float cannot hold both
    vec2 low;     // the part of the footprint's box that lies in the cell, relative to the centre
    vec2 high;
    VextureFrame frame;  // from offsets in lattice units
};

VextureLattice vexture_lattice(ivec2 origin, int level, VexturePlace place, VextureFrame frame) {
    int finer = VEXTURE_POSITION_BITS - level - VEXTURE_LATTICE_BITS;  // bits of a position below a lattice unit
    int coarser = max(-finer, 0);
    finer = max(finer, 0);
    ivec2 way = place.point - origin;
    ivec2 whole = (way >> finer) << coarser;
    vec2 part = (vec2(way & ((1 << finer) - 1)) + place.rest) * (float(1 << coarser) / float(1 << finer));
    float unit = VEXTURE_LATTICE * float(1 << level);  // lattice units in the unit square
    vec2 reach = frame.reach * unit;
    frame.right /= unit;
    frame.up /= unit;
    frame.size *= unit * unit;
    vec2 low = max(vec2(-whole) - part, -reach);
    vec2 high = min(vec2((1 << VEXTURE_LATTICE_BITS) - whole) - part, reach);
    return VextureLattice(whole, part, low, high, frame);
}

// Filled area of the pixel within one cell.
float vexture_cell_area(VextureCell cell, VextureLattice lattice) {
    int code = cell.is_quad ? 0 : vexture_winding_code(cell);
    uint curve = vexture_first_curve(cell);
    int count = code == 0 ? 0 : vexture_count(cell);
    int winding = code - VEXTURE_WINDING_OFFSET;
    vec2 low = lattice.low;
    vec2 high = lattice.high;
    int crossing = 0;  // a bit for each piece that may cross the footprint's box
    for (int i = 0; i < count; i++) {
        VexturePiece piece = vexture_piece(vexture_texel(curve + uint(i)), lattice.whole, lattice.part);
        if (piece.starts_left && piece.ends_left) {
            continue;  // on the left edge: its ends there cancel it
        }
        winding += piece.starts_left && piece.p0.y <= low.y ? 1 : 0;
        winding -= piece.ends_left && piece.p3.y <= low.y ? 1 : 0;
        bool turns = (piece.starts_left && piece.p0.y > low.y && piece.p0.y < high.y)
            || (piece.ends_left && piece.p3.y > low.y && piece.p3.y < high.y);
        int side = vexture_clear_side(piece, low, high);
        bool crosses = turns || side == VEXTURE_CROSSING;
        winding += crosses ? 0 : side;
        crossing |= crosses ? 1 << i : 0;
    }
    float filled = code == 0 ? vexture_stored_coverage(cell) : float(winding);
    float area = filled * vexture_box_area(lattice.frame, low, high);
    while (crossing != 0) {
        int lowest = crossing & -crossing;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        crossing ^= lowest;
        VexturePiece piece = vexture_piece(vexture_texel(curve + uint(i)), lattice.whole, lattice.part);
        area += vexture_piece_area(piece, lattice.frame, low, high);
    }
    return area;
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it; the
// steps to the next pixels (dFdx, dFdy of the position), taken in uniform control flow.
//
// The cells that the footprint touches are visited row by row from below; most pixels touch one. The lowest cell of a row
// determines its height; cells that reach into it from below have been counted.
float vextureCoverage(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.reach);
    int shared_levels = vexture_shared_levels(place.low, place.high);
    int finest = vexture_finest_level(frame.size, frame.reach);
    VextureTop top = VextureTop(root, 0);
    ivec2 position = place.low;
    int row = place.low.y;
    int next_row = place.high.y + 1;
    int cells = place.low.x <= place.high.x && place.low.y <= place.high.y ? VEXTURE_MOST_CELLS : 0;
    float area = 0.0;
    while (cells > 0) {
        VextureCell cell = vexture_descend(top, shared_levels, finest, position);
        int bits = VEXTURE_POSITION_BITS - cell.level;
        ivec2 origin = (position >> bits) << bits;
        ivec2 beyond = origin + (1 << bits);
        VextureLattice lattice = vexture_lattice(origin, cell.level, place, frame);
        bool counted = (origin.y < row && row != place.low.y) || any(greaterThanEqual(lattice.low, lattice.high));
        float more = vexture_cell_area(cell, lattice);
        area += counted ? 0.0 : more;
        next_row = min(next_row, beyond.y);
        bool row_ends = beyond.x > place.high.x;
        row = row_ends ? next_row : row;
        position = row_ends ? ivec2(place.low.x, row) : ivec2(beyond.x, row);
        next_row = row_ends ? place.high.y + 1 : next_row;
        cells = row > place.high.y ? 0 : cells - 1;
    }
    area *= frame.turned;
    return area > 0.0 ? min(area, 1.0) : 0.0;  // also 0 if a parameter is NaN
}

float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy) {
    return vextureCoverage(root, uvec2(0u), uv, dx, dy);
}
