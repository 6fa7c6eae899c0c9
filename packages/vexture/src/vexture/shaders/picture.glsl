// Pictures as paints (FORMAT.md, D.6): the mean of a picture's pixels over a parallelogram.
//
// The weight of each pixel is an integral along the parallelogram's sides, cut at the lines between rows; the area to the
// right of a column's border is the sum over the sides of how far they lie to its right. Pixels that are constant have
// exact weights. Pixels that are interpolated are a convolution of constant ones with a square: their weights are cubic
// along a side between two lines, so that Gauss-Legendre quadrature with two points is exact up to the kinks of columns.
// Colours at the border continue beyond it: a column or row at the border has all the weight beyond.
//
// VEXTURE_GRADIENTS is 0 if no map has programs, 1 if they hold no pictures, or 2 if they hold pictures: text that is not
// needed is left out, because it takes registers.
// Exports: VextureLevel, vexture_first_level, vexture_picture_mean, vexture_pixel.
// Exports to spline.glsl: vexture_block.
#include "tree.glsl"

#ifndef VEXTURE_GRADIENTS
#define VEXTURE_GRADIENTS 1
#endif

#if VEXTURE_GRADIENTS == 2

// A level of a picture: columns and rows, and the texel of its first pixels. In a picture of opacities, whose pixels are in
// blocks, it has the number of its first entry in the index instead, as if texel 0 began with entry 0.
struct VextureLevel {
    ivec2 size;
    uint first;
    uint blocks;  // the texel of the first block; 0 in other pictures
};

// A parallelogram in a level, in pixels from `origin`: where each of its sides begins, and the side.
struct VextureOutline {
    vec4 x;
    vec4 y;
    vec4 run;
    vec4 rise;  // not 0
    vec2 low;   // its bounds
    vec2 high;
    ivec2 origin;
};

// Parts of an outline's sides between two heights.
struct VextureStrip {
    vec4 low;
    vec4 high;
    vec4 rise;
};

// Two points on each of these parts, and their weights for the rows of pixels below and above.
struct VexturePoints {
    vec4 first;
    vec4 second;
    vec4 first_below;
    vec4 second_below;
    vec4 first_above;
    vec4 second_above;
};

// Premultiplied colour of a pixel, 0..255.
vec4 vexture_pixel(uint word) {
    return vec4(uvec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24));
}

// Weighted sum of the pixels of a texel: two columns in the row below, and in the row above.
vec4 vexture_sum_pixels(uvec4 pixels, vec4 weights) {
    vec4 below = weights.x * vexture_pixel(pixels.x) + weights.y * vexture_pixel(pixels.y);
    return below + weights.z * vexture_pixel(pixels.z) + weights.w * vexture_pixel(pixels.w);
}

// The opacities of a block, by its column and row: a word for each of its rows.
uvec4 vexture_block(VextureLevel level, int i, int j) {
    uint place = level.first + uint(j) * uint((level.size.x - 1) / VEXTURE_BLOCK_SIDE + 1) + uint(i);
    uvec4 entries = vexture_texel(place >> VEXTURE_ENTRY_BITS);
    uint entry = (entries[(place >> 1) & 3u] >> (16u * (place & 1u))) & 0xffffu;
    uvec4 found = uvec4(entry * 0x01010101u);
    if (entry >= uint(VEXTURE_FIRST_BLOCK)) {
        found = vexture_texel(level.blocks + entry - uint(VEXTURE_FIRST_BLOCK));
    }
    return found;
}

// The texel of two columns and two rows of pixels; opacities are in the low bytes of its words.
uvec4 vexture_pixels_at(VextureLevel level, int i, int j) {
    if (level.blocks != 0u) {
        uvec4 block = vexture_block(level, i >> 1, j >> 1);
        uvec2 rows = (j & 1) == 0 ? block.xy : block.zw;
        uint shift = 16u * uint(i & 1);
        return uvec4(rows.x >> shift, rows.x >> (shift + 8u), rows.y >> shift, rows.y >> (shift + 8u)) & 255u;
    }
    return vexture_texel(level.first + uint(j) * uint((level.size.x + 1) >> 1) + uint(i));
}

// The level with half as many columns and rows.
VextureLevel vexture_next_level(VextureLevel level) {
    ivec2 parts = (level.size - 1) / (level.blocks == 0u ? 2 : VEXTURE_BLOCK_SIDE) + 1;
    return VextureLevel((level.size + 1) >> 1, level.first + uint(parts.x) * uint(parts.y), level.blocks);
}

// The picture itself, from its columns and rows and its first texel.
VextureLevel vexture_first_level(ivec2 size, uint first, bool has_blocks) {
    VextureLevel level = VextureLevel(size, first, 0u);
    if (has_blocks) {
        level = VextureLevel(size, first << VEXTURE_ENTRY_BITS, 1u);
        VextureLevel last = level;
        while (last.size.x + last.size.y > 2) {
            last = vexture_next_level(last);
        }
        level.blocks = (last.first >> VEXTURE_ENTRY_BITS) + 1u;  // the last level has one entry
    }
    return level;
}

// The outline of a parallelogram, widened if it is thin.
VextureOutline vexture_outline(vec2 middle, vec2 right, vec2 up) {
    bool is_high = dot(up, up) > dot(right, right);
    vec2 a = is_high ? up : right;
    vec2 b = is_high ? right : up;
    float size = sqrt(dot(a, a));
    a = size < VEXTURE_LEAST_OUTLINE ? vec2(VEXTURE_LEAST_OUTLINE, 0.0) : a;
    size = max(size, VEXTURE_LEAST_OUTLINE);
    float wide = (a.x * b.y - a.y * b.x) / size;
    float more = max(VEXTURE_THINNEST_OUTLINE * size - abs(wide), 0.0) / size;
    b += (wide < 0.0 ? -more : more) * vec2(-a.y, a.x);
    vec2 origin = floor(middle);
    vec2 reach = 0.5 * (abs(a) + abs(b));
    vec2 corner = middle - origin - 0.5 * (a + b);
    float rise_a = abs(a.y) > VEXTURE_NOTHING ? a.y : VEXTURE_NOTHING;
    float rise_b = abs(b.y) > VEXTURE_NOTHING ? b.y : VEXTURE_NOTHING;
    return VextureOutline(
        corner.x + vec4(0.0, a.x, a.x + b.x, b.x),
        corner.y + vec4(0.0, a.y, a.y + b.y, b.y),
        vec4(a.x, b.x, -a.x, -b.x),
        vec4(rise_a, rise_b, -rise_a, -rise_b),
        middle - origin - reach,
        middle - origin + reach,
        ivec2(origin)
    );
}

// Where each side reaches a height, in 0..1 of the side.
vec4 vexture_cuts(VextureOutline outline, float y) {
    return clamp((y - outline.y) / outline.rise, 0.0, 1.0);
}

// A line between pixels, or through their centres, within bounds; the first and the last one are at the bounds.
float vexture_line(int k, int count, float place, vec2 bounds) {
    return k <= 0 ? bounds.x : k >= count ? bounds.y : clamp(place, bounds.x, bounds.y);
}

// First and last column of texels that an outline meets between two heights.
ivec2 vexture_columns(VextureLevel level, VextureOutline outline, vec4 from, vec4 to, float reach) {
    vec2 found = vec2(VEXTURE_PICTURE_FAR, -VEXTURE_PICTURE_FAR);
    for (int k = 0; k < 4; k++) {
        float start = outline.x[k] + from[k] * outline.run[k];
        float end = outline.x[k] + to[k] * outline.run[k];
        found.x = from[k] != to[k] ? min(found.x, min(start, end)) : found.x;
        found.y = from[k] != to[k] ? max(found.y, max(start, end)) : found.y;
    }
    int first = clamp(int(floor(found.x - reach)) + outline.origin.x, 0, level.size.x - 1) >> 1;
    int last = clamp(int(floor(found.y + reach)) + outline.origin.x, 0, level.size.x - 1) >> 1;
    return ivec2(first, min(last, first + VEXTURE_PICTURE_LINES));
}

VextureStrip vexture_strip(VextureOutline outline, vec4 from, vec4 to) {
    vec4 start = outline.x + from * outline.run;
    vec4 end = outline.x + to * outline.run;
    return VextureStrip(min(start, end), max(start, end), abs(to - from) * outline.rise);
}

// Area of a strip to the right of a vertical line.
float vexture_area_beyond(VextureStrip strip, float x) {
    vec4 share = clamp((strip.high - x) / max(strip.high - strip.low, VEXTURE_NOTHING), 0.0, 1.0);
    return 0.5 * dot(strip.rise, share * (max(strip.low - x, 0.0) + max(strip.high - x, 0.0)));
}

// Mean of constant pixels over an outline.
vec4 vexture_area_mean(VextureLevel level, VextureOutline outline) {
    vec4 sum = vec4(0.0);
    float total = 0.0;
    vec2 sides = vec2(outline.low.x, outline.high.x);
    vec2 ends = vec2(outline.low.y, outline.high.y);
    int first = clamp(int(floor(ends.x)) + outline.origin.y, 0, level.size.y - 1) >> 1;
    int last = clamp(int(floor(ends.y)) + outline.origin.y, 0, level.size.y - 1) >> 1;
    vec4 above = vexture_cuts(outline, ends.x);
    for (int j = first; j <= min(last, first + VEXTURE_PICTURE_LINES); j++) {
        vec4 below = above;
        float place = float(2 * j - outline.origin.y);
        vec4 between = vexture_cuts(outline, vexture_line(2 * j + 1, level.size.y, place + 1.0, ends));
        above = vexture_cuts(outline, vexture_line(2 * j + 2, level.size.y, place + 2.0, ends));
        VextureStrip low = vexture_strip(outline, below, between);
        VextureStrip high = vexture_strip(outline, between, above);
        ivec2 columns = vexture_columns(level, outline, below, above, 0.0);
        float x = float(2 * columns.x - outline.origin.x);
        float line = vexture_line(2 * columns.x, level.size.x, x, sides);
        vec2 left = vec2(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
        for (int i = columns.x; i <= columns.y; i++) {
            line = vexture_line(2 * i + 1, level.size.x, x + 1.0, sides);
            vec2 middle = vec2(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
            x += 2.0;
            line = vexture_line(2 * i + 2, level.size.x, x, sides);
            vec2 right = vec2(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
            vec4 weights = vec4(left.x - middle.x, middle.x - right.x, left.y - middle.y, middle.y - right.y);
            sum += vexture_sum_pixels(vexture_pixels_at(level, i, j), weights);
            total += weights.x + weights.y + weights.z + weights.w;
            left = right;
        }
    }
    return sum / (total != 0.0 ? total : 1.0);
}

// Points on the parts of sides above the height of the centres of a row.
VexturePoints vexture_points(VextureOutline outline, vec4 from, vec4 to, float y) {
    vec4 first = 0.5 * (from + to) - VEXTURE_GAUSS * (to - from);
    vec4 second = 0.5 * (from + to) + VEXTURE_GAUSS * (to - from);
    vec4 first_above = outline.y - y + first * outline.rise;
    vec4 second_above = outline.y - y + second * outline.rise;
    vec4 rise = 0.5 * abs(to - from) * outline.rise;
    return VexturePoints(
        outline.x + first * outline.run,
        outline.x + second * outline.run,
        rise * (1.0 - first_above),
        rise * (1.0 - second_above),
        rise * first_above,
        rise * second_above
    );
}

// Integral, from the left, of the sum of the weights of a column and of all to its right, for places from its centre.
vec4 vexture_ramp_beyond(vec4 place) {
    vec4 after = max(place + 1.0, 0.0);
    vec4 within = min(after, 1.0);
    return after - within + 0.5 * within * within;
}

// Weights of the columns from one with this centre on, in the rows below and above.
vec2 vexture_weight_beyond(VexturePoints points, float x) {
    vec4 first = vexture_ramp_beyond(points.first - x);
    vec4 second = vexture_ramp_beyond(points.second - x);
    float below = dot(points.first_below, first) + dot(points.second_below, second);
    return vec2(below, dot(points.first_above, first) + dot(points.second_above, second));
}

// Two columns of pixels in two rows, which may be in different texels.
uvec4 vexture_pixels_in(VextureLevel level, int i, ivec2 rows) {
    uvec4 below = vexture_pixels_at(level, i, rows.x >> 1);
    uvec4 above = below;
    if ((rows.x >> 1) != (rows.y >> 1)) {
        above = vexture_pixels_at(level, i, rows.y >> 1);
    }
    uvec2 first = (rows.x & 1) == 0 ? below.xy : below.zw;
    uvec2 second = (rows.y & 1) == 0 ? above.xy : above.zw;
    return uvec4(first, second);
}

// Mean of interpolated pixels over an outline.
vec4 vexture_smooth_mean(VextureLevel level, VextureOutline outline) {
    vec4 sum = vec4(0.0);
    float total = 0.0;
    vec2 sides = vec2(outline.low.x - 1.0, outline.high.x + 1.0);
    int first = int(floor(outline.low.y - 0.5)) + outline.origin.y;
    int last = int(floor(outline.high.y - 0.5)) + outline.origin.y;
    vec4 above = vexture_cuts(outline, outline.low.y);
    for (int j = first; j <= min(last, first + VEXTURE_PICTURE_LINES); j++) {
        vec4 below = above;
        float y = float(j - outline.origin.y) + 0.5;
        above = vexture_cuts(outline, y + 1.0);
        VexturePoints points = vexture_points(outline, below, above, y);
        ivec2 columns = vexture_columns(level, outline, below, above, 0.5);
        ivec2 rows = clamp(ivec2(j, j + 1), ivec2(0), ivec2(level.size.y - 1));
        float x = float(2 * columns.x - outline.origin.x) + 0.5;
        vec2 left = vexture_weight_beyond(points, vexture_line(2 * columns.x, level.size.x, x, sides));
        for (int i = columns.x; i <= columns.y; i++) {
            vec2 middle = vexture_weight_beyond(points, vexture_line(2 * i + 1, level.size.x, x + 1.0, sides));
            x += 2.0;
            vec2 right = vexture_weight_beyond(points, vexture_line(2 * i + 2, level.size.x, x, sides));
            vec4 weights = vec4(left.x - middle.x, middle.x - right.x, left.y - middle.y, middle.y - right.y);
            sum += vexture_sum_pixels(vexture_pixels_in(level, i, rows), weights);
            total += weights.x + weights.y + weights.z + weights.w;
            left = right;
        }
    }
    return sum / (total != 0.0 ? total : 1.0);
}

// Mean of a picture, 0..255, over a parallelogram in its pixels, given by its middle and sides, which has this share of a
// footprint: smaller ones cost less, which limits the cost of all in a footprint.
vec4 vexture_picture_mean(VextureLevel level, bool is_smooth, vec2 middle, vec2 right, vec2 up, float share) {
    float longer = max(dot(right, right), dot(up, up));
    float area = max(abs(right.x * up.y - right.y * up.x) / share, VEXTURE_PICTURE_LENGTH * longer);
    area *= 1.0 - VEXTURE_LEVEL_BIAS;
    float far = max(abs(middle.x), abs(middle.y));
    is_smooth = is_smooth && area <= VEXTURE_SMOOTH_AREA && far <= VEXTURE_PICTURE_FAR;
    float scale = 1.0;
    // so that it ends at the last level if a number is not finite
    while (!(area <= VEXTURE_PICTURE_AREA && far <= VEXTURE_PICTURE_FAR) && level.size.x + level.size.y > 2) {
        level = vexture_next_level(level);
        scale *= 0.5;
        area *= 0.25;
    }
    if (level.size.x + level.size.y == 2) {
        return vexture_pixel(vexture_pixels_at(level, 0, 0).x);
    }
    if (is_smooth) {
        if (longer < VEXTURE_SHORT_SMOOTH * VEXTURE_SHORT_SMOOTH) {
            vec2 wide = max(sqrt(right * right + up * up), VEXTURE_LEAST_SMOOTH);
            right = vec2(wide.x, 0.0);
            up = vec2(0.0, wide.y);
        }
        return vexture_smooth_mean(level, vexture_outline(middle, right, up));
    }
    return vexture_area_mean(level, vexture_outline(scale * middle, scale * right, scale * up));
}

#endif
