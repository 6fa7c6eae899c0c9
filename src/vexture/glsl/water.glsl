// Water along a shore: where it is, how far the shore is, and what is seen there: shallows and foam.
// Exports: VextureWater, vextureWater, vextureShallows, vextureFoam, vextureInshore, VextureLight, vextureSea.
//
// How far the shore is follows from coverage of a second, wide footprint: beside a straight shore it grows evenly from
// 1/2 on the shore to 1 at half the footprint's width from it.
#include "packed_wrap.glsl"

uniform int vextureShapes;    // none, one, or two while one turns into the other
uniform uvec2 vextureQuads;   // their roots,
uniform ivec2 vextureRows;    // where each one's texels begin,
uniform vec2 vextureShares;   // how much of each is seen
uniform float vextureShore;   // width of the strip along the shore, in the unit square; 0: none
uniform float vextureLapping; // seconds from one line of foam to the next

struct VextureWater {
    float coverage;  // of the pixel
    float offshore;  // how far the shore is, in widths of the strip; 1 beyond it
    float openness;  // 1 along wide water, 0 in channels that are narrow beside the strip
    vec2 place;      // in widths of the strip
    vec2 dx;         // and its steps to the next pixels
    vec2 dy;
};

// Parameters: those of vextureCoverage. All lookups are rounds of one loop, so that who needs none pays for none: the
// wide footprint first, and the pixel's own only where the wide one has met an outline.
VextureWater vextureWater(vec2 uv, vec2 dx, vec2 dy) {
    vec2 reach = abs(dx) + abs(dy);
    float box = 2.0 * vextureShore;
    float clarity = box > 0.0 ? clamp(2.0 - 2.0 * max(reach.x, reach.y) / box, 0.0, 1.0) : 0.0;
    bool wide = clarity > 0.0;
    bool near = false;
    float around = 0.0;
    float coverage = 0.0;
    int shape = 0;
    while (shape < vextureShapes) {
        vexture_first_row = vextureRows[shape];
        vexture_levels_below = wide ? VEXTURE_LEVELS_BELOW - 1 : VEXTURE_LEVELS_BELOW;
        vexture_is_plain = true;
        vec2 right = wide ? vec2(box, 0.0) : dx;
        vec2 up = wide ? vec2(0.0, box) : dy;
        float more = vextureWrapped(vextureQuads[shape], uv, right, up);
        coverage += vextureShares[shape] * (vexture_is_plain ? round(more) : more);
        near = near || (wide && !vexture_is_plain);
        shape++;
        bool again = wide && near && shape == vextureShapes;
        wide = wide && !again;
        around = again ? coverage : around;
        coverage = again ? 0.0 : coverage;
        shape = again ? 0 : shape;
    }
    float offshore = near ? mix(1.0, clamp(2.0 * around - 1.0, 0.0, 1.0), clarity) : 1.0;
    float widths = vextureShore > 0.0 ? 1.0 / vextureShore : 0.0;
    return VextureWater(coverage, offshore, smoothstep(0.2, 0.45, around), uv * widths, dx * widths, dy * widths);
}

// How much of the shallows' colour shows.
float vextureShallows(VextureWater water) {
    float near = 1.0 - water.offshore;
    return near * near * (3.0 - 2.0 * near);
}

// How much foam there is: a seam along the shore, and lines that run towards it, torn by the waves' normals. Where there
// can be none nothing is looked up.
float vextureFoam(VextureWater water, sampler2D normals, float seconds) {
    float foam = 0.0;
    if (water.coverage > 0.0 && water.offshore < 1.0 && water.openness > 0.0) {
        float drift = seconds / vextureLapping;
        float pixel = log2(float(textureSize(normals, 0).x)) + 0.5 * log2(length(water.dx) * length(water.dy) + 1e-20);
        vec4 broad = textureLod(normals, 0.11 * water.place + 0.013 * drift, pixel - 3.2);
        vec4 fine = textureLod(normals, 0.73 * water.place - 0.027 * drift, pixel - 0.45);
        float bent = water.offshore + 0.5 * (broad.x - 0.5) * smoothstep(0.0, 0.3, water.offshore);
        float behind = fract(2.5 * bent + drift + broad.y);
        float line = smoothstep(1.0, 0.93, behind) * pow(1.0 - behind, 2.5) * smoothstep(0.95, 0.35, bent);
        float seam = smoothstep(0.12 + 0.2 * broad.y, 0.0, water.offshore);
        float most = max(line, seam);
        float tear = 0.5 * (fine.x + fine.y) + 0.35 * (fine.z - 0.8);
        foam = smoothstep(0.62, 0.38, tear - 0.5 * most + 0.24) * most;
    }
    return water.openness * foam;
}

// The water's light with what is near the shore; the colours' alpha is how much of them there is at most.
vec3 vextureInshore(vec3 light, VextureWater water, sampler2D normals, float seconds, vec4 shallow, vec4 foam) {
    light = mix(light, shallow.rgb, 0.6 * shallow.a * vextureShallows(water));
    return mix(light, foam.rgb, foam.a * vextureFoam(water, normals, seconds));
}

// What lights the sea where there is no mirror.
struct VextureLight {
    vec3 toSun;
    vec3 sun;
    vec3 water;   // light from below
    vec3 zenith;  // the sky's, above
    vec3 horizon; // and at its edge
};

// Light of the open sea with a sky of two colours and the sun in it; y is up. Waves that are smaller than a pixel are
// gone from the normals' mean, but not from the sea: they spread the sun.
vec3 vextureSea(VextureLight light, vec3 eye, vec3 place, float size, sampler2D normals, float seconds) {
    vec2 at = place.xz * size;
    vec3 one = texture(normals, at / 103.0 + seconds * vec2(0.049, 0.031)).xzy;
    vec3 other = texture(normals, at / 421.0 + seconds * vec2(-0.013, 0.017)).xzy;
    vec3 normal = normalize((one + other - 1.0) * vec3(0.8, 1.0, 0.8));
    vec3 toEye = normalize(eye - place);
    float facing = max(dot(toEye, normal), 0.0);
    float reflectance = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    vec3 mirrored = reflect(-toEye, normal);
    vec3 sky = mix(light.horizon, light.zenith, smoothstep(0.0, 0.6, abs(mirrored.y)));
    float glint = pow(max(dot(mirrored, light.toSun), 0.0), 120.0);
    float lit = max(dot(light.toSun, normal), 0.0);
    vec3 below = light.water * (facing + 0.15 * lit);
    return mix(below, sky + 2.0 * glint * light.sun, reflectance);
}
