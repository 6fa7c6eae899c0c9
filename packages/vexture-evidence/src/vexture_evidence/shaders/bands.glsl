// Coverage of a pixel by the band algorithm: along two rays, the curves of a band, each root's distance in pixels.
// Written from the public description (E. Lengyel, "GPU-Centered Font Rendering Directly from Glyph Outlines",
// JCGT 6(2), 2017). The package includes it nowhere: it is what the others are measured against (measures/bands.py,
// which puts BANDS, ROW_BITS, COUNT_BITS, ELIGIBLE and STRAIGHT before it).
// Exports: band_coverage.

uniform usampler2D band_lists;  // BANDS horizontal heads, BANDS upright heads, then the lists
uniform sampler2D outlines;     // a curve's first and second point; its third is the first of the next texel
uniform vec4 band_box;          // lower left corner of the outline's box, bands per unit in x and in y

ivec2 texel_at(int index) {
    return ivec2(index & ((1 << ROW_BITS) - 1), index >> ROW_BITS);
}

uint list_entry(int index) {
    return texelFetch(band_lists, texel_at(index), 0).x;
}

// Two roots of a curve's crossings with y = 0 as x there, in pixels: of the falling one, then of the rising one.
vec2 crossings(vec2 p1, vec2 p2, vec2 p3, float pixels) {
    vec2 a = p1 - 2.0 * p2 + p3;
    vec2 b = p1 - p2;
    float root = sqrt(max(b.y * b.y - a.y * p1.y, 0.0));
    float inverse = 1.0 / a.y;
    vec2 t = vec2(b.y - root, b.y + root) * inverse;
    if (abs(a.y) < STRAIGHT) {
        t = vec2(0.5 * p1.y / b.y);
    }
    return ((a.x * t - 2.0 * b.x) * t + p1.x) * pixels;
}

// Winding along the ray to the right of the origin, its end spread over a pixel, and the weight of the nearest crossing.
vec2 ray_coverage(uint head, vec2 center, float pixels, bool upright) {
    int first = int(head >> COUNT_BITS);
    int last = first + int(head & ((1u << COUNT_BITS) - 1u));
    vec2 found = vec2(0.0);
    for (int i = first; i < last; i++) {
        int at = int(list_entry(i));
        vec4 start = texelFetch(outlines, texel_at(at), 0) - center.xyxy;
        vec2 p3 = texelFetch(outlines, texel_at(at + 1), 0).xy - center;
        vec2 p1 = upright ? start.yx : start.xy;
        vec2 p2 = upright ? start.wz : start.zw;
        p3 = upright ? p3.yx : p3;
        if (max(max(p1.x, p2.x), p3.x) * pixels < -0.5) {
            break;
        }
        int signs = (p1.y > 0.0 ? 2 : 0) + (p2.y > 0.0 ? 4 : 0) + (p3.y > 0.0 ? 8 : 0);
        int roots = (ELIGIBLE >> signs) & 3;
        if (roots != 0) {
            vec2 x = crossings(p1, p2, p3, pixels);
            vec2 part = clamp(x + 0.5, 0.0, 1.0);
            vec2 near = clamp(1.0 - 2.0 * abs(x), 0.0, 1.0);
            if ((roots & 1) != 0) {
                found = vec2(found.x + part.x, max(found.y, near.x));
            }
            if (roots > 1) {
                found = vec2(found.x - part.y, max(found.y, near.y));
            }
        }
    }
    return found;
}

float band_coverage(vec2 uv, vec2 dx, vec2 dy) {
    vec2 pixel = abs(dx) + abs(dy);
    vec2 pixels = 1.0 / pixel;
    vec2 place = (uv - band_box.xy) * band_box.zw;
    vec2 margin = 0.5 * pixel * band_box.zw;
    if (any(lessThan(place, -margin)) || any(greaterThan(place, float(BANDS) + margin))) {
        return 0.0;
    }
    ivec2 band = clamp(ivec2(place), 0, BANDS - 1);
    vec2 level = ray_coverage(list_entry(band.y), uv, pixels.x, false);
    vec2 upright = ray_coverage(list_entry(BANDS + band.x), uv, pixels.y, true);
    upright.x = -upright.x;  // turned over the diagonal, a contour goes the other way
    float both = abs(level.x * level.y + upright.x * upright.y) / max(level.y + upright.y, 1.0 / 65536.0);
    return min(max(both, min(abs(level.x), abs(upright.x))), 1.0);
}
