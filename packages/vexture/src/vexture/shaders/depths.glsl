// Water of known depth: calm where no waves come, tinted by its depth, clear where it is shallow; or depths as colours.
// Exports: VextureField, vextureField, vextureCalm, vextureJoined, vextureDepthColor.

const int vexture_most_classes = 8;

uniform sampler2D vextureFields;  // over the mesh: metres of depth, and how open the water is to waves, 0..1
uniform vec3 vextureShoal;        // light from calm water where it is shallow,
uniform vec3 vextureDeep;         // and where it is deep
uniform vec3 vextureMurk;         // metres in which the ground fades to 1/e, and the shallow colour turns into the deep one;
                                  // how much of the ground the shallowest water hides
uniform int vextureClasses;       // number of colours of depths; 0: water looks like water
uniform vec4 vextureClassColors[vexture_most_classes];  // and their opacity,
uniform float vextureClassFrom[vexture_most_classes];   // from these depths in metres, in ascending order
uniform bool vextureClassSmooth;  // one turns into the next

struct VextureField {
    float depth;     // metres
    float openness;  // 0..1
    float step;      // metres of depth in a pixel
};

VextureField vextureField(vec2 at) {
    vec2 found = texture(vextureFields, at).rg;
    float depth = max(found.x, 0.0);
    return VextureField(depth, clamp(found.y, 0.0, 1.0), fwidth(depth));
}

// Light and opacity of calm water: the reflection, by Schlick's approximation of Fresnel's equations, over its own colour,
// which hides the ground by Beer's law along the slanted path to it.
vec4 vextureCalm(float depth, vec3 mirrored, float facing) {
    float reflectance = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    float hidden = (1.0 - reflectance) * (1.0 - (1.0 - vextureMurk.z) * exp(-depth / (vextureMurk.x * max(facing, 0.4))));
    vec3 body = mix(vextureDeep, vextureShoal, exp(-depth / vextureMurk.y));
    float opacity = hidden + reflectance;
    return vec4((hidden * body + reflectance * mirrored) / opacity, opacity);
}

// One light over to another, each with its opacity.
vec4 vextureJoined(vec4 one, vec4 other, float share) {
    vec4 joined = mix(vec4(one.rgb * one.a, one.a), vec4(other.rgb * other.a, other.a), share);
    return vec4(joined.rgb / max(joined.a, 1e-6), joined.a);
}

// Colour of a depth. Between two classes it changes within a pixel.
vec4 vextureDepthColor(VextureField field) {
    vec4 color = vextureClassColors[0];
    for (int k = 1; k < vexture_most_classes; k++) {
        if (k < vextureClasses) {
            float from = vextureClassFrom[k];
            float width = max(field.step, 1e-6);
            float share = (field.depth - from) / width + 0.5;
            if (vextureClassSmooth) {
                share = (field.depth - vextureClassFrom[k - 1]) / max(from - vextureClassFrom[k - 1], 1e-6);
            }
            color = mix(color, vextureClassColors[k], clamp(share, 0.0, 1.0));
        }
    }
    return color;
}
