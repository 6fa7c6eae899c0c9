// The pieces of a planar map's leaf (FORMAT.md, D.2): one per texel, or two per texel if all are straight.
// Pieces that share a texel, or a texel of sides, cost one fetch if they are read one after the other.
// Exports: VextureLeaf, vexture_leaf, vexture_leaf_piece, vexture_leaf_sides.
#include "paints.glsl"
#include "piece.glsl"

struct VextureLeaf {
    uint first;     // texel of its first piece
    uint number;    // of that piece in the map
    bool is_straight;
    uint at;        // index of the texel of pieces that was read last,
    uvec4 texel;    // its content,
    uint sides_at;  // and the same of sides
    uvec4 sides;
};

VextureLeaf vexture_leaf(VextureCell cell) {
    uint counts = (cell.texel.z >> VEXTURE_COUNT_SHIFT) & 0x0f0f0fu & ((1u << cell.shift) - 1u);
    uint paired = (cell.texel.z & (uint(VEXTURE_STRAIGHT) * 0x010101u)) * uint(VEXTURE_MOST_CURVES);
    uint texels = counts - ((counts >> 1) & 0x070707u & paired);
    uint first = cell.texel.y + ((texels * 0x010101u >> 16) & 255u);
    uint number = cell.texel.w + ((counts * 0x010101u >> 16) & 255u);
    bool is_straight = ((cell.texel.z >> cell.shift) & uint(VEXTURE_STRAIGHT)) != 0u;
    return VextureLeaf(first, number, is_straight, 0u, uvec4(0u), 0u, uvec4(0u));
}

// Texel of a curve between two ends, with P1 and P2 nearest to the thirds of its chord.
uvec4 vexture_straight(uvec2 ends) {
    vec2 p0 = vexture_word(ends.x);
    vec2 p3 = vexture_word(ends.y);
    uvec2 p1 = uvec2((2.0 * p0 + p3) / 3.0 + (float(VEXTURE_CONTROL_OFFSET) + 0.5));  // a sixth away from whole numbers
    uvec2 p2 = uvec2((p0 + 2.0 * p3) / 3.0 + (float(VEXTURE_CONTROL_OFFSET) + 0.5));
    uvec2 words = uvec2(p1.x, p2.x) + (uvec2(p1.y, p2.y) << VEXTURE_COORDINATE_BITS);
    return uvec4(ends.x, words, ends.y);
}

// Piece i of a leaf, as the texel of a curve.
uvec4 vexture_leaf_piece(inout VextureLeaf leaf, int i) {
    uint at = leaf.first + uint(leaf.is_straight ? i >> 1 : i);
    if (at != leaf.at) {
        leaf.at = at;
        leaf.texel = vexture_texel(at);
    }
    return leaf.is_straight ? vexture_straight((i & 1) == 0 ? leaf.texel.xy : leaf.texel.zw) : leaf.texel;
}

// The paints on the left and on the right of piece i of a leaf.
uvec2 vexture_leaf_sides(inout VextureLeaf leaf, VexturePlanar planar, int i) {
    uint place = 2u * (leaf.number + uint(i));
    uint at = planar.sides + (place >> (2u + planar.packing));
    if (at != leaf.sides_at) {
        leaf.sides_at = at;
        leaf.sides = vexture_texel(at);
    }
    uint left = leaf.sides[(place >> planar.packing) & 3u];
    uint right = leaf.sides[((place + 1u) >> planar.packing) & 3u];
    return uvec2(vexture_numbered(planar, left, place), vexture_numbered(planar, right, place + 1u));
}
