"""Control points that move through every case, on the CPU, on the GPU and by counting crossings (thesis 4.4.1)."""

from collections import Counter
from collections.abc import Iterator
from typing import Any

import numba
import numpy as np
import pytest
from hand import EMPTY, Corner, Curve, Floats, decode, need_gpu, samples, speckles, texture_of, view_of

from vexture.thesis import cpu, method
from vexture.thesis.cpu import render_thesis_cpu
from vexture.thesis.cubic import solution_path, solve_cubic
from vexture.thesis.texture import render_thesis_gpu

PIXELS = 24
FRAMES = 24
PATHS = ("STRAIGHT", "QUADRATIC", "TRIPLE", "CUBE_ROOT", "DOUBLE", "HYPERBOLIC_SINE", "HYPERBOLIC_COSINE", "THREE")
SHIFT = (0.00123, 0.00071)  # so that no point falls on the edge of a cell
Frame = tuple[Any, Floats]


def wave(phase: float, low: float, high: float, speed: int, start: float = 0.0) -> float:
    return float(low + (high - low) * (0.5 + 0.5 * np.sin(speed * phase + start)))


def free(phase: float) -> Curve:
    """Loops, swirls, S-curves and arcs between edge points that wander over two edges each."""
    p1 = wave(phase, -1.25, 2.25, 1), wave(phase, -1.25, 2.25, 2, 1.0)
    p2 = wave(phase, -1.25, 2.25, 3, 2.0), wave(phase, -1.25, 2.25, 1, 3.0)
    return Curve(wave(phase, 0.55, 0.95, 1, 4.0), p1, p2, wave(phase, 0.05, 0.45, 2, 5.0))


def quadratic(phase: float) -> Curve:
    """Cubics that are raised quadratics, the control point beyond the ends as well as between them."""
    q = np.array([wave(phase, -0.6, 1.6, 1), wave(phase, -0.4, 1.4, 2, 1.0)])
    start, end = np.array([0.0, 0.25]), np.array([1.0, 0.75])
    p1, p2 = start + (q - start) * 2 / 3, end + (q - end) * 2 / 3
    return Curve(0.8125, tuple(p1), tuple(p2), 0.3125)


def even(phase: float) -> Curve:
    """Control points at one and two thirds of the chord, at any height: a line now and then."""
    return Curve(0.875, (1 / 3, wave(phase, -0.5, 1.5, 1)), (2 / 3, wave(phase, -0.5, 1.5, 2)), 0.375)


def symmetric(phase: float) -> Curve:
    """From an arc through the cusp, P1 = (1, .) and P2 = (0, .), to a loop."""
    reach = wave(phase, 0.2, 1.8, 1)
    return Curve(0.8, (reach, 1.4), (1.0 - reach, 1.4), 0.45)


def closed(phase: float) -> Curve:
    """Both ends in one point, the loop turning either way."""
    edge = wave(phase, 0.02, 0.98, 1)
    p1, p2 = (wave(phase, -0.8, 1.8, 2), 1.5), (wave(phase, -0.8, 1.8, 3), 0.2)
    return Curve(edge, p1, p2, edge)


def corner(phase: float) -> Corner:
    return Corner(wave(phase, 0.5, 0.999, 1), (wave(phase, 0, 1, 2), wave(phase, 0, 1, 3)), wave(phase, 0, 0.499, 2))


def basis_of(curve: Curve) -> tuple[Floats, Floats]:
    """Control points in the basis of the chord, and the basis (rows), of the curve as it is written."""
    row = texture_of([EMPTY, EMPTY, curve, EMPTY]).curves[2] / 65535
    outline = decode(row, False)
    p0, p3 = outline[0], outline[-1]
    chord = p3 - p0
    basis = np.array([chord, (-chord[1], chord[0])])
    controls = row[:, 1:].T * 3.5 - 1.25
    return (controls - p0) @ basis.T / (chord @ chord), np.array([p0, *basis])


def aimed(curve: Curve, x: float, y: float) -> Frame:
    """A view that puts one of the 16 points of a pixel exactly on a point of the curve's basis."""
    _, (start, along, across) = basis_of(curve)
    target = (start + x * along + y * across) / 2
    pixel = 0.5 / PIXELS
    one_of_16 = np.array([19, 21]) / 32  # column 2, row 1 of the grid, y up
    low = target - (np.floor(target / pixel) % PIXELS + one_of_16) * pixel
    return [EMPTY, EMPTY, curve, EMPTY], view_of((low[0], low[1]), 0.5, PIXELS)


def borders() -> Iterator[Frame]:
    """Curves whose cubic has a vanishing Delta_0, seen where it has three equal roots; turns, where it has two."""
    candidates = []
    for x1 in np.linspace(0.8, 1.2, 81):
        x2 = (x1 - np.sqrt(4 * x1 - 3 * x1 * x1)) / 2
        curve = Curve(0.875, (x1, 0.9), (x2, 0.9), 0.375)
        (p1, p2), _ = basis_of(curve)
        a, b, c = 3 * (p1[0] - p2[0]) + 1, 3 * p2[0] - 6 * p1[0], 3 * p1[0]
        candidates.append((abs(b * b - 3 * a * c), -b / (3 * a), curve, (p1[0], p2[0])))
    for _, t, curve, (x1, x2) in sorted(candidates, key=lambda c: c[0])[:4]:
        x = 3 * (1 - t) ** 2 * t * x1 + 3 * (1 - t) * t**2 * x2 + t**3
        yield aimed(curve, x, 0.1)
    for reach in (1.3, 1.5, 1.7):
        curve = Curve(0.875, (reach, 0.9), (1.0 - reach, 0.9), 0.375)
        (p1, p2), _ = basis_of(curve)
        for t in np.roots([3 * (3 * (p1[0] - p2[0]) + 1), 2 * (3 * p2[0] - 6 * p1[0]), 3 * p1[0]]).real:
            x = 3 * (1 - t) ** 2 * t * p1[0] + 3 * (1 - t) * t**2 * p2[0] + t**3
            yield aimed(curve, float(x), 0.1)


def moving(outline: Any) -> Iterator[Frame]:
    for phase in np.linspace(0, 2 * np.pi, FRAMES, endpoint=False):
        yield [EMPTY, EMPTY, outline(phase), EMPTY], view_of(SHIFT, 0.497, PIXELS)


SWEEPS = {f.__name__: lambda f=f: moving(f) for f in (free, quadratic, even, symmetric, closed, corner)} | {
    "borders": borders
}


@pytest.mark.slow
@pytest.mark.parametrize("name", SWEEPS)
def test_cpu_gpu_and_truth_agree_at_every_step(name: str) -> None:
    need_gpu()
    largest, mean = 0.0, 0.0
    for tree, view in SWEEPS[name]():
        texture = texture_of(tree)
        on_cpu, on_gpu = (
            render_thesis_cpu(texture, (PIXELS, PIXELS), view),
            render_thesis_gpu(texture, (PIXELS, PIXELS), view),
        )
        assert speckles(texture, on_cpu, view) == 0
        assert speckles(texture, on_gpu, view) == 0
        difference = np.abs(on_cpu - on_gpu)
        largest, mean = max(largest, difference.max()), max(mean, difference.mean())
    print(f"{name}: CPU and GPU differ by {largest:.4f} at most, {mean:.1e} on average in the worst picture")
    assert largest <= 1 / 16  # one of a pixel's points may lie within rounding of the outline
    assert mean <= 5e-4


@numba.njit
def count_paths(quads, curves, points, counts):
    """Solution path of every point that reaches the solver; the quadratic's by its number of roots on the curve."""
    for i in range(len(points)):
        cell = cpu.find_cell(quads, curves, (points[i, 0], points[i, 1]), 0.0)
        if cell.shape != method.CURVE:
            continue
        x, y = cpu.cell_point(cell, (points[i, 0], points[i, 1]))
        if not cell.heights[0] <= y < cell.heights[1]:
            continue
        x1, x2 = cell.p1[0], cell.p2[0]
        a, b, c = 3.0 * (x1 - x2) + 1.0, 3.0 * x2 - 6.0 * x1, 3.0 * x1
        path = solution_path(a, b, c, -x)
        if path != method.QUADRATIC:
            counts[path, 0] += 1
            continue
        roots = solve_cubic(a, b, c, -x)
        valid = 0
        for k in range(roots.found):
            valid += 0.0 <= roots.t[k] <= 1.0
        counts[path, valid] += 1


@pytest.mark.slow
def test_the_sweep_takes_all_nine_paths() -> None:
    counts = np.zeros((len(PATHS), 3), np.int64)
    for sweep in SWEEPS.values():
        for tree, view in sweep():
            texture = texture_of(tree)
            points = samples((PIXELS, PIXELS), view).reshape(-1, 2)
            count_paths(texture.quads / 65535, texture.curves / 65535, points, counts)
    taken = Counter({name: int(counts[getattr(method, name), 0]) for name in PATHS if name != "QUADRATIC"})
    taken["QUADRATIC, one root"], taken["QUADRATIC, two roots"] = map(int, counts[method.QUADRATIC, 1:])
    print(dict(taken))
    assert len(taken) == 9
    assert min(taken.values()) > 0, f"the sweep misses {[name for name, times in taken.items() if not times]}"
