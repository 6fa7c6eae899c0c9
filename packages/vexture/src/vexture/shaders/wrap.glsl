// Coverage of pixels anywhere: outside the unit square is nothing, the border's value, or the repeated shape.
// Exports: VextureSpot, vexture_spot, VextureTiles, vexture_tiles, vexture_tile, vexture_spot_coverage, vextureWrapped.
//
// VEXTURE_WRAP selects one of VEXTURE_WRAP_NONE, VEXTURE_WRAP_CLAMP or VEXTURE_WRAP_REPEAT. VEXTURE_FLAT is 1 for views
// whose pixels are equal upright rectangles in the drawing, which cost less, or 0 for any view.
#include "coverage.glsl"

#ifndef VEXTURE_WRAP
#define VEXTURE_WRAP VEXTURE_WRAP_NONE
#endif
#ifndef VEXTURE_FLAT
#define VEXTURE_FLAT 0
#endif

// A pixel's footprint, moved to the position where the shape is looked up.
struct VextureSpot {
    uvec2 base;   // its centre: 32-bit fixed point (1.0 = 2^32)
    vec2 offset;  // and an offset from it
    vec2 dx;      // steps to the next pixels
    vec2 dy;
    vec2 reach;   // half its box
};

// Fixed point as a float, which loses its last bits.
vec2 vexture_fraction(uvec2 base) {
    return vec2(base) * exp2(-32.0);
}

VextureSpot vexture_spot(uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    vec2 reach = 0.5 * (abs(dx) + abs(dy));
#if VEXTURE_WRAP == VEXTURE_WRAP_CLAMP
    // a footprint that would leave the square is moved, one larger than the square is shrunk
    vec2 shrink = min((VEXTURE_WHOLE_TILE - VEXTURE_BORDER) / max(reach, VEXTURE_SMALLEST_PIXEL), 1.0);
    dx *= shrink;
    dy *= shrink;
    reach *= shrink;
    vec2 inset = reach + VEXTURE_BORDER;
    offset = clamp(offset, inset - vexture_fraction(base), 1.0 - inset - vexture_fraction(base));
#elif VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    // the sum of fixed-point numbers drops whole tiles by overflow, and loses nothing else
    float unit = exp2(16.0);
    offset = clamp(offset, -0.5 * unit + 1.0, 0.5 * unit - 1.0);
    vec2 steps = floor(offset * unit);
    base += uvec2(ivec2(steps)) << 16;
    offset -= steps / unit;
#endif
    return VextureSpot(base, offset, dx, dy, reach);
}

// The tiles that a footprint touches where a shape is repeated, at most two in each direction.
struct VextureTiles {
    int count;
    int columns;
    uvec2 next_base;   // in the next tile the base is on the border between the two, where positions of both are exact
    vec2 next_offset;
    float whole;       // share of the whole shape's mean in the result, for a footprint about as large as a tile
};

VextureTiles vexture_tiles(VextureSpot spot) {
    float whole = (max(spot.reach.x, spot.reach.y) - VEXTURE_NEARLY_TILE) / (VEXTURE_WHOLE_TILE - VEXTURE_NEARLY_TILE);
    whole = clamp(whole, 0.0, 1.0);
    vec2 place = vexture_fraction(spot.base) + spot.offset;
    vec2 margin = spot.reach + VEXTURE_BORDER;
    bvec2 left = lessThan(place, margin);
    bvec2 right = greaterThan(place, 1.0 - margin);
    vec2 from_left = (vec2(spot.base) + 1.0) * exp2(-32.0);
    vec2 from_right = (vec2(~spot.base) + 1.0) * exp2(-32.0);
    uvec2 next_base = uvec2(left.x ? ~0u : 0u, left.y ? ~0u : 0u);
    vec2 next_offset = spot.offset + mix(-from_right, from_left, left);
    int columns = left.x || right.x ? 2 : 1;
    int rows = left.y || right.y ? 2 : 1;
    return VextureTiles(whole < 1.0 ? columns * rows : 0, columns, next_base, next_offset, whole);
}

// Footprint in one of these tiles.
VextureSpot vexture_tile(VextureTiles tiles, VextureSpot spot, int tile) {
    bool next_column = (tile & (tiles.columns - 1)) == 1;
    bool next_row = tile >= tiles.columns;
    spot.base.x = next_column ? tiles.next_base.x : spot.base.x;
    spot.base.y = next_row ? tiles.next_base.y : spot.base.y;
    spot.offset.x = next_column ? tiles.next_offset.x : spot.offset.x;
    spot.offset.y = next_row ? tiles.next_offset.y : spot.offset.y;
    return spot;
}

// Stored coverage of the whole square.
float vexture_mean_coverage(uint root) {
    return vexture_mean(vexture_texel(root).w, vec2(0.5));
}

float vexture_coverage_at(uint root, VextureSpot spot) {
#if VEXTURE_FLAT
    return vextureFlatCoverage(root, spot.base, spot.offset, vextureFlat(spot.dx, spot.dy));
#else
    return vextureCoverage(root, spot.base, spot.offset, spot.dx, spot.dy);
#endif
}

// A repeated shape is the sum over the tiles that the footprint touches.
float vexture_spot_coverage(uint root, VextureSpot spot) {
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    VextureTiles tiles = vexture_tiles(spot);
    float sum = 0.0;
    for (int tile = 0; tile < tiles.count; tile++) {
        sum += vexture_coverage_at(root, vexture_tile(tiles, spot, tile));
    }
    return mix(min(sum, 1.0), vexture_mean_coverage(root), tiles.whole);
#else
    return vexture_coverage_at(root, spot);
#endif
}

// Parameters: those of vextureCoverage; the position may lie anywhere.
float vextureWrapped(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    return vexture_spot_coverage(root, vexture_spot(base, offset, dx, dy));
}

float vextureWrapped(uint root, vec2 uv, vec2 dx, vec2 dy) {
    return vextureWrapped(root, uvec2(0u), uv, dx, dy);
}
