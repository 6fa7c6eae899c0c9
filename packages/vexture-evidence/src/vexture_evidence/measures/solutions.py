"""The nine solution paths of thesis Figure 3.5: a curve for each, solved in float64 and, by the shader, in float32.

A curve has P0 = (0, 0) and P3 = (1, 0), as in a leaf after its change of basis (thesis 3.2).
"""

from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.renderers.shader import vertex_source
from vexture.renderers.view import window
from vexture.thesis.cpu import height, inside_curve
from vexture.thesis.cubic import solution_path, solve_cubic
from vexture.thesis.method import (
    CUBE_ROOT,
    DOUBLE,
    HYPERBOLIC_COSINE,
    HYPERBOLIC_SINE,
    QUADRATIC,
    STRAIGHT,
    THREE,
    TRIPLE,
)
from vexture.thesis.shader_text import compose
from vexture_evidence.measures.programs import current_context

VERSION: Final = "330"

BOX: Final = (-0.4, -0.6, 1.55, 1.55)
"""x, y, width and height of the part that pictures show, in chord lengths."""

NONE: Final = -9.0
"""Value that the shader writes where there is no further root."""

MAIN: Final = """
uniform vec2 p1;
uniform vec2 p2;
uniform mat3 to_chord;  // from pixel coordinates to the chord's basis
out vec4 inside_and_roots;
void main() {
    vec2 point = (to_chord * vec3(gl_FragCoord.xy, 1.0)).xy;
    Roots roots = solve_cubic(3.0 * (p1.x - p2.x) + 1.0, 3.0 * p2.x - 6.0 * p1.x, 3.0 * p1.x, -point.x);
    vec3 t = roots.t;
    for (int k = 0; k < 3; k++) {
        if (k >= roots.found) {
            t[k] = NONE;
        }
    }
    inside_and_roots = vec4(inside_curve(p1, p2, point) ? 1.0 : 0.0, t);
}
""".replace("NONE", repr(NONE))


@dataclass(frozen=True, slots=True)
class SolutionPath:
    """A path of Figure 3.5, with a curve and a position for which the solver takes it.

    Parameters
    ----------
    name : str
    path : int
        Its number in `vexture.thesis.method`.
    p1, p2 : tuple of float
        Inner control points.
    x : float
        Position at which the curve is solved.
    """

    name: str
    path: int
    p1: tuple[float, float]
    p2: tuple[float, float]
    x: float

    @property
    def coefficients(self) -> tuple[float, float, float, float]:
        """Coefficients of equation 3.3, a t^3 + b t^2 + c t + d = 0."""
        return _coefficients(self.p1, self.p2, self.x)


@dataclass(frozen=True, slots=True)
class Solution:
    """Points at which a curve meets the vertical line at `SolutionPath.x`.

    Parameters
    ----------
    t : tuple of float
        Parameters on the curve, 0..1, ascending.
    heights : tuple of float
        The curve's y at each parameter.
    """

    t: tuple[float, ...]
    heights: tuple[float, ...]


def _coefficients(p1: tuple[float, float], p2: tuple[float, float], x: float) -> tuple[float, float, float, float]:
    return 3.0 * (p1[0] - p2[0]) + 1.0, 3.0 * p2[0] - 6.0 * p1[0], 3.0 * p1[0], -x


def _turning_point(x1: float, x2: float) -> float:
    """The x at which a curve with these control points first turns back: there two roots coincide."""
    a, b, c, _ = _coefficients((x1, 0.0), (x2, 0.0), 0.0)
    t = float(np.roots([3.0 * a, 2.0 * b, c]).real.min())
    return ((a * t + b) * t + c) * t


SOLUTIONS: Final = (
    SolutionPath("straight", STRAIGHT, (1 / 3, 0.9), (2 / 3, -0.5), 0.35),
    SolutionPath("quadratic, 1 root", QUADRATIC, (0.05, 0.9), (0.05 + 1 / 3, 0.6), 0.35),
    SolutionPath("quadratic, 2 roots", QUADRATIC, (-0.65, 0.2), (-0.65 + 1 / 3, 1.0), -0.2),
    SolutionPath("triple root", TRIPLE, (1.0, 1.0), (0.0, 0.4), 0.5),
    SolutionPath("cube root", CUBE_ROOT, (1.0, -0.9), (0.0, 0.9), 0.35),
    SolutionPath("double root", DOUBLE, (1.5, 1.0), (-0.5, 1.0), _turning_point(1.5, -0.5)),
    SolutionPath("hyperbolic sine", HYPERBOLIC_SINE, (0.6, 1.1), (0.4, 0.1), 0.35),
    SolutionPath("hyperbolic cosine", HYPERBOLIC_COSINE, (1.6, -0.5), (-0.2, 1.2), 0.15),
    SolutionPath("three roots", THREE, (1.9, 0.9), (-0.9, -0.5), 0.45),
)


def solve(case: SolutionPath) -> Solution:
    """Roots on the curve and their heights, in float64.

    Examples
    --------
    >>> solve(SOLUTIONS[0]).t
    (0.35,)
    """
    roots = solve_cubic(*case.coefficients)
    return _solution(case, roots.t[: roots.found])


def by_cpu(case: SolutionPath, side: int) -> NDArray[np.bool_]:
    """Whether the centre of each pixel of the picture of `BOX` is inside, (side, side), in float64."""
    view = window(*BOX).matrix((side, side))
    x = view[0, 0] * (np.arange(side) + 0.5) + view[0, 2]
    y = view[1, 1] * (np.arange(side) + 0.5) + view[1, 2]
    return np.array([[inside_curve(case.p1, case.p2, (float(u), float(v))) for u in x] for v in y])


def by_gpu(case: SolutionPath, side: int) -> NDArray[np.bool_]:
    """The same picture, computed by the shader, in float32.

    Raises
    ------
    DeviceError
        If there is no GPU.
    """
    inside: NDArray[np.bool_] = _draw(case, window(*BOX).matrix((side, side)), side)[:, :, 0] > 0.5
    return inside


def roots_by_gpu(case: SolutionPath) -> Solution:
    """The result of `solve`, computed by the shader, in float32.

    Raises
    ------
    DeviceError
        If there is no GPU.
    """
    roots = _draw(case, np.array([[0.0, 0.0, case.x], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), 1)[0, 0, 1:]
    return _solution(case, tuple(map(float, roots)))


def _solution(case: SolutionPath, roots: tuple[float, ...]) -> Solution:
    on_curve = tuple(sorted(t for t in roots if 0.0 <= t <= 1.0))
    return Solution(on_curve, tuple(height(case.p1[1], case.p2[1], t) for t in on_curve))


@cache
def _program() -> Any:
    gl = current_context()
    program = gl.program(vertex_shader=vertex_source(VERSION), fragment_shader=compose(VERSION, "inside.glsl", MAIN))
    return gl.vertex_array(program, [])


def _draw(case: SolutionPath, to_chord: NDArray[np.float64], side: int) -> NDArray[np.float32]:
    """Draw (side, side, 4): inside or not, then the roots in the solver's order, `NONE` where there is none."""
    gl = current_context()
    triangle = _program()
    frame = gl.framebuffer([gl.texture((side, side), 4, dtype="f4")])
    frame.use()
    triangle.program["p1"] = case.p1
    triangle.program["p2"] = case.p2
    triangle.program["to_chord"].write(to_chord.T.astype(np.float32).tobytes())
    triangle.render(vertices=3)
    return np.frombuffer(frame.read(components=4, dtype="f4"), np.float32).reshape(side, side, 4).copy()


def takes(case: SolutionPath) -> int:
    """Number of the path that the solver takes."""
    return solution_path(*case.coefficients)
