// Colour of a pixel from a planar map (FORMAT.md, part D): the mean of the map's colours over the pixel's footprint,
// premultiplied. In a cell it is the colour of the base paint, plus, for each piece, the jump in colour across the piece
// times the area on its right.
// Exports: vextureFlatColor, vextureColor.
#include "coverage.glsl"
#include "leaf.glsl"
#include "moment.glsl"
#include "paints.glsl"

uint vexture_leaf_kind(VextureCell cell) {
    return (cell.texel.z >> cell.shift) & ((1u << VEXTURE_COUNT_SHIFT) - 1u);
}

// Returns whether a paint in a leaf is a program.
bool vexture_holds_program(VextureCell cell) {
#if VEXTURE_GRADIENTS
    return (vexture_leaf_kind(cell) & uint(VEXTURE_HOLDS_PROGRAM)) != 0u;
#else
    return false;
#endif
}

// Returns whether the mean of a leaf is read instead of its pieces: if the leaf has only a mean, or if one of its paints
// is a program and nearly all of the leaf lies in the footprint.
bool vexture_reads_mean(VextureCell cell, float share) {
    bool is_whole = vexture_holds_program(cell) && share > VEXTURE_NEARLY_WHOLE;
    return is_whole || vexture_leaf_kind(cell) == uint(VEXTURE_IS_MEAN);
}

// Adds the stored mean of a cell, times its area; the mean of a quad near a point in its own unit square.
void vexture_add_mean(inout VextureSum sum, VexturePlanar planar, VextureCell cell, vec2 place, float area) {
    uvec4 stored = vexture_texel(vexture_means_at(planar, cell.quad));
    float step = area * (float(VEXTURE_PAINT_ONE) / float(VEXTURE_COVERAGE_ONE));
#if VEXTURE_GRADIENTS
    step = sum.done == 0u ? step : 0.0;
#endif
    sum.color += step * (cell.is_quad ? vexture_mean_color(stored, place) : vexture_unpacked(stored[cell.shift >> 3]));
}

// Region of a pixel with these sides, in positions.
VextureRegion vexture_region(VexturePlace place, vec2 right, vec2 up) {
    float unit = 1.0 / float(1 << VEXTURE_POSITION_BITS);
    return VextureRegion((vec2(place.point) + place.rest) * unit, right * unit, up * unit);
}

// Like vexture_first_look, for a pixel with horizontal and vertical sides; ends on the leaf's left edge need no flag.
VextureLook vexture_flat_look(uvec4 texel, VextureBox box) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p3 = vexture_word(texel.w);
    vec2 r0 = vexture_in_box(p0, box);
    vec2 r3 = vexture_in_box(p3, box);
    float y0 = clamp(r0.y, 0.0, 1.0);
    float y3 = clamp(r3.y, 0.0, 1.0);
    float filled = vexture_above_ends(p0, p3, y0, y3);
    float right = max(r0.x, r3.x);
    filled += right <= 0.0 ? y0 - y3 : 0.0;
    float left = right > 0.0 ? min(r0.x, r3.x) : 1.0;
    return VextureLook(filled, false, left < 1.0 && y0 != y3);
}

// Share of the box that a piece fills, with its moments if a program needs them.
VextureShare vexture_flat_filled_share(uvec4 texel, VextureLook look, VextureBox box, bool has_moments) {
#if VEXTURE_GRADIENTS
    if (has_moments) {
        VextureShare share = vexture_flat_ends_share(texel, look.crosses, box);
        if (look.crosses) {
            VexturePiece piece = vexture_piece(texel, box);
            share = vexture_plus_share(share, vexture_flat_piece_share(piece, vexture_ends(piece)), 1.0);
        }
        return share;
    }
#endif
    float area = look.filled;
    if (look.crosses) {
        VexturePiece piece = vexture_piece(texel, box);
        area += vexture_flat_piece_area(piece, vexture_ends(piece));
    }
    return vexture_area_share(area);
}

// Adds the colours of a leaf in the box, given the box's sides and centre in the pixel.
void vexture_add_flat_leaf(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, VextureBox box, vec2 sides, vec2 middle
) {
    VextureLeaf leaf = vexture_leaf(cell);
    int count = vexture_count(cell);
    int crossing = 0;  // a bit for each piece that is not clear of the box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_flat_look(vexture_leaf_piece(leaf, i), box);
        crossing |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
    bool has_moments = vexture_holds_program(cell);
    VextureShare whole = vexture_moved_share(vexture_whole_share(), sides, middle);
    vexture_add_base(sum, planar, vexture_base_paint(planar, cell), whole);
    while (crossing != 0) {
        int lowest = crossing & -crossing;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        crossing ^= lowest;
        uvec4 texel = vexture_leaf_piece(leaf, i);
        VextureShare share = vexture_flat_filled_share(texel, vexture_flat_look(texel, box), box, has_moments);
        vexture_add_piece(sum, planar, vexture_leaf_sides(leaf, planar, i), vexture_moved_share(share, sides, middle));
    }
}

// Adds the colour of the part of a cell in the box.
void vexture_add_flat_cell(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, VextureBox box, VextureFlat view
) {
    float side = uintBitsToFloat(uint(127 - cell.bit) << 23);  // inverse
    if (cell.is_quad || vexture_reads_mean(cell, min(box.size.x, box.size.y) * side)) {
        vec2 place = (box.way + (box.part + 0.5) * box.size) * side;
        vexture_add_mean(sum, planar, cell, place, box.size.x * box.size.y * view.inverse);
    } else {
        vec2 across = 0.5 / view.extent;
        vexture_add_flat_leaf(sum, planar, cell, box, across * box.size, across * (box.low + 0.5 * box.size));
    }
}

// Clamps a premultiplied colour to its range; NaN becomes 0.
vec4 vexture_held(vec4 color) {
    float alpha = color.a > 0.0 ? min(color.a, 1.0) : 0.0;
    return vec4(mix(vec3(0.0), min(color.rgb, alpha), greaterThan(color.rgb, vec3(0.0))), alpha);
}

// Parameters: the map's root quad, then as in vextureFlatCoverage.
vec4 vextureFlatColor(uint root, uvec2 base, vec2 offset, VextureFlat view) {
    VexturePlanar planar = vexture_planar(root);
    VexturePlace place = vexture_place(base, offset, view.extent);
    VextureRegion region = vexture_region(place, vec2(2.0 * view.extent.x, 0.0), vec2(0.0, 2.0 * view.extent.y));
    VextureSum sum = vexture_nothing();
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    VextureTop top = vexture_top(root);
    while (square.position.x < VEXTURE_NO_CELL || vexture_holds_kept(sum)) {
        bool is_over = vexture_holds_kept(sum) && square.position.x >= VEXTURE_NO_CELL;
        VextureCell cell = vexture_descend(top, shared_bit, is_over ? VEXTURE_NO_CELL : view.finest, square.position);
        ivec2 origin = square.position & -(1 << cell.bit);
        bool is_left = true;
        while (is_left) {
            if (is_over) {
                vexture_add_kept(sum, planar);
            } else {
                vexture_add_flat_cell(sum, planar, cell, vexture_box(origin, cell.bit, place, view.extent), view);
            }
            is_left = vexture_settle(sum, planar, region);
        }
        if (!is_over) {
            square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
        }
    }
    return vexture_held(sum.color / float(VEXTURE_PAINT_ONE));
}

// Like vexture_flat_filled_share, for any footprint; `whole` is its share in the cell.
VextureShare vexture_filled_share(
    uvec4 texel, VextureLook look, VextureBox box, VextureFrame frame, VextureShare whole, bool has_moments
) {
    VextureShare share = vexture_plus_share(vexture_area_share(0.0), whole, look.filled);
    if (look.crosses) {
        VexturePiece piece = vexture_piece(texel, box);
        VextureEnds ends = vexture_ends(piece);
#if VEXTURE_GRADIENTS
        if (has_moments) {
            return vexture_plus_share(share, vexture_piece_share(texel, look.turns, piece, ends, box, frame), 1.0);
        }
#endif
        share.area += vexture_piece_area(texel, look.turns, piece, ends, box, frame);
    }
    return share;
}

// Like vexture_add_flat_leaf, for any footprint.
void vexture_add_leaf(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, VextureBox box, VextureFrame frame, VextureShare whole
) {
    VextureLeaf leaf = vexture_leaf(cell);
    int count = whole.area > 0.0 ? vexture_count(cell) : 0;
    int crossing = 0;  // a bit for each piece that is not clear of the footprint's box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_first_look(vexture_leaf_piece(leaf, i), box);
        crossing |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
    bool has_moments = vexture_holds_program(cell);
    vexture_add_base(sum, planar, vexture_base_paint(planar, cell), whole);
    while (crossing != 0) {
        int lowest = crossing & -crossing;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        crossing ^= lowest;
        uvec4 texel = vexture_leaf_piece(leaf, i);
        VextureLook look = vexture_first_look(texel, box);
        VextureShare share = vexture_filled_share(texel, look, box, frame, whole, has_moments);
        vexture_add_piece(sum, planar, vexture_leaf_sides(leaf, planar, i), share);
    }
}

// Adds the colour of the part of a footprint in a cell, times its area.
void vexture_add_cell(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, VextureBox box, VextureFrame frame
) {
    bool is_cut = any(greaterThan(box.low, -frame.extent)) || any(lessThan(box.low + box.size, frame.extent));
    VextureShare whole = vexture_whole_share();
    if (is_cut) {
#if VEXTURE_GRADIENTS
        whole = vexture_box_share(frame, box.low, box.size);
#else
        whole.area = vexture_box_area(frame, box.low, box.size);
#endif
    }
    float side = float(1 << cell.bit);
    if (cell.is_quad || vexture_reads_mean(cell, whole.area * frame.size / (side * side))) {
        vexture_add_mean(sum, planar, cell, cell.is_quad ? vexture_cut_place(cell, box, frame) : vec2(0.5), whole.area);
    } else {
        vexture_add_leaf(sum, planar, cell, box, frame, whole);
    }
}

// Parameters: the map's root quad, then as in vextureCoverage.
vec4 vextureColor(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VexturePlanar planar = vexture_planar(root);
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.extent);
    int finest = vexture_finest_bit(frame.size, frame.longer);
    vec2 right = vec2(frame.up.y, -frame.up.x) * frame.size;
    VextureRegion region = vexture_region(place, right, vec2(-frame.right.y, frame.right.x) * frame.size);
    VextureSum sum = vexture_nothing();
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    VextureTop top = vexture_top(root);
    bool beside = false;
    while (square.position.x < VEXTURE_NO_CELL || vexture_holds_kept(sum)) {
        bool is_over = vexture_holds_kept(sum) && square.position.x >= VEXTURE_NO_CELL;
        int bit = square.bit;
        if (!beside) {
            VextureCell cell = vexture_descend(top, shared_bit, is_over ? VEXTURE_NO_CELL : finest, square.position);
            bit = cell.bit;
            ivec2 origin = square.position & -(1 << bit);
            bool is_left = true;
            while (is_left) {
                if (is_over) {
                    vexture_add_kept(sum, planar);
                } else {
                    vexture_add_cell(sum, planar, cell, vexture_box(origin, bit, place, frame.extent), frame);
                }
                is_left = vexture_settle(sum, planar, region);
            }
        }
        int side = 1 << bit;
        beside = false;
        if (!is_over) {
            square = vexture_next_square(square.position, (square.position & -side) + side, place);
            beside = square.position.x < VEXTURE_NO_CELL && vexture_is_beside(square, place, frame);
        }
    }
    return vexture_held(sum.color / float(VEXTURE_PAINT_ONE));
}
