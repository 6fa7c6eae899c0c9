// Steps of a position to the next pixels: derivatives at the pixel itself.
// Exports: vextureStepX, vextureStepY.
//
// GPUs compute derivatives as differences between the two pixels of a pair. On a plane in perspective a position is N / D,
// where N and D = gl_FragCoord.w are linear over the picture. The difference is (N' D - N D') / (D of one pixel * D of the
// other), but the derivative at a pixel has the square of its own D. Near a horizon the two differ by 10% and more.

// D of a pair's other pixel relative to this one's; `odd` is the parity of the pixel's number, `step` its difference.
float vexture_other(float odd, float step, float more) {
    float way = (1.0 - 2.0 * odd) * step;  // 1 in the first pixel of a pair, -1 in the second
    return clamp(1.0 + way * more / gl_FragCoord.w, 0.5, 2.0);  // beyond that lies the edge of a triangle
}

vec2 vextureStepX(vec2 position) {
    float odd = 2.0 * fract(0.5 * floor(gl_FragCoord.x));
    return dFdx(position) * vexture_other(odd, dFdx(odd), dFdx(gl_FragCoord.w));
}

vec2 vextureStepY(vec2 position) {
    float odd = 2.0 * fract(0.5 * floor(gl_FragCoord.y));
    return dFdy(position) * vexture_other(odd, dFdy(odd), dFdy(gl_FragCoord.w));
}
