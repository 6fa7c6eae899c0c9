"""The server of a flood under clients that are hostile, broken or too many, as the tests of the core try servers."""

import json
import sys
import tempfile
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from floods import BOUNDS, FloodServer, geotiff, sea
from server import serving
from test_connections import (  # noqa: F401  # collected here with the fixture `served` of this module
    PATIENT_LIMITS,
    test_a_broken_body_breaks_only_its_own_request,
    test_bytes_that_trickle_keep_no_connection_open,
    test_connections_never_use_up_the_descriptors,
    test_peers_that_do_not_ask_are_closed,
    test_requests_that_wait_for_a_reader_keep_no_connection_open,
)
from test_converter import check_others_are_converted

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("page_is_built")]

PROGRAM = """
import json, resource, sys
from vexture.cli.main import main
from vexture_geo.flood import server as flood
from vexture.server.limits import Limits

limits = json.loads(sys.argv.pop(1))
files = limits.pop("files")
resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))
flood.Limits = lambda: Limits(**limits)
main()
"""


class Flood(FloodServer):
    """The whole server of a flood, with other limits."""

    large = "/flood.js"

    def __init__(self, folder, token=True, files=2000, size=None, **limits):
        told = {"files": files, **PATIENT_LIMITS, **limits}
        self.water = sea(folder / "sea.geojson").read_bytes()
        options = ["--extent", folder / "sea.geojson", "--bounds", ",".join(map(str, BOUNDS))]
        super().__init__(folder, *options, token=token, program=[sys.executable, "-c", PROGRAM, json.dumps(told)])

    def stop(self):
        """Show newer water and end; the notes about the flood are no complaints."""
        assert self.put("flood", self.water)[0] == 200
        code, said, errors = super().stop()
        return code, said, "".join(line for line in errors.splitlines(True) if not line.startswith("vexture: "))


@contextmanager
def flood(**given):
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder), kind=partial(Flood, **given)) as server:
        yield server


@pytest.fixture
def served():
    """Context of the server of a flood under limits that are given."""
    return flood


def test_a_slow_conversion_of_a_flood_keeps_no_other_waiting(tmp_path):
    noise = np.random.default_rng(1).normal(size=(1900, 1900)).astype(np.float32)
    with flood() as server:
        slow = geotiff(tmp_path / "noise.tif", noise).read_bytes()  # takes more than a minute
        check_others_are_converted(server, "flood", server.water, slow)
