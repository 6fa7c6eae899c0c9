"""The guides run: those that need nothing but a folder here, the others where their browser and their data are."""

import inspect
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import vexture
from guides import GUIDES, ROOT, Block, Reader, alike, blocks_of, free_port

ELSEWHERE = {
    "from-svg-to-three": "web/test_guide_three.py",
    "coastal-data": "geo/flood/test_guide_coastal.py",
    "fonts": "web/test_guide_fonts.py",
    "web-maps": "web/test_guide_maps.py",
    "text": "web/test_guide_text.py",
    "from-troika": "web/test_guide_text.py",
}
TESTS = Path(__file__).parents[1]


def test_the_guide_for_python_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("from-python"):
            reader.take(block)
    with Image.open(folder / "logo.png") as image:
        assert image.getpixel((30, 150)) == (0, 102, 204)
        assert image.getpixel((100, 104)) == (255, 214, 51)
    with Image.open(folder / "kite.png") as image:
        assert 1 - np.asarray(image).mean() / 255 == pytest.approx(0.24, abs=0.01)


def test_the_overview_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("overview"):
            reader.take(block)
    (colours,), (outline,) = (vexture.load(folder / f"{name}.ktx2").roots for name in ("logo", "outline"))
    assert colours.style is None
    assert outline.paint is None


def test_the_guide_for_python_lists_the_parameters_of_convert() -> None:
    text = (GUIDES / "from-python.md").read_text(encoding="utf-8")
    (listed,) = re.findall(r"The parameters of `convert` are.*?\n\n", text, re.S)
    parameters = {*inspect.signature(vexture.convert).parameters} - {"source", "encoding", "others"}
    assert {*re.findall(r"`(\w+)`", listed)} == parameters | {"convert"}


@pytest.mark.slow
@pytest.mark.long
def test_the_guide_for_the_command_line_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("command-line"):
            reader.take(block)
    assert {path.name for path in (folder / "out").iterdir()} == {"logo.ktx2", "kite.ktx2"}
    assert (folder / "piped.ktx2").read_bytes()[:8] == (folder / "badge.ktx2").read_bytes()[:8]
    roots = {name: [root.name for root in vexture.load(folder / f"{name}.ktx2").roots] for name in ("shapes", "layers")}
    assert roots["shapes"] == ["logo", "kite"]
    assert roots["layers"] == ["logo/1-#0066cc", "logo/2-#ffffff", "logo/3-#ffcc00cc", "kite/1-#000000"]
    assert {root.paint.hex for root in vexture.load(folder / "traced.ktx2").roots if root.paint} >= {"#0066cc"}
    with Image.open(folder / "colours.png") as image:
        assert image.getpixel((30, 150))[:3] == (0, 102, 204)
    with Image.open(folder / "kite.png") as image:
        assert image.size == (320, 200)
        assert image.convert("L").getpixel((160, 100)) == 0
    with Image.open(folder / "mask.png") as image:
        assert image.convert("L").getpixel((32, 32)) == 0
    with Image.open(folder / "turned.png") as image:
        assert image.convert("RGBA").getpixel((511, 0))[3] == 0
    assert len(json.loads((folder / "shapes.json").read_text())["roots"]) == 2
    assert vexture.fold_from((folder / "kite.fold.ktx2").read_bytes()).cycle == 6.0
    assert (folder / "fold.png").is_file()


@pytest.mark.slow
def test_the_guide_for_the_thesis_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("thesis"):
            reader.take(block)
        assert reader.names["image"].mean() == pytest.approx(0.24, abs=0.01)
    with Image.open(folder / "kite.png") as image:
        assert 1 - np.asarray(image.convert("L")).mean() / 255 == pytest.approx(0.24, abs=0.01)


@pytest.mark.usefixtures("page_is_built")
def test_the_guide_for_notebooks_does_what_it_says(tmp_path: Path) -> None:
    pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("notebooks"):
            reader.take(block)
        chart, night = reader.names["chart"], reader.names["night"]
    assert chart.view == night.view
    with Image.open(folder / "harbour.png") as image:
        assert image.size == (640, 260)
    assert (folder / "harbour.html").read_bytes().startswith(b"<!doctype html>")


@pytest.mark.slow
@pytest.mark.filterwarnings(
    "ignore:.*lies below others:vexture.base.errors.SourceWarning"
)  # the lake, as the guide says
@pytest.mark.usefixtures("page_is_built")
def test_the_guide_for_maps_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("maps"):
            reader.take(block)
    with Image.open(folder / "land.png") as image:
        assert len(image.convert("RGBA").getcolors(160_000)) >= 3
    legend = json.loads((folder / "kinds.json").read_text())["legend"]
    assert [entry["label"] for entry in legend[0]["entries"]] == ["farm", "lake", "town"]
    assert sorted(vexture.load(folder / "both.ktx2").roots[0].style.names) == ["A4", "D", "N", "W"]
    assert (folder / "land.parquet").is_file()
    years = json.loads((folder / "years.times.json").read_text())
    assert years["times"] == ["2001", "2002"]
    assert [len(step) for step in years["colors"]] == [len(years["ids"])] * 2
    assert vexture.load(folder / "black.ktx2").roots[0].style.names.count("outline") == 1


def test_the_guide_for_tiles_does_what_it_says(tmp_path: Path) -> None:
    """But for installing, and for the cluster, which `tests/tiles` has."""
    pytest.importorskip("pmtiles", reason="pmtiles is not installed (pip install 'vexture[map]')")
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("tiles"):
            reader.take(block)
    assert (folder / "parcels.pmtiles").read_bytes().startswith(b"PMTiles\3")
    assert not (folder / "parcels.pmtiles.parts").exists()


@pytest.mark.usefixtures("page_is_built")
def test_the_guide_for_servers_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder, {"8000": free_port()}) as reader:
        for block in blocks_of("live"):
            reader.take(block)
        assert "version" in reader.said, "the drawing is not published"
    assert "<title>Our logo</title>" in (folder / "logo.html").read_text(encoding="utf-8")


def test_every_guide_is_read_by_a_test() -> None:
    for path in GUIDES.glob("*.md"):
        test = TESTS / ELSEWHERE.get(path.stem, "docs/test_guides.py")
        text = test.read_text(encoding="utf-8")
        assert "blocks_of(" in text
        assert f'"{path.stem}"' in text


def test_the_guide_of_the_gallery_names_every_example() -> None:
    [block] = blocks_of("gallery")
    assert block.text.startswith("make gallery ")
    examples = tomllib.loads((ROOT / "gallery" / "gallery.toml").read_text(encoding="utf-8"))["example"]
    text = (GUIDES / "gallery.md").read_text(encoding="utf-8")
    assert [one["title"] for one in examples if f"| {one['title']} |" not in text] == []


def test_a_guide_that_says_what_is_not_so_is_noticed(tmp_path: Path) -> None:
    def block(language: str, text: str) -> Block:
        return Block(language, None, text, "", "here")

    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        reader.take(block("sh", "echo 12.5 ms, 3 quads"))
        reader.take(block("text", "8.25 ms, 3 quads\n"))
        with pytest.raises(AssertionError, match="3 quads"):
            reader.take(block("text", "12.5 ms, 4 quads\n"))
        with pytest.raises(AssertionError, match="here"):
            reader.take(block("sh", "vexture convert missing.svg\necho done"))
        with pytest.raises(ZeroDivisionError):
            reader.take(block("python", "1 / 0"))
        with pytest.raises(AssertionError, match="nothing is done with ruby"):
            reader.take(block("ruby", "puts 1"))
    assert alike("a: 3 curves, 1120 bytes, 4.6 ms") == "a: 3 curves, -, -"


def test_what_a_guide_starts_ends_with_it(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        command = f"{sys.executable} -u -m http.server 0   # until Ctrl-C"
        reader.take(Block("sh", None, command, "", "here"))
        (process,) = reader.started
        assert process.poll() is None
    assert isinstance(process, subprocess.Popen)
    assert process.poll() is not None
