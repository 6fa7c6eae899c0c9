"""The container: what we write others read, what others write we read, and strangers' files get one clear line."""

import json
import shutil
import struct
import subprocess
import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

import corpora
from vexture.base.errors import FormatError, VextureError
from vexture.texture.ktx2 import read_ktx2, write_ktx2

SHAPES = st.integers(0, 6).map(lambda power: (1, 1 << power, 4)) | st.integers(1, 3).map(lambda rows: (rows, 2048, 4))
TEXELS = hnp.arrays(np.uint32, SHAPES, elements=st.integers(0, 2**32 - 1), fill=st.integers(0, 2**32 - 1))
TEXTS = st.dictionaries(
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), min_size=1),
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"])),
    max_size=4,
)
SMALL = np.arange(16, dtype=np.uint32).reshape(1, 4, 4)
RAW = SMALL.tobytes()
READER = """
import { read } from %s;
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';
const file = read(new Uint8Array(readFileSync(process.argv[2])));
const { vkFormat, typeSize, pixelWidth, pixelHeight, pixelDepth, layerCount, faceCount, supercompressionScheme } = file;
const [level] = file.levels, words = inflateSync(level.levelData);
const decoder = new TextDecoder('utf-8', { fatal: true });
const text = value => typeof value === 'string' ? value : decoder.decode(value);
console.log(JSON.stringify({
  header: [vkFormat, typeSize, pixelWidth, pixelHeight, pixelDepth, layerCount, faceCount, supercompressionScheme],
  levels: file.levels.length, size: level.uncompressedByteLength, texels: words.toString('hex'),
  texts: Object.entries(file.keyValue).map(([key, value]) => [key, text(value)]),
  descriptor: file.dataFormatDescriptor,
}));
"""


def by_ktx_parse(data: bytes, folder: Path) -> dict[str, object]:
    """What ktx-parse, a reader in JavaScript, makes of a file."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is missing")
    try:
        module = corpora.ktx_parse() / "dist" / "ktx-parse.modern.js"
    except VextureError as error:
        pytest.skip(str(error))
    (folder / "read.mjs").write_text(READER % json.dumps(module.as_uri()))
    (folder / "file.ktx2").write_bytes(data)
    command = [node, str(folder / "read.mjs"), str(folder / "file.ktx2")]
    outcome = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(outcome.stdout)


def stranger(
    *,
    header: dict[int, int] | None = None,
    pairs: bytes = b"",
    level: tuple[int, int, int] | None = None,
    image: bytes = zlib.compress(RAW),
    descriptor: bytes = b"",
    inflated: int = len(RAW),
) -> bytes:
    """File of another writer: key/value data after the image, no descriptor; `header` replaces fields by place."""
    fields = [107, 4, 4, 1, 0, 0, 1, 1, 3, 104, len(descriptor), 104 + len(descriptor) + len(image), len(pairs), 0, 0]
    for place, value in (header or {}).items():
        fields[place] = value
    index = struct.pack("<3Q", *(level or (104 + len(descriptor), len(image), inflated)))
    return b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I4I2Q", *fields) + index + descriptor + image + pairs


def pair(key: bytes, value: bytes) -> bytes:
    body = key + b"\0" + value
    return struct.pack("<I", len(body)) + body + bytes(-len(body) % 4)


@given(TEXELS, TEXTS)
def test_round_trip(texels: NDArray[np.uint32], texts: dict[str, str]) -> None:
    found, said = read_ktx2(write_ktx2(texels, texts), "x")
    assert found.dtype == np.uint32
    np.testing.assert_array_equal(found, texels)
    assert said == texts


def test_another_reader_reads_the_same(tmp_path: Path) -> None:
    texels = np.random.default_rng(1).integers(0, 2**32, (3, 2048, 4), np.uint32)
    told = by_ktx_parse(write_ktx2(texels, {"vexture.name": "Größe 坐标", "KTXwriter": "vexture", "a": ""}), tmp_path)
    assert told["header"] == [107, 4, 2048, 3, 0, 0, 1, 3]
    assert (told["levels"], told["size"]) == (1, texels.nbytes)
    assert bytes.fromhex(str(told["texels"])) == texels.tobytes()
    assert told["texts"] == [["KTXwriter", "vexture"], ["a", "\0"], ["vexture.name", "Größe 坐标\0"]]


def test_another_reader_reads_the_descriptor(tmp_path: Path) -> None:
    (block,) = by_ktx_parse(write_ktx2(SMALL, {}), tmp_path)["descriptor"]
    assert (block["vendorId"], block["descriptorType"], block["versionNumber"]) == (0, 0, 2)
    assert (block["colorModel"], block["transferFunction"], block["flags"]) == (1, 1, 0)
    assert block["texelBlockDimension"] == [0, 0, 0, 0]
    assert block["bytesPlane"] == [16, 0, 0, 0, 0, 0, 0, 0]
    for k, sample in enumerate(block["samples"]):
        assert (sample["bitOffset"], sample["bitLength"]) == (32 * k, 31)
        assert (sample["channelType"], sample["sampleLower"], sample["sampleUpper"]) == ((0, 1, 2, 15)[k], 0, 1)


@pytest.mark.parametrize(
    "data",
    [
        stranger(),
        stranger(header={8: 0}, image=RAW),
        stranger(header={8: 0}, image=RAW, inflated=0),
        stranger(header={7: 0}),
        stranger(image=zlib.compress(RAW, 0)),
        stranger(descriptor=struct.pack("<2I", 8, 0)),
    ],
    ids=["after the image", "not deflated", "not deflated, no length", "no mip count", "stored", "another descriptor"],
)
def test_files_of_other_writers(data: bytes) -> None:
    np.testing.assert_array_equal(read_ktx2(data, "x")[0], SMALL)


def test_texts_of_other_writers() -> None:
    pairs = pair(b"z", b"last\0") + pair(b"a", b"no zero") + pair(b"empty", b"") + pair(b"other", b"\xff\xfe\0")
    assert read_ktx2(stranger(pairs=pairs), "x")[1] == {"z": "last", "a": "no zero", "empty": ""}


GOOD = write_ktx2(SMALL, {"KTXwriter": "x"})
BAD: dict[str, tuple[bytes, str]] = {
    "empty": (b"", "it is empty; convert"),
    "png": (b"\x89PNG\r\n\x1a\n" + bytes(200), "begins with"),
    "ktx 1": (GOOD.replace(b"KTX 20", b"KTX 11"), "begins with"),
    "header only": (GOOD[:80], "80 bytes; the header alone has 104"),
    "floats": (stranger(header={0: 109}), "vkFormat is 109; it must be 107"),
    "type size": (stranger(header={1: 1}), "typeSize is 1"),
    "3d": (stranger(header={4: 2}), "pixelDepth is 2"),
    "array": (stranger(header={5: 1}), "layerCount is 1"),
    "cube": (stranger(header={6: 6}), "faceCount is 6"),
    "mips": (stranger(header={7: 2}), "levelCount is 2; it must be 1 or 0"),
    "zstd": (stranger(header={8: 2}), "supercompressionScheme is 2; it must be 3 or 0"),
    "global data": (stranger(header={14: 1}), "sgdByteLength is 1"),
    "no width": (stranger(header={2: 0}), "0 x 1 texels"),
    "odd width": (stranger(header={2: 3}), "3 x 1 texels"),
    "wide": (stranger(header={2: 4096}), "4096 x 1 texels"),
    "no height": (stranger(header={3: 0}), "4 x 0 texels"),
    "rows of a narrow texture": (stranger(header={3: 2}), "4 x 2 texels"),
    "high": (stranger(header={2: 2048, 3: 16385}), "1 to 16384 high"),
    "longest": (stranger(header={2: 2**32 - 1, 3: 2**32 - 1}), "4294967295 x 4294967295"),
    "image outside": (stranger(level=(2**64 - 1, 2**64 - 1, 64)), "image at bytes"),
    "image beyond the end": (stranger(level=(104, 1000, 64)), "image at bytes 104 to 1104 of a file of"),
    "image in the header": (stranger(level=(0, 80, 64)), "image at bytes 0 to 80"),
    "other size": (stranger(inflated=48), "uncompressedByteLength is 48; the size in texels makes it 64"),
    "too few data": (stranger(image=zlib.compress(RAW[:-1])), "has 63 bytes; its size in texels makes it 64"),
    "too many data": (stranger(image=zlib.compress(RAW + b"\0")), "has 65 bytes"),
    "not deflated": (stranger(image=RAW), "cannot be inflated"),
    "not deflated, short": (stranger(header={8: 0}, image=RAW[:-1]), "has 63 bytes"),
    "no checksum": (stranger(image=zlib.compress(RAW)[:-1]), "do not end where they should"),
    "more after the image": (stranger(image=zlib.compress(RAW) + b"\0"), "do not end where they should"),
    "texts outside": (stranger(header={11: 2**32 - 1, 12: 2**20}), "key/value data at bytes"),
    "texts too long": (stranger(header={12: 2**32 - 1}), "the limit is 16777216"),
    "a text cut off": (stranger(pairs=pair(b"key", b"value")[:-4]), "key/value data are damaged"),
    "a length cut off": (stranger(pairs=pair(b"key", b"value") + b"\0"), "key/value data are damaged"),
    "no key": (stranger(pairs=pair(b"", b"value")), "key/value data are damaged"),
    "no zero": (stranger(pairs=struct.pack("<I", 4) + b"abcd"), "key/value data are damaged"),
    "key twice": (stranger(pairs=2 * pair(b"key", b"value")), "key b'key' is there twice"),
    "descriptor outside": (stranger(header={10: 10_000}), "data format descriptor at bytes"),
    "descriptor's length": (stranger(descriptor=struct.pack("<2I", 12, 0)), "says 12 bytes and has 8"),
    "two-byte descriptor": (stranger(header={10: 2}), "says 0 bytes and has 2"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_refused_in_one_line(name: str) -> None:
    data, expected = BAD[name]
    with pytest.raises(FormatError) as caught:
        read_ktx2(data, "folder/name.ktx2")
    message = str(caught.value)
    assert expected in message
    assert message.startswith("folder/name.ktx2: ")
    assert "convert" in message
    assert "\n" not in message
    assert len(message) < 300


def test_a_bomb_is_not_inflated() -> None:
    bomb = stranger(image=zlib.compress(bytes(300_000_000), 9))
    assert len(bomb) < 1_000_000
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match="has 65 bytes"):
            read_ktx2(bomb, "bomb")
        assert tracemalloc.get_traced_memory()[1] < 4 * len(bomb)
    finally:
        tracemalloc.stop()


def test_a_size_that_no_data_can_have_is_not_allocated() -> None:
    lie = stranger(header={2: 2048, 3: 16384}, inflated=2048 * 16384 * 16)
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match=r"bytes of image; they cannot inflate to 536870912"):
            read_ktx2(lie, "lie")
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()


def test_texts_of_a_ktx2_file_are_kept() -> None:
    data = write_ktx2(np.ones((1, 2, 4), np.uint32), {"KTXwriter": "an example"})
    assert read_ktx2(data, "ones")[1] == {"KTXwriter": "an example"}
