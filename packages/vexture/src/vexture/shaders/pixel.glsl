// The pixel's footprint: a parallelogram, and the frame in which it is the square from -1/2 to 1/2.
// Exports: VextureFrame, vexture_frame, vexture_into_frame, vexture_slopes, vexture_beside, vexture_box_area.

// Lengths are in positions.
struct VextureFrame {
    vec2 right;   // rows of the matrix from the drawing's plane to the frame
    vec2 up;
    vec2 extent;  // half the footprint's box
    float size;   // the footprint's area,
    float longer; // and the square of its longer side
};

VextureFrame vexture_frame(vec2 dx, vec2 dy) {
    dx *= float(1 << VEXTURE_POSITION_BITS);
    dy *= float(1 << VEXTURE_POSITION_BITS);
    float smallest = VEXTURE_SMALLEST_PIXEL * float(1 << VEXTURE_POSITION_BITS);
    float longer = max(dot(dx, dx), dot(dy, dy));
    float area = dx.x * dy.y - dx.y * dy.x;
    bool exists = longer > smallest * smallest;  // false if a parameter is NaN
    if (!exists || abs(area) < VEXTURE_THINNEST_PIXEL * longer) {  // the plane is seen from its edge
        float width = exists ? VEXTURE_THINNEST_PIXEL : 1.0;
        dx = dot(dx, dx) == longer ? dx : dy;
        dx = exists ? dx : vec2(smallest, 0.0);
        dy = vec2(-dx.y, dx.x) * width;
        longer = dot(dx, dx);
        area = width * longer;
    }
    vec2 right = vec2(dy.y, -dy.x) / area;
    vec2 up = vec2(-dx.y, dx.x) / abs(area);  // the frame never mirrors the plane
    return VextureFrame(right, up, 0.5 * (abs(dx) + abs(dy)), abs(area), longer);
}

vec2 vexture_into_frame(VextureFrame frame, vec2 point) {
    return vec2(dot(frame.right, point), dot(frame.up, point));
}

// Slopes dx / dy and dy / dx of a direction; 0 in place of infinity.
vec2 vexture_slopes(float dx, float dy) {
    return vec2(dy != 0.0 ? dx / dy : 0.0, dx != 0.0 ? dy / dx : 0.0);
}

// Integral of clamp(u, 0, 1).
float vexture_ramp(float u) {
    float held = clamp(u, 0.0, 1.0);
    return held * (u - 0.5 * held);
}

// Area of the pixel on the right of a straight line from p to a height, both in the frame, with the `vexture_slopes` of
// its direction; negative if the line goes up.
float vexture_beside_sloped(vec2 p, float end, vec2 slopes) {
    float y0 = clamp(p.y, -0.5, 0.5);
    float y1 = clamp(end, -0.5, 0.5);
    float u0 = 0.5 - p.x - (y0 - p.y) * slopes.x;
    float u1 = 0.5 - p.x - (y1 - p.y) * slopes.x;
    float steep = (y0 - y1) * clamp(0.5 * (u0 + u1), 0.0, 1.0);
    return abs(u1 - u0) < VEXTURE_SHORT_WAY ? steep : (vexture_ramp(u1) - vexture_ramp(u0)) * slopes.y;
}

float vexture_beside(vec2 p, vec2 q) {
    return vexture_beside_sloped(p, q.y, vexture_slopes(q.x - p.x, q.y - p.y));
}

// Approximate fraction of a straight line that lies in the pixel; the factor that it scales is small.
float vexture_part_inside(vec2 p, vec2 q) {
    vec2 way = q - p;
    vec2 held = clamp(q, -0.5, 0.5) - clamp(p, -0.5, 0.5);
    float x = way.x != 0.0 ? held.x / way.x : abs(p.x) < 0.5 ? 1.0 : 0.0;
    float y = way.y != 0.0 ? held.y / way.y : abs(p.y) < 0.5 ? 1.0 : 0.0;
    return x * y;
}

// Area of the pixel in a box.
float vexture_box_area(VextureFrame frame, vec2 low, vec2 size) {
    vec2 level = vexture_slopes(frame.right.x, frame.up.x);
    vec2 upright = vexture_slopes(frame.right.y, frame.up.y);
    vec2 p = vexture_into_frame(frame, low);
    vec2 q = p + vec2(frame.right.x, frame.up.x) * size.x;
    vec2 r = q + vec2(frame.right.y, frame.up.y) * size.y;
    vec2 s = p + vec2(frame.right.y, frame.up.y) * size.y;
    return vexture_beside_sloped(p, q.y, level) + vexture_beside_sloped(q, r.y, upright)
        + vexture_beside_sloped(r, s.y, level) + vexture_beside_sloped(s, p.y, upright);
}
