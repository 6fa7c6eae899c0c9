"""Write and read KTX 2.0: one image of four unsigned 32-bit words per texel, with texts; files are validated.

The container follows the Khronos KTX File Format Specification, version 2.0. The descriptor of the words follows the
Khronos Data Format Specification, version 1.3.
"""

import struct
import zlib
from collections.abc import Mapping
from contextlib import suppress
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import FormatError
from vexture.base.layout import MOST_ROWS, MOST_TEXT_BYTES, ROW_BITS

MAGIC: Final = b"\xabKTX 20\xbb\r\n\x1a\n"

R32G32B32A32_UINT: Final = 107
"""The VkFormat of a texture."""

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
"""Most bytes that one byte of a deflate stream can inflate to (zlib's technical details)."""


class Ktx2Header(NamedTuple):
    """Header of the file; fields are named as in the specification."""

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


def check_size(width: int, rows: int) -> None:
    """Raise a `FormatError` if a texture cannot have this size in texels."""
    widest = 1 << ROW_BITS
    if width.bit_count() != 1 or width > widest or not 1 <= rows <= (MOST_ROWS if width == widest else 1):
        raise FormatError(
            f"{width} x {rows} texels; a texture is {widest} wide and 1 to {MOST_ROWS} high, "
            "or one row of a smaller power of two"
        )


def _descriptor() -> bytes:
    """Data format descriptor: one basic block of four unsigned integers of 32 bits."""
    samples = b"".join(
        struct.pack("<HBB4B2I", 8 * WORD_BYTES * k, 8 * WORD_BYTES - 1, channel, 0, 0, 0, 0, 0, 1)
        for k, channel in enumerate((0, 1, 2, ALPHA))
    )
    version, rgbsda, bt709, linear = 2, 1, 1, 1
    size = 24 + len(samples)
    head = struct.pack("<I2H4B4B8B", 0, version, size, rgbsda, bt709, linear, 0, 0, 0, 0, 0, TEXEL_BYTES, *bytes(7))
    return LENGTH.pack(LENGTH.size + size) + head + samples


def write_ktx2(texels: NDArray[np.uint32], texts: Mapping[str, str | bytes], deflate: bool = True) -> bytes:
    """Return a KTX 2.0 file of texels (rows, width, 4), deflated or not; texts are stored as UTF-8 with a zero byte."""
    height, width, _ = texels.shape
    raw = np.ascontiguousarray(texels, "<u4").tobytes()
    # level 6 saves 0.2% but takes 1.6 times as long, and deflating is most of a map's conversion
    stored = zlib.compress(raw, 4) if deflate else raw
    descriptor, pairs = _descriptor(), _key_values(texts)
    dfd_offset = HEADER.size + LEVEL.size
    kvd_offset = dfd_offset + len(descriptor)
    image_offset = kvd_offset + len(pairs)
    header = Ktx2Header(
        MAGIC, R32G32B32A32_UINT, WORD_BYTES, width, height, 0, 0, 1, 1, ZLIB if deflate else NONE,
        dfd_offset, len(descriptor), kvd_offset if pairs else 0, len(pairs), 0, 0,
    )  # fmt: skip
    level = LEVEL.pack(image_offset, len(stored), len(raw))
    return HEADER.pack(*header) + level + descriptor + pairs + stored


def _key_values(texts: Mapping[str, str | bytes]) -> bytes:
    """Key/value data, sorted by key, each pair padded to four bytes."""
    pairs = b""
    for key, value in sorted((key.encode(), value) for key, value in texts.items()):
        pair = key + b"\0" + (value if isinstance(value, bytes) else value.encode() + b"\0")
        pairs += LENGTH.pack(len(pair)) + pair + bytes(-len(pair) % LENGTH.size)
    return pairs


def read_ktx2(data: bytes, name: str) -> tuple[NDArray[np.uint32], dict[str, str]]:
    """Read texels (rows, width, 4) and texts of an untrusted KTX 2.0 file; `name` is its name in messages.

    The header limits all memory that is allocated, and the format limits the header. Texts lose their final zero byte;
    texts that are not UTF-8 are left out. Raises a `FormatError` if the file is damaged, or is not one image of
    R32G32B32A32_UINT, deflated or not.
    """
    try:
        header = _read_header(data)
        if header.dfd_length:
            _read_descriptor(_part(data, header.dfd_offset, header.dfd_length, "data format descriptor"))
        texts = _read_texts(_part(data, header.kvd_offset, header.kvd_length, "key/value data"))
        return _read_image(data, header), texts
    except FormatError as error:
        raise FormatError(f"{name}: {error}; convert the drawing again") from None


def _part(data: bytes, offset: int, length: int, label: str) -> bytes:
    """Part of the file; raises a `FormatError` if it lies outside the file."""
    if length and not HEADER.size <= offset <= len(data) - length:
        raise FormatError(f"{label} at bytes {offset} to {offset + length} of a file of {len(data)}; it is damaged")
    return data[offset : offset + length]


def _read_header(data: bytes) -> Ktx2Header:
    if not data:
        raise FormatError("it is empty")
    if data[: len(MAGIC)] != MAGIC:
        raise FormatError(f"begins with {data[: len(MAGIC)]!r}; a packed texture is a KTX 2.0 file")
    if len(data) < HEADER.size + LEVEL.size:
        raise FormatError(f"{len(data)} bytes; the header alone has {HEADER.size + LEVEL.size}")
    header = Ktx2Header(*HEADER.unpack_from(data))
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
            raise FormatError(f"{what} is {value}; it must be {' or '.join(map(str, allowed))}")
    check_size(header.width, header.height)
    if header.kvd_length > MOST_TEXT_BYTES:
        raise FormatError(f"{header.kvd_length} bytes of key/value data; the limit is {MOST_TEXT_BYTES}")
    return header


def _read_descriptor(descriptor: bytes) -> None:
    """Check only the length of the descriptor: other writers may describe the same words differently."""
    total = LENGTH.unpack_from(descriptor)[0] if len(descriptor) >= LENGTH.size else 0
    if total != len(descriptor) or total % LENGTH.size:
        raise FormatError(f"the data format descriptor says {total} bytes and has {len(descriptor)}")


def read_value(data: bytes, key: str) -> bytes | None:
    """Return a key's binary value, from a file that `read_ktx2` has validated; None if the key is missing."""
    header = _read_header(data)
    pairs = _part(data, header.kvd_offset, header.kvd_length, "key/value data")
    return _read_values(pairs).get(key.encode())


def _read_texts(pairs: bytes) -> dict[str, str]:
    texts: dict[str, str] = {}
    for key, value in _read_values(pairs).items():
        with suppress(UnicodeDecodeError):  # other writers may store any bytes under their own keys
            texts[key.decode()] = value.removesuffix(b"\0").decode()
    return texts


def _read_values(pairs: bytes) -> dict[bytes, bytes]:
    values: dict[bytes, bytes] = {}
    at = 0
    while at < len(pairs):
        length = LENGTH.unpack_from(pairs, at)[0] if at + LENGTH.size <= len(pairs) else 0
        at += LENGTH.size
        key, zero, value = pairs[at : at + length].partition(b"\0")
        if not key or not zero or at + length > len(pairs):
            raise FormatError(f"key/value data are damaged at byte {at} of {len(pairs)}")
        if key in values:
            raise FormatError(f"key {key[:40]!r} is there twice; each may be there once")
        values[key] = value
        at += length + -length % LENGTH.size
    return values


def _read_image(data: bytes, header: Ktx2Header) -> NDArray[np.uint32]:
    offset, length, said = LEVEL.unpack_from(data, HEADER.size)
    size = header.width * header.height * TEXEL_BYTES
    stored = _part(data, offset, length, "image")
    if header.scheme == NONE:
        raw = stored
    else:
        if said != size:
            raise FormatError(f"uncompressedByteLength is {said}; the size in texels makes it {size}")
        raw = inflate(stored, size, "image")
    if len(raw) != size:
        raise FormatError(f"the image has {len(raw)} bytes; its size in texels makes it {size}")
    # a writable copy, as a conversion makes: kernels are compiled for such arrays
    texels = np.frombuffer(raw, "<u4").astype(np.uint32)
    return texels.reshape(header.height, header.width, CHANNELS)


def inflate(stored: bytes, size: int, label: str) -> bytes:
    """Inflate to at most `size` bytes; raise a `FormatError` with `label` if the data are damaged."""
    if size > DEFLATE_RATIO * (len(stored) + 1):
        raise FormatError(f"{len(stored)} bytes of {label}; they cannot inflate to {size}")
    stream = zlib.decompressobj()
    try:
        raw = stream.decompress(stored, size + 1)
    except zlib.error as error:
        raise FormatError(f"the {label} cannot be inflated ({error})") from None
    if len(raw) == size and (not stream.eof or stream.unused_data):
        raise FormatError(f"the {len(stored)} bytes of {label} do not end where they should")
    return raw
