"""Drawings on materials of models: what is written, and that everything else stays."""

import hashlib
import json
import warnings
from base64 import b64decode
from io import BytesIO
from pathlib import Path

import pytest
from click.testing import CliRunner
from PIL import Image

import vexture
from room_model import chunks_of, document_of, glb_content, make_room
from vexture.cli.main import main

EXTENSION = "VEXTURE_vector_texture"
KITE = vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])
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


def digest(content):
    return hashlib.sha256(content).hexdigest()


def without_extension(document):
    """A document without all that vexture adds to it."""
    cleaned = json.loads(json.dumps(document))
    for owner in (cleaned, *cleaned.get("materials", [])):
        owner.get("extensions", {}).pop(EXTENSION, None)
        if owner.get("extensions") == {}:
            del owner["extensions"]
    cleaned["extensionsUsed"] = [name for name in cleaned.get("extensionsUsed", []) if name != EXTENSION]
    return cleaned


def bytes_of(content, index=0):
    """File of a texture in a .glb."""
    (_, text), (_, binary), *_ = chunks_of(content)
    document = json.loads(text)
    texture = document["extensions"][EXTENSION]["textures"][index]
    view = document["bufferViews"][texture["bufferView"]]
    assert view["buffer"] == 0
    assert view["byteOffset"] + view["byteLength"] <= document["buffers"][0]["byteLength"] <= len(binary)
    return binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]


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


@pytest.mark.parametrize("indent", [None, "\t", "  "])
def test_a_gltf_has_its_texture_beside_it(kite, tmp_path, indent):
    document, binary = make_room()
    (tmp_path / "room.bin").write_bytes(binary)
    document["buffers"][0]["uri"] = "room.bin"
    text = json.dumps(document, indent=indent, ensure_ascii=False, separators=None if indent else (",", ":"))
    (tmp_path / "room.gltf").write_text(text, encoding="utf-8")
    model = vexture.read_model(tmp_path / "room.gltf").with_drawing(1, kite, mode="alpha", tex_coord=0)
    written = model.save(tmp_path / "new.gltf").read_text(encoding="utf-8")
    assert without_extension(json.loads(written)) == {**document, "extensionsUsed": []}
    assert indent is None or {line for line in text.splitlines() if "name" in line} <= {*written.splitlines()}
    assert json.loads(written)["extensions"][EXTENSION]["textures"][0]["uri"] == "new.drawing.ktx2"
    assert digest((tmp_path / "new.drawing.ktx2").read_bytes()) == digest(kite.to_ktx2())
    with pytest.raises(vexture.ParameterError, match=r"refers to room\.bin beside it; write it into the same folder"):
        model.save(tmp_path / "elsewhere" / "new.gltf")


def test_a_gltf_becomes_a_glb_with_all_that_is_beside_it(kite, tmp_path):
    picture = BytesIO()
    Image.new("RGB", (2, 2), "red").save(picture, "PNG")
    document, binary = make_room(images=[{"uri": "a%20b.png"}, {"uri": "data:image/png;base64,AA=="}])
    (tmp_path / "a b.png").write_bytes(picture.getvalue())
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "room.bin").write_bytes(binary)
    (tmp_path / "two.bin").write_bytes(b"twotwo")
    document["buffers"] = [{**document["buffers"][0], "uri": "parts/room.bin"}, {"uri": "two.bin", "byteLength": 6}]
    (tmp_path / "room.gltf").write_text(json.dumps(document))
    first = vexture.read_model(tmp_path / "room.gltf").with_drawing("Sign", kite).save(tmp_path / "first.gltf")
    again = vexture.read_model(first).with_drawing("Wall", kite, mode="mix")
    (content,) = again.files(tmp_path / "elsewhere" / "room.glb").values()
    written = document_of(content)
    assert digest(chunks_of(content)[1][1][: len(binary)]) == digest(binary)
    assert "uri" not in written["buffers"][0]
    assert b64decode(written["buffers"][1]["uri"].partition(",")[2]) == b"twotwo"
    assert written["images"][1] == document["images"][1]
    view = written["bufferViews"][written["images"][0]["bufferView"]]
    assert written["images"][0]["mimeType"] == "image/png"
    start = view["byteOffset"]
    assert chunks_of(content)[1][1][start : start + view["byteLength"]] == picture.getvalue()
    assert [digest(bytes_of(content, place)) for place in (0, 1)] == [digest(kite.to_ktx2())] * 2


def test_a_glb_becomes_a_gltf_with_its_bytes_beside_it(kite, tmp_path):
    document, binary = make_room()
    model = vexture.read_model(glb_content(document, binary)).with_drawing("Sign", kite)
    written = json.loads(model.save(tmp_path / "my room.gltf").read_text())
    assert written["buffers"] == [{**document["buffers"][0], "uri": "my%20room.bin"}]
    assert digest((tmp_path / "my room.bin").read_bytes()) == digest(binary)
    extra = vexture.read_model(glb_content(document, binary, (b"XTRA", b"kept")))
    with pytest.raises(vexture.ParameterError, match=r"only a \.glb can hold"):
        extra.files(tmp_path / "extra.gltf")


def test_a_glb_with_a_file_beside_it_takes_it_to_another_folder(kite, tmp_path):
    picture = BytesIO()
    Image.new("RGB", (2, 2), "red").save(picture, "PNG")
    (tmp_path / "a.png").write_bytes(picture.getvalue())
    document, binary = make_room(images=[{"uri": "a.png"}])
    (tmp_path / "room.glb").write_bytes(glb_content(document, binary))
    model = vexture.read_model(tmp_path / "room.glb").with_drawing("Sign", kite)
    (same,) = model.files(tmp_path / "new.glb").values()
    (other,) = model.files(tmp_path / "elsewhere" / "new.glb").values()
    assert document_of(same)["images"] == document["images"]
    (image,) = document_of(other)["images"]
    view = document_of(other)["bufferViews"][image["bufferView"]]
    start = view["byteOffset"]
    assert digest(chunks_of(other)[1][1][start : start + view["byteLength"]]) == digest(picture.getvalue())
    for content in (same, other):
        assert digest(chunks_of(content)[1][1][: len(binary)]) == digest(binary)
        assert digest(bytes_of(content)) == digest(kite.to_ktx2())


def test_a_model_whose_bytes_are_elsewhere_holds_the_texture_as_an_address(kite):
    for document in (
        make_room(buffers=[{"uri": "data:,", "byteLength": 0}])[0],
        make_room(buffers=[{"byteLength": 4}])[0],
    ):
        (content,) = vexture.read_model(glb_content(document)).with_drawing("Sign", kite).files("a.glb").values()
        (texture,) = document_of(content)["extensions"][EXTENSION]["textures"]
        assert digest(b64decode(texture["uri"].removeprefix("data:image/ktx2;base64,"))) == digest(kite.to_ktx2())
        assert document_of(content)["buffers"] == document["buffers"]
    (content,) = (
        vexture.read_model(glb_content({"asset": {"version": "2.0"}, "materials": [{}]}))
        .with_drawing(0, kite)
        .files("a.glb")
        .values()
    )
    assert digest(bytes_of(content)) == digest(kite.to_ktx2())


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


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"mode": "glow"}, "`mode` is 'glow'; it must be one of 'paint', 'mix', 'cut', 'alpha'"),
        ({"wrap": "mirror"}, "`wrap` is 'mirror'; it must be one of 'none', 'clamp', 'repeat'"),
        ({"tex_coord": 2}, "`tex_coord` is 2; it must be one of 0, 1"),
        ({"color": "red"}, "`color` is for the mode mix; leave it out"),
        ({"invert": True}, "`invert` is for the mode mix or cut or alpha; leave it out"),
        ({"mode": "cut", "threshold": 2}, "`threshold` is 2; it must be a coverage, 0 to 1"),
        ({"mode": "mix", "color": "rgb(0 0 0 / 0.5)"}, "`color` is 'rgb(0 0 0 / 0.5)'; give an opaque CSS colour"),
        ({"scale": (1,)}, "`scale` is (1,); it must be two finite numbers"),
        ({"scale": (2, 0)}, "`scale` is (2, 0); by 0 the drawing is a line; give other numbers"),
        ({"rotation": float("nan")}, "`rotation` is nan; it must be a finite number"),
        ({"root": "nobody"}, "drawing: no shape 'nobody'; there is 'drawing'"),
        ({"mode": "cut", "root": 1}, "drawing: no shape 1; they are numbered 0 to 0"),
    ],
)
def test_an_appearance_that_cannot_be_is_refused(kite, given, message):
    with pytest.raises(vexture.ParameterError) as caught:
        vexture.read_model(glb_content(*make_room())).with_drawing("Sign", kite, **given)
    assert str(caught.value).startswith(message)


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
