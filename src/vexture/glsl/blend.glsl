// Blend modes that treat each component by itself (Compositing and Blending Level 1 of the W3C).
// Exports: vexture_blended.

// B(cb, cs) of one component, b of what is below and s of what is laid over it.
float vexture_separable(uint blend, float b, float s) {
    switch (blend) {
    case uint(VEXTURE_BLEND_MULTIPLY):
        return b * s;
    case uint(VEXTURE_BLEND_SCREEN):
        return b + s - b * s;
    case uint(VEXTURE_BLEND_OVERLAY):
        return b <= 0.5 ? 2.0 * b * s : 1.0 - 2.0 * (1.0 - b) * (1.0 - s);
    case uint(VEXTURE_BLEND_DARKEN):
        return min(b, s);
    case uint(VEXTURE_BLEND_LIGHTEN):
        return max(b, s);
    case uint(VEXTURE_BLEND_COLOR_DODGE):
        return b == 0.0 ? 0.0 : s >= 1.0 ? 1.0 : min(1.0, b / (1.0 - s));
    case uint(VEXTURE_BLEND_COLOR_BURN):
        return b >= 1.0 ? 1.0 : s == 0.0 ? 0.0 : 1.0 - min(1.0, (1.0 - b) / s);
    case uint(VEXTURE_BLEND_HARD_LIGHT):
        return s <= 0.5 ? 2.0 * b * s : 1.0 - 2.0 * (1.0 - b) * (1.0 - s);
    case uint(VEXTURE_BLEND_SOFT_LIGHT): {
        float root = b <= 0.25 ? ((16.0 * b - 12.0) * b + 4.0) * b : sqrt(b);
        return b + (2.0 * s - 1.0) * (s <= 0.5 ? b * (1.0 - b) : root - b);
    }
    case uint(VEXTURE_BLEND_DIFFERENCE):
        return abs(b - s);
    }
    return b + s - 2.0 * b * s;  // exclusion
}

// One premultiplied colour over another.
vec4 vexture_blended(vec4 below, vec4 above, uint mode) {
    if (mode == uint(VEXTURE_BLEND_NORMAL)) {
        return above + (1.0 - above.a) * below;
    }
    if (mode == uint(VEXTURE_BLEND_PLUS_LIGHTER)) {
        return min(below + above, 1.0);
    }
    vec3 b = min(below.rgb / max(below.a, VEXTURE_NOTHING), 1.0);
    vec3 s = min(above.rgb / max(above.a, VEXTURE_NOTHING), 1.0);
    vec3 mixed;
    for (int k = 0; k < 3; k++) {
        mixed[k] = vexture_separable(mode, b[k], s[k]);
    }
    vec3 apart = above.rgb * (1.0 - below.a) + below.rgb * (1.0 - above.a);
    return vec4(apart + above.a * below.a * mixed, above.a + below.a * (1.0 - above.a));
}
