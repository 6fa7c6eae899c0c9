// Steps of a position to the next pixels: derivatives at the pixel itself.
// Exports: vextureStepX, vextureStepY.
//
// GPUs compute derivatives as differences between the two pixels of a pair. On a plane in perspective a position is N / D,
// where N and D = gl_FragCoord.w are linear over the picture. The difference is (N' D - N D') / (D of one pixel * D of the
// other), but the derivative at a pixel has the square of its own D. Near a horizon the two differ by 10% and more.

// D of a pair's other pixel relative to this one's; `odd` is the parity of the pixel's number, `step` its difference.
fn vexture_other(vexture_fragment: vec4f, odd: f32, step: f32, more: f32) -> f32 {
    let way: f32 = (1.0 - 2.0 * odd) * step;  // 1 in the first pixel of a pair, -1 in the second
    return clamp(1.0 + way * more / vexture_fragment.w, 0.5, 2.0);  // beyond that lies the edge of a triangle
}

fn vextureStepX(vexture_fragment: vec4f, position: vec2f) -> vec2f {
    let odd: f32 = 2.0 * fract(0.5 * floor(vexture_fragment.x));
    return dpdxFine(position) * vexture_other(vexture_fragment, odd, dpdxFine(odd), dpdxFine(vexture_fragment.w));
}

fn vextureStepY(vexture_fragment: vec4f, position: vec2f) -> vec2f {
    let odd: f32 = 2.0 * fract(0.5 * floor(vexture_fragment.y));
    return dpdyFine(position) * vexture_other(vexture_fragment, odd, dpdyFine(odd), dpdyFine(vexture_fragment.w));
}
