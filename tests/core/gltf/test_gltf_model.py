"""Drawings on materials of models: what is written, and that everything else stays."""

import json
import warnings
from pathlib import Path

import pytest
from click.testing import CliRunner
from textured_models import EXTENSION, KITE, bytes_of, digest, without_extension

import vexture
from room_model import chunks_of, document_of, glb_content, make_room
from vexture.cli.main import main

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path fill="#06c" d="M1 1h7v7z"/>'
    '<path d="M1 2v6h6z"/></svg>'
)


@pytest.fixture(scope="module")
def kite():
    return vexture.convert(KITE)


@pytest.fixture
def drawing(tmp_path):
    file = tmp_path / "mark.svg"
    file.write_text(SVG)
    return file


def run(*arguments):
    return CliRunner().invoke(main, ["gltf", *map(str, arguments)])


def test_everything_else_in_a_glb_stays(kite, tmp_path):
    other = (b"XTRA", b"kept")
    document, binary = make_room(extensionsUsed=["VENDOR_a"], extensions={"VENDOR_a": {"deep": [{"x": 0.1}]}})
    before = glb_content(document, binary, other)
    model = vexture.read_model(before)
    after = model.with_drawing("Sign", kite, mode="cut", threshold=0.25).save(tmp_path / "after.glb").read_bytes()
    written = document_of(after)
    assert written["materials"][0]["extensions"] == {EXTENSION: {"texture": 0, "mode": "cut", "threshold": 0.25}}
    assert written["extensions"][EXTENSION]["textures"] == [
        {"name": "drawing", "mimeType": "image/ktx2", "bufferView": len(document["bufferViews"])}
    ]
    assert written["extensionsUsed"] == ["VENDOR_a", EXTENSION]
    assert "extensionsRequired" not in written
    cleaned = without_extension(written)
    assert (cleaned["bufferViews"].pop(), cleaned["buffers"].pop()) == (
        {"buffer": 0, "byteOffset": len(binary), "byteLength": len(kite.to_ktx2())},
        {"byteLength": len(binary) + len(kite.to_ktx2())},
    )
    assert cleaned == {**document, "buffers": []}
    assert chunks_of(after)[2] == other
    assert digest(chunks_of(after)[1][1][: len(binary)]) == digest(binary)
    assert digest(bytes_of(after)) == digest(kite.to_ktx2())
    assert model.container.document == document, "a model is never changed"


def test_materials_share_a_texture_and_a_new_one_takes_the_place_of_an_old_one(kite):
    before = glb_content(*make_room())
    both = vexture.read_model(before).with_drawing("Sign", kite).with_drawing("Wall", kite, mode="mix", color="red")
    (content,) = both.files("a.glb").values()
    materials = document_of(content)["materials"]
    assert [one["extensions"][EXTENSION]["texture"] for one in materials] == [0, 0]
    assert materials[1]["extensions"][EXTENSION]["color"] == [1.0, 0.0, 0.0]
    full = vexture.convert(vexture.Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]))
    (one_other,) = vexture.read_model(content).with_drawing("Sign", full).files("a.glb").values()
    assert [one["extensions"][EXTENSION]["texture"] for one in document_of(one_other)["materials"]] == [1, 0]
    assert [digest(bytes_of(one_other, place)) for place in (0, 1)] == [digest(kite.to_ktx2()), digest(full.to_ktx2())]
    (replaced,) = vexture.read_model(one_other).with_drawing("Sign", kite).files("a.glb").values()
    assert len(document_of(replaced)["extensions"][EXTENSION]["textures"]) == 2
    assert digest(bytes_of(replaced, 1)) == digest(kite.to_ktx2())


def test_a_material_is_found_by_its_name_or_its_place():
    document = make_room(materials=[{"name": "1"}, {}, {"name": "a"}, {"name": "a"}, {"name": 3}])[0]
    model = vexture.read_model(json.dumps(document).encode(), name="m")
    assert [model.place_of(one) for one in ("1", 1, "4", 3)] == [0, 1, 4, 3]
    for wanted, message in (
        ("a", "m: 2 materials are named 'a'; give the place of one: 2, 3"),
        ("b", "m: no material 'b'; its materials are '1', 1, 'a', 'a', 4"),
        (5, "m: no material 5; its materials are '1', 1, 'a', 'a', 4"),
        (-1, "m: no material -1; its materials are '1', 1, 'a', 'a', 4"),
        (True, "m: no material True; its materials are '1', 1, 'a', 'a', 4"),
    ):
        with pytest.raises(vexture.ParameterError) as caught:
            model.place_of(wanted)
        assert str(caught.value) == message


def test_a_mesh_that_cannot_show_the_drawing_is_named(kite):
    model = vexture.read_model(glb_content(*make_room()), name="room")
    with pytest.warns(vexture.SourceWarning, match=r"^room: the mesh 'Box' has no texture coordinates 1, so"):
        model.with_drawing("Wall", kite, tex_coord=1)


def test_the_command_puts_drawings_on_materials(drawing, tmp_path):
    (tmp_path / "room.glb").write_bytes(glb_content(*make_room()))
    assert run(tmp_path / "room.glb", "--list").stdout == "0 Sign\n1 Wall\n"
    vexture.atlas([drawing, KITE]).save(tmp_path / "icons.ktx2")
    pairs = ("--material", "Sign", "--drawing", drawing, "--material", "1", "--drawing", tmp_path / "icons.ktx2")
    result = run(tmp_path / "room.glb", *pairs, "-o", tmp_path / "new.glb")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "atlas holds 2 drawings (mark, drawing); choose one by --root" in result.stderr
    assert not (tmp_path / "new.glb").exists()
    result = run(tmp_path / "room.glb", *pairs[:4], "-o", tmp_path / "new.glb", "--rotation", 90, "--offset", "0,1")
    content = (tmp_path / "new.glb").read_bytes()
    assert result.stdout == f"{tmp_path / 'new.glb'}: drawings on 'Sign'; new.glb {len(content)} bytes\n"
    shown = document_of(content)["materials"][0]["extensions"][EXTENSION]
    assert shown["transform"] == {"offset": [0.0, 1.0], "rotation": pytest.approx(-1.5707963)}
    (tmp_path / "drawn.ktx2").write_bytes(bytes_of(content))
    root = vexture.load(tmp_path / "drawn.ktx2").roots[0]
    assert (root.name, root.is_map) == ("mark", True)
    icons = ("--material", "Wall", "--drawing", tmp_path / "icons.ktx2", "--root", "drawing", "--mode", "mix")
    result = run(tmp_path / "new.glb", *icons, "-q", "--color", "#36c", "-o", tmp_path / "both.glb")
    assert (result.exit_code, result.output) == (0, "")
    shown = document_of((tmp_path / "both.glb").read_bytes())["materials"][1]["extensions"][EXTENSION]
    assert shown == {"texture": 1, "root": "drawing", "mode": "mix", "color": [0.033105, 0.132868, 0.603827]}


def test_the_command_says_in_a_line_what_is_wrong(drawing, tmp_path):
    model = tmp_path / "room.glb"
    model.write_bytes(glb_content(*make_room()))
    (tmp_path / "lossy.svg").write_text(SVG.replace("</svg>", "<foreignObject/></svg>"))
    right = ("--material", "Sign", "--drawing", drawing, "-o", tmp_path / "out.glb")
    for arguments, message in (
        ((model,), "--material is missing; give one, or --list to print the materials"),
        ((model, *right[:2]), "--drawing is missing; give one, or --list to print the materials"),
        ((model, *right[:4]), "--output is missing; give one, or --list to print the materials"),
        ((model, *right, "--list"), "--list only prints the materials; leave the other options out"),
        ((model, *right, "--drawing", drawing), "there are 2 drawings for 1 materials; give a --drawing for each"),
        ((model, "--material", "Sing", *right[2:]), f"{model}: no material 'Sing'; its materials are 'Sign', 'Wall'"),
        ((model, "--material", "Sing", "--drawing", tmp_path / "no.svg", *right[4:]), f"{model}: no material 'Sing'"),
        ((model, *right[:4], "-o", tmp_path / "out.obj"), f"--output {tmp_path / 'out.obj'}: models are files of glTF"),
        ((drawing, *right), f"{drawing}: is no glTF; give a .glb or a .gltf of glTF 2.0"),
        ((tmp_path / "no.glb", *right), f"{tmp_path / 'no.glb'}: cannot be read: No such file or directory"),
        ((model, *right, "--threshold", "0.1"), "--threshold is for the mode cut; leave it out"),
        ((model, *right[:3], tmp_path / "lossy.svg", *right[4:], "--strict"), f"{tmp_path / 'lossy.svg'}: "),
    ):
        result = run(*arguments)
        assert result.stderr.startswith(f"vexture: {message}"), result.stderr
        assert (result.exit_code, result.stderr.count("\n"), result.stdout) == (1, 1, "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lossy.svg", "mark.svg", "room.glb"]


def test_a_texture_takes_no_options_of_a_conversion(kite, tmp_path):
    file = kite.save(tmp_path / "kite.ktx2")
    with pytest.raises(vexture.ParameterError, match="`precision` is for drawings, and drawing is a texture already"):
        vexture.read_model(glb_content(*make_room())).with_drawing("Sign", file, conversion={"precision": 1e-7})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert vexture.read_model(glb_content(*make_room())).with_drawing(
            "Sign", Path(file), mode="mix"
        ).textures.keys() == {0}
