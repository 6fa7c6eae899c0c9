// Conversion of colours to linear light.
// Exports: vexture_linear.

// Converts sRGB components to linear ones (IEC 61966-2-1).
vec3 vexture_linear(vec3 encoded) {
    vec3 bent = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return mix(bent, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}
