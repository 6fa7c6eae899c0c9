"""Every server and page gives of each kind of file the drawing that Python reads."""

import json
import re
import subprocess
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click
import pytest
from kinds import one_of_each
from server import COMMAND, serving

from vexture.base.errors import DeviceError
from vexture.base.notes import line_of
from vexture.cli.export import export
from vexture.cli.messages import as_options
from vexture.conversion.reading import content_of, read_drawing
from vexture.drawing.drawing import Drawing
from vexture.pages.page import SCRIPT, built


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[Path]]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what writes them
        yield one_of_each(tmp_path_factory.mktemp("served"))


def assert_shows(manifest: Mapping[str, Any], drawing: Drawing, said_of: str) -> None:
    facts = manifest["facts"]
    assert facts["segments"] == drawing.segments, said_of
    assert facts["layers"] == (1 if drawing.is_coloured else len(drawing.layers()))  # a map is one
    assert facts["to_source"] == drawing.to_source.ravel().tolist()
    assert facts["warnings"] == [line for line in [line_of(said_of, drawing.notes)] if line]


@pytest.mark.slow
def test_a_server_takes_every_file_of_its_folder_and_every_upload(files: list[Path]) -> None:
    uploaded = {".svg": ".svg", ".svgz": ".svg", ".geojson": ".geojson"}
    with serving(files[0].parent, "--rate", 1000) as server:
        for path in files:
            drawing, suffix = read_drawing(path), uploaded.get(path.suffix, "")
            assert_shows(server.wait_for(path.stem), drawing, path.stem + suffix)
            status, manifest = server.put(f"put-{path.stem}", content_of(path))
            assert status == 201, manifest
            assert_shows(manifest, drawing, f"put-{path.stem}{suffix}")
            assert ("svg" in manifest["views"]) == (suffix == ".svg")


def test_a_page_holds_every_file(files: list[Path], tmp_path: Path) -> None:
    try:
        built(SCRIPT)
    except DeviceError as error:
        pytest.skip(str(error))
    page = tmp_path / "page.html"
    done = subprocess.run([*COMMAND, "export", *map(str, files), "-o", str(page)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    text = page.read_text()
    scene = json.loads(re.search(r'id="vexture-scene">(.*?)</script>', text, re.DOTALL)[1])  # type: ignore[index]
    lines = []
    for path, manifest in zip(files, scene["shapes"], strict=True):
        drawing = read_drawing(path)
        assert manifest["name"] == path.stem
        assert_shows(manifest, drawing, str(path))
        with click.Context(export):
            lines += [f"vexture: warning: {as_options(line)}" for line in manifest["facts"]["warnings"]]
    assert [line for line in done.stderr.splitlines() if "warning" in line] == lines
