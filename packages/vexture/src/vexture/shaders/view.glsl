// Positions of a picture's pixels in the drawing. With VEXTURE_FLAT, all pixels are equal upright rectangles.
// Exports: ViewPixel, view_pixel.

uniform mat3 to_unit;  // from pixel coordinates, y down, to the unit square, relative to
uniform uvec2 base;    // a point of it, 1.0 = 2^32
uniform uint root;     // quad of a shape's tree, or head of a planar map

// Arguments of vextureCoverage for a pixel.
struct ViewPixel {
    bool seen;  // false beyond the horizon
    vec2 offset;
    vec2 dx;
    vec2 dy;
};

// The steps are the map's Jacobian at the pixel's centre: finite differences would lose digits at high magnification, and
// in tilted views they would belong to a neighbour.
ViewPixel view_pixel(vec2 pixel) {
    vec3 h = to_unit * vec3(pixel, 1.0);
    if (h.z <= 0.5 * (abs(to_unit[0].z) + abs(to_unit[1].z))) {  // the pixel reaches the horizon
        return ViewPixel(false, vec2(0.0), vec2(0.0), vec2(0.0));
    }
    vec2 offset = h.xy / h.z;
    vec2 dx = (to_unit[0].xy - offset * to_unit[0].z) / h.z;
    vec2 dy = (to_unit[1].xy - offset * to_unit[1].z) / h.z;
    return ViewPixel(true, offset, dx, dy);
}
