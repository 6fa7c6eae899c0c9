"""A server that is killed at any moment has lost nothing that it acknowledged, and serves only whole shapes."""

import http.client
import json
import os
import random
import threading

import pytest
from loops import run
from server import serving, square

from vexture.base.errors import DeviceError
from vexture.server.folder import STATE, Folder
from vexture.server.limits import Limits
from vexture.server.names import manifest_name
from vexture.server.published import TEXTURE_TYPE, PublishedFile, PublishedShape
from vexture.texture.load import texture_from

LOST = (OSError, http.client.HTTPException, ValueError)


@pytest.mark.parametrize("rounds", [
    2,
    pytest.param(200, marks=[pytest.mark.slow, pytest.mark.timeout(3600)]),
])  # fmt: skip
def test_kill_at_random_moments(tmp_path, rounds):
    chance = random.Random(4)
    folder = tmp_path / "shapes"
    acknowledged, sent = {}, {"a": set(), "b": set()}
    height = 0
    for _ in range(rounds):
        with serving(folder, "--rate", 1000) as server:
            for name, last in acknowledged.items():
                found = server.manifest(name)
                drawing = server.ask("GET", found["views"]["svg"][2:])[2]
                assert drawing in {last, *sent[name]}
                texture_from(server.ask("GET", found["texture"][2:])[2], name)
                assert found["facts"]["segments"] == 4
            assert server.put("a", square(1))[0] in (200, 201)  # it converts now
            acknowledged["a"] = square(1)
            sent["a"].clear()
            killer = threading.Timer(chance.uniform(0.0, 0.3), server.process.kill)
            killer.start()
            try:
                for _ in range(10_000):  # which no server takes in so short a time
                    height += 1
                    name, body = "ab"[height % 2], square(1 + height % 7) + b" " * height
                    sent[name].add(body)
                    if server.put(name, body)[0] in (200, 201):
                        acknowledged[name] = body
                        sent[name].clear()
                pytest.fail("the server outlived its killing")
            except LOST:
                killer.join()
    assert height >= rounds
    with serving(folder) as server:
        for name, last in acknowledged.items():
            assert server.ask("GET", server.manifest(name)["views"]["svg"][2:])[2] in {last, *sent[name]}
        kept = {file.name for file in (folder / STATE / "files").iterdir()}
        # what was sent last may be there though nobody heard of it
        manifests = [
            server.manifest(name) for name in sent if (folder / STATE / "shapes" / manifest_name(name)).exists()
        ]
        assert len(manifests) >= len(acknowledged)
        named = {one["texture"].rpartition("/")[2] for one in manifests}
        assert kept == named | {one["views"]["svg"].rpartition("/")[2] for one in manifests}


@pytest.fixture
def shape():
    return PublishedShape(
        "duck",
        PublishedFile(b"texture", TEXTURE_TYPE, ".ktx2"),
        {"segments": 1},
        {"svg": PublishedFile(b"s", "a/b", ".svg")},
    )


async def published(path, *shapes, say=pytest.fail):
    folder = Folder(path, Limits(), say)
    try:
        for shape in shapes:
            await folder.publish(shape)
    finally:
        folder.release()


def reopened(path):
    lines = []
    folder = Folder(path, Limits(), lines.append)
    folder.release()
    return folder, lines


def test_what_is_published_is_there_again(tmp_path, shape):
    run(published(tmp_path, shape))
    folder, lines = reopened(tmp_path)
    assert (folder.shape("duck"), lines) == (shape, [])


@pytest.mark.parametrize(
    "damage",
    [b"", b"{", b"[]", b"{}", b"[" * 100_000, b'{"name": "../x"}', b'{"name": "other"}', b"\xff\xfe", b"null",
     json.dumps({"name": "duck", "texture": {"file": "../lock", "type": "a"}, "views": {}, "facts": {}}).encode(),
     json.dumps({"name": "duck", "texture": {"file": "", "type": "a"}, "views": {}, "facts": {}}).encode()],
)  # fmt: skip
def test_a_damaged_manifest_is_one_line_and_others_are_served(tmp_path, shape, damage):
    other = PublishedShape("other", PublishedFile(b"x", TEXTURE_TYPE, ".ktx2"))
    run(published(tmp_path, shape, other))
    (tmp_path / STATE / "shapes" / manifest_name("duck")).write_bytes(damage)
    folder, lines = reopened(tmp_path)
    assert folder.names == ["other"]
    assert len(lines) == 1
    assert "\n" not in lines[0]
    assert (tmp_path / STATE / "files" / shape.texture.name).exists()  # for who mends the manifest


@pytest.mark.parametrize("content", [None, b"textur", b""])
def test_a_damaged_texture_is_one_line(tmp_path, shape, content):
    run(published(tmp_path, shape))
    file = tmp_path / STATE / "files" / shape.texture.name
    file.unlink() if content is None else file.write_bytes(content)
    folder, lines = reopened(tmp_path)
    assert (folder.names, len(lines)) == ([], 1)
    run(published(tmp_path, shape, say=[].append))
    assert reopened(tmp_path)[0].names == ["duck"]


def test_what_a_crash_leaves_is_removed(tmp_path, shape):
    run(published(tmp_path, shape))
    for name in ("files/x.ktx2.tmp", "files/0123.ktx2", "shapes/x.json.tmp"):
        (tmp_path / STATE / name).write_bytes(b"part")
    folder, lines = reopened(tmp_path)
    assert (folder.names, lines) == (["duck"], [])
    left = sorted(path.name for path in (tmp_path / STATE).rglob("*") if path.is_file())
    assert left == sorted(["lock", manifest_name("duck"), *(file.name for file in shape.files)])


def test_the_disk_refuses(tmp_path, shape, monkeypatch):
    run(published(tmp_path, shape))
    newer = PublishedShape("duck", PublishedFile(b"newer", TEXTURE_TYPE, ".ktx2"))

    def full(handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(DeviceError, match="No space left"):
        run(published(tmp_path, newer))
    monkeypatch.undo()
    assert reopened(tmp_path)[0].shape("duck") == shape
    assert not list((tmp_path / STATE).rglob("*.tmp"))


def test_nothing_waits_for_a_dead_servers_lock(tmp_path):
    with serving(tmp_path / "shapes") as server:
        server.process.kill()
        server.process.wait()
        with serving(tmp_path / "shapes") as again:
            assert again.ask("GET", "/shapes")[0] == 200
