// The share of a box around each position that a shape fills: the raster that water.glsl reads beside the shape.
// Exports: vextureTexelOf, vextureSpread.
#include "wrap.glsl"
#include "around.glsl"

// Whether no outline, however small, passes through a box: then all its cells are constant and equal. A cell with curves
// counts as crossed.
bool vexture_is_clear(uint root, VextureSpot spot) {
    VexturePlace place = vexture_place(spot.base, spot.offset, spot.reach);
    int shared_levels = vexture_shared_levels(place.low, place.high);
    VextureTop top = VextureTop(root, 0);
    ivec2 position = place.low;
    int next_row = place.high.y + 1;
    int cells = VEXTURE_MOST_CELLS;
    float lowest = 1.0;
    float highest = 0.0;
    while (cells > 0) {
        VextureCell cell = vexture_descend(top, shared_levels, VEXTURE_MOST_DEPTH, position);
        float filled = cell.is_quad || vexture_winding_code(cell) != 0 ? 0.5 : vexture_stored_coverage(cell);
        lowest = min(lowest, filled);
        highest = max(highest, filled);
        int bits = VEXTURE_POSITION_BITS - cell.level;
        ivec2 beyond = ((position >> bits) + 1) << bits;
        next_row = min(next_row, beyond.y);
        bool row_ends = beyond.x > place.high.x;
        position = row_ends ? ivec2(place.low.x, next_row) : ivec2(beyond.x, position.y);
        next_row = row_ends ? place.high.y + 1 : next_row;
        bool is_mixed = highest > 0.0 && lowest < 1.0;
        cells = is_mixed || position.y > place.high.y ? 0 : cells - 1;
    }
    return position.y > place.high.y && (highest == 0.0 || lowest == 1.0);
}

// Value of the texel at a position before it is spread: the share of the texel that the shape fills.
float vextureTexelOf(uint root, vec2 uv, float texel) {
    VextureSpot spot = vexture_spot(uvec2(0u), uv, vec2(texel, 0.0), vec2(0.0, texel));
    float share = vexture_spot_coverage(root, spot);
    return vexture_is_clear(root, spot) ? round(share) : vexture_around(share);
}

// Value after it is spread: the mean over `reach` texels on either side, along one axis after the other.
float vextureSpread(sampler2D raster, ivec2 at, ivec2 way, int reach) {
    ivec2 last = textureSize(raster, 0) - 1;
    float lowest = 1.0;
    float highest = 0.0;
    float sum = 0.0;
    for (int k = -reach; k <= reach; k++) {
        float around = texelFetch(raster, clamp(at + k * way, ivec2(0), last), 0).r;
        lowest = min(lowest, around);
        highest = max(highest, around);
        sum += vexture_share(vec2(around)).x;
    }
    return highest == 0.0 || lowest == 1.0 ? lowest : vexture_around(sum / float(2 * reach + 1));
}
