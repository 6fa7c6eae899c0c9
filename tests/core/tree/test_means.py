"""Mean colours of leaves of planar maps."""

import numpy as np
import pytest

from degenerate import drawing, polygon
from gradient_drawings import (
    DRAWINGS,
    WARM,
    linear,
    painted_path,
)
from planar import cell_at, colour_paths, sample_picture
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.tree.planar.build import build_map


@pytest.mark.parametrize("name", DRAWINGS)
def test_means_are_those_of_many_points(name: str) -> None:
    planar = build_map(DRAWINGS[name])
    wanted = sample_picture(DRAWINGS[name], 2, 64)
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], wanted, atol=1.5 / 255)


@pytest.mark.slow
def test_a_crowded_cell_has_the_mean_of_its_gradients() -> None:
    rng = np.random.default_rng(7)
    lines = [polygon([(0.01, y), (0.99, 1 - y), (0.99, 1.004 - y)]) for y in rng.uniform(0.1, 0.9, 90)]
    ramp = linear((0, 0), (1, 0), WARM)
    of = Drawing(
        tuple(painted_path(line, Paint((0, 0, k % 2), 0.5) if k % 3 else ramp) for k, line in enumerate(lines))
    )
    planar = build_map(of, max_depth=2)
    assert planar.unresolved > 0
    np.testing.assert_allclose(planar.mean[0].reshape(2, 2, 4)[::-1], sample_picture(of, 2, 40), atol=0.02)


@pytest.mark.parametrize("seed", range(8))
def test_means_are_exact(seed: int) -> None:
    of = colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))
    means = build_map(of).mean[0].reshape(2, 2, 4)[::-1]
    np.testing.assert_allclose(means, render_exact_colours(of, 2), atol=2e-4)


def test_a_cell_that_is_too_full_has_its_mean() -> None:
    rng = np.random.default_rng(7)
    lines = [polygon([(0.01, y), (0.99, 1 - y), (0.99, 1.004 - y)]) for y in rng.uniform(0.1, 0.9, 90)]
    of = Drawing(tuple(Path((line,), paint=Paint((k % 2, 0, 1 - k % 2), 0.5)) for k, line in enumerate(lines)))
    planar = build_map(of, max_depth=3)
    assert planar.unresolved > 0
    wanted = render_exact_colours(of, 8)
    for x in range(8):
        for y in range(8):
            quad, k, _ = cell_at(planar, ((x + 0.5) / 8, (y + 0.5) / 8))
            if planar.is_mean[quad, k]:
                np.testing.assert_allclose(planar.mean[quad, k], wanted[7 - y, x], atol=0.01)
