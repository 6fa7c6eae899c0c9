"""A loss of power: what an answer has acknowledged is on the disk before the answer, in an order that can be lost."""

import asyncio
import os
from pathlib import Path

import httpx
import pytest
from loops import run
from server import TOKEN, square
from starlette.applications import Starlette

from vexture.server.converter import Converter
from vexture.server.folder import STATE, Folder
from vexture.server.limits import Limits
from vexture.server.uploads import publishing_routes

FLUSHED, RENAMED, MADE, ANSWERED = "flushed", "renamed", "made", "answered"


@pytest.fixture
def steps(monkeypatch):
    """What is done to the disk, in its order; all of it is done."""
    told = []
    flush, rename, make = os.fsync, os.replace, os.mkdir

    def fsync(handle):
        flush(handle)
        told.append((FLUSHED, Path(os.readlink(f"/proc/self/fd/{handle}"))))

    def replace(source, target):
        rename(source, target)
        told.append((RENAMED, Path(source), Path(target)))

    def mkdir(path, *mode):
        make(path, *mode)
        told.append((MADE, Path(path)))

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(os, "replace", replace)
    monkeypatch.setattr(os, "mkdir", mkdir)
    return told


async def published(path, steps, bodies):
    """Send drawings to a server of a folder, and note each answer among the steps."""
    folder, converter = Folder(path, Limits(), pytest.fail), Converter(Limits())
    app = Starlette(routes=publishing_routes(folder, converter, Limits(), TOKEN))

    async def noted(scope, receive, send):
        async def sent(message):
            if message["type"] == "http.response.start":
                steps.append((ANSWERED, message["status"]))
            await send(message)

        await app(scope, receive, sent)

    transport = httpx.ASGITransport(noted)
    try:
        async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
            for name, body in bodies:
                await client.put(f"/shapes/{name}", content=body, headers={"Authorization": f"Bearer {TOKEN}"})
    finally:
        await asyncio.to_thread(converter.close)
        folder.release()


def after(steps, first, *, before):
    """Place of the first step that is like another, which comes before a place."""
    place = steps.index(first)
    assert place < before, f"{first} comes too late"
    return place


def test_all_is_flushed_in_an_order_before_the_answer(tmp_path, steps):
    """First a file's content, then its name, then the folder of the names; the manifest after the files it names."""
    path = tmp_path / "new" / "shapes"
    run(published(path, steps, [("duck", square(5)), ("duck", square(6))]))
    answers = [place for place, step in enumerate(steps) if step[0] == ANSWERED]
    assert [steps[place][1] for place in answers] == [201, 200]
    begin = 0
    for end in answers:
        part = steps[begin:end]
        renames = [step for step in part if step[0] == RENAMED]
        manifest = part.index(renames[-1])
        assert [target.parent.name for _, _, target in renames] == ["files", "files", "shapes"]
        for rename in renames:
            _, source, target = rename
            place = after(part, rename, before=len(part))
            after(part, (FLUSHED, source), before=place)
            last = manifest if target.parent.name == "files" else len(part)
            assert (FLUSHED, target.parent) in part[place:last], f"{target.name} may be lost after {part[last:]}"
        begin = end + 1
    made = [step[1] for step in steps if step[0] == MADE and path.parent in (step[1], *step[1].parents)]
    assert made == [path.parent, path, path / STATE, path / STATE / "shapes", path / STATE / "files"]
    for folder in made:
        assert (FLUSHED, folder.parent) in steps[steps.index((MADE, folder)) : answers[0]]
