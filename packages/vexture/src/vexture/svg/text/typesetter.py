"""Typesetting: the fonts of a drawing, and the painted parts of its texts."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lxml import etree

from vexture.base.errors import DeviceError
from vexture.svg.outline import ShapeOutline
from vexture.svg.report import Report
from vexture.svg.space import ElementPlace
from vexture.svg.stylesheets import FontFace

if TYPE_CHECKING:  # imported at run time for drawings with texts only
    from vexture.svg.text.pieces import TextPiece
    from vexture.svg.text.runs import TextFaces
    from vexture.svg.text.tree import TextScene


@dataclass(frozen=True, slots=True, eq=False)
class Text:
    """The painted parts of a text, and the box around the cells of its glyphs."""

    pieces: "tuple[TextPiece, ...]" = ()
    box: ShapeOutline | None = None


class Typesetter:
    """Typesets the texts of a drawing, with fonts from files, from the drawing and from the system."""

    def __init__(self, files: Sequence[str | os.PathLike[str]], font_faces: Sequence[FontFace], report: Report) -> None:
        self.files = (files,) if isinstance(files, str | os.PathLike) else files
        self.font_faces = font_faces
        self.report = report
        self.count: int = 0  # number of characters so far

    @cached_property
    def faces(self) -> "TextFaces":
        """Faces of the drawing; raises a `DeviceError` without HarfBuzz."""
        from vexture.fonts.library import Fonts
        from vexture.svg.text.embedded import embedded_fonts
        from vexture.svg.text.runs import TextFaces

        embedded = embedded_fonts(self.font_faces, Fonts(self.files), self.report)
        return TextFaces(Fonts(self.files, embedded), self.report)

    def text(self, scene: "TextScene", element: etree._Element, place: ElementPlace) -> Text:
        """Typeset a text element at a place with its style."""
        from vexture.svg.text.layout import is_vertical, lay_out
        from vexture.svg.text.pieces import cells, pieces
        from vexture.svg.text.runs import clusters
        from vexture.svg.text.tree import characters

        found = characters(scene, element, place, self.count)
        self.count = found.count
        vertical = is_vertical(place.style)
        try:
            faces = self.faces
            faces.report, faces.noted = scene.report, set()
            glyphs = clusters(found, faces, vertical)
        except DeviceError as error:
            scene.report.left_out(f"<text>: {error}", element)
            return Text()
        chunks = lay_out(found, glyphs, vertical, scene.report)
        return Text(tuple(pieces(chunks, vertical, scene.report)), cells(chunks))
