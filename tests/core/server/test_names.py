"""Names that strangers send, clients that are slow, and publishers in haste."""

import asyncio
import os

import pytest
from hypothesis import given
from hypothesis import strategies as st
from loops import run

from vexture.base.errors import LimitError, ParameterError
from vexture.server.limits import Limits, Pace
from vexture.server.names import checked_name, manifest_name
from vexture.server.published import TEXTURE_TYPE, Listener, PublishedFile, PublishedShape, PublishedShapes

HOSTILE = ["", ".", "..", "../x", "a//b", "/a", "a/", "a/../b", "a/.b", "a/ b", "a\\b", ".hidden", "a\0", "a\n", " a",
           "a ", "a" * 101, "é" * 51, "a\u202eb", "a\u2044b", "\uff0e\uff0e\uff0fx", "a\ud800", "a:b", "a%2fb", "a*",
           "ａ／ｂ"]  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_are_refused_in_one_line(name):
    with pytest.raises(LimitError) as refused:
        checked_name(name)
    assert str(refused.value).isprintable()


@given(st.text(max_size=120))
def test_every_allowed_name_is_one_file_in_its_folder(name):
    try:
        allowed = checked_name(name)
    except LimitError:
        return
    assert checked_name(allowed) == allowed
    assert len(allowed.encode()) <= 100
    assert not {"\\", "\0", ":"} & set(allowed)
    assert all(part and not part.startswith(".") for part in allowed.split("/"))
    assert os.path.basename(manifest_name(allowed)) == manifest_name(allowed)


def test_two_spellings_are_one_name():
    assert checked_name("Ko\u0308ln") == checked_name("K\u00f6ln") == "Köln"


@given(st.lists(st.tuples(st.sampled_from("ab"), st.sampled_from(["put", "refuse", "remove"]), st.integers(0, 9))))
def test_a_slow_client_is_told_the_newest_of_each_name_and_no_more(steps):
    async def told():
        shelf = PublishedShapes()
        with shelf.events() as listener:
            for name, step, number in steps:
                if step == "put":
                    shelf.add(PublishedShape(name, PublishedFile(b"%d" % number, TEXTURE_TYPE, ".ktx2")))
                elif step == "refuse":
                    shelf.refuse(name, str(number))
                else:
                    shelf.remove(name)
            assert len(listener) <= 4
            known, notes = {}, {}
            while len(listener):
                event = await listener.next()
                kind, data = event.kind, event.data
                if kind == "note":
                    notes[data["name"]] = data["message"]
                else:
                    notes.pop(data["name"], None)
                    known.pop(data["name"], None)
                    known |= {data["name"]: data["version"]} if kind == "shape" else {}
            assert known == shelf.versions(shelf.names)
            assert notes == shelf.notes
            shelf.close()
            assert await listener.next() is None

    run(told())


def test_who_waits_is_woken():
    async def woken():
        listener = Listener()
        waiting = asyncio.create_task(listener.next())
        await asyncio.sleep(0)
        listener.close()
        assert await waiting is None

    run(woken())


def test_a_replaced_file_is_served_a_moment_longer():
    shelf = PublishedShapes()
    old, new = (PublishedFile(content, TEXTURE_TYPE, ".ktx2") for content in (b"old", b"new"))
    shelf.add(PublishedShape("a", old))
    shelf.add(PublishedShape("b", old))
    shelf.add(PublishedShape("a", new))
    assert (shelf.owners(old.name), shelf.nbytes) == (1, 6)
    shelf.add(PublishedShape("b", new))
    assert (shelf.owners(old.name), shelf.owners(new.name), shelf.nbytes) == (0, 2, 3)
    assert shelf.file(old.name) == old


def test_a_bucket_fills_again():
    now = 0.0
    pace = Pace(2.0, 2, lambda: now)
    assert [pace.wait("a") for _ in range(3)] == [0.0, 0.0, 0.5]
    now = 0.5
    assert [pace.wait("a"), pace.wait("a")] == [0.0, 0.5]
    now = 1000.0
    assert [pace.wait("a") for _ in range(3)] == [0.0, 0.0, 0.5]


@pytest.mark.parametrize("value", [0, -1, float("nan")])
def test_limits_are_above_zero(value):
    with pytest.raises(ParameterError, match="`rate` is"):
        Limits(rate=value)
