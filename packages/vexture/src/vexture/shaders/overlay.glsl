// The structure of a packed texture, drawn over its picture: the borders of cells, their stored coverage, their depth, and
// the cells whose stored coverage would replace curves at larger pixels.
// Exports: vextureOverlay.
#include "layers.glsl"

uniform highp uint vextureOverlayRoot;    // the quad whose tree is shown
uniform bool vextureOverlayOfMap;         // is it the root quad of a planar map
uniform highp uvec2 vextureOverlayMeans;  // of a map: texel of the root's means; log2 of the quads in a block
uniform vec3 vextureOverlayShow;          // opacity of borders, coverage and depth; 0 hides them
uniform float vextureOverlayCutoff;       // levels by which the cut-off is exaggerated; 0: not shown
uniform vec3 vextureOverlayCoverage[2];   // colours, sRGB, of an empty and a full cell
uniform vec3 vextureOverlayStored[2];     // of an empty and a full quad at the cut-off
uniform vec3 vextureOverlayDepth[VEXTURE_MOST_DEPTH + 1];

// Share of a pixel covered by the border of a cell, one pixel wide. `pixels` is the size of a position unit in pixels.
float vexture_border(VexturePlace place, int bit, vec2 pixels) {
    ivec2 before = place.point & ((1 << bit) - 1);
    ivec2 after = (1 << bit) - before;  // integers: small near the border, so that a float is exact
    vec2 near = min(vec2(before) + place.rest, vec2(after) - place.rest) * pixels;
    vec2 size = float(1 << bit) * pixels;
    float seen = clamp(min(size.x, size.y) / VEXTURE_FADED_CELL - 1.0, 0.0, 1.0);
    return seen * clamp(1.0 - min(near.x, near.y), 0.0, 1.0);
}

vec4 vexture_over(vec4 color, vec3 paint, float opacity) {
    return mix(color, vec4(paint, 1.0), opacity);
}

// A dark colour on light colours, a light one on dark colours.
vec3 vexture_contrast(vec4 color) {
    return vec3(dot(color.rgb, vec3(0.299, 0.587, 0.114)) > 0.5 ? 0.0 : 1.0);
}

// What is stored for a cell: its coverage, or the mean of a map, as a colour between those of empty and full cells.
vec3 vexture_stored_color(VextureCell cell, vec3 empty, vec3 full) {
    if (!vextureOverlayOfMap) {
        float stored = cell.is_quad ? vexture_mean(cell.texel.w, vec2(0.5)) : vexture_stored_coverage(cell);
        return mix(empty, full, stored);
    }
    uint place = cell.quad - vextureOverlayRoot;
    uvec4 means = vexture_texel(vextureOverlayMeans.x + place + (place >> vextureOverlayMeans.y));
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; k++) {
        bool counts = cell.is_quad || 8u * uint(k) == cell.shift;
        vec4 mean = vec4((uvec4(means[k]) >> uvec4(0u, 8u, 16u, 24u)) & 255u);
        sum += counts ? mean : vec4(0.0);
    }
    sum *= (cell.is_quad ? 0.25 : 1.0) / float(VEXTURE_COVERAGE_ONE);
    return sum.rgb + (1.0 - sum.a) * empty;
}

// The picture's colour with the overlays that are switched on; the other parameters are those of vextureCoverage.
// The descent ends at the leaf, or at a quad no larger than the cut-off: a pixel, unless exaggerated. The root is no cell.
vec4 vextureOverlay(vec4 color, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureFrame frame = vexture_frame(dx, dy);
    VexturePlace place = vexture_place(base, offset, frame.extent);
    ivec2 outside = place.point >> VEXTURE_POSITION_BITS;
    int finest = min(vexture_bit_of(frame.size * exp2(2.0 * vextureOverlayCutoff)), VEXTURE_POSITION_BITS - 1);
    vec2 lengths = vec2(length(vec2(dx.x, dy.x)), length(vec2(dx.y, dy.y)));
    vec2 pixels = 1.0 / (max(lengths, VEXTURE_SMALLEST_PIXEL) * float(1 << VEXTURE_POSITION_BITS));
    VextureTop top = VextureTop(vextureOverlayRoot, VEXTURE_POSITION_BITS, 0u);
    VextureCell cell = VextureCell(0u, uvec4(0u), 0u, VEXTURE_POSITION_BITS, outside == ivec2(0));
    float border = cell.is_quad ? vexture_border(place, cell.bit, pixels) : 0.0;
    while (cell.is_quad && cell.bit > finest) {
        int bit = cell.bit - 1;
        cell = vexture_descend(top, bit, bit, place.point);
        border = max(border, vexture_border(place, bit, pixels));
    }
    if (outside != ivec2(0)) {
        return color;
    }
    bool is_cut = cell.is_quad && vextureOverlayCutoff > 0.0;
    vec3 stored = vexture_stored_color(cell, vextureOverlayStored[0], vextureOverlayStored[1]);
    color = vexture_over(color, stored, is_cut ? 1.0 : 0.0);
    vec3 shade = vexture_stored_color(cell, vextureOverlayCoverage[0], vextureOverlayCoverage[1]);
    color = vexture_over(color, shade, is_cut ? 0.0 : vextureOverlayShow.y);
    color = vexture_over(color, vextureOverlayDepth[VEXTURE_POSITION_BITS - cell.bit], vextureOverlayShow.z);
    return vexture_over(color, vexture_contrast(color), border * vextureOverlayShow.x);
}
