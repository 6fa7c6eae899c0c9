"""From a texture to a file that drawing programs open, and from what they save to a texture again."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

from vexture.drawing import Drawing
from vexture.images import coverage
from vexture.pipeline import run
from vexture.texture.texture import Texture
from vexture_evidence.measures.metrics import Errors, errors
from vexture_evidence.measures.timing import median_seconds

__all__ = ["Edited", "edited"]

SIDE = 256
"""Pixels of the picture that tells whether the way there and back changed anything."""


@dataclass(frozen=True, slots=True, eq=False)
class Edited:
    """A texture that went through a file of drawing programs.

    Parameters
    ----------
    exported : Drawing
        What a drawing program reads of the texture.
    unchanged : Errors
        Of a picture of it against one of the drawing that the texture was made from.
    drawing : Drawing
        What was saved after the change.
    texture : Texture
        Made from that.
    seconds : float
        From the saved file to the texture's file, median.
    """

    exported: Drawing
    unchanged: Errors
    drawing: Drawing
    texture: Texture
    seconds: float


def edited(drawing: Drawing, texture: Texture, change: str, repeat: int = 5) -> Edited:
    """Export a texture, change the file, convert it.

    Parameters
    ----------
    drawing : Drawing
        That `texture` was made from.
    texture : Texture
        Of one shape.
    change : str
        SVG elements that are put on top, as a drawing program would save them.
    repeat : int
        Conversions that are timed.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    >>> after = edited(half, vexture.convert(half), '<circle cx="0.5" cy="-0.8" r="0.1"/>', 1)
    >>> after.drawing.segments, after.unchanged.mae < 0.1
    (12, True)
    """
    with tempfile.TemporaryDirectory() as folder:
        path, target = Path(folder) / f"{texture.name}.svg", Path(folder) / "converted.ktx2"
        text = texture.to_svg()
        path.write_text(text, encoding="utf-8")
        exported = run(path).drawing
        path.write_text(text.replace("</svg>", f"{change}</svg>"), encoding="utf-8")
        made = run(path)
        assert isinstance(made.texture, Texture)

        def convert() -> None:
            converted = run(path).texture
            assert isinstance(converted, Texture)
            converted.save(target)

        seconds = median_seconds(convert, repeat)
    size = (SIDE, SIDE)
    unchanged = errors(*(coverage(shown, size, renderer="exact") for shown in (exported, drawing)))
    return Edited(exported, unchanged, made.drawing, made.texture, seconds)
