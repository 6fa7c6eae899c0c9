"""Pictures of pixels as a source (thesis 4.2)."""

from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.errors import DeviceError
from vexture.images import coverage
from vexture.pipeline import convert
from vexture_evidence.figures.tracing import tracing
from vexture_evidence.measures.metrics import outline_distance
from vexture_evidence.measures.timing import median_seconds
from vexture_evidence.report.section import Material, Picture, Section, Table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from vexture.drawing import Drawing

__all__ = ["section"]

SIDES: Final = (64, 128, 256, 512)
"""Pixels of the pictures that are traced."""

SHOWN: Final = 128
"""Pixels of the one that is shown."""

TEXT: Final = (
    "The thesis takes SVG files and names another program for pictures of pixels. Here `vexture convert logo.png` "
    "traces them itself. To know how well, the exact picture of a known drawing is saved as a PNG file of 8 bits, that "
    "is traced, and the outline found is compared with the true one.",
)


def section(material: Material) -> Section:
    """Make the part of the report that is about tracing.

    Parameters
    ----------
    material : Material
        Its main drawing is drawn, and traced.
    """
    drawing = material.main.drawing
    pictures = {side: coverage(drawing, (side, side), renderer="exact") for side in SIDES}
    if not 0.0 < float(pictures[SHOWN].mean()) < 1.0:
        return Section("tracing", "Pictures of pixels", (*TEXT, f"{drawing.name} shows no outline to trace."))
    try:
        rows = [_row(drawing, pictures[side]) for side in SIDES]
        traced = _traced(_png(pictures[SHOWN]))
    except DeviceError as error:
        return Section("tracing", "Pictures of pixels", (*TEXT, f"Not measured here: {error}."))
    table = Table(
        "traced",
        f"{drawing.name}, drawn, traced and converted. The distance is the area between both outlines over the length "
        "of the true one, in pixels of the traced picture and in 1/1000 of its side.",
        ["side: px", "PNG: bytes", "tracing: ms", "traced: cubics", "packed: bytes", "distance: px", "distance: ‰"],
        rows,
    )
    picture = Picture(
        "tracing",
        tracing(pictures[SHOWN], traced, drawing),
        f"Thesis 4.2. The picture of {SHOWN} pixels, the outline traced in it and the true one where the drawing turns "
        "most, and two pictures from the packed texture of what was traced. The frame marks the part that is "
        "enlarged. Corners between pixels are rounded: the pixels no longer say where they were.",
        f"Pixels of {drawing.name}, a traced outline that follows the true one, and large pictures without pixels",
    )
    return Section("tracing", "Pictures of pixels", TEXT, (table, picture))


def _row(drawing: "Drawing", picture: "NDArray[np.float32]") -> list[Any]:
    side = len(picture)
    file = _png(picture)
    traced = _traced(file)
    seconds = median_seconds(lambda: _traced(file), 1)
    off = outline_distance(traced, drawing)
    packed = len(convert(traced).to_ktx2())
    return [str(side), len(file), 1e3 * seconds, traced.segments, packed, off * side, 1e3 * off]


def _png(picture: "NDArray[np.float32]") -> bytes:
    """The drawing black on white, as a file."""
    from PIL import Image

    data = BytesIO()
    Image.fromarray(np.uint8(np.rint(255.0 * (1.0 - picture)))).save(data, "PNG", optimize=True)
    return data.getvalue()


def _traced(file: bytes) -> "Drawing":
    from vexture.tracing.trace import read_image

    return read_image(file, "traced.png")
