// Reading the pair of textures (FORMAT.md, part A): the leaf at a point.
// Exports: Cell, find_cell, cell_contains, cell_point, cell_value.
#include "inside.glsl"

uniform ivec2 list_lengths;  // rows of quads and of curves

// A leaf, or as a constant a quad smaller than a pixel.
struct Cell {
    vec2 origin;  // lower left corner
    float size;   // length of its side
    int shape;    // CONSTANT, CURVE or CORNER
    float value;  // coverage of a constant
    vec2 start;   // P0 in the cell's own square
    vec2 along;   // basis of the chord (change_basis), for p1, p2 and heights
    vec2 p1;      // P1 or the corner
    vec2 p2;      // P2
    vec2 heights; // bounds of the outline's height
};

Cell constant_cell(vec2 origin, float size, float value) {
    return Cell(origin, size, CONSTANT, value, vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0));
}

// A list longer than the height of the device's textures continues in the columns to its right.
vec4 fetch(sampler2D list, int width, int row, int column) {
    return texelFetch(list, ivec2(row / FOLD_HEIGHT * width + column, row % FOLD_HEIGHT), 0);
}

// Point at a position on the cell's edge (thesis, Table 4.1).
vec2 edge_point(float edge) {
    float s = 4.0 * edge;
    return s < 1.0 ? vec2(s, 1.0) : s < 2.0 ? vec2(1.0, 2.0 - s) : s < 3.0 ? vec2(3.0 - s, 0.0) : vec2(0.0, s - 3.0);
}

// P3. An outline that ends where it starts has no chord; its P3 moves by a short step along the edge, clockwise if the
// outline turns counter-clockwise.
vec2 end_point(float edge0, float edge3, vec2 p1, vec2 p2) {
    if (edge0 != edge3) {
        return edge_point(edge3);
    }
    vec2 a = p1 - edge_point(edge0);
    vec2 b = p2 - edge_point(edge0);
    return edge_point(fract(edge0 + (a.x * b.y > a.y * b.x ? SHORTEST_CHORD : 1.0 - SHORTEST_CHORD)));
}

Cell read_leaf(sampler2D curves, vec2 origin, float size, int shape, int row) {
    vec4 left = fetch(curves, CURVE_WIDTH, row, 0);
    vec4 right = fetch(curves, CURVE_WIDTH, row, 1);
    vec2 p1 = vec2(left.g, right.g);
    vec2 p2 = p1;
    if (shape == CURVE) {
        p1 = mix(vec2(CONTROL_MIN), vec2(CONTROL_MAX), p1);
        p2 = mix(vec2(CONTROL_MIN), vec2(CONTROL_MAX), vec2(left.b, right.b));
    }
    vec2 start = edge_point(left.r);
    vec2 chord = end_point(left.r, right.r, p1, p2) - start;
    vec2 along = chord / dot(chord, chord);
    p1 = change_basis(along, p1 - start);
    p2 = change_basis(along, p2 - start);
    // the sum of the weights of P1 and P2 is at most 3/4
    vec2 heights = (shape == CURVE ? 0.75 : 1.0) * vec2(min(0.0, min(p1.y, p2.y)), max(0.0, max(p1.y, p2.y)));
    return Cell(origin, size, shape, 0.0, start, along, p1, p2, heights);
}

bool outside_square(vec2 point) {
    return any(lessThan(point, vec2(0.0))) || any(greaterThanEqual(point, vec2(1.0)));
}

// Descends the tree (thesis 3.4, 4.4.2) to quads that are no smaller than a pixel (4.4.3).
Cell find_cell(sampler2D quads, sampler2D curves, vec2 point, float footprint) {
    vec2 origin = vec2(0.0);
    float size = 1.0;
    int row = 0;
    if (outside_square(point)) {
        return constant_cell(origin, 0.0, 0.0);
    }
    for (int level = 0; level < LEVELS; level++) {
        vec2 middle = origin + 0.5 * size;
        ivec2 upper = ivec2(greaterThanEqual(point, middle));
        vec4 texel = fetch(quads, QUAD_WIDTH, row, CELL_ORDER[upper.x + 2 * upper.y]);
        if (footprint > size) {  // the thesis's footprint * 2^depth > 1
            return constant_cell(origin, size, texel.b);
        }
        size *= 0.5;
        origin += size * vec2(upper);
        if (texel.r > THRESHOLD_QUAD) {
            row = int(texel.g * float(list_lengths.x - 1) + 0.5);
            continue;
        }
        row = int(texel.g * float(list_lengths.y - 1) + 0.5);
        if (row < CONSTANT_ROWS) {
            return constant_cell(origin, size, row == FULL_ROW ? 1.0 : 0.0);
        }
        return read_leaf(curves, origin, size, texel.r > THRESHOLD_CORNER ? CORNER : CURVE, row);
    }
    return constant_cell(origin, size, 0.0);  // deeper than the texture's stated depth
}

bool cell_contains(Cell cell, vec2 low, vec2 high) {
    return all(greaterThanEqual(low, cell.origin)) && all(lessThan(high, cell.origin + cell.size));
}

// A point in the basis of the cell's chord.
vec2 cell_point(Cell cell, vec2 point) {
    return change_basis(cell.along, (point - cell.origin) / cell.size - cell.start);
}

float cell_value(Cell cell, vec2 point) {
    if (cell.shape == CONSTANT) {
        return cell.value;
    }
    vec2 c = cell_point(cell, point);
    if (c.y >= cell.heights.y || c.y < cell.heights.x) {
        return c.y < cell.heights.x ? 1.0 : 0.0;
    }
    return (cell.shape == CURVE ? inside_curve(cell.p1, cell.p2, c) : inside_corner(cell.p1, c)) ? 1.0 : 0.0;
}
