"""The drawings that come with the program."""

from pathlib import Path

DRAWINGS = sorted((Path(__file__).parents[2] / "examples" / "shapes").glob("*.svg"))
