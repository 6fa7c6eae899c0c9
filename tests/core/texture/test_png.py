import io
import struct
import tracemalloc
import zlib
from collections.abc import Callable

import numpy as np
import png
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray
from PIL import Image

from vexture.base.errors import FormatError
from vexture.thesis.layout import FILE_LIMIT, LIST_LIMIT
from vexture.thesis.png import _filter_rows, read_png, write_png

TEXTS = {"vexture.version": "1", "vexture.crs": "RD new é"}
SHAPES = st.tuples(st.integers(1, 40), st.sampled_from([2, 4]), st.just(3))
PIXELS = hnp.arrays(np.uint8, SHAPES) | hnp.arrays(np.uint16, SHAPES)


def header(width: int = 4, height: int = 1, bits: int = 8, color: int = 2, interlace: int = 0) -> bytes:
    return struct.pack(">2I5B", width, height, bits, color, 0, 0, interlace)


def framed(*chunks: tuple[bytes, bytes]) -> bytes:
    out = io.BytesIO()
    png.write_chunks(out, chunks)
    return out.getvalue()


def image(head: bytes, raw: bytes, *others: tuple[bytes, bytes]) -> bytes:
    return framed((b"IHDR", head), *others, (b"IDAT", zlib.compress(raw)), (b"IEND", b""))


ROW = bytes(13)
GOOD = image(header(), ROW)


@given(PIXELS)
def test_round_trip(pixels: NDArray[np.uint8]) -> None:
    found, texts = read_png(write_png(pixels, TEXTS), pixels.shape[1], "x")
    assert found.dtype == pixels.dtype
    np.testing.assert_array_equal(found, pixels)
    assert texts == TEXTS


@given(PIXELS)
def test_pypng_reads_the_same(pixels: NDArray[np.uint8]) -> None:
    width, height, rows, told = png.Reader(bytes=write_png(pixels, TEXTS)).asDirect()
    assert (width, height, told["bitdepth"], told["planes"]) == (*pixels.shape[1::-1], 8 * pixels.itemsize, 3)
    np.testing.assert_array_equal(np.array([list(row) for row in rows]).reshape(pixels.shape), pixels)


@given(hnp.arrays(np.uint8, st.tuples(st.integers(1, 40), st.integers(1, 40), st.just(1))))
def test_pypng_reads_grey_the_same(pixels: NDArray[np.uint8]) -> None:
    width, height, rows, told = png.Reader(bytes=write_png(pixels, {})).read()
    assert (width, height, told["greyscale"], told["planes"]) == (*pixels.shape[1::-1], True, 1)
    np.testing.assert_array_equal(np.array([list(row) for row in rows]), pixels[..., 0])


@given(hnp.arrays(np.uint8, SHAPES))
def test_pillow_reads_8_bits_the_same_and_sees_the_texts(pixels: NDArray[np.uint8]) -> None:
    with Image.open(io.BytesIO(write_png(pixels, TEXTS))) as opened:
        assert opened.mode == "RGB"
        assert opened.text == TEXTS
        np.testing.assert_array_equal(np.asarray(opened), pixels)


def test_texts_beyond_latin_1() -> None:
    data = write_png(np.zeros((1, 4, 3), np.uint8), {"vexture.crs": "坐标系"})
    assert read_png(data, 4, "x")[1] == {"vexture.crs": "坐标系"}
    with Image.open(io.BytesIO(data)) as opened:
        assert opened.text == {"vexture.crs": "坐标系"}


@given(PIXELS)
def test_every_filter_says_the_same(pixels: NDArray[np.uint8]) -> None:
    height, width, _ = pixels.shape
    for kind, raw in enumerate(_filter_rows(pixels)):
        assert set(raw[:: len(raw) // height]) == {kind}
        found = read_png(image(header(width, height, 8 * pixels.itemsize), raw), width, "x")[0]
        np.testing.assert_array_equal(found, pixels)


@pytest.mark.parametrize("kind", ["along", "down", "noise", "steps"])
def test_the_smallest_is_written(kind: str) -> None:
    rows, cells = np.mgrid[0:200, 0:4]
    random = np.random.default_rng(1)
    plane = {
        "along": cells * 40 + rows * rows,
        "down": rows * 3 + cells * 77,
        "noise": random.integers(0, 255, rows.shape),
        "steps": random.integers(0, 2, rows.shape).cumsum(axis=0),
    }[kind]
    pixels = np.repeat((plane % 251).astype(np.uint8)[:, :, None], 3, axis=2)
    others = [image(header(height=200), raw) for raw in _filter_rows(pixels)]
    assert len(write_png(pixels, {})) <= min(map(len, others))
    for other in others:
        np.testing.assert_array_equal(read_png(other, 4, "x")[0], pixels)


BAD: dict[str, tuple[bytes, str]] = {
    "empty": (b"", "damaged"),
    "text": (b"hello, world", "signature"),
    "no chunks": (GOOD[:8], "damaged"),
    "no end": (GOOD[:-12], "damaged"),
    "wrong checksum": (GOOD[:30] + bytes([GOOD[30] ^ 1]) + GOOD[31:], "damaged"),
    "first chunk is no header": (framed((b"IDAT", b""), (b"IEND", b"")), "header"),
    "short header": (framed((b"IHDR", header()[:-1]), (b"IEND", b"")), "header"),
    "two headers": (image(header(), ROW, (b"IHDR", header(height=9))), "header"),
    "no data": (framed((b"IHDR", header()), (b"IEND", b"")), "13 bytes"),
    "grey": (image(header(color=0), ROW), "colour type 0"),
    "with alpha": (image(header(color=6), ROW), "colour type 6"),
    "4 bits": (image(header(bits=4), ROW), "4 bits"),
    "interlaced": (image(header(interlace=1), ROW), "interlace 1"),
    "wide": (image(header(width=5), ROW), "5 x 1"),
    "no rows": (image(header(height=0), b""), "4 x 0"),
    "60000 x 60000": (image(header(60_000, 60_000), ROW), "60000 x 60000"),
    "8 bits too high": (image(header(height=257), 257 * ROW), "1 to 256"),
    "16 bits too high": (image(header(height=LIST_LIMIT[16] + 1, bits=16), b""), "1 to 65000"),
    "too few data": (image(header(height=2), ROW), "26 bytes"),
    "too many data": (image(header(), ROW + b"\0"), "13 bytes"),
    "not deflated": (framed((b"IHDR", header()), (b"IDAT", b"abc"), (b"IEND", b"")), "damaged"),
    "no adler": (framed((b"IHDR", header()), (b"IDAT", zlib.compress(ROW)[:-2]), (b"IEND", b"")), "13 bytes"),
    "filter 7": (image(header(), b"\7" + bytes(12)), "damaged"),
    "text not utf-8": (image(header(), ROW, (b"iTXt", b"vexture.crs\0\0\0\0\0\xff")), "damaged"),
    "long": (GOOD + bytes(FILE_LIMIT), "longer than"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_refused_in_one_line(name: str) -> None:
    data, expected = BAD[name]
    with pytest.raises(FormatError, match=expected) as caught:
        read_png(data, 4, "folder/name.quads.png")
    message = str(caught.value)
    assert message.startswith("folder/name.quads.png: ")
    assert "convert" in message
    assert "\n" not in message


def test_other_chunks_are_ignored() -> None:
    data = image(header(), ROW, (b"gAMA", b"\0\0\xb1\x8f"), (b"pHYs", b"x"), (b"PLTE", bytes(4)), (b"abCd", b"?"))
    assert read_png(data, 4, "x")[0].shape == (1, 4, 3)


def split(raw: bytes) -> bytes:
    deflated = zlib.compress(raw)
    return framed((b"IHDR", header()), (b"IDAT", deflated[:5]), (b"IDAT", deflated[5:]), (b"IEND", b""))


def deflate_bomb(raw: bytes) -> bytes:
    return image(header(), raw)


@pytest.mark.parametrize("write", [split, deflate_bomb])
def test_a_bomb_is_not_inflated(write: Callable[[bytes], bytes]) -> None:
    bomb = write(bytes(60_000_000))
    assert len(bomb) < FILE_LIMIT
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match="13 bytes"):
            read_png(bomb, 4, "bomb")
        assert tracemalloc.get_traced_memory()[1] < 4 * len(bomb)
    finally:
        tracemalloc.stop()


def test_data_in_several_chunks() -> None:
    assert read_png(split(ROW), 4, "x")[0].shape == (1, 4, 3)
