"""Splines of planar maps in textures: written, read back, and refused where they are damaged."""

import numpy as np
import pytest
from test_maps import faces

from blur_drawings import BLURS, random_blur, soft_path
from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Picture
from vexture.texture.load import texture_from
from vexture.texture.planar import decode_map, map_texels
from vexture.texture.texture import Texture
from vexture.tree.planar.blurs import with_splines

FOLLOWS = layout.KIND_FOLLOWS << layout.KIND_SHIFT


def pictures_in(texture: Texture) -> list[Picture]:
    planar = decode_map(texture.flat, texture.roots[0].quad)
    return [one for program in planar.programs.values() for one in program if isinstance(one, Picture)]


def blocks_of(values: np.ndarray) -> list[np.ndarray]:
    """Blocks of 4 x 4 values, in rows; what does not exist is 0, and the block is masked there."""
    rows, columns = values.shape
    padded = np.ma.masked_all((-(-rows // 4) * 4, -(-columns // 4) * 4), np.int64)
    padded[:rows, :columns] = values
    return [padded[j : j + 4, i : i + 4] for j in range(0, rows, 4) for i in range(0, columns, 4)]


@pytest.mark.parametrize("seed", [2, 3])
def test_texels_of_opacities_are_as_specified(seed: int) -> None:
    drawing = Drawing((soft_path(random_blur(np.random.default_rng(seed)), (1.0, 0.5, 0.0), 0.75),))
    texture = faces(drawing)
    picture = with_splines(drawing).paths[0].paint.picture
    assert picture is not None
    assert picture.sampling.components == 1
    values = picture.pixels[..., 0].astype(np.int64)
    rows, columns = values.shape
    programs, operations, stops, count = texture.flat[texture.roots[0].quad - 2].tolist()
    texels = texture.flat[programs : programs + operations]
    assert (texture.version, operations, stops) == ("3", 3, 0)
    assert texels[0].tolist() == [round(0.75 * 65535), columns | rows << 16, 3, int(picture.sampling)]
    assert texels[1:, 3].tolist() == [FOLLOWS | 0x0080FF, FOLLOWS]
    blocks, level = [], 0
    while True:
        step = 1 << level
        means = [
            [values[j : j + step, i : i + step].mean() for i in range(0, columns, step)] for j in range(0, rows, step)
        ]
        blocks += blocks_of(np.floor(np.array(means) + 0.5).astype(np.int64))
        if len(means) == len(means[0]) == 1:
            break
        level += 1
    at = programs + operations
    entries = texture.flat[at : at + -(-len(blocks) // 8)].copy().view("<u2").ravel()
    stored = at + -(-len(blocks) // 8)
    assert not entries[len(blocks) :].any()
    for entry, block in zip(entries.tolist(), blocks, strict=False):
        if block.min() == block.max():
            assert entry == block.min()
        else:
            assert stored + entry - 256 < at + count
            found = texture.flat[stored + entry - 256].copy().view("u1").reshape(4, 4)
            assert (found == block.filled(0)).all()
    assert stored + max(entries.tolist()) - 255 == at + count


@pytest.mark.parametrize("name", BLURS)
def test_blurs_read_back(name: str) -> None:
    texture = faces(BLURS[name])
    again = texture_from(texture.to_ktx2(), "again")
    assert again.version == "3"
    np.testing.assert_array_equal(again.texels, texture.texels)
    planar = decode_map(again.flat, again.roots[0].quad)
    np.testing.assert_array_equal(map_texels(planar, 0), again.flat[: len(map_texels(planar, 0))])
    wanted = [path.paint.picture for path in with_splines(BLURS[name]).paths]
    found = pictures_in(again)
    assert found
    for one in found:
        assert any(
            other is not None
            and one.sampling is other.sampling
            and one.pixels.shape == other.pixels.shape
            and bool((one.pixels == other.pixels).all())
            for other in wanted
        )


@pytest.mark.parametrize(
    ("part", "at", "word", "value", "message"),
    [
        ("programs", 0, 3, 5, "opacity or sampling"),
        ("programs", 0, 3, 2, "a word that is not 0"),
        ("programs", 0, 1, 999 | 999 << 16, "an index of blocks"),
        ("programs", 1, 3, FOLLOWS | 1 << 24, "a word that is not 0"),
        ("programs", 2, 3, FOLLOWS | 1, "a word that is not 0"),
        ("pixels", 0, 0, 0xFFFF, "pixels elsewhere"),
        ("pixels", 0, 0, 0xFFFF0000, "pixels elsewhere"),
    ],
)
def test_damaged_splines_are_refused(part: str, at: int, word: int, value: int, message: str) -> None:
    texture = faces(BLURS["turned"])
    texture.check()
    flat = texture.flat.copy()
    programs, operations, stops, _ = flat[0].tolist()
    flat[{"programs": programs, "pixels": programs + operations + stops}[part] + at, word] = value
    with pytest.raises(FormatError, match=message) as caught:
        Texture(flat.reshape(texture.texels.shape), texture.roots).check()
    assert "\n" not in str(caught.value)
