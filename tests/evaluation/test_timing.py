"""What counts and what does not, without a look at the clock."""

import pytest

from vexture.errors import DeviceError
from vexture_evidence.measures.shape import Shape, example
from vexture_evidence.measures.timing import frames_per_second, median_seconds


@pytest.mark.parametrize("repeat", [1, 4])
def test_the_first_call_does_not_count(repeat):
    calls = []
    assert median_seconds(lambda: calls.append(1), repeat) >= 0.0
    assert len(calls) == repeat + 1


def test_a_rate_is_finite():
    from vexture_evidence.measures.programs import packed_program

    try:
        program = packed_program(Shape(example("duck")).way("packed").texture, "exact")
    except DeviceError as error:
        pytest.skip(str(error))
    assert 0.0 < frames_per_second(program, (64, 64), 1) < float("inf")
