import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from vexture.bezier.area import edge_index
from vexture.thesis.decode import edge_point
from vexture.thesis.encode import quantised_ends

INDEX = st.floats(0.0, 1.0, exclude_max=True)


@given(INDEX)
def test_point_and_index_are_inverse(index: float) -> None:
    x, y = edge_point(np.array(index))
    assert {0.0, 1.0} & {float(x), float(y)}, "one coordinate is exact"
    assert min(x, y) >= 0.0
    assert max(x, y) <= 1.0
    apart = abs(edge_index(float(x), float(y)) - index)
    assert min(apart, 1.0 - apart) < 1e-15


def test_one_is_the_top_left_corner_again() -> None:
    assert edge_point(np.array([0.0, 1.0])).tolist() == [[0.0, 1.0], [0.0, 1.0]]


@given(INDEX, INDEX | st.sampled_from([-1e-3, -1e-6, 0.0, 1e-6, 1e-3]), st.booleans(), st.sampled_from([255, 65535]))
def test_ends_stay_apart_in_their_order(start: float, step: float, clockwise: bool, steps: int) -> None:
    exact = np.array([start, (start + step) % 1.0])
    whole = quantised_ends(exact[None], np.array([clockwise]), steps)[0]
    assert whole[0] != whole[1]
    assert (whole >= 0).all()
    assert (whole < steps).all()
    off = (whole - exact * steps + steps / 2) % steps - steps / 2
    collide = abs((exact[0] - exact[1] + 0.5) % 1.0 - 0.5) * steps <= 1.0
    assert abs(off).max() <= (1.0 if collide else 0.5) + 1e-9
    walk, walk_whole = (exact[0] - exact[1]) % 1.0, (whole[0] - whole[1]) % steps
    if exact[0] == exact[1]:
        assert walk_whole == (1 if clockwise else steps - 1)
    else:  # a short walk stays short, a long one long
        assert abs(walk_whole - walk * steps) <= 1.0 + 1e-9
