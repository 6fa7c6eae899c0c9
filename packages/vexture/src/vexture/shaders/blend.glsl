// Blend modes (Compositing and Blending Level 1 of the W3C).
// Exports: vexture_blended.

// Blend function B(cb, cs) of one component: b of the backdrop, s of the source that is laid over it.
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

float vexture_luminosity(vec3 c) {
    return dot(c, vec3(0.3, 0.59, 0.11));
}

float vexture_saturation(vec3 c) {
    return max(max(c.r, c.g), c.b) - min(min(c.r, c.g), c.b);
}

// The W3C's SetSat.
vec3 vexture_with_saturation(vec3 c, float wanted) {
    return (c - min(min(c.r, c.g), c.b)) * (wanted / max(vexture_saturation(c), VEXTURE_NOTHING));
}

// The W3C's SetLum and ClipColor.
vec3 vexture_with_luminosity(vec3 c, float wanted) {
    c += wanted - vexture_luminosity(c);
    float least = min(min(c.r, c.g), c.b);
    float greatest = max(max(c.r, c.g), c.b);
    float share = least < 0.0 ? wanted / (wanted - least) : 1.0;
    share = greatest > 1.0 ? (1.0 - wanted) / (greatest - wanted) : share;
    return wanted + (c - wanted) * share;
}

// Makes a colour grey that differs from grey by rounding only: hue and saturation would amplify the difference.
vec3 vexture_greyed(vec3 c) {
    return vexture_saturation(c) < VEXTURE_GREY ? vec3(vexture_luminosity(c)) : c;
}

// Makes a component exactly 0 or 1 if it differs by rounding only: dodge and burn jump there.
float vexture_settled(float c) {
    return c < VEXTURE_LEAST_COLOR ? 0.0 : c > 1.0 - VEXTURE_LEAST_COLOR ? 1.0 : c;
}

// Straight colour of a premultiplied colour.
vec3 vexture_straight_color(vec4 color, bool is_whole) {
    vec3 c = color.rgb / max(color.a, VEXTURE_NOTHING);
    c = vec3(vexture_settled(c.r), vexture_settled(c.g), vexture_settled(c.b));
    return is_whole ? vexture_greyed(c) : c;
}

// Blend function B(cb, cs) of straight colours.
vec3 vexture_mixture(uint blend, vec3 b, vec3 s) {
    if (blend < uint(VEXTURE_BLEND_HUE)) {
        float red = vexture_separable(blend, b.r, s.r);
        return vec3(red, vexture_separable(blend, b.g, s.g), vexture_separable(blend, b.b, s.b));
    }
    vec3 color = blend == uint(VEXTURE_BLEND_COLOR) ? s : b;
    if (blend == uint(VEXTURE_BLEND_HUE)) {
        color = vexture_with_saturation(s, vexture_saturation(b));
    } else if (blend == uint(VEXTURE_BLEND_SATURATION)) {
        color = vexture_with_saturation(b, vexture_saturation(s));
    }
    return vexture_with_luminosity(color, vexture_luminosity(blend == uint(VEXTURE_BLEND_LUMINOSITY) ? s : b));
}

// Lays one premultiplied colour over another.
vec4 vexture_blended(vec4 below, vec4 above, uint mode) {
    if (mode == uint(VEXTURE_BLEND_NORMAL)) {
        return above + (1.0 - above.a) * below;
    }
    if (mode == uint(VEXTURE_BLEND_PLUS_LIGHTER)) {
        return min(below + above, 1.0);
    }
    bool is_whole = mode >= uint(VEXTURE_BLEND_HUE);
    vec3 b = vexture_straight_color(below, is_whole);
    vec3 s = vexture_straight_color(above, is_whole);
    vec3 apart = above.rgb * (1.0 - below.a) + below.rgb * (1.0 - above.a);
    return vec4(apart + above.a * below.a * vexture_mixture(mode, b, s), above.a + below.a * (1.0 - above.a));
}
