// Pictures whose pixels are the coefficients of cubic B-splines (FORMAT.md, D.6): the mean of a spline over a parallelogram.
//
// Over an upright box it is exact: the weight of a column or row is a difference of integrals. For opacities, a small
// parallelogram is divided into few parts, each replaced by the box with the same variances. In others, and for colours,
// pixels are interpolated linearly, and the parallelogram is widened by the variance that a spline has beyond that:
// 1/3 - 1/6 in each direction. That is off by 0.4 of 255 for a blurred edge, and takes no further code.
//
// VEXTURE_GRADIENTS is 2 if programs hold pictures.
// Exports: vexture_sampled_mean.
#include "picture.glsl"

#if VEXTURE_GRADIENTS == 2

// Integral, from the left, of the sum of the B-splines of a column and of all to its right, for places from its left line.
vec4 vexture_spline_beyond(vec4 place) {
    vec4 wide = max(1.5 - abs(place), 0.0);
    vec4 narrow = max(0.5 - abs(place), 0.0);
    wide *= wide;
    narrow *= narrow;
    return max(place, 0.0) + (wide * wide - 3.0 * narrow * narrow) / 24.0;
}

// Shares that the columns or rows of `count` from each of four on have in the mean between two places from `origin`. Beyond
// the border all is that of the one at the border.
vec4 vexture_shares_beyond(int first, int count, float origin, vec2 between) {
    vec4 number = float(first) + vec4(0.0, 1.0, 2.0, 3.0);
    vec4 line = number - origin;
    vec4 share = vexture_spline_beyond(between.y - line) - vexture_spline_beyond(between.x - line);
    share = max(share / (between.y - between.x), clamp(1.0 - number, 0.0, 1.0));
    return share * clamp(float(count) - number, 0.0, 1.0);
}

// Mean opacity over an upright box, given by its middle and its sides.
float vexture_box_mean(VextureLevel level, vec2 middle, vec2 sides) {
    middle = min(max(middle, -VEXTURE_WIDEST_SPLINE_BOX), vec2(level.size) + VEXTURE_WIDEST_SPLINE_BOX);
    vec2 origin = floor(middle);
    vec2 low = middle - origin - 0.5 * sides;
    vec2 high = low + sides;
    ivec2 first = clamp(ivec2(origin + floor(low - 1.5)), ivec2(0), level.size - 1) / VEXTURE_BLOCK_SIDE;
    ivec2 last = clamp(ivec2(origin + floor(high + 1.5)), ivec2(0), level.size - 1) / VEXTURE_BLOCK_SIDE;
    last = min(last, first + 4);  // more than the widest box needs: bounds the work for invalid numbers
    float sum = 0.0;
    vec4 above = vexture_shares_beyond(4 * first.y, level.size.y, origin.y, vec2(low.y, high.y));
    for (int j = first.y; j <= last.y; j++) {
        vec4 row = above;
        above = vexture_shares_beyond(4 * j + 4, level.size.y, origin.y, vec2(low.y, high.y));
        row -= vec4(row.yzw, above.x);
        vec4 right = vexture_shares_beyond(4 * first.x, level.size.x, origin.x, vec2(low.x, high.x));
        for (int i = first.x; i <= last.x; i++) {
            vec4 column = right;
            right = vexture_shares_beyond(4 * i + 4, level.size.x, origin.x, vec2(low.x, high.x));
            column -= vec4(column.yzw, right.x);
            uvec4 block = vexture_block(level, i, j);
            sum += row.x * dot(column, vexture_pixel(block.x)) + row.y * dot(column, vexture_pixel(block.y));
            sum += row.z * dot(column, vexture_pixel(block.z)) + row.w * dot(column, vexture_pixel(block.w));
        }
    }
    return sum;
}

// The two sides of a parallelogram, in columns and rows, with the variances of another one and 1/6 more in each direction.
vec4 vexture_widen(vec2 right, vec2 up) {
    float longer = max(dot(right, right), dot(up, up));
    float area = max(abs(right.x * up.y - right.y * up.x), max(VEXTURE_THINNEST_PIXEL * longer, VEXTURE_NOTHING));
    float inverse = 2.0 / (area * area);
    float along = 1.0 + inverse * dot(up, up);
    float beside = 1.0 + inverse * dot(right, right);
    float both = -inverse * dot(right, up);
    float root = sqrt(max(along * beside - both * both, 0.0));
    vec4 sides = vec4((along + root) * right + both * up, both * right + (beside + root) * up);
    return sides / sqrt(along + beside + 2.0 * root);
}

// Mean of a picture of any sampling, 0..255, over a parallelogram; parameters as of vexture_picture_mean, which is called
// in one place, because compilers copy it.
vec4 vexture_sampled_mean(VextureLevel level, uint sampling, vec2 middle, vec2 right, vec2 up, float share) {
    float less = 1.0 - VEXTURE_LEVEL_BIAS;
    vec2 slants = less * sqrt(abs(vec2(right.x * right.y, up.x * up.y)));
    vec2 parts = max(ceil(slants / VEXTURE_SLANTED_PART), 1.0);
    vec2 sides = sqrt(right * right / (parts.x * parts.x) + up * up / (parts.y * parts.y));
    bool is_small = parts.x * parts.y <= float(VEXTURE_MOST_SPLINE_BOXES);
    is_small = is_small && less * max(sides.x, sides.y) <= VEXTURE_WIDEST_SPLINE_BOX;
    if (is_small && sampling >= uint(VEXTURE_SAMPLING_OPACITY)) {
        sides = max(sides, VEXTURE_LEAST_SPLINE_BOX);
        int across = int(parts.x);
        int number = across * int(parts.y);
        float sum = 0.0;
        for (int k = 0; k < number; k++) {
            vec2 place = (vec2(ivec2(k % across, k / across)) + 0.5) / parts - 0.5;
            sum += vexture_box_mean(level, middle + place.x * right + place.y * up, sides);
        }
        return vec4(sum / float(number), 0.0, 0.0, 0.0);
    }
    if (sampling >= uint(VEXTURE_SAMPLING_SPLINE)) {
        vec4 widened = vexture_widen(right, up);
        right = widened.xy;
        up = widened.zw;
    }
    return vexture_picture_mean(level, sampling != uint(VEXTURE_SAMPLING_PIXELS), middle, right, up, share);
}

#endif
