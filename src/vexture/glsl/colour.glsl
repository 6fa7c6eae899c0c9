// Colour of a pixel from a planar map (FORMAT.md, part D): the mean of the map's colours over the pixel's footprint,
// premultiplied. In a cell it is that of the base paint, plus the jump in colour across each piece times the area that lies
// on the piece's right.
// Exports: VexturePlanar, vextureFlatColor, vextureColor.
//
// VEXTURE_LINEAR is 0 for a mean in sRGB, or 1 for one in linear light, with linear components. VEXTURE_GRADIENTS is 0 where
// no map has programs.
#include "coverage.glsl"
#include "gradient.glsl"
#include "leaf.glsl"
#include "srgb.glsl"

#ifndef VEXTURE_LINEAR
#define VEXTURE_LINEAR 0
#endif

// Where the parts of a map begin.
struct VexturePlanar {
    uint cells;   // less two texels for each quad before the first one
    uint sides;
    uint paints;
};

// The map with a root quad; its head comes before that.
VexturePlanar vexture_planar(uint root) {
    uvec4 head = vexture_texel(root - 1u);
    return VexturePlanar(head.y - 2u * root, head.z, head.w);
}

// A stored colour as what is averaged, premultiplied. In whole steps, sums of differences are exact.
vec4 vexture_averaged(vec4 stored) {
#if VEXTURE_LINEAR
    return vec4(vexture_linear(min(stored.rgb / max(stored.a, 1.0), 1.0)) * stored.a, stored.a);
#else
    return stored;
#endif
}

// Colour of a paint; of one that holds gradients, over a region.
vec4 vexture_paint(VexturePlanar planar, uint number, VextureRegion region) {
    uvec4 both = vexture_texel(planar.paints + (number >> 1));
    uvec2 words = (number & 1u) == 0u ? both.xy : both.zw;
    vec4 color = vexture_halves(words);
#if VEXTURE_GRADIENTS
    if (words.x != 0u && color.a == 0.0) {
        color = vexture_program(words.x, words.y, region);
    }
#endif
    return vexture_averaged(color);
}

// The colours of a pixel, times their areas. Pieces of a cell name the same few paints again and again, and of most nothing is
// left: where paints are programs, their areas are summed first, so that each is run once.
struct VextureSum {
    vec4 color;
#if VEXTURE_GRADIENTS
    uvec4 paints;
    vec4 areas;  // where 0 is room for another paint
#endif
};

VextureSum vexture_nothing() {
#if VEXTURE_GRADIENTS
    return VextureSum(vec4(0.0), uvec4(0u), vec4(0.0));
#else
    return VextureSum(vec4(0.0));
#endif
}

#if VEXTURE_GRADIENTS
// Whether the colour of a paint is still to be added.
bool vexture_waits(VextureSum sum) {
    return any(notEqual(sum.areas, vec4(0.0)));
}
#endif

// Whether there is room for the two paints beside a piece.
bool vexture_has_room(VextureSum sum) {
#if VEXTURE_GRADIENTS
    return dot(vec4(equal(sum.areas, vec4(0.0))), vec4(1.0)) > 1.5;
#else
    return true;
#endif
}

// Adds a paint over a region.
void vexture_add_paint(
    inout VextureSum sum, VexturePlanar planar, uint paint, float area, VextureRegion region
) {
#if VEXTURE_GRADIENTS
    int free = 0;
    int same = -1;
    for (int slot = 0; slot < 4; slot++) {
        bool is_free = sum.areas[slot] == 0.0;
        free = is_free ? slot : free;
        same = !is_free && sum.paints[slot] == paint ? slot : same;
    }
    int slot = same < 0 ? free : same;
    sum.paints[slot] = paint;
    sum.areas[slot] += area;
#else
    sum.color += area * vexture_paint(planar, paint, region);
#endif
}

// Adds the paint on the left of a piece, and takes away that on its right.
void vexture_add_piece(
    inout VextureSum sum, VexturePlanar planar, uint sides, float area, VextureRegion region
) {
#if VEXTURE_GRADIENTS
    vexture_add_paint(sum, planar, sides & 0xffffu, area, region);
    vexture_add_paint(sum, planar, sides >> VEXTURE_COORDINATE_BITS, -area, region);
#else
    vec4 right = vexture_paint(planar, sides >> VEXTURE_COORDINATE_BITS, region);
    sum.color += area * (vexture_paint(planar, sides & 0xffffu, region) - right);
#endif
}

// Adds the colours of paints of which only the areas are known.
void vexture_settle(inout VextureSum sum, VexturePlanar planar, VextureRegion region) {
#if VEXTURE_GRADIENTS
    while (vexture_waits(sum)) {
        int slot = sum.areas.x != 0.0 ? 0 : sum.areas.y != 0.0 ? 1 : sum.areas.z != 0.0 ? 2 : 3;
        sum.color += sum.areas[slot] * vexture_paint(planar, sum.paints[slot], region);
        sum.areas[slot] = 0.0;
    }
#endif
}

// In steps of a byte.
vec4 vexture_unpacked(uint word) {
    return vexture_averaged(vec4(uvec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24)));
}

// Mean of a quad about a place in its own unit square: as vexture_mean, in steps of a byte.
vec4 vexture_mean_color(uvec4 stored, vec2 place) {
    vec2 at = 2.0 * place - 0.5;
    vec4 low = mix(vexture_unpacked(stored.x), vexture_unpacked(stored.y), at.x);
    vec4 high = mix(vexture_unpacked(stored.z), vexture_unpacked(stored.w), at.x);
    return clamp(mix(low, high, at.y), 0.0, float(VEXTURE_COVERAGE_ONE));
}

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
    uint at = planar.cells + 2u * cell.quad;
    uvec4 stored = vexture_texel(cell.is_quad || is_mean ? at : at + 1u);
    uint word = stored[cell.shift >> 3];
    float step = area * (float(VEXTURE_PAINT_ONE) / float(VEXTURE_COVERAGE_ONE));
    if (cell.is_quad) {
        sum.color += step * vexture_mean_color(stored, place);
    } else if (is_mean) {
        sum.color += step * vexture_unpacked(word);
    } else {
        vexture_add_paint(sum, planar, word, area, region);
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

// Adds the colour of the part of a cell in the box, times its area.
void vexture_add_flat_cell(inout VextureSum sum, VexturePlanar planar, VextureCell cell, ivec2 origin, VextureBox box) {
    float whole = box.size.x * box.size.y;
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
#else
    {  // a loop would turn once, which costs a tenth of the time
#endif
        while (counted != 0 && vexture_has_room(sum)) {
            int lowest = counted & -counted;
            int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
            counted ^= lowest;
            uvec4 texel = vexture_leaf_piece(leaf, i);
            VextureLook look = vexture_flat_look(texel, box);
            float area = look.filled;
            if (look.crosses) {
                area += vexture_flat_piece_area(texel, box);
            }
            uint sides = vexture_leaf_sides(leaf, planar.sides, i);
            vexture_add_piece(sum, planar, sides, whole * area, region);
        }
        vexture_settle(sum, planar, region);
    }
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
        vexture_add_flat_cell(sum, planar, cell, origin, vexture_box(origin, cell.bit, place, view.extent));
        square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
    }
    return vexture_held(sum.color * (view.inverse / float(VEXTURE_PAINT_ONE)));
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
    VextureLeaf leaf = vexture_leaf(cell);
    int count = whole > 0.0 && !cell.is_quad && !is_mean ? vexture_count(cell) : 0;
    int counted = 0;  // a bit for each piece that is not clear of the footprint's box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_first_look(vexture_leaf_piece(leaf, i), box);
        counted |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
#if VEXTURE_GRADIENTS
    while (counted != 0 || vexture_waits(sum)) {
#else
    {
#endif
        while (counted != 0 && vexture_has_room(sum)) {
            int lowest = counted & -counted;
            int i = (floatBitsToInt(float(lowest)) >> 23) - 127;
            counted ^= lowest;
            uvec4 texel = vexture_leaf_piece(leaf, i);
            VextureLook look = vexture_first_look(texel, box);
            float area = whole * look.filled;
            if (look.crosses) {
                area += vexture_piece_area(texel, look.turns, box, frame);
            }
            uint sides = vexture_leaf_sides(leaf, planar.sides, i);
            vexture_add_piece(sum, planar, sides, area, region);
        }
        vexture_settle(sum, planar, region);
    }
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
