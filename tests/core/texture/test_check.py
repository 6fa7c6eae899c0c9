"""Texels from strangers: every fault is one line, and nothing but a tree comes through."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_texture_encode import chain, leaf_pair, texture_of

from both_encodings import decode
from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.texture.texture import Texture


def put(texel: int, word: int, value: int) -> Callable[[Texture], None]:
    return lambda texture: texture.texels[0].__setitem__((texel, word), value)


FAULTS: dict[str, tuple[Callable[[Texture], None], str]] = {
    "a quad is itself": (put(0, 0, 0), "quad 0 has 1 quads from texel 0; they must lie after it"),
    "a quad beyond": (put(0, 0, 8), "quad 0 has 1 quads from texel 8"),
    "a quad far beyond": (put(0, 0, 2**32 - 1), "quad 0 has 1 quads from texel 4294967295"),
    "a quad is a curve": (put(0, 0, 2), "texel 2 is referred to twice"),
    "curves beyond": (put(1, 1, 7), "quad 1 has 2 curves from texel 7"),
    "curves before": (put(1, 1, 0), "quad 1 has 2 curves from texel 0"),
    "curves shared": (put(1, 1, 3), "texel 3 is referred to twice"),
    "a quad with a count": (put(0, 2, 0x0C_88_0C_00), "quad 0, cell 2 is 136, which is no valid cell"),
    "a constant with a winding": (put(1, 2, 0x04_00_00_14), "quad 1, cell 3 is 4"),
    "curves without a winding": (put(1, 2, 0x00_00_00_10), "quad 1, cell 0 is 16"),
    "an end beyond": (put(4, 0, 32769), "curve 4 has an end at 32769; the limit is 32768"),
    "an end above": (put(5, 3, 40000 << 16), "curve 5 has an end at 40000"),
    "padding": (put(7, 3, 1), "texel 7 belongs to no root and is not 0"),
    "a lost curve": (put(1, 2, 0x00_00_00_0C), "texel 5 belongs to no root"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults_of_the_texels(name: str) -> None:
    texture = leaf_pair()
    texture.check()
    change, expected = FAULTS[name]
    change(texture)
    with pytest.raises(FormatError) as caught:
        texture.check()
    assert expected in str(caught.value)
    assert str(caught.value).endswith("convert the drawing again")


def test_a_root_inside_another_or_beyond() -> None:
    texture = leaf_pair()
    for quad, expected in ((1, "texel 1 is referred to twice"), (8, "a root is quad 8 of 8 texels")):
        with pytest.raises(FormatError, match=expected):
            Texture(texture.texels, (Root("a"), Root("b", quad))).check()


def test_quads_of_one_depth_that_share() -> None:
    texels = np.zeros((1, 4, 4), np.uint32)
    texels[0, :3] = (1, 0, 0x80_80, 0), (0, 3, 0x0C, 0), (0, 3, 0x0C, 0)
    with pytest.raises(FormatError, match="texel 3 is referred to twice, as a curve now"):
        Texture(texels, (Root("a"),)).check()


def test_the_depth_limit() -> None:
    texture_of([chain(layout.MOST_DEPTH)]).check()
    with pytest.raises(FormatError, match="lies at depth 20; the limit is 19"):
        texture_of([chain(layout.MOST_DEPTH + 1)]).check()


@given(st.integers(0, 2**32), st.integers(1, 64))
def test_random_texels_are_refused_or_a_tree(seed: int, roots: int) -> None:
    random = np.random.default_rng(seed)
    texels = random.integers(0, 2**32, (1, 64, 4), np.uint32)
    texels[:, :, :2] %= 80
    texels[:, :, 2] = random.choice(np.array([0, 0x80, 0x0C00, 0x80_00_14_00], np.uint32), (1, 64))
    texture = Texture(texels, tuple(Root(str(k), k) for k in range(roots)))
    try:
        texture.check()
    except FormatError:
        return
    for k in range(roots):
        decode(texture, k)


def test_200000_texels_are_checked_by_arrays() -> None:
    tree = chain(16)
    texture = encode_packed([tree] * 12_500, [Root("x")] * 12_500, name="many")
    texture.check()
    texture.texels[-1, 0, 0] = 7
    assert len(texture.flat) >= 200_000
