// The pixel's footprint: a parallelogram, and the frame in which it is the square from -1/2 to 1/2.
// Exports: VextureFrame, vexture_frame, vexture_into_frame, vexture_beside, vexture_box_area.
//
// exact: the footprint is the parallelogram that dx and dy span.
// fast: one with two horizontal sides and the same second moments. In its frame the heights of the drawing are those of
// the pixel, so that nothing is due for horizontal lines.

struct VextureFrame {
    vec2 right;   // its rows: from the drawing's plane to the frame
    vec2 up;
    vec2 reach;   // half the footprint's box
    float turned; // 1 or -1: whether the frame keeps orientation
    float size;    // the footprint's area
};

VextureFrame vexture_frame(vec2 dx, vec2 dy) {
    float larger = max(dot(dx, dx), dot(dy, dy));
    if (!(larger > VEXTURE_SMALLEST_PIXEL * VEXTURE_SMALLEST_PIXEL)) {
        dx = vec2(VEXTURE_SMALLEST_PIXEL, 0.0);
        dy = vec2(0.0, VEXTURE_SMALLEST_PIXEL);
        larger = dot(dx, dx);
    }
    float area = dx.x * dy.y - dx.y * dy.x;
    if (abs(area) < VEXTURE_THINNEST_PIXEL * larger) {  // a line, seen from its edge
        dx = dot(dx, dx) == larger ? dx : dy;
        dy = vec2(-dx.y, dx.x) * VEXTURE_THINNEST_PIXEL;
        area = VEXTURE_THINNEST_PIXEL * larger;
    }
#if VEXTURE_QUALITY == VEXTURE_EXACT
    vec2 reach = 0.5 * (abs(dx) + abs(dy));
    float shrink = 1.0 / area;
    return VextureFrame(vec2(dy.y, -dy.x) * shrink, vec2(-dx.y, dx.x) * shrink, reach, sign(area), abs(area));
#else
    float square = max(dx.y * dx.y + dy.y * dy.y, VEXTURE_THINNEST_PIXEL * VEXTURE_THINNEST_PIXEL * larger);
    float up = inversesqrt(square);
    float height = square * up;
    float width = abs(area) * up;
    float right = 1.0 / width;
    float lean = (dx.x * dx.y + dy.x * dy.y) * up;
    vec2 reach = 0.5 * vec2(width + abs(lean), height);
    return VextureFrame(vec2(right, -lean * up * right), vec2(0.0, up), reach, 1.0, abs(area));
#endif
}

vec2 vexture_into_frame(VextureFrame frame, vec2 point) {
    return vec2(dot(frame.right, point), dot(frame.up, point));
}

// Integral of clamp(u, 0, 1).
float vexture_ramp(float u) {
    float held = clamp(u, 0.0, 1.0);
    return held * (u - 0.5 * held);
}

// Mean of clamp(u, 0, 1) while u runs from one value to another.
float vexture_mean_clamped(float u0, float u1) {
    float way = u1 - u0;
    bool short_way = abs(way) < VEXTURE_SHORT_WAY;
    float mean = (vexture_ramp(u1) - vexture_ramp(u0)) / (short_way ? 1.0 : way);
    return short_way ? clamp(0.5 * (u0 + u1), 0.0, 1.0) : mean;
}

// Area of the pixel on the right of a straight line from p to q, both in the frame; negative if the line goes up.
float vexture_beside(vec2 p, vec2 q) {
    float y0 = clamp(p.y, -0.5, 0.5);
    float y1 = clamp(q.y, -0.5, 0.5);
    float rise = q.y - p.y;
    float slope = rise != 0.0 ? (q.x - p.x) / rise : 0.0;
    float u0 = 0.5 - p.x - (y0 - p.y) * slope;
    float u1 = 0.5 - p.x - (y1 - p.y) * slope;
    return (y0 - y1) * vexture_mean_clamped(u0, u1);
}

// Part of a straight line that lies in the pixel, by and large: what it is multiplied with is small.
float vexture_part_inside(vec2 p, vec2 q) {
    vec2 way = q - p;
    vec2 held = clamp(q, -0.5, 0.5) - clamp(p, -0.5, 0.5);
    float x = abs(way.x) > 0.0 ? held.x / way.x : 1.0;
    float y = abs(way.y) > 0.0 ? held.y / way.y : 1.0;
    return x * y;
}

// Area of the pixel in a box, positive where the frame keeps orientation.
float vexture_box_area(VextureFrame frame, vec2 low, vec2 high) {
    vec2 p = vexture_into_frame(frame, low);
    vec2 q = vexture_into_frame(frame, vec2(high.x, low.y));
    vec2 r = vexture_into_frame(frame, high);
    vec2 s = vexture_into_frame(frame, vec2(low.x, high.y));
    float area = vexture_beside(q, r) + vexture_beside(s, p);
#if VEXTURE_QUALITY == VEXTURE_EXACT
    area += vexture_beside(p, q) + vexture_beside(r, s);
#endif
    return area;
}
