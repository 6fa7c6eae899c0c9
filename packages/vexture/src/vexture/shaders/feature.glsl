// Face of a planar map at a point (FORMAT.md, D.7): the number of its paint, whose elements are listed in the map's
// style.
// Exports: vextureFeature.
#include "leaf.glsl"

// Coordinate x of a curve at a height between its ends, in lattice units.
float vexture_x_at(uvec4 texel, float y) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p1 = vexture_word(texel.y) - float(VEXTURE_CONTROL_OFFSET);
    vec2 p2 = vexture_word(texel.z) - float(VEXTURE_CONTROL_OFFSET);
    vec2 p3 = vexture_word(texel.w);
    vec2 at = p0;
    float low = 0.0;
    float high = 1.0;
    for (int i = 0; i < VEXTURE_BISECTIONS; i++) {
        float t = 0.5 * (low + high);
        float s = 1.0 - t;
        at = s * s * (s * p0 + 3.0 * t * p1) + t * t * (3.0 * s * p2 + t * p3);
        low = at.y <= y ? t : low;
        high = at.y <= y ? high : t;
    }
    return at.x;
}

// Number that a curve adds to the count of its left paint at a point of its leaf and subtracts from its right one's.
int vexture_counted(uvec4 texel, vec2 point) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p3 = vexture_word(texel.w);
    int starts = p0.x == 0.0 && p0.y <= point.y ? 1 : 0;
    int ends = p3.x == 0.0 && p3.y <= point.y ? 1 : 0;
    bool is_beside = p0.y <= point.y && point.y < p3.y && min(p0.x, p3.x) <= point.x;
    if (is_beside && point.x < max(p0.x, p3.x)) {
        is_beside = vexture_x_at(texel, point.y) <= point.x;
    }
    return starts - ends - (is_beside ? 1 : 0);
}

// Parameters: the map's root quad; a point, as 32-bit fixed point (1.0 = 2^32) and an offset from it. The result is -1
// outside the unit square, in leaves with only a mean, and in slivers in which no single paint is left.
int vextureFeature(uint root, uvec2 base, vec2 offset) {
    VexturePlace place = vexture_place(base, offset, vec2(1.0));
    ivec2 position = place.point + ivec2(place.rest);
    ivec2 inside = position & ((1 << VEXTURE_POSITION_BITS) - 1);
    if (any(lessThan(place.high, place.low)) || any(notEqual(position, inside))) {
        return -1;
    }
    VexturePlanar planar = vexture_planar(root);
    VextureTop top = vexture_top(root);
    VextureCell cell = vexture_descend(top, -1, VEXTURE_POSITION_BITS - VEXTURE_MOST_DEPTH, position);
    if (((cell.texel.z >> cell.shift) & 255u) == uint(VEXTURE_IS_MEAN)) {
        return -1;
    }
    vec2 way = vec2(position & ((1 << cell.bit) - 1)) + fract(place.rest);
    vec2 point = way * uintBitsToFloat(uint(127 + VEXTURE_LATTICE_BITS - cell.bit) << 23);
    uint number = vexture_base_paint(planar, cell);
    uint square = number * number;  // if one paint is left, the square of its number
    VextureLeaf leaf = vexture_leaf(cell);
    int count = vexture_count(cell);
    for (int i = 0; i < count; i++) {
        uint counted = uint(vexture_counted(vexture_leaf_piece(leaf, i), point));
        uvec2 sides = vexture_leaf_sides(leaf, planar, i);
        number += counted * (sides.x - sides.y);
        square += counted * (sides.x * sides.x - sides.y * sides.y);
    }
    return number < uint(VEXTURE_MOST_PAINTS) && number * number == square ? int(number) : -1;
}

int vextureFeature(uint root, vec2 uv) {
    return vextureFeature(root, uvec2(0u), uv);
}
