// Test whether a point is inside the curve or corner of a cell.
// Exports: change_basis, inside_curve, inside_corner.
//
// Points are in the basis of the chord: P0 = (0, 0), P3 = (1, 0) (thesis 3.2), where the filled side, on the right from P0
// to P3, is below. The straight rays y = 0 before P0 and beyond P3 extend the outline; they lie outside the cell, because
// the chord lies inside. One rule holds for all curves, including loops and swirls: a point is inside if the outline
// crosses the vertical line through it an odd number of times above it.
//
// In total the outline crosses that line an odd number of times, because it comes from one side and leaves on the other.
// So if the curve itself crosses an even number of times, a ray counts as one more crossing, at height 0. The rule does
// not depend on C.x. It therefore also corrects a root that rounding lost or doubled at an end, where the curve's height
// is 0 too.
#include "cubic.glsl"

// Coordinates of an offset from P0; `along` is (P3 - P0) / |P3 - P0|^2.
vec2 change_basis(vec2 along, vec2 offset) {
    return vec2(dot(along, offset), along.x * offset.y - along.y * offset.x);
}

// Equation 3.2.
float height(float y1, float y2, float t) {
    return 3.0 * (1.0 - t) * t * ((1.0 - t) * y1 + t * y2);
}

bool inside_curve(vec2 p1, vec2 p2, vec2 point) {
    Roots roots = solve_cubic(3.0 * (p1.x - p2.x) + 1.0, 3.0 * p2.x - 6.0 * p1.x, 3.0 * p1.x, -point.x);
    int crossings = 0;
    int above = 0;
    for (int k = 0; k < roots.found; k++) {
        float t = roots.t[k];
        if (t >= 0.0 && t <= 1.0) {
            crossings++;
            above += height(p1.y, p2.y, t) > point.y ? 1 : 0;
        }
    }
    if (crossings % 2 == 0 && point.y < 0.0) {
        above++;
    }
    return above % 2 == 1;
}

// The same rule for the straight lines from P0 to the corner and on to P3 (thesis 6.1.2).
bool inside_corner(vec2 corner, vec2 point) {
    bool after_start = point.x >= 0.0;
    bool after_corner = point.x >= corner.x;
    bool after_end = point.x >= 1.0;
    bool inside = point.y < 0.0 && after_start == after_end;
    if (after_start != after_corner && point.y < corner.y * point.x / corner.x) {
        inside = !inside;
    }
    if (after_corner != after_end && point.y < corner.y * (1.0 - point.x) / (1.0 - corner.x)) {
        inside = !inside;
    }
    return inside;
}
