// A picture of one shape in a packed texture; with VEXTURE_FLAT, of upright pixels that are all alike.
// Exports: view_coverage.
#include "coverage.glsl"

uniform mat3 to_unit;  // from pixel coordinates, y down, to the unit square, relative to
uniform uvec2 base;    // a point of it, 1.0 = 2^32
uniform uint root;

// The steps are the map's Jacobian at the pixel's centre: finite differences would lose digits at high magnification, and
// be those of a neighbour in tilted views.
float view_coverage(vec2 pixel) {
    vec3 h = to_unit * vec3(pixel, 1.0);
    if (h.z <= 0.5 * (abs(to_unit[0].z) + abs(to_unit[1].z))) {  // the pixel reaches the horizon
        return 0.0;
    }
    vec2 offset = h.xy / h.z;
    vec2 dx = (to_unit[0].xy - offset * to_unit[0].z) / h.z;
    vec2 dy = (to_unit[1].xy - offset * to_unit[1].z) / h.z;
#if VEXTURE_FLAT
    return vextureFlatCoverage(root, base, offset, vextureFlat(dx, dy));
#else
    return vextureCoverage(root, base, offset, dx, dy);
#endif
}
