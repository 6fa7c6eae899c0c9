"""Parameters of a flood are checked before any file is read."""

import json

import pytest
from floods import flood, sea

from vexture.base.errors import ParameterError
from vexture_geo.flood.options import FloodOptions, bounds_of

pytestmark = pytest.mark.usefixtures("page_is_built")


@pytest.mark.parametrize("options", [[], ["-o", "page.html", "--serve"], ["-o", "page.html", "--token-file", "x"]])
def test_where_to_show_it_must_be_said(options, tmp_path):
    outcome = flood("--extent", sea(tmp_path / "s.json"), *options)
    assert outcome.returncode == 1
    (line,) = outcome.stderr.splitlines()
    assert "--serve" in line


def test_parameters_are_checked(tmp_path):
    with pytest.raises(ParameterError, match="`amplitude` nan"):
        FloodOptions(tmp_path, amplitude=float("nan"))
    assert FloodOptions(tmp_path).amplitude_in(1000.0) == 2.0
    with pytest.raises(ParameterError, match="the box is empty"):
        bounds_of("1,2,1,4")
    assert json.dumps(bounds_of("170,-20,-170,-10")) == "[170.0, -20.0, -170.0, -10.0]"
