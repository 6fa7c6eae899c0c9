"""The four floods of the example, for all tests of floods."""

import importlib.util
import sys
from pathlib import Path

import pytest

from vexture_geo.readers import extent_of

EXAMPLE = Path(__file__).parents[3] / "examples" / "four_floods" / "make_floods.py"


@pytest.fixture(scope="session")
def floods(tmp_path_factory):
    """Extents of the four floods of the example, by name."""
    found = importlib.util.spec_from_file_location("four_floods", EXAMPLE)
    module = sys.modules["four_floods"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    folder = tmp_path_factory.mktemp("floods")
    paths = [module.write(make(), folder) for make in module.SCENES]
    return {path.stem: extent_of(path, str(path)) for path in paths}
