"""D.6 of FORMAT.md says all that a decoder needs to know about splines, and which files a reader refuses."""

import re
import struct
import zlib
from functools import cache
from pathlib import Path

import decoder
import map_decoder
import numpy as np
import picture_decoder
import pytest

import vexture
from blur_drawings import BLURS
from gradient_drawings import SQUARE, painted_path
from picture_drawings import OTHER
from vexture.base.errors import FormatError
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.exact import render_exact_colours
from vexture.texture.load import texture_from

REPOSITORY = Path(__file__).parents[3]
TINY = 1e-6
"""Side of the pixel that is as good as a point."""

WHOLE = ((6.0, 0.0, 0.0), (0.0, -5.0, 5.0))


def exact_colors(drawing: Drawing, points: np.ndarray) -> np.ndarray:
    """Colour of a tiny pixel around each point."""
    corners = (points - TINY / 2).tolist()
    return np.array([render_exact_colours(drawing, 1, vexture.window(*low, TINY, TINY))[0, 0] for low in corners])


@pytest.mark.slow
@pytest.mark.parametrize("name", BLURS)
def test_it_shows_blurs(name: str) -> None:
    points = np.random.default_rng(1).random((24, 2))
    _, _, (planar,) = map_decoder.read_maps(vexture.convert(BLURS[name], split="faces").to_ktx2())
    found = map_decoder.color_at(planar, *points.T)
    np.testing.assert_allclose(found, exact_colors(BLURS[name], points), rtol=0, atol=1.5 / 255)


def spline_drawing() -> Drawing:
    """The unit square painted with a spline of colours, and a part of it with splines of opacity over that."""
    rng = np.random.default_rng(41)
    opacities = rng.integers(0, 256, (5, 6, 1), np.uint8)
    opacities[:4, :4] = 77  # a block of one value
    colors = rng.integers(0, 256, (5, 7, 1), np.uint8).repeat(4, axis=2)
    colors[:2, :2] = 0  # also an index of blocks of one value
    color = Picture(WHOLE, colors, Sampling.SPLINE)
    shadow = Picture(WHOLE, opacities, Sampling.OPACITY, 0.75, (0.2, 0.4, 1.0))
    inverse = Picture(WHOLE, opacities, Sampling.INVERSE, 0.5, (1.0, 0.0, 0.6))
    paints = [Paint.from_picture(picture) for picture in (color, shadow, inverse)]
    return Drawing(tuple(map(painted_path, (SQUARE, OTHER, OTHER), paints)))


@cache
def spline_file() -> bytes:
    return run(spline_drawing(), Parameters("faces")).texture.to_ktx2()


def test_it_shows_splines() -> None:
    points = np.random.default_rng(2).random((50, 2))
    _, _, (planar,) = map_decoder.read_maps(spline_file())
    samplings = {int(texels[0, 3]) for program in planar.programs.values() for _, texels, _ in program}
    assert samplings == {2, 3, 4}
    found = map_decoder.color_at(planar, *points.T)
    np.testing.assert_allclose(found, exact_colors(spline_drawing(), points), rtol=0, atol=0.1 / 255)


def test_samplings_3_and_4_share_their_texels_and_are_complements() -> None:
    _, _, (planar,) = map_decoder.read_maps(spline_file())
    pictures = {int(texels[0, 3]): (texels, at) for program in planar.programs.values() for _, texels, at in program}
    assert pictures[3][1] == pictures[4][1] != pictures[2][1]
    x, y = np.random.default_rng(2).random((2, 50))
    opacities = [
        picture_decoder.picture_color(texels, planar.pixels[at:], x, y)[:, 3] * 65535 / int(texels[0, 0])
        for texels, at in (pictures[3], pictures[4])
    ]
    np.testing.assert_allclose(sum(opacities), 1)


def test_the_example_of_blocks_is_what_it_says() -> None:
    part = (REPOSITORY / "FORMAT.md").read_text(encoding="utf-8").split("### D.6 Programs")[1].split("### D.7")[0]
    rows = re.findall(r"^\| (\d+) \|((?: [0-9a-f]{8} \|){4})", part.split("a spline of five pixels")[1], re.M)
    assert [number for number, _ in rows] == ["20", "21", "22", "23", "24", "25"]
    words = np.array([[int(word, 16) for word in row.split("|")[:4]] for _, row in rows])
    program = map_decoder.read_programs(words, 0, [3, 0, 3], {1: [0, 3]})
    ((_, texels, first),) = program[1]
    levels, count = picture_decoder.read_picture(texels, words[3 + first :])
    assert count == 3
    assert [level.ravel().tolist() for level in levels] == [[0, 0, 0, 0, 255], [0, 0, 255], [0, 255], [51]]
    found = picture_decoder.picture_color(texels, words[3 + first :], np.array([0.9, 0.1]), np.array([0.3, 0.3]))
    np.testing.assert_allclose(found, [(5 / 6, 0, 0, 5 / 6), (0, 0, 0, 0)], atol=1e-12)
    opacities = np.array([0, 0, 0, 0, 255], np.uint8).reshape(1, 5, 1)
    picture = Picture(((5, 0, 0), (0, -1, 1)), opacities, Sampling.OPACITY, color=(1.0, 0.0, 0.0))
    flat = run(Drawing((painted_path(SQUARE, Paint.from_picture(picture)),)), Parameters("faces")).texture.flat
    programs, operations, _, number = flat[0].tolist()
    np.testing.assert_array_equal(flat[programs : programs + operations + number], words)


def places() -> dict[str, int]:
    """Return the texels of the file that damage is named by: the first operation of each sampling, and pixels."""
    _, (root,), words = decoder.read_ktx2(spline_file())
    begin, operations, stops, pixels = words[root["quad"] - 2].tolist()
    rows = [row for row in range(begin, begin + operations) if words[row, 3] >> 29 == 0]
    found = {f"sampling {words[row, 3]}": row for row in reversed(rows)}
    found |= {f"pixels {words[row, 3]}": row + words[row, 2] for row in rows}
    return found | {"end": begin + operations + stops + pixels}


def spoilt_file(place: str, texel: int, word: int, value: int) -> bytes:
    """Return the file with another value of a word."""
    data = spline_file()
    start = int.from_bytes(data[80:88], "little")
    texels = bytearray(zlib.decompress(data[start:]))
    struct.pack_into("<I", texels, 16 * (places()[place] + texel) + 4 * word, value)
    packed = zlib.compress(texels)
    return data[:88] + struct.pack("<Q", len(packed)) + data[96:start] + packed


BLOCKS = "pixels 3"
# The 6 x 5 opacities have levels of 3 x 3, 2 x 2 and 1 pixels: 4 + 1 + 1 + 1 blocks, so that the index is one texel,
# whose last 16 bits belong to none. The 7 x 5 colours have 4 x 3 texels.


@pytest.mark.parametrize(
    ("place", "texel", "word", "value"),
    [
        ("sampling 3", 0, 0, 65536),  # opacity
        ("sampling 3", 0, 1, 0x00050000),  # no columns
        ("sampling 3", 0, 1, 0x00000006),  # no rows
        ("sampling 3", 0, 1, 0x40010006),  # too many rows
        ("sampling 3", 0, 1, 0x00060006),  # not those of the other picture with these texels
        ("sampling 3", 0, 2, 0),  # no distance to the pixels
        ("sampling 3", 0, 2, 1),  # pixels in operations
        ("sampling 3", 0, 2, 0x80000000),  # pixels beyond the texture
        ("sampling 3", 0, 3, 5),  # sampling
        ("sampling 2", 0, 3, 3),  # of blocks, unlike the other picture with these texels
        ("sampling 3", 0, 3, 0x13),  # a bit that nothing names
        ("sampling 3", 1, 0, 0x7F800000),  # infinity
        ("sampling 3", 2, 1, 0x7FC00000),  # not a number
        ("sampling 3", 1, 3, 0xE1000000),  # a bit above the colour
        ("sampling 3", 1, 3, 0x00FFFFFF),  # another kind
        ("sampling 3", 2, 3, 0xE0000001),  # a colour in the third texel
        ("sampling 2", 1, 3, 0xE0000001),  # a colour of a spline of colours
        ("sampling 2", 2, 3, 0xE0000001),
        ("sampling 2", 0, 3, 0x12),  # a bit that nothing names
        (BLOCKS, 0, 3, 0x00010033),  # an entry of no block
        (BLOCKS, 0, 0, 0xFFFF004D),  # a block beyond the texels of pixels
        ("pixels 2", 0, 0, 0x10000020),  # red above the opacity
        ("pixels 2", 12, 1, 0x10200000),  # blue above the opacity, in a level
        ("pixels 2", 3, 1, 0x00000001),  # above the opacity, in a pixel that does not exist
    ],
)
def test_a_damaged_spline_is_refused(place: str, texel: int, word: int, value: int) -> None:
    data = spoilt_file(place, texel, word, value)
    with pytest.raises(ValueError, match="not a valid texture"):
        map_decoder.read_maps(data)
    with pytest.raises(FormatError):
        texture_from(data, "it")


@pytest.mark.parametrize(
    ("place", "texel", "word", "value"),
    [
        ("pixels 2", 3, 1, 0x10101010),  # a pixel that does not exist
        ("pixels 2", 12, 1, 0x10101010),  # a level that is not the mean
        (BLOCKS, 2, 3, 0x01020304),  # pixels of a block that do not exist
        (BLOCKS, 0, 0, 0x0101004D),  # a block of two entries, and one of none
    ],
)
def test_what_readers_need_not_check_is_read(place: str, texel: int, word: int, value: int) -> None:
    data = spoilt_file(place, texel, word, value)
    assert data != spline_file()
    map_decoder.read_maps(data)
    texture_from(data, "it")


@pytest.mark.parametrize("version", [b"2", b"4"])
def test_splines_raise_the_version(version: bytes) -> None:
    data = spline_file()
    assert data.count(b"vexture.version\x003") == 1
    data = data.replace(b"vexture.version\x003", b"vexture.version\x00" + version)
    with pytest.raises(ValueError, match="not a valid texture"):
        map_decoder.read_maps(data)
    with pytest.raises(FormatError):
        texture_from(data, "it")
