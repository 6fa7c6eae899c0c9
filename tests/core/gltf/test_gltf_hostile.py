"""Models that are damaged or hostile: one line for each, and nothing is written."""

import json

import pytest

import vexture

KITE = vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])


def text(**members):
    return json.dumps({"asset": {"version": "2.0"}, "materials": [{"name": "Sign"}], **members}).encode()


CHANGED = {
    "extensions": ({"extensions": []}, "extensions is no object"),
    "ours": ({"extensions": {"VEXTURE_vector_texture": 1}}, "extensions.VEXTURE_vector_texture is no object"),
    "textures": ({"extensions": {"VEXTURE_vector_texture": {"textures": 1}}}, "textures is no list of objects"),
    "used": ({"extensionsUsed": {}}, "extensionsUsed is no list"),
    "of a material": ({"materials": [{"extensions": 1}]}, "materials[0].extensions is no object"),
    "primitives": ({"meshes": [{"primitives": 1}]}, "primitives is no list of objects"),
}


@pytest.mark.parametrize("name", CHANGED)
def test_a_part_that_is_not_what_it_should_be_is_refused(name):
    members, message = CHANGED[name]
    model = vexture.read_model(text(**members), name="m")
    with pytest.raises(vexture.SourceError) as caught:
        model.with_drawing(0, KITE)
    assert str(caught.value).startswith(f"m: {message}")


OTHERWISE = {
    "link.bin": "leads out of its folder",
    "missing.bin": "cannot be read (No such file or directory)",
    "data:,abc": "is not base64",
    "data:;base64,***": "is no base64",
}
ADDRESSES = (
    *("../secret.bin", "%2e%2e/secret.bin", "..\\secret.bin", "/etc/hostname", "file:///etc/hostname", "C:\\secret"),
    *("http://a/secret.bin", "//a/b", "a\0b", "parts/../../secret.bin", *OTHERWISE),
)


@pytest.mark.parametrize("uri", ADDRESSES)
def test_only_files_beside_a_model_are_read(tmp_path, uri):
    folder = tmp_path / "models"
    folder.mkdir()
    (tmp_path / "secret.bin").write_bytes(b"secret")
    (folder / "link.bin").symlink_to(tmp_path / "secret.bin")
    (folder / "m.gltf").write_bytes(text(buffers=[{"uri": uri, "byteLength": 6}]))
    model = vexture.read_model(folder / "m.gltf").with_drawing("Sign", KITE)
    with pytest.raises(vexture.SourceError) as caught:
        model.save(tmp_path / "out.glb")
    assert str(caught.value).startswith(str(folder / "m.gltf"))
    assert OTHERWISE.get(uri, "and only files beside it or in folders there are read") in str(caught.value)
    assert str(caught.value).isprintable()
    assert not (tmp_path / "out.glb").exists()


def test_files_that_only_an_extension_knows_are_not_left_behind(tmp_path):
    (tmp_path / "m.gltf").write_bytes(text(extensions={"VENDOR_sound": {"audio": [{"uri": "ring.mp3"}]}}))
    model = vexture.read_model(tmp_path / "m.gltf").with_drawing("Sign", KITE)
    with pytest.raises(vexture.SourceError, match=r"an extension of it refers to the file ring\.mp3; write a \.gltf"):
        model.save(tmp_path / "out.glb")
    assert model.save(tmp_path / "out.gltf").is_file()


def test_half_a_character_stays_one(tmp_path):
    (tmp_path / "m.gltf").write_bytes(text(extras="\ud83d"))
    model = vexture.read_model(tmp_path / "m.gltf").with_drawing("Sign", KITE)
    assert json.loads(model.save(tmp_path / "out.gltf").read_bytes())["extras"] == "\ud83d"
