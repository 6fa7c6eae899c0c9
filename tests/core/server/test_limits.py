"""Limits of servers, and the pace of publishers."""

import pytest

from vexture.base.errors import ParameterError
from vexture.server.limits import Limits, Pace


def test_a_bucket_fills_again():
    now = 0.0
    pace = Pace(2.0, 2, lambda: now)
    assert [pace.wait("a") for _ in range(3)] == [0.0, 0.0, 0.5]
    now = 0.5
    assert [pace.wait("a"), pace.wait("a")] == [0.0, 0.5]
    now = 1000.0
    assert [pace.wait("a") for _ in range(3)] == [0.0, 0.0, 0.5]


@pytest.mark.parametrize("value", [0, -1, float("nan")])
def test_limits_are_above_zero(value):
    with pytest.raises(ParameterError, match="`rate` is"):
        Limits(rate=value)
