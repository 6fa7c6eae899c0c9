// A texel of at most eight bits describes the box around it. It is exactly 0 or 1 if no outline passes through the box;
// otherwise a value in between encodes the share of the box that the shape fills.
// Exports: vexture_around, vexture_share.

const float vexture_mixed = 8.0 / 255.0;  // if the nearest texel is mixed, a blend is neither 0 nor 1

float vexture_around(float share) {
    return mix(vexture_mixed, 1.0 - vexture_mixed, share);
}

vec2 vexture_share(vec2 around) {
    return clamp((around - vexture_mixed) / (1.0 - 2.0 * vexture_mixed), 0.0, 1.0);
}
