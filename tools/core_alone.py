"""A plugin of pytest that hides vexture-geo and vexture-evidence, as where only the core is installed.

PYTHONPATH=tools python -m pytest -p core_alone tests/core
"""

import importlib.metadata
import sys
from typing import Any

HIDDEN = ("vexture_geo", "vexture_evidence")
for name in HIDDEN:
    sys.modules[name] = None  # type: ignore[assignment]  # an import raises ModuleNotFoundError

entry_points = importlib.metadata.entry_points


def of_others(**selection: str) -> Any:
    """Return the entry points that the hidden packages do not have; without a selection, all of them by group."""
    if not selection:  # Numba asks so; Python 3.11 answers with a dictionary that warns of its end
        return entry_points()
    found = entry_points(**selection)
    return importlib.metadata.EntryPoints(point for point in found if point.module.partition(".")[0] not in HIDDEN)


importlib.metadata.entry_points = of_others
