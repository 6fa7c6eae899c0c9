"""The four floods of the example, for all tests of floods."""

import importlib.util
import pickle
import sys
from pathlib import Path

import pytest

from vexture_geo.readers import extent_of

EXAMPLE = Path(__file__).parents[3] / "examples" / "four_floods" / "make_floods.py"


@pytest.fixture(scope="session")
def floods(made_once):
    """Extents of the four floods of the example, by name; they are read once for all processes of tests."""
    folder = made_once("floods", write_floods)
    return {path.stem: pickle.loads(path.read_bytes()) for path in folder.glob("*.pickle")}


def write_floods(folder):
    """Write the floods, and the extents that are read from them."""
    found = importlib.util.spec_from_file_location("four_floods", EXAMPLE)
    module = sys.modules["four_floods"] = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    for make in module.SCENES:
        path = module.write(make(), folder)
        extent = extent_of(path, str(path))
        (folder / f"{path.stem}.pickle").write_bytes(pickle.dumps(extent))
