"""Numbers of paints in 8, 16 and 32 bits (FORMAT.md, D.3)."""

import numpy as np
import pytest

from vexture.texture.numbers import means_place, packing_of, read_number


@pytest.mark.parametrize(("dtype", "packing"), [("<u1", 2), ("<u2", 1), ("<u4", 0)])
def test_numbers_of_a_texel_are_those_of_numpy(dtype: str, packing: int) -> None:
    texel = np.random.default_rng(1).integers(0, 2**32, 4, np.uint32)
    numbers = texel.view(dtype)
    assert [read_number(texel, place, packing) for place in range(len(numbers))] == numbers.tolist()
    assert read_number(texel, len(numbers) + 3, packing) == numbers[3]


@pytest.mark.parametrize(("used", "packing"), [(1, 2), (256, 2), (257, 1), (65536, 1), (65537, 0)])
def test_width_of_numbers_follows_from_how_many_paints_there_are(used: int, packing: int) -> None:
    flat = np.zeros((4, 4), np.uint32)
    flat[1, 0] = used
    assert packing_of(flat, 2) == packing


def test_a_texel_of_base_paints_precedes_the_means_of_four_quads() -> None:
    flat = np.zeros((20, 4), np.uint32)
    flat[1, 0] = 3
    assert [means_place(flat, 2, 2 + place) for place in range(9)] == [1, 2, 3, 4, 6, 7, 8, 9, 11]
