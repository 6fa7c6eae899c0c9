"""Files that are saved as editors save them, while a viewer watches them."""

import asyncio
import os
from contextlib import suppress
from itertools import cycle, islice
from pathlib import Path

import pytest
from loops import run

from vexture.server import watch as watching
from vexture.server.publish_file import VIEWER_PARAMETERS, shape_of
from vexture.server.published import PublishedShapes
from viewing import SHAPES, until, viewing

DUCK, CAKE = ((SHAPES / f"{name}.svg").read_bytes() for name in ("duck", "cake"))


def in_place(path, content):
    path.write_bytes(content)


def in_pieces(path, content):
    """Half-written files can be seen in between."""
    with path.open("wb") as file:
        for start in range(0, len(content), 200):
            file.write(content[start : start + 200])
            file.flush()
            os.fsync(file.fileno())


def renamed_over(path, content):
    other = path.with_name(f".{path.name}.swp")
    other.write_bytes(content)
    other.replace(path)


def deleted_and_made_again(path, content):
    path.unlink()
    path.write_bytes(content)


def moved_away_and_made_again(path, content):
    path.replace(path.with_name(path.name + "~"))
    path.write_bytes(content)


WAYS = (in_place, in_pieces, renamed_over, deleted_and_made_again, moved_away_and_made_again)
NAMES = [*(way.__name__ for way in WAYS), "broken", "deleted", "slow", "same", "target"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("watched")
    for name in NAMES:
        (folder / f"{name}.svg").write_bytes(DUCK)
    (folder / "elsewhere").mkdir()
    (folder / "elsewhere" / "link.svg").symlink_to(folder / "target.svg")
    return folder


@pytest.fixture(scope="module")
def view(folder, tmp_path_factory):
    files = [folder / f"{name}.svg" for name in NAMES] + [folder / "elsewhere" / "link.svg"]
    with viewing(tmp_path_factory.mktemp("said"), *files, "--watch") as running:
        yield running


def shown(view, name):
    """Content of the drawing that is published."""
    return view.get(view.manifest(name)["views"]["svg"].removeprefix("../")).content


@pytest.mark.parametrize("save", WAYS)
def test_saved_drawing_is_published_however_it_is_saved(view, folder, save):
    path = folder / f"{save.__name__}.svg"
    for content in (CAKE, DUCK):
        save(path, content)
        until(lambda content=content: shown(view, path.stem) == content)
        assert view.manifest(path.stem)["note"] is None


def test_clients_are_told(view, folder):
    path = folder / "slow.svg"
    with view.events() as events:
        _, versions = next(events)
        path.write_bytes(CAKE)
        told = next((kind, data) for kind, data in events if data.get("name") == "slow")
    assert told == ("shape", {"name": "slow", "version": view.manifest("slow")["version"]})
    assert versions["versions"]["slow"] != told[1]["version"]


@pytest.mark.parametrize("content", [DUCK, CAKE], ids=["as before", "another"])
def test_garbage_becomes_a_note_and_the_last_good_drawing_stays(view, folder, content):
    path = folder / "broken.svg"
    before = view.manifest("broken")
    path.write_bytes(b"<svg")
    note = until(lambda: view.manifest("broken")["note"])
    assert note.startswith(f"{path}: not well-formed XML")
    assert "\n" not in note
    assert view.manifest("broken") == {**before, "note": note}
    path.write_bytes(content)
    until(lambda: view.manifest("broken")["note"] is None)
    assert shown(view, "broken") == content


def test_file_that_stays_away_becomes_a_note(view, folder):
    path = folder / "deleted.svg"
    path.unlink()
    assert "cannot be read" in until(lambda: view.manifest("deleted")["note"])
    assert shown(view, "deleted") == DUCK
    path.write_bytes(DUCK)
    until(lambda: view.manifest("deleted")["note"] is None)


def test_link_is_followed(view, folder):
    (folder / "target.svg").write_bytes(CAKE)
    until(lambda: shown(view, "link") == CAKE)
    other = folder / "elsewhere" / "other"
    other.symlink_to(folder / "same.svg")
    other.replace(folder / "elsewhere" / "link.svg")
    until(lambda: shown(view, "link") == DUCK)


def test_change_is_noticed_when_it_happens(tmp_path, monkeypatch):
    """Not only when files are looked at anyway, which here is never."""
    monkeypatch.setattr(watching, "CHECK_MILLISECONDS", 3_600_000)
    path = tmp_path / "logo.svg"
    path.write_bytes(DUCK)

    async def convert(source, data):
        return shape_of(data, str(source.path), source.name, VIEWER_PARAMETERS)

    async def notice():
        shelf = PublishedShapes()
        task = asyncio.create_task(watching.watch(shelf, watching.name_files([path]), convert, {"logo": DUCK}))
        with shelf.events() as listener:
            for content in islice(cycle([CAKE, DUCK]), 20):  # the first may come before watching has begun
                path.write_bytes(content)
                with suppress(TimeoutError):
                    async with asyncio.timeout(1.0):
                        event = await listener.next()
                        break
            else:
                pytest.fail("no change was noticed")
        task.cancel()
        with suppress(asyncio.CancelledError):
            await task
        return event

    event = run(notice())
    assert (event.kind, event.data["name"]) == ("shape", "logo")


def test_one_name_each():
    names = [
        source.name for source in watching.name_files([Path("a/b.svg"), Path("b.svg"), Path("b-2.svg"), Path("b.ktx2")])
    ]
    assert len(set(names)) == 4
