// Planar maps, and drawings of several sheets: maps and layers, the lowest first, composited.
// Exports: vextureWrappedColor, vextureSheets, vextureSheetCoverage, vextureLight.
//
// With VEXTURE_LINEAR, all colours in this file are linear; those of vextureLight always are.
#include "layers.glsl"
#include "colour.glsl"

vec4 vexture_color_at(uint root, VextureSpot spot) {
#if VEXTURE_FLAT
    return vextureFlatColor(root, spot.base, spot.offset, vextureFlat(spot.dx, spot.dy));
#else
    return vextureColor(root, spot.base, spot.offset, spot.dx, spot.dy);
#endif
}

// Stored mean of the whole square.
vec4 vexture_whole_color(uint root) {
    uvec4 means = vexture_texel(vexture_means_at(vexture_planar(root), root));
    return vexture_mean_color(means, vec2(0.5)) / float(VEXTURE_COVERAGE_ONE);
}

// Like vexture_spot_coverage, for a planar map.
vec4 vexture_spot_color(uint root, VextureSpot spot) {
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    VextureTiles tiles = vexture_tiles(spot);
    vec4 sum = vec4(0.0);
    for (int tile = 0; tile < tiles.count; tile++) {
        sum += vexture_color_at(root, vexture_tile(tiles, spot, tile));
    }
    return mix(vexture_held(sum), vexture_whole_color(root), tiles.whole);
#else
    return vexture_color_at(root, spot);
#endif
}

// Colour of a pixel of one map, premultiplied. Parameters: its root quad, then those of vextureColor; the position may lie
// anywhere.
vec4 vextureWrappedColor(uint root, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    return vexture_spot_color(root, vexture_spot(base, offset, dx, dy));
}

vec4 vextureWrappedColor(uint root, vec2 uv, vec2 dx, vec2 dy) {
    return vextureWrappedColor(root, uvec2(0u), uv, dx, dy);
}

// Colour of one sheet.
vec4 vexture_sheet_color(uvec4 head, VextureSpot spot) {
    if (head.w != 0u) {
        return vexture_spot_color(head.x, spot);
    }
    vec4 paint = vexture_layer_paint(head);
#if VEXTURE_LINEAR
    paint.rgb = vexture_linear(paint.rgb);
#endif
    return paint.a * vexture_spot_coverage(head.x, spot) * vec4(paint.rgb, 1.0);
}

// Like vextureLayers, for layers and maps.
vec4 vextureSheets(int first, int count, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureSpot spot = vexture_spot(base, offset, dx, dy);
    vec4 color = vec4(0.0);
    int layer = vexture_layer_below(first + count, first, spot);
    while (layer >= first && color.a < VEXTURE_COVERED) {
        color += (1.0 - color.a) * vexture_sheet_color(texelFetch(vexturePaints, ivec2(0, layer), 0), spot);
        layer = vexture_layer_below(layer, first, spot);
    }
    return color;
}

vec4 vextureSheets(int first, int count, vec2 uv, vec2 dx, vec2 dy) {
    return vextureSheets(first, count, uvec2(0u), uv, dx, dy);
}

// Coverage by one root, given by its number in the texture: a map's opacity, or a layer's area without its paint.
float vextureSheetCoverage(uint root, vec2 uv, vec2 dx, vec2 dy) {
    VextureSpot spot = vexture_spot(uvec2(0u), uv, dx, dy);
    uvec4 head = texelFetch(vexturePaints, ivec2(0, int(root)), 0);
    if (head.w != 0u) {
        return vexture_spot_color(head.x, spot).a;
    }
    return vexture_spot_coverage(head.x, spot);
}

// From the colours of this file, premultiplied, to straight linear components.
vec4 vextureLight(vec4 color) {
#if VEXTURE_LINEAR
    return vec4(color.rgb / max(color.a, exp2(-24.0)), color.a);
#else
    return vextureStraight(color);
#endif
}
