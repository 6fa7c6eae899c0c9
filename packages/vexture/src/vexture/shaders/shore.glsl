// The share of a wide box around each position that a shape fills, and whether a near one holds an outline: the raster
// that water.glsl reads beside the shape.
// Exports: vextureTexelOf, vextureSpread.
#include "wrap.glsl"
#include "around.glsl"

const int vexture_most_cells = 256;  // a box that needs more counts as crossed

// Returns whether no outline, however small, passes through a box: all its cells are constant and equal. A cell with curves
// counts as crossed.
bool vexture_is_clear(uint root, VextureSpot spot) {
    VexturePlace place = vexture_place(spot.base, spot.offset, spot.reach * float(1 << VEXTURE_POSITION_BITS));
    VextureSquare square = vexture_first_square(place);
    int shared_bit = square.bit;
    VextureTop top = vexture_top(root);
    int cells = vexture_most_cells;
    float lowest = 1.0;
    float highest = 0.0;
    while (cells > 0 && square.position.x < VEXTURE_NO_CELL && (highest == 0.0 || lowest == 1.0)) {
        cells--;
        VextureCell cell = vexture_descend(top, shared_bit, 0, square.position);
        float filled = cell.is_quad || vexture_winding_code(cell) != 0 ? 0.5 : vexture_stored_coverage(cell);
        lowest = min(lowest, filled);
        highest = max(highest, filled);
        int side = 1 << cell.bit;
        square = vexture_next_square(square.position, (square.position & -side) + side, place);
    }
    return square.position.x == VEXTURE_NO_CELL && (highest == 0.0 || lowest == 1.0);
}

// Value of the texel at a position before it is spread: the share of the texel that the shape fills.
float vextureTexelOf(uint root, vec2 uv, float texel) {
    VextureSpot spot = vexture_spot(uvec2(0u), uv, vec2(texel, 0.0), vec2(0.0, texel));
    float share = vexture_spot_coverage(root, spot);
    return vexture_is_clear(root, spot) ? round(share) : vexture_around(share);
}

// Values after they are spread, along one axis after the other: the mean over `reach` texels on either side, and over `near`,
// which are no more.
vec2 vextureSpread(sampler2D raster, ivec2 at, ivec2 way, int reach, int near) {
    ivec2 last = textureSize(raster, 0) - 1;
    vec2 lowest = vec2(1.0);
    vec2 highest = vec2(0.0);
    vec2 sum = vec2(0.0);
    for (int k = -reach; k <= reach; k++) {
        vec2 around = texelFetch(raster, clamp(at + k * way, ivec2(0), last), 0).rg;
        vec2 counts = vec2(1.0, abs(k) <= near ? 1.0 : 0.0);
        lowest = min(lowest, mix(vec2(1.0), around, counts));
        highest = max(highest, around * counts);
        sum += counts * vexture_share(around);
    }
    vec2 mean = sum / vec2(2 * reach + 1, 2 * near + 1);
    return vec2(
        highest.x == 0.0 || lowest.x == 1.0 ? lowest.x : vexture_around(mean.x),
        highest.y == 0.0 || lowest.y == 1.0 ? lowest.y : vexture_around(mean.y)
    );
}
