"""A decoder of packed textures written from FORMAT.md, part B, alone: it shares no code with the package."""

import json
import re
import struct
import zlib
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

import degenerate
from both_encodings import encode
from vexture.drawing.drawing import Drawing
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.tree.build import build_tree

TEXT = (Path(__file__).parents[3] / "FORMAT.md").read_text(encoding="utf-8")
TRIANGLE = Drawing.polygon([(0.125, 0.125), (0.875, 0.125), (0.125, 0.875)])
DEFLATED_LENGTH = slice(88, 96)  # in the level index; depends on the deflater
UNIT = 32768

Point = tuple[int, int]


class File(NamedTuple):
    """Texels in rows, and texts."""

    rows: list[list[tuple[int, ...]]]
    texts: dict[str, str]

    def texel(self, index: int) -> tuple[int, ...]:
        return self.rows[index >> 11][index & 2047]


def read(data: bytes) -> File:
    assert data[:12] == b"\xabKTX 20\xbb\r\n\x1a\n"
    vk, size, width, height, depth, layers, faces, levels, scheme = struct.unpack_from("<9I", data, 12)
    assert (vk, size, depth, layers, faces, levels, scheme) == (107, 4, 0, 0, 1, 1, 3)
    _, _, at, length = struct.unpack_from("<4I", data, 48)
    texts = {}
    end = at + length
    while at < end:
        (length,) = struct.unpack_from("<I", data, at)
        key, _, value = data[at + 4 : at + 4 + length].partition(b"\0")
        texts[key.decode()] = value.removesuffix(b"\0").decode()
        at += 4 + -(-length // 4) * 4
    offset, length, inflated = struct.unpack_from("<3Q", data, 80)
    raw = zlib.decompress(data[offset : offset + length])
    assert len(raw) == inflated == 16 * width * height
    texels = list(struct.iter_unpack("<4I", raw))
    return File([texels[row * width : (row + 1) * width] for row in range(height)], texts)


def points(texel: tuple[int, ...]) -> list[Point]:
    offsets = (0, 16384, 16384, 0)
    return [((word & 0xFFFF) - offset, (word >> 16) - offset) for word, offset in zip(texel, offsets, strict=True)]


def at_or_left(curve: list[Point], x: Fraction, y: Fraction) -> bool:
    """Whether a curve is at or left of (x, y) at the height y, by halving."""
    ends = curve[0][0], curve[3][0]
    if max(ends) <= x or min(ends) > x:
        return max(ends) <= x
    low, high = 0.0, 1.0
    rising = curve[3][1] > curve[0][1]
    for _ in range(60):
        t = (low + high) / 2
        weights = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
        if (sum(w * p[1] for w, p in zip(weights, curve, strict=True)) < y) == rising:
            low = t
        else:
            high = t
    return sum(w * p[0] for w, p in zip(weights, curve, strict=True)) <= x


def filled(file: File, q: int, x: float, y: float) -> bool:
    if not (0 <= x < 1 and 0 <= y < 1):
        return False
    x, y = Fraction(x), Fraction(y)
    while True:
        k = (x >= Fraction(1, 2)) + 2 * (y >= Fraction(1, 2))
        x, y = 2 * x - k % 2, 2 * y - k // 2
        first_quad, first_curve, cells, coverage = file.texel(q)
        below = cells & ((1 << 8 * k) - 1)
        cell = cells >> 8 * k & 255
        if cell == 128:
            q = first_quad + ((((below >> 7) & 0x00010101) * 0x01010101 & 0xFFFFFFFF) >> 24)
            continue
        if cell == 0:
            return (coverage >> 8 * k & 255) > 127
        n, w = divmod(cell, 8)
        first = first_curve + ((((below >> 3) & 0x000F0F0F) * 0x01010101 & 0xFFFFFFFF) >> 24)
        x, y = UNIT * x, UNIT * y
        winding = w - 4
        for curve in (points(file.texel(first + i)) for i in range(n)):
            (x0, y0), (x3, y3) = curve[0], curve[3]
            winding += (x0 == 0 and y0 <= y) - (x3 == 0 and y3 <= y)
            if y0 <= y < y3:
                winding -= at_or_left(curve, x, y)
            if y3 <= y < y0:
                winding += at_or_left(curve, x, y)
        return winding > 0


@pytest.mark.parametrize("seed", [0, 1, 2, 4, 5, 7, 11, 13])
def test_a_stranger_sees_the_same_picture(seed: int) -> None:
    """The second shape of a texture of several rows is where the drawing is filled, and where the package says so."""
    drawing = degenerate.drawing(seed)
    trees = [build_tree(TRIANGLE)] * 1000 + [build_tree(drawing)]
    texture = encode_packed(trees, [Root(str(k)) for k in range(1001)], name="x")
    file = read(texture.to_ktx2())
    (quad,) = [root["quad"] for root in json.loads(file.texts["vexture.roots"]) if root["name"] == "1000"]
    asked = degenerate.points_near(drawing, np.random.default_rng(seed), 300)
    found = np.array([filled(file, quad, x, y) for x, y in asked.tolist()])
    np.testing.assert_array_equal(texture.contains(asked, "1000"), found)
    windings, distance = degenerate.path_windings(drawing, asked)
    clear = distance > 1e-4
    np.testing.assert_array_equal(found[clear], degenerate.silhouette(drawing, windings)[clear])


def coverage_of_a_leaf(file: File, first: int, n: int, corner: int) -> float:
    """By the formula of B.7."""
    area = float(corner)
    for i in range(n):
        (x0, y0), (x1, y1), (x2, y2), (x3, y3) = [(x / UNIT, y / UNIT) for x, y in points(file.texel(first + i))]
        integral = x0 * (-10 * y0 + 6 * y1 + 3 * y2 + y3) + x1 * (-6 * y0 + 3 * y2 + 3 * y3)
        integral += x2 * (-3 * y0 - 3 * y1 + 6 * y3) + x3 * (-y0 - 3 * y1 - 6 * y2 + 10 * y3)
        area += integral / 20 - (y3 - y0) + (1 - y0) * (x0 == 0) - (1 - y3) * (x3 == 0)
    return area


@pytest.mark.parametrize("seed", [0, 1, 2, 4, 5, 7, 11, 13])
def test_a_stranger_computes_the_same_coverage(seed: int) -> None:
    texture = encode(build_tree(degenerate.drawing(seed)), to_source=np.eye(2, 3), name="x")
    file = read(texture.to_ktx2())

    def mean(q: int) -> float:
        quad, curve, cells, coverage = file.texel(q)
        total = 0.0
        for k in range(4):
            stored, cell = (coverage >> 8 * k & 255) / 255, cells >> 8 * k & 255
            area = stored
            if cell == 128:
                area = mean(quad)
                quad += 1
            elif cell:
                area = coverage_of_a_leaf(file, curve, cell // 8, cell % 8 - 4)
                curve += cell // 8
            assert stored == pytest.approx(area, abs=0.51 / 255 + 1e-6)
            total += area / 4
        return total

    mean(0)


def test_the_example_in_the_specification() -> None:
    texture = encode(build_tree(TRIANGLE), to_source=np.eye(2, 3), name="triangle")
    lines = re.findall(r"^\| \d+ \| ([0-9a-f]{8}(?: \| [0-9a-f]{8}){3}) \|$", TEXT, re.M)
    texels = [[int(word, 16) for word in line.split(" | ")] for line in lines]
    assert texture.texels.tolist() == [texels]
    (dump,) = re.findall(r"^```\n((?:[0-9a-f ]+\n)+)```$", TEXT, re.M)
    start, data = bytearray(bytes.fromhex(dump)), bytearray(texture.to_ktx2())
    image = bytes(data[len(start) :])
    assert struct.unpack_from("<2Q", data, 80) == (len(start), len(image))
    start[DEFLATED_LENGTH] = data[DEFLATED_LENGTH] = bytes(8)
    assert data[: len(start)] == start
    assert zlib.decompress(image) == b"".join(struct.pack("<4I", *texel) for texel in texels)


def test_the_example_is_the_triangle() -> None:
    file = read(encode(build_tree(TRIANGLE), to_source=np.eye(2, 3), name="triangle").to_ktx2())
    grid = (np.arange(40) + 0.5) / 40
    for x in grid.tolist():
        for y in grid.tolist():
            if abs(x + y - 1.0) > 1e-9:
                assert filled(file, 0, x, y) == (x > 0.125 and y > 0.125 and x + y < 1.0)
