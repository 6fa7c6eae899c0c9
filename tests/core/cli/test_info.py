"""The command `info`."""

import json

import numpy as np
import pytest
from test_cli import SQUARE, run
from test_cli_streams import LOGO


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(LOGO.format("<foreignObject/>"))
    return file


def test_info(square, tmp_path):
    run("convert", square, "-o", tmp_path, "--encoding", "thesis")
    facts = json.loads(run("info", tmp_path / "square", "--json").output)
    assert facts["encoding"] == "thesis"
    assert facts["bits"] == 16
    assert abs(facts["coverage"] - 0.3) < 1e-3
    assert np.allclose(facts["transform"], [[10, 0, 0], [0, -10, 10]])
    assert "quads" in run("info", tmp_path / "square").output


def test_info_says_that_a_file_is_no_texture(logo):
    result = run("info", logo)
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert f"{logo}: it is not a texture; give a texture, which vexture convert makes from a drawing" in result.stderr
