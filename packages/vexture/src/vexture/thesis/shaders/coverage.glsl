// Coverage of a pixel by the shape in a pair of textures.
// Exports: coverage.
#include "cells.glsl"

// Mean of SAMPLES x SAMPLES points of a pixel (thesis 4.4.3), one in each of as many equal squares.
//
// The thesis's grid is parallel to the pixels, so that a vertical or horizontal edge passes four points at once, with an
// error of up to 32/255. This grid is turned (spanned by (4, -1)/16 and (1, 4)/16): such an edge passes one at a time.
//
// A point outside the cell of the previous one is looked up again. The thesis evaluates all points with the curve of the
// pixel's centre, even beyond its cell, and thereby draws lines along its cells (thesis 6.3).
//
// Parameters: the pixel's centre in the unit square, and the steps to the next pixels (dFdx, dFdy), taken in uniform
// control flow.
float coverage(sampler2D quads, sampler2D curves, vec2 center, vec2 dx, vec2 dy) {
    float footprint = max(length(dx), length(dy));
    vec2 reach = 0.5 * (abs(dx) + abs(dy));
    Cell cell = find_cell(quads, curves, center, footprint);
    if (cell_contains(cell, center - reach, center + reach)) {
        if (cell.shape == CONSTANT) {
            return cell.value;
        }
        float y = cell_point(cell, center).y;
        float spread = 0.5 * (abs(change_basis(cell.along, dx).y) + abs(change_basis(cell.along, dy).y)) / cell.size;
        if (y - spread >= cell.heights.y || y + spread < cell.heights.x) {  // the pixel is clear of the outline
            return y < cell.heights.x ? 1.0 : 0.0;
        }
    }
    float sum = 0.0;
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        int row = i / SAMPLES;
        int column = row % 2 == 0 ? i % SAMPLES : SAMPLES - 1 - i % SAMPLES;  // back and forth: few steps leave a cell
        vec2 turned = (vec2(row, SAMPLES - 1 - column) + 0.5) / float(SAMPLES);
        vec2 offset = (vec2(column, row) + turned) / float(SAMPLES) - 0.5;
        vec2 point = center + offset.x * dx + offset.y * dy;
        if (!cell_contains(cell, point, point)) {
            cell = find_cell(quads, curves, point, footprint);
        }
        sum += cell_value(cell, point);
    }
    return sum / float(SAMPLES * SAMPLES);
}
