// Reading the packed texture (FORMAT.md, part B): positions, and the cells down the tree.
// Exports: VexturePlace, VextureCell, VextureTop, vexture_place, vexture_finest_level, vexture_texel, vexture_descend.
//
// Positions are signed integers in units of 2^-POSITION_BITS of the unit square, so that a pixel beyond the square's edge
// has one too; a float holds the rest.

uniform highp usampler2D vextureTexels;

// A point and the box of a pixel around it.
struct VexturePlace {
    ivec2 point;
    vec2 rest;   // of the point, in the same unit, 0 or a little more
    ivec2 low;   // first and last position of the box, clipped to the unit square;
    ivec2 high;  // high < low if it lies outside
};

// A cell, as the byte of a texel.
struct VextureCell {
    uvec4 texel;  // of the quad that holds it
    uint shift;   // of its byte
    int level;    // 1 is a quarter of the unit square
    bool is_quad;
};

// Start of a descent of the tree: a quad, and the number of levels above it.
struct VextureTop {
    uint quad;
    int level;
};

int vexture_first_row = 0;  // of the texture to read: an image may hold several, one below the other

uvec4 vexture_texel(uint index) {
    ivec2 last = textureSize(vextureTexels, 0) - 1;
    int row = int(index >> VEXTURE_ROW_BITS) + vexture_first_row;
    ivec2 at = ivec2(int(index & uint((1 << VEXTURE_ROW_BITS) - 1)), row);
    return texelFetch(vextureTexels, min(at, last), 0);
}

VexturePlace vexture_place(uvec2 base, vec2 offset, vec2 reach) {
    int spare = 32 - VEXTURE_POSITION_BITS;
    float one = float(1 << VEXTURE_POSITION_BITS);
    vec2 scaled = clamp(offset, -VEXTURE_FARTHEST, VEXTURE_FARTHEST) * one;
    vec2 whole = floor(scaled);
    ivec2 point = ivec2(base >> spare) + ivec2(whole);
    vec2 rest = scaled - whole + vec2(ivec2(base & uvec2((1 << spare) - 1))) / float(1 << spare);
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

// The finest level whose cells are no smaller than a square of this area.
int vexture_level_of(float area) {
    return -1 - (((floatBitsToInt(area * (1.0 - VEXTURE_LEVEL_BIAS)) >> 23) - 127) >> 1);
}

// The level of the footprint's area plus LEVELS_BELOW; one more in pictures of few pixels, where drawings have few deep
// cells; fewer for a long footprint, so that its box touches at most MOST_CELLS cells.
int vexture_finest_level(float area, vec2 reach) {
    float length = VEXTURE_LONG * max(reach.x, reach.y);
    int usual = vexture_level_of(max(area, length * length)) + VEXTURE_LEVELS_BELOW;
    int small = vexture_level_of(max(area, 4.0 * length * length)) + VEXTURE_LEVELS_BELOW + 1;
    return clamp(max(usual, min(small, VEXTURE_SMALL_FINEST)), VEXTURE_LEAST_FINEST, VEXTURE_MOST_DEPTH);
}

// The cell at a position: a leaf, or a quad of the level `finest`. `top` becomes the quad of the level `shared`.
VextureCell vexture_descend(inout VextureTop top, int shared, int finest, ivec2 position) {
    uvec4 texel = uvec4(0u);
    uint shift = 0u;
    uint quad = top.quad;
    bool is_quad = true;
    int bit = VEXTURE_POSITION_BITS - 1 - top.level;
    int last = VEXTURE_POSITION_BITS - finest;
    while (is_quad && bit >= last) {
        texel = vexture_texel(quad);
        shift = ((uint(position.x) >> bit) & 1u) * 8u + ((uint(position.y) >> bit) & 1u) * 16u;
        is_quad = ((texel.z >> shift) & uint(VEXTURE_QUAD_FLAG)) != 0u;
        uint flags = (texel.z >> 7) & 0x01010101u;  // a byte for each cell: whether it is a quad
        quad = texel.x + (((flags * 0x01010100u) >> shift) & 3u);
        bit--;
        bool above = VEXTURE_POSITION_BITS - 1 - bit == shared && is_quad;
        top.quad = above ? quad : top.quad;
        top.level = above ? shared : top.level;
    }
    return VextureCell(texel, shift, VEXTURE_POSITION_BITS - 1 - bit, is_quad);
}

float vexture_stored_coverage(VextureCell cell) {
    return float(int((cell.texel.w >> cell.shift) & 255u)) / float(VEXTURE_COVERAGE_ONE);
}

int vexture_count(VextureCell cell) {
    return int((cell.texel.z >> (cell.shift + uint(VEXTURE_COUNT_SHIFT))) & uint(VEXTURE_MOST_CURVES));
}

// 0 marks a constant leaf.
int vexture_winding_code(VextureCell cell) {
    return int((cell.texel.z >> cell.shift) & 7u);
}

uint vexture_first_curve(VextureCell cell) {
    uint counts = (cell.texel.z >> VEXTURE_COUNT_SHIFT) & 0x0f0f0f0fu;
    return cell.texel.y + (((counts * 0x01010100u) >> cell.shift) & 255u);
}
