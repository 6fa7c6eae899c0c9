// A picture of a planar map, premultiplied; with VEXTURE_LINEAR, averaged and drawn in linear light.
// Exports: view_color.
#include "colour.glsl"
#include "view.glsl"

vec4 view_color(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    if (!found.seen) {
        return vec4(0.0);
    }
#if VEXTURE_FLAT
    return vextureFlatColor(root, base, found.offset, vextureFlat(found.dx, found.dy));
#else
    return vextureColor(root, base, found.offset, found.dx, found.dy);
#endif
}
