"""Packed textures as files: where they go, what comes back, what strangers send."""

import dataclasses
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from test_texture_encode import TRANSFORM, chain

from strategies import packed_trees
from vexture.base.errors import DeviceError, FormatError, ParameterError
from vexture.cli.main import main
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode as encode_packed
from vexture.texture.ktx2 import write_ktx2
from vexture.texture.load import load_any as load
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture.tree.tree import Tree

THESIS = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8), name="shape")
POINTS = np.random.default_rng(0).random((20, 2))
FINITE = st.floats(allow_nan=False, allow_infinity=False)
UNIT = st.floats(0.0, 1.0)
PAINTS = st.none() | st.builds(Paint, st.tuples(UNIT, UNIT, UNIT), UNIT)
ROOTS = st.builds(
    Root,
    st.text(),
    to_source=st.lists(FINITE, min_size=6, max_size=6).map(lambda numbers: np.array(numbers).reshape(2, 3)),
    tolerance=st.floats(0.0, 1.0),
    crs=st.none() | st.text(),
    paint=PAINTS,
)


def shape(name: str = "shape") -> Texture:
    return encode_packed([chain(2)], [Root(name, to_source=TRANSFORM)], name=name)


def names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.rglob("*") if file.is_file())


def facts(root: Root) -> tuple[Any, ...]:
    return root.name, root.quad, root.to_source.tobytes(), root.tolerance, root.crs, root.paint


@given(packed_trees(max_quads=6), st.lists(ROOTS | st.just(Root("\udcff")), min_size=1, max_size=4), st.text())
def test_what_is_saved_is_loaded(tmp_path: Path, tree: Tree, roots: list[Root], source: str) -> None:
    source = source.encode(errors="ignore").decode().replace("\0", "")
    texture = encode_packed([tree] * len(roots), roots, name="shape", source=source)
    found = load(texture.save(f"{tmp_path}/"))
    np.testing.assert_array_equal(found.texels, texture.texels)
    assert (found.name, found.source) == ("shape", source)
    assert [facts(root) for root in found.roots] == [facts(root) for root in texture.roots]
    assert found.to_ktx2() == texture.to_ktx2()


def test_the_same_texture_is_the_same_file(tmp_path: Path) -> None:
    """In another process as well, in which sets and dictionaries of texts have another order."""
    again = """
import hashlib, sys
from vexture.texture.load import load
print(hashlib.sha256(load(sys.argv[1]).to_ktx2()).hexdigest())
"""
    path = shape().save(tmp_path)
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    command = [sys.executable, "-c", again, str(path)]
    outcome = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert outcome.stdout.strip() == hashlib.sha256(shape().to_ktx2()).hexdigest()


@pytest.mark.parametrize("target", ["", "/", "new/deep/", "shape.ktx2"])
def test_where_a_texture_goes(tmp_path: Path, target: str) -> None:
    path = shape().save(f"{tmp_path}/{target}" if target else tmp_path)
    assert path.name == "shape.ktx2"
    assert names(tmp_path) == ["shape.ktx2"]
    for way in (path, str(path), path.parent / "shape"):
        assert load(way).root("shape").quad == 0


def test_any_file_name(tmp_path: Path) -> None:
    assert shape().save(tmp_path / "shape.v2").name == "shape.v2"
    assert isinstance(load(tmp_path / "shape.v2"), Texture)


@pytest.mark.parametrize("name", ["shape.png", "shape.SVG", "shape.geojson"])
def test_a_suffix_of_another_kind_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ParameterError, match=rf"`path` .*{name} ends in .*, but a texture is a KTX2 file; use \.ktx2"):
        shape().save(tmp_path / name)
    assert names(tmp_path) == []


def test_a_name_cannot_leave_the_folder(tmp_path: Path) -> None:
    assert shape("../up").save(f"{tmp_path}/in/").parent == tmp_path / "in"


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(DeviceError, match="cannot be written"):
        shape().save(tmp_path / "file" / "x.ktx2")
    assert names(tmp_path) == ["file"]


def test_the_kind_is_found_by_what_is_there(tmp_path: Path) -> None:
    THESIS.save(tmp_path)
    assert isinstance(load(tmp_path / "shape"), ThesisTexture)
    shape().save(tmp_path)
    assert isinstance(load(tmp_path / "shape.ktx2"), Texture)
    for way in ("shape.png", "shape.quads.png", "shape.curves.png"):
        assert isinstance(load(tmp_path / way), ThesisTexture)
    with pytest.raises(FormatError, match=r"means .*shape\.ktx2 as well as .*shape\.quads\.png; name one of them"):
        load(tmp_path / "shape")
    for file in ("shape.quads.png", "shape.curves.png"):
        (tmp_path / file).unlink()
    assert isinstance(load(tmp_path / "shape"), Texture)


def test_nothing_there(tmp_path: Path) -> None:
    for way in ("x", "x.ktx2"):
        with pytest.raises(FormatError, match=r"not found; a texture is NAME\.ktx2, or NAME\.quads\.png, NAME\.curves"):
            load(tmp_path / way)
    with pytest.raises(FormatError, match=r"x\.quads\.png: not found; .* the pair NAME\.quads\.png and NAME"):
        load(tmp_path / "x.quads.png")


def refusal(path: Path) -> str:
    with pytest.raises(FormatError) as caught:
        load(path)
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(f"{path}: ")
    assert len(message) < 500
    return message


ENTRY = {"name": "a", "quad": 0, "transform": [1, 0, 0, 0, 1, 0], "tolerance": 0}


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("vexture.version", "4", "vexture.version is '4'; this program reads '1', '2', '3'; update it"),
        ("vexture.version", "3", "vexture.version is '3', but with pictures it is '3', with maps '2' and without '1'"),
        ("vexture.version", "2", "vexture.version is '2', but with pictures it is '3', with maps '2' and without '1'"),
        ("vexture.version", None, "vexture.version is None"),
        ("vexture.encoding", "layers", "vexture.encoding is 'layers'"),
        ("vexture.encoding", "x" * 100_000, "vexture.encoding is 'xxx"),
        ("vexture.roots", None, "vexture.roots is not JSON"),
        ("vexture.roots", "[", "vexture.roots is not JSON"),
        ("vexture.roots", "[" * 100_000, "vexture.roots is not JSON"),
        ("vexture.roots", "1" * 10_000, "vexture.roots is not JSON"),
        ("vexture.roots", "[]", "at least one root"),
        ("vexture.roots", "{}", "at least one root"),
        ("vexture.roots", "[1]", "root 0 is 1; it must be an object"),
    ],
)
def test_texts(tmp_path: Path, key: str, value: str | None, expected: str) -> None:
    texts = shape().texts() | {key: value or ""}
    if value is None:
        del texts[key]
    (tmp_path / "bad.ktx2").write_bytes(write_ktx2(shape().texels, texts))
    assert expected in refusal(tmp_path / "bad.ktx2")


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("name", "1", "has the name 1"),
        ("quad", "-1", "has the quad -1"),
        ("quad", "0.0", "has the quad 0.0"),
        ("quad", "true", "has the quad True"),
        ("quad", "9", "a root is quad 9 of 2 texels"),
        ("quad", "1" + "0" * 40, "has the quad 1000"),
        ("crs", "[]", "has the crs []"),
        ("transform", "[1,0,0,0,1]", "must be 6 finite numbers"),
        ("transform", "[1,0,0,0,1,1e999]", "must be 6 finite numbers"),
        ("transform", "[1,0,0,0,1,true]", "must be 6 finite numbers"),
        ("transform", "[1,0,0,0,1,NaN]", "NaN is no number of JSON"),
        ("transform", "[1,0,0,0,1,1" + "0" * 400 + "]", "must be 6 finite numbers"),
        ("transform", '"' + "9" * 100_000 + '"', "must be 6 finite numbers"),
        ("tolerance", "-1", "tolerance is -1; it must be at least 0"),
        ("tolerance", "null", "must be 1 finite number"),
        ("paint", "[]", "paint is []; it must be an object"),
        ("paint", "{}", "color is None"),
        ("paint", '{"color":[0,0,2]}', "must be in 0..1"),
        ("paint", '{"color":[0,0,0],"opacity":-1}', "must be in 0..1"),
    ],
)
def test_roots(tmp_path: Path, key: str, value: str, expected: str) -> None:
    entry = json.dumps({**ENTRY, key: "HERE"}).replace('"HERE"', value)
    texts = shape().texts() | {"vexture.roots": f"[{entry}]"}
    (tmp_path / "bad.ktx2").write_bytes(write_ktx2(shape().texels, texts))
    assert expected in refusal(tmp_path / "bad.ktx2")


def test_what_is_not_known_is_ignored(tmp_path: Path) -> None:
    roots = json.dumps([{**ENTRY, "layer": {"of": 1}}])
    texts = shape().texts() | {"vexture.roots": roots, "vexture.more": "x", "KTXorientation": "rd"}
    del texts["vexture.name"], texts["KTXwriter"]
    (tmp_path / "file.ktx2").write_bytes(write_ktx2(shape().texels, texts))
    found = load(tmp_path / "file.ktx2")
    assert (found.name, found.source, found.root().name) == ("file", None, "a")


def test_faults_of_the_texels_name_the_file(tmp_path: Path) -> None:
    texture = shape()
    texture.texels[0, 0, 0] = 0
    (tmp_path / "bad.ktx2").write_bytes(texture.to_ktx2())
    assert "quad 0 has 1 quads from texel 0" in refusal(tmp_path / "bad.ktx2")


def read_or_refused(path: Path) -> None:
    try:
        found = load(path)
    except FormatError as error:
        message = str(error)
    else:
        message = ""
        found.check()
        found.contains(POINTS)
    assert "\n" not in message


def test_truncated_at_every_byte(tmp_path: Path) -> None:
    whole = dataclasses.replace(shape(), source="somewhere").to_ktx2()
    path = tmp_path / "bad.ktx2"
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        refusal(path)


@pytest.mark.slow
def test_every_bit_flipped(tmp_path: Path) -> None:
    whole = bytearray(shape().to_ktx2())
    path = tmp_path / "bad.ktx2"
    for bit in range(8 * len(whole)):
        whole[bit // 8] ^= 1 << bit % 8
        path.write_bytes(whole)
        read_or_refused(path)
        whole[bit // 8] ^= 1 << bit % 8


@pytest.mark.slow
@settings(max_examples=300)
@given(packed_trees(max_quads=4), st.data())
def test_flipped_words(tmp_path: Path, tree: Tree, data: st.DataObject) -> None:
    """Damage behind the compression, which its checksum does not see."""
    texture = encode_packed([tree], [Root("x")], name="bad")
    words = texture.texels.reshape(-1)
    for _ in range(data.draw(st.integers(1, 4))):
        words[data.draw(st.integers(0, len(words) - 1))] ^= np.uint32(1 << data.draw(st.integers(0, 31)))
    (tmp_path / "bad.ktx2").write_bytes(texture.to_ktx2())
    read_or_refused(tmp_path / "bad.ktx2")


def test_the_command_line_describes_it(tmp_path: Path) -> None:
    path = str(shape().save(tmp_path))
    as_json, as_text = (CliRunner().invoke(main, ["info", path, *flags]) for flags in (["--json"], []))
    assert (as_json.exit_code, as_text.exit_code) == (0, 0)
    root = {"name": "shape", "quad": 0, "coverage": 0.0, "quads": 2, "curves": 0, "depth": 1}
    root |= {"transform": TRANSFORM.tolist(), "crs": None, "tolerance": 0.0, "paint": None}
    whole = {"encoding": "packed", "version": "1", "name": "shape", "source": None, "width": 2, "height": 1}
    whole |= {"texels": 2, "depth": 1, "bytes": 32, "roots": [root]}
    assert json.loads(as_json.output) == whole
    lines = as_text.output.splitlines()
    assert "memory      32 bytes on the GPU" in lines
    assert "shape       name shape, quad 0, coverage 0, quads 2, curves 0, depth 1" in lines
    assert "None" not in as_text.output


def test_the_command_line_describes_it_readably(tmp_path: Path) -> None:
    paint = Paint((0.0, 0.4, 0.8), 1 / 3)
    path = str(
        dataclasses.replace(shape(), roots=(Root("sea", 0, TRANSFORM / 3, 1e-4, "EPSG:28992", paint),)).save(tmp_path)
    )
    first, second = CliRunner().invoke(main, ["info", path]).output.splitlines()[-2:]
    assert first == "shape       name sea, quad 0, coverage 0, quads 2, curves 0, depth 1"
    assert " ".join(second.split()) == (
        "transform x = 8u - 0.5, y = - 8v + 0.111111, crs EPSG:28992, tolerance 0.0001, "
        "paint #0066cc at opacity 0.333333"
    )
