"""FORMAT.md says all that a decoder needs: one that was written from it alone draws every example."""

import ast
import io
import re
import struct
import zlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import decoder
import numpy as np
import png
import pytest

import vexture

REPOSITORY = Path(__file__).parents[3]
DRAWINGS = {path.stem: path for path in sorted((REPOSITORY / "examples" / "shapes").glob("*.svg"))}
SIZE, SAMPLES = 64, 6
# Mean error of the touched pixels, and the largest. An outline passes some 8 of the 36 squares around a pixel's samples
# and is off by up to half of each, at random: 0.29 sqrt(8) / 36 = 0.023 at worst; measured are 0.004 to 0.012, and 0.13
# where two outlines pass. Rounding is far below that but in 8 bits: 1/127 of a cell is up to 1/4 of a pixel here, and
# what is measured 0.023 and 0.23.
EXACT, COARSE = (0.015, 0.17), (0.035, 0.35)


@cache
def exact(name: str) -> Any:
    return vexture.coverage(vexture.read_svg(DRAWINGS[name]), (SIZE, SIZE), renderer="exact").astype(float)


def differs(picture: Any, name: str) -> tuple[float, float]:
    """Return the mean error over the pixels that an outline touches in either picture, and the largest of all."""
    touched = (abs(exact(name) - 0.5) < 0.5) | (abs(picture - 0.5) < 0.5)
    error = abs(picture - exact(name))
    return error[touched].mean(), error.max()


def assert_alike(picture: Any, name: str, limits: tuple[float, float] = EXACT) -> None:
    mean, largest = differs(picture, name)
    assert mean < limits[0]
    assert largest < limits[1]


def document(start: str, end: str) -> str:
    """Return a part of FORMAT.md."""
    return (REPOSITORY / "FORMAT.md").read_text(encoding="utf-8").split(start)[1].split(end)[0]


def image(rows: list[list[int]], texts: list[tuple[str, str]]) -> bytes:
    """Return a PNG of 8 bits with these texts."""
    file = io.BytesIO()
    png.Writer(len(rows[0]) // 3, len(rows), greyscale=False).write(file, rows)
    first, *others = png.Reader(bytes=file.getvalue()).chunks()
    file = io.BytesIO()
    png.write_chunks(file, [first, *((b"tEXt", f"{key}\0{text}".encode("latin-1")) for key, text in texts), *others])
    return file.getvalue()


TEXTS = [("vexture.version", "1"), ("vexture.encoding", "thesis"), ("vexture.transform", "1 0 0 0 1 0")]


def example_rows() -> tuple[list[list[int]], list[list[int]]]:
    """Return the rows of the example in A.7: of its quads and of its curves."""
    tables = [
        [[int(n) for n in " ".join(row.split("|")[2:]).split()] for row in re.findall(r"^\| \d.*", part, re.MULTILINE)]
        for part in document("### A.7 Example", "## B.").split("| curve |")
    ]
    return tables[0], tables[1]


def example_bytes() -> bytes:
    """Return the file of the example in B.10."""
    part = document("### B.10 Example", "## C.")
    words = re.findall(r"\b[0-9a-f]{8}\b", part.split("Texel 0 is the root")[0])
    texels = zlib.compress(struct.pack(f"<{len(words)}I", *(int(word, 16) for word in words)))
    head = bytes.fromhex(part.split("```")[1])
    return head[:88] + struct.pack("<Q", len(texels)) + head[96:] + texels


def test_it_is_short_and_knows_only_the_document() -> None:
    source = Path(decoder.__file__).read_text(encoding="utf-8")
    nodes = list(ast.walk(ast.parse(source)))
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    imported |= {f"{'.' * node.level}{node.module or ''}" for node in nodes if isinstance(node, ast.ImportFrom)}
    assert imported == {"collections", "collections.abc", "contextlib", "json", "numpy", "png", "struct", "zlib"}
    assert len(source.splitlines()) < 205


@pytest.mark.parametrize("name", DRAWINGS)
def test_packed(name: str) -> None:
    texture = decoder.read_packed(vexture.convert(DRAWINGS[name]).to_ktx2())
    assert_alike(decoder.picture(texture, SIZE, samples=SAMPLES), name)


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize(("bits", "limits"), [(16, EXACT), (8, COARSE)])
def test_thesis(name: str, bits: int, limits: tuple[float, float]) -> None:
    if (name, bits) == ("hairline", 8):
        pytest.skip("takes more than the 256 rows of 8 bits")
    texture = decoder.read_thesis(*vexture.convert(DRAWINGS[name], encoding="thesis", bits=bits).to_png())
    assert_alike(decoder.picture(texture, SIZE, samples=SAMPLES), name, limits)


def test_several_roots_by_name_and_number() -> None:
    names = ["duck", "holes", "loop"]
    texture = decoder.read_packed(vexture.atlas([DRAWINGS[name] for name in names]).to_ktx2())
    assert [root["name"] for root in texture.roots] == names
    for number, name in enumerate(names):
        picture = decoder.picture(texture, SIZE, root=name, samples=SAMPLES)
        assert_alike(picture, name)
        first = decoder.picture(texture, SIZE // 4, root=name, samples=1)
        np.testing.assert_array_equal(decoder.picture(texture, SIZE // 4, root=number, samples=1), first)


def test_example_of_part_a() -> None:
    quads, curves = example_rows()
    texture = decoder.read_thesis(image(quads, TEXTS), image(curves, TEXTS))
    x, y = np.array([0.1, 0.4, 0.6, 0.9, 0.1, 0.3, 0.9, 0.7]), np.array([0.1, 0.4, 0.6, 0.9, 0.8, 0.9, 0.2, 0.2])
    np.testing.assert_array_equal(decoder.inside(texture, x, y), x + y < 1)
    assert decoder.picture(texture, 1, samples=64).item() == pytest.approx(0.5, abs=1 / 64)


def test_example_of_part_b() -> None:
    texture = decoder.read_packed(example_bytes())
    x, y = np.random.default_rng(1).random((2, 1000))
    np.testing.assert_array_equal(decoder.inside(texture, x, y), (x >= 0.125) & (y >= 0.125) & (x + y < 1))
    cells = decoder.picture(texture, 2, root="triangle", samples=64)
    np.testing.assert_allclose(cells, [[0.28125, 0], [0.5625, 0.28125]], atol=1 / 64)


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (0, 0),  # magic
        (12, 37),  # vkFormat
        (16, 1),  # typeSize
        (20, 7),  # pixelWidth
        (28, 1),  # pixelDepth
        (36, 6),  # faceCount
        (40, 2),  # levelCount
        (44, 1),  # supercompressionScheme
        (72, 1),  # global data
        (96, 127),  # uncompressed size
    ],
)
def test_a_broken_file_is_refused(place: int, value: int) -> None:
    data = bytearray(example_bytes())
    data[place] = value
    with pytest.raises(ValueError, match="not a valid texture"):
        decoder.read_packed(bytes(data))


@pytest.mark.parametrize(
    ("texel", "word", "value"),
    [
        (0, 2, 0x0014140D - 1 - 4),  # a leaf with a curve, and no winding number
        (0, 2, 0x8114140C),  # no such byte
        (0, 2, 0x8014140C),  # a quad that is its own child, or a curve too
        (0, 1, 0),  # curves that are their quad
        (0, 1, 2),  # a texel that nothing reaches
        (0, 1, 4),  # a curve beyond the texture
        (1, 0, 0x80012000),  # an end outside its leaf
        (7, 0, 1),  # a texel that nothing reaches
    ],
)
def test_broken_texels_are_refused(texel: int, word: int, value: int) -> None:
    data = example_bytes()
    start = int.from_bytes(data[80:88], "little")
    texels = bytearray(zlib.decompress(data[start:]))
    struct.pack_into("<I", texels, 16 * texel + 4 * word, value)
    packed = zlib.compress(texels)
    with pytest.raises(ValueError, match="not a valid texture"):
        decoder.read_packed(data[:88] + struct.pack("<Q", len(packed)) + data[96:start] + packed)


@pytest.mark.parametrize("old", [b'":0,"trans', b"[1,0,", b"packed", b"version\x001", b"}]", b'"name":"'])
def test_broken_values_are_refused(old: bytes) -> None:
    data = example_bytes()
    assert old in data
    with pytest.raises(ValueError, match="not a valid texture"):
        decoder.read_packed(data.replace(old, old[:-3] + b"\x00" * min(3, len(old))))


Rows = list[list[int]]


@pytest.mark.parametrize(
    "spoil",
    [
        lambda quads, curves, texts: quads[0].__setitem__(8, 129),  # coverage differs
        lambda quads, curves, texts: quads[0].__setitem__(6, 128),  # a corner that is full
        lambda quads, curves, texts: quads[0].__setitem__(3, 255),  # a quad in itself
        lambda quads, curves, texts: quads[0].__setitem__(1, 170),  # order of the curves
        lambda quads, curves, texts: curves[2].__setitem__(3, 0),  # ends where it starts
        lambda quads, curves, texts: curves[2].__setitem__(3, 255),  # likewise: 255 is 0
        lambda quads, curves, texts: curves.append([0] * 6),  # nothing refers to it
        lambda quads, curves, texts: texts.__setitem__(0, ("vexture.version", "2")),
        lambda quads, curves, texts: texts.__setitem__(1, ("vexture.encoding", "packed")),
        lambda quads, curves, texts: texts.__setitem__(2, ("vexture.transform", "1 0 0 0 1")),
        lambda quads, curves, texts: texts.__setitem__(2, ("vexture.transform", "1 0 0 0 1 inf")),
        lambda quads, curves, texts: texts.pop(),
    ],
)
def test_a_broken_pair_is_refused(spoil: Callable[[Rows, Rows, list[tuple[str, str]]], object]) -> None:
    (quads, curves), texts = example_rows(), list(TEXTS)
    spoil(quads, curves, texts)
    with pytest.raises(ValueError, match="not a valid texture"):
        decoder.read_thesis(image(quads, texts), image(curves, texts))


def test_files_of_two_pairs_are_refused() -> None:
    quads, curves = example_rows()
    others = [*TEXTS[:2], ("vexture.transform", "2 0 0 0 2 0")]
    with pytest.raises(ValueError, match="different textures"):
        decoder.read_thesis(image(quads, TEXTS), image(curves, others))
    with pytest.raises(ValueError, match="not a valid texture"):
        decoder.read_thesis(image(quads, TEXTS)[:-30], image(curves, TEXTS))
