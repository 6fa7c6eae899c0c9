// The paints of a planar map (FORMAT.md, D.5), and a sum of them.
// Exports: VexturePlanar, VextureSum, vexture_planar, vexture_nothing, vexture_add_paint, vexture_add_piece, vexture_settle.
//
// VEXTURE_LINEAR is 0 for a mean in sRGB, or 1 for one in linear light, with linear components. VEXTURE_GRADIENTS is 0 where
// no map has programs.
#include "gradient.glsl"
#include "srgb.glsl"

#ifndef VEXTURE_LINEAR
#define VEXTURE_LINEAR 0
#endif

// Where the parts of a map begin.
struct VexturePlanar {
    uint root;
    uint cells;
    uint sides;
    uint paints;
    uint packing;  // logarithm of how many numbers of paints are in a word
};

// The map with a root quad; its head comes before that.
VexturePlanar vexture_planar(uint root) {
    uvec4 head = vexture_texel(root - 1u);
    uint packing = head.x > uint(VEXTURE_MOST_HALF_PAINTS) ? 0u : head.x > uint(VEXTURE_MOST_BYTE_PAINTS) ? 1u : 2u;
    return VexturePlanar(root, head.y, head.z, head.w, packing);
}

// The texel of the means of a quad's cells. Before those of each quad, or two, or four, is one of base paints.
uint vexture_means_at(VexturePlanar planar, uint quad) {
    uint place = quad - planar.root;
    return planar.cells + 1u + place + (place >> planar.packing);
}

// The number at a place among others that fill words, of which `word` is that of the place.
uint vexture_numbered(VexturePlanar planar, uint word, uint place) {
    uint bits = 32u >> planar.packing;
    return (word >> (bits * (place & ((1u << planar.packing) - 1u)))) & (0xffffffffu >> (32u - bits));
}

// Number of the base paint of a leaf.
uint vexture_base_paint(VexturePlanar planar, VextureCell cell) {
    uint place = cell.quad - planar.root;
    uint block = place >> planar.packing;
    uvec4 numbers = vexture_texel(planar.cells + (block << planar.packing) + block);
    uint k = 4u * place + (cell.shift >> 3);
    return vexture_numbered(planar, numbers[(k >> planar.packing) & 3u], k);
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
// left: where paints are programs, their shares are summed first, so that each is run once, about the middle of its part.
struct VextureSum {
    vec4 color;
#if VEXTURE_GRADIENTS
    uvec4 paints;
    vec4 areas;   // as shares of the pixel, and first moments about the middle of a region's box, in its sides. Where all
    vec4 across;  // are nothing is room for another paint
    vec4 up;
#endif
};

VextureSum vexture_nothing() {
#if VEXTURE_GRADIENTS
    return VextureSum(vec4(0.0), uvec4(0u), vec4(0.0), vec4(0.0), vec4(0.0));
#else
    return VextureSum(vec4(0.0));
#endif
}

#if VEXTURE_GRADIENTS
// Which of the four are taken.
bvec4 vexture_taken(VextureSum sum) {
    return greaterThan(abs(sum.areas) + abs(sum.across) + abs(sum.up), vec4(VEXTURE_LEAST_SHARE));
}

// Whether the colour of a paint is still to be added.
bool vexture_waits(VextureSum sum) {
    return any(vexture_taken(sum));
}
#endif

// Whether there is room for the two paints beside a piece.
bool vexture_has_room(VextureSum sum) {
#if VEXTURE_GRADIENTS
    return dot(vec4(vexture_taken(sum)), vec4(1.0)) < 2.5;
#else
    return true;
#endif
}

// Adds a paint over a part of a region: its area, and its moments.
void vexture_add_paint(inout VextureSum sum, VexturePlanar planar, uint paint, vec3 share, VextureRegion region) {
#if VEXTURE_GRADIENTS
    bvec4 taken = vexture_taken(sum);
    int free = 0;
    int same = -1;
    for (int slot = 0; slot < 4; slot++) {
        free = taken[slot] ? free : slot;
        same = taken[slot] && sum.paints[slot] == paint ? slot : same;
    }
    int slot = same < 0 ? free : same;
    sum.paints[slot] = paint;
    sum.areas[slot] += share.x;
    sum.across[slot] += share.y;
    sum.up[slot] += share.z;
#else
    sum.color += share.x * vexture_paint(planar, paint, region);
#endif
}

// Adds the paint on the left of a piece, and takes away that on its right.
void vexture_add_piece(inout VextureSum sum, VexturePlanar planar, uvec2 sides, vec3 share, VextureRegion region) {
#if VEXTURE_GRADIENTS
    vexture_add_paint(sum, planar, sides.x, share, region);
    vexture_add_paint(sum, planar, sides.y, -share, region);
#else
    vec4 right = vexture_paint(planar, sides.y, region);
    sum.color += share.x * (vexture_paint(planar, sides.x, region) - right);
#endif
}

// The part of a region about a place, given about the middle of its box and in the box's sides. As far as to the nearer side
// it is right for a straight border along an axis, and a straight ramp only needs the place.
VextureRegion vexture_part(VextureRegion region, vec2 place) {
    vec2 held = clamp(place, -0.5, 0.5);
    vec2 size = abs(region.right) + abs(region.up);
    vec2 share = 1.0 - 2.0 * abs(held);
    return VextureRegion(region.point + held * size, region.right * share, region.up * share);
}

// Adds the colours of paints of which only the shares are known.
void vexture_settle(inout VextureSum sum, VexturePlanar planar, VextureRegion region) {
#if VEXTURE_GRADIENTS
    bvec4 taken = vexture_taken(sum);
    while (any(taken)) {
        int slot = taken.x ? 0 : taken.y ? 1 : taken.z ? 2 : 3;
        float area = sum.areas[slot];
        if (area != 0.0) {
            VextureRegion part = vexture_part(region, vec2(sum.across[slot], sum.up[slot]) / area);
            sum.color += area * vexture_paint(planar, sum.paints[slot], part);
        }
        taken[slot] = false;
    }
    sum.areas = vec4(0.0);
    sum.across = vec4(0.0);
    sum.up = vec4(0.0);
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
