// Paints that hold gradients (FORMAT.md, D.6): the colour of a program over a region, the part of a footprint in a cell.
// Exports: VextureRegion, vexture_halves, vexture_program.
//
// VEXTURE_GRADIENTS is 0 where no map has programs: their text is left out then, for it takes registers.
#include "tree.glsl"
#include "blend.glsl"

#ifndef VEXTURE_GRADIENTS
#define VEXTURE_GRADIENTS 1
#endif

// In the unit square.
struct VextureRegion {
    vec2 point;  // its middle
    vec2 right;  // its sides
    vec2 up;
};

// Four numbers in two words, 0..65535.
vec4 vexture_halves(uvec2 words) {
    return vec4(uvec4(words.x & 0xffffu, words.x >> 16, words.y & 0xffffu, words.y >> 16));
}

#if VEXTURE_GRADIENTS

// A place on a ramp, and how it changes along x and y of the unit square.
struct VextureRamp {
    float t;
    vec2 way;
    float share;  // of the region: beside a cone there is no place
};

// How far a value goes across a region that changes along x and y like this: the length of an interval with the variance of
// both sides.
float vexture_span(vec2 way, VextureRegion region) {
    return length(vec2(dot(way, region.right), dot(way, region.up)));
}

// The place on a circular ramp: the greatest t whose circle, about c t from the focal point, goes through the region's middle
// and has a radius, |q - c t|^2 = (fr + t dr)^2. Parameters: the rows of the map to the ramp; focal point and radius.
VextureRamp vexture_round_ramp(vec3 across, vec3 up, vec2 focus, VextureRegion region) {
    vec2 q = vec2(dot(across.xy, region.point) + across.z - focus.x, dot(up.xy, region.point) + up.z);
    float grows = 1.0 - focus.y;
    float a = focus.x * focus.x - grows * grows;
    float b = focus.y * grows - q.x * focus.x;
    float c = dot(q, q) - focus.y * focus.y;
    float inside = b * b - a * c;
    vec2 slope = -2.0 * vec2(b * focus.x + a * q.x, a * q.y);
    float soft = vexture_span(slope.x * across.xy + slope.y * up.xy, region);
    float share = a < 0.0 ? 1.0 : clamp(0.5 + inside / max(soft, VEXTURE_NOTHING), 0.0, 1.0);
    float root = sqrt(max(inside, 0.0));
    float far = b < 0.0 ? b - root : b + root;  // the roots are far / a and c / far: neither is a small difference
    float first = a != 0.0 ? far / a : VEXTURE_NO_PLACE;
    float second = far != 0.0 ? c / far : VEXTURE_NO_PLACE;
    float t = max(first, second);
    t = focus.y + t * grows < -VEXTURE_LEAST_RADIUS || t > -VEXTURE_NO_PLACE ? min(first, second) : t;
    bool exists = focus.y + t * grows >= -VEXTURE_LEAST_RADIUS && t > VEXTURE_NO_PLACE;
    vec2 e = vec2(q.x + t * focus.x, q.y);
    e = length(e) > VEXTURE_LEAST_RADIUS ? normalize(e) : vec2(0.0);  // of a point, no direction is known
    float down = grows - e.x * focus.x;
    e = down != 0.0 ? e / down : vec2(0.0);
    return VextureRamp(t, e.x * across.xy + e.y * up.xy, exists ? share : 0.0);
}

// Integral of a ramp over an interval: Simpson's rule is exact for a premultiplied segment between two stops.
vec4 vexture_ramp_sum(uint stops, uint number, float low, float high) {
    vec4 sum = vec4(0.0);
    vec4 before = vec4(0.0);
    float begin = low;
    for (uint k = 0u; k <= number; k++) {
        uvec4 stop = vexture_texel(stops + min(k, number - 1u));
        vec4 after = vexture_halves(stop.yz) / float(VEXTURE_PAINT_ONE);
        float end = k < number ? uintBitsToFloat(stop.x) : high;
        before = k == 0u ? after : before;
        float a = clamp(begin, low, high);
        float b = clamp(end, a, high);
        if (b > a) {
            vec4 slope = k == 0u || k == number ? vec4(0.0) : (after - before) / (end - begin);
            vec4 c0 = before + slope * (a - begin);
            vec4 c2 = before + slope * (b - begin);
            vec4 c1 = 0.5 * (c0 + c2);
            sum += (b - a) / 6.0 * vec4(c0.rgb * c0.a + 4.0 * c1.rgb * c1.a + c2.rgb * c2.a, 6.0 * c1.a);
        }
        if (end >= high) {
            break;
        }
        begin = end;
        before = after;
    }
    return sum;
}

// Mean of a ramp over an interval; beyond 0..1 it goes on as `spread` says.
vec4 vexture_ramp_mean(uint stops, uint number, uint spread, float middle, float width) {
    if (spread != uint(VEXTURE_SPREAD_PAD) && width >= 1.0) {
        return vexture_ramp_sum(stops, number, 0.0, 1.0);
    }
    bool pads = spread == uint(VEXTURE_SPREAD_PAD);
    middle = pads ? clamp(middle, -width, 1.0 + width) : middle;
    float low = middle - 0.5 * width;
    float whole = pads ? 0.0 : floor(low);
    low -= whole;
    float high = low + width;
    bool back = spread == uint(VEXTURE_SPREAD_REFLECT) && mod(whole, 2.0) != 0.0;
    float held = pads ? high : min(high, 1.0);
    vec2 part = back ? vec2(1.0 - held, 1.0 - low) : vec2(low, held);
    float size = part.y - part.x;
    vec4 sum = vexture_ramp_sum(stops, number, part.x, part.y);
    if (held < high) {
        bool goes_back = spread == uint(VEXTURE_SPREAD_REFLECT) && !back;
        part = goes_back ? vec2(2.0 - high, 1.0) : vec2(0.0, high - 1.0);
        size += part.y - part.x;
        sum += vexture_ramp_sum(stops, number, part.x, part.y);
    }
    return sum / size;
}

// Premultiplied colour of a gradient, whose first texel is given with its index, and its number of stops. A region in which a
// circle bends, or a ramp begins again, is divided.
vec4 vexture_gradient(uint at, uvec4 texel, uint number, VextureRegion region) {
    uint kind = texel.w >> VEXTURE_KIND_SHIFT;
    vec3 across = uintBitsToFloat(texel.xyz);
    vec3 up = vec3(0.0);
    vec2 focus = vec2(0.0);
    if (kind != uint(VEXTURE_KIND_LINEAR)) {
        up = uintBitsToFloat(vexture_texel(at + 1u).xyz);
    }
    if (kind == uint(VEXTURE_KIND_FOCAL)) {
        focus = uintBitsToFloat(vexture_texel(at + 2u).xy);
    }
    uint stops = at + (texel.w & ((1u << VEXTURE_STOP_BITS) - 1u));
    uint spread = (texel.w >> (VEXTURE_STOP_BITS + VEXTURE_STOP_COUNT_BITS)) & 3u;
    float size = float(VEXTURE_RAMP_PARTS) * max(vexture_span(across.xy, region), vexture_span(up.xy, region));
    int parts = size < float(VEXTURE_MOST_RAMP_PARTS) ? max(int(ceil(size)), 1) : VEXTURE_MOST_RAMP_PARTS;
    VextureRegion part = VextureRegion(region.point, region.right / float(parts), region.up / float(parts));
    vec4 sum = vec4(0.0);
    for (int k = 0; k < parts * parts; k++) {
        vec2 place = vec2(ivec2(k % parts, k / parts)) + 0.5 - 0.5 * float(parts);
        part.point = region.point + place.x * part.right + place.y * part.up;
        VextureRamp ramp = VextureRamp(dot(across.xy, part.point) + across.z, across.xy, 1.0);
        if (kind != uint(VEXTURE_KIND_LINEAR)) {
            ramp = vexture_round_ramp(across, up, focus, part);
        }
        if (ramp.share > 0.0) {
            float width = clamp(vexture_span(ramp.way, part), VEXTURE_SHORTEST_RAMP, VEXTURE_LONGEST_RAMP);
            sum += ramp.share * vexture_ramp_mean(stops, number, spread, ramp.t, width);
        }
    }
    return sum / float(parts * parts);
}

// Premultiplied colour of a program, given by its first texel and how many it has; in steps of a paint.
vec4 vexture_program(uint at, uint count, VextureRegion region) {
    vec4 color = vec4(0.0);
    vec4 kept = vec4(0.0);
    vec4 kept_before = vec4(0.0);
    uint end = at + min(count, uint(VEXTURE_MOST_PROGRAM));
    uint left = uint(VEXTURE_MOST_STOPS);  // what is no program ends as well
    for (; at < end; at++) {
        uvec4 texel = vexture_texel(at);
        uint kind = texel.w >> VEXTURE_KIND_SHIFT;
        if (kind == uint(VEXTURE_KIND_KEEP)) {
            kept_before = kept;
            kept = color;
            color = vec4(0.0);
        } else if (kind == uint(VEXTURE_KIND_MIX)) {
            color = vexture_blended(kept, color * (float(texel.x) / float(VEXTURE_PAINT_ONE)), texel.y);
            kept = kept_before;
        } else if (kind != uint(VEXTURE_KIND_FOLLOWS)) {
            vec4 above = vexture_halves(texel.xy) / float(VEXTURE_PAINT_ONE);
            if (kind != uint(VEXTURE_KIND_SOLID)) {
                uint number = clamp((texel.w >> VEXTURE_STOP_BITS) & uint(VEXTURE_MOST_STOPS), 1u, max(left, 1u));
                left -= min(number, left);
                above = vexture_gradient(at, texel, number, region);
            }
            color = above + (1.0 - above.a) * color;
        }
    }
    return color * float(VEXTURE_PAINT_ONE);
}

#endif
