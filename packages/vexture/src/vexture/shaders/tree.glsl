// Reading the packed texture (FORMAT.md, part B): positions, and the descent to the cells.
// Exports: VexturePlace, VextureCell, VextureSquare, vexture_place, vexture_texel, vexture_top, vexture_descend.
//
// Positions are signed integers in units of 2^-POSITION_BITS of the unit square, so that a pixel beyond the square's edge
// has one too; a float holds the rest. A cell's side is a power of two, 2^bit positions.

uniform highp usampler2D vextureTexels;

// A point and the bounding box of the pixel around it.
struct VexturePlace {
    ivec2 point;  // a multiple of 2^REST_BITS, so that a float holds its distance from any cell
    vec2 rest;    // of the point, in the same unit, 0 or more
    ivec2 low;    // first and last position of the box, clipped to the unit square;
    ivec2 high;   // high < low if it lies outside
};

// A leaf, given by its byte in a quad's texel; or a quad.
struct VextureCell {
    uint quad;    // quad that holds the leaf, or the quad itself
    uvec4 texel;  // its texel
    uint shift;   // of the cell's byte in the words of the quad that holds it
    int bit;
    bool is_quad;
};

// A square of cells, given by its lowest position in a pixel's box.
struct VextureSquare {
    ivec2 position;
    int bit;
};

// Start of a descent of the tree: a quad.
struct VextureTop {
    uint quad;
    int bit;
    uint followed;  // quads before this one are followed below the finest cells: the first of the shape, if any
};

int vexture_first_row = 0;  // of the texture to read: an image may hold several, one below the other

uvec4 vexture_texel(uint index) {
    int row = int(index >> VEXTURE_ROW_BITS) + vexture_first_row;
    return texelFetch(vextureTexels, ivec2(int(index & uint((1 << VEXTURE_ROW_BITS) - 1)), row), 0);
}

// Parameters: the pixel's centre, as 32-bit fixed point and an offset from it; half the footprint's box, in positions.
VexturePlace vexture_place(uvec2 base, vec2 offset, vec2 extent) {
    int spare = 32 - VEXTURE_POSITION_BITS + VEXTURE_REST_BITS;
    float one = float(1 << VEXTURE_REST_BITS);
    vec2 scaled = clamp(offset, -VEXTURE_FARTHEST, VEXTURE_FARTHEST) * (float(1 << VEXTURE_POSITION_BITS) / one);
    vec2 whole = floor(scaled);
    ivec2 point = (ivec2(base >> spare) + ivec2(whole)) << VEXTURE_REST_BITS;
    vec2 below = vec2(ivec2(base & uvec2((1 << spare) - 1)));
    vec2 rest = (scaled - whole) * one + below * (one / float(1 << spare));
    float square = float(1 << VEXTURE_POSITION_BITS);
    bool is_far = any(greaterThan(abs(offset) * square - square, extent));  // the box ends before the unit square
    extent = min(extent, VEXTURE_FARTHEST * square);
    int last = is_far ? -1 : (1 << VEXTURE_POSITION_BITS) - 1;
    ivec2 low = max(point + ivec2(floor(rest - extent)), 0);
    ivec2 high = min(point + ivec2(ceil(rest + extent)) - 1, last);
    return VexturePlace(point, rest, low, high);
}

// Smallest cell that contains the whole box of a place, or the smallest of all cells. If the box lies outside the unit
// square, there is none: x is NO_CELL.
VextureSquare vexture_first_square(VexturePlace place) {
    int differ = (place.low.x ^ place.high.x) | (place.low.y ^ place.high.y);
    int bits = (floatBitsToInt(float(differ)) >> 23) - 126;  // of the largest one in it
    bool is_inside = all(lessThanEqual(place.low, place.high));
    ivec2 position = ivec2(is_inside ? place.low.x : VEXTURE_NO_CELL, place.low.y);
    return VextureSquare(position, max(bits, VEXTURE_POSITION_BITS - VEXTURE_MOST_DEPTH));
}

// Next square of cells that meets the box, after a cell with the upper right corner `beyond`; x is NO_CELL if there is
// none. The order is Morton's: of the two sides across which the next square may lie, the one that ends the smaller square.
VextureSquare vexture_next_square(ivec2 position, ivec2 beyond, VexturePlace place) {
    ivec2 step = beyond & -beyond;
    step.x = beyond.x <= place.high.x ? step.x : VEXTURE_NO_CELL;
    step.y = beyond.y <= place.high.y ? step.y : VEXTURE_NO_CELL;
    int least = min(step.x, step.y);
    int left = max(position.x & -(step.y + step.y), place.low.x);
    int bottom = max(position.y & -step.x, place.low.y);
    ivec2 next = step.x <= step.y ? ivec2(beyond.x, bottom) : ivec2(left, beyond.y);
    next.x = least < VEXTURE_NO_CELL ? next.x : VEXTURE_NO_CELL;
    return VextureSquare(next, (floatBitsToInt(float(least)) >> 23) - 127);
}

// Bit of the largest cells that are no larger than a square of this area, in positions.
int vexture_bit_of(float area) {
    return ((floatBitsToInt(area * (1.0 - VEXTURE_LEVEL_BIAS)) >> 23) - 127) >> 1;
}

// Bit of the smallest cells that the sum over cells visits, if the tree has them: a quarter to half as wide as the footprint;
// half of that in pictures of few pixels, where drawings have few deep cells; wider for a long footprint. Parameters: the
// footprint's area, and the square of its length.
int vexture_finest_bit(float area, float longer) {
    int finest = vexture_bit_of(max(area * (area / longer), longer * VEXTURE_LONG)) - 1;
    finest -= finest > VEXTURE_POSITION_BITS - VEXTURE_SMALL_FINEST ? 1 : 0;
    return clamp(finest, VEXTURE_POSITION_BITS - VEXTURE_MOST_DEPTH, VEXTURE_POSITION_BITS - VEXTURE_LEAST_FINEST);
}

// The descents of a shape begin at its root.
VextureTop vexture_top(uint root) {
    return VextureTop(root, VEXTURE_POSITION_BITS, root + uint(VEXTURE_FOLLOWED_QUADS));
}

// The cell at a position: a leaf, or a quad of the side `finest`, or a smaller one below the shape's first quads. `top`
// becomes the quad of the side `shared`. Quads are numbered breadth first, so that a shape of few quads is followed
// everywhere, and one of many nowhere that is fine.
VextureCell vexture_descend(inout VextureTop top, int shared, int finest, ivec2 position) {
    uint quad = top.quad;
    int bit = top.bit;
    uvec4 texel = vexture_texel(quad);
    uint shift = 0u;
    bool is_quad = true;
    while (is_quad && bit > (quad < top.followed ? finest - VEXTURE_FURTHER : finest)) {
        bit--;
        shift = ((uint(position.x << 3) >> bit) & 8u) | ((uint(position.y << 4) >> bit) & 16u);
        is_quad = ((texel.z >> shift) & uint(VEXTURE_QUAD_FLAG)) != 0u;
        if (is_quad) {
            uint before = (texel.z >> 7) & 0x010101u & ((1u << shift) - 1u);  // a byte for each quad before this one
            quad = texel.x + ((before * 0x010101u >> 16) & 3u);
            texel = vexture_texel(quad);
            bool above = bit == shared;
            top.quad = above ? quad : top.quad;
            top.bit = above ? bit : top.bit;
        }
    }
    return VextureCell(quad, texel, shift, bit, is_quad);
}

float vexture_stored_coverage(VextureCell cell) {
    return float(int((cell.texel.w >> cell.shift) & 255u)) / float(VEXTURE_COVERAGE_ONE);
}

int vexture_count(VextureCell cell) {
    return int((cell.texel.z >> (cell.shift + uint(VEXTURE_COUNT_SHIFT))) & uint(VEXTURE_MOST_CURVES));
}

// Corner winding of the leaf plus WINDING_OFFSET; 0 marks a constant leaf.
int vexture_winding_code(VextureCell cell) {
    return int((cell.texel.z >> cell.shift) & 7u);
}

uint vexture_first_curve(VextureCell cell) {
    uint before = (cell.texel.z >> VEXTURE_COUNT_SHIFT) & 0x0f0f0fu & ((1u << cell.shift) - 1u);
    return cell.texel.y + ((before * 0x010101u >> 16) & 255u);
}
