"""Files and bytes beside a model: textures, buffers, pictures."""

import json
from base64 import b64decode
from io import BytesIO

import pytest
from PIL import Image
from textured_models import EXTENSION, KITE, bytes_of, digest, without_extension

import vexture
from room_model import chunks_of, document_of, glb_content, make_room


@pytest.fixture(scope="module")
def kite():
    return vexture.convert(KITE)


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
