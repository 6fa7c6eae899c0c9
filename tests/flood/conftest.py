"""What all tests of the flood's page need: the page, and the server's helpers."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "live"))


@pytest.fixture(scope="session")
def page_is_built():
    from vexture.errors import DeviceError
    from vexture.live.page import FLOOD, built

    try:
        built(FLOOD.script)
    except DeviceError as error:
        pytest.skip(str(error))
