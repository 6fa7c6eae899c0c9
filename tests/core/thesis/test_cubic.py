"""Roots of cubics by the solution paths of the thesis."""

import numpy as np
import pytest

from vexture.thesis import method
from vexture.thesis.cubic import solution_path, solve_cubic


def from_roots(a: float, *roots: complex) -> tuple[float, ...]:
    return tuple(a * np.poly(roots).real)


CASES = {
    "straight": ((0.0, 0.0, 1.0, -0.3), "STRAIGHT"),
    "quadratic": ((0.0, *from_roots(2.0, 0.25, 1.5)), "QUADRATIC"),
    "quadratic without a root": ((0.0, *from_roots(2.0, 0.5 + 1j, 0.5 - 1j)), "QUADRATIC"),
    "triple": (from_roots(4.0, 0.5, 0.5, 0.5), "TRIPLE"),
    "p = 0": ((4.0, -6.0, 3.0, -0.9), "CUBE_ROOT"),
    "p = 0, q > 0": ((4.0, -6.0, 3.0, -0.1), "CUBE_ROOT"),
    "double": (from_roots(2.0, 0.75, 0.25, 0.25), "DOUBLE"),
    "p > 0": (from_roots(1.0, 0.3, 0.4 + 2j, 0.4 - 2j), "HYPERBOLIC_SINE"),
    "p > 0, a < 0": (from_roots(-1.0, 0.3, 0.1 + 2j, 0.1 - 2j), "HYPERBOLIC_SINE"),
    "p < 0": (from_roots(1.0, 0.3, 3 + 0.1j, 3 - 0.1j), "HYPERBOLIC_COSINE"),
    "p < 0, q < 0": (from_roots(1.0, 0.9, -3 + 0.1j, -3 - 0.1j), "HYPERBOLIC_COSINE"),
    "three": (from_roots(3.0, 0.1, 0.5, 0.8), "THREE"),
    "three, a < 0": (from_roots(-3.0, 0.1, 0.2, 0.9), "THREE"),
    "three, one far": (from_roots(1e-3, 0.1, 0.6, 1000.0), "THREE"),
}


@pytest.mark.parametrize("name", CASES)
def test_each_path_finds_its_roots(name: str) -> None:
    coefficients, path = CASES[name]
    assert solution_path(*coefficients) == getattr(method, path)
    roots = solve_cubic(*coefficients)
    expected = np.roots(np.trim_zeros(coefficients, "f"))
    real = np.sort(expected[np.abs(expected.imag) < 1e-4].real)
    if path in ("TRIPLE", "DOUBLE"):  # a pair is left out
        real = real[-1:]
    assert roots.found == len(real)
    np.testing.assert_allclose(sorted(roots.t[: roots.found]), real, rtol=1e-9, atol=1e-5 if path == "TRIPLE" else 1e-9)
