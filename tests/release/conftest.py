"""Puts tools/ on the import path: what builds and checks a release is tried here."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
