const VEXTURE_BEND: f32 = 20.0;
const VEXTURE_CLOSE: f32 = 0.02;
const VEXTURE_CONTROL_OFFSET: i32 = 16384;
const VEXTURE_COORDINATE_BITS: i32 = 16;
const VEXTURE_COUNT_SHIFT: i32 = 3;
const VEXTURE_COVERAGE_ONE: i32 = 255;
const VEXTURE_DRAWN: f32 = 0.7;
const VEXTURE_FARTHEST: f32 = 3.0;
const VEXTURE_FOLLOWED_QUADS: i32 = 256;
const VEXTURE_FURTHER: i32 = 2;
const VEXTURE_LATTICE_BITS: i32 = 15;
const VEXTURE_LEAST_FINEST: i32 = 4;
const VEXTURE_LEVEL_BIAS: f32 = 0.00390625;
const VEXTURE_LONG: f32 = 0.00390625;
const VEXTURE_MOST_CURVES: i32 = 15;
const VEXTURE_MOST_DEPTH: i32 = 20;
const VEXTURE_MOST_PARTS: f32 = 8.0;
const VEXTURE_NO_CELL: i32 = 1073741824;
const VEXTURE_NO_SIZE: f32 = 1.52587890625e-05;
const VEXTURE_POSITION_BITS: i32 = 28;
const VEXTURE_QUAD_FLAG: i32 = 128;
const VEXTURE_REST_BITS: i32 = 4;
const VEXTURE_ROW_BITS: i32 = 11;
const VEXTURE_SHORT_WAY: f32 = 0.0009765625;
const VEXTURE_SMALLEST_BOX: f32 = 9.5367431640625e-07;
const VEXTURE_SMALLEST_PIXEL: f32 = 9.094947017729282e-13;
const VEXTURE_SMALL_FINEST: i32 = 8;
const VEXTURE_STEPS: i32 = 6;
const VEXTURE_THINNEST_PIXEL: f32 = 0.015625;
const VEXTURE_WINDING_OFFSET: i32 = 4;
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
