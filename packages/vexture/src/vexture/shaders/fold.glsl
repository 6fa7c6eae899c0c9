// Texture folding: a small texture displaces the positions at which a shape is looked up, over time (FORMAT.md, part C).
// Exports: VextureFolded, vextureFold.
//
// Outside the unit square the fold's border applies, or with VEXTURE_WRAP_REPEAT the fold repeats.

#ifndef VEXTURE_WRAP
#define VEXTURE_WRAP VEXTURE_WRAP_NONE
#endif

uniform highp usampler2D vextureFolding;  // top row first
uniform float vextureTime;                // seconds, reduced to the cycle if there is one
uniform float vextureCycle;               // seconds; 0: once

// A pixel's footprint at the position where the shape is looked up.
struct VextureFolded {
    vec2 uv;
    vec2 dx;
    vec2 dy;
};

// The share of a texel's displacement that applies now: 0 to 1, or -1 to 1 for the periodic kind.
float vexture_progress(uvec4 texel) {
    float tick = 1.0 / float(VEXTURE_FOLD_TICKS);
    float since = vextureTime - float(texel.z & ((1u << VEXTURE_FOLD_KIND_SHIFT) - 1u)) * tick;
    since -= vextureCycle > 0.0 ? vextureCycle * floor(since / vextureCycle) : 0.0;
    float part = max(since / (float(texel.w) * tick), 0.0);
    uint kind = texel.z >> VEXTURE_FOLD_KIND_SHIFT;
    if (kind == uint(VEXTURE_FOLD_PERIODIC)) {
        return sin(6.28318531 * (part - floor(part)));
    }
    float x = min(part, 1.0);
    float y = 1.0 - x;
    float eased = kind == uint(VEXTURE_FOLD_SMOOTH_BOTH) ? x * x * (3.0 - 2.0 * x) : x;
    eased = kind == uint(VEXTURE_FOLD_SMOOTH_START) ? x * x : eased;
    return kind == uint(VEXTURE_FOLD_SMOOTH_END) ? 1.0 - y * y : eased;
}

// Parameters: a position as 32-bit fixed point (1.0 = 2^32) and an offset from it; the steps to the next pixels. The
// result's uv is the new offset from the same base.
//
// The current displacements of nine texels are the control points of a quadratic B-spline; its gradient transforms the
// footprint. The position within the texel is computed in fixed point, because a float would lose its last digits.
VextureFolded vextureFold(uvec2 base, vec2 offset, vec2 dx, vec2 dy) {
    ivec2 size = textureSize(vextureFolding, 0);
    uvec2 low = (base & 0xffffu) * uvec2(size);
    uvec2 high = (base >> 16) * uvec2(size) + (low >> 16);
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    vec2 near = offset - floor(offset);
#else
    vec2 near = clamp(offset, -2.0, 2.0);
#endif
    vec2 part = (vec2(ivec2(high & 0xffffu)) + vec2(ivec2(low & 0xffffu)) / 65536.0) / 65536.0 + near * vec2(size);
    vec2 whole = floor(part);
    ivec2 middle = ivec2(high >> 16) + ivec2(whole);
    vec2 t = part - whole - 0.5;
    vec2 a = 0.5 - t;
    vec2 b = 0.5 + t;
    vec2 weights[3] = vec2[3](0.5 * a * a, 0.75 - t * t, 0.5 * b * b);
    vec2 slopes[3] = vec2[3](-a, -2.0 * t, b);
    vec2 moved = vec2(0.0);
    vec2 along_x = vec2(0.0);
    vec2 along_y = vec2(0.0);
    for (int k = 0; k < 9; k++) {
        int i = k % 3;
        int j = k / 3;
        ivec2 at = middle + ivec2(i - 1, j - 1);
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
        at = (at + size) % size;
#else
        at = clamp(at, ivec2(0), size - 1);
#endif
        uvec4 texel = texelFetch(vextureFolding, ivec2(at.x, size.y - 1 - at.y), 0);
        vec2 now = uintBitsToFloat(texel.xy) * vexture_progress(texel);
        moved += weights[i].x * weights[j].y * now;
        along_x += slopes[i].x * weights[j].y * now;
        along_y += weights[i].x * slopes[j].y * now;
    }
    along_x *= float(size.x);
    along_y *= float(size.y);
    vec2 right = dx + along_x * dx.x + along_y * dx.y;
    vec2 up = dy + along_x * dy.x + along_y * dy.y;
    return VextureFolded(offset + moved, right, up);
}

VextureFolded vextureFold(vec2 uv, vec2 dx, vec2 dy) {
    return vextureFold(uvec2(0u), uv, dx, dy);
}
