import numpy as np
import pytest

from vexture.base.errors import DeviceError
from vexture.renderers.device import context
from vexture.thesis.cubic import solution_path
from vexture.thesis.method import QUADRATIC
from vexture_evidence.measures.solutions import BOX, SOLUTIONS, by_cpu, by_gpu, roots_by_gpu, solve

NAMES = [case.name for case in SOLUTIONS]


def points(case, t):
    control, t = np.array([(0, 0), case.p1, case.p2, (1, 0)]), np.asarray(t)[:, None]
    for _ in range(3):
        control = (1 - t[..., None]) * control[..., :-1, :] + t[..., None] * control[..., 1:, :]
    return control[:, 0]


@pytest.mark.parametrize("case", SOLUTIONS, ids=NAMES)
def test_a_curve_takes_its_path_and_its_roots_lie_on_the_line(case):
    assert solution_path(*case.coefficients) == case.path
    found = solve(case)
    assert found.t
    np.testing.assert_allclose(points(case, found.t), [(case.x, y) for y in found.heights], atol=1e-9)


def test_there_are_nine_paths():
    told = [(case.path, len(solve(case).t)) if case.path == QUADRATIC else case.path for case in SOLUTIONS]
    assert len(told) == len(set(told)) == 9
    assert [len(solve(case).t) for case in SOLUTIONS] == [1, 1, 2, 1, 1, 1, 1, 1, 3]


@pytest.mark.parametrize("case", SOLUTIONS, ids=NAMES)
def test_a_picture_is_in_and_out_as_counted(case):
    side = 24
    chords = points(case, np.linspace(0, 1, 2000))
    chords = np.vstack([(-9, 0), chords, (9, 0)])
    step = BOX[2] / side
    image = by_cpu(case, side)
    for row in range(0, side, 3):
        for column in range(0, side, 2):
            x, y = BOX[0] + (column + 0.5) * step, BOX[1] + BOX[3] - (row + 0.5) * step
            if np.hypot(*(chords - (x, y)).T).min() < 1e-3 or abs(y) < 1e-3:
                continue
            (xa, ya), (xb, yb) = chords[:-1].T, chords[1:].T
            cut = (xa <= x) != (xb <= x)
            above = ya[cut] + (x - xa[cut]) / (xb - xa)[cut] * (yb - ya)[cut] > y
            assert image[row, column] == above.sum() % 2, (x, y)


@pytest.mark.parametrize("case", SOLUTIONS, ids=NAMES)
def test_the_shader_finds_the_same(case):
    try:
        context()
    except DeviceError as error:
        pytest.skip(str(error))
    found, expected = roots_by_gpu(case), solve(case)
    np.testing.assert_allclose(found.t, expected.t, atol=1e-6)
    np.testing.assert_allclose(found.heights, expected.heights, atol=1e-6)
    assert (by_cpu(case, 48) != by_gpu(case, 48)).mean() < 0.002
