// Shapes in their colours, composited.
// Exports: vexture_layer_paint, vexture_layer_below, vextureLayers, vextureStraight, vextureQuad.
#include "srgb.glsl"
#include "wrap.glsl"

// A row for each root of the texture: its quad; red and green, blue and opacity as 16-bit halves of words (sRGB); 1 for a
// planar map; then the bounding box of the shape, 1.0 = 65536.
uniform highp usampler2D vexturePaints;

// Quad of a root, given by its number in the texture.
uint vextureQuad(uint root) {
    return texelFetch(vexturePaints, ivec2(0, int(root)), 0).x;
}

// sRGB and opacity, straight.
vec4 vexture_layer_paint(uvec4 head) {
    return vec4(unpackUnorm2x16(head.y), unpackUnorm2x16(head.z));
}

bool vexture_meets(uvec4 box, VextureSpot spot) {
    vec2 low = vec2(box.xy) * exp2(-16.0);
    vec2 high = vec2(box.zw) * exp2(-16.0);
    vec2 way = vexture_fraction(spot.base) + spot.offset - 0.5 * (low + high);
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    way -= floor(way + 0.5);
#endif
    return all(lessThan(abs(way), 0.5 * (high - low) + spot.reach + VEXTURE_BORDER));
}

// Highest layer below another one that the footprint meets, or the number below the first layer.
int vexture_layer_below(int layer, int first, VextureSpot spot) {
    bool meets = false;
    while (!meets && layer >= first) {
        layer--;
        meets = layer >= first && vexture_meets(texelFetch(vexturePaints, ivec2(1, layer), 0), spot);
    }
    return layer;
}

// Colour of a pixel, premultiplied, composited in sRGB as in SVG. Parameters: the number of the lowest layer, the number of
// layers, then those of vextureCoverage.
//
// Layers are visited from the top until no lower one would show. Layers that the footprint does not meet take no
// iteration: on devices that execute both sides of a branch, skipping them by a branch would cost as much as drawing them.
vec4 vextureLayers(int first, int count, uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    VextureSpot spot = vexture_spot(base, offset, dx, dy);
    vec4 color = vec4(0.0);
    int layer = vexture_layer_below(first + count, first, spot);
    while (layer >= first && color.a < VEXTURE_COVERED) {
        uvec4 head = texelFetch(vexturePaints, ivec2(0, layer), 0);
        vec4 paint = vexture_layer_paint(head);
        float cover = paint.a * vexture_spot_coverage(head.x, spot);
        color += (1.0 - color.a) * cover * vec4(paint.rgb, 1.0);
        layer = vexture_layer_below(layer, first, spot);
    }
    return color;
}

vec4 vextureLayers(int first, int count, vec2 uv, vec2 dx, vec2 dy) {
    return vextureLayers(first, count, uvec2(0u), uv, dx, dy);
}

// From premultiplied sRGB to straight linear components.
vec4 vextureStraight(vec4 color) {
    return vec4(vexture_linear(color.rgb / max(color.a, exp2(-24.0))), color.a);
}
