// One triangle that covers the whole image.
// Exports: covering_triangle.

vec4 covering_triangle(int vertex) {
    return vec4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
