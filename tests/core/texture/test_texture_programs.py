"""Programs of planar maps in textures: damaged ones are refused, sound ones read back."""

import numpy as np
import pytest
from test_maps import faces

from gradient_drawings import DRAWINGS
from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.texture.planar import decode_map, map_texels
from vexture.texture.texture import Texture

GRADIENT = layout.KIND_LINEAR << layout.KIND_SHIFT | 3 << layout.STOP_BITS
MIX = layout.KIND_MIX << layout.KIND_SHIFT


@pytest.mark.parametrize(
    ("part", "at", "word", "value", "message"),
    [
        ("head", 0, 1, 0, "a head that is not 0"),
        ("head", 0, 1, 1, "gaps|one is empty or too long"),
        ("head", 0, 0, 1 << 31, "end at texel"),
        ("head", 0, 2, 1 << 31, "end at texel"),
        ("head", 0, 2, 2, "stops elsewhere"),
        ("programs", 0, 3, 0, "wrong length"),
        ("head", 0, 3, 1 << 31, "end at texel"),
        ("programs", 0, 3, layout.KIND_FOLLOWS << layout.KIND_SHIFT, "half of an operation"),
        ("programs", 0, 3, layout.KIND_FOCAL << layout.KIND_SHIFT, "wrong length"),
        ("programs", 0, 3, GRADIENT, "stops elsewhere"),
        ("programs", 0, 3, GRADIENT | (1 << layout.STOP_BITS) - 1, "stops elsewhere"),
        ("programs", 0, 3, layout.KIND_LINEAR << layout.KIND_SHIFT | 1, "stops elsewhere"),
        ("programs", 0, 3, GRADIENT | 3 << 27 | 5, "no such spread|stops elsewhere"),
        ("programs", 0, 0, 0x7F800000, "not finite"),
        ("programs", 0, 3, MIX, "a group is not ended|no such group|not 0"),
        ("programs", 0, 3, layout.KIND_KEEP << layout.KIND_SHIFT, "a word that is not 0"),
        ("programs", 0, 3, layout.KIND_SOLID << layout.KIND_SHIFT, "a colour above its opacity|not 0"),
        ("stops", 0, 0, 0x3F800000, "stops that are not in order"),
        ("stops", 0, 0, 0xBF800000, "not in 0..1"),
        ("stops", 0, 0, 0x7FC00000, "not in 0..1"),
        ("stops", 0, 3, 1, "a word that is not 0"),
    ],
)
def test_damaged_programs_are_refused(part: str, at: int, word: int, value: int, message: str) -> None:
    texture = faces(DRAWINGS["groups"])
    texture.check()
    flat = texture.flat.copy()
    programs, operations, _, _ = flat[0].tolist()
    flat[at + {"head": 0, "programs": programs, "stops": programs + operations}[part], word] = value
    with pytest.raises(FormatError, match=message):
        Texture(flat.reshape(texture.texels.shape), texture.roots).check()


@pytest.mark.parametrize("name", DRAWINGS)
def test_programs_read_back(name: str) -> None:
    texture = faces(DRAWINGS[name])
    planar = decode_map(texture.flat, texture.roots[0].quad)
    np.testing.assert_array_equal(map_texels(planar, 0), texture.flat[: len(map_texels(planar, 0))])
