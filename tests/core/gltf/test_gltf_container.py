"""Containers of models that are damaged: one line for each."""

import json
import struct

import pytest

import vexture
from room_model import glb_content, make_room

WHOLE = glb_content(*make_room())


def patched(at, value):
    return WHOLE[:at] + struct.pack("<I", value) + WHOLE[at + 4 :]


def text(**members):
    return json.dumps({"asset": {"version": "2.0"}, "materials": [{"name": "Sign"}], **members}).encode()


DAMAGED = {
    "empty": (b"", "is no glTF; give a .glb or a .gltf"),
    "magic": (b"glTf" + WHOLE[4:], "is no glTF; give a .glb or a .gltf"),
    "head": (WHOLE[:11], "breaks off after 11 bytes"),
    "version 1": (patched(4, 1), "is glTF 1; vexture reads glTF 2"),
    "short": (WHOLE[:-1], f"its header says {len(WHOLE)} bytes, and it has {len(WHOLE) - 1}"),
    "no length": (patched(8, 3), "its header says 3 bytes"),
    "huge length": (patched(8, 2**32 - 1), "its header says 4294967295 bytes"),
    "huge chunk": (patched(12, 2**32 - 1), "its chunk at 20 says 4294967295 bytes"),
    "half a chunk": (
        glb_content(*make_room(), (b"XTRA", b""))[:8] + struct.pack("<I", len(WHOLE) + 4) + WHOLE[12:] + bytes(4),
        "breaks off in the head of a chunk",
    ),
    "no chunk": (struct.pack("<4sII", b"glTF", 2, 12), "its first chunk is not JSON"),
    "binary first": (glb_content({}, None)[:16] + b"BIN\0" + glb_content({}, None)[20:], "its first chunk is not JSON"),
    "no JSON": (glb_content({})[:20] + b"{]  ", "its JSON cannot be read"),
    "no UTF-8": (b'{"asset": "\xff"}', "its JSON cannot be read"),
    "no object": (glb_content([1]), "its JSON is no object"),
    "nested": (b'{"a":' * 200 + b"1" + b"}" * 200, "its JSON is nested deeper than 128 levels"),
    "nested further": (b'{"a":' + b"[" * 10**6, "its JSON cannot be read"),
    "no number": (text(a=float("nan")), "its JSON cannot be read (NaN is no number"),
    "infinite": (text(a=1).replace(b'"a": 1', b'"a": 1e999'), "its JSON has a number that is too large"),
    "digits": (text(a=1).replace(b'"a": 1', b'"a": ' + b"9" * 5000), "its JSON cannot be read"),
    "no asset": (b"{}", "asset.version is None; vexture reads glTF 2.0"),
    "asset 1": (text(asset={"version": "1.0"}), "asset.version is '1.0'"),
    "asset list": (text(asset=[]), "asset.version is None"),
    "materials": (text(materials={"a": 1}), "materials is no list of objects"),
    "material": (text(materials=[1]), "materials is no list of objects"),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_model_is_refused_in_a_line(name):
    content, message = DAMAGED[name]
    with pytest.raises(vexture.SourceError) as caught:
        vexture.read_model(content, name="m")
    assert str(caught.value).startswith(f"m: {message}")
    assert len(str(caught.value)) < 250
