"""Raster images as input: how well they are traced (thesis 4.2)."""

from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.base.errors import DeviceError
from vexture.conversion.images import coverage
from vexture.conversion.pipeline import convert
from vexture_evidence.figures.tracing import tracing
from vexture_evidence.measures.metrics import outline_distance
from vexture_evidence.measures.timing import median_seconds
from vexture_evidence.report.section import Material, PrintedPicture, Section, Table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vexture.drawing.drawing import Drawing

SIDES: Final = (64, 128, 256, 512)
"""Sides of the pictures that are traced, in pixels."""

SHOWN: Final = 128
"""Side of the picture that is shown."""

TEXT: Final = (
    "The thesis reads only SVG files and leaves tracing to another program. `vexture convert logo.png` traces pictures "
    "of pixels itself. To measure how well, the exact picture of a known drawing is saved as an 8-bit PNG file, this "
    "file is traced, and the traced outline is compared with the true one.",
)


def section(material: Material) -> Section:
    """Make the section on tracing.

    Parameters
    ----------
    material : Material
        Its main drawing is rendered, and the picture is traced.
    """
    drawing = material.main.drawing
    pictures = {side: coverage(drawing, (side, side), renderer="exact") for side in SIDES}
    if not 0.0 < float(pictures[SHOWN].mean()) < 1.0:
        return Section("tracing", "Raster images", (*TEXT, f"{drawing.name} shows no outline to trace."))
    try:
        rows = [_row(drawing, pictures[side]) for side in SIDES]
        traced = _trace_picture(_png(pictures[SHOWN]))
    except DeviceError as error:
        return Section("tracing", "Raster images", (*TEXT, f"Not measured here: {error}."))
    table = Table(
        "traced",
        f"{drawing.name}, rendered, traced and converted. The distance is the area between the two outlines divided by "
        "the length of the true one, in pixels of the traced picture and in 1/1000 of its side.",
        ["side: px", "PNG: bytes", "tracing: ms", "traced: cubics", "packed: bytes", "distance: px", "distance: ‰"],
        rows,
    )
    picture = PrintedPicture(
        "tracing",
        tracing(pictures[SHOWN], traced, drawing),
        f"Thesis 4.2. From the left: the picture of {SHOWN} pixels; the traced outline and the true one where the "
        "drawing turns most; two pictures from the packed texture of the traced outline. The frame marks the part that "
        "is enlarged. Corners that lie between pixels are rounded, because the pixels do not tell where they were.",
        f"Pixels of {drawing.name}, a traced outline that follows the true one, and large pictures without pixel steps",
    )
    return Section("tracing", "Raster images", TEXT, (table, picture))


def _row(drawing: "Drawing", picture: "NDArray[np.float32]") -> list[Any]:
    side = len(picture)
    file = _png(picture)
    traced = _trace_picture(file)
    seconds = median_seconds(lambda: _trace_picture(file), 1)
    off = outline_distance(traced, drawing)
    packed = len(convert(traced, split=None).to_ktx2())
    return [str(side), len(file), 1e3 * seconds, traced.segments, packed, off * side, 1e3 * off]


def _png(picture: "NDArray[np.float32]") -> bytes:
    """A PNG file of the picture, black on white."""
    from PIL import Image

    data = BytesIO()
    Image.fromarray(np.uint8(np.rint(255.0 * (1.0 - picture)))).save(data, "PNG", optimize=True)
    return data.getvalue()


def _trace_picture(file: bytes) -> "Drawing":
    from vexture.tracing.trace import read_image

    return read_image(file, "traced.png")
