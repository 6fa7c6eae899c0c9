"""Published shapes: what slow clients are told of them, and how long their files are served."""

import asyncio

from hypothesis import given
from hypothesis import strategies as st
from loops import run

from vexture.server.published import TEXTURE_TYPE, Listener, PublishedFile, PublishedShape, PublishedShapes


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
