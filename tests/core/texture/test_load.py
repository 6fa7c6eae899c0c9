"""Files from strangers: every fault is one line, and nothing but a valid tree comes through."""

import dataclasses
import shutil
import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from both_encodings import decode, encode
from strategies import cell_trees
from vexture.base.errors import FormatError
from vexture.texture.load import load_any as load
from vexture.thesis.png import write_png
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree

TRANSFORM = np.array([[32.5, 0.0, 1e-7], [0.0, -32.5, 1 / 3]])


def small_tree() -> CellTree:
    """A root with two quads, each with a curve and a corner."""
    Q, C, K, F, E = CellKind.QUAD, CellKind.CURVE, CellKind.CORNER, CellKind.FULL, CellKind.EMPTY
    curve = [[0.0, 0.5], [0.3, 0.6], [0.6, 0.4], [1.0, 0.5]]
    corner = [[0.0, 0.2], [0.7, 0.7], [0.7, 0.7], [0.2, 0.0]]
    return CellTree(
        np.array([[Q, E, F, Q], [C, E, K, F], [E, C, F, K]], np.uint8),
        np.array([[1, -1, -1, 2], [0, -1, 1, -1], [-1, 2, -1, 3]], np.int32),
        np.full((3, 4), 0.5),
        np.array([curve, corner, curve, corner]),
        0.0,
        0,
    )


def small(bits: int = 16) -> ThesisTexture:
    return encode(small_tree(), bits, to_source=TRANSFORM, name="small", crs="EPSG:28992")


def write(folder: Path, quads: NDArray[Any], curves: NDArray[Any], texts: dict[str, str] | None = None) -> Path:
    texts = small().texts() if texts is None else texts
    (folder / "bad.quads.png").write_bytes(write_png(quads, texts))
    (folder / "bad.curves.png").write_bytes(write_png(curves, texts))
    return folder / "bad"


def refusal(path: Path) -> str:
    with pytest.raises(FormatError) as caught:
        load(path)
    message = str(caught.value)
    assert "\n" not in message
    assert "bad." in message, "names the file"
    return message


def read_or_refused(path: Path) -> CellTree | None:
    try:
        return decode(load(path))
    except FormatError as error:
        message = str(error)
    assert "\n" not in message
    return None


@pytest.mark.parametrize("bits", [8, 16])
def test_what_is_saved_is_loaded(tmp_path: Path, bits: int) -> None:
    texture = small(bits)
    texture.save(tmp_path)
    found = load(tmp_path / "small")
    np.testing.assert_array_equal(found.quads, texture.quads)
    np.testing.assert_array_equal(found.curves, texture.curves)
    np.testing.assert_array_equal(found.to_source, TRANSFORM)
    assert (found.name, found.crs, found.bits) == ("small", "EPSG:28992", bits)


def test_without_crs(tmp_path: Path) -> None:
    dataclasses.replace(small(), crs=None).save(tmp_path)
    assert load(tmp_path / "small").crs is None


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=6, max_size=6))
def test_the_transform_comes_back_exactly(tmp_path: Path, numbers: list[float]) -> None:
    texture = dataclasses.replace(small(), to_source=np.array(numbers).reshape(2, 3))
    texture.save(tmp_path)
    assert load(tmp_path / "small").to_source.tobytes() == texture.to_source.tobytes()


def test_the_transform_is_short() -> None:
    texture = dataclasses.replace(small(), to_source=np.array([[32.0, 0.0, 0.5], [0.0, -32.0, 32.0]]))
    assert texture.texts()["vexture.transform"] == "32 0 0.5 0 -32 32"


def test_missing_files(tmp_path: Path) -> None:
    with pytest.raises(
        FormatError, match=r"bad: not found; a texture is NAME\.ktx2, or NAME\.quads\.png, NAME\.curves\.png$"
    ):
        load(tmp_path / "bad")
    path = write(tmp_path, small().quads, small().curves)
    path.with_name("bad.curves.png").unlink()
    assert "bad.curves.png: not found" in refusal(path)


def test_a_pair_of_two_depths(tmp_path: Path) -> None:
    assert "16 bits with curves of 8" in refusal(write(tmp_path, small(16).quads, small(8).curves))


def test_a_list_without_its_constants(tmp_path: Path) -> None:
    assert "1 rows of curves" in refusal(write(tmp_path, small().quads, small().curves[:1]))


def test_files_of_two_pairs(tmp_path: Path) -> None:
    texture = small()
    path = write(tmp_path, texture.quads, texture.curves)
    texts = {**texture.texts(), "vexture.transform": "1 0 0 0 1 0"}
    path.with_name("bad.curves.png").write_bytes(write_png(texture.curves, texts))
    assert "vexture.transform differs from that of bad.curves.png" in refusal(path)


def test_files_swapped(tmp_path: Path) -> None:
    path = write(tmp_path, small().quads, small().curves)
    shutil.copy(path.with_name("bad.curves.png"), path.with_name("bad.quads.png"))
    assert "2 x 6 pixels; a texture of 16 bits is 4 wide" in refusal(path)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("vexture.version", "2", "vexture.version is '2'; this program reads '1'; update it"),
        ("vexture.version", None, "vexture.version is None"),
        ("vexture.encoding", "packed", "vexture.encoding is 'packed'; this program reads 'thesis'"),
        ("vexture.encoding", None, "vexture.encoding is None"),
        ("vexture.transform", None, "vexture.transform is ''"),
        ("vexture.transform", "1 0 0 0 1", "six finite numbers"),
        ("vexture.transform", "1 0 0 0 1 nan", "six finite numbers"),
        ("vexture.transform", "1 0 0 0 1 1e999", "six finite numbers"),
        ("vexture.transform", "1 0 0 0 one 0", "six finite numbers"),
        ("vexture.transform", "9" * 100_000, "six finite numbers"),
    ],
)
def test_texts(tmp_path: Path, key: str, value: str | None, expected: str) -> None:
    texts = {name: text for name, text in small().texts().items() if name != key}
    texts |= {} if value is None else {key: value}
    message = refusal(write(tmp_path, small().quads, small().curves, texts))
    assert expected in message
    assert len(message) < 400


def set_pixel(which: str, place: tuple[int, int, int], value: int) -> Callable[[ThesisTexture], None]:
    return lambda texture: getattr(texture, which).__setitem__(place, value)


# pixels of a row are the cells 2, 3, 0, 1; three quads make indices of 0, 32768, 65535; six curves steps of 13107
FAULTS: dict[str, tuple[Callable[[ThesisTexture], None], str]] = {
    "the root referenced": (set_pixel("quads", (0, 2, 1), 0), "reference 0 to quad rows is to row 0"),
    "a quad twice": (set_pixel("quads", (0, 2, 1), 65535), "reference 0 to quad rows is to row 2"),
    "a quad less": (set_pixel("quads", (0, 2, 0), 0), "1 references to 2 quad rows"),
    "a quad more": (set_pixel("quads", (2, 0, 0), 65535), "3 references to 2 quad rows"),
    "a curve twice": (set_pixel("quads", (2, 3, 1), 2 * 13107), "reference 2 to curve rows is to row 2"),
    "curves backwards": (set_pixel("quads", (1, 2, 1), 3 * 13107), "reference 0 to curve rows is to row 3"),
    "a curve less": (set_pixel("quads", (1, 2, 1), 0), "3 references to 4 curve rows"),
    "a constant corner": (set_pixel("quads", (0, 0, 0), 32768), "calls a constant a corner"),
    "uneven coverage": (set_pixel("quads", (1, 3, 2), 7), "quad 1 has coverages"),
    "ends that coincide": (set_pixel("curves", (3, 1, 0), int(small().curves[3, 0, 0])), "curve row 3: P0 and P3"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults_of_the_tree(tmp_path: Path, name: str) -> None:
    change, expected = FAULTS[name]
    texture = small()
    change(texture)
    assert expected in refusal(write(tmp_path, texture.quads, texture.curves))


def test_a_cycle(tmp_path: Path) -> None:
    """Row 1 refers to itself: every row is referred to once and in order, yet the root does not reach it."""
    quads = np.zeros((2, 4, 3), np.uint8)
    quads[1, 2] = [255, 255, 0]
    assert "quad 1, cell 0 refers to itself or backwards" in refusal(
        write(tmp_path, quads, np.zeros((2, 2, 3), np.uint8))
    )


def test_ends_that_coincide_modulo_the_cell(tmp_path: Path) -> None:
    texture = small()
    texture.curves[2, :, 0] = 0, texture.maximum
    assert "both at edge step 0" in refusal(write(tmp_path, texture.quads, texture.curves))


def test_values_between_the_written_ones_are_read_by_thresholds(tmp_path: Path) -> None:
    texture = small(16)
    red = texture.quads[:, :, 0]
    nudged = texture.quads.copy()
    nudged[:, :, 0] = np.select([red == 0, red == 65535], [16000, 49200], 20000)  # 0.24, 0.75+, 0.31
    nudged[:, :, 1] += 1000 * (nudged[:, :, 1] == 32768).astype(np.uint16)
    found = load(write(tmp_path, nudged, texture.curves)).cells()
    for now, before in zip(found, texture.cells(), strict=True):
        np.testing.assert_array_equal(now, before)


@given(st.data(), st.sampled_from([8, 16]))
def test_damaged_bytes(tmp_path: Path, data: st.DataObject, bits: int) -> None:
    """Bytes flipped, cut or inserted anywhere: refused, or read as before (an unused byte of a text, say)."""
    small(bits).save(tmp_path)
    path = tmp_path / ("small" + data.draw(st.sampled_from([".quads.png", ".curves.png"])))
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        if not content:
            break
        at = data.draw(st.integers(0, len(content) - 1))
        how = data.draw(st.sampled_from(["flip", "cut", "drop", "insert"]))
        if how == "flip":
            content[at] ^= data.draw(st.integers(1, 255))
        elif how == "cut":
            del content[at + 1 :]
        elif how == "drop":
            del content[at]
        else:
            content.insert(at, data.draw(st.integers(0, 255)))
    path.write_bytes(refreshed(bytes(content)) if data.draw(st.booleans()) else content)
    read_or_refused(path)


def refreshed(content: bytes) -> bytes:
    """The same chunks with the checksums that they should have, so that damage gets past them."""
    out, at = content[:8], 8
    while at + 12 <= len(content):
        (length,) = struct.unpack(">I", content[at : at + 4])
        body = content[at + 4 : at + 8 + length]
        out += content[at : at + 4] + body + struct.pack(">I", zlib.crc32(body))
        at += 12 + length
    return out


@settings(max_examples=40)
@given(st.data(), cell_trees(max_quads=6), st.sampled_from([8, 16]))
def test_damaged_pixels(tmp_path: Path, data: st.DataObject, tree: CellTree, bits: int) -> None:
    texture = encode(tree, bits, to_source=TRANSFORM, name="small")
    for _ in range(data.draw(st.integers(1, 4))):
        pixels = data.draw(st.sampled_from([texture.quads, texture.curves]))
        place = tuple(data.draw(st.integers(0, size - 1)) for size in pixels.shape)
        pixels[place] = data.draw(st.sampled_from([0, 1, texture.maximum // 2, texture.maximum]))
    decoded = read_or_refused(write(tmp_path, texture.quads, texture.curves))
    if decoded is None:
        return
    assert (decoded.quad_depth[1:] > 0).all()
    assert np.isfinite(decoded.curves).all()
    assert decoded.coverage.min() >= 0.0
    assert decoded.coverage.max() <= 1.0


def test_the_longest_lists_pass(tmp_path: Path) -> None:
    """256 quads in 8 bits: every index comes back."""
    kind = np.full((256, 4), CellKind.EMPTY, np.uint8)
    ref = np.full((256, 4), -1, np.int32)
    kind.flat[:255] = CellKind.QUAD
    ref.flat[:255] = np.arange(1, 256)
    tree = CellTree(kind, ref, np.zeros((256, 4)), np.zeros((0, 4, 2)), 0.0, 0)
    encode(tree, 8, to_source=TRANSFORM, name="many").save(tmp_path)
    np.testing.assert_array_equal(decode(load(tmp_path / "many")).ref, ref)


def test_reading_needs_no_compiler(tmp_path: Path) -> None:
    """Numba takes 0.3 s to import, which `vexture info` must not cost."""
    small().save(tmp_path)
    program = (
        "import sys; from vexture.texture.load import load_any; load_any(sys.argv[1]).info(); "
        "print('numba' in sys.modules)"
    )
    told = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "small")], capture_output=True, text=True, check=True
    )
    assert told.stdout.strip() == "False"
