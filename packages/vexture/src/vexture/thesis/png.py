"""Write compact PNG files with text chunks; read RGB images and their texts from untrusted files."""

import io
import struct
import zlib
from typing import Any

import numpy as np
import png
from numpy.typing import NDArray

from vexture.base.errors import FormatError
from vexture.thesis.layout import FILE_LIMIT, LIST_LIMIT

HEADER = struct.Struct(">2I5B")
RGB = 2  # colour type
CHANNELS = 3
COLOUR_TYPES = {1: 0, CHANNELS: RGB}


def write_png(pixels: NDArray[Any], texts: dict[str, str]) -> bytes:
    """Write a PNG, RGB or grey: (height, width, 3) or (height, width, 1) uint8 or uint16.

    The filter, one for all rows, and the deflate strategy are those of the smallest file. The keywords of the texts are
    Latin-1.

    Examples
    --------
    >>> read_png(write_png(np.zeros((1, 2, 3), np.uint8), {"vexture.crs": "EPSG:28992"}), 2, "zeros")
    (array([[[0, 0, 0], [0, 0, 0]]], dtype=uint8), {'vexture.crs': 'EPSG:28992'})
    """
    height, width, channels = pixels.shape
    header = HEADER.pack(width, height, 8 * pixels.dtype.itemsize, COLOUR_TYPES[channels], 0, 0, 0)
    images = _filter_rows(pixels)
    deflated = [_deflate(image, zlib.Z_DEFAULT_STRATEGY) for image in images]
    smallest = images[deflated.index(min(deflated, key=len))]
    data = min(*deflated, _deflate(smallest, zlib.Z_FILTERED), _deflate(smallest, zlib.Z_RLE), key=len)
    return _write_chunks((b"IHDR", header), *(_text_chunk(key, value) for key, value in texts.items()), (b"IDAT", data))


def _write_chunks(*chunks: tuple[bytes, bytes]) -> bytes:
    out = io.BytesIO()
    png.write_chunks(out, (*chunks, (b"IEND", b"")))
    return out.getvalue()


def _deflate(image: bytes, strategy: int) -> bytes:
    """Deflate at zlib's default level: level 9 saves at most 0.3% and takes ten times as long for the longest lists."""
    stream = zlib.compressobj(strategy=strategy)
    return stream.compress(image) + stream.flush()


def _filter_rows(pixels: NDArray[Any]) -> list[bytes]:
    """Filter image bytes by None, Sub and Up (PNG specification, 9.2), with a filter byte for each row.

    The filters Average and Paeth make none of our textures smaller.
    """
    height, width, channels = pixels.shape
    step = channels * pixels.dtype.itemsize
    raw = pixels.astype(pixels.dtype.newbyteorder(">")).view(np.uint8).reshape(height, width * step)
    images = np.zeros((3, height, 1 + width * step), np.uint8)
    images[:, :, 0] = np.arange(3)[:, None]
    images[:, :, 1:] = raw
    images[1, :, 1 + step :] -= raw[:, :-step]  # modulo 256, as specified
    images[2, 1:, 1:] -= raw[:-1]
    return [image.tobytes() for image in images]


def _text_chunk(key: str, value: str) -> tuple[bytes, bytes]:
    keyword = key.encode("latin-1")
    try:
        return b"tEXt", keyword + b"\0" + value.encode("latin-1")
    except UnicodeEncodeError:
        return b"iTXt", keyword + b"\0\0\0\0\0" + value.encode()


def read_png(data: bytes, width: int, name: str) -> tuple[NDArray[Any], dict[str, str]]:
    """Read pixels (height, width, 3), uint8 or uint16, and texts of an untrusted PNG; `name` is its name in messages.

    The header limits all memory that is allocated, and the format limits the header. The texts of tEXt and uncompressed
    iTXt chunks are keyed by keyword.

    Raises
    ------
    FormatError
        If the file is damaged, or is not an RGB image of 8 or 16 bits and this width without interlacing.
    """
    if len(data) > FILE_LIMIT:
        raise FormatError(f"{name}: longer than {FILE_LIMIT} bytes, so not a texture; convert the drawing again")
    try:
        chunks = list(png.Reader(bytes=data).chunks())
        height, bits = _read_header(chunks, width, name)
        if chunks[-1] != (b"IEND", b""):
            raise png.FormatError("its last chunk is no end")
        deflated = b"".join(body for tag, body in chunks if tag == b"IDAT")
        _check_inflated(deflated, width, height, bits)
        rows = png.Reader(bytes=_write_chunks(chunks[0], (b"IDAT", deflated))).read()[2]  # no other programs' chunks
        image = np.frombuffer(b"".join(bytes(row) for row in rows), np.uint8 if bits == 8 else np.uint16)
        return image.reshape(height, width, CHANNELS), _read_texts(chunks)
    except (png.Error, zlib.error, EOFError, UnicodeDecodeError) as error:
        raise FormatError(f"{name}: damaged PNG ({error}); convert the drawing again") from None


def _read_header(chunks: list[tuple[bytes, bytes]], width: int, name: str) -> tuple[int, int]:
    """Check the header; return height and bits per channel."""
    (tag, body), *others = chunks
    if tag != b"IHDR" or len(body) != HEADER.size or b"IHDR" in dict(others):
        raise png.FormatError("its first chunk is not the only header")
    found_width, height, bits, color, _, _, interlace = HEADER.unpack(body)
    if color != RGB or bits not in LIST_LIMIT or interlace:
        raise FormatError(
            f"{name}: colour type {color}, {bits} bits, interlace {interlace}; a texture is RGB (type {RGB}), "
            "8 or 16 bits, not interlaced; convert the drawing again"
        )
    if found_width != width or not 1 <= height <= LIST_LIMIT[bits]:
        raise FormatError(
            f"{name}: {found_width} x {height} pixels; a texture of {bits} bits is {width} wide and "
            f"1 to {LIST_LIMIT[bits]} high; convert the drawing again"
        )
    return height, bits


def _check_inflated(data: bytes, width: int, height: int, bits: int) -> None:
    """Raise an error if image data do not inflate to the header's size; inflate at most that much."""
    size = height * (1 + width * CHANNELS * bits // 8)
    stream = zlib.decompressobj()
    if len(stream.decompress(data, size + 1)) != size or not stream.eof:
        raise png.FormatError(f"its image data are not {size} bytes long")


def _read_texts(chunks: list[tuple[bytes, bytes]]) -> dict[str, str]:
    texts = {}
    for tag, body in chunks:
        keyword, _, value = body.partition(b"\0")
        if tag == b"tEXt":
            texts[keyword.decode("latin-1")] = value.decode("latin-1")
        elif tag == b"iTXt" and value[:1] == b"\0":  # not compressed
            texts[keyword.decode("latin-1")] = value[2:].split(b"\0", 2)[-1].decode()
    return texts
