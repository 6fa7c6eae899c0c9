// Water along a shore: its coverage, the distance of the shore, and the shallows and foam near it.
// Exports: VextureWater, vextureWater, vextureShallows, vextureFoam, vextureInshore, VextureLight, vextureSkyOf, vextureSea.
//
// The distance follows from the rasters that shore.glsl draws: beside a straight shore, the filled share of the box around
// a position grows linearly from 1/2 on the shore to 1 at half the box's width from it.
#include "wrap.glsl"
#include "around.glsl"

uniform int vextureShapes;    // number: 0, 1, or 2 during a transition
uniform uvec2 vextureQuads;   // their roots,
uniform ivec2 vextureRows;    // the first row of each one's texels,
uniform vec2 vextureShares;   // weight of each in the picture; 0 if there is none
uniform sampler2D vextureAround;      // the first one's raster
uniform sampler2D vextureAroundNext;  // and the second's
uniform vec3 vextureBox;      // half the width of their wide boxes, in the unit square; that and the near one's less a texel
uniform float vextureShore;   // width of the strip along the shore, in the unit square; 0: none
uniform float vextureLapping; // seconds from one line of foam to the next

struct VextureWater {
    float coverage;  // of the pixel
    float offshore;  // distance of the shore in widths of the strip, at most 1
    float openness;  // 1 along wide water, 0 in channels that are narrow beside the strip
    vec2 place;      // in widths of the strip
    vec2 dx;         // and its steps to the next pixels
    vec2 dy;
};

// Parameters: those of vextureCoverage. Where the boxes hold no outline, a pixel within them holds none either: no
// lookup is needed. Lookups are iterations of a loop, so that pixels without any skip their cost.
VextureWater vextureWater(vec2 uv, vec2 dx, vec2 dy) {
    vec2 reach = abs(dx) + abs(dy);
    float pixel = max(reach.x, reach.y);
    vec4 around = vec4(textureLod(vextureAround, uv, 0.0).rg, textureLod(vextureAroundNext, uv, 0.0).rg);
    vec2 raster = around.xz;
    vec2 told = 0.5 * pixel < vextureBox.z ? around.yw : raster;
    bool is_clear = 0.5 * pixel < vextureBox.y && vextureShares == vextureShares * abs(2.0 * told - 1.0);
    float coverage = is_clear ? dot(vextureShares, told) : 0.0;
    int shape = is_clear ? vextureShapes : 0;
    while (shape < vextureShapes) {
        vexture_first_row = vextureRows[shape];
        coverage += vextureShares[shape] * vextureWrapped(vextureQuads[shape], uv, dx, dy);
        shape++;
    }
    vec2 filled = vexture_share(raster);
    vec2 weights = vextureShares * filled + 1e-6;
    weights /= weights.x + weights.y;
    float widths = vextureShore > 0.0 ? 1.0 / vextureShore : 0.0;
    vec2 far = clamp((2.0 * filled - 1.0) * vextureBox.x * widths, 0.0, 1.0);
    float clarity = clamp(2.0 - pixel * widths, 0.0, 1.0);
    float offshore = widths > 0.0 ? mix(1.0, dot(weights, far), clarity) : 1.0;
    float openness = dot(weights, smoothstep(0.2, 0.45, filled));
    return VextureWater(coverage, offshore, openness, uv * widths, dx * widths, dy * widths);
}

// Opacity of the shallows' colour.
float vextureShallows(VextureWater water) {
    float near = 1.0 - water.offshore;
    return near * near * (3.0 - 2.0 * near);
}

// Opacity of the foam: a seam along the shore, and lines that move towards it, broken up by the waves' normals. No lookups
// where there can be none.
float vextureFoam(VextureWater water, sampler2D normals, float seconds) {
    float foam = 0.0;
    if (water.coverage > 0.0 && water.offshore < 1.0 && water.openness > 0.0) {
        float drift = seconds / vextureLapping;
        float pixel = log2(float(textureSize(normals, 0).x)) + 0.5 * log2(length(water.dx) * length(water.dy) + 1e-20);
        vec4 broad = textureLod(normals, 0.11 * water.place + 0.013 * drift, pixel - 3.2);
        vec4 fine = textureLod(normals, 0.73 * water.place - 0.027 * drift, pixel - 0.45);
        float bent = water.offshore + 0.5 * (broad.x - 0.5) * smoothstep(0.0, 0.3, water.offshore);
        float behind = fract(2.5 * bent + drift + broad.y);
        float front = clamp(5.0 * max(length(water.dx), length(water.dy)), 0.03, 1.0);  // no sharper than two pixels
        float line = smoothstep(0.0, front, behind) * pow(1.0 - behind, 2.5) * smoothstep(0.95, 0.35, bent);
        float seam = smoothstep(0.12 + 0.2 * broad.y, 0.0, water.offshore);
        float most = max(line, seam);
        float tear = 0.5 * (fine.x + fine.y) + 0.35 * (fine.z - 0.8);
        foam = smoothstep(0.62, 0.38, tear - 0.5 * most + 0.24) * most;
    }
    return water.openness * foam;
}

// The water's light with shallows and foam; the colours' alpha is their greatest opacity.
vec3 vextureInshore(vec3 light, VextureWater water, sampler2D normals, float seconds, vec4 shallow, vec4 foam) {
    light = mix(light, shallow.rgb, 0.6 * shallow.a * vextureShallows(water));
    return mix(light, foam.rgb, foam.a * vextureFoam(water, normals, seconds));
}

// Lighting of the sea without a mirror texture.
struct VextureLight {
    vec3 toSun;
    vec3 sun;
    vec3 water;   // light from below
    vec3 zenith;  // the sky's, above
    vec3 horizon; // and at its edge
};

// Light of the sky in a direction, given by the sine of its elevation.
vec3 vextureSkyOf(VextureLight light, float steep) {
    return mix(light.horizon, light.zenith, smoothstep(0.0, 0.6, abs(steep)));
}

// Light of the open sea under a sky of two colours with the sun; y is up. Waves smaller than a pixel vanish from the mean
// of the normals, but still spread the sun's reflection.
vec3 vextureSea(VextureLight light, vec3 eye, vec3 place, float size, sampler2D normals, float seconds) {
    vec2 at = place.xz * size;
    vec3 one = texture(normals, at / 103.0 + seconds * vec2(0.049, 0.031)).xzy;
    vec3 other = texture(normals, at / 421.0 + seconds * vec2(-0.013, 0.017)).xzy;
    vec3 normal = normalize((one + other - 1.0) * vec3(0.8, 1.0, 0.8));
    vec3 toEye = normalize(eye - place);
    float facing = max(dot(toEye, normal), 0.0);
    float reflectance = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    vec3 mirrored = reflect(-toEye, normal);
    vec3 sky = vextureSkyOf(light, mirrored.y);
    float glint = pow(max(dot(mirrored, light.toSun), 0.0), 120.0);
    float lit = max(dot(light.toSun, normal), 0.0);
    vec3 below = light.water * (facing + 0.15 * lit);
    return mix(below, sky + 2.0 * glint * light.sun, reflectance);
}
