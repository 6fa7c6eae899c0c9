"""Areas in a pixel and their moments about its middle, against formulas of polygons."""

import numpy as np
import pytest

from vexture.renderers.moment import area_share, moved_share, plus_share, share_beside, whole_share


def test_right_half_of_a_pixel() -> None:
    share = share_beside((0.0, 0.5), (0.0, -0.5))
    assert share == pytest.approx((0.5, 0.125, 0.0, 1 / 24, 0.0, 1 / 24), abs=1e-12)
    beyond = share_beside((0.0, 3.0), (0.0, -7.0))
    assert beyond == pytest.approx(share, abs=1e-12)
    back = share_beside((0.0, -0.5), (0.0, 0.5))
    assert plus_share(share, back, 1.0) == pytest.approx((0.0,) * 6, abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_triangle_in_a_pixel(seed: int) -> None:
    corners = np.random.default_rng(seed).uniform(-0.5, 0.5, (3, 2))
    (ax, ay), (bx, by) = corners[1] - corners[0], corners[2] - corners[0]
    area = 0.5 * (ax * by - ay * bx)
    total = area_share(0.0)
    for start, end in zip(corners.tolist(), np.roll(corners, -1, axis=0).tolist(), strict=True):
        total = plus_share(total, share_beside(tuple(start), tuple(end)), 1.0)
    second = area / 12 * (corners.T @ corners + np.outer(corners.sum(axis=0), corners.sum(axis=0)))
    expected = (area, *(area * corners.mean(axis=0)), second[0, 0], second[0, 1], second[1, 1])
    assert total == pytest.approx(expected, abs=1e-12)


def test_a_whole_box_as_a_part_of_a_pixel() -> None:
    quarter = moved_share(whole_share(), (0.5, 0.5), (0.25, -0.25))
    assert quarter == pytest.approx((0.25, 1 / 16, -1 / 16, 1 / 48, -1 / 64, 1 / 48), abs=1e-12)
