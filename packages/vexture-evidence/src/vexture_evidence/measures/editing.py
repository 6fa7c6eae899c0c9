"""From a texture to an SVG file that drawing programs open, and from the file that they save to a texture again."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

from vexture.conversion.images import coverage
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing
from vexture.texture.texture import Texture
from vexture_evidence.measures.metrics import Errors, errors
from vexture_evidence.measures.timing import median_seconds

SIDE = 256
"""Pixels along a side of the pictures that show whether the round trip changed the drawing."""


@dataclass(frozen=True, slots=True, eq=False)
class EditedTexture:
    """A texture that was exported for a drawing program, changed and converted again.

    Parameters
    ----------
    exported : Drawing
        The texture's exported SVG, read again.
    unchanged : Errors
        Errors of a picture of `exported` against the drawing that the texture was made from.
    drawing : Drawing
        The drawing saved after the change.
    texture : Texture
        The texture of `drawing`.
    seconds : float
        Median time from the saved file to the texture's file.
    """

    exported: Drawing
    unchanged: Errors
    drawing: Drawing
    texture: Texture
    seconds: float


def edit_texture(drawing: Drawing, texture: Texture, change: str, repeat: int = 5) -> EditedTexture:
    """Export a texture, change the exported file, and convert it.

    Parameters
    ----------
    drawing : Drawing
        The drawing that `texture` was made from.
    texture : Texture
        A texture of one shape.
    change : str
        SVG elements that are added on top, as a drawing program would save them.
    repeat : int
        Conversions that are timed.

    Examples
    --------
    >>> import vexture
    >>> half = Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    >>> after = edit_texture(half, vexture.convert(half), '<circle cx="0.5" cy="-0.8" r="0.1"/>', 1)
    >>> after.drawing.segments, after.unchanged.mae < 0.1
    (12, True)
    """
    with tempfile.TemporaryDirectory() as folder:
        path, target = Path(folder) / f"{texture.name}.svg", Path(folder) / "converted.ktx2"
        text = texture.to_svg()
        path.write_text(text, encoding="utf-8")
        exported = run(path, Parameters(split=None)).drawing
        path.write_text(text.replace("</svg>", f"{change}</svg>"), encoding="utf-8")
        made = run(path, Parameters(split=None))
        assert isinstance(made.texture, Texture)

        def convert() -> None:
            converted = run(path, Parameters(split=None)).texture
            assert isinstance(converted, Texture)
            converted.save(target)

        seconds = median_seconds(convert, repeat)
    size = (SIDE, SIDE)
    unchanged = errors(*(coverage(shown, size, renderer="exact") for shown in (exported, drawing)))
    return EditedTexture(exported, unchanged, made.drawing, made.texture, seconds)
