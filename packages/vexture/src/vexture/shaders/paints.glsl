// The paints of a planar map (FORMAT.md, D.5), and a sum of them.
// Exports: VexturePlanar, VextureSum, vexture_planar, vexture_nothing, vexture_add_paint, vexture_add_piece, vexture_settle.
//
// VEXTURE_LINEAR is 0 for a mean in sRGB, or 1 for a mean in linear light, with linear components. VEXTURE_GRADIENTS is 0
// if no map has programs.
#include "gradient.glsl"
#include "moment.glsl"
#include "srgb.glsl"

#ifndef VEXTURE_LINEAR
#define VEXTURE_LINEAR 0
#endif

// First texel of each part of a map.
struct VexturePlanar {
    uint root;
    uint cells;
    uint sides;
    uint paints;
    uint packing;  // logarithm to base 2 of the count of paint numbers in a word
};

// Reads the head of a map, which precedes its root quad.
VexturePlanar vexture_planar(uint root) {
    uvec4 head = vexture_texel(root - 1u);
    uint packing = head.x > uint(VEXTURE_MOST_HALF_PAINTS) ? 0u : head.x > uint(VEXTURE_MOST_BYTE_PAINTS) ? 1u : 2u;
    return VexturePlanar(root, head.y, head.z, head.w, packing);
}

// Index of the texel with the means of a quad's cells. A texel of base paints precedes each block of 1, 2 or 4 quads.
uint vexture_means_at(VexturePlanar planar, uint quad) {
    uint place = quad - planar.root;
    return planar.cells + 1u + place + (place >> planar.packing);
}

// Number at a place in a sequence of packed numbers; `word` is the word that contains it.
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

// Converts a stored colour to the premultiplied colour that is averaged. Sums of differences of whole steps are exact.
vec4 vexture_averaged(vec4 stored) {
#if VEXTURE_LINEAR
    return vec4(vexture_linear(min(stored.rgb / max(stored.a, 1.0), 1.0)) * stored.a, stored.a);
#else
    return stored;
#endif
}

uvec2 vexture_paint_words(VexturePlanar planar, uint number) {
    uvec4 both = vexture_texel(planar.paints + (number >> 1));
    return (number & 1u) == 0u ? both.xy : both.zw;
}

// Returns whether a paint is a program: its opacity is 0, but its first word is not.
bool vexture_is_program(uvec2 words) {
    return words.x != 0u && words.y >> 16 == 0u;
}

// Sum of a pixel's colours, times their areas. The pieces of a cell name the same few paints again and again, and most of
// their shares cancel. The shares of programs are summed first, so that each program runs once, over its part of the cell.
// There is room for four programs: those with the smallest numbers above `done`. The others are left for another round.
struct VextureSum {
    vec4 color;
#if VEXTURE_GRADIENTS
    uint kept;     // program that fills whole cells, within the pixel, and its share:
    VextureShare kept_share;  // across the borders of cells, it runs once
    uint done;
    bool is_left;
    float cell;    // area of the cell within the pixel
    uvec4 paints;  // 0 is a free slot, because paint 0 is no program
    vec4 areas;    // of each paint the parts of its share
    vec4 x;
    vec4 y;
    vec4 xx;
    vec4 xy;
    vec4 yy;
#endif
};

VextureSum vexture_nothing() {
#if VEXTURE_GRADIENTS
    vec4 none = vec4(0.0);
    return VextureSum(none, 0u, vexture_area_share(0.0), 0u, false, 0.0, uvec4(0u), none, none, none, none, none, none);
#else
    return VextureSum(vec4(0.0));
#endif
}

#if VEXTURE_GRADIENTS
// Slot for a paint: its own, else a free one, else the slot of the greatest number if that is greater than its own; else 4.
int vexture_slot(VextureSum sum, uint paint) {
    int best = 0;
    for (int slot = 0; slot < 4; slot++) {
        if (sum.paints[slot] == paint) {
            return slot;
        }
        bool is_freer = sum.paints[slot] - 1u > sum.paints[best] - 1u;  // 0 is the greatest
        best = is_freer ? slot : best;
    }
    return sum.paints[best] - 1u >= paint ? best : 4;
}

// Adds a program's share if there is room.
void vexture_add_program(inout VextureSum sum, uint paint, VextureShare share) {
    int slot = vexture_slot(sum, paint);
    bool is_new = slot < 4 && sum.paints[slot & 3] != paint;
    sum.is_left = sum.is_left || slot == 4 || (is_new && sum.paints[slot & 3] != 0u);
    if (slot < 4) {
        float kept = is_new ? 0.0 : 1.0;
        sum.paints[slot] = paint;
        sum.areas[slot] = kept * sum.areas[slot] + share.area;
        sum.x[slot] = kept * sum.x[slot] + share.x;
        sum.y[slot] = kept * sum.y[slot] + share.y;
        sum.xx[slot] = kept * sum.xx[slot] + share.xx;
        sum.xy[slot] = kept * sum.xy[slot] + share.xy;
        sum.yy[slot] = kept * sum.yy[slot] + share.yy;
    }
}
#endif

// Adds a paint over a part of a region.
void vexture_add_paint(inout VextureSum sum, VexturePlanar planar, uint paint, VextureShare share) {
#if VEXTURE_GRADIENTS
    if (paint > sum.done) {
        uvec2 words = uvec2(1u, 0u);  // as of a program: its share is summed already
        if (!any(equal(sum.paints, uvec4(paint)))) {
            words = vexture_paint_words(planar, paint);
        }
        if (vexture_is_program(words)) {
            vexture_add_program(sum, paint, share);
        } else if (sum.done == 0u) {
            sum.color += share.area * vexture_averaged(vexture_halves(words));
        }
    }
#else
    sum.color += share.area * vexture_averaged(vexture_halves(vexture_paint_words(planar, paint)));
#endif
}

// Returns whether a program is kept.
bool vexture_holds_kept(VextureSum sum) {
#if VEXTURE_GRADIENTS
    return sum.kept != 0u;
#else
    return false;
#endif
}

// Adds the kept program.
void vexture_add_kept(inout VextureSum sum, VexturePlanar planar) {
#if VEXTURE_GRADIENTS
    vexture_add_paint(sum, planar, sum.kept, sum.kept_share);
    sum.kept = 0u;
    sum.cell = VEXTURE_NO_SHARE;  // so that no share fills the cell: the program would be kept forever
#endif
}

// Adds the base paint of a cell, over the cell's part of the pixel.
void vexture_add_base(inout VextureSum sum, VexturePlanar planar, uint paint, VextureShare share) {
#if VEXTURE_GRADIENTS
    sum.cell = share.area;
#endif
    vexture_add_paint(sum, planar, paint, share);
}

// Adds the paint on the left of a piece, and subtracts the paint on its right.
void vexture_add_piece(inout VextureSum sum, VexturePlanar planar, uvec2 sides, VextureShare share) {
    vexture_add_paint(sum, planar, sides.x, share);
    vexture_add_paint(sum, planar, sides.y, vexture_plus_share(vexture_area_share(0.0), share, -1.0));
}

#if VEXTURE_GRADIENTS
// Parallelogram with the moments of a share of a region. Its centre is the share's, and its sides are the region's times
// the symmetric root of the share's covariance, which is 1 for a whole region.
VextureRegion vexture_part(VextureRegion region, VextureShare share) {
    vec2 at = clamp(vec2(share.x, share.y) / share.area, -0.5, 0.5);
    float xx = clamp(12.0 * (share.xx / share.area - at.x * at.x), 0.0, 3.0);
    float yy = clamp(12.0 * (share.yy / share.area - at.y * at.y), 0.0, 3.0);
    float most = sqrt(xx * yy);
    float xy = clamp(12.0 * (share.xy / share.area - at.x * at.y), -most, most);
    float root = sqrt(max(xx * yy - xy * xy, 0.0));
    float inverse = 1.0 / sqrt(max(xx + yy + 2.0 * root, VEXTURE_NOTHING));
    vec2 right = inverse * ((xx + root) * region.right + xy * region.up);
    vec2 up = inverse * (xy * region.right + (yy + root) * region.up);
    return VextureRegion(region.point + at.x * region.right + at.y * region.up, right, up);
}

#endif

// Adds the colours of the programs whose shares are summed; returns whether more programs are left.
bool vexture_settle(inout VextureSum sum, VexturePlanar planar, VextureRegion region) {
#if VEXTURE_GRADIENTS
    uint last = sum.done;
    for (int slot = 0; slot < 4; slot++) {
        float area = sum.areas[slot];
        if (sum.paints[slot] != 0u && abs(area) > VEXTURE_LEAST_SHARE) {
            uint paint = sum.paints[slot];
            VextureShare share = VextureShare(area, sum.x[slot], sum.y[slot], sum.xx[slot], sum.xy[slot], sum.yy[slot]);
            if (abs(area - sum.cell) <= 1.0 - VEXTURE_NEARLY_WHOLE) {
                // it fills the cell: it is kept, and another program that was kept before runs
                bool is_same = paint == sum.kept;
                VextureShare before = sum.kept_share;
                sum.kept_share = vexture_plus_share(share, before, is_same ? 1.0 : 0.0);
                uint kept = is_same ? 0u : sum.kept;
                sum.kept = paint;
                paint = kept;
                share = before;
            }
            if (paint != 0u) {
                uvec2 words = vexture_paint_words(planar, paint);
                vec4 color = vexture_program(words.x, words.y, vexture_part(region, share), share.area);
                sum.color += share.area * vexture_averaged(color);
            }
        }
        last = max(last, sum.paints[slot]);
    }
    bool is_left = sum.is_left;
    sum.done = is_left ? last : 0u;
    sum.is_left = false;
    sum.paints = uvec4(0u);
    return is_left;
#else
    return false;
#endif
}

// Unpacks a stored mean, 0..255.
vec4 vexture_unpacked(uint word) {
    return vexture_averaged(vec4(uvec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24)));
}

// Mean colour of a quad near a point of its own unit square, like vexture_mean; 0..255.
vec4 vexture_mean_color(uvec4 stored, vec2 place) {
    vec2 at = 2.0 * place - 0.5;
    vec4 low = mix(vexture_unpacked(stored.x), vexture_unpacked(stored.y), at.x);
    vec4 high = mix(vexture_unpacked(stored.z), vexture_unpacked(stored.w), at.x);
    return clamp(mix(low, high, at.y), 0.0, float(VEXTURE_COVERAGE_ONE));
}
