"""Figures 5.1 to 5.11 of the thesis: every drawing with its cells, its textures and a picture drawn from them."""

from vexture.base.errors import LimitError
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.overview import SIDE, overview
from vexture_evidence.figures.textures import count_text
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing
from vexture_evidence.measures.thesis_numbers import TABLE_5_1
from vexture_evidence.report.section import Material, PrintedPicture, Section


def section(material: Material) -> Section:
    """Show every drawing.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> section(Material([example("duck")])).items[0].caption[:5]
    'duck.'
    """
    text = (
        "Each figure shows a drawing and, for each way of conversion, the cells that the unit square was divided into, "
        "with the curves in them, and the texels that a shader reads. At the lower left is a picture drawn from the "
        "last texture. The fuller a cell is, the darker it is shown; this coverage represents the whole cell "
        f"where the cell is smaller than a pixel. The error is that of a picture of {SIDE} x {SIDE} pixels, compared "
        "with the exact coverage: the mean, in 1/255, over the pixels that the shape touches in either.",
        "Packed leaves hold few horizontal lines, because these follow from the other curves. Lines that no leaf holds "
        "are dotted. An outline along the border of a cell needs no curve in the cell, so it may not be drawn there.",
    )
    items = [_picture(shape, place, material.own) for place, shape in enumerate(material.shapes, 1)]
    return Section("shapes", "Every drawing", text, items)


def textures_of(shape: ConvertedDrawing) -> tuple[dict[str, ThesisTexture | Texture], list[str]]:
    """Textures of a drawing by way of conversion, and the reason for each way that cannot hold it.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> [*textures_of(ConvertedDrawing(example("duck")))[0]]
    ['sampled', 'direct', 'packed']
    """
    made: dict[str, ThesisTexture | Texture] = {}
    refused = []
    for way in WAYS:
        try:
            made[way] = shape.way(way).texture
        except LimitError as error:
            refused.append(f"`{way}` is missing: {error}.")
    return made, refused


def _picture(shape: ConvertedDrawing, place: int, is_own: bool) -> PrintedPicture:
    made, refused = textures_of(shape)
    row = None if is_own else TABLE_5_1.get(shape.name)
    title = f"{shape.name}." if row is None else f"Thesis 5.{place}. {row.title}."
    parts = [
        f"`{way}`: {count_text(len(shape.way(way).tree.coverage), 'quad')}, "
        f"{count_text(len(shape.way(way).tree.curves), 'curve')}"
        for way in made
    ]
    printed = "" if row is None else f" The thesis's own drawing: ⟦{row.quads} quads, {row.curves} curves⟧."
    caption = " ".join([title, f"{'; '.join(parts)}.{printed}", *refused])
    name = f"shape-{place}" if row is None else f"shape-{shape.name}"
    alt = f"{shape.name}: the drawing, its cells, its textures and a picture drawn from them"
    return PrintedPicture(name, overview(shape.drawing, made), caption, alt)
