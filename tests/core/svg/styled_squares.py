"""Drawings of a square whose style matters, and their colours."""

import warnings
from pathlib import Path

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

SQUARE = '<path id="p" d="M0 0h9v9z"/>'


def read_quietly(folder: Path, body: str, root: str = 'viewBox="0 0 9 9"') -> Drawing:
    """Read an SVG file with this body, without warnings."""
    file = folder / "a.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read_svg(file)


def colors(drawing: Drawing) -> list[tuple[float, float, float]]:
    """Colours of the paths of a drawing."""
    return [path.paint.color for path in drawing.paths]
