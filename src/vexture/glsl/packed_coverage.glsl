// Coverage of a pixel by a shape in a packed texture: the exact area of the shape in the pixel's footprint.
// Exports: vextureCoverage.
#include "packed_tree.glsl"
#include "packed_piece.glsl"

// Area of the pixel that is filled, within one leaf and within the box from low to high (relative to the pixel's centre,
// in lattice units of the leaf; the centre in those units).
float vexture_leaf_area(VextureCell cell, vec2 center, VextureFrame frame, vec2 low, vec2 high) {
    int code = vexture_winding_code(cell);
    if (code == 0) {
        float stored = vexture_stored_coverage(cell);
        return stored == 0.0 ? 0.0 : stored * vexture_beside_box(frame, low, high);
    }
    int winding = code - VEXTURE_WINDING_OFFSET;
    float area = winding == 0 ? 0.0 : float(winding) * vexture_beside_box(frame, low, high);
    uint curve = vexture_first_curve(cell);
    int count = vexture_count(cell);
    for (int i = 0; i < VEXTURE_MOST_CURVES; i++) {
        if (i >= count) {
            break;
        }
        VexturePiece piece = vexture_piece(vexture_texel(curve + uint(i)), center);
        if (piece.starts_left && piece.p0.y < high.y) {
            area += vexture_beside_box(frame, vec2(low.x, max(low.y, piece.p0.y)), high);
        }
        if (piece.ends_left && piece.p3.y < high.y) {
            area -= vexture_beside_box(frame, vec2(low.x, max(low.y, piece.p3.y)), high);
        }
        area += vexture_piece_area(piece, frame, low, high);
    }
    return area;
}

// The same for any cell, given by its level and a position in it.
float vexture_cell_area(VextureCell cell, int level, ivec2 position, VexturePlace place, VextureFrame frame) {
    int bits = VEXTURE_POSITION_BITS - level;
    ivec2 origin = (position >> bits) << bits;
    float scale = VEXTURE_LATTICE / float(1 << bits);
    vec2 center = (vec2(place.point - origin) + place.rest) * scale;
    float unit = scale * float(1 << VEXTURE_POSITION_BITS);  // lattice units in the unit square
    frame.right /= unit;
    frame.up /= unit;
    vec2 reach = frame.reach * unit;
    vec2 low = max(-center, -reach);
    vec2 high = min(VEXTURE_LATTICE - center, reach);
    if (any(greaterThanEqual(low, high))) {
        return 0.0;
    }
    if (cell.is_quad) {
        return vexture_stored_coverage(cell) * vexture_beside_box(frame, low, high);
    }
    return vexture_leaf_area(cell, center, frame, low, high);
}

// Sum over the cells that the footprint touches, row by row from below. A row is as high as its lowest cell; cells that
// reach into it from below have been counted.
float vexture_sum_cells(VextureCell top, int shared_levels, VexturePlace place, VextureFrame frame) {
    int finest = clamp(int(floor(VEXTURE_LEVEL_BIAS - log2(frame.extent))) + VEXTURE_LEVELS_BELOW, 1, VEXTURE_MOST_DEPTH);
    float area = 0.0;
    ivec2 position = place.low;
    int row = place.low.y;
    int next_row = place.high.y + 1;
    for (int i = 0; i < VEXTURE_MOST_CELLS; i++) {
        VextureCell cell = top;
        int level = shared_levels;
        for (int j = 0; j < VEXTURE_MOST_DEPTH; j++) {
            cell = vexture_below(cell, level, position);
            level++;
            if (!cell.is_quad || level >= finest) {
                break;
            }
        }
        int bits = VEXTURE_POSITION_BITS - level;
        ivec2 origin = (position >> bits) << bits;
        ivec2 beyond = origin + (1 << bits);
        if (origin.y >= row || row == place.low.y) {
            area += vexture_cell_area(cell, level, position, place, frame);
        }
        next_row = min(next_row, beyond.y);
        position.x = beyond.x;
        if (position.x > place.high.x) {
            row = next_row;
            position = ivec2(place.low.x, row);
            next_row = place.high.y + 1;
            if (row > place.high.y) {
                break;
            }
        }
    }
    return area;
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it; the
// steps to the next pixels (dFdx, dFdy of the position), taken where all pixels of a group still run together.
float vextureCoverage(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.reach);
    if (any(greaterThan(place.low, place.high))) {
        return 0.0;
    }
    int shared_levels = vexture_shared_levels(place.low, place.high);
    VextureCell cell = vexture_root(root);
    int level = 0;
    for (int i = 0; i < VEXTURE_MOST_DEPTH; i++) {
        if (level >= shared_levels || !cell.is_quad) {
            break;
        }
        cell = vexture_below(cell, level, place.low);
        level++;
    }
    float area = cell.is_quad ? vexture_sum_cells(cell, level, place, frame)
                              : vexture_cell_area(cell, level, place.low, place, frame);
    return clamp(frame.turned * area, 0.0, 1.0);
}

float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy) {
    return vextureCoverage(root, uvec2(0u), uv, dx, dy);
}
