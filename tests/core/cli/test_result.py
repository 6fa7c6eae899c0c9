"""Results of conversions, as the command line prints them."""

import json

import pytest
from test_cli_streams import LOGO, run

import vexture


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(LOGO.format("<foreignObject/>"))
    return file


def test_json_has_the_facts_of_each_source(logo, tmp_path):
    bad = tmp_path / "bad.svg"
    bad.write_text("no svg")
    result = run("convert", logo, bad, "-o", tmp_path / "out", "--split", "paint", "--json")
    assert result.exit_code == 1
    good, failed = json.loads(result.stdout)
    file = tmp_path / "out" / "logo.ktx2"
    texture = vexture.load(file)
    assert (good["source"], good["name"], good["files"]) == (str(logo), "logo", [str(file)])
    assert good["bytes"] == file.stat().st_size
    assert good["layers"] == len(good["shapes"]) == 2
    assert good["quads"] == sum(root["quads"] for root in texture.info()["roots"])
    assert good["warning"] == f"{logo}: left out: <foreignObject>"
    assert failed.keys() == {"source", "error"}
    assert "holds nothing that can be read" in failed["error"]


def test_quiet_says_errors_only_and_verbose_each_shape(logo, tmp_path):
    result = run("convert", logo, "-o", tmp_path, "-q")
    assert (result.exit_code, result.output) == (0, "")
    assert run("convert", tmp_path / "gone.svg", "-o", tmp_path, "-q").stderr.count("\n") == 1
    plain = run("convert", logo, "-o", tmp_path, "--split", "paint")
    told = run("convert", logo, "-o", tmp_path, "--split", "paint", "-v")
    assert "left out: <foreignObject>" in plain.stderr
    assert len(plain.stdout.splitlines()) == 1
    assert told.stdout.splitlines()[1:] == [
        "  shape 0: 1 quad, 4 curves",
        "  shape 1: 1 quad, 2 curves",
        f"  {tmp_path / 'logo.ktx2'}",
    ]
