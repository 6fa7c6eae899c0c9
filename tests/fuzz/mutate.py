"""Damage to files: bytes, tokens and numbers; and repairs, so that what a checksum guards is reached."""

import re
import struct
import zlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from random import Random

MOST_BYTES = 1 << 17
"""Of an input: faults of reading show in small files, and small files are read more often in a second."""

NUMBER = re.compile(rb"-?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
NUMBERS = (
    b"0 -0 1 -1 0.5 2 3 7 15 16 17 255 256 65535 65536 2147483647 -2147483648 4294967295 4294967296 1e-320 1e-12 "
    b"-1e-6 1e-300 1e9 1e12 -1e12 1e15 1e39 1e154 1e300 -1e308 1e309 nan inf 00000 1e 1.e1 0x10 9007199254740993"
).split()
EDGES = (0, 1, 2, 4, 0x7F, 0x80, 0xFF, 0x100, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
LARGEST_WORD = {1: 0xFF, 2: 0xFFFF, 4: 0xFFFFFFFF, 8: 0xFFFFFFFFFFFFFFFF}

Change = Callable[[Random, bytearray, Sequence[bytes], Sequence[bytes]], None]


def _place(rng: Random, data: bytearray, most: int = 64) -> slice:
    """A random range, more often a short one."""
    at = rng.randrange(len(data) + 1)
    return slice(at, min(at + rng.randrange(rng.choice((2, 8, most))), len(data)))


def _flip(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    if data:
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)


def _word(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    size = rng.choice((1, 2, 4, 4, 8))
    if len(data) >= size:
        at, order = rng.randrange(len(data) - size + 1), rng.choice(("little", "big"))
        old = int.from_bytes(data[at : at + size], order)
        new = rng.choice((rng.choice(EDGES), old + rng.choice((-1, 1, 16, -16)), rng.getrandbits(8 * size), -1))
        data[at : at + size] = (new & LARGEST_WORD[size]).to_bytes(size, order)


def _token(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    place = _place(rng, data, 16)
    data[place if rng.random() < 0.5 else slice(place.start, place.start)] = rng.choice(tokens or NUMBERS)


def _number(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    match = NUMBER.search(data, rng.randrange(len(data) + 1))
    if match:
        data[slice(*match.span())] = rng.choice((rng.choice(NUMBERS), b"%r" % rng.uniform(-9, 99), match[0] + b"0"))


def _remove(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    del data[_place(rng, data)]


def _repeat(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    place = _place(rng, data)
    data[place.start : place.start] = data[place] * rng.choice((1, 1, 1, 2, 9, 300))


def _splice(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    other = bytearray(rng.choice(seeds))
    data[_place(rng, data, 4096)] = other[_place(rng, other, 4096)]


def _cut(rng: Random, data: bytearray, tokens: Sequence[bytes], seeds: Sequence[bytes]) -> None:
    del data[rng.randrange(len(data) + 1) :]


BINARY: tuple[Change, ...] = (_flip, _flip, _word, _word, _word, _token, _remove, _repeat, _splice, _cut)
TEXT: tuple[Change, ...] = (_flip, _token, _token, _token, _number, _number, _remove, _repeat, _splice, _cut)


def mutate_seed(rng: Random, seeds: Sequence[bytes], tokens: Sequence[bytes], text: bool) -> bytes:
    """One of the seeds with one to eight random changes."""
    data = bytearray(rng.choice(seeds))
    for _ in range(rng.choice((1, 1, 2, 3, 5, 8))):
        change = rng.choice(TEXT if text else BINARY)
        change(rng, data, tokens, seeds)
        if len(data) > MOST_BYTES:
            break
    return bytes(data[:MOST_BYTES])


def png_repaired(data: bytes) -> bytes:
    """PNG files, one after the other, with checksums that are right and image data that can be inflated."""
    signature = b"\x89PNG\r\n\x1a\n"
    files = data.split(signature)
    return files[0] + b"".join(signature + _chunks_repaired(file) for file in files[1:])


def _chunks_repaired(data: bytes) -> bytes:
    out, at = b"", 0
    while at + 8 <= len(data):
        length, tag = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + length]
        if tag == b"IDAT":
            with suppress(zlib.error):
                body = zlib.compress(zlib.decompressobj(-15).decompress(body[2:], MOST_BYTES), 1)
        out += struct.pack(">I4s", len(body), tag) + body + struct.pack(">I", zlib.crc32(tag + body))
        at += 12 + length
    return out


def zip_repaired(data: bytes) -> bytes:
    """A zip whose members are stored, with their checksums right in both places."""
    fixed = bytearray(data)
    for match in re.finditer(rb"PK\x01\x02", data):
        at = match.start()
        if at + 46 <= len(data):
            (size,), (local,) = struct.unpack_from("<I", data, at + 20), struct.unpack_from("<I", data, at + 42)
            if data[local : local + 4] == b"PK\x03\x04" and local + 30 <= len(data):
                start = local + 30 + sum(struct.unpack_from("<2H", data, local + 26))
                checksum = struct.pack("<I", zlib.crc32(data[start : start + size]))
                fixed[at + 16 : at + 20] = fixed[local + 14 : local + 18] = checksum
    return bytes(fixed)
