// A picture of one shape in a packed texture.
// Exports: view_coverage.
#include "coverage.glsl"
#include "view.glsl"

float view_coverage(vec2 pixel) {
    ViewPixel found = view_pixel(pixel);
    if (!found.seen) {
        return 0.0;
    }
#if VEXTURE_FLAT
    return vextureFlatCoverage(root, base, found.offset, vextureFlat(found.dx, found.dy));
#else
    return vextureCoverage(root, base, found.offset, found.dx, found.dy);
#endif
}
