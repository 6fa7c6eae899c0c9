"""Pictures in an SVG, as paints of rectangles."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.pixels import decode_picture, premultiply
from vexture.drawing.drawing import Path
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.drawing.picture_size import fit_pictures, halve, halvings_needed
from vexture.svg.report import Report

MOST_TEXELS: Final = 262_144
"""Most texels of the pictures of one drawing, with all their levels: 4 MiB."""

PIXELATED: Final = frozenset({"pixelated", "crisp-edges", "-moz-crisp-edges", "optimizespeed"})
"""Values of `image-rendering` that show pixels as squares."""


@dataclass(frozen=True, slots=True, eq=False)
class EmbeddedPicture:
    """A picture in a drawing, halved until it fits alone."""

    label: str
    size: tuple[float, float]  # columns and rows of the file
    paint: Paint  # in units of the file's pixels, y down
    remarks: tuple[str, ...] = ()
    is_turned: bool = False  # True if the orientation in the file changed it

    @classmethod
    def from_content(cls, content: bytes, label: str) -> "EmbeddedPicture":
        """Decode the content of a file."""
        decoded = decode_picture(content)
        rows, columns = decoded.pixels.shape[:2]
        times = halvings_needed(columns, rows, MOST_TEXELS)
        part = 0.5**times
        pixels = halve(premultiply(decoded.pixels), times)
        paint = Paint.from_picture(Picture(((part, 0.0, 0.0), (0.0, part, 0.0)), pixels))
        return cls(label, (columns, rows), paint, decoded.remarks, decoded.is_turned)

    def paint_with(self, rendering: str) -> Paint:
        """Return the paint for a value of `image-rendering`."""
        picture = self.paint.picture
        if picture is None or rendering.lower() not in PIXELATED:
            return self.paint
        return replace(self.paint, picture=picture.with_sampling(Sampling.PIXELS))


def fit_into_budget(paths: Sequence[Path], embedded: Sequence[EmbeddedPicture], report: Report) -> tuple[Path, ...]:
    """Halve the largest pictures of a drawing until all fit, and note all that are smaller than in their files.

    `embedded` are the pictures of the drawing; some may not be visible.
    """
    visible = {id(path.paint.picture.pixels) for path in paths if path.paint.picture is not None}
    fitted, reductions = fit_pictures(paths, MOST_TEXELS)
    reduced: dict[int, NDArray[np.uint8]] = {id(each.original): each.reduced for each in reductions}
    for picture in embedded:
        assert picture.paint.picture is not None
        pixels = picture.paint.picture.pixels
        if id(pixels) in visible:
            note_size(picture, reduced.get(id(pixels), pixels), report)
    return fitted


def note_size(picture: EmbeddedPicture, pixels: NDArray[np.uint8], report: Report) -> None:
    """Note the size of a picture if it is smaller than in the file."""
    rows, columns = pixels.shape[:2]
    if (columns, rows) != picture.size:
        size = "{:,} x {:,}".format(*picture.size)
        limit = f"pictures of a drawing take at most {MOST_TEXELS:,} texels"
        report.simplification(f"{picture.label}: {columns:,} x {rows:,} of its {size} pixels ({limit})")
