"""The permitted distance between outlines, for cells of any size."""

import numpy as np
import pytest

from vexture.base.errors import ParameterError
from vexture.base.tolerance import COARSEST, DETAIL_SHARE, FINEST
from vexture.thesis.accuracy import Accuracy, accuracy_of, cell_tolerance


@pytest.mark.parametrize(("size", "tolerance"), [(1.0, 0.01), (0.05, 0.005), (0.01, 0.001)])
def test_a_cell_has_a_share_of_its_size_at_most(size: float, tolerance: float) -> None:
    assert cell_tolerance(Accuracy(0.01, 0.1, 0.0), size) == pytest.approx(tolerance)
    assert cell_tolerance(Accuracy(0.01, 0.1, 0.2), size) == pytest.approx(0.2 * size), "no finer than quantisation"


def test_a_number_holds_for_cells_of_all_sizes() -> None:
    chosen = accuracy_of(0.01, np.zeros((0, 4, 2)), 0.5)
    assert [cell_tolerance(chosen, size) for size in (1.0, 1e-6)] == [0.01, 0.01]


def test_the_smallest_detail_decides_within_limits() -> None:
    detail = 0.5 * (FINEST + COARSEST) / DETAIL_SHARE
    sizes = np.array([3.0 * detail, detail, 2.0 * detail])
    cubics = np.linspace(0.0, 1.0, 4)[:, None] * np.array([1.0, 0.3]) * sizes[:, None, None]
    assert accuracy_of("auto", cubics).distance == pytest.approx(0.5 * (FINEST + COARSEST))
    assert accuracy_of("auto", cubics * 1e-9).distance == FINEST
    assert accuracy_of("auto", cubics * 1e9).distance == COARSEST


@pytest.mark.parametrize("tolerance", [0, 0.0, 1.0, -0.1, float("nan"), "0.1", None])
def test_other_tolerances_are_named(tolerance: object) -> None:
    with pytest.raises(ParameterError, match=r"`tolerance` .* is not between 0 and 1"):
        accuracy_of(tolerance, np.zeros((0, 4, 2)))  # type: ignore[arg-type]
