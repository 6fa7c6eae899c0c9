"""`vexture report` as people type it."""

import subprocess
import sys
from pathlib import Path

import vexture

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
RUN = "import sys; from vexture.cli.main import main; main()"


def report(*arguments, before=""):
    command = [sys.executable, "-c", before + RUN, "report", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_source_that_cannot_be_read_is_one_line_and_nothing_is_written(tmp_path):
    (tmp_path / "broken.svg").write_text("<svg")
    outcome = report(SHAPES / "duck.svg", tmp_path / "broken.svg", "-o", tmp_path / "out")
    assert outcome.returncode == 1
    (line,) = outcome.stderr.splitlines()
    assert "broken.svg" in line
    assert not (tmp_path / "out").exists()


def test_a_texture_is_no_source(tmp_path):
    vexture.convert(SHAPES / "duck.svg").save(tmp_path / "duck.ktx2")
    outcome = report(tmp_path / "duck.ktx2", "-o", tmp_path / "out")
    assert outcome.returncode == 1
    (line,) = outcome.stderr.splitlines()
    assert line.endswith("duck.ktx2: is a texture already; give the drawing that it was made from")
