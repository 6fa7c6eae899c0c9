// Colour of a pixel from a planar map (FORMAT.md, part D): the mean of the map's colours over the pixel's footprint,
// premultiplied. In a cell it is that of the base paint, plus the jump in colour across each piece times the area that lies
// on the piece's right.
// Exports: VexturePlanar, vextureFlatColor, vextureColor.
//
// VEXTURE_LINEAR is 0 for a mean in sRGB, or 1 for one in linear light, with linear components.
#include "coverage.glsl"
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

vec4 vexture_paint(VexturePlanar planar, uint number) {
    uvec4 both = vexture_texel(planar.paints + (number >> 1));
    uvec2 words = (number & 1u) == 0u ? both.xy : both.zw;
    return vexture_averaged(vec4(uvec4(words.x & 0xffffu, words.x >> 16, words.y & 0xffffu, words.y >> 16)));
}

// Colour on the left of a piece minus that on its right.
vec4 vexture_jump(VexturePlanar planar, uint curve) {
    uint sides = vexture_texel(planar.sides + (curve >> 2))[curve & 3u];
    return vexture_paint(planar, sides & 0xffffu) - vexture_paint(planar, sides >> VEXTURE_COORDINATE_BITS);
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

// Colour of a cell without its pieces: of a quad, its mean about a place in its own unit square; of a leaf, its base paint,
// or its mean if that is all that is known of it.
vec4 vexture_cell_color(VexturePlanar planar, VextureCell cell, vec2 place) {
    bool is_mean = ((cell.texel.z >> cell.shift) & 255u) == uint(VEXTURE_IS_MEAN);
    uint at = planar.cells + 2u * cell.quad;
    uvec4 stored = vexture_texel(cell.is_quad || is_mean ? at : at + 1u);
    uint word = stored[cell.shift >> 3];
    float step = float(VEXTURE_PAINT_ONE) / float(VEXTURE_COVERAGE_ONE);
    if (cell.is_quad) {
        return step * vexture_mean_color(stored, place);
    }
    return is_mean ? step * vexture_unpacked(word) : vexture_paint(planar, word);
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
void vexture_add_flat_cell(inout vec4 color, VexturePlanar planar, VextureCell cell, VextureBox box) {
    float whole = box.size.x * box.size.y;
    float side = uintBitsToFloat(uint(127 - cell.bit) << 23);
    vec2 place = (box.way + (box.part + 0.5) * box.size) * side;
    color += whole * vexture_cell_color(planar, cell, place);
    uint curve = vexture_first_curve(cell);
    int count = cell.is_quad ? 0 : vexture_count(cell);
    int counted = 0;  // a bit for each piece that is not clear of the box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_flat_look(vexture_texel(curve + uint(i)), box);
        counted |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
    while (counted != 0) {
        int lowest = counted & -counted;
        uint at = curve + (floatBitsToUint(float(lowest)) >> 23) - 127u;
        counted ^= lowest;
        uvec4 texel = vexture_texel(at);
        VextureLook look = vexture_flat_look(texel, box);
        float area = look.filled;
        if (look.crosses) {
            area += vexture_flat_piece_area(texel, box);
        }
        color += whole * area * vexture_jump(planar, at);
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
    vec4 color = vec4(0.0);
    while (square.position.x < VEXTURE_NO_CELL) {
        VextureCell cell = vexture_descend(top, shared_bit, view.finest, square.position);
        ivec2 origin = square.position & -(1 << cell.bit);
        vexture_add_flat_cell(color, planar, cell, vexture_box(origin, cell.bit, place, view.extent));
        square = vexture_next_square(square.position, origin + (1 << cell.bit), place);
    }
    return vexture_held(color * (view.inverse / float(VEXTURE_PAINT_ONE)));
}

// Adds the colour of the part of a footprint in a cell, times its area.
void vexture_add_cell(inout vec4 color, VexturePlanar planar, VextureCell cell, VextureBox box, VextureFrame frame) {
    bool is_cut = any(greaterThan(box.low, -frame.extent)) || any(lessThan(box.low + box.size, frame.extent));
    float whole = 1.0;
    if (is_cut) {
        whole = vexture_box_area(frame, box.low, box.size);
    }
    vec2 place = vec2(0.5);
    if (cell.is_quad) {
        place = vexture_cut_place(cell, box, frame);
    }
    color += whole * vexture_cell_color(planar, cell, place);
    uint curve = vexture_first_curve(cell);
    int count = whole > 0.0 && !cell.is_quad ? vexture_count(cell) : 0;
    int counted = 0;  // a bit for each piece that is not clear of the footprint's box: others need no colours
    for (int i = 0; i < count; i++) {
        VextureLook look = vexture_first_look(vexture_texel(curve + uint(i)), box);
        counted |= look.crosses || look.filled != 0.0 ? 1 << i : 0;
    }
    while (counted != 0) {
        int lowest = counted & -counted;
        uint at = curve + (floatBitsToUint(float(lowest)) >> 23) - 127u;
        counted ^= lowest;
        uvec4 texel = vexture_texel(at);
        VextureLook look = vexture_first_look(texel, box);
        float area = whole * look.filled;
        if (look.crosses) {
            area += vexture_piece_area(texel, look.turns, box, frame);
        }
        color += area * vexture_jump(planar, at);
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
    vec4 color = vec4(0.0);
    bool beside = false;
    while (square.position.x < VEXTURE_NO_CELL) {
        int bit = square.bit;
        if (!beside) {
            VextureCell cell = vexture_descend(top, shared_bit, finest, square.position);
            bit = cell.bit;
            ivec2 origin = square.position & -(1 << bit);
            vexture_add_cell(color, planar, cell, vexture_box(origin, bit, place, frame.extent), frame);
        }
        int side = 1 << bit;
        square = vexture_next_square(square.position, (square.position & -side) + side, place);
        if (square.position.x < VEXTURE_NO_CELL) {
            beside = vexture_is_beside(square, place, frame);
        }
    }
    return vexture_held(color / float(VEXTURE_PAINT_ONE));
}
