"""The thesis's 6.3, 6.4, 4.3.1 and 4.2: lines in pictures, crossings, long lists, and editing."""

from typing import Any, Final

import numpy as np

from vexture.images import coverage
from vexture.pipeline import run
from vexture.texture.texture import Texture
from vexture.thesis.layout import LIST_LIMIT
from vexture_evidence.figures.discussion import before_after, edited_drawing, lines_at_borders, list_growth
from vexture_evidence.measures.closeups import closeup, joined
from vexture_evidence.measures.editing import edited
from vexture_evidence.measures.printed import TABLE_5_1
from vexture_evidence.measures.shape import WAYS, Shape
from vexture_evidence.measures.thesis_limits import Close, Lengths, close_up, list_lengths
from vexture_evidence.report.discussed import LEFT_OUT, Point, packed_of, pair_of
from vexture_evidence.report.section import Material, Picture, Section

__all__ = ["crossings_point", "editing_point", "lines_point", "lists_point"]

CROSSED, SMALL, DUCK = "crossings", "simple-small", "duck"
"""Example drawings on which a point shows, whatever the report is about."""

CROSSING: Final = (170.0 / 256.0, 45.5 / 256.0)
"""Where two sides of the lower pentagram cross."""

UNALIGNED: Final = 101
"""Pixels of a picture whose borders are not those of cells: else these would not show."""

ACROSS: Final = {"sampled": (1, 2, 3, 5), "direct": (1, 3, 9, 27, 81, 108), "packed": (1, 3, 9, 27, 81, 108)}
"""Copies in a row: the thesis's own way takes long."""

BALL: Final = '<circle cx="36" cy="40" r="24"/>'
"""What is drawn beside the duck, in the units of its file."""


def lines_point(material: Material, subject: Shape) -> Point:
    """Lines along the borders of cells."""
    close = _as_thesis(subject)
    if not close.stray[0]:  # its outline is nowhere near a border of cells
        subject = material.example(DUCK)
        close = _as_thesis(subject)
    same = close_up(subject.drawing, pair_of(subject, "direct"), pair_of(subject, "direct"), side=UNALIGNED)
    before, after = close.stray
    again = same.stray[1]
    text = (
        "Thesis 6.3: the pictures “show some visible and unwanted artifacts. These mainly consist of the horizontal "
        "and vertical lines that can be seen in every rendered result”; it puts them down to “gaps in precision when "
        "traversing down the quad-tree”.",
        "Before: they come from more than precision. All 16 samples of a pixel take the curve of the cell of its "
        "centre, which where a cell ends is prolonged beyond it. The thesis's way to a pixel shows the lines in "
        f"float64 too: {before} pixels of the picture are wrong although no outline passes through them.",
        f"After: a sample that leaves the cell is looked up again, and of the same texture {again} such pixels are "
        f"left. Ours is integrated piece by piece and cell by cell: {after}.",
    )
    caption = (
        f"Thesis 6.3. {subject.name} at {UNALIGNED} x {UNALIGNED} pixels from its `direct` texture, whose curves are "
        f"exact or nearly so. Middle: errors of the thesis's way to a pixel, largest where the outline passes a cell's "
        f"border; {close.errors[0].mae:.2g}/255 over all. Right: errors of `packed`, whose own cells are "
        f"others, {close.errors[1].mae:.1g}/255."
    )
    picture = Picture(
        "discussion-lines",
        lines_at_borders(close, ("as the thesis draws it", "packed")),
        caption,
        "Errors of two pictures, with the cells' borders above them.",
    )
    part = Section("lines", "Lines along cells (6.3)", text, [picture])
    return Point(part, f"pixels of {subject.name} that are wrong away from its outline", before, after)


def _as_thesis(shape: Shape) -> Close:
    return close_up(shape.drawing, pair_of(shape, "direct"), packed_of(shape), side=UNALIGNED, as_thesis=True)


def crossings_point(material: Material, subject: Shape) -> Point:
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
        f"{left} cells hold what no curve can say.",
        f"After: crossings are resolved in the leaf, by either rule, with {none} cells left over.",
    )
    caption = (
        f"Thesis 6.4. Above: `{shape.name}`, before with {left} unresolved cells and after with {none}. Below: one "
        "crossing, 1/64 of the drawing. Curves: in the cells that are seen. " + LEFT_OUT
    )
    picture = Picture(
        "discussion-crossings",
        before_after(rows, [("sampled", "packed")] * 2),
        caption,
        "Two pentagrams and one of their crossings, before and after.",
    )
    part = Section("crossings", "Crossings (6.4)", text, [picture])
    return Point(part, f"error of a picture of {shape.name}, 1/255", before.mae, after.mae)


def lists_point(material: Material, subject: Shape) -> Point:
    """How much a texture holds."""
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
    held = {way: _held(found) for way, found in lengths.items()}
    refusal = next((length.refused for length in lengths["direct"] if length.refused), "")
    printed = [TABLE_5_1[name].curves for name in (SMALL, "simple-duo", "simple-quartet")]
    text = (
        "Thesis 4.3.1: 16-bit channels allow “for lists sizes up to 65.536 curves or quads, instead of the maximum of "
        "256 quads or curves in 8-bit channels”; 5.1 compares files of 8 bits only, because no example needs more.",
        f"Before: the simple shape once, twice and four times is ⟦{printed[0]}, {printed[1]} and {printed[2]}⟧ curves "
        "in the thesis. Indices are stored as fractions, of which float32 tells "
        f"{LIST_LIMIT[16]:,} apart. {across * across:,} copies are refused: “{refusal}”.",
        "After: an index is a whole number of 32 bits, and one texture holds them all: "
        f"{held['packed']:,} copies in {texture.nbytes:,} bytes.",
    )
    caption = (
        "Thesis 4.3.1 and 5.1. Left: entries of the longer list (of `packed`: all texels) over copies of the simple "
        "shape; dashed, what a texture can hold; the cross is what was refused. Middle and right: parts of "
        f"{across * across:,} copies, from `packed`. `sampled`, which takes long, is tried with few."
    )
    picture = Picture(
        "discussion-lists",
        list_growth(lengths, parts),
        caption,
        "Growth of the lists, and a drawing of thousands of shapes.",
    )
    part = Section("list-limits", "List limits (4.3.1, 5.1)", text, [picture], {"lengths": _as_facts(lengths)})
    return Point(part, "copies of the simple shape held, of the numbers tried", held["direct"], held["packed"])


def _held(found: list[Lengths]) -> int:
    return max(length.copies for length in found if length.entries is not None)


def _as_facts(lengths: dict[str, list[Lengths]]) -> dict[str, Any]:
    return {way: [{"copies": length.copies, "entries": length.entries} for length in found]
            for way, found in lengths.items()}  # fmt: skip


def editing_point(material: Material, subject: Shape) -> Point:
    """What drawing programs can do with a texture."""
    shape = material.example(DUCK)
    after = edited(shape.drawing, packed_of(shape), BALL)
    sampled = run(shape.drawing, **WAYS["sampled"])
    text = (
        "Thesis 4.2: “it would require a separate UI to create new shapes”, and 7: “The format’s current form is not "
        "directly compatible with the wide range of customer solutions for creating and editing vector graphics, like "
        "Adobe Illustrator, Inkscape or Sketch.”",
        "Before: a texture is an end. What a drawing program opens of it is coloured pixels, and a change means the "
        f"source and a conversion of ⟦{TABLE_5_1[DUCK].ms} ms⟧ for the thesis's duck, "
        f"{1000.0 * sampled.seconds:.0f} ms here by `sampled`.",
        "After: `texture.to_svg()` gives the outlines back as a file that any drawing program opens, and "
        f"`vexture view --watch` converts whatever one saves. From the saved file to the texture's file: "
        f"{1000.0 * after.seconds:.1f} ms. There and back changes a picture by {after.unchanged.mae:.1g}/255 in the "
        f"mean, {after.unchanged.max:.1g} at most.",
    )
    caption = (
        "Thesis 4.2. From the left: the thesis's textures of the duck as images; the duck's texture of ours as SVG, "
        f"with the nodes and handles that a drawing program shows ({len(joined(shape.drawing))} cubics were drawn, cut "
        "since where cells end or they turn); the file after a ball was drawn beside it; what it was converted to."
    )
    figure = edited_drawing(pair_of(shape, "sampled"), after, coverage(after.texture, (200, 200), renderer="cpu"))
    picture = Picture(
        "discussion-editing", figure, caption, "A texture's pixels; its outlines with handles; a changed drawing."
    )
    part = Section("editing", "Editing with ordinary programs (4.2, 7)", text, [picture])
    return Point(part, "from the duck's file to its texture, ms", 1000.0 * sampled.seconds, 1000.0 * after.seconds)
