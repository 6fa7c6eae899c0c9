"""What counts and what does not, without a look at the clock."""

import time

import pytest

from vexture.base.errors import DeviceError
from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.measures.timing import frames_per_second, median_seconds


@pytest.mark.parametrize(("taken", "expected"), [([100, 7], 7), ([100, 5, 1, 3, 2], 2.5)])
def test_the_first_call_does_not_count(taken, expected, monkeypatch):
    """By a clock that only the actions move."""
    now, left = [0.0], list(taken)
    monkeypatch.setattr(time, "perf_counter", lambda: now[0])

    def action():
        now[0] += left.pop(0)

    assert median_seconds(action, len(taken) - 1) == expected
    assert left == []


def test_a_rate_is_finite():
    from vexture_evidence.measures.programs import packed_program

    try:
        program = packed_program(ConvertedDrawing(example("duck")).way("packed").texture)
    except DeviceError as error:
        pytest.skip(str(error))
    assert 0.0 < frames_per_second(program, (64, 64), 1) < float("inf")
