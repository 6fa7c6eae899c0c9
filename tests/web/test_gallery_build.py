"""The build of the gallery: what it says, keeps and copies, and the sources of its examples."""

import runpy
import shutil
import sys
import types
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from chromium import ROOT

sys.path.append(str(ROOT / "tools"))

import gallery_data
import gallery_pages

EXAMPLES = {one.name: one for one in gallery_pages.examples()}
RUNNING = [name for name, one in EXAMPLES.items() if one.libraries]
MOST_LINES = 66
LONGEST_LINE = 140  # characters


@pytest.mark.parametrize("name", EXAMPLES)
def test_sources_are_short(name: str) -> None:
    assert 5 < len(EXAMPLES[name].source.splitlines()) < MOST_LINES
    assert max(map(len, EXAMPLES[name].source.splitlines())) <= LONGEST_LINE


@pytest.mark.parametrize("name", RUNNING)
def test_an_example_has_controls_and_its_picture_sets_those_that_it_has(name: str) -> None:
    assert "./helpers.js" in EXAMPLES[name].source
    assert "helpers" in EXAMPLES[name].libraries
    assert [label for label in EXAMPLES[name].picture if f"'{label}'" not in EXAMPLES[name].source] == []


def test_building_says_what_it_fetches(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    package = gallery_data.corpora.Package("drawings", "1.2.3", "files")

    def install(self: Any, npm: str, prefix: Path) -> None:
        assert capsys.readouterr().out == "fetching drawings 1.2.3 by npm ...\n"
        (prefix / "node_modules" / "drawings" / "files").mkdir(parents=True)

    monkeypatch.setenv("VEXTURE_CORPORA", str(tmp_path))
    monkeypatch.setattr(gallery_data.corpora.Package, "install", install)
    monkeypatch.setattr(shutil, "which", lambda name: name)
    for _ in range(2):
        assert gallery_data.fetched_folder(package).is_dir()
        assert capsys.readouterr().out == ""


def test_a_page_of_its_own_is_built_and_comes_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    site = tmp_path / "site"
    site.mkdir()

    def build_page(target: Path, links: str) -> None:
        target.parent.mkdir()
        target.write_text(f"a page, {links}")

    monkeypatch.setitem(sys.modules, "make_play", types.SimpleNamespace(build_page=build_page))
    page = gallery_pages.OwnPage("play", "Play <here>", "One's own drawing.", "all")
    tool = runpy.run_path(str(ROOT / "tools" / "make_gallery.py"))
    tool["build_own_pages"](site, [page])
    assert (site / "play" / "index.html").read_text() == 'a page, <a href="../index.html">Gallery</a>'
    tool["drawn_thumbnail"](site, page)
    gallery_pages.write_index(site, [page, EXAMPLES["logo"]], "")
    index = (site / "index.html").read_text(encoding="utf-8")
    assert 0 < index.index('href="play/index.html"') < index.index('href="logo/index.html"')
    assert "Play &lt;here&gt;" in index
    assert (site / "play" / "thumbnail.jpg").is_file()


def test_building_says_each_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    example = replace(EXAMPLES["logo"], commands=("vexture info --help",), files=())
    runpy.run_path(str(ROOT / "tools" / "make_gallery.py"))["make_files"](tmp_path, example, quick=True)
    assert capsys.readouterr().out.splitlines() == ["logo: making logo.svg ...", "logo: vexture info --help ..."]


def test_files_that_nothing_has_changed_for_are_not_made_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_gallery.py"))
    example = replace(EXAMPLES["logo"], commands=("vexture info --help",), files=("logo.svg",))

    def said(one: Any, *, quick: bool = True) -> list[str]:
        tool["drop_old"](tmp_path, [one], quick=quick)
        tool["make_files"](tmp_path, one, quick=quick)
        return capsys.readouterr().out.splitlines()

    (tmp_path / "other").mkdir()
    made = said(example)
    assert made[0] == "logo: making logo.svg ..."
    assert [path.name for path in tmp_path.iterdir()] == ["logo"]
    before = {path.name: path.read_bytes() for path in (tmp_path / "logo").iterdir()}
    assert said(example) == ["logo: its files are as they were ..."]
    assert {path.name: path.read_bytes() for path in (tmp_path / "logo").iterdir()} == before
    for other in (replace(example, commands=("vexture --help",)), replace(example, files=())):
        assert said(other) == [made[0], f"logo: {other.commands[0]} ..."]
    assert said(example, quick=False) == made
    (tmp_path / "logo" / "made.txt").write_text("of an older converter")
    assert said(example, quick=False) == made


def test_a_page_is_pictured_again_when_something_of_it_has_changed(tmp_path: Path) -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_gallery.py"))
    example = replace(EXAMPLES["logo"], libraries=("three",))
    own, library, style = tmp_path / "logo", tmp_path / "lib" / "three.js", tmp_path / "gallery.css"
    for path in (own / "index.html", own / "logo.ktx2", library, style):
        path.parent.mkdir(exist_ok=True)
        path.write_text("as it was")

    def is_pictured() -> bool:
        return bool(tool["is_pictured"](tmp_path, example))

    assert not is_pictured()
    for path in (own / "index.html", own / "logo.ktx2", library, style, own / "thumbnail.jpg"):
        tool["save_picture"](tmp_path, example, Image.new("RGB", (4, 4)))
        assert is_pictured()
        path.write_text("another")
        assert not is_pictured(), path
    tool["save_picture"](tmp_path, example, Image.new("RGB", (4, 4)))
    example = replace(example, picture={"Size": 1})
    assert not is_pictured()


def test_there_are_enough() -> None:
    assert len(EXAMPLES) >= 12


def test_land_goes_on_beyond_the_180th_meridian_and_around_a_pole() -> None:
    east, west = gallery_data.unroll_ring([(170, 60), (-170, 60), (-175, 70), (170, 60)])[::-1]
    assert east.tolist() == [[170, 60], [190, 60], [185, 70], [170, 60]]
    assert np.array_equal(west, east - (360, 0))
    (plain,) = gallery_data.unroll_ring([(0, 0), (20, 0), (0, 20), (0, 0)])
    assert plain.tolist() == [[0, 0], [20, 0], [0, 20], [0, 0]]
    corners = [(-180, -70), (-60, -75), (60, -70), (-180, -70)]
    for ring in (corners, corners[::-1]):
        around = gallery_data.unroll_ring(ring)
        whole = [one for one in around if one[:, 0].min() <= -180 and one[:, 0].max() >= 180]
        assert len(whole) == 1
        assert sorted(whole[0][-2:].tolist()) == [[-180, -90], [180, -90]]
