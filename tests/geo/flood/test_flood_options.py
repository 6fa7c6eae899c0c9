"""Parameters of a flood are checked before any file is read."""

import json
from dataclasses import fields

import pytest
from floods import flood, sea

from vexture.base.errors import ParameterError
from vexture_geo.flood.options import FloodOptions, FloodParameters, bounds_of

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


def test_a_program_may_name_each_parameter_of_the_command():
    named = {"extent", "ground", "relief", "depths"}  # parameters of `flood_page` of other types
    assert {one.name for one in fields(FloodOptions)} - named == set(FloodParameters.__annotations__)


def test_a_layer_is_refused_for_a_run_that_a_model_writes(tmp_path):
    outcome = flood("--follow", tmp_path / "run.nc", "--layer", "wet", "--serve")
    (line,) = outcome.stderr.splitlines()
    assert (outcome.returncode, line) == (1, "vexture: --layer 'wet': it is for polygons, and --follow reads depths")
