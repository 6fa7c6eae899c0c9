// Roots of a t^3 + b t^2 + c t + d by the solution paths of thesis Figure 3.5, equations 3.3 to 3.12.
// Exports: Roots, solution_path, solve_cubic.
//
// In float32 the equations as printed cause speckles where one path borders on another. Countermeasures:
// - The discriminant is evaluated in its direct form, because the thesis's (Delta_1^2 - 4 Delta_0^3) / (-27 a^2)
//   cancels where a is small; and about the inflection, because near a triple root every form cancels elsewhere.
//   A shift of t changes neither the discriminant nor Delta_0 and Delta_1.
// - Of three roots only the farthest comes from the trigonometric equation, whose rounding error is of its size.
// - Every root is polished with the cubic itself: GPUs may compute cosines with an error of 2^-11.
// - Every path preserves parity: one or three roots of a cubic, none or two of a quadratic, no double root (thesis
//   3.3.3). A wrong choice of path then moves the curve by a rounding error only.

struct Roots {
    int found;
    vec3 t;  // in no order; the first `found` hold
};

float evaluate_cubic(float a, float b, float c, float d, float t) {
    return ((a * t + b) * t + c) * t + d;
}

// Two Newton steps, each taken only if it reduces the error: the slope at a double root is useless.
float polish(float a, float b, float c, float d, float t) {
    for (int i = 0; i < 2; i++) {
        float error = evaluate_cubic(a, b, c, d, t);
        float slope = (3.0 * a * t + 2.0 * b) * t + c;
        float closer = slope != 0.0 ? t - error / slope : t;
        t = abs(evaluate_cubic(a, b, c, d, closer)) < abs(error) ? closer : t;
    }
    return t;
}

// The inflection -b / (3a), clamped to the neighbourhood of the curve's 0..1.
float inflection(float a, float b) {
    return clamp(-b / (3.0 * a), -1.0, 2.0);
}

// Coefficients b, c, d of the same cubic in t - shift.
vec3 shift_cubic(float a, float b, float c, float d, float shift) {
    return vec3(3.0 * a * shift + b, (3.0 * a * shift + 2.0 * b) * shift + c, evaluate_cubic(a, b, c, d, shift));
}

// Delta_0 of thesis 3.3.3.
float delta_0(float a, float b, float c) {
    return b * b - 3.0 * a * c;
}

// Delta_1 of thesis 3.3.3.
float delta_1(float a, float b, float c, float d) {
    return b * (2.0 * b * b - 9.0 * a * c) + 27.0 * a * a * d;
}

// The discriminant, and the sum of its terms' absolute values, to which its rounding error is proportional.
vec2 discriminant(float a, float b, float c, float d) {
    float bbcc = b * b * c * c;
    float accc = 4.0 * a * c * c * c;
    float bbbd = 4.0 * b * b * b * d;
    float aadd = 27.0 * a * a * d * d;
    float abcd = 18.0 * a * b * c * d;
    return vec2(bbcc - accc - bbbd - aadd + abcd, bbcc + abs(accc) + abs(bbbd) + aadd + abs(abcd));
}

// The equation that solves the cubic; zero and equal are relative to the coefficients.
int solution_path(float a, float b, float c, float d) {
    float size = max(abs(a), max(abs(b), abs(c)));
    if (max(abs(a), abs(b)) <= NEARLY_ZERO * size) {
        return STRAIGHT;
    }
    if (abs(a) <= NEARLY_ZERO * abs(b)) {
        return QUADRATIC;
    }
    vec3 s = shift_cubic(a, b, c, d, inflection(a, b));
    float delta = delta_0(a, s.x, s.y);
    if (abs(delta) <= NEARLY_EQUAL * abs(a) * size) {
        return abs(delta_1(a, s.x, s.y, s.z)) <= 27.0 * NEARLY_EQUAL * a * a * size ? TRIPLE : CUBE_ROOT;
    }
    vec2 sign_and_size = discriminant(a, s.x, s.y, s.z);
    if (abs(sign_and_size.x) <= NEARLY_EQUAL * sign_and_size.y) {
        return DOUBLE;
    }
    if (sign_and_size.x > 0.0) {
        return THREE;
    }
    return delta < 0.0 ? HYPERBOLIC_SINE : HYPERBOLIC_COSINE;
}

// Equations 3.5 and 3.6 for a t^2 + b t + c; the roots are q / a and c / q, because neither cancels.
Roots solve_quadratic(float a, float b, float c) {
    float square = b * b - 4.0 * a * c;
    if (square < 0.0) {
        return Roots(0, vec3(0.0));
    }
    float q = -0.5 * (b + (b < 0.0 ? -sqrt(square) : sqrt(square)));
    return Roots(2, vec3(a != 0.0 ? q / a : 0.0, q != 0.0 ? c / q : 0.0, 0.0));
}

// Equations 3.7, 3.8, 3.10 and 3.11: the single root.
float solve_single(int path, float a, float b, float c, float d) {
    float center = -b / (3.0 * a);
    float p = -delta_0(a, b, c) / (3.0 * a * a);
    float q = delta_1(a, b, c, d) / (27.0 * a * a * a);
    if (path == TRIPLE) {
        return center;
    }
    if (path == DOUBLE) {
        return (4.0 * a * b * c - 9.0 * a * a * d - b * b * b) / (a * delta_0(a, b, c));
    }
    if (path == CUBE_ROOT) {  // p = 0, a case that the thesis omits
        return center - sign(q) * pow(abs(q), 1.0 / 3.0);
    }
    if (path == HYPERBOLIC_SINE) {
        return center - 2.0 * sqrt(p / 3.0) * sinh(asinh(1.5 * q / p * sqrt(3.0 / p)) / 3.0);
    }
    // the domain of arcosh is 1 and more; the thesis states -1 to 1
    float ratio = max(-1.5 * abs(q) / p * sqrt(-3.0 / p), 1.0);
    return center - 2.0 * sign(q) * sqrt(-p / 3.0) * cosh(acosh(ratio) / 3.0);
}

// Equation 3.12 for the root farthest from 0; the other two from the quadratic quotient. For these the equation would
// subtract numbers of the size of b / a; the quotient, built from d upwards, does not.
// The cosine of the angle is the thesis's 3q / (2p) sqrt(-3 / p), turned to the far side; its sine preserves the digits.
Roots solve_three(float a, float b, float c, float d) {
    float p = -delta_0(a, b, c) / (3.0 * a * a);
    float q = delta_1(a, b, c, d) / (27.0 * a * a * a);
    float side = a * b > 0.0 ? -1.0 : 1.0;
    float angle = atan(sqrt(discriminant(a, b, c, d).x / 27.0) / (a * a), -side * q);
    float far = polish(a, b, c, d, -b / (3.0 * a) + side * 2.0 * sqrt(-p / 3.0) * cos(angle / 3.0));
    float c2 = -d / far;
    float b2 = (c2 - c) / far;
    Roots rest = solve_quadratic(b - b2, c - c2, d);
    return Roots(1 + rest.found, vec3(far, rest.t.xy));
}

// All real roots that affect parity.
Roots solve_cubic(float a, float b, float c, float d) {
    int path = solution_path(a, b, c, d);
    float shift = 0.0;
    if (path > QUADRATIC) {
        shift = inflection(a, b);
        vec3 s = shift_cubic(a, b, c, d, shift);
        b = s.x;
        c = s.y;
        d = s.z;
    }
    Roots roots;
    if (path == STRAIGHT) {
        roots = Roots(1, vec3(-d / c));
    } else if (path == QUADRATIC) {
        // the quadratic that agrees with the cubic at 0, 1/2 and 1: there t^3 is 3/2 t^2 - t/2
        roots = solve_quadratic(b + 1.5 * a, c - 0.5 * a, d);
    } else if (path == THREE) {
        roots = solve_three(a, b, c, d);
    } else {
        roots = Roots(1, vec3(solve_single(path, a, b, c, d)));
    }
    for (int k = 0; k < roots.found; k++) {
        roots.t[k] = shift + polish(a, b, c, d, roots.t[k]);
    }
    return roots;
}
