// What a texel, which may have no more than eight bits, says of the box around it: no outline at all, 0 or 1; else how
// much of it is the shape's.
// Exports: vexture_around, vexture_share.

const float vexture_mixed = 8.0 / 255.0;  // so far from 0 and 1 that a blend whose nearest texel is mixed is neither

float vexture_around(float share) {
    return mix(vexture_mixed, 1.0 - vexture_mixed, share);
}

vec2 vexture_share(vec2 around) {
    return clamp((around - vexture_mixed) / (1.0 - 2.0 * vexture_mixed), 0.0, 1.0);
}
