import os
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from vexture.base.errors import DeviceError
from vexture.texture.files import file_name, target_of, writable
from vexture.texture.load import load_any as load
from vexture.thesis.texture import ThesisTexture, pair_of

FULL = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8), name="full")
PAIR = ["full.curves.png", "full.quads.png"]


def names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.rglob("*") if file.is_file())


@pytest.mark.parametrize("target", ["", "/", "new/deep/", "full", "full.png", "full.quads.png", "full.curves.png"])
def test_where_a_texture_goes(tmp_path: Path, target: str) -> None:
    quads, curves = FULL.save(f"{tmp_path}/{target}" if target else tmp_path)
    assert (quads.name, curves.name) == (PAIR[1], PAIR[0])
    assert names(tmp_path) == PAIR
    for path in (quads, str(curves), quads.parent / "full", quads.parent / "full.png"):
        assert load(path).name == "full"


def test_a_stem_may_have_dots(tmp_path: Path) -> None:
    quads, _ = FULL.save(tmp_path / "icon.v2")
    assert quads.name == "icon.v2.quads.png"
    assert load(tmp_path / "icon.v2").name == "icon.v2"


def test_files_are_as_readable_as_others(tmp_path: Path) -> None:
    quads, _ = FULL.save(tmp_path)
    other = tmp_path / "other"
    other.write_bytes(b"")
    assert quads.stat().st_mode == other.stat().st_mode


@settings(max_examples=40)
@given(st.text())
@example("..")
@example(".hidden")
@example(" . ")
def test_a_name_cannot_leave_the_folder(name: str) -> None:
    safe = file_name(name)
    assert safe == Path(safe).name
    assert safe not in ("", ".", "..")
    assert not safe.startswith(".")
    assert len(os.fsencode(safe)) <= 200
    assert pair_of(Path("folder") / (safe + ".quads.png"))[0] == Path("folder") / (safe + ".quads.png")


@pytest.mark.parametrize("name", ["../up", "/etc/passwd", "a\\b", "a\0b", "\udcff", "..", "x" * 5000, "漢" * 5000])
def test_hostile_names_are_saved_inside(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "inner"
    quads, curves = ThesisTexture(FULL.quads, FULL.curves, name=name).save(f"{folder}/")
    assert quads.parent == curves.parent == folder
    assert len(names(tmp_path)) == 2


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    for target in (tmp_path / "file" / "x", "/proc/vexture/"):
        with pytest.raises(DeviceError, match=r"cannot be written \(.*choose another place") as caught:
            FULL.save(target)
        assert "\n" not in str(caught.value)
    assert names(tmp_path) == ["file"]


def test_both_files_or_none(tmp_path: Path) -> None:
    """The second file's place is taken by a folder: the first is not left behind either."""
    (tmp_path / "full.curves.png").mkdir()
    with pytest.raises(DeviceError, match=r"full\.curves\.png"):
        FULL.save(tmp_path)
    assert names(tmp_path) == []


def test_an_old_pair_is_replaced(tmp_path: Path) -> None:
    FULL.save(tmp_path)
    empty = ThesisTexture(np.full((1, 4, 3), [0, 255, 0], np.uint8), FULL.curves, name="full")
    empty.save(tmp_path)
    assert names(tmp_path) == PAIR
    np.testing.assert_array_equal(load(tmp_path / "full").quads, empty.quads)


def test_file_names_of_drawings() -> None:
    assert file_name("../../etc/passwd") == "_.._etc_passwd"
    assert file_name("") == "drawing"
    assert file_name("kaart van Delft") == "kaart van Delft"


def test_a_packed_texture_goes_in_a_folder_or_to_the_path_itself() -> None:
    assert target_of("maps/", "delft") == Path("maps/delft.ktx2")
    assert target_of("maps/all.ktx2", "delft") == Path("maps/all.ktx2")


def test_a_folder_in_a_file_cannot_be_made() -> None:
    message = "/dev/null/report: cannot be written (/dev/null is no folder); choose another place"
    with pytest.raises(DeviceError, match=f"^{re.escape(message)}$"):
        writable(Path("/dev/null/report"))
