// A piece of outline in a box: the part of a cell that lies in the box around a pixel's footprint. In the box's own
// coordinates it is the unit square.
// Exports: VextureBox, VexturePiece, VextureEnds, vexture_box, vexture_piece, vexture_ends, vexture_bulge, vexture_mean.
#include "tree.glsl"

struct VextureBox {
    float unit;  // of the cell's lattice, in positions
    vec2 way;    // from the cell's origin to the pixel's point, in positions;
    vec2 part;   // from there to the box's low corner, in its sides: one float cannot hold both
    vec2 low;    // that corner relative to the pixel's centre, in positions
    vec2 size;   // in positions
};

// A piece, monotone in x and y. Falling coordinates are mirrored in the box, so that both rise.
struct VexturePiece {
    vec2 a;  // coefficients of t^3, t^2, t and 1
    vec2 b;
    vec2 c;
    vec2 d;
    vec2 way;  // from its begin to its end
    bvec2 falls;
};

// Points where a piece enters and leaves the box.
struct VextureEnds {
    float start;  // t
    float end;
    vec2 enter;
    vec2 leave;
};

// Part of a cell in the footprint's box, which extends by `extent` from the pixel's centre.
VextureBox vexture_box(ivec2 origin, int bit, VexturePlace place, vec2 extent) {
    vec2 way = vec2(place.point - origin);
    vec2 low = max(-way - place.rest, -extent);
    vec2 high = min((float(1 << bit) - way) - place.rest, extent);
    vec2 size = max(high - low, VEXTURE_SMALLEST_BOX);
    float unit = uintBitsToFloat(uint(127 - VEXTURE_LATTICE_BITS + bit) << 23);
    return VextureBox(unit, way, (place.rest + low) / size, low, size);
}

vec2 vexture_word(uint word) {
    return vec2(ivec2(int(word & 0xffffu), int(word >> VEXTURE_COORDINATE_BITS)));
}

vec2 vexture_in_box(vec2 point, VextureBox box) {
    return (point * box.unit - box.way) / box.size - box.part;
}

VexturePiece vexture_piece(uvec4 texel, VextureBox box) {
    vec2 p0 = vexture_word(texel.x);
    vec2 p1 = vexture_word(texel.y);
    vec2 p2 = vexture_word(texel.z);
    vec2 way = vexture_word(texel.w) - p0;
    bvec2 falls = lessThan(way, vec2(0.0));
    vec2 sides = box.unit / box.size;
    vec2 rising = 3.0 * vec2(falls.x ? -sides.x : sides.x, falls.y ? -sides.y : sides.y);
    vec2 d = vexture_in_box(p0, box);
    d = vec2(falls.x ? 1.0 - d.x : d.x, falls.y ? 1.0 - d.y : d.y);
    vec2 c = (p1 - p0 - float(VEXTURE_CONTROL_OFFSET)) * rising;
    vec2 b = (p2 - p1) * rising - c;
    way = abs(way) * sides;
    return VexturePiece(way - c - b, b, c, d, way, falls);
}

vec2 vexture_at(VexturePiece piece, float t) {
    return clamp(((piece.a * t + piece.b) * t + piece.c) * t + piece.d, 0.0, 1.0);
}

vec2 vexture_slope(VexturePiece piece, float t) {
    return (3.0 * piece.a * t + 2.0 * piece.b) * t + piece.c;
}

// A Laguerre step, worth several Newton steps near a turning point, towards the t at which each coordinate is `side`. At a
// flat inflection there is no slope to follow: the step, which never has to be longer than 1, then goes to an end.
vec2 vexture_better_t(VexturePiece piece, float side, vec2 t) {
    vec2 q = piece.a * t;
    vec2 bend = 3.0 * q + piece.b;  // half the second derivative
    vec2 error = 3.0 * (((q + piece.b) * t + piece.c) * t + (piece.d - side));
    vec2 slope = (bend + piece.b) * t + piece.c;
    vec2 divisor = slope + 2.0 * sqrt(abs(slope * slope - error * bend));
    return clamp(t - error / max(divisor, max(abs(error), VEXTURE_NO_SIZE)), 0.0, 1.0);
}

// The coordinate that passes the box's low sides last decides where the piece enters, and the one that passes a high side
// first, where it leaves. It becomes exactly the side's, because one step of t may be a large part of a small pixel. A piece
// that misses the box passes a corner of it: there it enters and leaves.
VextureEnds vexture_ends(VexturePiece piece) {
    vec2 inverse = 1.0 / max(piece.way, VEXTURE_NO_SIZE);
    vec2 t0 = clamp(-piece.d * inverse, 0.0, 1.0);
    vec2 t1 = clamp(inverse - piece.d * inverse, 0.0, 1.0);
    float close = VEXTURE_CLOSE * min(inverse.x, inverse.y);
    int steps = VEXTURE_STEPS;
    while (steps > 0) {
        vec2 better0 = vexture_better_t(piece, 0.0, t0);
        vec2 better1 = vexture_better_t(piece, 1.0, t1);
        vec2 moved = max(abs(better0 - t0), abs(better1 - t1));
        t0 = better0;
        t1 = better1;
        steps = max(moved.x, moved.y) > close ? steps - 1 : 0;
    }
    float start = max(t0.x, t0.y);
    float end = max(min(t1.x, t1.y), start);
    vec2 enter = vexture_at(piece, start);
    vec2 leave = vexture_at(piece, end);
    enter = vec2(t0.x > t0.y ? 0.0 : enter.x, t0.y > t0.x ? 0.0 : enter.y);
    leave = vec2(t1.x < t1.y ? 1.0 : leave.x, t1.y < t1.x ? 1.0 : leave.y);
    return VextureEnds(start, end, enter, leave);
}

float vexture_cross(vec2 p, vec2 q) {
    return p.x * q.y - p.y * q.x;
}

// Area between a part of a piece and its chord, positive where the piece lies on the right of a chord upwards. Parameters:
// a third of the part's interval of t, and the derivatives at its ends.
float vexture_bulge(float third, vec2 first, vec2 last, vec2 chord) {
    return 0.15 * third * (2.0 * vexture_cross(first - last, chord) - third * vexture_cross(first, last));
}

// Mean of a quad near a point of its own unit square: the value of the bilinear function whose means over the four cells
// are the stored coverages.
float vexture_mean(uint stored, vec2 place) {
    vec4 cells = vec4(ivec4(stored & 255u, (stored >> 8) & 255u, (stored >> 16) & 255u, stored >> 24));
    vec2 at = 2.0 * place - 0.5;
    vec2 rows = mix(cells.xz, cells.yw, at.x);
    return clamp(mix(rows.x, rows.y, at.y) / float(VEXTURE_COVERAGE_ONE), 0.0, 1.0);
}
