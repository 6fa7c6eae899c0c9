// Colour of a pixel from a planar map (FORMAT.md, part D): the mean of the map's colours over the pixel's footprint,
// premultiplied. In a cell it is that of the base paint, plus the jump in colour across each piece times the area that lies
// on the piece's right.
// Exports: vextureFlatColor, vextureColor.
#include "coverage.glsl"
#include "leaf.glsl"
#include "moment.glsl"
#include "paints.glsl"

uint vexture_leaf_kind(VextureCell cell) {
    return (cell.texel.z >> cell.shift) & ((1u << VEXTURE_COUNT_SHIFT) - 1u);
}

// Whether a paint in a leaf is a program.
bool vexture_holds_program(VextureCell cell) {
#if VEXTURE_GRADIENTS
    return (vexture_leaf_kind(cell) & uint(VEXTURE_HOLDS_PROGRAM)) != 0u;
#else
    return false;
#endif
}

// Whether the mean of a leaf is read and not its pieces: nothing else is known of it, or a paint in it is a program and it
// lies, all but the least share, in the footprint.
bool vexture_reads_mean(VextureCell cell, float share) {
    bool is_whole = vexture_holds_program(cell) && share > VEXTURE_NEARLY_WHOLE;
    return is_whole || vexture_leaf_kind(cell) == uint(VEXTURE_IS_MEAN);
}

// Adds a cell of this area without its pieces: of a quad, its mean about a place in its own unit square; of a leaf, its base
// paint over a region, or its mean.
void vexture_add_whole(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, bool is_mean, vec2 place, float area, VextureRegion region
) {
    if (cell.is_quad || is_mean) {
        uvec4 stored = vexture_texel(vexture_means_at(planar, cell.quad));
        float step = area * (float(VEXTURE_PAINT_ONE) / float(VEXTURE_COVERAGE_ONE));
        sum.color += step * (cell.is_quad ? vexture_mean_color(stored, place) : vexture_unpacked(stored[cell.shift >> 3]));
    } else {
        vexture_add_paint(sum, planar, vexture_base_paint(planar, cell), vec3(area, 0.0, 0.0), region);
    }
}

// The region about a place in a cell, in positions, as are its sides.
VextureRegion vexture_region(ivec2 origin, vec2 middle, vec2 right, vec2 up) {
    float unit = 1.0 / float(1 << VEXTURE_POSITION_BITS);
    return VextureRegion((vec2(origin) + middle) * unit, right * unit, up * unit);
}

// As vexture_first_look, of a pixel whose sides are level and upright; it needs no note of ends on the leaf's left edge.
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

// Adds those pieces of a leaf in the box of which there is a bit, as long as there is room for their paints.
void vexture_add_flat_pieces(
    inout VextureSum sum, inout int counted, inout VextureLeaf leaf, VexturePlanar planar, VextureBox box, float whole,
    VextureRegion region
) {
    while (counted != 0 && vexture_has_room(sum)) {
        int lowest = counted & -counted;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        counted ^= lowest;
        uvec4 texel = vexture_leaf_piece(leaf, i);
        VextureLook look = vexture_flat_look(texel, box);
        vec3 share = vec3(look.filled, 0.0, vexture_lift(texel, look.crosses, box));
        if (look.crosses) {
            VexturePiece piece = vexture_piece(texel, box);
            VextureEnds ends = vexture_ends(piece);
            share += vec3(vexture_flat_piece_area(piece, ends), vexture_moment(piece, ends));
        }
        uvec2 sides = vexture_leaf_sides(leaf, planar, i);
        vexture_add_piece(sum, planar, sides, whole * share, region);
    }
    vexture_settle(sum, planar, region);
}

// Adds the colour of the part of a cell in the box, times its share of the pixel, of whose area this is the inverse.
void vexture_add_flat_cell(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, ivec2 origin, VextureBox box, float inverse
) {
    float whole = box.size.x * box.size.y * inverse;
    float side = uintBitsToFloat(uint(127 - cell.bit) << 23);  // inverse
    vec2 middle = box.way + (box.part + 0.5) * box.size;
    bool is_mean = vexture_reads_mean(cell, min(box.size.x, box.size.y) * side);
    VextureRegion region = vexture_region(origin, middle, vec2(box.size.x, 0.0), vec2(0.0, box.size.y));
    vexture_add_whole(sum, planar, cell, is_mean, middle * side, whole, region);
    VextureLeaf leaf = vexture_leaf(cell);
    int count = cell.is_quad || is_mean ? 0 : vexture_count(cell);
    int counted = 0;  // a bit for each piece that is not clear of the box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_flat_look(vexture_leaf_piece(leaf, i), box);
        counted |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
#if VEXTURE_GRADIENTS
    while (counted != 0 || vexture_waits(sum)) {
        vexture_add_flat_pieces(sum, counted, leaf, planar, box, whole, region);
    }
#else
    vexture_add_flat_pieces(sum, counted, leaf, planar, box, whole, region);
#endif
}

// A premultiplied colour within its range; 0 for what is NaN.
vec4 vexture_held(vec4 color) {
    float alpha = color.a > 0.0 ? min(color.a, 1.0) : 0.0;
    return vec4(mix(vec3(0.0), min(color.rgb, alpha), greaterThan(color.rgb, vec3(0.0))), alpha);
}

// Parameters: the map's root quad; the others are those of vextureFlatCoverage.
vec4 vextureFlatColor(uint root, uvec2 base, vec2 offset, VextureFlat view) {
    VexturePlanar planar = vexture_planar(root);
    VexturePlace place = vexture_place(base, offset, view.extent);
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    VextureTop top = vexture_top(root);
    VextureSum sum = vexture_nothing();
    while (square.position.x < VEXTURE_NO_CELL) {
        VextureCell cell = vexture_descend(top, shared_bit, view.finest, square.position);
        ivec2 origin = square.position & -(1 << cell.bit);
        VextureBox box = vexture_box(origin, cell.bit, place, view.extent);
        vexture_add_flat_cell(sum, planar, cell, origin, box, view.inverse);
        square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
    }
    return vexture_held(sum.color / float(VEXTURE_PAINT_ONE));
}

// As vexture_add_flat_pieces, of any footprint. Moments count by the share `turned`.
void vexture_add_pieces(
    inout VextureSum sum, inout int counted, inout VextureLeaf leaf, VexturePlanar planar, VextureBox box,
    VextureFrame frame, float whole, float turned, VextureRegion region
) {
    while (counted != 0 && vexture_has_room(sum)) {
        int lowest = counted & -counted;
        int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
        counted ^= lowest;
        uvec4 texel = vexture_leaf_piece(leaf, i);
        VextureLook look = vexture_first_look(texel, box);
        vec3 share = vec3(whole * look.filled, 0.0, turned * vexture_lift(texel, look.crosses, box));
        if (look.crosses) {
            VexturePiece piece = vexture_piece(texel, box);
            VextureEnds ends = vexture_ends(piece);
            float area = vexture_piece_area(texel, look.turns, piece, ends, box, frame);
            share += vec3(area, turned * vexture_moment(piece, ends));
        }
        uvec2 sides = vexture_leaf_sides(leaf, planar, i);
        vexture_add_piece(sum, planar, sides, share, region);
    }
    vexture_settle(sum, planar, region);
}

// Adds the colour of the part of a footprint in a cell, times its area.
void vexture_add_cell(
    inout VextureSum sum, VexturePlanar planar, VextureCell cell, ivec2 origin, VextureBox box, VextureFrame frame
) {
    bool is_cut = any(greaterThan(box.low, -frame.extent)) || any(lessThan(box.low + box.size, frame.extent));
    float whole = 1.0;
    if (is_cut) {
        whole = vexture_box_area(frame, box.low, box.size);
    }
    vec2 place = vec2(0.5);
    if (cell.is_quad || vexture_holds_program(cell)) {
        place = vexture_cut_place(cell, box, frame);
    }
    float side = float(1 << cell.bit);
    bool is_mean = vexture_reads_mean(cell, whole * frame.size / (side * side));
    vec2 part = box.size / (2.0 * frame.extent);
    vec2 right = vec2(frame.up.y, -frame.up.x) * frame.size;
    vec2 up = vec2(-frame.right.y, frame.right.x) * frame.size;
    VextureRegion region = vexture_region(origin, place * side, part * right, part * up);
    vexture_add_whole(sum, planar, cell, is_mean, place, whole, region);
    // moments of the box as those of a footprint that is turned in it, whose parts lie as much nearer its middle
    float filled = whole * frame.size / (box.size.x * box.size.y);
    float turned = whole * sqrt(clamp(filled, 0.0, 1.0));
    VextureLeaf leaf = vexture_leaf(cell);
    int count = whole > 0.0 && !cell.is_quad && !is_mean ? vexture_count(cell) : 0;
    int counted = 0;  // a bit for each piece that is not clear of the footprint's box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_first_look(vexture_leaf_piece(leaf, i), box);
        counted |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
#if VEXTURE_GRADIENTS
    while (counted != 0 || vexture_waits(sum)) {
        vexture_add_pieces(sum, counted, leaf, planar, box, frame, whole, turned, region);
    }
#else
    vexture_add_pieces(sum, counted, leaf, planar, box, frame, whole, turned, region);
#endif
}

// Parameters: the map's root quad; the others are those of vextureCoverage.
vec4 vextureColor(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VexturePlanar planar = vexture_planar(root);
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.extent);
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    int finest = vexture_finest_bit(frame.size, frame.longer);
    VextureTop top = vexture_top(root);
    VextureSum sum = vexture_nothing();
    bool beside = false;
    while (square.position.x < VEXTURE_NO_CELL) {
        int bit = square.bit;
        if (!beside) {
            VextureCell cell = vexture_descend(top, shared_bit, finest, square.position);
            bit = cell.bit;
            ivec2 origin = square.position & -(1 << bit);
            vexture_add_cell(sum, planar, cell, origin, vexture_box(origin, bit, place, frame.extent), frame);
        }
        int side = 1 << bit;
        square = vexture_next_square(square.position, (square.position & -side) + side, place);
        if (square.position.x < VEXTURE_NO_CELL) {
            beside = vexture_is_beside(square, place, frame);
        }
    }
    return vexture_held(sum.color / float(VEXTURE_PAINT_ONE));
}
