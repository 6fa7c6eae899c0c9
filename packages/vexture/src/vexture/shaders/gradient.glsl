// Paints that hold gradients or pictures (FORMAT.md, D.6): the colour of a program over a region, the part of a footprint
// in a cell.
// Exports: VextureRegion, vexture_halves, vexture_program.
//
// VEXTURE_GRADIENTS is 0 if no map has programs: their text is then left out, because it takes registers. It is 2 if
// programs may hold pictures.
#include "tree.glsl"
#include "blend.glsl"
#include "spline.glsl"

// In the unit square.
struct VextureRegion {
    vec2 point;  // its middle
    vec2 right;  // its sides
    vec2 up;
};

// Unpacks four numbers, 0..65535, from two words.
vec4 vexture_halves(uvec2 words) {
    return vec4(uvec4(words.x & 0xffffu, words.x >> 16, words.y & 0xffffu, words.y >> 16));
}

#if VEXTURE_GRADIENTS

// A position on a ramp, and its gradient in x and y of the unit square.
struct VextureRamp {
    float t;
    vec2 way;
    bool exists;  // false outside a cone
    vec2 parts;   // per side of a region, so that the ramp is nearly straight in each
};

// GLSL's mod, which other shading languages lack.
float vexture_mod(float x, float y) {
    return x - y * floor(x / y);
}

// Change of a value along each side of a region, from the value's gradient in x and y.
vec2 vexture_spans(vec2 way, VextureRegion region) {
    return abs(vec2(dot(way, region.right), dot(way, region.up)));
}

// The place on a circular ramp: the greatest t whose circle, about c t from the focal point, goes through the region's middle
// and has a radius, |q - c t|^2 = (fr + t dr)^2. Near the border of a cone it is that of a point further inside, as the
// borders of faces are where something is painted. The circle bends away from its tangent, on which places are further out:
// t is their mean. Parameters: the rows of the map to the ramp; focal point and radius.
VextureRamp vexture_round_ramp(vec3 across, vec3 up, vec2 focus, VextureRegion region) {
    vec2 q = vec2(dot(across.xy, region.point) + across.z - focus.x, dot(up.xy, region.point) + up.z);
    vec2 spans = max(vexture_spans(across.xy, region), vexture_spans(up.xy, region));
    vec2 parts = float(VEXTURE_RAMP_PARTS) * spans;
    float grows = 1.0 - focus.y;
    float tip = focus.x / max(grows, VEXTURE_NOTHING) - focus.x;  // where the circles have radius 0
    parts = length(q - vec2(tip, 0.0)) < length(spans) ? vec2(float(VEXTURE_MOST_RAMP_PARTS)) : parts;
    float a = (focus.x - grows) * (focus.x + grows);  // exactly 0 for circles that touch, even if products are fused
    if (a >= 0.0 && grows > 0.0) {
        // the middle of a part of what is in a cone may be beside it, and then in the cone behind the tip
        float outside = q.x - tip + sqrt(a) / grows * abs(q.y);
        q.x -= outside < 0.5 * float(VEXTURE_MOST_RAMP_PARTS) * length(spans) ? max(outside, 0.0) : 0.0;
    }
    float b = focus.y * grows - q.x * focus.x;
    float c = dot(q, q) - focus.y * focus.y;
    float inside = b * b - a * c;
    if (a >= 0.0) {
        vec2 slope = -2.0 * vec2(b * focus.x + a * q.x, a * q.y);
        vec2 sides = vexture_spans(slope.x * across.xy + slope.y * up.xy, region);
        float least = 0.25 * (sides.x + sides.y);
        parts = inside < 4.0 * least ? vec2(float(VEXTURE_MOST_RAMP_PARTS)) : parts;
        if (inside < least) {
            q += (least - inside) / max(dot(slope, slope), VEXTURE_NOTHING) * slope;
            b = focus.y * grows - q.x * focus.x;
            c = dot(q, q) - focus.y * focus.y;
            inside = b * b - a * c;
        }
    }
    float root = sqrt(max(inside, 0.0));
    float far = b < 0.0 ? b - root : b + root;  // the roots are far / a and c / far, neither of which cancels
    float first = a != 0.0 ? far / a : VEXTURE_NO_PLACE;
    float second = far != 0.0 ? c / far : VEXTURE_NO_PLACE;
    float t = max(first, second);
    t = focus.y + t * grows < -VEXTURE_LEAST_RADIUS || t > -VEXTURE_NO_PLACE ? min(first, second) : t;
    float radius = focus.y + t * grows;
    bool exists = radius >= -VEXTURE_LEAST_RADIUS && t > VEXTURE_NO_PLACE;
    vec2 e = vec2(q.x + t * focus.x, q.y);
    e = length(e) > VEXTURE_LEAST_RADIUS ? normalize(e) : vec2(0.0);  // a circle of radius 0 has no direction
    float down = grows - e.x * focus.x;
    vec2 beside = vexture_spans(e.x * up.xy - e.y * across.xy, region);
    float bend = dot(beside, beside) / 12.0;
    bend /= max(sqrt(radius * radius + bend) + radius, VEXTURE_NOTHING);
    vec2 ahead = vexture_spans(e.x * across.xy + e.y * up.xy, region);
    float least_bend = VEXTURE_RAMP_BEND * max(radius, 0.0) * (ahead.x + ahead.y);
    parts = max(parts, beside / sqrt(max(least_bend, VEXTURE_NOTHING)));
    float inverse = down != 0.0 ? 1.0 / down : 0.0;
    vec2 way = inverse * (e.x * across.xy + e.y * up.xy);
    return VextureRamp(t + inverse * bend, way, exists, parts);
}

// Adds to a sum the integral of a stretch of a ramp between two stops, given by the colour and slope at its start. The
// weights are a trapezoid: they rise from the first of its edges to the second, are 1 up to the third, and fall up to the
// fourth. In each of these parts Simpson's rule is exact: a premultiplied colour, which is quadratic, is multiplied by a
// linear weight.
vec4 vexture_add_stretch(vec4 total, vec4 color, vec4 slope, vec2 stretch, vec4 edges) {
    for (int k = 0; k < 3; k++) {
        vec2 part = clamp(k == 0 ? edges.xy : k == 1 ? edges.yz : edges.zw, stretch.x, stretch.y);
        if (part.y > part.x) {
            vec2 weights = vec2(1.0);
            weights = k == 0 ? (part - edges.x) / (edges.y - edges.x) : weights;
            weights = k == 2 ? (edges.w - part) / (edges.w - edges.z) : weights;
            vec4 c0 = color + slope * (part.x - stretch.x);
            vec4 c2 = color + slope * (part.y - stretch.x);
            vec4 c1 = 0.5 * (c0 + c2);
            c0 = weights.x * vec4(c0.rgb * c0.a, c0.a);
            c1 = 2.0 * (weights.x + weights.y) * vec4(c1.rgb * c1.a, c1.a);
            c2 = weights.y * vec4(c2.rgb * c2.a, c2.a);
            total += (part.y - part.x) / 6.0 * (c0 + c1 + c2);
        }
    }
    return total;
}

// Adds the same of a whole ramp between bounds; before its first stop and after its last, their colours continue.
vec4 vexture_add_ramp(vec4 total, uint stops, uint number, vec4 edges, vec2 bounds) {
    vec4 before = vec4(0.0);
    float begin = bounds.x;
    for (uint k = 0u; k <= number; k++) {
        vec4 after = before;
        float end = bounds.y;
        if (k < number) {
            uvec4 stop = vexture_texel(stops + k);
            after = vexture_halves(stop.yz) / float(VEXTURE_PAINT_ONE);
            end = uintBitsToFloat(stop.x);
        }
        before = k == 0u ? after : before;
        float a = clamp(begin, bounds.x, bounds.y);
        float b = clamp(end, a, bounds.y);
        if (b > a) {
            vec4 slope = k == 0u || k == number ? vec4(0.0) : (after - before) / (end - begin);
            total = vexture_add_stretch(total, before + slope * (a - begin), slope, vec2(a, b), edges);
        }
        if (end >= bounds.y) {
            break;
        }
        begin = end;
        before = after;
    }
    return total;
}

// Integral of a ramp with its spread method; over at most two periods if it is not padded.
vec4 vexture_spread_sum(uint stops, uint number, uint spread, vec4 edges) {
    bool pads = spread == uint(VEXTURE_SPREAD_PAD);
    vec4 sum = vec4(0.0);
    float whole = pads ? 0.0 : floor(edges.x);
    for (int k = 0; k < 3; k++) {
        vec4 here = edges - whole;
        here = spread == uint(VEXTURE_SPREAD_REFLECT) && vexture_mod(whole, 2.0) != 0.0 ? 1.0 - here.wzyx : here;
        sum = vexture_add_ramp(sum, stops, number, here, pads ? here.xw : clamp(here.xw, 0.0, 1.0));
        whole += 1.0;
        if (pads || whole >= edges.w) {
            break;
        }
    }
    return sum;
}

// Mean of a ramp over a parallelogram, given the position at its centre and the change along its sides: the weights of
// positions are a trapezoid. If the ramp repeats, whole periods of a side have the mean of a period; the rest of the side
// counts with its share, moved by half of these periods.
vec4 vexture_ramp_mean(uint stops, uint number, uint spread, float middle, vec2 spans) {
    bool pads = spread == uint(VEXTURE_SPREAD_PAD);
    spans = clamp(spans, pads ? 0.0 : VEXTURE_SHORTEST_RAMP, VEXTURE_LONGEST_RAMP);
    float period = spread == uint(VEXTURE_SPREAD_REFLECT) ? 2.0 : 1.0;
    vec2 whole = pads ? vec2(0.0) : period * floor(spans / period + 0.5);
    vec2 rest = abs(spans - whole);
    float share = (1.0 - whole.x / max(spans.x, VEXTURE_NOTHING)) * (1.0 - whole.y / max(spans.y, VEXTURE_NOTHING));
    vec4 mean = vec4(0.0);
    if (abs(share) >= 1.0 - VEXTURE_NEARLY_WHOLE) {
        float wide = max(max(rest.x, rest.y), VEXTURE_SHORTEST_RAMP);
        float narrow = min(rest.x, rest.y);
        // a repeated ramp is periodic in 2, and float32 is finer near 0
        float turned = vexture_mod(vexture_mod(middle, 2.0) - 0.5 * vexture_mod(whole.x + whole.y, 4.0), 2.0);
        middle = pads ? clamp(middle, -wide - narrow, 1.0 + wide + narrow) : turned;
        vec4 edges = middle + 0.5 * vec4(-wide - narrow, narrow - wide, wide - narrow, wide + narrow);
        float size = 0.5 * (edges.w - edges.x + edges.z - edges.y);
        mean = vexture_spread_sum(stops, number, spread, edges) / size;
    }
    if (whole != vec2(0.0)) {
        vec4 full = vexture_add_ramp(vec4(0.0), stops, number, vec4(0.0, 0.0, 1.0, 1.0), vec2(0.0, 1.0));
        mean = mix(full, mean, share);
    }
    return mean;
}

// Ramp of a gradient over a region, from the gradient's first texel and its index.
VextureRamp vexture_gradient_ramp(uint at, uvec4 record, VextureRegion region) {
    uint kind = record.w >> VEXTURE_KIND_SHIFT;
    vec3 across = uintBitsToFloat(record.xyz);
    if (kind == uint(VEXTURE_KIND_LINEAR)) {
        return VextureRamp(dot(across.xy, region.point) + across.z, across.xy, true, vec2(0.0));
    }
    vec2 focus = vec2(0.0);
    if (kind == uint(VEXTURE_KIND_FOCAL)) {
        focus = uintBitsToFloat(vexture_texel(at + 2u).xy);
    }
    return vexture_round_ramp(across, uintBitsToFloat(vexture_texel(at + 1u).xyz), focus, region);
}

// Premultiplied mean colour of a gradient, from its first texel, the texel's index and the number of stops, over a region
// in which its ramp is straight.
vec4 vexture_gradient(uint at, uvec4 record, uint number, VextureRegion region) {
    VextureRamp ramp = vexture_gradient_ramp(at, record, region);
    uint stops = at + (record.w & ((1u << VEXTURE_STOP_BITS) - 1u));
    uint spread = (record.w >> (VEXTURE_STOP_BITS + VEXTURE_STOP_COUNT_BITS)) & 3u;
    vec4 mean = vec4(0.0);
    if (ramp.exists) {
        mean = vexture_ramp_mean(stops, number, spread, ramp.t, vexture_spans(ramp.way, region));
    }
    return mean;
}

#if VEXTURE_GRADIENTS == 2

// A parallelogram in the pixels of a picture, from the picture's first texel: its middle and its sides.
VextureRegion vexture_picture_region(uint at, VextureRegion region) {
    vec3 across = uintBitsToFloat(vexture_texel(at + 1u).xyz);
    vec3 down = uintBitsToFloat(vexture_texel(at + 2u).xyz);
    vec2 point = vec2(dot(across.xy, region.point) + across.z, dot(down.xy, region.point) + down.z);
    vec2 right = vec2(dot(across.xy, region.right), dot(down.xy, region.right));
    return VextureRegion(point, right, vec2(dot(across.xy, region.up), dot(down.xy, region.up)));
}

// Premultiplied mean colour of a picture, from its first texel and the texel's index, over a region that has this share of
// a pixel.
vec4 vexture_picture(uint at, uvec4 record, VextureRegion region, float share) {
    ivec2 size = max(ivec2(uvec2(record.y & 0xffffu, record.y >> 16)), 1);
    uint sampling = record.w & 7u;
    bool is_one = sampling >= uint(VEXTURE_SAMPLING_OPACITY);
    VextureRegion pixels = vexture_picture_region(at, region);
    VextureLevel level = vexture_first_level(size, at + record.z, is_one);
    float opacity = float(record.x & 0xffffu) / float(VEXTURE_PAINT_ONE) / float(VEXTURE_COVERAGE_ONE);
    vec4 mean = vexture_sampled_mean(level, sampling, pixels.point, pixels.right, pixels.up, share);
    if (is_one) {
        float one = float(VEXTURE_COVERAGE_ONE);
        vec4 color = vexture_pixel(vexture_texel(at + 1u).w);
        mean = (sampling == uint(VEXTURE_SAMPLING_INVERSE) ? one - mean.x : mean.x) * vec4(color.rgb / one, 1.0);
    }
    return opacity * mean;
}

#endif

// Ends a group: lays its colour on the colour kept at its begin, or masks that colour with it.
vec4 vexture_ended(vec4 kept, vec4 color, uint how) {
    if (how < uint(VEXTURE_MASKS)) {
        return vexture_blended(kept, color, how);
    }
    vec3 parts = vec3(VEXTURE_LUMINANCE_RED, VEXTURE_LUMINANCE_GREEN, VEXTURE_LUMINANCE_BLUE);
    return kept * (how == uint(VEXTURE_MASKS + VEXTURE_MASK_LUMINANCE) ? dot(parts, color.rgb) : color.a);
}

// Premultiplied colour of a program over a region that is small enough for means of its gradients to be composited, and has
// this share of a pixel.
vec4 vexture_program_part(uint at, uint end, VextureRegion region, float share) {
    vec4 color = vec4(0.0);
    vec4 kept = vec4(0.0);
    vec4 kept_before = vec4(0.0);
    vec4 kept_first = vec4(0.0);
    uint left = uint(VEXTURE_MOST_STOPS);  // bounds the work for invalid texels
    for (; at < end; at++) {
        uvec4 texel = vexture_texel(at);
        uint kind = texel.w >> VEXTURE_KIND_SHIFT;
        if (kind == uint(VEXTURE_KIND_KEEP)) {
            kept_first = kept_before;
            kept_before = kept;
            kept = color;
            color = vec4(0.0);
        } else if (kind == uint(VEXTURE_KIND_MIX)) {
            color = vexture_ended(kept, color * (float(texel.x) / float(VEXTURE_PAINT_ONE)), texel.y);
            kept = kept_before;
            kept_before = kept_first;
        } else if (kind != uint(VEXTURE_KIND_FOLLOWS)) {
            vec4 above = vexture_halves(texel.xy) / float(VEXTURE_PAINT_ONE);
#if VEXTURE_GRADIENTS == 2
            if (kind == uint(VEXTURE_KIND_PICTURE)) {
                above = vexture_picture(at, texel, region, share);
                kind = uint(VEXTURE_KIND_SOLID);  // as its colour is known
            }
#endif
            if (kind != uint(VEXTURE_KIND_SOLID)) {
                uint number = clamp((texel.w >> VEXTURE_STOP_BITS) & uint(VEXTURE_MOST_STOPS), 1u, max(left, 1u));
                left -= min(number, left);
                above = vexture_gradient(at, texel, number, region);
            }
            color = above + (1.0 - above.a) * color;
        }
    }
    return color;
}

// Number of parts into which each side of a region is divided for a program, so that circles are nearly straight in each
// part, and ramps are short if a product of gradients or a blend mode is averaged. A small region of a pixel is divided
// less, which limits the cost of all regions of a pixel.
vec2 vexture_program_parts(uint at, uint end, VextureRegion region, float area) {
    vec2 bends = vec2(0.0);
    vec2 ramps = vec2(0.0);
    int factors = 0;  // a blend mode or a mask counts as two factors
    float for_each = float(VEXTURE_PRODUCT_PARTS);
    for (; at < end; at++) {
        uvec4 texel = vexture_texel(at);
        uint kind = texel.w >> VEXTURE_KIND_SHIFT;
        if (kind == uint(VEXTURE_KIND_MIX)) {
            factors += texel.y == uint(VEXTURE_BLEND_NORMAL) ? 0 : 2;
            // not of dodge and burn: a part beyond the end of a band has its last colour, where they may jump
            if (texel.y > uint(VEXTURE_BLEND_COLOR_BURN) && texel.y < uint(VEXTURE_MASKS)) {
                for_each = float(VEXTURE_BLEND_PARTS);
            }
        } else if (kind >= uint(VEXTURE_KIND_LINEAR) && kind <= uint(VEXTURE_KIND_FOCAL)) {
            VextureRamp ramp = vexture_gradient_ramp(at, texel, region);
            factors++;
            bends = max(bends, ramp.parts);
            ramps = max(ramps, vexture_spans(ramp.way, region));
        }
#if VEXTURE_GRADIENTS == 2
        if (kind == uint(VEXTURE_KIND_PICTURE)) {
            VextureRegion pixels = vexture_picture_region(at, region);
            factors++;
            ramps = max(ramps, VEXTURE_PICTURE_RAMP * vec2(length(pixels.right), length(pixels.up)));
        }
#endif
    }
    ramps = factors > 1 ? max(bends, for_each * ramps) : bends;
    float most = clamp(float(VEXTURE_PIXEL_PARTS) * sqrt(abs(area)), 1.0, float(VEXTURE_MOST_RAMP_PARTS));
    return ceil(clamp(ramps, 1.0, most));
}

// Premultiplied mean colour, 0..65535, of a program, given by its first texel and their number, over a region with this
// area of a pixel.
vec4 vexture_program(uint at, uint count, VextureRegion region, float area) {
    uint end = at + min(count, uint(VEXTURE_MOST_PROGRAM));
    vec2 parts = vexture_program_parts(at, end, region, area);
    int across = int(parts.x);
    int number = across * int(parts.y);
    VextureRegion part = VextureRegion(region.point, region.right / parts.x, region.up / parts.y);
    float share = max(abs(area), VEXTURE_LEAST_SHARE) / float(number);
    vec4 sum = vec4(0.0);
    for (int k = 0; k < number; k++) {
        vec2 place = vec2(ivec2(k % across, k / across)) + 0.5 - 0.5 * parts;
        part.point = region.point + place.x * part.right + place.y * part.up;
        sum += vexture_program_part(at, end, part, share);
    }
    return sum * (float(VEXTURE_PAINT_ONE) / float(number));
}

#endif
