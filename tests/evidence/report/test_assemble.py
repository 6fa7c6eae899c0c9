"""A report is made as a whole or not at all."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from lxml import html
from PIL import Image

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
RUN = "import sys; from vexture.cli.main import main; main()"


def report(*arguments, before=""):
    command = [sys.executable, "-c", before + RUN, "report", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_missing_matplotlib_is_one_line(tmp_path):
    outcome = report("-o", tmp_path / "out", before="import sys; sys.modules['matplotlib'] = None; ")
    assert outcome.returncode == 1
    assert outcome.stderr.splitlines() == ["vexture: figures need the package matplotlib: pip install vexture-evidence"]
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_report_is_whole(tmp_path):
    outcome = report(SHAPES / "duck.svg", "-o", tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    page = html.parse(tmp_path / "index.html")
    pictures = [tmp_path / source for source in page.xpath("//img/@src")]
    assert len(pictures) > 20
    assert sorted(pictures) == sorted((tmp_path / "figures").iterdir())
    for image, picture in zip(page.xpath("//img"), pictures, strict=True):
        with Image.open(picture) as opened:
            shown = int(image.get("width")) * opened.height / opened.width
            assert shown == pytest.approx(int(image.get("height")), rel=0.01)
            assert all(low < high for low, high in opened.convert("RGB").getextrema())
    facts = json.loads((tmp_path / "report.json").read_text())
    assert {"machine", "conversion", "shapes", "structure", "rendering", "discussion", "comparison"} <= set(facts)
    assert set(page.xpath("//nav//a/@href")) <= {f"#{anchor}" for anchor in page.xpath("//@id")}
    assert len(page.xpath("//@id")) == len(set(page.xpath("//@id")))


def test_missing_renderer_is_found_before_anything_is_measured(tmp_path):
    outcome = report("-o", tmp_path / "out", before="import sys; sys.modules['skia'] = None; ")
    assert outcome.returncode == 1
    (line,) = outcome.stderr.splitlines()
    assert line == "vexture: this comparison needs the package skia-python: pip install vexture-evidence"


def test_place_that_cannot_be_written_is_found_before_anything_is_measured(tmp_path):
    (tmp_path / "figures").touch()
    outcome = report(SHAPES / "duck.svg", "-o", tmp_path)
    assert outcome.returncode == 1
    (line,) = outcome.stderr.splitlines()
    assert f"{tmp_path / 'figures'}: cannot be written" in line
