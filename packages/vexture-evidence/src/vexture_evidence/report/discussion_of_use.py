"""Sections 6.3, 6.4, 4.3.1 and 4.2 of the thesis: lines in pictures, crossings, long lists, and editing."""

from typing import Any, Final

import numpy as np

from vexture.conversion.images import coverage
from vexture.texture.texture import Texture
from vexture.thesis.layout import LIST_LIMIT
from vexture_evidence.figures.discussion import before_after, edited_drawing, lines_at_borders, list_growth
from vexture_evidence.measures.closeups import all_cubics, closeup
from vexture_evidence.measures.editing import edit_texture
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by
from vexture_evidence.measures.thesis_limits import BeforeAfter, Lengths, close_up, list_lengths
from vexture_evidence.measures.thesis_numbers import TABLE_5_1
from vexture_evidence.report.discussion_point import LEFT_OUT, DiscussionPoint, packed_of, pair_of
from vexture_evidence.report.section import Material, PrintedPicture, Section

CROSSED, SMALL, DUCK = "crossings", "simple-small", "duck"
"""Example drawings for the points that few drawings show, used in every report."""

CROSSING: Final = (170.0 / 256.0, 45.5 / 256.0)
"""Where two sides of the lower pentagram cross."""

UNALIGNED: Final = 101
"""Side of a picture in pixels, chosen so that cells' borders lie inside pixels, where the lines show."""

ACROSS: Final = {"sampled": (1, 2, 3, 5), "direct": (1, 3, 9, 27, 81, 108), "packed": (1, 3, 9, 27, 81, 108)}
"""Copies in a row, by way of conversion; fewer for `sampled`, which takes long."""

BALL: Final = '<circle cx="36" cy="40" r="24"/>'
"""The shape that is added beside the duck, in the units of the duck's file."""


def lines_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Lines along the borders of cells."""
    close = _as_thesis(subject)
    if not close.stray[0]:  # no pixel is wrong away from the outline, so this drawing does not show the point
        subject = material.example(DUCK)
        close = _as_thesis(subject)
    same = close_up(subject.drawing, pair_of(subject, "direct"), pair_of(subject, "direct"), side=UNALIGNED)
    before, after = close.stray
    again = same.stray[1]
    text = (
        "Thesis 6.3: the pictures “show some visible and unwanted artifacts. These mainly consist of the horizontal "
        "and vertical lines that can be seen in every rendered result”; it explains them by “gaps in precision when "
        "traversing down the quad-tree”.",
        "Before: precision is not the only cause. All 16 samples of a pixel use the curve of the cell at the pixel's "
        "centre, also where the pixel extends beyond this cell. Rendered in this way, the lines show in float64 "
        f"too: {before} pixels of the picture are wrong although no outline passes through them.",
        "After: a sample outside the cell is looked up again. From the same texture, the number of such pixels is "
        f"{again}. `packed` is integrated piece by piece and cell by cell: {after}.",
    )
    caption = (
        f"Thesis 6.3. Left: the cells of the `direct` texture of {subject.name}, whose curves are exact or nearly so. "
        f"Middle: errors of its picture of {UNALIGNED} x {UNALIGNED} pixels, rendered as in the thesis. They are "
        "largest where the outline crosses a cell's border; the mean error is "
        f"{close.errors[0].mae:.2g}/255. Right: errors of `packed`, whose own cells are different; the mean error is "
        f"{close.errors[1].mae:.1g}/255."
    )
    picture = PrintedPicture(
        "discussion-lines",
        lines_at_borders(close, ("as the thesis draws it", "packed")),
        caption,
        "Cells of a texture, and the errors of two pictures with the cells' borders drawn over them.",
    )
    part = Section("lines", "Lines along cells (6.3)", text, [picture])
    return DiscussionPoint(part, f"pixels of {subject.name} that are wrong away from its outline", before, after)


def _as_thesis(shape: ConvertedDrawing) -> BeforeAfter:
    return close_up(shape.drawing, pair_of(shape, "direct"), packed_of(shape), side=UNALIGNED, as_thesis=True)


def crossings_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Paths that cross."""
    shape = material.example(CROSSED)
    drawing, pair, packed = shape.drawing, pair_of(shape, "sampled"), packed_of(shape)
    x, y = CROSSING
    near = (x - 1 / 128, y - 1 / 128, x + 1 / 128, y + 1 / 128)
    rows = [close_up(drawing, pair, packed), close_up(drawing, pair, packed, near)]
    before, after = rows[0].errors
    left, none = (shape.way(way).tree.unresolved for way in ("sampled", "packed"))
    text = (
        "Thesis 6.4: “One of the examples that fails to render and convert is the case where path segments intersect. "
        "The behavior in these cases is not standardized, but a common solution is the even-odd rule”.",
        f"Before: two pentagrams, one by each fill rule. `sampled` divides at crossings down to its depth limit, where "
        f"{left} cells still hold more than one curve can represent.",
        f"After: crossings are resolved in the leaf, by either rule, and {none} cells are left unresolved.",
    )
    caption = (
        f"Thesis 6.4. Above: `{shape.name}`, before with {left} unresolved cells and after with {none}. Below: one "
        "crossing, in a square of 1/64 of the drawing's side. The titles count the curves in the cells that are "
        "shown. " + LEFT_OUT
    )
    picture = PrintedPicture(
        "discussion-crossings",
        before_after(rows, [("sampled", "packed")] * 2),
        caption,
        "Two pentagrams and one of their crossings, before and after.",
    )
    part = Section("crossings", "Crossings (6.4)", text, [picture])
    return DiscussionPoint(part, f"error of a picture of {shape.name}, 1/255", before.mae, after.mae)


def lists_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """List limits: how much one texture can hold."""
    drawing = material.example(SMALL).drawing
    lengths = {way: list_lengths(drawing, parameters, ACROSS[way]) for way, parameters in WAYS.items()}
    across = ACROSS["packed"][-1]
    texture = lengths["packed"][-1].texture
    assert isinstance(texture, Texture)
    size = (240, 240)
    parts = {
        f"{seen} x {seen} of {across * across:,} copies": coverage(
            texture, size, closeup(size, np.full(2, 0.5), across / seen), "cpu"
        )
        for seen in (24, 4)
    }
    held = {way: _most_copies(found) for way, found in lengths.items()}
    refusal = next((length.refused for length in lengths["direct"] if length.refused), "")
    printed = [TABLE_5_1[name].curves for name in (SMALL, "simple-duo", "simple-quartet")]
    text = (
        "Thesis 4.3.1: 16-bit channels allow “for lists sizes up to 65.536 curves or quads, instead of the maximum of "
        "256 quads or curves in 8-bit channels”; 5.1 compares files of 8 bits only, because no example needs more.",
        "Before: in the thesis, one, two and four copies of the simple shape have "
        f"⟦{printed[0]}, {printed[1]} and {printed[2]}⟧ curves. "
        f"Indices are stored as fractions, and float32 distinguishes {LIST_LIMIT[16]:,} of them. "
        f"{across * across:,} copies are refused: “{refusal}”.",
        "After: an index is a whole number of 32 bits, and one texture holds all copies: "
        f"{held['packed']:,} copies in {texture.nbytes:,} bytes.",
    )
    caption = (
        "Thesis 4.3.1 and 5.1. Left: entries of the longer list (for `packed`, all texels) over the number of copies "
        "of the simple shape. Dashed lines mark what a texture can hold; the cross marks a conversion that was "
        f"refused. Middle and right: parts of a picture of {across * across:,} copies, from `packed`. `sampled`, which "
        "takes long, is tried with few copies."
    )
    picture = PrintedPicture(
        "discussion-lists",
        list_growth(lengths, parts),
        caption,
        "Growth of the lists, and a drawing of thousands of shapes.",
    )
    part = Section("list-limits", "List limits (4.3.1, 5.1)", text, [picture], {"lengths": _as_facts(lengths)})
    return DiscussionPoint(
        part, "most copies of the simple shape held, of the numbers tried", held["direct"], held["packed"]
    )


def _most_copies(found: list[Lengths]) -> int:
    return max(length.copies for length in found if length.entries is not None)


def _as_facts(lengths: dict[str, list[Lengths]]) -> dict[str, Any]:
    return {way: [{"copies": length.copies, "entries": length.entries} for length in found]
            for way, found in lengths.items()}  # fmt: skip


def editing_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Editing: what drawing programs can do with a texture."""
    shape = material.example(DUCK)
    after = edit_texture(shape.drawing, packed_of(shape), BALL)
    sampled = convert_by(shape.drawing, WAYS["sampled"])
    text = (
        "Thesis 4.2: “it would require a separate UI to create new shapes”, and 7: “The format’s current form is not "
        "directly compatible with the wide range of customer solutions for creating and editing vector graphics, like "
        "Adobe Illustrator, Inkscape or Sketch.”",
        "Before: a texture cannot be edited. A drawing program shows it as coloured pixels, and every change needs the "
        f"source file and a new conversion, which takes ⟦{TABLE_5_1[DUCK].ms} ms⟧ for the thesis's duck, and "
        f"{1000.0 * sampled.seconds:.0f} ms here by `sampled`.",
        "After: `texture.to_svg()` writes the outlines as a file that any drawing program opens, and "
        "`vexture view --watch` converts the file each time it is saved. From the saved file to the texture's file "
        f"takes {1000.0 * after.seconds:.1f} ms. A texture's picture from SVG export and back differs from the "
        f"drawing's by {after.unchanged.mae:.1g}/255 on average, and by {after.unchanged.max:.1g}/255 at most.",
    )
    caption = (
        "Thesis 4.2. From the left: the thesis's textures of the duck as images; our texture of the duck exported as "
        "SVG, with the nodes and handles that a drawing program shows (the drawing has "
        f"{len(all_cubics(shape.drawing))} cubics, which the conversion cut at the borders of cells and where x or y "
        "turns); this file with a ball added beside the duck; a picture of the texture that the changed file became."
    )
    figure = edited_drawing(pair_of(shape, "sampled"), after, coverage(after.texture, (200, 200), renderer="cpu"))
    picture = PrintedPicture(
        "discussion-editing", figure, caption, "A texture's pixels; its outlines with handles; a changed drawing."
    )
    part = Section("editing", "Editing with ordinary programs (4.2, 7)", text, [picture])
    return DiscussionPoint(part, "time to convert the duck, ms", 1000.0 * sampled.seconds, 1000.0 * after.seconds)
