"""One image of four unsigned 32-bit words to a texel, with texts, to KTX 2.0 and back; safe to read from strangers.

The container is that of the Khronos KTX File Format Specification, version 2.0, its description of the words that of
the Khronos Data Format Specification, version 1.3.
"""

import struct
import zlib
from contextlib import suppress
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.errors import FormatError
from vexture.layout import MOST_ROWS, MOST_TEXT_BYTES, ROW_BITS

__all__ = ["MAGIC", "TEXEL_BYTES", "read_ktx2", "write_ktx2"]

MAGIC: Final = b"\xabKTX 20\xbb\r\n\x1a\n"

R32G32B32A32_UINT: Final = 107
"""VkFormat."""

NONE: Final = 0
ZLIB: Final = 3
"""Supercompression schemes."""

WORD_BYTES: Final = 4
CHANNELS: Final = 4
TEXEL_BYTES: Final = CHANNELS * WORD_BYTES
ALPHA: Final = 15
"""Number of the alpha channel in a data format descriptor; red, green and blue are 0, 1 and 2."""

HEADER: Final = struct.Struct("<12s9I4I2Q")
LEVEL: Final = struct.Struct("<3Q")
LENGTH: Final = struct.Struct("<I")

DEFLATE_RATIO: Final = 1032
"""Bytes that one byte of a deflate stream can become at most (zlib's technical details)."""

REMEDY: Final = "convert the drawing again"


class Header(NamedTuple):
    """The file's header, as the specification names its fields."""

    identifier: bytes
    vk_format: int
    type_size: int
    width: int
    height: int
    depth: int
    layers: int
    faces: int
    levels: int
    scheme: int
    dfd_offset: int
    dfd_length: int
    kvd_offset: int
    kvd_length: int
    sgd_offset: int
    sgd_length: int


def _descriptor() -> bytes:
    """Return the data format descriptor: one basic block, four unsigned integers of 32 bits."""
    samples = b"".join(
        struct.pack("<HBB4B2I", 8 * WORD_BYTES * k, 8 * WORD_BYTES - 1, channel, 0, 0, 0, 0, 0, 1)
        for k, channel in enumerate((0, 1, 2, ALPHA))
    )
    version, rgbsda, bt709, linear = 2, 1, 1, 1
    size = 24 + len(samples)
    head = struct.pack("<I2H4B4B8B", 0, version, size, rgbsda, bt709, linear, 0, 0, 0, 0, 0, TEXEL_BYTES, *bytes(7))
    return LENGTH.pack(LENGTH.size + size) + head + samples


def write_ktx2(texels: NDArray[np.uint32], texts: dict[str, str]) -> bytes:
    """Write a KTX 2.0 file with supercompression ZLIB.

    Parameters
    ----------
    texels : (rows, width, 4) uint32 array
    texts : dict
        Keys and their values; stored as UTF-8 that ends with a zero byte.

    Examples
    --------
    >>> data = write_ktx2(np.ones((1, 2, 4), np.uint32), {"KTXwriter": "an example"})
    >>> read_ktx2(data, "ones")[1]
    {'KTXwriter': 'an example'}
    """
    height, width, _ = texels.shape
    raw = np.ascontiguousarray(texels, "<u4").tobytes()
    deflated = zlib.compress(raw, 4)  # level 6 saves 0.2% and takes 1.6 times as long: of a map, most of its conversion
    descriptor, pairs = _descriptor(), _key_values(texts)
    dfd_offset = HEADER.size + LEVEL.size
    kvd_offset = dfd_offset + len(descriptor)
    image_offset = kvd_offset + len(pairs)
    header = Header(
        MAGIC, R32G32B32A32_UINT, WORD_BYTES, width, height, 0, 0, 1, 1, ZLIB,
        dfd_offset, len(descriptor), kvd_offset if pairs else 0, len(pairs), 0, 0,
    )  # fmt: skip
    level = LEVEL.pack(image_offset, len(deflated), len(raw))
    return HEADER.pack(*header) + level + descriptor + pairs + deflated


def _key_values(texts: dict[str, str]) -> bytes:
    """Return the key/value data: sorted by key, each padded to four bytes."""
    pairs = b""
    for key, value in sorted((key.encode(), value.encode()) for key, value in texts.items()):
        pair = key + b"\0" + value + b"\0"
        pairs += LENGTH.pack(len(pair)) + pair + bytes(-len(pair) % LENGTH.size)
    return pairs


def read_ktx2(data: bytes, where: str) -> tuple[NDArray[np.uint32], dict[str, str]]:
    """Texels and texts of a KTX 2.0 file that a stranger may have written.

    Everything that costs memory is bounded by the header, and the header by the format's limits.

    Parameters
    ----------
    data : bytes
        The file.
    where : str
        Names the file in messages.

    Returns
    -------
    texels : (rows, width, 4) uint32 array
    texts : dict
        Values by key, without the zero byte at their end; those that are not UTF-8 are left out.

    Raises
    ------
    FormatError
        If it is damaged or anything else than one image of R32G32B32A32_UINT, deflated or plain.
    """
    try:
        header = _read_header(data)
        if header.dfd_length:
            _read_descriptor(_part(data, header.dfd_offset, header.dfd_length, "data format descriptor"))
        texts = _read_texts(_part(data, header.kvd_offset, header.kvd_length, "key/value data"))
        return _read_image(data, header), texts
    except FormatError as error:
        raise FormatError(f"{where}: {error}") from None


def _part(data: bytes, offset: int, length: int, what: str) -> bytes:
    """Bytes of the file, if it has so many."""
    if length and not HEADER.size <= offset <= len(data) - length:
        raise FormatError(
            f"{what} at bytes {offset} to {offset + length} of a file of {len(data)}; it is damaged; {REMEDY}"
        )
    return data[offset : offset + length]


def _read_header(data: bytes) -> Header:
    if data[: len(MAGIC)] != MAGIC:
        raise FormatError(f"begins with {data[: len(MAGIC)]!r}; a packed texture is a KTX 2.0 file; {REMEDY}")
    if len(data) < HEADER.size + LEVEL.size:
        raise FormatError(f"{len(data)} bytes; the header alone has {HEADER.size + LEVEL.size}; {REMEDY}")
    header = Header(*HEADER.unpack_from(data))
    for what, value, allowed in (
        ("vkFormat", header.vk_format, (R32G32B32A32_UINT,)),
        ("typeSize", header.type_size, (WORD_BYTES,)),
        ("pixelDepth", header.depth, (0,)),
        ("layerCount", header.layers, (0,)),
        ("faceCount", header.faces, (1,)),
        ("levelCount", header.levels, (1, 0)),
        ("supercompressionScheme", header.scheme, (ZLIB, NONE)),
        ("sgdByteLength", header.sgd_length, (0,)),
    ):
        if value not in allowed:
            raise FormatError(f"{what} is {value}; it must be {' or '.join(map(str, allowed))}; {REMEDY}")
    widest = 1 << ROW_BITS
    narrow = header.width.bit_count() == 1 and header.width <= widest
    if not narrow or not 1 <= header.height <= (MOST_ROWS if header.width == widest else 1):
        raise FormatError(
            f"{header.width} x {header.height} texels; a texture is {widest} wide and 1 to {MOST_ROWS} high, "
            f"or one row of a smaller power of two; {REMEDY}"
        )
    if header.kvd_length > MOST_TEXT_BYTES:
        raise FormatError(f"{header.kvd_length} bytes of key/value data; the limit is {MOST_TEXT_BYTES}; {REMEDY}")
    return header


def _read_descriptor(descriptor: bytes) -> None:
    """Refuse a description that contradicts the header; other writers may word the same one differently."""
    total = LENGTH.unpack_from(descriptor)[0] if len(descriptor) >= LENGTH.size else 0
    if total != len(descriptor) or total % LENGTH.size:
        raise FormatError(f"the data format descriptor says {total} bytes and has {len(descriptor)}; {REMEDY}")


def _read_texts(pairs: bytes) -> dict[str, str]:
    texts: dict[str, str] = {}
    met: set[bytes] = set()
    at = 0
    while at < len(pairs):
        length = LENGTH.unpack_from(pairs, at)[0] if at + LENGTH.size <= len(pairs) else 0
        at += LENGTH.size
        key, zero, value = pairs[at : at + length].partition(b"\0")
        if not key or not zero or at + length > len(pairs):
            raise FormatError(f"key/value data are damaged at byte {at} of {len(pairs)}; {REMEDY}")
        if key in met:
            raise FormatError(f"key {key[:40]!r} is there twice; each may be there once; {REMEDY}")
        met.add(key)
        with suppress(UnicodeDecodeError):  # other writers may store anything under their own keys
            texts[key.decode()] = value.removesuffix(b"\0").decode()
        at += length + -length % LENGTH.size
    return texts


def _read_image(data: bytes, header: Header) -> NDArray[np.uint32]:
    offset, length, inflated = LEVEL.unpack_from(data, HEADER.size)
    size = header.width * header.height * TEXEL_BYTES
    stored = _part(data, offset, length, "image")
    if header.scheme == NONE:
        raw = stored
    else:
        if inflated != size:
            raise FormatError(f"uncompressedByteLength is {inflated}; the size in texels makes it {size}; {REMEDY}")
        if size > DEFLATE_RATIO * (length + 1):
            raise FormatError(f"{length} bytes of image; they cannot inflate to {size}; {REMEDY}")
        raw = _inflate(stored, size)
    if len(raw) != size:
        raise FormatError(f"the image has {len(raw)} bytes; its size in texels makes it {size}; {REMEDY}")
    # a copy, which can be written to: kernels are compiled for such arrays, as a conversion makes them
    texels = np.frombuffer(raw, "<u4").astype(np.uint32)
    return texels.reshape(header.height, header.width, CHANNELS)


def _inflate(stored: bytes, size: int) -> bytes:
    """Inflate to `size` bytes, and never to more."""
    stream = zlib.decompressobj()
    try:
        raw = stream.decompress(stored, size + 1)
    except zlib.error as error:
        raise FormatError(f"the image cannot be inflated ({error}); {REMEDY}") from None
    if len(raw) == size and (not stream.eof or stream.unused_data):
        raise FormatError(f"the image's {len(stored)} bytes do not end where they should; {REMEDY}")
    return raw
