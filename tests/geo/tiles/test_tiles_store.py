"""Finished parts of a pyramid on disk: what is whole is there again, and nothing else."""

import hashlib

import pytest

from vexture.base.errors import DeviceError
from vexture_geo.tiles.store import JOURNAL, Store
from vexture_geo.tiles.subtree import JobResult

KEY = {"source": "parcels", "zoom": 4}


def result(*tiles, geometry=b""):
    made = JobResult(geometry=geometry)
    for first, count, content in tiles:
        made.add(first, count, content)
    return made


@pytest.fixture
def folder(tmp_path):
    store = Store(tmp_path / "out.parts", KEY)
    store.add("leaf-1", result((5, 2, b"sea"), (9, 1, b"land"), geometry=b"coast"))
    store.add("leaf-2", result((7, 2, b"sea"), (10, 1, b"island")))
    store.close()
    return store.folder


def test_runs_of_equal_tiles_are_joined_and_contents_read(folder):
    store = Store(folder, KEY)
    runs, contents = store.tiles()
    store.close()
    sea, land, island = (hashlib.sha256(content).hexdigest() for content in (b"sea", b"land", b"island"))
    assert runs == [(5, 4, sea), (9, 1, land), (10, 1, island)]
    assert {digest: content.read() for digest, content in contents.items()} == {
        sea: b"sea",
        land: b"land",
        island: b"island",
    }
    assert (store.geometry("leaf-1"), store.geometry("leaf-2")) == (b"coast", b"")


def test_what_the_journal_does_not_confirm_is_made_again(folder):
    pack = folder / "leaf-1"
    pack.write_bytes(pack.read_bytes().replace(b"coast", b"ghost"))
    with (folder / JOURNAL).open("a") as journal:
        journal.write("leaf-3 half of a li")
    store = Store(folder, KEY)
    assert [store.has(name) for name in ("leaf-1", "leaf-2", "leaf-3")] == [False, True, False]
    store.close()


def test_parts_of_another_pyramid_are_removed(folder):
    store = Store(folder, {**KEY, "zoom": 5})
    assert not store.has("leaf-2")
    assert store.tiles() == ([], {})
    assert not (folder / "leaf-2").exists()
    store.close()


def test_the_source_is_read_once(folder):
    store = Store(folder, KEY)
    assert store.read_parts() is None
    assert not store.has_parts
    (store.sources / "a").write_text("half of the source")
    store.close()
    store = Store(folder, KEY)
    assert store.read_parts() is None  # so what is there of it goes
    assert [*store.sources.iterdir()] == []
    store.write_parts([[1, 2]])
    store.close()
    store = Store(folder, KEY)
    assert (store.has_parts, store.read_parts()) == (True, [[1, 2]])
    store.remove()
    assert not folder.exists()


def test_two_processes_do_not_make_one_pyramid_and_folders_of_others_stay(folder, tmp_path):
    store = Store(folder, KEY)
    with pytest.raises(DeviceError, match="another process makes this pyramid now"):
        Store(folder, KEY)
    store.close()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("years of work")
    with pytest.raises(DeviceError, match="holds something else; move it away"):
        Store(tmp_path / "mine", KEY)
    assert (tmp_path / "mine" / "thesis.txt").exists()
