// A flat picture of one pair of textures.
// Exports: view_coverage.
#include "coverage.glsl"

uniform sampler2D quads;
uniform sampler2D curves;
uniform mat3 to_unit;  // from pixel coordinates, y down, to the unit square

float view_coverage(vec2 pixel) {
    vec3 h = to_unit * vec3(pixel, 1.0);
    vec2 center = h.xy / h.z;
    vec2 dx = dFdx(center);
    vec2 dy = dFdy(center);
    // a neighbour beyond the horizon of a tilted view makes the steps meaningless
    if (h.z <= abs(to_unit[0].z) + abs(to_unit[1].z)) {
        return 0.0;
    }
    return coverage(quads, curves, center, dx, dy);
}
