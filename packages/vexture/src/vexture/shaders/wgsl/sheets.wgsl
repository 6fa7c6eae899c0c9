const VEXTURE_BEND: f32 = 20.0;
const VEXTURE_BLEND_COLOR: i32 = 14;
const VEXTURE_BLEND_COLOR_BURN: i32 = 7;
const VEXTURE_BLEND_COLOR_DODGE: i32 = 6;
const VEXTURE_BLEND_DARKEN: i32 = 4;
const VEXTURE_BLEND_DIFFERENCE: i32 = 10;
const VEXTURE_BLEND_HARD_LIGHT: i32 = 8;
const VEXTURE_BLEND_HUE: i32 = 12;
const VEXTURE_BLEND_LIGHTEN: i32 = 5;
const VEXTURE_BLEND_LUMINOSITY: i32 = 15;
const VEXTURE_BLEND_MULTIPLY: i32 = 1;
const VEXTURE_BLEND_NORMAL: i32 = 0;
const VEXTURE_BLEND_OVERLAY: i32 = 3;
const VEXTURE_BLEND_PARTS: i32 = 256;
const VEXTURE_BLEND_PLUS_LIGHTER: i32 = 16;
const VEXTURE_BLEND_SATURATION: i32 = 13;
const VEXTURE_BLEND_SCREEN: i32 = 2;
const VEXTURE_BLEND_SOFT_LIGHT: i32 = 9;
const VEXTURE_BLOCK_SIDE: i32 = 4;
const VEXTURE_BORDER: f32 = 2.384185791015625e-07;
const VEXTURE_CLOSE: f32 = 0.02;
const VEXTURE_CONTROL_OFFSET: i32 = 16384;
const VEXTURE_COORDINATE_BITS: i32 = 16;
const VEXTURE_COUNT_SHIFT: i32 = 3;
const VEXTURE_COVERAGE_ONE: i32 = 255;
const VEXTURE_COVERED: f32 = 0.9990234375;
const VEXTURE_DRAWN: f32 = 0.7;
const VEXTURE_ENTRY_BITS: i32 = 3;
const VEXTURE_FARTHEST: f32 = 3.0;
const VEXTURE_FIRST_BLOCK: i32 = 256;
const VEXTURE_FOLLOWED_QUADS: i32 = 256;
const VEXTURE_FURTHER: i32 = 2;
const VEXTURE_GAUSS: f32 = 0.2886751345948129;
const VEXTURE_GREY: f32 = 0.0009765625;
const VEXTURE_HOLDS_PROGRAM: i32 = 4;
const VEXTURE_IS_MEAN: i32 = 2;
const VEXTURE_KIND_FOCAL: i32 = 4;
const VEXTURE_KIND_FOLLOWS: i32 = 7;
const VEXTURE_KIND_KEEP: i32 = 5;
const VEXTURE_KIND_LINEAR: i32 = 2;
const VEXTURE_KIND_MIX: i32 = 6;
const VEXTURE_KIND_PICTURE: i32 = 0;
const VEXTURE_KIND_SHIFT: i32 = 29;
const VEXTURE_KIND_SOLID: i32 = 1;
const VEXTURE_LATTICE_BITS: i32 = 15;
const VEXTURE_LEAST_COLOR: f32 = 6.103515625e-05;
const VEXTURE_LEAST_FINEST: i32 = 4;
const VEXTURE_LEAST_OUTLINE: f32 = 3.814697265625e-06;
const VEXTURE_LEAST_RADIUS: f32 = 9.5367431640625e-07;
const VEXTURE_LEAST_SHARE: f32 = 9.5367431640625e-07;
const VEXTURE_LEAST_SMOOTH: f32 = 0.015625;
const VEXTURE_LEAST_SPLINE_BOX: f32 = 0.0625;
const VEXTURE_LEVEL_BIAS: f32 = 0.00390625;
const VEXTURE_LONG: f32 = 0.00390625;
const VEXTURE_LONGEST_RAMP: f32 = 1048576.0;
const VEXTURE_LUMINANCE_BLUE: f32 = 0.0721;
const VEXTURE_LUMINANCE_GREEN: f32 = 0.7154;
const VEXTURE_LUMINANCE_RED: f32 = 0.2125;
const VEXTURE_MASKS: i32 = 32;
const VEXTURE_MASK_LUMINANCE: i32 = 2;
const VEXTURE_MOST_BYTE_PAINTS: i32 = 256;
const VEXTURE_MOST_CURVES: i32 = 15;
const VEXTURE_MOST_DEPTH: i32 = 20;
const VEXTURE_MOST_HALF_PAINTS: i32 = 65536;
const VEXTURE_MOST_PARTS: f32 = 8.0;
const VEXTURE_MOST_PROGRAM: i32 = 64;
const VEXTURE_MOST_RAMP_PARTS: i32 = 4;
const VEXTURE_MOST_SPLINE_BOXES: i32 = 4;
const VEXTURE_MOST_STOPS: i32 = 255;
const VEXTURE_NEARLY_TILE: f32 = 0.375;
const VEXTURE_NEARLY_WHOLE: f32 = 0.9990234375;
const VEXTURE_NOTHING: f32 = 8.673617379884035e-19;
const VEXTURE_NO_CELL: i32 = 1073741824;
const VEXTURE_NO_PLACE: f32 = -1e+30;
const VEXTURE_NO_SHARE: f32 = 1.152921504606847e+18;
const VEXTURE_NO_SIZE: f32 = 1.52587890625e-05;
const VEXTURE_PAINT_ONE: i32 = 65535;
const VEXTURE_PICTURE_AREA: f32 = 256.0;
const VEXTURE_PICTURE_FAR: f32 = 16777216.0;
const VEXTURE_PICTURE_LENGTH: f32 = 0.0625;
const VEXTURE_PICTURE_LINES: i32 = 130;
const VEXTURE_PICTURE_RAMP: f32 = 0.25;
const VEXTURE_PIXEL_PARTS: i32 = 8;
const VEXTURE_POSITION_BITS: i32 = 28;
const VEXTURE_PRODUCT_PARTS: i32 = 4;
const VEXTURE_QUAD_FLAG: i32 = 128;
const VEXTURE_RAMP_BEND: f32 = 0.5;
const VEXTURE_RAMP_PARTS: i32 = 6;
const VEXTURE_REST_BITS: i32 = 4;
const VEXTURE_ROW_BITS: i32 = 11;
const VEXTURE_SAMPLING_INVERSE: i32 = 4;
const VEXTURE_SAMPLING_OPACITY: i32 = 3;
const VEXTURE_SAMPLING_PIXELS: i32 = 0;
const VEXTURE_SAMPLING_SPLINE: i32 = 2;
const VEXTURE_SHORTEST_RAMP: f32 = 2.384185791015625e-07;
const VEXTURE_SHORT_SMOOTH: f32 = 0.0625;
const VEXTURE_SHORT_WAY: f32 = 0.0009765625;
const VEXTURE_SLANTED_PART: f32 = 0.75;
const VEXTURE_SMALLEST_BOX: f32 = 9.5367431640625e-07;
const VEXTURE_SMALLEST_PIXEL: f32 = 9.094947017729282e-13;
const VEXTURE_SMALL_FINEST: i32 = 8;
const VEXTURE_SMOOTH_AREA: f32 = 48.0;
const VEXTURE_SPREAD_PAD: i32 = 0;
const VEXTURE_SPREAD_REFLECT: i32 = 1;
const VEXTURE_STEPS: i32 = 6;
const VEXTURE_STOP_BITS: i32 = 19;
const VEXTURE_STOP_COUNT_BITS: i32 = 8;
const VEXTURE_STRAIGHT: i32 = 1;
const VEXTURE_THINNEST_OUTLINE: f32 = 0.00390625;
const VEXTURE_THINNEST_PIXEL: f32 = 0.015625;
const VEXTURE_WHOLE_TILE: f32 = 0.5;
const VEXTURE_WIDEST_SPLINE_BOX: f32 = 12.0;
const VEXTURE_WINDING_OFFSET: i32 = 4;
const VEXTURE_WRAP_CLAMP: i32 = 1;
const VEXTURE_WRAP_NONE: i32 = 0;
const VEXTURE_WRAP_REPEAT: i32 = 2;
// Conversion of colours to linear light.
// Exports: vexture_linear.

// Converts sRGB components to linear ones (IEC 61966-2-1).
fn vexture_linear(encoded: vec3f) -> vec3f {
    let bent: vec3f = pow((encoded + 0.055) / 1.055, vec3f(2.4));
    return select(bent, encoded / 12.92, encoded <= vec3f(0.04045));
}
// Reading the packed texture (FORMAT.md, part B): positions, and the descent to the cells.
// Exports: VexturePlace, VextureCell, VextureSquare, vexture_place, vexture_texel, vexture_top, vexture_descend.
//
// Positions are signed integers in units of 2^-POSITION_BITS of the unit square, so that a pixel beyond the square's edge
// has one too; a float holds the rest. A cell's side is a power of two, 2^bit positions.

// A point and the bounding box of the pixel around it.
struct VexturePlace {
    point: vec2i,  // a multiple of 2^REST_BITS, so that a float holds its distance from any cell
    rest: vec2f,  // of the point, in the same unit, 0 or more
    low: vec2i,  // first and last position of the box, clipped to the unit square;
    high: vec2i,  // high < low if it lies outside
}

// A leaf, given by its byte in a quad's texel; or a quad.
struct VextureCell {
    quad: u32,  // quad that holds the leaf, or the quad itself
    texel: vec4u,  // its texel
    shift: u32,  // of the cell's byte in the words of the quad that holds it
    bit: i32,
    is_quad: bool,
}

// A square of cells, given by its lowest position in a pixel's box.
struct VextureSquare {
    position: vec2i,
    bit: i32,
}

// Start of a descent of the tree: a quad.
struct VextureTop {
    quad: u32,
    bit: i32,
    followed: u32,  // quads before this one are followed below the finest cells: the first of the shape, if any
}

var<private> vexture_first_row: i32 = 0;  // of the texture to read: an image may hold several, one below the other

fn vexture_texel(vextureTexels: texture_2d<u32>, index: u32) -> vec4u {
    let row: i32 = i32(index >> u32(VEXTURE_ROW_BITS)) + vexture_first_row;
    return textureLoad(vextureTexels, vec2i(i32(index & u32((1 << u32(VEXTURE_ROW_BITS)) - 1)), row), 0);
}

// Parameters: the pixel's centre, as 32-bit fixed point and an offset from it; half the footprint's box, in positions.
fn vexture_place(base: vec2u, offset: vec2f, extent_given: vec2f) -> VexturePlace {
    var extent = extent_given;
    let spare: i32 = 32 - VEXTURE_POSITION_BITS + VEXTURE_REST_BITS;
    let one: f32 = f32(1 << u32(VEXTURE_REST_BITS));
    let scaled: vec2f = clamp(offset, vec2f(-VEXTURE_FARTHEST), vec2f(VEXTURE_FARTHEST))
        * (f32(1 << u32(VEXTURE_POSITION_BITS)) / one);
    let whole: vec2f = floor(scaled);
    let point: vec2i = (vec2i(base >> vec2u(u32(spare))) + vec2i(whole)) << vec2u(u32(VEXTURE_REST_BITS));
    let below: vec2f = vec2f(vec2i(base & vec2u(u32((1 << u32(spare)) - 1))));
    let rest: vec2f = (scaled - whole) * one + below * (one / f32(1 << u32(spare)));
    let square: f32 = f32(1 << u32(VEXTURE_POSITION_BITS));
    let is_far: bool = any(abs(offset) * square - square > extent);  // the box ends before the unit square
    extent = min(extent, vec2f(VEXTURE_FARTHEST * square));
    let last: i32 = select((1 << u32(VEXTURE_POSITION_BITS)) - 1, -1, is_far);
    let low: vec2i = max(point + vec2i(floor(rest - extent)), vec2i(0));
    let high: vec2i = min(point + vec2i(ceil(rest + extent)) - 1, vec2i(last));
    return VexturePlace(point, rest, low, high);
}

// Smallest cell that contains the whole box of a place, or the smallest of all cells. If the box lies outside the unit
// square, there is none: x is NO_CELL.
fn vexture_first_square(place: VexturePlace) -> VextureSquare {
    let differ: i32 = (place.low.x ^ place.high.x) | (place.low.y ^ place.high.y);
    let bits: i32 = (bitcast<i32>(f32(differ)) >> 23u) - 126;  // of the largest one in it
    let is_inside: bool = all(place.low <= place.high);
    let position: vec2i = vec2i(select(VEXTURE_NO_CELL, place.low.x, is_inside), place.low.y);
    return VextureSquare(position, max(bits, VEXTURE_POSITION_BITS - VEXTURE_MOST_DEPTH));
}

// Next square of cells that meets the box, after a cell with the upper right corner `beyond`; x is NO_CELL if there is
// none. The order is Morton's: of the two sides across which the next square may lie, the one that ends the smaller square.
fn vexture_next_square(position: vec2i, beyond: vec2i, place: VexturePlace) -> VextureSquare {
    var step: vec2i = beyond & -beyond;
    step.x = select(VEXTURE_NO_CELL, step.x, beyond.x <= place.high.x);
    step.y = select(VEXTURE_NO_CELL, step.y, beyond.y <= place.high.y);
    let least: i32 = min(step.x, step.y);
    let left: i32 = max(position.x & -(step.y + step.y), place.low.x);
    let bottom: i32 = max(position.y & -step.x, place.low.y);
    var next: vec2i = select(vec2i(left, beyond.y), vec2i(beyond.x, bottom), step.x <= step.y);
    next.x = select(VEXTURE_NO_CELL, next.x, least < VEXTURE_NO_CELL);
    return VextureSquare(next, (bitcast<i32>(f32(least)) >> 23u) - 127);
}

// Bit of the largest cells that are no larger than a square of this area, in positions.
fn vexture_bit_of(area: f32) -> i32 {
    return ((bitcast<i32>(area * (1.0 - VEXTURE_LEVEL_BIAS)) >> 23u) - 127) >> 1u;
}

// Bit of the smallest cells that the sum over cells visits, if the tree has them: a quarter to half as wide as the footprint;
// half of that in pictures of few pixels, where drawings have few deep cells; wider for a long footprint. Parameters: the
// footprint's area, and the square of its length.
fn vexture_finest_bit(area: f32, longer: f32) -> i32 {
    var finest: i32 = vexture_bit_of(max(area * (area / longer), longer * VEXTURE_LONG)) - 1;
    finest -= select(0, 1, finest > VEXTURE_POSITION_BITS - VEXTURE_SMALL_FINEST);
    return clamp(finest, VEXTURE_POSITION_BITS - VEXTURE_MOST_DEPTH, VEXTURE_POSITION_BITS - VEXTURE_LEAST_FINEST);
}

// The descents of a shape begin at its root.
fn vexture_top(root: u32) -> VextureTop {
    return VextureTop(root, VEXTURE_POSITION_BITS, root + u32(VEXTURE_FOLLOWED_QUADS));
}

// The cell at a position: a leaf, or a quad of the side `finest`, or a smaller one below the shape's first quads. `top`
// becomes the quad of the side `shared`. Quads are numbered breadth first, so that a shape of few quads is followed
// everywhere, and one of many nowhere that is fine.
fn vexture_descend(
    vextureTexels: texture_2d<u32>, top: ptr<function, VextureTop>, shared_: i32, finest: i32, position: vec2i,
) -> VextureCell {
    var quad: u32 = (*top).quad;
    var bit: i32 = (*top).bit;
    var texel: vec4u = vexture_texel(vextureTexels, quad);
    var shift: u32 = 0u;
    var is_quad: bool = true;
    while (is_quad && bit > select(finest, finest - VEXTURE_FURTHER, quad < (*top).followed)) {
        bit--;
        shift = ((u32(position.x << 3u) >> u32(bit)) & 8u) | ((u32(position.y << 4u) >> u32(bit)) & 16u);
        is_quad = ((texel.z >> shift) & u32(VEXTURE_QUAD_FLAG)) != 0u;
        if (is_quad) {
            let before: u32 = (texel.z >> 7u) & 0x010101u & ((1u << shift) - 1u);  // a byte for each quad before this one
            quad = texel.x + (((before * 0x010101u) >> 16u) & 3u);
            texel = vexture_texel(vextureTexels, quad);
            let above: bool = bit == shared_;
            (*top).quad = select((*top).quad, quad, above);
            (*top).bit = select((*top).bit, bit, above);
        }
    }
    return VextureCell(quad, texel, shift, bit, is_quad);
}

fn vexture_stored_coverage(cell: VextureCell) -> f32 {
    return f32(i32((cell.texel.w >> cell.shift) & 255u)) / f32(VEXTURE_COVERAGE_ONE);
}

fn vexture_count(cell: VextureCell) -> i32 {
    return i32((cell.texel.z >> (cell.shift + u32(VEXTURE_COUNT_SHIFT))) & u32(VEXTURE_MOST_CURVES));
}

// Corner winding of the leaf plus WINDING_OFFSET; 0 marks a constant leaf.
fn vexture_winding_code(cell: VextureCell) -> i32 {
    return i32((cell.texel.z >> cell.shift) & 7u);
}

fn vexture_first_curve(cell: VextureCell) -> u32 {
    let before: u32 = (cell.texel.z >> u32(VEXTURE_COUNT_SHIFT)) & 0x0f0f0fu & ((1u << cell.shift) - 1u);
    return cell.texel.y + (((before * 0x010101u) >> 16u) & 255u);
}

// A piece of outline in a box: the part of a cell that lies in the box around a pixel's footprint. In the box's own
// coordinates it is the unit square.
// Exports: VextureBox, VexturePiece, VextureEnds, vexture_box, vexture_piece, vexture_ends, vexture_bulge, vexture_mean.

struct VextureBox {
    unit: f32,  // of the cell's lattice, in positions
    way: vec2f,  // from the cell's origin to the pixel's point, in positions;
    part: vec2f,  // from there to the box's low corner, in its sides: one float cannot hold both
    low: vec2f,  // that corner relative to the pixel's centre, in positions
    size: vec2f,  // in positions
}

// A piece, monotone in x and y. Falling coordinates are mirrored in the box, so that both rise.
struct VexturePiece {
    a: vec2f,  // coefficients of t^3, t^2, t and 1
    b: vec2f,
    c: vec2f,
    d: vec2f,
    way: vec2f,  // from its begin to its end
    falls: vec2<bool>,
}

// Points where a piece enters and leaves the box.
struct VextureEnds {
    start: f32,  // t
    end: f32,
    enter: vec2f,
    leave: vec2f,
}

// Part of a cell in the footprint's box, which extends by `extent` from the pixel's centre.
fn vexture_box(origin: vec2i, bit: i32, place: VexturePlace, extent: vec2f) -> VextureBox {
    let way: vec2f = vec2f(place.point - origin);
    let low: vec2f = max(-way - place.rest, -extent);
    let high: vec2f = min(f32(1 << u32(bit)) - way - place.rest, extent);
    let size: vec2f = max(high - low, vec2f(VEXTURE_SMALLEST_BOX));
    let unit: f32 = bitcast<f32>(u32(127 - VEXTURE_LATTICE_BITS + bit) << 23u);
    return VextureBox(unit, way, (place.rest + low) / size, low, size);
}

fn vexture_word(word: u32) -> vec2f {
    return vec2f(vec2i(i32(word & 0xffffu), i32(word >> u32(VEXTURE_COORDINATE_BITS))));
}

fn vexture_in_box(point: vec2f, box: VextureBox) -> vec2f {
    return (point * box.unit - box.way) / box.size - box.part;
}

fn vexture_piece(texel: vec4u, box: VextureBox) -> VexturePiece {
    let p0: vec2f = vexture_word(texel.x);
    let p1: vec2f = vexture_word(texel.y);
    let p2: vec2f = vexture_word(texel.z);
    var way: vec2f = vexture_word(texel.w) - p0;
    let falls: vec2<bool> = way < vec2f(0.0);
    let sides: vec2f = box.unit / box.size;
    let rising: vec2f = 3.0 * vec2f(select(sides.x, -sides.x, falls.x), select(sides.y, -sides.y, falls.y));
    var d: vec2f = vexture_in_box(p0, box);
    d = vec2f(select(d.x, 1.0 - d.x, falls.x), select(d.y, 1.0 - d.y, falls.y));
    let c: vec2f = (p1 - p0 - f32(VEXTURE_CONTROL_OFFSET)) * rising;
    let b: vec2f = (p2 - p1) * rising - c;
    way = abs(way) * sides;
    return VexturePiece(way - c - b, b, c, d, way, falls);
}

fn vexture_at(piece: VexturePiece, t: f32) -> vec2f {
    return clamp(((piece.a * t + piece.b) * t + piece.c) * t + piece.d, vec2f(0.0), vec2f(1.0));
}

fn vexture_slope(piece: VexturePiece, t: f32) -> vec2f {
    return (3.0 * piece.a * t + 2.0 * piece.b) * t + piece.c;
}

// A Laguerre step, worth several Newton steps near a turning point, towards the t at which each coordinate is `side`. At a
// flat inflection there is no slope to follow: the step, which never has to be longer than 1, then goes to an end.
fn vexture_better_t(piece: VexturePiece, side: f32, t: vec2f) -> vec2f {
    let q: vec2f = piece.a * t;
    let bend: vec2f = 3.0 * q + piece.b;  // half the second derivative
    let error: vec2f = 3.0 * (((q + piece.b) * t + piece.c) * t + (piece.d - side));
    let slope: vec2f = (bend + piece.b) * t + piece.c;
    let divisor: vec2f = slope + 2.0 * sqrt(abs(slope * slope - error * bend));
    return clamp(t - error / max(divisor, max(abs(error), vec2f(VEXTURE_NO_SIZE))), vec2f(0.0), vec2f(1.0));
}

// The coordinate that passes the box's low sides last decides where the piece enters, and the one that passes a high side
// first, where it leaves. It becomes exactly the side's, because one step of t may be a large part of a small pixel. A piece
// that misses the box passes a corner of it: there it enters and leaves.
fn vexture_ends(piece: VexturePiece) -> VextureEnds {
    let inverse: vec2f = 1.0 / max(piece.way, vec2f(VEXTURE_NO_SIZE));
    var t0: vec2f = clamp(-piece.d * inverse, vec2f(0.0), vec2f(1.0));
    var t1: vec2f = clamp(inverse - piece.d * inverse, vec2f(0.0), vec2f(1.0));
    let close: f32 = VEXTURE_CLOSE * min(inverse.x, inverse.y);
    var steps: i32 = VEXTURE_STEPS;
    while (steps > 0) {
        let better0: vec2f = vexture_better_t(piece, 0.0, t0);
        let better1: vec2f = vexture_better_t(piece, 1.0, t1);
        let moved: vec2f = max(abs(better0 - t0), abs(better1 - t1));
        t0 = better0;
        t1 = better1;
        steps = select(0, steps - 1, max(moved.x, moved.y) > close);
    }
    let start: f32 = max(t0.x, t0.y);
    let end: f32 = max(min(t1.x, t1.y), start);
    var enter: vec2f = vexture_at(piece, start);
    var leave: vec2f = vexture_at(piece, end);
    enter = vec2f(select(enter.x, 0.0, t0.x > t0.y), select(enter.y, 0.0, t0.y > t0.x));
    leave = vec2f(select(leave.x, 1.0, t1.x < t1.y), select(leave.y, 1.0, t1.y < t1.x));
    return VextureEnds(start, end, enter, leave);
}

fn vexture_cross(p: vec2f, q: vec2f) -> f32 {
    return p.x * q.y - p.y * q.x;
}

// Area between a part of a piece and its chord, positive where the piece lies on the right of a chord upwards. Parameters:
// a third of the part's interval of t, and the derivatives at its ends.
fn vexture_bulge(third: f32, first: vec2f, last: vec2f, chord: vec2f) -> f32 {
    return 0.15 * third * (2.0 * vexture_cross(first - last, chord) - third * vexture_cross(first, last));
}

// Mean of a quad near a point of its own unit square: the value of the bilinear function whose means over the four cells
// are the stored coverages.
fn vexture_mean(stored: u32, place: vec2f) -> f32 {
    let cells: vec4f = vec4f(vec4i(i32(stored & 255u), i32((stored >> 8u) & 255u), i32((stored >> 16u) & 255u),
        i32(stored >> 24u)));
    let at: vec2f = 2.0 * place - 0.5;
    let rows: vec2f = mix(cells.xz, cells.yw, vec2f(at.x));
    return clamp(mix(rows.x, rows.y, at.y) / f32(VEXTURE_COVERAGE_ONE), 0.0, 1.0);
}

// Coverage of a pixel with horizontal and vertical sides in the drawing, in views in which all pixels are equal: the
// result of vextureCoverage, with less work and half its registers.
// Exports: VextureFlat, vextureFlat, vextureFlatCoverage.

// Values that all pixels of a view share.
struct VextureFlat {
    extent: vec2f,  // half a pixel, in positions
    inverse: f32,  // of its area
    finest: i32,  // bit of the finest cells
}

// Parameters: the steps to the next pixels, each along one axis.
fn vextureFlat(dx: vec2f, dy: vec2f) -> VextureFlat {
    let extent: vec2f = max(0.5 * (abs(dx) + abs(dy)), vec2f(0.5 * VEXTURE_SMALLEST_PIXEL))
        * f32(1 << u32(VEXTURE_POSITION_BITS));
    let area: f32 = 4.0 * extent.x * extent.y;
    let longer: f32 = 2.0 * max(extent.x, extent.y);
    return VextureFlat(extent, 1.0 / area, vexture_finest_bit(area, longer * longer));
}

// Area of the box to the right of a piece; negative if the piece rises.
fn vexture_flat_piece_area(piece: VexturePiece, ends: VextureEnds) -> f32 {
    let chord: vec2f = ends.leave - ends.enter;
    let first: vec2f = vexture_slope(piece, ends.start);
    let last: vec2f = vexture_slope(piece, ends.end);
    let bulge: f32 = vexture_bulge((ends.end - ends.start) / 3.0, first, last, chord);
    let left: f32 = 0.5 * (ends.enter.x + ends.leave.x) * chord.y + bulge;
    let y0: f32 = clamp(piece.d.y, 0.0, 1.0);
    let y3: f32 = clamp(piece.d.y + piece.way.y, 0.0, 1.0);
    let area: f32 = select(ends.leave.y - y0 - left, y3 - ends.leave.y + left, piece.falls.x);
    return select(-area, area, piece.falls.y);
}

// Filled share of the box.
fn vexture_flat_cell_area(vextureTexels: texture_2d<u32>, cell: VextureCell, box: VextureBox) -> f32 {
    if (cell.is_quad) {
        let side: f32 = bitcast<f32>(u32(127 - cell.bit) << 23u);
        return vexture_mean(cell.texel.w, (box.way + (box.part + 0.5) * box.size) * side);
    }
    let code: i32 = vexture_winding_code(cell);
    let curve: u32 = vexture_first_curve(cell);
    let count: i32 = vexture_count(cell);
    var filled: f32 = select(f32(code - VEXTURE_WINDING_OFFSET), vexture_stored_coverage(cell), code == 0);
    var crossing: i32 = 0;  // a bit for each piece that may cross the box
    for (var i: i32 = 0; i < count; i++) {
        let texel: vec4u = vexture_texel(vextureTexels, curve + u32(i));
        let p0: vec2f = vexture_word(texel.x);
        let p3: vec2f = vexture_word(texel.w);
        let r0: vec2f = vexture_in_box(p0, box);
        let r3: vec2f = vexture_in_box(p3, box);
        let y0: f32 = clamp(r0.y, 0.0, 1.0);
        let y3: f32 = clamp(r3.y, 0.0, 1.0);
        filled += select(0.0, 1.0 - y0, p0.x == 0.0);
        filled -= select(0.0, 1.0 - y3, p3.x == 0.0);
        let right: f32 = max(r0.x, r3.x);
        filled += select(0.0, y0 - y3, right <= 0.0);
        let left: f32 = select(1.0, min(r0.x, r3.x), right > 0.0);
        crossing |= select(0, 1 << u32(i), left < 1.0 && y0 != y3);
    }
    while (crossing != 0) {
        let lowest: i32 = crossing & -crossing;
        var i: i32 = (bitcast<i32>(f32(lowest)) >> 23u) - 127;
        crossing ^= lowest;
        let piece: VexturePiece = vexture_piece(vexture_texel(vextureTexels, curve + u32(i)), box);
        filled += vexture_flat_piece_area(piece, vexture_ends(piece));
    }
    return filled;
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it.
fn vextureFlatCoverage(
    vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, view: VextureFlat,
) -> f32 {
    let place: VexturePlace = vexture_place(base, offset, view.extent);
    var square: VextureSquare = vexture_first_square(place);
    let shared_bit: i32 = square.bit;
    var top: VextureTop = vexture_top(root);
    var area: f32 = 0.0;
    while (square.position.x < VEXTURE_NO_CELL) {
        let cell: VextureCell = vexture_descend(vextureTexels, &top, shared_bit, view.finest, square.position);
        let origin: vec2i = square.position & vec2i(-(1 << u32(cell.bit)));
        let box: VextureBox = vexture_box(origin, cell.bit, place, view.extent);
        area += vexture_flat_cell_area(vextureTexels, cell, box) * (box.size.x * box.size.y);
        square = vexture_next_square(square.position, origin + (1 << u32(cell.bit)), place);
    }
    area *= view.inverse;
    return select(0.0, min(area, 1.0), area > 0.0);  // also 0 if a parameter is NaN
}

// The pixel's footprint: a parallelogram, and the frame in which it is the square from -1/2 to 1/2.
// Exports: VextureFrame, vexture_frame, vexture_into_frame, vexture_slopes, vexture_beside, vexture_box_area.

// Lengths are in positions.
struct VextureFrame {
    right: vec2f,  // rows of the matrix from the drawing's plane to the frame
    up: vec2f,
    extent: vec2f,  // half the footprint's box
    size: f32,  // the footprint's area,
    longer: f32,  // and the square of its longer side
}

fn vexture_frame(dx_given: vec2f, dy_given: vec2f) -> VextureFrame {
    var dx = dx_given;
    var dy = dy_given;
    dx *= f32(1 << u32(VEXTURE_POSITION_BITS));
    dy *= f32(1 << u32(VEXTURE_POSITION_BITS));
    let smallest: f32 = VEXTURE_SMALLEST_PIXEL * f32(1 << u32(VEXTURE_POSITION_BITS));
    var longer: f32 = max(dot(dx, dx), dot(dy, dy));
    var area: f32 = dx.x * dy.y - dx.y * dy.x;
    let exists: bool = longer > smallest * smallest;  // false if a parameter is NaN
    if (!exists || abs(area) < VEXTURE_THINNEST_PIXEL * longer) {  // the plane is seen from its edge
        let width: f32 = select(1.0, VEXTURE_THINNEST_PIXEL, exists);
        dx = select(dy, dx, dot(dx, dx) == longer);
        dx = select(vec2f(smallest, 0.0), dx, exists);
        dy = vec2f(-dx.y, dx.x) * width;
        longer = dot(dx, dx);
        area = width * longer;
    }
    let right: vec2f = vec2f(dy.y, -dy.x) / area;
    let up: vec2f = vec2f(-dx.y, dx.x) / abs(area);  // the frame never mirrors the plane
    return VextureFrame(right, up, 0.5 * (abs(dx) + abs(dy)), abs(area), longer);
}

fn vexture_into_frame(frame: VextureFrame, point: vec2f) -> vec2f {
    return vec2f(dot(frame.right, point), dot(frame.up, point));
}

// Slopes dx / dy and dy / dx of a direction; 0 in place of infinity.
fn vexture_slopes(dx: f32, dy: f32) -> vec2f {
    return vec2f(select(0.0, dx / dy, dy != 0.0), select(0.0, dy / dx, dx != 0.0));
}

// Integral of clamp(u, 0, 1).
fn vexture_ramp(u: f32) -> f32 {
    let held: f32 = clamp(u, 0.0, 1.0);
    return held * (u - 0.5 * held);
}

// Area of the pixel on the right of a straight line from p to a height, both in the frame, with the `vexture_slopes` of
// its direction; negative if the line goes up.
fn vexture_beside_sloped(p: vec2f, end: f32, slopes: vec2f) -> f32 {
    let y0: f32 = clamp(p.y, -0.5, 0.5);
    let y1: f32 = clamp(end, -0.5, 0.5);
    let u0: f32 = 0.5 - p.x - (y0 - p.y) * slopes.x;
    let u1: f32 = 0.5 - p.x - (y1 - p.y) * slopes.x;
    let steep: f32 = (y0 - y1) * clamp(0.5 * (u0 + u1), 0.0, 1.0);
    return select((vexture_ramp(u1) - vexture_ramp(u0)) * slopes.y, steep, abs(u1 - u0) < VEXTURE_SHORT_WAY);
}

fn vexture_beside(p: vec2f, q: vec2f) -> f32 {
    return vexture_beside_sloped(p, q.y, vexture_slopes(q.x - p.x, q.y - p.y));
}

// Approximate fraction of a straight line that lies in the pixel; the factor that it scales is small.
fn vexture_part_inside(p: vec2f, q: vec2f) -> f32 {
    let way: vec2f = q - p;
    let held: vec2f = clamp(q, vec2f(-0.5), vec2f(0.5)) - clamp(p, vec2f(-0.5), vec2f(0.5));
    let x: f32 = select(select(0.0, 1.0, abs(p.x) < 0.5), held.x / way.x, way.x != 0.0);
    let y: f32 = select(select(0.0, 1.0, abs(p.y) < 0.5), held.y / way.y, way.y != 0.0);
    return x * y;
}

// Area of the pixel in a box.
fn vexture_box_area(frame: VextureFrame, low: vec2f, size: vec2f) -> f32 {
    let level: vec2f = vexture_slopes(frame.right.x, frame.up.x);
    let upright: vec2f = vexture_slopes(frame.right.y, frame.up.y);
    let p: vec2f = vexture_into_frame(frame, low);
    let q: vec2f = p + vec2f(frame.right.x, frame.up.x) * size.x;
    let r: vec2f = q + vec2f(frame.right.y, frame.up.y) * size.y;
    let s: vec2f = p + vec2f(frame.right.y, frame.up.y) * size.y;
    return vexture_beside_sloped(p, q.y, level) + vexture_beside_sloped(q, r.y, upright)
        + vexture_beside_sloped(r, s.y, level) + vexture_beside_sloped(s, p.y, upright);
}

// Coverage of a pixel by a shape in a packed texture: the exact area of the shape in the pixel's footprint.
// Exports: vextureCoverage.

// A box as a parallelogram in the footprint's frame.
struct VextureCorner {
    origin: vec2f,
    x: vec2f,  // its sides
    y: vec2f,
}

// Corner of the box at which a piece's coordinates, which may be mirrored, begin.
fn vexture_corner(falls: vec2<bool>, box: VextureBox, frame: VextureFrame) -> VextureCorner {
    let low: vec2f = vec2f(select(box.low.x, box.low.x + box.size.x, falls.x),
        select(box.low.y, box.low.y + box.size.y, falls.y));
    let x: f32 = select(box.size.x, -box.size.x, falls.x);
    let y: f32 = select(box.size.y, -box.size.y, falls.y);
    let origin: vec2f = vexture_into_frame(frame, low);
    return VextureCorner(origin, vec2f(frame.right.x, frame.up.x) * x, vec2f(frame.right.y, frame.up.y) * y);
}

fn vexture_from_corner(corner: VextureCorner, x: f32, y: f32) -> vec2f {
    return corner.origin + corner.x * x + corner.y * y;
}

// Number of parts into which a piece is divided because of its bend.
fn vexture_piece_parts(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> i32 {
    var slope: vec2f = vexture_slope(piece, ends.start);
    let first: vec2f = corner.x * slope.x + corner.y * slope.y;
    slope = vexture_slope(piece, ends.end);
    let last: vec2f = corner.x * slope.x + corner.y * slope.y;
    let p: vec2f = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    let chord: vec2f = vexture_from_corner(corner, ends.leave.x, ends.leave.y) - p;
    let bend: f32 = (ends.end - ends.start) * (abs(vexture_cross(first, chord)) + abs(vexture_cross(last, chord)));
    return 1 + i32(min(VEXTURE_BEND * bend, VEXTURE_MOST_PARTS - 1.0));
}

// Area of the pixel beside a piece between its ends, summed over parts: the area beside each part's chord, plus the area
// between part and chord times the share of the chord in the pixel.
fn vexture_curve_area(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> f32 {
    var parts: i32 = vexture_piece_parts(piece, ends, corner);
    let step_t: f32 = (ends.end - ends.start) / f32(parts);
    var p: vec2f = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    var slope: vec2f = vexture_slope(piece, ends.start);
    var first: vec2f = corner.x * slope.x + corner.y * slope.y;
    var area: f32 = 0.0;
    var t: f32 = ends.start;
    while (parts > 0) {
        parts--;
        t = select(t + step_t, ends.end, parts == 0);
        let next: vec2f = select(vexture_at(piece, t), ends.leave, parts == 0);
        slope = vexture_slope(piece, t);
        let q: vec2f = vexture_from_corner(corner, next.x, next.y);
        let last: vec2f = corner.x * slope.x + corner.y * slope.y;
        area += vexture_beside(p, q) + vexture_bulge(step_t / 3.0, first, last, q - p) * vexture_part_inside(p, q);
        p = q;
        first = last;
    }
    return area;
}

// Path along the box's sides that closes a piece: the box's left side while the piece is left of the box, and back on the
// box's right side.
struct VexturePath {
    corner: VextureCorner,
    l0: vec2f,
    l1: vec2f,
    r0: vec2f,
    r1: vec2f,
    e0: vec2f,
    e1: vec2f,
}

// If the piece `turns`, an end of it lies on the leaf's left edge and in the box, and the part of the box above that end is
// included with the sign of its winding.
fn vexture_path_of(
    texel: vec4u, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame,
) -> VexturePath {
    let corner: VextureCorner = vexture_corner(piece.falls, box, frame);
    let falls: bool = piece.falls.x;
    let top: f32 = select(1.0, 0.0, piece.falls.y);
    var y0: f32 = clamp(piece.d.y, 0.0, 1.0);
    var y3: f32 = clamp(piece.d.y + piece.way.y, 0.0, 1.0);
    y0 = select(y0, top, turns && (texel.x & 0xffffu) == 0u);
    y3 = select(y3, top, turns && (texel.w & 0xffffu) == 0u);
    let left: f32 = select(0.0, 1.0, falls);
    let right: f32 = 1.0 - left;
    let left_end: f32 = select(ends.enter.y, y3, falls);
    let right_end: f32 = select(y0, ends.enter.y, falls);
    let left_start: f32 = select(y0, ends.leave.y, falls);
    let right_start: f32 = select(ends.leave.y, y3, falls);
    let l0: vec2f = vexture_from_corner(corner, left, left_start);
    let l1: vec2f = vexture_from_corner(corner, left, left_end);
    let r0: vec2f = vexture_from_corner(corner, right, right_start);
    let r1: vec2f = vexture_from_corner(corner, right, right_end);
    let e0: vec2f = vexture_from_corner(corner, ends.enter.x, right_end);
    let e1: vec2f = vexture_from_corner(corner, ends.leave.x, right_start);
    return VexturePath(corner, l0, l1, r0, r1, e0, e1);
}

// Area on the right of a piece inside the box; negative if the piece goes up.
fn vexture_piece_area(
    texel: vec4u, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame,
) -> f32 {
    let path: VexturePath = vexture_path_of(texel, turns, piece, ends, box, frame);
    let level: vec2f = vexture_slopes(frame.right.x, frame.up.x);
    let upright: vec2f = vexture_slopes(frame.right.y, frame.up.y);
    var area: f32 = vexture_beside_sloped(path.l0, path.l1.y, upright)
        + vexture_beside_sloped(path.r0, path.r1.y, upright);
    area += vexture_beside_sloped(path.e1, path.r0.y, level) + vexture_beside_sloped(path.r1, path.e0.y, level);
    return area + vexture_curve_area(piece, ends, path.corner);
}

// Centre of the part of a quad in the footprint, in the quad's own unit square: the quad's mean near this point is nearly
// the mean over that part.
fn vexture_cut_place(cell: VextureCell, box: VextureBox, frame: VextureFrame) -> vec2f {
    var middle: vec2f = box.low + 0.5 * box.size;
    let at: vec2f = vexture_into_frame(frame, middle);
    let x: vec2f = abs(vec2f(frame.right.x, frame.up.x)) * box.size.x;
    let y: vec2f = abs(vec2f(frame.right.y, frame.up.y)) * box.size.y;
    let reach: vec2f = 0.5 * (x + y);
    let low: vec2f = max(at - reach, vec2f(-0.5));
    let high: vec2f = min(at + reach, vec2f(0.5));
    let moved: vec2f = VEXTURE_DRAWN * (0.5 * (low + high) - at);
    // back from the frame
    let dx: vec2f = vec2f(frame.up.y, -frame.up.x) * frame.size;
    let dy: vec2f = vec2f(-frame.right.y, frame.right.x) * frame.size;
    middle += dx * moved.x + dy * moved.y;
    let side: f32 = bitcast<f32>(u32(127 - cell.bit) << 23u);
    let place: vec2f = (box.way + box.part * box.size + (middle - box.low)) * side;
    return clamp(place, vec2f(0.0), vec2f(1.0));
}

// Share of the box above the ends of a piece that lie on the leaf's left edge, with the sign of their windings.
fn vexture_above_ends(p0: vec2f, p3: vec2f, y0: f32, y3: f32) -> f32 {
    return select(0.0, 1.0 - y0, p0.x == 0.0) - select(0.0, 1.0 - y3, p3.x == 0.0);
}

// Result from the ends of a piece alone.
struct VextureLook {
    filled: f32,  // share of the box that the piece fills, without the part that only a close look finds
    turns: bool,  // an end lies on the leaf's left edge and in the box
    crosses: bool,  // the piece may cross the box, and needs a close look
}

fn vexture_first_look(texel: vec4u, box: VextureBox) -> VextureLook {
    let p0: vec2f = vexture_word(texel.x);
    let p3: vec2f = vexture_word(texel.w);
    let r0: vec2f = vexture_in_box(p0, box);
    let r3: vec2f = vexture_in_box(p3, box);
    let y0: f32 = clamp(r0.y, 0.0, 1.0);
    let y3: f32 = clamp(r3.y, 0.0, 1.0);
    let is_left: bool = max(r0.x, r3.x) <= 0.0;
    let is_right: bool = min(r0.x, r3.x) >= 1.0;
    let passed: f32 = select(0.0, y0 - y3, is_left);
    let crosses: bool = fract(passed) != 0.0 || (!is_left && !is_right && y0 != y3);
    var look: VextureLook = VextureLook(select(passed, 0.0, crosses), false, crosses);
    if (p0.x * p3.x == 0.0) {
        let above: f32 = vexture_above_ends(p0, p3, y0, y3);
        let cancels: bool = p0.x == p3.x;  // a piece on the left edge, with its ends there
        look.turns = fract(above) != 0.0;
        look.crosses = (look.turns || crosses) && !cancels;
        look.filled = select(above, 0.0, look.turns && !cancels) + select(passed, 0.0, look.crosses);
    }
    return look;
}

// Filled area of the pixel within one cell.
fn vexture_cell_area(vextureTexels: texture_2d<u32>, cell: VextureCell, box: VextureBox, frame: VextureFrame) -> f32 {
    let is_cut: bool = any(box.low > -frame.extent) || any(box.low + box.size < frame.extent);
    var whole: f32 = 1.0;
    if (is_cut) {
        whole = vexture_box_area(frame, box.low, box.size);
    }
    if (cell.is_quad) {
        return whole * vexture_mean(cell.texel.w, vexture_cut_place(cell, box, frame));
    }
    let code: i32 = vexture_winding_code(cell);
    let curve: u32 = vexture_first_curve(cell);
    let count: i32 = select(0, vexture_count(cell), whole > 0.0);
    var filled: f32 = select(f32(code - VEXTURE_WINDING_OFFSET), vexture_stored_coverage(cell), code == 0);
    var crossing: i32 = 0;  // a bit for each piece that may cross the footprint's box,
    var turning: i32 = 0;  // and for each with an end on the leaf's left edge and in the box
    for (var i: i32 = 0; i < count; i++) {
        let look: VextureLook = vexture_first_look(vexture_texel(vextureTexels, curve + u32(i)), box);
        filled += look.filled;
        turning |= select(0, 1 << u32(i), look.turns);
        crossing |= select(0, 1 << u32(i), look.crosses);
    }
    var area: f32 = filled * whole;
    while (crossing != 0) {
        let lowest: i32 = crossing & -crossing;
        var i: i32 = (bitcast<i32>(f32(lowest)) >> 23u) - 127;
        crossing ^= lowest;
        let texel: vec4u = vexture_texel(vextureTexels, curve + u32(i));
        let piece: VexturePiece = vexture_piece(texel, box);
        area += vexture_piece_area(texel, (turning & lowest) != 0, piece, vexture_ends(piece), box, frame);
    }
    return area;
}

// Whether a square of cells lies beside the footprint, though not beside its box.
fn vexture_is_beside(square: VextureSquare, place: VexturePlace, frame: VextureFrame) -> bool {
    let side: i32 = 1 << u32(square.bit);
    let way: vec2f = vec2f((square.position & vec2i(-side)) - place.point) - place.rest;
    let at: vec2f = vexture_into_frame(frame, way + 0.5 * f32(side));
    let reach: vec2f = 0.5 + 0.5 * f32(side)
        * (abs(vec2f(frame.right.x, frame.up.x)) + abs(vec2f(frame.right.y, frame.up.y)));
    return any(abs(at) > reach);
}

// Parameters: the shape's root quad; the pixel's centre, as 32-bit fixed point (1.0 = 2^32) and an offset from it; the
// steps to the next pixels (dFdx, dFdy of the position), taken in uniform control flow.
fn vextureCoverageFrom(
    vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, dx: vec2f, dy: vec2f,
) -> f32 {
    let frame: VextureFrame = vexture_frame(dx, dy);
    let place: VexturePlace = vexture_place(base, offset, frame.extent);
    var square: VextureSquare = vexture_first_square(place);
    let shared_bit: i32 = square.bit;
    let finest: i32 = vexture_finest_bit(frame.size, frame.longer);
    var top: VextureTop = vexture_top(root);
    var area: f32 = 0.0;
    var beside: bool = false;
    while (square.position.x < VEXTURE_NO_CELL) {
        var cell: VextureCell = vexture_descend(vextureTexels, &top, shared_bit,
            select(finest, VEXTURE_NO_CELL, beside), square.position);
        cell.bit = select(cell.bit, square.bit, beside);
        let origin: vec2i = square.position & vec2i(-(1 << u32(cell.bit)));
        let more: f32 = vexture_cell_area(vextureTexels, cell, vexture_box(origin, cell.bit, place, frame.extent),
            frame);
        area += select(more, 0.0, beside);
        square = vexture_next_square(square.position, origin + (1 << u32(cell.bit)), place);
        if (square.position.x < VEXTURE_NO_CELL) {
            beside = vexture_is_beside(square, place, frame);
        }
    }
    return select(0.0, min(area, 1.0), area > 0.0);  // also 0 if a parameter is NaN
}

fn vextureCoverage(vextureTexels: texture_2d<u32>, root: u32, uv: vec2f, dx: vec2f, dy: vec2f) -> f32 {
    return vextureCoverageFrom(vextureTexels, root, vec2u(0u), uv, dx, dy);
}

// Coverage of pixels anywhere: outside the unit square is nothing, the border's value, or the repeated shape.
// Exports: VextureSpot, vexture_spot, VextureTiles, vexture_tiles, vexture_tile, vexture_spot_coverage, vextureWrapped.
//
// VEXTURE_WRAP selects one of VEXTURE_WRAP_NONE, VEXTURE_WRAP_CLAMP or VEXTURE_WRAP_REPEAT. VEXTURE_FLAT is 1 for views
// whose pixels are equal upright rectangles in the drawing, which cost less, or 0 for any view.

// A pixel's footprint, moved to the position where the shape is looked up.
struct VextureSpot {
    base: vec2u,  // its centre: 32-bit fixed point (1.0 = 2^32)
    offset: vec2f,  // and an offset from it
    dx: vec2f,  // steps to the next pixels
    dy: vec2f,
    reach: vec2f,  // half its box
}

// Fixed point as a float, which loses its last bits.
fn vexture_fraction(base: vec2u) -> vec2f {
    return vec2f(base) * exp2(-32.0);
}

fn vexture_spot(base_given: vec2u, offset_given: vec2f, dx_given: vec2f, dy_given: vec2f) -> VextureSpot {
    var base = base_given;
    var offset = offset_given;
    var dx = dx_given;
    var dy = dy_given;
    var reach: vec2f = 0.5 * (abs(dx) + abs(dy));
#if VEXTURE_WRAP == VEXTURE_WRAP_CLAMP
    // a footprint that would leave the square is moved, one larger than the square is shrunk
    let shrink: vec2f = min((VEXTURE_WHOLE_TILE - VEXTURE_BORDER) / max(reach, vec2f(VEXTURE_SMALLEST_PIXEL)),
        vec2f(1.0));
    dx *= shrink;
    dy *= shrink;
    reach *= shrink;
    let inset: vec2f = reach + VEXTURE_BORDER;
    offset = clamp(offset, inset - vexture_fraction(base), 1.0 - inset - vexture_fraction(base));
#elif VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    // the sum of fixed-point numbers drops whole tiles by overflow, and loses nothing else
    let unit: f32 = exp2(16.0);
    offset = clamp(offset, vec2f(-0.5 * unit + 1.0), vec2f(0.5 * unit - 1.0));
    let steps: vec2f = floor(offset * unit);
    base += vec2u(vec2i(steps)) << vec2u(16u);
    offset -= steps / unit;
#endif
    return VextureSpot(base, offset, dx, dy, reach);
}

// The tiles that a footprint touches where a shape is repeated, at most two in each direction.
struct VextureTiles {
    count: i32,
    columns: i32,
    next_base: vec2u,  // in the next tile the base is on the border between the two, where positions of both are exact
    next_offset: vec2f,
    whole: f32,  // share of the whole shape's mean in the result, for a footprint about as large as a tile
}

fn vexture_tiles(spot: VextureSpot) -> VextureTiles {
    var whole: f32 = (max(spot.reach.x, spot.reach.y) - VEXTURE_NEARLY_TILE) / (VEXTURE_WHOLE_TILE
        - VEXTURE_NEARLY_TILE);
    whole = clamp(whole, 0.0, 1.0);
    let place: vec2f = vexture_fraction(spot.base) + spot.offset;
    let margin: vec2f = spot.reach + VEXTURE_BORDER;
    let left: vec2<bool> = place < margin;
    let right: vec2<bool> = place > 1.0 - margin;
    let from_left: vec2f = (vec2f(spot.base) + 1.0) * exp2(-32.0);
    let from_right: vec2f = (vec2f(~spot.base) + 1.0) * exp2(-32.0);
    let next_base: vec2u = vec2u(select(0u, ~0u, left.x), select(0u, ~0u, left.y));
    let next_offset: vec2f = spot.offset + select(-from_right, from_left, left);
    let columns: i32 = select(1, 2, left.x || right.x);
    let rows: i32 = select(1, 2, left.y || right.y);
    return VextureTiles(select(0, columns * rows, whole < 1.0), columns, next_base, next_offset, whole);
}

// Footprint in one of these tiles.
fn vexture_tile(tiles: VextureTiles, spot_given: VextureSpot, tile: i32) -> VextureSpot {
    var spot = spot_given;
    let next_column: bool = (tile & (tiles.columns - 1)) == 1;
    let next_row: bool = tile >= tiles.columns;
    spot.base.x = select(spot.base.x, tiles.next_base.x, next_column);
    spot.base.y = select(spot.base.y, tiles.next_base.y, next_row);
    spot.offset.x = select(spot.offset.x, tiles.next_offset.x, next_column);
    spot.offset.y = select(spot.offset.y, tiles.next_offset.y, next_row);
    return spot;
}

// Stored coverage of the whole square.
fn vexture_mean_coverage(vextureTexels: texture_2d<u32>, root: u32) -> f32 {
    return vexture_mean(vexture_texel(vextureTexels, root).w, vec2f(0.5));
}

fn vexture_coverage_at(vextureTexels: texture_2d<u32>, root: u32, spot: VextureSpot) -> f32 {
#if VEXTURE_FLAT
    return vextureFlatCoverage(vextureTexels, root, spot.base, spot.offset, vextureFlat(spot.dx, spot.dy));
#else
    return vextureCoverageFrom(vextureTexels, root, spot.base, spot.offset, spot.dx, spot.dy);
#endif
}

// A repeated shape is the sum over the tiles that the footprint touches.
fn vexture_spot_coverage(vextureTexels: texture_2d<u32>, root: u32, spot: VextureSpot) -> f32 {
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    let tiles: VextureTiles = vexture_tiles(spot);
    var sum: f32 = 0.0;
    for (var tile: i32 = 0; tile < tiles.count; tile++) {
        sum += vexture_coverage_at(vextureTexels, root, vexture_tile(tiles, spot, tile));
    }
    return mix(min(sum, 1.0), vexture_mean_coverage(vextureTexels, root), tiles.whole);
#else
    return vexture_coverage_at(vextureTexels, root, spot);
#endif
}

// Parameters: those of vextureCoverage; the position may lie anywhere.
fn vextureWrappedFrom(
    vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, dx: vec2f, dy: vec2f,
) -> f32 {
    return vexture_spot_coverage(vextureTexels, root, vexture_spot(base, offset, dx, dy));
}

fn vextureWrapped(vextureTexels: texture_2d<u32>, root: u32, uv: vec2f, dx: vec2f, dy: vec2f) -> f32 {
    return vextureWrappedFrom(vextureTexels, root, vec2u(0u), uv, dx, dy);
}
// Shapes in their colours, composited.
// Exports: vexture_layer_paint, vexture_layer_below, vextureLayers, vextureStraight, vextureQuad.
// A row for each root of the texture: its quad; red and green, blue and opacity as 16-bit halves of words (sRGB); 1 for a
// planar map; then the bounding box of the shape, 1.0 = 65536.

// Quad of a root, given by its number in the texture.
fn vextureQuad(vexturePaints: texture_2d<u32>, root: u32) -> u32 {
    return textureLoad(vexturePaints, vec2i(0, i32(root)), 0).x;
}

// sRGB and opacity, straight.
fn vexture_layer_paint(head: vec4u) -> vec4f {
    return vec4f(unpack2x16unorm(head.y), unpack2x16unorm(head.z));
}

fn vexture_meets(box: vec4u, spot: VextureSpot) -> bool {
    let low: vec2f = vec2f(box.xy) * exp2(-16.0);
    let high: vec2f = vec2f(box.zw) * exp2(-16.0);
    var way: vec2f = vexture_fraction(spot.base) + spot.offset - 0.5 * (low + high);
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    way -= floor(way + 0.5);
#endif
    return all(abs(way) < 0.5 * (high - low) + spot.reach + VEXTURE_BORDER);
}

// Highest layer below another one that the footprint meets, or the number below the first layer.
fn vexture_layer_below(vexturePaints: texture_2d<u32>, layer_given: i32, first: i32, spot: VextureSpot) -> i32 {
    var layer = layer_given;
    var meets: bool = false;
    while (!meets && layer >= first) {
        layer--;
        meets = layer >= first && vexture_meets(textureLoad(vexturePaints, vec2i(1, layer), 0), spot);
    }
    return layer;
}

// Colour of a pixel, premultiplied, composited in sRGB as in SVG. Parameters: the number of the lowest layer, the number of
// layers, then those of vextureCoverage.
//
// Layers are visited from the top until no lower one would show. Layers that the footprint does not meet take no
// iteration: on devices that execute both sides of a branch, skipping them by a branch would cost as much as drawing them.
fn vextureLayersFrom(
    vextureTexels: texture_2d<u32>, vexturePaints: texture_2d<u32>, first: i32, count: i32, base: vec2u, offset: vec2f,
    dx: vec2f, dy: vec2f,
) -> vec4f {
    let spot: VextureSpot = vexture_spot(base, offset, dx, dy);
    var color: vec4f = vec4f(0.0);
    var layer: i32 = vexture_layer_below(vexturePaints, first + count, first, spot);
    while (layer >= first && color.a < VEXTURE_COVERED) {
        let head: vec4u = textureLoad(vexturePaints, vec2i(0, layer), 0);
        let paint: vec4f = vexture_layer_paint(head);
        let cover: f32 = paint.a * vexture_spot_coverage(vextureTexels, head.x, spot);
        color += (1.0 - color.a) * cover * vec4f(paint.rgb, 1.0);
        layer = vexture_layer_below(vexturePaints, layer, first, spot);
    }
    return color;
}

fn vextureLayers(
    vextureTexels: texture_2d<u32>, vexturePaints: texture_2d<u32>, first: i32, count: i32, uv: vec2f, dx: vec2f,
    dy: vec2f,
) -> vec4f {
    return vextureLayersFrom(vextureTexels, vexturePaints, first, count, vec2u(0u), uv, dx, dy);
}

// From premultiplied sRGB to straight linear components.
fn vextureStraight(color: vec4f) -> vec4f {
    return vec4f(vexture_linear(color.rgb / max(color.a, exp2(-24.0))), color.a);
}

// Blend modes (Compositing and Blending Level 1 of the W3C).
// Exports: vexture_blended.

// Blend function B(cb, cs) of one component: b of the backdrop, s of the source that is laid over it.
fn vexture_separable(blend: u32, b: f32, s: f32) -> f32 {
    switch (blend) {
        case u32(VEXTURE_BLEND_MULTIPLY): {
            return b * s;
        }
        case u32(VEXTURE_BLEND_SCREEN): {
            return b + s - b * s;
        }
        case u32(VEXTURE_BLEND_OVERLAY): {
            return select(1.0 - 2.0 * (1.0 - b) * (1.0 - s), 2.0 * b * s, b <= 0.5);
        }
        case u32(VEXTURE_BLEND_DARKEN): {
            return min(b, s);
        }
        case u32(VEXTURE_BLEND_LIGHTEN): {
            return max(b, s);
        }
        case u32(VEXTURE_BLEND_COLOR_DODGE): {
            return select(select(min(1.0, b / (1.0 - s)), 1.0, s >= 1.0), 0.0, b == 0.0);
        }
        case u32(VEXTURE_BLEND_COLOR_BURN): {
            return select(select(1.0 - min(1.0, (1.0 - b) / s), 0.0, s == 0.0), 1.0, b >= 1.0);
        }
        case u32(VEXTURE_BLEND_HARD_LIGHT): {
            return select(1.0 - 2.0 * (1.0 - b) * (1.0 - s), 2.0 * b * s, s <= 0.5);
        }
        case u32(VEXTURE_BLEND_SOFT_LIGHT): {
            let root: f32 = select(sqrt(b), ((16.0 * b - 12.0) * b + 4.0) * b, b <= 0.25);
            return b + (2.0 * s - 1.0) * select(root - b, b * (1.0 - b), s <= 0.5);
        }
        case u32(VEXTURE_BLEND_DIFFERENCE): {
            return abs(b - s);
        }
        default: {}
    }
    return b + s - 2.0 * b * s;  // exclusion
}

fn vexture_luminosity(c: vec3f) -> f32 {
    return dot(c, vec3f(0.3, 0.59, 0.11));
}

fn vexture_saturation(c: vec3f) -> f32 {
    return max(max(c.r, c.g), c.b) - min(min(c.r, c.g), c.b);
}

// The W3C's SetSat.
fn vexture_with_saturation(c: vec3f, wanted: f32) -> vec3f {
    return (c - min(min(c.r, c.g), c.b)) * (wanted / max(vexture_saturation(c), VEXTURE_NOTHING));
}

// The W3C's SetLum and ClipColor.
fn vexture_with_luminosity(c_given: vec3f, wanted: f32) -> vec3f {
    var c = c_given;
    c += wanted - vexture_luminosity(c);
    let least: f32 = min(min(c.r, c.g), c.b);
    let greatest: f32 = max(max(c.r, c.g), c.b);
    var share: f32 = select(1.0, wanted / (wanted - least), least < 0.0);
    share = select(share, (1.0 - wanted) / (greatest - wanted), greatest > 1.0);
    return wanted + (c - wanted) * share;
}

// Makes a colour grey that differs from grey by rounding only: hue and saturation would amplify the difference.
fn vexture_greyed(c: vec3f) -> vec3f {
    return select(c, vec3f(vexture_luminosity(c)), vexture_saturation(c) < VEXTURE_GREY);
}

// Makes a component exactly 0 or 1 if it differs by rounding only: dodge and burn jump there.
fn vexture_settled(c: f32) -> f32 {
    return select(select(c, 1.0, c > 1.0 - VEXTURE_LEAST_COLOR), 0.0, c < VEXTURE_LEAST_COLOR);
}

// Straight colour of a premultiplied colour.
fn vexture_straight_color(color: vec4f, is_whole: bool) -> vec3f {
    var c: vec3f = color.rgb / max(color.a, VEXTURE_NOTHING);
    c = vec3f(vexture_settled(c.r), vexture_settled(c.g), vexture_settled(c.b));
    return select(c, vexture_greyed(c), is_whole);
}

// Blend function B(cb, cs) of straight colours.
fn vexture_mixture(blend: u32, b: vec3f, s: vec3f) -> vec3f {
    if (blend < u32(VEXTURE_BLEND_HUE)) {
        let red: f32 = vexture_separable(blend, b.r, s.r);
        return vec3f(red, vexture_separable(blend, b.g, s.g), vexture_separable(blend, b.b, s.b));
    }
    var color: vec3f = select(b, s, blend == u32(VEXTURE_BLEND_COLOR));
    if (blend == u32(VEXTURE_BLEND_HUE)) {
        color = vexture_with_saturation(s, vexture_saturation(b));
    } else if (blend == u32(VEXTURE_BLEND_SATURATION)) {
        color = vexture_with_saturation(b, vexture_saturation(s));
    }
    return vexture_with_luminosity(color, vexture_luminosity(select(b, s, blend == u32(VEXTURE_BLEND_LUMINOSITY))));
}

// Lays one premultiplied colour over another.
fn vexture_blended(below: vec4f, above: vec4f, mode: u32) -> vec4f {
    if (mode == u32(VEXTURE_BLEND_NORMAL)) {
        return above + (1.0 - above.a) * below;
    }
    if (mode == u32(VEXTURE_BLEND_PLUS_LIGHTER)) {
        return min(below + above, vec4f(1.0));
    }
    let is_whole: bool = mode >= u32(VEXTURE_BLEND_HUE);
    let b: vec3f = vexture_straight_color(below, is_whole);
    let s: vec3f = vexture_straight_color(above, is_whole);
    let apart: vec3f = above.rgb * (1.0 - below.a) + below.rgb * (1.0 - above.a);
    return vec4f(apart + above.a * below.a * vexture_mixture(mode, b, s), above.a + below.a * (1.0 - above.a));
}

// Pictures as paints (FORMAT.md, D.6): the mean of a picture's pixels over a parallelogram.
//
// The weight of each pixel is an integral along the parallelogram's sides, cut at the lines between rows; the area to the
// right of a column's border is the sum over the sides of how far they lie to its right. Pixels that are constant have
// exact weights. Pixels that are interpolated are a convolution of constant ones with a square: their weights are cubic
// along a side between two lines, so that Gauss-Legendre quadrature with two points is exact up to the kinks of columns.
// Colours at the border continue beyond it: a column or row at the border has all the weight beyond.
//
// VEXTURE_GRADIENTS is 0 if no map has programs, 1 if they hold no pictures, or 2 if they hold pictures: text that is not
// needed is left out, because it takes registers.
// Exports: VextureLevel, vexture_first_level, vexture_picture_mean, vexture_pixel.
// Exports to spline.glsl: vexture_block.

#if VEXTURE_GRADIENTS == 2

// A level of a picture: columns and rows, and the texel of its first pixels. In a picture of opacities, whose pixels are in
// blocks, it has the number of its first entry in the index instead, as if texel 0 began with entry 0.
struct VextureLevel {
    size: vec2i,
    first: u32,
    blocks: u32,  // the texel of the first block; 0 in other pictures
}

// A parallelogram in a level, in pixels from `origin`: where each of its sides begins, and the side.
struct VextureOutline {
    x: vec4f,
    y: vec4f,
    run: vec4f,
    rise: vec4f,  // not 0
    low: vec2f,  // its bounds
    high: vec2f,
    origin: vec2i,
}

// Parts of an outline's sides between two heights.
struct VextureStrip {
    low: vec4f,
    high: vec4f,
    rise: vec4f,
}

// Two points on each of these parts, and their weights for the rows of pixels below and above.
struct VexturePoints {
    first: vec4f,
    second: vec4f,
    first_below: vec4f,
    second_below: vec4f,
    first_above: vec4f,
    second_above: vec4f,
}

// Premultiplied colour of a pixel, 0..255.
fn vexture_pixel(word: u32) -> vec4f {
    return vec4f(vec4u(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u));
}

// Weighted sum of the pixels of a texel: two columns in the row below, and in the row above.
fn vexture_sum_pixels(pixels: vec4u, weights: vec4f) -> vec4f {
    let below: vec4f = weights.x * vexture_pixel(pixels.x) + weights.y * vexture_pixel(pixels.y);
    return below + weights.z * vexture_pixel(pixels.z) + weights.w * vexture_pixel(pixels.w);
}

// The opacities of a block, by its column and row: a word for each of its rows.
fn vexture_block(vextureTexels: texture_2d<u32>, level: VextureLevel, i: i32, j: i32) -> vec4u {
    let place: u32 = level.first + u32(j) * u32((level.size.x - 1) / VEXTURE_BLOCK_SIDE + 1) + u32(i);
    let entries: vec4u = vexture_texel(vextureTexels, place >> u32(VEXTURE_ENTRY_BITS));
    let entry: u32 = (entries[(place >> 1u) & 3u] >> (16u * (place & 1u))) & 0xffffu;
    var found: vec4u = vec4u(entry * 0x01010101u);
    if (entry >= u32(VEXTURE_FIRST_BLOCK)) {
        found = vexture_texel(vextureTexels, level.blocks + entry - u32(VEXTURE_FIRST_BLOCK));
    }
    return found;
}

// The texel of two columns and two rows of pixels; opacities are in the low bytes of its words.
fn vexture_pixels_at(vextureTexels: texture_2d<u32>, level: VextureLevel, i: i32, j: i32) -> vec4u {
    if (level.blocks != 0u) {
        let block: vec4u = vexture_block(vextureTexels, level, i >> 1u, j >> 1u);
        let rows: vec2u = select(block.zw, block.xy, (j & 1) == 0);
        let shift: u32 = 16u * u32(i & 1);
        return vec4u(rows.x >> shift, rows.x >> (shift + 8u), rows.y >> shift, rows.y >> (shift + 8u)) & vec4u(255u);
    }
    return vexture_texel(vextureTexels, level.first + u32(j) * u32((level.size.x + 1) >> 1u) + u32(i));
}

// The level with half as many columns and rows.
fn vexture_next_level(level: VextureLevel) -> VextureLevel {
    let parts: vec2i = (level.size - 1) / select(VEXTURE_BLOCK_SIDE, 2, level.blocks == 0u) + 1;
    return VextureLevel((level.size + 1) >> vec2u(1u), level.first + u32(parts.x) * u32(parts.y), level.blocks);
}

// The picture itself, from its columns and rows and its first texel.
fn vexture_first_level(size: vec2i, first: u32, has_blocks: bool) -> VextureLevel {
    var level: VextureLevel = VextureLevel(size, first, 0u);
    if (has_blocks) {
        level = VextureLevel(size, first << u32(VEXTURE_ENTRY_BITS), 1u);
        var last: VextureLevel = level;
        while (last.size.x + last.size.y > 2) {
            last = vexture_next_level(last);
        }
        level.blocks = (last.first >> u32(VEXTURE_ENTRY_BITS)) + 1u;  // the last level has one entry
    }
    return level;
}

// The outline of a parallelogram, widened if it is thin.
fn vexture_outline(middle: vec2f, right: vec2f, up: vec2f) -> VextureOutline {
    let is_high: bool = dot(up, up) > dot(right, right);
    var a: vec2f = select(right, up, is_high);
    var b: vec2f = select(up, right, is_high);
    var size: f32 = sqrt(dot(a, a));
    a = select(a, vec2f(VEXTURE_LEAST_OUTLINE, 0.0), size < VEXTURE_LEAST_OUTLINE);
    size = max(size, VEXTURE_LEAST_OUTLINE);
    let wide: f32 = (a.x * b.y - a.y * b.x) / size;
    let more: f32 = max(VEXTURE_THINNEST_OUTLINE * size - abs(wide), 0.0) / size;
    b += select(more, -more, wide < 0.0) * vec2f(-a.y, a.x);
    let origin: vec2f = floor(middle);
    let reach: vec2f = 0.5 * (abs(a) + abs(b));
    let corner: vec2f = middle - origin - 0.5 * (a + b);
    let rise_a: f32 = select(VEXTURE_NOTHING, a.y, abs(a.y) > VEXTURE_NOTHING);
    let rise_b: f32 = select(VEXTURE_NOTHING, b.y, abs(b.y) > VEXTURE_NOTHING);
    return VextureOutline(corner.x + vec4f(0.0, a.x, a.x + b.x, b.x), corner.y + vec4f(0.0, a.y, a.y + b.y, b.y),
        vec4f(a.x, b.x, -a.x, -b.x), vec4f(rise_a, rise_b, -rise_a, -rise_b), middle - origin - reach, middle - origin
        + reach, vec2i(origin));
}

// Where each side reaches a height, in 0..1 of the side.
fn vexture_cuts(outline: VextureOutline, y: f32) -> vec4f {
    return clamp((y - outline.y) / outline.rise, vec4f(0.0), vec4f(1.0));
}

// A line between pixels, or through their centres, within bounds; the first and the last one are at the bounds.
fn vexture_line(k: i32, count: i32, place: f32, bounds: vec2f) -> f32 {
    return select(select(clamp(place, bounds.x, bounds.y), bounds.y, k >= count), bounds.x, k <= 0);
}

// First and last column of texels that an outline meets between two heights.
fn vexture_columns(level: VextureLevel, outline: VextureOutline, from_: vec4f, to: vec4f, reach: f32) -> vec2i {
    var found: vec2f = vec2f(VEXTURE_PICTURE_FAR, -VEXTURE_PICTURE_FAR);
    for (var k: i32 = 0; k < 4; k++) {
        let start: f32 = outline.x[k] + from_[k] * outline.run[k];
        let end: f32 = outline.x[k] + to[k] * outline.run[k];
        found.x = select(found.x, min(found.x, min(start, end)), from_[k] != to[k]);
        found.y = select(found.y, max(found.y, max(start, end)), from_[k] != to[k]);
    }
    let first: i32 = clamp(i32(floor(found.x - reach)) + outline.origin.x, 0, level.size.x - 1) >> 1u;
    let last: i32 = clamp(i32(floor(found.y + reach)) + outline.origin.x, 0, level.size.x - 1) >> 1u;
    return vec2i(first, min(last, first + VEXTURE_PICTURE_LINES));
}

fn vexture_strip(outline: VextureOutline, from_: vec4f, to: vec4f) -> VextureStrip {
    let start: vec4f = outline.x + from_ * outline.run;
    let end: vec4f = outline.x + to * outline.run;
    return VextureStrip(min(start, end), max(start, end), abs(to - from_) * outline.rise);
}

// Area of a strip to the right of a vertical line.
fn vexture_area_beyond(strip: VextureStrip, x: f32) -> f32 {
    let share: vec4f = clamp((strip.high - x) / max(strip.high - strip.low, vec4f(VEXTURE_NOTHING)), vec4f(0.0),
        vec4f(1.0));
    return 0.5 * dot(strip.rise, share * (max(strip.low - x, vec4f(0.0)) + max(strip.high - x, vec4f(0.0))));
}

// Mean of constant pixels over an outline.
fn vexture_area_mean(vextureTexels: texture_2d<u32>, level: VextureLevel, outline: VextureOutline) -> vec4f {
    var sum: vec4f = vec4f(0.0);
    var total: f32 = 0.0;
    let sides: vec2f = vec2f(outline.low.x, outline.high.x);
    let ends: vec2f = vec2f(outline.low.y, outline.high.y);
    let first: i32 = clamp(i32(floor(ends.x)) + outline.origin.y, 0, level.size.y - 1) >> 1u;
    let last: i32 = clamp(i32(floor(ends.y)) + outline.origin.y, 0, level.size.y - 1) >> 1u;
    var above: vec4f = vexture_cuts(outline, ends.x);
    for (var j: i32 = first; j <= min(last, first + VEXTURE_PICTURE_LINES); j++) {
        let below: vec4f = above;
        let place: f32 = f32(2 * j - outline.origin.y);
        let between: vec4f = vexture_cuts(outline, vexture_line(2 * j + 1, level.size.y, place + 1.0, ends));
        above = vexture_cuts(outline, vexture_line(2 * j + 2, level.size.y, place + 2.0, ends));
        let low: VextureStrip = vexture_strip(outline, below, between);
        let high: VextureStrip = vexture_strip(outline, between, above);
        let columns: vec2i = vexture_columns(level, outline, below, above, 0.0);
        var x: f32 = f32(2 * columns.x - outline.origin.x);
        var line: f32 = vexture_line(2 * columns.x, level.size.x, x, sides);
        var left: vec2f = vec2f(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
        for (var i: i32 = columns.x; i <= columns.y; i++) {
            line = vexture_line(2 * i + 1, level.size.x, x + 1.0, sides);
            let middle: vec2f = vec2f(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
            x += 2.0;
            line = vexture_line(2 * i + 2, level.size.x, x, sides);
            let right: vec2f = vec2f(vexture_area_beyond(low, line), vexture_area_beyond(high, line));
            let weights: vec4f = vec4f(left.x - middle.x, middle.x - right.x, left.y - middle.y, middle.y - right.y);
            sum += vexture_sum_pixels(vexture_pixels_at(vextureTexels, level, i, j), weights);
            total += weights.x + weights.y + weights.z + weights.w;
            left = right;
        }
    }
    return sum / select(1.0, total, total != 0.0);
}

// Points on the parts of sides above the height of the centres of a row.
fn vexture_points(outline: VextureOutline, from_: vec4f, to: vec4f, y: f32) -> VexturePoints {
    let first: vec4f = 0.5 * (from_ + to) - VEXTURE_GAUSS * (to - from_);
    let second: vec4f = 0.5 * (from_ + to) + VEXTURE_GAUSS * (to - from_);
    let first_above: vec4f = outline.y - y + first * outline.rise;
    let second_above: vec4f = outline.y - y + second * outline.rise;
    let rise: vec4f = 0.5 * abs(to - from_) * outline.rise;
    return VexturePoints(outline.x + first * outline.run, outline.x + second * outline.run, rise * (1.0 - first_above),
        rise * (1.0 - second_above), rise * first_above, rise * second_above);
}

// Integral, from the left, of the sum of the weights of a column and of all to its right, for places from its centre.
fn vexture_ramp_beyond(place: vec4f) -> vec4f {
    let after: vec4f = max(place + 1.0, vec4f(0.0));
    let within: vec4f = min(after, vec4f(1.0));
    return after - within + 0.5 * within * within;
}

// Weights of the columns from one with this centre on, in the rows below and above.
fn vexture_weight_beyond(points: VexturePoints, x: f32) -> vec2f {
    let first: vec4f = vexture_ramp_beyond(points.first - x);
    let second: vec4f = vexture_ramp_beyond(points.second - x);
    let below: f32 = dot(points.first_below, first) + dot(points.second_below, second);
    return vec2f(below, dot(points.first_above, first) + dot(points.second_above, second));
}

// Two columns of pixels in two rows, which may be in different texels.
fn vexture_pixels_in(vextureTexels: texture_2d<u32>, level: VextureLevel, i: i32, rows: vec2i) -> vec4u {
    let below: vec4u = vexture_pixels_at(vextureTexels, level, i, rows.x >> 1u);
    var above: vec4u = below;
    if (rows.x >> 1u != rows.y >> 1u) {
        above = vexture_pixels_at(vextureTexels, level, i, rows.y >> 1u);
    }
    let first: vec2u = select(below.zw, below.xy, (rows.x & 1) == 0);
    let second: vec2u = select(above.zw, above.xy, (rows.y & 1) == 0);
    return vec4u(first, second);
}

// Mean of interpolated pixels over an outline.
fn vexture_smooth_mean(vextureTexels: texture_2d<u32>, level: VextureLevel, outline: VextureOutline) -> vec4f {
    var sum: vec4f = vec4f(0.0);
    var total: f32 = 0.0;
    let sides: vec2f = vec2f(outline.low.x - 1.0, outline.high.x + 1.0);
    let first: i32 = i32(floor(outline.low.y - 0.5)) + outline.origin.y;
    let last: i32 = i32(floor(outline.high.y - 0.5)) + outline.origin.y;
    var above: vec4f = vexture_cuts(outline, outline.low.y);
    for (var j: i32 = first; j <= min(last, first + VEXTURE_PICTURE_LINES); j++) {
        let below: vec4f = above;
        let y: f32 = f32(j - outline.origin.y) + 0.5;
        above = vexture_cuts(outline, y + 1.0);
        let points: VexturePoints = vexture_points(outline, below, above, y);
        let columns: vec2i = vexture_columns(level, outline, below, above, 0.5);
        let rows: vec2i = clamp(vec2i(j, j + 1), vec2i(0), vec2i(level.size.y - 1));
        var x: f32 = f32(2 * columns.x - outline.origin.x) + 0.5;
        var left: vec2f = vexture_weight_beyond(points, vexture_line(2 * columns.x, level.size.x, x, sides));
        for (var i: i32 = columns.x; i <= columns.y; i++) {
            let middle: vec2f = vexture_weight_beyond(points, vexture_line(2 * i + 1, level.size.x, x + 1.0, sides));
            x += 2.0;
            let right: vec2f = vexture_weight_beyond(points, vexture_line(2 * i + 2, level.size.x, x, sides));
            let weights: vec4f = vec4f(left.x - middle.x, middle.x - right.x, left.y - middle.y, middle.y - right.y);
            sum += vexture_sum_pixels(vexture_pixels_in(vextureTexels, level, i, rows), weights);
            total += weights.x + weights.y + weights.z + weights.w;
            left = right;
        }
    }
    return sum / select(1.0, total, total != 0.0);
}

// Mean of a picture, 0..255, over a parallelogram in its pixels, given by its middle and sides, which has this share of a
// footprint: smaller ones cost less, which limits the cost of all in a footprint.
fn vexture_picture_mean(
    vextureTexels: texture_2d<u32>, level_given: VextureLevel, is_smooth_given: bool, middle: vec2f, right_given: vec2f,
    up_given: vec2f, share: f32,
) -> vec4f {
    var level = level_given;
    var is_smooth = is_smooth_given;
    var right = right_given;
    var up = up_given;
    let longer: f32 = max(dot(right, right), dot(up, up));
    var area: f32 = max(abs(right.x * up.y - right.y * up.x) / share, VEXTURE_PICTURE_LENGTH * longer);
    area *= 1.0 - VEXTURE_LEVEL_BIAS;
    let far: f32 = max(abs(middle.x), abs(middle.y));
    is_smooth = is_smooth && area <= VEXTURE_SMOOTH_AREA && far <= VEXTURE_PICTURE_FAR;
    var scale: f32 = 1.0;
    // so that it ends at the last level if a number is not finite
    while (!(area <= VEXTURE_PICTURE_AREA && far <= VEXTURE_PICTURE_FAR) && level.size.x + level.size.y > 2) {
        level = vexture_next_level(level);
        scale *= 0.5;
        area *= 0.25;
    }
    if (level.size.x + level.size.y == 2) {
        return vexture_pixel(vexture_pixels_at(vextureTexels, level, 0, 0).x);
    }
    if (is_smooth) {
        if (longer < VEXTURE_SHORT_SMOOTH * VEXTURE_SHORT_SMOOTH) {
            let wide: vec2f = max(sqrt(right * right + up * up), vec2f(VEXTURE_LEAST_SMOOTH));
            right = vec2f(wide.x, 0.0);
            up = vec2f(0.0, wide.y);
        }
        return vexture_smooth_mean(vextureTexels, level, vexture_outline(middle, right, up));
    }
    return vexture_area_mean(vextureTexels, level, vexture_outline(scale * middle, scale * right, scale * up));
}
#endif

// Pictures whose pixels are the coefficients of cubic B-splines (FORMAT.md, D.6): the mean of a spline over a parallelogram.
//
// Over an upright box it is exact: the weight of a column or row is a difference of integrals. For opacities, a small
// parallelogram is divided into few parts, each replaced by the box with the same variances. In others, and for colours,
// pixels are interpolated linearly, and the parallelogram is widened by the variance that a spline has beyond that:
// 1/3 - 1/6 in each direction. That is off by 0.4 of 255 for a blurred edge, and takes no further code.
//
// VEXTURE_GRADIENTS is 2 if programs hold pictures.
// Exports: vexture_sampled_mean.

#if VEXTURE_GRADIENTS == 2

// Integral, from the left, of the sum of the B-splines of a column and of all to its right, for places from its left line.
fn vexture_spline_beyond(place: vec4f) -> vec4f {
    var wide: vec4f = max(1.5 - abs(place), vec4f(0.0));
    var narrow: vec4f = max(0.5 - abs(place), vec4f(0.0));
    wide *= wide;
    narrow *= narrow;
    return max(place, vec4f(0.0)) + (wide * wide - 3.0 * narrow * narrow) / 24.0;
}

// Shares that the columns or rows of `count` from each of four on have in the mean between two places from `origin`. Beyond
// the border all is that of the one at the border.
fn vexture_shares_beyond(first: i32, count: i32, origin: f32, between: vec2f) -> vec4f {
    let number: vec4f = f32(first) + vec4f(0.0, 1.0, 2.0, 3.0);
    let line: vec4f = number - origin;
    var share: vec4f = vexture_spline_beyond(between.y - line) - vexture_spline_beyond(between.x - line);
    share = max(share / (between.y - between.x), clamp(1.0 - number, vec4f(0.0), vec4f(1.0)));
    return share * clamp(f32(count) - number, vec4f(0.0), vec4f(1.0));
}

// Mean opacity over an upright box, given by its middle and its sides.
fn vexture_box_mean(vextureTexels: texture_2d<u32>, level: VextureLevel, middle_given: vec2f, sides: vec2f) -> f32 {
    var middle = middle_given;
    middle = min(max(middle, vec2f(-VEXTURE_WIDEST_SPLINE_BOX)), vec2f(level.size) + VEXTURE_WIDEST_SPLINE_BOX);
    let origin: vec2f = floor(middle);
    let low: vec2f = middle - origin - 0.5 * sides;
    let high: vec2f = low + sides;
    let first: vec2i = clamp(vec2i(origin + floor(low - 1.5)), vec2i(0), level.size - 1) / VEXTURE_BLOCK_SIDE;
    var last: vec2i = clamp(vec2i(origin + floor(high + 1.5)), vec2i(0), level.size - 1) / VEXTURE_BLOCK_SIDE;
    last = min(last, first + 4);  // more than the widest box needs: bounds the work for invalid numbers
    var sum: f32 = 0.0;
    var above: vec4f = vexture_shares_beyond(4 * first.y, level.size.y, origin.y, vec2f(low.y, high.y));
    for (var j: i32 = first.y; j <= last.y; j++) {
        var row: vec4f = above;
        above = vexture_shares_beyond(4 * j + 4, level.size.y, origin.y, vec2f(low.y, high.y));
        row -= vec4f(row.yzw, above.x);
        var right: vec4f = vexture_shares_beyond(4 * first.x, level.size.x, origin.x, vec2f(low.x, high.x));
        for (var i: i32 = first.x; i <= last.x; i++) {
            var column: vec4f = right;
            right = vexture_shares_beyond(4 * i + 4, level.size.x, origin.x, vec2f(low.x, high.x));
            column -= vec4f(column.yzw, right.x);
            let block: vec4u = vexture_block(vextureTexels, level, i, j);
            sum += row.x * dot(column, vexture_pixel(block.x)) + row.y * dot(column, vexture_pixel(block.y));
            sum += row.z * dot(column, vexture_pixel(block.z)) + row.w * dot(column, vexture_pixel(block.w));
        }
    }
    return sum;
}

// The two sides of a parallelogram, in columns and rows, with the variances of another one and 1/6 more in each direction.
fn vexture_widen(right: vec2f, up: vec2f) -> vec4f {
    let longer: f32 = max(dot(right, right), dot(up, up));
    let area: f32 = max(abs(right.x * up.y - right.y * up.x), max(VEXTURE_THINNEST_PIXEL * longer, VEXTURE_NOTHING));
    let inverse: f32 = 2.0 / (area * area);
    let along: f32 = 1.0 + inverse * dot(up, up);
    let beside: f32 = 1.0 + inverse * dot(right, right);
    let both: f32 = -inverse * dot(right, up);
    let root: f32 = sqrt(max(along * beside - both * both, 0.0));
    let sides: vec4f = vec4f((along + root) * right + both * up, both * right + (beside + root) * up);
    return sides / sqrt(along + beside + 2.0 * root);
}

// Mean of a picture of any sampling, 0..255, over a parallelogram; parameters as of vexture_picture_mean, which is called
// in one place, because compilers copy it.
fn vexture_sampled_mean(
    vextureTexels: texture_2d<u32>, level: VextureLevel, sampling: u32, middle: vec2f, right_given: vec2f,
    up_given: vec2f, share: f32,
) -> vec4f {
    var right = right_given;
    var up = up_given;
    let less: f32 = 1.0 - VEXTURE_LEVEL_BIAS;
    let slants: vec2f = less * sqrt(abs(vec2f(right.x * right.y, up.x * up.y)));
    let parts: vec2f = max(ceil(slants / VEXTURE_SLANTED_PART), vec2f(1.0));
    var sides: vec2f = sqrt(right * right / (parts.x * parts.x) + up * up / (parts.y * parts.y));
    var is_small: bool = parts.x * parts.y <= f32(VEXTURE_MOST_SPLINE_BOXES);
    is_small = is_small && less * max(sides.x, sides.y) <= VEXTURE_WIDEST_SPLINE_BOX;
    if (is_small && sampling >= u32(VEXTURE_SAMPLING_OPACITY)) {
        sides = max(sides, vec2f(VEXTURE_LEAST_SPLINE_BOX));
        let across: i32 = i32(parts.x);
        let number: i32 = across * i32(parts.y);
        var sum: f32 = 0.0;
        for (var k: i32 = 0; k < number; k++) {
            let place: vec2f = (vec2f(vec2i(k % across, k / across)) + 0.5) / parts - 0.5;
            sum += vexture_box_mean(vextureTexels, level, middle + place.x * right + place.y * up, sides);
        }
        return vec4f(sum / f32(number), 0.0, 0.0, 0.0);
    }
    if (sampling >= u32(VEXTURE_SAMPLING_SPLINE)) {
        let widened: vec4f = vexture_widen(right, up);
        right = widened.xy;
        up = widened.zw;
    }
    return vexture_picture_mean(vextureTexels, level, sampling != u32(VEXTURE_SAMPLING_PIXELS), middle, right, up,
        share);
}
#endif

// Paints that hold gradients or pictures (FORMAT.md, D.6): the colour of a program over a region, the part of a footprint
// in a cell.
// Exports: VextureRegion, vexture_halves, vexture_program.
//
// VEXTURE_GRADIENTS is 0 if no map has programs: their text is then left out, because it takes registers. It is 2 if
// programs may hold pictures.

// In the unit square.
struct VextureRegion {
    point: vec2f,  // its middle
    right: vec2f,  // its sides
    up: vec2f,
}

// Unpacks four numbers, 0..65535, from two words.
fn vexture_halves(words: vec2u) -> vec4f {
    return vec4f(vec4u(words.x & 0xffffu, words.x >> 16u, words.y & 0xffffu, words.y >> 16u));
}

#if VEXTURE_GRADIENTS

// A position on a ramp, and its gradient in x and y of the unit square.
struct VextureRamp {
    t: f32,
    way: vec2f,
    exists: bool,  // false outside a cone
    parts: vec2f,  // per side of a region, so that the ramp is nearly straight in each
}

// GLSL's mod, which other shading languages lack.
fn vexture_mod(x: f32, y: f32) -> f32 {
    return x - y * floor(x / y);
}

// Change of a value along each side of a region, from the value's gradient in x and y.
fn vexture_spans(way: vec2f, region: VextureRegion) -> vec2f {
    return abs(vec2f(dot(way, region.right), dot(way, region.up)));
}

// The place on a circular ramp: the greatest t whose circle, about c t from the focal point, goes through the region's middle
// and has a radius, |q - c t|^2 = (fr + t dr)^2. Near the border of a cone it is that of a point further inside, as the
// borders of faces are where something is painted. The circle bends away from its tangent, on which places are further out:
// t is their mean. Parameters: the rows of the map to the ramp; focal point and radius.
fn vexture_round_ramp(across: vec3f, up: vec3f, focus: vec2f, region: VextureRegion) -> VextureRamp {
    var q: vec2f = vec2f(dot(across.xy, region.point) + across.z - focus.x, dot(up.xy, region.point) + up.z);
    let spans: vec2f = max(vexture_spans(across.xy, region), vexture_spans(up.xy, region));
    var parts: vec2f = f32(VEXTURE_RAMP_PARTS) * spans;
    let grows: f32 = 1.0 - focus.y;
    let tip: f32 = focus.x / max(grows, VEXTURE_NOTHING) - focus.x;  // where the circles have radius 0
    parts = select(parts, vec2f(f32(VEXTURE_MOST_RAMP_PARTS)), length(q - vec2f(tip, 0.0)) < length(spans));
    let a: f32 = (focus.x - grows) * (focus.x + grows);  // exactly 0 for circles that touch, even if products are fused
    if (a >= 0.0 && grows > 0.0) {
        // the middle of a part of what is in a cone may be beside it, and then in the cone behind the tip
        let outside: f32 = q.x - tip + sqrt(a) / grows * abs(q.y);
        q.x -= select(0.0, max(outside, 0.0), outside < 0.5 * f32(VEXTURE_MOST_RAMP_PARTS) * length(spans));
    }
    var b: f32 = focus.y * grows - q.x * focus.x;
    var c: f32 = dot(q, q) - focus.y * focus.y;
    var inside: f32 = b * b - a * c;
    if (a >= 0.0) {
        let slope: vec2f = -2.0 * vec2f(b * focus.x + a * q.x, a * q.y);
        let sides: vec2f = vexture_spans(slope.x * across.xy + slope.y * up.xy, region);
        let least: f32 = 0.25 * (sides.x + sides.y);
        parts = select(parts, vec2f(f32(VEXTURE_MOST_RAMP_PARTS)), inside < 4.0 * least);
        if (inside < least) {
            q += (least - inside) / max(dot(slope, slope), VEXTURE_NOTHING) * slope;
            b = focus.y * grows - q.x * focus.x;
            c = dot(q, q) - focus.y * focus.y;
            inside = b * b - a * c;
        }
    }
    let root: f32 = sqrt(max(inside, 0.0));
    let far: f32 = select(b + root, b - root, b < 0.0);  // the roots are far / a and c / far, neither of which cancels
    let first: f32 = select(VEXTURE_NO_PLACE, far / a, a != 0.0);
    let second: f32 = select(VEXTURE_NO_PLACE, c / far, far != 0.0);
    var t: f32 = max(first, second);
    t = select(t, min(first, second), focus.y + t * grows < -VEXTURE_LEAST_RADIUS || t > -VEXTURE_NO_PLACE);
    let radius: f32 = focus.y + t * grows;
    let exists: bool = radius >= -VEXTURE_LEAST_RADIUS && t > VEXTURE_NO_PLACE;
    var e: vec2f = vec2f(q.x + t * focus.x, q.y);
    e = select(vec2f(0.0), normalize(e), length(e) > VEXTURE_LEAST_RADIUS);  // a circle of radius 0 has no direction
    let down: f32 = grows - e.x * focus.x;
    let beside: vec2f = vexture_spans(e.x * up.xy - e.y * across.xy, region);
    var bend: f32 = dot(beside, beside) / 12.0;
    bend /= max(sqrt(radius * radius + bend) + radius, VEXTURE_NOTHING);
    let ahead: vec2f = vexture_spans(e.x * across.xy + e.y * up.xy, region);
    let least_bend: f32 = VEXTURE_RAMP_BEND * max(radius, 0.0) * (ahead.x + ahead.y);
    parts = max(parts, beside / sqrt(max(least_bend, VEXTURE_NOTHING)));
    let inverse: f32 = select(0.0, 1.0 / down, down != 0.0);
    let way: vec2f = inverse * (e.x * across.xy + e.y * up.xy);
    return VextureRamp(t + inverse * bend, way, exists, parts);
}

// Adds to a sum the integral of a stretch of a ramp between two stops, given by the colour and slope at its start. The
// weights are a trapezoid: they rise from the first of its edges to the second, are 1 up to the third, and fall up to the
// fourth. In each of these parts Simpson's rule is exact: a premultiplied colour, which is quadratic, is multiplied by a
// linear weight.
fn vexture_add_stretch(total_given: vec4f, color: vec4f, slope: vec4f, stretch: vec2f, edges: vec4f) -> vec4f {
    var total = total_given;
    for (var k: i32 = 0; k < 3; k++) {
        let part: vec2f = clamp(select(select(edges.zw, edges.yz, k == 1), edges.xy, k == 0), vec2f(stretch.x),
            vec2f(stretch.y));
        if (part.y > part.x) {
            var weights: vec2f = vec2f(1.0);
            weights = select(weights, (part - edges.x) / (edges.y - edges.x), k == 0);
            weights = select(weights, (edges.w - part) / (edges.w - edges.z), k == 2);
            var c0: vec4f = color + slope * (part.x - stretch.x);
            var c2: vec4f = color + slope * (part.y - stretch.x);
            var c1: vec4f = 0.5 * (c0 + c2);
            c0 = weights.x * vec4f(c0.rgb * c0.a, c0.a);
            c1 = 2.0 * (weights.x + weights.y) * vec4f(c1.rgb * c1.a, c1.a);
            c2 = weights.y * vec4f(c2.rgb * c2.a, c2.a);
            total += (part.y - part.x) / 6.0 * (c0 + c1 + c2);
        }
    }
    return total;
}

// Adds the same of a whole ramp between bounds; before its first stop and after its last, their colours continue.
fn vexture_add_ramp(
    vextureTexels: texture_2d<u32>, total_given: vec4f, stops: u32, number: u32, edges: vec4f, bounds: vec2f,
) -> vec4f {
    var total = total_given;
    var before: vec4f = vec4f(0.0);
    var begin: f32 = bounds.x;
    for (var k: u32 = 0u; k <= number; k++) {
        var after: vec4f = before;
        var end: f32 = bounds.y;
        if (k < number) {
            let stop: vec4u = vexture_texel(vextureTexels, stops + k);
            after = vexture_halves(stop.yz) / f32(VEXTURE_PAINT_ONE);
            end = bitcast<f32>(stop.x);
        }
        before = select(before, after, k == 0u);
        let a: f32 = clamp(begin, bounds.x, bounds.y);
        let b: f32 = clamp(end, a, bounds.y);
        if (b > a) {
            let slope: vec4f = select((after - before) / (end - begin), vec4f(0.0), k == 0u || k == number);
            total = vexture_add_stretch(total, before + slope * (a - begin), slope, vec2f(a, b), edges);
        }
        if (end >= bounds.y) {
            break;
        }
        begin = end;
        before = after;
    }
    return total;
}

// Integral of a ramp with its spread method; over at most two periods if it is not padded.
fn vexture_spread_sum(vextureTexels: texture_2d<u32>, stops: u32, number: u32, spread: u32, edges: vec4f) -> vec4f {
    let pads: bool = spread == u32(VEXTURE_SPREAD_PAD);
    var sum: vec4f = vec4f(0.0);
    var whole: f32 = select(floor(edges.x), 0.0, pads);
    for (var k: i32 = 0; k < 3; k++) {
        var here: vec4f = edges - whole;
        here = select(here, 1.0 - here.wzyx, spread == u32(VEXTURE_SPREAD_REFLECT) && vexture_mod(whole, 2.0) != 0.0);
        sum = vexture_add_ramp(vextureTexels, sum, stops, number, here,
            select(clamp(here.xw, vec2f(0.0), vec2f(1.0)), here.xw, pads));
        whole += 1.0;
        if (pads || whole >= edges.w) {
            break;
        }
    }
    return sum;
}

// Mean of a ramp over a parallelogram, given the position at its centre and the change along its sides: the weights of
// positions are a trapezoid. If the ramp repeats, whole periods of a side have the mean of a period; the rest of the side
// counts with its share, moved by half of these periods.
fn vexture_ramp_mean(
    vextureTexels: texture_2d<u32>, stops: u32, number: u32, spread: u32, middle_given: f32, spans_given: vec2f,
) -> vec4f {
    var middle = middle_given;
    var spans = spans_given;
    let pads: bool = spread == u32(VEXTURE_SPREAD_PAD);
    spans = clamp(spans, vec2f(select(VEXTURE_SHORTEST_RAMP, 0.0, pads)), vec2f(VEXTURE_LONGEST_RAMP));
    let period: f32 = select(1.0, 2.0, spread == u32(VEXTURE_SPREAD_REFLECT));
    let whole: vec2f = select(period * floor(spans / period + 0.5), vec2f(0.0), pads);
    let rest: vec2f = abs(spans - whole);
    let share: f32 = (1.0 - whole.x / max(spans.x, VEXTURE_NOTHING)) * (1.0 - whole.y / max(spans.y, VEXTURE_NOTHING));
    var mean: vec4f = vec4f(0.0);
    if (abs(share) >= 1.0 - VEXTURE_NEARLY_WHOLE) {
        let wide: f32 = max(max(rest.x, rest.y), VEXTURE_SHORTEST_RAMP);
        let narrow: f32 = min(rest.x, rest.y);
        // a repeated ramp is periodic in 2, and float32 is finer near 0
        let turned: f32 = vexture_mod(vexture_mod(middle, 2.0) - 0.5 * vexture_mod(whole.x + whole.y, 4.0), 2.0);
        middle = select(turned, clamp(middle, -wide - narrow, 1.0 + wide + narrow), pads);
        let edges: vec4f = middle + 0.5 * vec4f(-wide - narrow, narrow - wide, wide - narrow, wide + narrow);
        let size: f32 = 0.5 * (edges.w - edges.x + edges.z - edges.y);
        mean = vexture_spread_sum(vextureTexels, stops, number, spread, edges) / size;
    }
    if (any(whole != vec2f(0.0))) {
        let full: vec4f = vexture_add_ramp(vextureTexels, vec4f(0.0), stops, number, vec4f(0.0, 0.0, 1.0, 1.0),
            vec2f(0.0, 1.0));
        mean = mix(full, mean, vec4f(share));
    }
    return mean;
}

// Ramp of a gradient over a region, from the gradient's first texel and its index.
fn vexture_gradient_ramp(vextureTexels: texture_2d<u32>, at: u32, record: vec4u, region: VextureRegion) -> VextureRamp {
    let kind: u32 = record.w >> u32(VEXTURE_KIND_SHIFT);
    let across: vec3f = bitcast<vec3f>(record.xyz);
    if (kind == u32(VEXTURE_KIND_LINEAR)) {
        return VextureRamp(dot(across.xy, region.point) + across.z, across.xy, true, vec2f(0.0));
    }
    var focus: vec2f = vec2f(0.0);
    if (kind == u32(VEXTURE_KIND_FOCAL)) {
        focus = bitcast<vec2f>(vexture_texel(vextureTexels, at + 2u).xy);
    }
    return vexture_round_ramp(across, bitcast<vec3f>(vexture_texel(vextureTexels, at + 1u).xyz), focus, region);
}

// Premultiplied mean colour of a gradient, from its first texel, the texel's index and the number of stops, over a region
// in which its ramp is straight.
fn vexture_gradient(
    vextureTexels: texture_2d<u32>, at: u32, record: vec4u, number: u32, region: VextureRegion,
) -> vec4f {
    let ramp: VextureRamp = vexture_gradient_ramp(vextureTexels, at, record, region);
    let stops: u32 = at + (record.w & ((1u << u32(VEXTURE_STOP_BITS)) - 1u));
    let spread: u32 = (record.w >> u32(VEXTURE_STOP_BITS + VEXTURE_STOP_COUNT_BITS)) & 3u;
    var mean: vec4f = vec4f(0.0);
    if (ramp.exists) {
        mean = vexture_ramp_mean(vextureTexels, stops, number, spread, ramp.t, vexture_spans(ramp.way, region));
    }
    return mean;
}

#if VEXTURE_GRADIENTS == 2

// A parallelogram in the pixels of a picture, from the picture's first texel: its middle and its sides.
fn vexture_picture_region(vextureTexels: texture_2d<u32>, at: u32, region: VextureRegion) -> VextureRegion {
    let across: vec3f = bitcast<vec3f>(vexture_texel(vextureTexels, at + 1u).xyz);
    let down: vec3f = bitcast<vec3f>(vexture_texel(vextureTexels, at + 2u).xyz);
    let point: vec2f = vec2f(dot(across.xy, region.point) + across.z, dot(down.xy, region.point) + down.z);
    let right: vec2f = vec2f(dot(across.xy, region.right), dot(down.xy, region.right));
    return VextureRegion(point, right, vec2f(dot(across.xy, region.up), dot(down.xy, region.up)));
}

// Premultiplied mean colour of a picture, from its first texel and the texel's index, over a region that has this share of
// a pixel.
fn vexture_picture(vextureTexels: texture_2d<u32>, at: u32, record: vec4u, region: VextureRegion, share: f32) -> vec4f {
    let size: vec2i = max(vec2i(vec2u(record.y & 0xffffu, record.y >> 16u)), vec2i(1));
    let sampling: u32 = record.w & 7u;
    let is_one: bool = sampling >= u32(VEXTURE_SAMPLING_OPACITY);
    let pixels: VextureRegion = vexture_picture_region(vextureTexels, at, region);
    let level: VextureLevel = vexture_first_level(size, at + record.z, is_one);
    let opacity: f32 = f32(record.x & 0xffffu) / f32(VEXTURE_PAINT_ONE) / f32(VEXTURE_COVERAGE_ONE);
    var mean: vec4f = vexture_sampled_mean(vextureTexels, level, sampling, pixels.point, pixels.right, pixels.up,
        share);
    if (is_one) {
        let one: f32 = f32(VEXTURE_COVERAGE_ONE);
        let color: vec4f = vexture_pixel(vexture_texel(vextureTexels, at + 1u).w);
        mean = select(mean.x, one - mean.x, sampling == u32(VEXTURE_SAMPLING_INVERSE)) * vec4f(color.rgb / one, 1.0);
    }
    return opacity * mean;
}
#endif

// Ends a group: lays its colour on the colour kept at its begin, or masks that colour with it.
fn vexture_ended(kept: vec4f, color: vec4f, how: u32) -> vec4f {
    if (how < u32(VEXTURE_MASKS)) {
        return vexture_blended(kept, color, how);
    }
    let parts: vec3f = vec3f(VEXTURE_LUMINANCE_RED, VEXTURE_LUMINANCE_GREEN, VEXTURE_LUMINANCE_BLUE);
    return kept * select(color.a, dot(parts, color.rgb), how == u32(VEXTURE_MASKS + VEXTURE_MASK_LUMINANCE));
}

// Premultiplied colour of a program over a region that is small enough for means of its gradients to be composited, and has
// this share of a pixel.
fn vexture_program_part(
    vextureTexels: texture_2d<u32>, at_given: u32, end: u32, region: VextureRegion, share: f32,
) -> vec4f {
    var at = at_given;
    var color: vec4f = vec4f(0.0);
    var kept: vec4f = vec4f(0.0);
    var kept_before: vec4f = vec4f(0.0);
    var kept_first: vec4f = vec4f(0.0);
    var left: u32 = u32(VEXTURE_MOST_STOPS);  // bounds the work for invalid texels
    for (; at < end; at++) {
        let texel: vec4u = vexture_texel(vextureTexels, at);
        var kind: u32 = texel.w >> u32(VEXTURE_KIND_SHIFT);
        if (kind == u32(VEXTURE_KIND_KEEP)) {
            kept_first = kept_before;
            kept_before = kept;
            kept = color;
            color = vec4f(0.0);
        } else if (kind == u32(VEXTURE_KIND_MIX)) {
            color = vexture_ended(kept, color * (f32(texel.x) / f32(VEXTURE_PAINT_ONE)), texel.y);
            kept = kept_before;
            kept_before = kept_first;
        } else if (kind != u32(VEXTURE_KIND_FOLLOWS)) {
            var above: vec4f = vexture_halves(texel.xy) / f32(VEXTURE_PAINT_ONE);
#if VEXTURE_GRADIENTS == 2
            if (kind == u32(VEXTURE_KIND_PICTURE)) {
                above = vexture_picture(vextureTexels, at, texel, region, share);
                kind = u32(VEXTURE_KIND_SOLID);  // as its colour is known
            }
#endif
            if (kind != u32(VEXTURE_KIND_SOLID)) {
                let number: u32 = clamp((texel.w >> u32(VEXTURE_STOP_BITS)) & u32(VEXTURE_MOST_STOPS), 1u,
                    max(left, 1u));
                left -= min(number, left);
                above = vexture_gradient(vextureTexels, at, texel, number, region);
            }
            color = above + (1.0 - above.a) * color;
        }
    }
    return color;
}

// Number of parts into which each side of a region is divided for a program, so that circles are nearly straight in each
// part, and ramps are short if a product of gradients or a blend mode is averaged. A small region of a pixel is divided
// less, which limits the cost of all regions of a pixel.
fn vexture_program_parts(
    vextureTexels: texture_2d<u32>, at_given: u32, end: u32, region: VextureRegion, area: f32,
) -> vec2f {
    var at = at_given;
    var bends: vec2f = vec2f(0.0);
    var ramps: vec2f = vec2f(0.0);
    var factors: i32 = 0;  // a blend mode or a mask counts as two factors
    var for_each: f32 = f32(VEXTURE_PRODUCT_PARTS);
    for (; at < end; at++) {
        let texel: vec4u = vexture_texel(vextureTexels, at);
        let kind: u32 = texel.w >> u32(VEXTURE_KIND_SHIFT);
        if (kind == u32(VEXTURE_KIND_MIX)) {
            factors += select(2, 0, texel.y == u32(VEXTURE_BLEND_NORMAL));
            // not of dodge and burn: a part beyond the end of a band has its last colour, where they may jump
            if (texel.y > u32(VEXTURE_BLEND_COLOR_BURN) && texel.y < u32(VEXTURE_MASKS)) {
                for_each = f32(VEXTURE_BLEND_PARTS);
            }
        } else if (kind >= u32(VEXTURE_KIND_LINEAR) && kind <= u32(VEXTURE_KIND_FOCAL)) {
            let ramp: VextureRamp = vexture_gradient_ramp(vextureTexels, at, texel, region);
            factors++;
            bends = max(bends, ramp.parts);
            ramps = max(ramps, vexture_spans(ramp.way, region));
        }
#if VEXTURE_GRADIENTS == 2
        if (kind == u32(VEXTURE_KIND_PICTURE)) {
            let pixels: VextureRegion = vexture_picture_region(vextureTexels, at, region);
            factors++;
            ramps = max(ramps, VEXTURE_PICTURE_RAMP * vec2f(length(pixels.right), length(pixels.up)));
        }
#endif
    }
    ramps = select(bends, max(bends, for_each * ramps), factors > 1);
    let most: f32 = clamp(f32(VEXTURE_PIXEL_PARTS) * sqrt(abs(area)), 1.0, f32(VEXTURE_MOST_RAMP_PARTS));
    return ceil(clamp(ramps, vec2f(1.0), vec2f(most)));
}

// Premultiplied mean colour, 0..65535, of a program, given by its first texel and their number, over a region with this
// area of a pixel.
fn vexture_program(vextureTexels: texture_2d<u32>, at: u32, count: u32, region: VextureRegion, area: f32) -> vec4f {
    let end: u32 = at + min(count, u32(VEXTURE_MOST_PROGRAM));
    let parts: vec2f = vexture_program_parts(vextureTexels, at, end, region, area);
    let across: i32 = i32(parts.x);
    let number: i32 = across * i32(parts.y);
    var part: VextureRegion = VextureRegion(region.point, region.right / parts.x, region.up / parts.y);
    let share: f32 = max(abs(area), VEXTURE_LEAST_SHARE) / f32(number);
    var sum: vec4f = vec4f(0.0);
    for (var k: i32 = 0; k < number; k++) {
        let place: vec2f = vec2f(vec2i(k % across, k / across)) + 0.5 - 0.5 * parts;
        part.point = region.point + place.x * part.right + place.y * part.up;
        sum += vexture_program_part(vextureTexels, at, end, part, share);
    }
    return sum * (f32(VEXTURE_PAINT_ONE) / f32(number));
}
#endif

// Area and first and second moments of the part of a pixel that a piece fills. The moments give the centre and the extent
// of a paint's part of a cell, over which the paint's gradients are averaged.
//
// Each moment is an integral, over the heights of a straight line, of a polynomial of at most the third degree, so that
// Gauss-Legendre quadrature with two points is exact.
// VEXTURE_GRADIENTS is 0 if no map has programs: a share is then only an area.
// Exports: VextureShare, vexture_plus_share, vexture_box_share, vexture_piece_share, vexture_flat_piece_share.

// Share of a pixel: area, and moments about the pixel's centre, in units of its sides.
struct VextureShare {
    area: f32,
#if VEXTURE_GRADIENTS
    x: f32,
    y: f32,
    xx: f32,
    xy: f32,
    yy: f32,
#endif
}

// Share with an area but without moments.
fn vexture_area_share(area: f32) -> VextureShare {
#if VEXTURE_GRADIENTS
    return VextureShare(area, 0.0, 0.0, 0.0, 0.0, 0.0);
#else
    return VextureShare(area);
#endif
}

// Share of a whole pixel.
fn vexture_whole_share() -> VextureShare {
#if VEXTURE_GRADIENTS
    return VextureShare(1.0, 0.0, 0.0, 1.0 / 12.0, 0.0, 1.0 / 12.0);
#else
    return VextureShare(1.0);
#endif
}

// Sum of a share and a multiple of another.
fn vexture_plus_share(a: VextureShare, b: VextureShare, times: f32) -> VextureShare {
#if VEXTURE_GRADIENTS
    return VextureShare(a.area + times * b.area, a.x + times * b.x, a.y + times * b.y, a.xx + times * b.xx, a.xy
        + times * b.xy, a.yy + times * b.yy);
#else
    return VextureShare(a.area + times * b.area);
#endif
}

// Converts a share of a box to one of its pixel, given the box's sides and centre in the pixel.
fn vexture_moved_share(share: VextureShare, sides: vec2f, middle: vec2f) -> VextureShare {
    let area: f32 = sides.x * sides.y * share.area;
#if VEXTURE_GRADIENTS
    var first: vec2f = sides.x * sides.y * sides * vec2f(share.x, share.y);
    var second: vec3f = sides.x * sides.y * sides.xxy * sides.xyy * vec3f(share.xx, share.xy, share.yy);
    second += vec3f(2.0 * first.x * middle.x, first.x * middle.y + first.y * middle.x, 2.0 * first.y * middle.y);
    second += area * middle.xxy * middle.xyy;
    first += area * middle;
    return VextureShare(area, first.x, first.y, second.x, second.y, second.z);
#else
    return VextureShare(area);
#endif
}

#if VEXTURE_GRADIENTS

// Area and moments, per unit of height, of the part of the pixel to the right of a point at its height.
fn vexture_share_at(place: vec2f) -> VextureShare {
    let wide: f32 = 0.5 - place.x;
    let first: f32 = 0.5 * (0.25 - place.x * place.x);
    let second: f32 = (0.125 - place.x * place.x * place.x) / 3.0;
    return VextureShare(wide, first, place.y * wide, second, place.y * first, place.y * place.y * wide);
}

// Share to the right of a straight line inside the pixel; negative if the line goes up.
fn vexture_stretch_share(p: vec2f, q: vec2f) -> VextureShare {
    let middle: vec2f = 0.5 * (p + q);
    let way: vec2f = VEXTURE_GAUSS * (q - p);
    let fall: f32 = 0.5 * (p.y - q.y);
    let share: VextureShare = vexture_plus_share(vexture_area_share(0.0), vexture_share_at(middle - way), fall);
    return vexture_plus_share(share, vexture_share_at(middle + way), fall);
}

// The same for any straight line: where it is left of the pixel, all of the pixel lies on its right.
fn vexture_share_beside(p: vec2f, q: vec2f) -> VextureShare {
    let way: vec2f = q - p;
    let run: f32 = select(VEXTURE_NOTHING, way.x, abs(way.x) > VEXTURE_NOTHING);
    let rise: f32 = select(VEXTURE_NOTHING, way.y, abs(way.y) > VEXTURE_NOTHING);
    let low: f32 = clamp((-0.5 - p.y) / rise, 0.0, 1.0);
    let high: f32 = clamp((0.5 - p.y) / rise, 0.0, 1.0);
    let start: f32 = min(low, high);
    let end: f32 = max(low, high);
    let left: f32 = clamp((-0.5 - p.x) / run, start, end);
    let right: f32 = clamp((0.5 - p.x) / run, start, end);
    var outside: vec2f = p.y + way.y * select(vec2f(left, end), vec2f(start, left), run > 0.0);
    outside = clamp(outside, vec2f(-0.5), vec2f(0.5));
    let enter: vec2f = clamp(p + way * min(left, right), vec2f(-0.5), vec2f(0.5));
    let leave: vec2f = clamp(p + way * max(left, right), vec2f(-0.5), vec2f(0.5));
    let share: VextureShare = vexture_stretch_share(vec2f(-0.5, outside.x), vec2f(-0.5, outside.y));
    return vexture_plus_share(share, vexture_stretch_share(enter, leave), 1.0);
}

// Share of the pixel in a box.
fn vexture_box_share(frame: VextureFrame, low: vec2f, size: vec2f) -> VextureShare {
    let p: vec2f = vexture_into_frame(frame, low);
    let q: vec2f = p + vec2f(frame.right.x, frame.up.x) * size.x;
    let r: vec2f = q + vec2f(frame.right.y, frame.up.y) * size.y;
    let s: vec2f = p + vec2f(frame.right.y, frame.up.y) * size.y;
    var share: VextureShare = vexture_plus_share(vexture_share_beside(p, q), vexture_share_beside(q, r), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(r, s), 1.0);
    return vexture_plus_share(share, vexture_share_beside(s, p), 1.0);
}

// Like vexture_curve_area, with moments; the area between a part and its chord counts as if it lay at the chord's middle.
fn vexture_curve_share(piece: VexturePiece, ends: VextureEnds, corner: VextureCorner) -> VextureShare {
    var parts: i32 = vexture_piece_parts(piece, ends, corner);
    let step_t: f32 = (ends.end - ends.start) / f32(parts);
    var p: vec2f = vexture_from_corner(corner, ends.enter.x, ends.enter.y);
    var slope: vec2f = vexture_slope(piece, ends.start);
    var first: vec2f = corner.x * slope.x + corner.y * slope.y;
    var share: VextureShare = vexture_area_share(0.0);
    var t: f32 = ends.start;
    while (parts > 0) {
        parts--;
        t = select(t + step_t, ends.end, parts == 0);
        let next: vec2f = select(vexture_at(piece, t), ends.leave, parts == 0);
        slope = vexture_slope(piece, t);
        let q: vec2f = vexture_from_corner(corner, next.x, next.y);
        let last: vec2f = corner.x * slope.x + corner.y * slope.y;
        let more: f32 = vexture_bulge(step_t / 3.0, first, last, q - p) * vexture_part_inside(p, q);
        let m: vec2f = clamp(0.5 * (p + q), vec2f(-0.5), vec2f(0.5));
        share = vexture_plus_share(share, vexture_share_beside(p, q), 1.0);
        share = vexture_plus_share(share, VextureShare(1.0, m.x, m.y, m.x * m.x, m.x * m.y, m.y * m.y), more);
        p = q;
        first = last;
    }
    return share;
}

// Like vexture_piece_area, with moments.
fn vexture_piece_share(
    texel: vec4u, turns: bool, piece: VexturePiece, ends: VextureEnds, box: VextureBox, frame: VextureFrame,
) -> VextureShare {
    let path: VexturePath = vexture_path_of(texel, turns, piece, ends, box, frame);
    var share: VextureShare = vexture_curve_share(piece, ends, path.corner);
    share = vexture_plus_share(share, vexture_share_beside(path.l0, path.l1), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(path.r0, path.r1), 1.0);
    share = vexture_plus_share(share, vexture_share_beside(path.e1, path.r0), 1.0);
    return vexture_plus_share(share, vexture_share_beside(path.r1, path.e0), 1.0);
}

// Like vexture_flat_piece_area, with moments, for a box as the pixel.
fn vexture_flat_piece_share(piece: VexturePiece, ends: VextureEnds) -> VextureShare {
    let origin: vec2f = vec2f(select(-0.5, 0.5, piece.falls.x), select(-0.5, 0.5, piece.falls.y));
    let corner: VextureCorner = VextureCorner(origin, vec2f(-2.0 * origin.x, 0.0), vec2f(0.0, -2.0 * origin.y));
    let from_: f32 = select(clamp(piece.d.y, 0.0, 1.0), ends.leave.y, piece.falls.x);
    let to: f32 = select(ends.enter.y, clamp(piece.d.y + piece.way.y, 0.0, 1.0), piece.falls.x);
    let left: vec2f = origin.y - 2.0 * origin.y * vec2f(from_, to);  // where it is left of the box
    let share: VextureShare = vexture_curve_share(piece, ends, corner);
    return vexture_plus_share(share, vexture_stretch_share(vec2f(-0.5, left.x), vec2f(-0.5, left.y)), 1.0);
}

// Share of a box above a height in 0..1.
fn vexture_share_above(y: f32) -> VextureShare {
    return vexture_stretch_share(vec2f(-0.5, 0.5), vec2f(-0.5, y - 0.5));
}

// Share that vexture_flat_look finds filled: the box above ends of the piece on the leaf's left edge and, unless the piece
// crosses the box, the box beside a piece on its left.
fn vexture_flat_ends_share(texel: vec4u, crosses: bool, box: VextureBox) -> VextureShare {
    let p0: vec2f = vexture_word(texel.x);
    let p3: vec2f = vexture_word(texel.w);
    let r0: vec2f = vexture_in_box(p0, box);
    let r3: vec2f = vexture_in_box(p3, box);
    let passed: f32 = select(0.0, 1.0, !crosses && max(r0.x, r3.x) <= 0.0);
    let first: f32 = select(0.0, 1.0, p0.x == 0.0) - passed;
    let last: f32 = select(0.0, 1.0, p3.x == 0.0) - passed;
    let share: VextureShare = vexture_plus_share(vexture_area_share(0.0), vexture_share_above(clamp(r0.y, 0.0, 1.0)),
        first);
    return vexture_plus_share(share, vexture_share_above(clamp(r3.y, 0.0, 1.0)), -last);
}
#endif

// The paints of a planar map (FORMAT.md, D.5), and a sum of them.
// Exports: VexturePlanar, VextureSum, vexture_planar, vexture_nothing, vexture_add_paint, vexture_add_piece, vexture_settle.
//
// VEXTURE_LINEAR is 0 for a mean in sRGB, or 1 for a mean in linear light, with linear components. VEXTURE_GRADIENTS is 0
// if no map has programs.

// First texel of each part of a map.
struct VexturePlanar {
    root: u32,
    cells: u32,
    sides: u32,
    paints: u32,
    packing: u32,  // logarithm to base 2 of the count of paint numbers in a word
}

// Reads the head of a map, which precedes its root quad.
fn vexture_planar(vextureTexels: texture_2d<u32>, root: u32) -> VexturePlanar {
    let head: vec4u = vexture_texel(vextureTexels, root - 1u);
    let packing: u32 = select(select(2u, 1u, head.x > u32(VEXTURE_MOST_BYTE_PAINTS)), 0u,
        head.x > u32(VEXTURE_MOST_HALF_PAINTS));
    return VexturePlanar(root, head.y, head.z, head.w, packing);
}

// Index of the texel with the means of a quad's cells. A texel of base paints precedes each block of 1, 2 or 4 quads.
fn vexture_means_at(planar: VexturePlanar, quad: u32) -> u32 {
    let place: u32 = quad - planar.root;
    return planar.cells + 1u + place + (place >> planar.packing);
}

// Number at a place in a sequence of packed numbers; `word` is the word that contains it.
fn vexture_numbered(planar: VexturePlanar, word: u32, place: u32) -> u32 {
    let bits: u32 = 32u >> planar.packing;
    return (word >> (bits * (place & ((1u << planar.packing) - 1u)))) & (0xffffffffu >> (32u - bits));
}

// Number of the base paint of a leaf.
fn vexture_base_paint(vextureTexels: texture_2d<u32>, planar: VexturePlanar, cell: VextureCell) -> u32 {
    let place: u32 = cell.quad - planar.root;
    let block: u32 = place >> planar.packing;
    let numbers: vec4u = vexture_texel(vextureTexels, planar.cells + (block << planar.packing) + block);
    let k: u32 = 4u * place + (cell.shift >> 3u);
    return vexture_numbered(planar, numbers[(k >> planar.packing) & 3u], k);
}

// Converts a stored colour to the premultiplied colour that is averaged. Sums of differences of whole steps are exact.
fn vexture_averaged(stored: vec4f) -> vec4f {
#if VEXTURE_LINEAR
    return vec4f(vexture_linear(min(stored.rgb / max(stored.a, 1.0), vec3f(1.0))) * stored.a, stored.a);
#else
    return stored;
#endif
}

fn vexture_paint_words(vextureTexels: texture_2d<u32>, planar: VexturePlanar, number: u32) -> vec2u {
    let both: vec4u = vexture_texel(vextureTexels, planar.paints + (number >> 1u));
    return select(both.zw, both.xy, (number & 1u) == 0u);
}

// Returns whether a paint is a program: its opacity is 0, but its first word is not.
fn vexture_is_program(words: vec2u) -> bool {
    return words.x != 0u && words.y >> 16u == 0u;
}

// Sum of a pixel's colours, times their areas. The pieces of a cell name the same few paints again and again, and most of
// their shares cancel. The shares of programs are summed first, so that each program runs once, over its part of the cell.
// There is room for four programs: those with the smallest numbers above `done`. The others are left for another round.
struct VextureSum {
    color: vec4f,
#if VEXTURE_GRADIENTS
    kept: u32,  // program that fills whole cells, within the pixel, and its share:
    kept_share: VextureShare,  // across the borders of cells, it runs once
    done: u32,
    is_left: bool,
    cell: f32,  // area of the cell within the pixel
    paints: vec4u,  // 0 is a free slot, because paint 0 is no program
    areas: vec4f,  // of each paint the parts of its share
    x: vec4f,
    y: vec4f,
    xx: vec4f,
    xy: vec4f,
    yy: vec4f,
#endif
}

fn vexture_nothing() -> VextureSum {
#if VEXTURE_GRADIENTS
    let none: vec4f = vec4f(0.0);
    return VextureSum(none, 0u, vexture_area_share(0.0), 0u, false, 0.0, vec4u(0u), none, none, none, none, none, none);
#else
    return VextureSum(vec4f(0.0));
#endif
}

#if VEXTURE_GRADIENTS
// Slot for a paint: its own, else a free one, else the slot of the greatest number if that is greater than its own; else 4.
fn vexture_slot(sum: VextureSum, paint: u32) -> i32 {
    var best: i32 = 0;
    for (var slot: i32 = 0; slot < 4; slot++) {
        if (sum.paints[slot] == paint) {
            return slot;
        }
        let is_freer: bool = sum.paints[slot] - 1u > sum.paints[best] - 1u;  // 0 is the greatest
        best = select(best, slot, is_freer);
    }
    return select(4, best, sum.paints[best] - 1u >= paint);
}

// Adds a program's share if there is room.
fn vexture_add_program(sum: ptr<function, VextureSum>, paint: u32, share: VextureShare) {
    let slot: i32 = vexture_slot(*sum, paint);
    let is_new: bool = slot < 4 && (*sum).paints[slot & 3] != paint;
    (*sum).is_left = (*sum).is_left || slot == 4 || (is_new && (*sum).paints[slot & 3] != 0u);
    if (slot < 4) {
        let kept: f32 = select(1.0, 0.0, is_new);
        (*sum).paints[slot] = paint;
        (*sum).areas[slot] = kept * (*sum).areas[slot] + share.area;
        (*sum).x[slot] = kept * (*sum).x[slot] + share.x;
        (*sum).y[slot] = kept * (*sum).y[slot] + share.y;
        (*sum).xx[slot] = kept * (*sum).xx[slot] + share.xx;
        (*sum).xy[slot] = kept * (*sum).xy[slot] + share.xy;
        (*sum).yy[slot] = kept * (*sum).yy[slot] + share.yy;
    }
}
#endif

// Adds a paint over a part of a region.
fn vexture_add_paint(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, paint: u32,
    share: VextureShare,
) {
#if VEXTURE_GRADIENTS
    if (paint > (*sum).done) {
        var words: vec2u = vec2u(1u, 0u);  // as of a program: its share is summed already
        if (!any((*sum).paints == vec4u(paint))) {
            words = vexture_paint_words(vextureTexels, planar, paint);
        }
        if (vexture_is_program(words)) {
            vexture_add_program(sum, paint, share);
        } else if ((*sum).done == 0u) {
            (*sum).color += share.area * vexture_averaged(vexture_halves(words));
        }
    }
#else
    (*sum).color += share.area * vexture_averaged(vexture_halves(vexture_paint_words(vextureTexels, planar, paint)));
#endif
}

// Returns whether a program is kept.
fn vexture_holds_kept(sum: VextureSum) -> bool {
#if VEXTURE_GRADIENTS
    return sum.kept != 0u;
#else
    return false;
#endif
}

// Adds the kept program.
fn vexture_add_kept(vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar) {
#if VEXTURE_GRADIENTS
    vexture_add_paint(vextureTexels, sum, planar, (*sum).kept, (*sum).kept_share);
    (*sum).kept = 0u;
    (*sum).cell = VEXTURE_NO_SHARE;  // so that no share fills the cell: the program would be kept forever
#endif
}

// Adds the base paint of a cell, over the cell's part of the pixel.
fn vexture_add_base(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, paint: u32,
    share: VextureShare,
) {
#if VEXTURE_GRADIENTS
    (*sum).cell = share.area;
#endif
    vexture_add_paint(vextureTexels, sum, planar, paint, share);
}

// Adds the paint on the left of a piece, and subtracts the paint on its right.
fn vexture_add_piece(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, sides: vec2u,
    share: VextureShare,
) {
    vexture_add_paint(vextureTexels, sum, planar, sides.x, share);
    vexture_add_paint(vextureTexels, sum, planar, sides.y, vexture_plus_share(vexture_area_share(0.0), share, -1.0));
}

#if VEXTURE_GRADIENTS
// Parallelogram with the moments of a share of a region. Its centre is the share's, and its sides are the region's times
// the symmetric root of the share's covariance, which is 1 for a whole region.
fn vexture_part(region: VextureRegion, share: VextureShare) -> VextureRegion {
    let at: vec2f = clamp(vec2f(share.x, share.y) / share.area, vec2f(-0.5), vec2f(0.5));
    let xx: f32 = clamp(12.0 * (share.xx / share.area - at.x * at.x), 0.0, 3.0);
    let yy: f32 = clamp(12.0 * (share.yy / share.area - at.y * at.y), 0.0, 3.0);
    let most: f32 = sqrt(xx * yy);
    let xy: f32 = clamp(12.0 * (share.xy / share.area - at.x * at.y), -most, most);
    let root: f32 = sqrt(max(xx * yy - xy * xy, 0.0));
    let inverse: f32 = 1.0 / sqrt(max(xx + yy + 2.0 * root, VEXTURE_NOTHING));
    let right: vec2f = inverse * ((xx + root) * region.right + xy * region.up);
    let up: vec2f = inverse * (xy * region.right + (yy + root) * region.up);
    return VextureRegion(region.point + at.x * region.right + at.y * region.up, right, up);
}
#endif

// Adds the colours of the programs whose shares are summed; returns whether more programs are left.
fn vexture_settle(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, region: VextureRegion,
) -> bool {
#if VEXTURE_GRADIENTS
    var last: u32 = (*sum).done;
    for (var slot: i32 = 0; slot < 4; slot++) {
        let area: f32 = (*sum).areas[slot];
        if ((*sum).paints[slot] != 0u && abs(area) > VEXTURE_LEAST_SHARE) {
            var paint: u32 = (*sum).paints[slot];
            var share: VextureShare = VextureShare(area, (*sum).x[slot], (*sum).y[slot], (*sum).xx[slot],
                (*sum).xy[slot], (*sum).yy[slot]);
            if (abs(area - (*sum).cell) <= 1.0 - VEXTURE_NEARLY_WHOLE) {
                // it fills the cell: it is kept, and another program that was kept before runs
                let is_same: bool = paint == (*sum).kept;
                let before: VextureShare = (*sum).kept_share;
                (*sum).kept_share = vexture_plus_share(share, before, select(0.0, 1.0, is_same));
                let kept: u32 = select((*sum).kept, 0u, is_same);
                (*sum).kept = paint;
                paint = kept;
                share = before;
            }
            if (paint != 0u) {
                let words: vec2u = vexture_paint_words(vextureTexels, planar, paint);
                let color: vec4f = vexture_program(vextureTexels, words.x, words.y, vexture_part(region, share),
                    share.area);
                (*sum).color += share.area * vexture_averaged(color);
            }
        }
        last = max(last, (*sum).paints[slot]);
    }
    let is_left: bool = (*sum).is_left;
    (*sum).done = select(0u, last, is_left);
    (*sum).is_left = false;
    (*sum).paints = vec4u(0u);
    return is_left;
#else
    return false;
#endif
}

// Unpacks a stored mean, 0..255.
fn vexture_unpacked(word: u32) -> vec4f {
    return vexture_averaged(vec4f(vec4u(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u)));
}

// Mean colour of a quad near a point of its own unit square, like vexture_mean; 0..255.
fn vexture_mean_color(stored: vec4u, place: vec2f) -> vec4f {
    let at: vec2f = 2.0 * place - 0.5;
    let low: vec4f = mix(vexture_unpacked(stored.x), vexture_unpacked(stored.y), vec4f(at.x));
    let high: vec4f = mix(vexture_unpacked(stored.z), vexture_unpacked(stored.w), vec4f(at.x));
    return clamp(mix(low, high, vec4f(at.y)), vec4f(0.0), vec4f(f32(VEXTURE_COVERAGE_ONE)));
}

// The pieces of a planar map's leaf (FORMAT.md, D.2): one per texel, or two per texel if all are straight.
// Pieces that share a texel, or a texel of sides, cost one fetch if they are read one after the other.
// Exports: VextureLeaf, vexture_leaf, vexture_leaf_piece, vexture_leaf_sides.

struct VextureLeaf {
    first: u32,  // texel of its first piece
    number: u32,  // of that piece in the map
    is_straight: bool,
    at: u32,  // index of the texel of pieces that was read last,
    texel: vec4u,  // its content,
    sides_at: u32,  // and the same of sides
    sides: vec4u,
}

fn vexture_leaf(cell: VextureCell) -> VextureLeaf {
    let counts: u32 = (cell.texel.z >> u32(VEXTURE_COUNT_SHIFT)) & 0x0f0f0fu & ((1u << cell.shift) - 1u);
    let paired: u32 = (cell.texel.z & (u32(VEXTURE_STRAIGHT) * 0x010101u)) * u32(VEXTURE_MOST_CURVES);
    let texels: u32 = counts - ((counts >> 1u) & 0x070707u & paired);
    let first: u32 = cell.texel.y + (((texels * 0x010101u) >> 16u) & 255u);
    let number: u32 = cell.texel.w + (((counts * 0x010101u) >> 16u) & 255u);
    let is_straight: bool = ((cell.texel.z >> cell.shift) & u32(VEXTURE_STRAIGHT)) != 0u;
    return VextureLeaf(first, number, is_straight, 0u, vec4u(0u), 0u, vec4u(0u));
}

// Texel of a curve between two ends, with P1 and P2 nearest to the thirds of its chord.
fn vexture_straight(ends: vec2u) -> vec4u {
    let p0: vec2f = vexture_word(ends.x);
    let p3: vec2f = vexture_word(ends.y);
    let p1: vec2u = vec2u((2.0 * p0 + p3) / 3.0 + (f32(VEXTURE_CONTROL_OFFSET) + 0.5));  // a sixth away from whole numbers
    let p2: vec2u = vec2u((p0 + 2.0 * p3) / 3.0 + (f32(VEXTURE_CONTROL_OFFSET) + 0.5));
    let words: vec2u = vec2u(p1.x, p2.x) + (vec2u(p1.y, p2.y) << vec2u(u32(VEXTURE_COORDINATE_BITS)));
    return vec4u(ends.x, words, ends.y);
}

// Piece i of a leaf, as the texel of a curve.
fn vexture_leaf_piece(vextureTexels: texture_2d<u32>, leaf: ptr<function, VextureLeaf>, i: i32) -> vec4u {
    let at: u32 = (*leaf).first + u32(select(i, i >> 1u, (*leaf).is_straight));
    if (at != (*leaf).at) {
        (*leaf).at = at;
        (*leaf).texel = vexture_texel(vextureTexels, at);
    }
    return select((*leaf).texel, vexture_straight(select((*leaf).texel.zw, (*leaf).texel.xy, (i & 1) == 0)),
        (*leaf).is_straight);
}

// The paints on the left and on the right of piece i of a leaf.
fn vexture_leaf_sides(
    vextureTexels: texture_2d<u32>, leaf: ptr<function, VextureLeaf>, planar: VexturePlanar, i: i32,
) -> vec2u {
    let place: u32 = 2u * ((*leaf).number + u32(i));
    let at: u32 = planar.sides + (place >> (2u + planar.packing));
    if (at != (*leaf).sides_at) {
        (*leaf).sides_at = at;
        (*leaf).sides = vexture_texel(vextureTexels, at);
    }
    let left: u32 = (*leaf).sides[(place >> planar.packing) & 3u];
    let right: u32 = (*leaf).sides[((place + 1u) >> planar.packing) & 3u];
    return vec2u(vexture_numbered(planar, left, place), vexture_numbered(planar, right, place + 1u));
}

// Colour of a pixel from a planar map (FORMAT.md, part D): the mean of the map's colours over the pixel's footprint,
// premultiplied. In a cell it is the colour of the base paint, plus, for each piece, the jump in colour across the piece
// times the area on its right.
// Exports: vextureFlatColor, vextureColor.

fn vexture_leaf_kind(cell: VextureCell) -> u32 {
    return (cell.texel.z >> cell.shift) & ((1u << u32(VEXTURE_COUNT_SHIFT)) - 1u);
}

// Returns whether a paint in a leaf is a program.
fn vexture_holds_program(cell: VextureCell) -> bool {
#if VEXTURE_GRADIENTS
    return (vexture_leaf_kind(cell) & u32(VEXTURE_HOLDS_PROGRAM)) != 0u;
#else
    return false;
#endif
}

// Returns whether the mean of a leaf is read instead of its pieces: if the leaf has only a mean, or if one of its paints
// is a program and nearly all of the leaf lies in the footprint.
fn vexture_reads_mean(cell: VextureCell, share: f32) -> bool {
    let is_whole: bool = vexture_holds_program(cell) && share > VEXTURE_NEARLY_WHOLE;
    return is_whole || vexture_leaf_kind(cell) == u32(VEXTURE_IS_MEAN);
}

// Adds the stored mean of a cell, times its area; the mean of a quad near a point in its own unit square.
fn vexture_add_mean(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, cell: VextureCell,
    place: vec2f, area: f32,
) {
    let stored: vec4u = vexture_texel(vextureTexels, vexture_means_at(planar, cell.quad));
    var step: f32 = area * (f32(VEXTURE_PAINT_ONE) / f32(VEXTURE_COVERAGE_ONE));
#if VEXTURE_GRADIENTS
    step = select(0.0, step, (*sum).done == 0u);
#endif
    (*sum).color += step
        * select(vexture_unpacked(stored[cell.shift >> 3u]), vexture_mean_color(stored, place), cell.is_quad);
}

// Region of a pixel with these sides, in positions.
fn vexture_region(place: VexturePlace, right: vec2f, up: vec2f) -> VextureRegion {
    let unit: f32 = 1.0 / f32(1 << u32(VEXTURE_POSITION_BITS));
    return VextureRegion((vec2f(place.point) + place.rest) * unit, right * unit, up * unit);
}

// Like vexture_first_look, for a pixel with horizontal and vertical sides; ends on the leaf's left edge need no flag.
fn vexture_flat_look(texel: vec4u, box: VextureBox) -> VextureLook {
    let p0: vec2f = vexture_word(texel.x);
    let p3: vec2f = vexture_word(texel.w);
    let r0: vec2f = vexture_in_box(p0, box);
    let r3: vec2f = vexture_in_box(p3, box);
    let y0: f32 = clamp(r0.y, 0.0, 1.0);
    let y3: f32 = clamp(r3.y, 0.0, 1.0);
    var filled: f32 = vexture_above_ends(p0, p3, y0, y3);
    let right: f32 = max(r0.x, r3.x);
    filled += select(0.0, y0 - y3, right <= 0.0);
    let left: f32 = select(1.0, min(r0.x, r3.x), right > 0.0);
    return VextureLook(filled, false, left < 1.0 && y0 != y3);
}

// Share of the box that a piece fills, with its moments if a program needs them.
fn vexture_flat_filled_share(texel: vec4u, look: VextureLook, box: VextureBox, has_moments: bool) -> VextureShare {
#if VEXTURE_GRADIENTS
    if (has_moments) {
        var share: VextureShare = vexture_flat_ends_share(texel, look.crosses, box);
        if (look.crosses) {
            let piece: VexturePiece = vexture_piece(texel, box);
            share = vexture_plus_share(share, vexture_flat_piece_share(piece, vexture_ends(piece)), 1.0);
        }
        return share;
    }
#endif
    var area: f32 = look.filled;
    if (look.crosses) {
        let piece: VexturePiece = vexture_piece(texel, box);
        area += vexture_flat_piece_area(piece, vexture_ends(piece));
    }
    return vexture_area_share(area);
}

// Adds the colours of a leaf in the box, given the box's sides and centre in the pixel.
fn vexture_add_flat_leaf(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, cell: VextureCell,
    box: VextureBox, sides: vec2f, middle: vec2f,
) {
    var leaf: VextureLeaf = vexture_leaf(cell);
    let count: i32 = vexture_count(cell);
    var crossing: i32 = 0;  // a bit for each piece that is not clear of the box: others need no colours
    for (var i: i32 = 0; i < count; i++) {
        let look: VextureLook = vexture_flat_look(vexture_leaf_piece(vextureTexels, &leaf, i), box);
        crossing |= select(0, 1 << u32(i), look.crosses || look.filled != 0.0);
    }
    let has_moments: bool = vexture_holds_program(cell);
    let whole: VextureShare = vexture_moved_share(vexture_whole_share(), sides, middle);
    vexture_add_base(vextureTexels, sum, planar, vexture_base_paint(vextureTexels, planar, cell), whole);
    while (crossing != 0) {
        let lowest: i32 = crossing & -crossing;
        var i: i32 = (bitcast<i32>(f32(lowest)) >> 23u) - 127;
        crossing ^= lowest;
        let texel: vec4u = vexture_leaf_piece(vextureTexels, &leaf, i);
        let share: VextureShare = vexture_flat_filled_share(texel, vexture_flat_look(texel, box), box, has_moments);
        vexture_add_piece(vextureTexels, sum, planar, vexture_leaf_sides(vextureTexels, &leaf, planar, i),
            vexture_moved_share(share, sides, middle));
    }
}

// Adds the colour of the part of a cell in the box.
fn vexture_add_flat_cell(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, cell: VextureCell,
    box: VextureBox, view: VextureFlat,
) {
    let side: f32 = bitcast<f32>(u32(127 - cell.bit) << 23u);  // inverse
    if (cell.is_quad || vexture_reads_mean(cell, min(box.size.x, box.size.y) * side)) {
        let place: vec2f = (box.way + (box.part + 0.5) * box.size) * side;
        vexture_add_mean(vextureTexels, sum, planar, cell, place, box.size.x * box.size.y * view.inverse);
    } else {
        let across: vec2f = 0.5 / view.extent;
        vexture_add_flat_leaf(vextureTexels, sum, planar, cell, box, across * box.size, across
            * (box.low + 0.5 * box.size));
    }
}

// Clamps a premultiplied colour to its range; NaN becomes 0.
fn vexture_held(color: vec4f) -> vec4f {
    let alpha: f32 = select(0.0, min(color.a, 1.0), color.a > 0.0);
    return vec4f(select(vec3f(0.0), min(color.rgb, vec3f(alpha)), color.rgb > vec3f(0.0)), alpha);
}

// Parameters: the map's root quad, then as in vextureFlatCoverage.
fn vextureFlatColor(vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, view: VextureFlat) -> vec4f {
    let planar: VexturePlanar = vexture_planar(vextureTexels, root);
    let place: VexturePlace = vexture_place(base, offset, view.extent);
    let region: VextureRegion = vexture_region(place, vec2f(2.0 * view.extent.x, 0.0), vec2f(0.0, 2.0 * view.extent.y));
    var sum: VextureSum = vexture_nothing();
    var square: VextureSquare = vexture_first_square(place);
    let shared_bit: i32 = square.bit;
    var top: VextureTop = vexture_top(root);
    while (square.position.x < VEXTURE_NO_CELL || vexture_holds_kept(sum)) {
        let is_over: bool = vexture_holds_kept(sum) && square.position.x >= VEXTURE_NO_CELL;
        let cell: VextureCell = vexture_descend(vextureTexels, &top, shared_bit,
            select(view.finest, VEXTURE_NO_CELL, is_over), square.position);
        let origin: vec2i = square.position & vec2i(-(1 << u32(cell.bit)));
        var is_left: bool = true;
        while (is_left) {
            if (is_over) {
                vexture_add_kept(vextureTexels, &sum, planar);
            } else {
                vexture_add_flat_cell(vextureTexels, &sum, planar, cell,
                    vexture_box(origin, cell.bit, place, view.extent), view);
            }
            is_left = vexture_settle(vextureTexels, &sum, planar, region);
        }
        if (!is_over) {
            square = vexture_next_square(square.position, origin + (1 << u32(cell.bit)), place);
        }
    }
    return vexture_held(sum.color / f32(VEXTURE_PAINT_ONE));
}

// Like vexture_flat_filled_share, for any footprint; `whole` is its share in the cell.
fn vexture_filled_share(
    texel: vec4u, look: VextureLook, box: VextureBox, frame: VextureFrame, whole: VextureShare, has_moments: bool,
) -> VextureShare {
    var share: VextureShare = vexture_plus_share(vexture_area_share(0.0), whole, look.filled);
    if (look.crosses) {
        let piece: VexturePiece = vexture_piece(texel, box);
        let ends: VextureEnds = vexture_ends(piece);
#if VEXTURE_GRADIENTS
        if (has_moments) {
            return vexture_plus_share(share, vexture_piece_share(texel, look.turns, piece, ends, box, frame), 1.0);
        }
#endif
        share.area += vexture_piece_area(texel, look.turns, piece, ends, box, frame);
    }
    return share;
}

// Like vexture_add_flat_leaf, for any footprint.
fn vexture_add_leaf(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, cell: VextureCell,
    box: VextureBox, frame: VextureFrame, whole: VextureShare,
) {
    var leaf: VextureLeaf = vexture_leaf(cell);
    let count: i32 = select(0, vexture_count(cell), whole.area > 0.0);
    var crossing: i32 = 0;  // a bit for each piece that is not clear of the footprint's box: others need no colours
    for (var i: i32 = 0; i < count; i++) {
        let look: VextureLook = vexture_first_look(vexture_leaf_piece(vextureTexels, &leaf, i), box);
        crossing |= select(0, 1 << u32(i), look.crosses || look.filled != 0.0);
    }
    let has_moments: bool = vexture_holds_program(cell);
    vexture_add_base(vextureTexels, sum, planar, vexture_base_paint(vextureTexels, planar, cell), whole);
    while (crossing != 0) {
        let lowest: i32 = crossing & -crossing;
        var i: i32 = (bitcast<i32>(f32(lowest)) >> 23u) - 127;
        crossing ^= lowest;
        let texel: vec4u = vexture_leaf_piece(vextureTexels, &leaf, i);
        let look: VextureLook = vexture_first_look(texel, box);
        let share: VextureShare = vexture_filled_share(texel, look, box, frame, whole, has_moments);
        vexture_add_piece(vextureTexels, sum, planar, vexture_leaf_sides(vextureTexels, &leaf, planar, i), share);
    }
}

// Adds the colour of the part of a footprint in a cell, times its area.
fn vexture_add_cell(
    vextureTexels: texture_2d<u32>, sum: ptr<function, VextureSum>, planar: VexturePlanar, cell: VextureCell,
    box: VextureBox, frame: VextureFrame,
) {
    let is_cut: bool = any(box.low > -frame.extent) || any(box.low + box.size < frame.extent);
    var whole: VextureShare = vexture_whole_share();
    if (is_cut) {
#if VEXTURE_GRADIENTS
        whole = vexture_box_share(frame, box.low, box.size);
#else
        whole.area = vexture_box_area(frame, box.low, box.size);
#endif
    }
    let side: f32 = f32(1 << u32(cell.bit));
    if (cell.is_quad || vexture_reads_mean(cell, whole.area * frame.size / (side * side))) {
        vexture_add_mean(vextureTexels, sum, planar, cell,
            select(vec2f(0.5), vexture_cut_place(cell, box, frame), cell.is_quad), whole.area);
    } else {
        vexture_add_leaf(vextureTexels, sum, planar, cell, box, frame, whole);
    }
}

// Parameters: the map's root quad, then as in vextureCoverage.
fn vextureColor(vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, dx: vec2f, dy: vec2f) -> vec4f {
    let planar: VexturePlanar = vexture_planar(vextureTexels, root);
    let frame: VextureFrame = vexture_frame(dx, dy);
    let place: VexturePlace = vexture_place(base, offset, frame.extent);
    let finest: i32 = vexture_finest_bit(frame.size, frame.longer);
    let right: vec2f = vec2f(frame.up.y, -frame.up.x) * frame.size;
    let region: VextureRegion = vexture_region(place, right, vec2f(-frame.right.y, frame.right.x) * frame.size);
    var sum: VextureSum = vexture_nothing();
    var square: VextureSquare = vexture_first_square(place);
    let shared_bit: i32 = square.bit;
    var top: VextureTop = vexture_top(root);
    var beside: bool = false;
    while (square.position.x < VEXTURE_NO_CELL || vexture_holds_kept(sum)) {
        let is_over: bool = vexture_holds_kept(sum) && square.position.x >= VEXTURE_NO_CELL;
        var bit: i32 = square.bit;
        if (!beside) {
            let cell: VextureCell = vexture_descend(vextureTexels, &top, shared_bit,
                select(finest, VEXTURE_NO_CELL, is_over), square.position);
            bit = cell.bit;
            let origin: vec2i = square.position & vec2i(-(1 << u32(bit)));
            var is_left: bool = true;
            while (is_left) {
                if (is_over) {
                    vexture_add_kept(vextureTexels, &sum, planar);
                } else {
                    vexture_add_cell(vextureTexels, &sum, planar, cell, vexture_box(origin, bit, place, frame.extent),
                        frame);
                }
                is_left = vexture_settle(vextureTexels, &sum, planar, region);
            }
        }
        let side: i32 = 1 << u32(bit);
        beside = false;
        if (!is_over) {
            square = vexture_next_square(square.position, (square.position & vec2i(-side)) + side, place);
            beside = square.position.x < VEXTURE_NO_CELL && vexture_is_beside(square, place, frame);
        }
    }
    return vexture_held(sum.color / f32(VEXTURE_PAINT_ONE));
}

// Planar maps, and drawings of several sheets: maps and layers, the lowest first, composited.
// Exports: vextureWrappedColor, vextureSheets, vextureSheetCoverage, vextureLight.
//
// With VEXTURE_LINEAR, all colours in this file are linear; those of vextureLight always are.

fn vexture_color_at(vextureTexels: texture_2d<u32>, root: u32, spot: VextureSpot) -> vec4f {
#if VEXTURE_FLAT
    return vextureFlatColor(vextureTexels, root, spot.base, spot.offset, vextureFlat(spot.dx, spot.dy));
#else
    return vextureColor(vextureTexels, root, spot.base, spot.offset, spot.dx, spot.dy);
#endif
}

// Stored mean of the whole square.
fn vexture_whole_color(vextureTexels: texture_2d<u32>, root: u32) -> vec4f {
    let means: vec4u = vexture_texel(vextureTexels, vexture_means_at(vexture_planar(vextureTexels, root), root));
    return vexture_mean_color(means, vec2f(0.5)) / f32(VEXTURE_COVERAGE_ONE);
}

// Like vexture_spot_coverage, for a planar map.
fn vexture_spot_color(vextureTexels: texture_2d<u32>, root: u32, spot: VextureSpot) -> vec4f {
#if VEXTURE_WRAP == VEXTURE_WRAP_REPEAT
    let tiles: VextureTiles = vexture_tiles(spot);
    var sum: vec4f = vec4f(0.0);
    for (var tile: i32 = 0; tile < tiles.count; tile++) {
        sum += vexture_color_at(vextureTexels, root, vexture_tile(tiles, spot, tile));
    }
    return mix(vexture_held(sum), vexture_whole_color(vextureTexels, root), vec4f(tiles.whole));
#else
    return vexture_color_at(vextureTexels, root, spot);
#endif
}

// Colour of a pixel of one map, premultiplied. Parameters: its root quad, then those of vextureColor; the position may lie
// anywhere.
fn vextureWrappedColorFrom(
    vextureTexels: texture_2d<u32>, root: u32, base: vec2u, offset: vec2f, dx: vec2f, dy: vec2f,
) -> vec4f {
    return vexture_spot_color(vextureTexels, root, vexture_spot(base, offset, dx, dy));
}

fn vextureWrappedColor(vextureTexels: texture_2d<u32>, root: u32, uv: vec2f, dx: vec2f, dy: vec2f) -> vec4f {
    return vextureWrappedColorFrom(vextureTexels, root, vec2u(0u), uv, dx, dy);
}

// Colour of one sheet.
fn vexture_sheet_color(vextureTexels: texture_2d<u32>, head: vec4u, spot: VextureSpot) -> vec4f {
    if (head.w != 0u) {
        return vexture_spot_color(vextureTexels, head.x, spot);
    }
    var paint: vec4f = vexture_layer_paint(head);
#if VEXTURE_LINEAR
    paint = vec4f(vexture_linear(paint.rgb), paint.a);
#endif
    return paint.a * vexture_spot_coverage(vextureTexels, head.x, spot) * vec4f(paint.rgb, 1.0);
}

// Like vextureLayers, for layers and maps.
fn vextureSheetsFrom(
    vextureTexels: texture_2d<u32>, vexturePaints: texture_2d<u32>, first: i32, count: i32, base: vec2u, offset: vec2f,
    dx: vec2f, dy: vec2f,
) -> vec4f {
    let spot: VextureSpot = vexture_spot(base, offset, dx, dy);
    var color: vec4f = vec4f(0.0);
    var layer: i32 = vexture_layer_below(vexturePaints, first + count, first, spot);
    while (layer >= first && color.a < VEXTURE_COVERED) {
        color += (1.0 - color.a)
            * vexture_sheet_color(vextureTexels, textureLoad(vexturePaints, vec2i(0, layer), 0), spot);
        layer = vexture_layer_below(vexturePaints, layer, first, spot);
    }
    return color;
}

fn vextureSheets(
    vextureTexels: texture_2d<u32>, vexturePaints: texture_2d<u32>, first: i32, count: i32, uv: vec2f, dx: vec2f,
    dy: vec2f,
) -> vec4f {
    return vextureSheetsFrom(vextureTexels, vexturePaints, first, count, vec2u(0u), uv, dx, dy);
}

// Coverage by one root, given by its number in the texture: a map's opacity, or a layer's area without its paint.
fn vextureSheetCoverage(
    vextureTexels: texture_2d<u32>, vexturePaints: texture_2d<u32>, root: u32, uv: vec2f, dx: vec2f, dy: vec2f,
) -> f32 {
    let spot: VextureSpot = vexture_spot(vec2u(0u), uv, dx, dy);
    let head: vec4u = textureLoad(vexturePaints, vec2i(0, i32(root)), 0);
    if (head.w != 0u) {
        return vexture_spot_color(vextureTexels, head.x, spot).a;
    }
    return vexture_spot_coverage(vextureTexels, head.x, spot);
}

// From the colours of this file, premultiplied, to straight linear components.
fn vextureLight(color: vec4f) -> vec4f {
#if VEXTURE_LINEAR
    return vec4f(color.rgb / max(color.a, exp2(-24.0)), color.a);
#else
    return vextureStraight(color);
#endif
}
