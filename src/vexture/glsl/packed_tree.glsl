// Reading the packed texture (FORMAT.md, part B): positions, and the cells down the tree.
// Exports: VexturePlace, VextureCell, vexture_place, vexture_shared_levels, vexture_texel, vexture_root, vexture_below.
//
// Positions are whole numbers of 2^-POSITION_BITS of the unit square, signed, so that a pixel around the square's edge
// has one too; a float holds what is left.

uniform highp usampler2D vextureTexels;

// A point and the box of a pixel around it.
struct VexturePlace {
    ivec2 point;
    vec2 rest;   // of the point, in the same unit, 0 or a little more
    ivec2 low;   // the box, cut to the unit square: the first and
    ivec2 high;  // the last position in it; if last < first it lies outside
};

// A cell of a quad.
struct VextureCell {
    uint quad;    // index of the quad that holds it; if the cell itself is one, of its own
    uint texel_x; // words of the holder's texel
    uint texel_y;
    uint texel_z;
    uint texel_w;
    uint shift;   // of the cell's bytes
    bool is_quad;
};

uvec4 vexture_texel(uint index) {
    ivec2 last = textureSize(vextureTexels, 0) - 1;
    ivec2 at = ivec2(int(index & uint((1 << VEXTURE_ROW_BITS) - 1)), int(index >> VEXTURE_ROW_BITS));
    return texelFetch(vextureTexels, min(at, last), 0);
}

VexturePlace vexture_place(uvec2 base, vec2 offset, vec2 reach) {
    int spare = 32 - VEXTURE_POSITION_BITS;
    float one = float(1 << VEXTURE_POSITION_BITS);
    vec2 scaled = clamp(offset, -VEXTURE_FARTHEST, VEXTURE_FARTHEST) * one;
    vec2 whole = floor(scaled);
    ivec2 point = ivec2(base >> spare) + ivec2(whole);
    vec2 rest = scaled - whole + vec2(base & uvec2((1 << spare) - 1)) / float(1 << spare);
    vec2 extent = min(reach, VEXTURE_FARTHEST) * one;
    int last = (1 << VEXTURE_POSITION_BITS) - 1;
    ivec2 low = max(point + ivec2(floor(rest - extent)), 0);
    ivec2 high = min(point + ivec2(ceil(rest + extent)) - 1, last);
    return VexturePlace(point, rest, low, high);
}

// Number of levels on which one cell holds both positions.
int vexture_shared_levels(ivec2 low, ivec2 high) {
    int differ = (low.x ^ high.x) | (low.y ^ high.y);
    int bits = (floatBitsToInt(float(differ)) >> 23) - 126;  // of the largest one in it
    return clamp(VEXTURE_POSITION_BITS - bits, 0, VEXTURE_MOST_DEPTH);
}

VextureCell vexture_root(uint root) {
    return VextureCell(root, 0u, 0u, 0u, 0u, 0u, true);
}

// One level down, from a quad of this level to its cell at a position.
VextureCell vexture_below(VextureCell cell, int level, ivec2 position) {
    uvec4 texel = vexture_texel(cell.quad);
    int bit = VEXTURE_POSITION_BITS - 1 - level;
    uint shift = uint(((position.x >> bit) & 1) + 2 * ((position.y >> bit) & 1)) * uint(VEXTURE_CELL_BITS);
    uint flags = (texel.z >> 7) & 0x01010101u;
    uint quad = texel.x + (((flags * 0x01010100u) >> shift) & 3u);
    bool is_quad = ((texel.z >> shift) & uint(VEXTURE_QUAD_FLAG)) != 0u;
    return VextureCell(is_quad ? quad : cell.quad, texel.x, texel.y, texel.z, texel.w, shift, is_quad);
}

float vexture_stored_coverage(VextureCell cell) {
    return float((cell.texel_w >> cell.shift) & 255u) / float(VEXTURE_COVERAGE_ONE);
}

int vexture_count(VextureCell cell) {
    return int((cell.texel_z >> (cell.shift + uint(VEXTURE_COUNT_SHIFT))) & uint(VEXTURE_MOST_CURVES));
}

// 0 marks a constant leaf.
int vexture_winding_code(VextureCell cell) {
    return int((cell.texel_z >> cell.shift) & 7u);
}

uint vexture_first_curve(VextureCell cell) {
    uint counts = (cell.texel_z >> VEXTURE_COUNT_SHIFT) & 0x0f0f0f0fu;
    return cell.texel_y + (((counts * 0x01010100u) >> cell.shift) & 255u);
}
