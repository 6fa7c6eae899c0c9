// Steps of a position to the next pixels, as they are at the pixel itself.
// Exports: vextureStepX, vextureStepY.
//
// GPUs take derivatives as differences between the two pixels of a pair. On a plane in perspective a position is N / D,
// and N and D = gl_FragCoord.w grow evenly over the picture; so the difference is (N' D - N D') / (D of one, D of the
// other), while the derivative at a pixel has its own D twice. Towards a horizon the two differ by a tenth and more.

// D of a pair's other pixel in D of this one; `odd` is whether the pixel's number is, `step` the difference of that.
float vexture_other(float odd, float step, float more) {
    float way = (1.0 - 2.0 * odd) * step;  // 1 in the first pixel of a pair, -1 in the second
    return clamp(1.0 + way * more / gl_FragCoord.w, 0.5, 2.0);  // beyond that lies the edge of a triangle
}

vec2 vextureStepX(vec2 position) {
    float odd = mod(floor(gl_FragCoord.x), 2.0);
    return dFdx(position) * vexture_other(odd, dFdx(odd), dFdx(gl_FragCoord.w));
}

vec2 vextureStepY(vec2 position) {
    float odd = mod(floor(gl_FragCoord.y), 2.0);
    return dFdy(position) * vexture_other(odd, dFdy(odd), dFdy(gl_FragCoord.w));
}
