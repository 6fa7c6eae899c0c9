"""Sections 6.1 and 6.2 of the thesis: what its leaves cannot represent, and where its conversion loses accuracy."""

import numpy as np

from vexture.texture.decode import decode
from vexture.thesis.encode import encode
from vexture.thesis.sample_and_fit import SAMPLES_ACROSS
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree
from vexture_evidence.figures.discussion import before_after, density, stored_value_errors, unneeded_divisions
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.outline import off_outline
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by
from vexture_evidence.measures.stored_coverage import StoredValues, stored_values
from vexture_evidence.measures.thesis_limits import (
    clamp_curves,
    close_up,
    corner_cells,
    looping,
    sharp_corners,
    unnecessary_quads,
)
from vexture_evidence.report.discussion_point import LEFT_OUT, DiscussionPoint, packed_of, pair_of, tree_of
from vexture_evidence.report.section import Material, PrintedPicture, Section

LOOPS, CORNERS, SMALL, LARGE = "loop", "flame", "simple-small", "simple-big"
"""Example drawings for the points that few drawings show, used in every report."""


def loops_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Control range and loops."""
    drawing = looping()
    direct, packed = convert_by(drawing, WAYS["direct"]), convert_by(drawing, WAYS["packed"])
    assert isinstance(direct.tree, CellTree)
    tree, changed = clamp_curves(direct.tree)
    texture = encode(tree, to_source=drawing.to_source, name=drawing.name, bits=16)
    shape = material.example(LOOPS)
    assert isinstance(direct.texture, ThesisTexture)
    rows = [
        close_up(drawing, texture, direct.texture),
        close_up(shape.drawing, pair_of(shape, "sampled"), packed_of(shape)),
    ]
    (before, after), (sampled, ours) = rows[0].errors, rows[1].errors
    whole = close_up(drawing, texture, packed.texture).errors[1]
    left = shape.way("sampled").tree.unresolved
    text = (
        "Thesis 6.1.1: “the control points P1 and P2 are clamped between an x-value of 0 and 1. This means that loops "
        "can never be defined”; a range of -1 to 2 “would allow for a wider range of curve definitions”.",
        "Before: the clamp is restored in the leaves of four cubics that cross themselves. It changes "
        f"{changed} of {len(tree.curves)} curves, and the picture has an error of {before.mae:.3g}/255.",
        "After: the range along the line from P0 to P3 is no longer limited; only the range along the cell's own axes "
        f"is (-1.25 to 2.25). Each loop is one leaf of `direct`, and the error is {after.mae:.2g}/255. `packed` cuts "
        "each cubic where its x or y turns, so that no piece contains a loop: "
        f"{len(packed.tree.curves)} pieces, with an error of {whole.mae:.1g}/255.",
    )
    caption = (
        "Thesis 6.1.1. Above: four cubics, each with a loop, on the left with the clamp and on the right without it. "
        f"Below: the example `{shape.name}`, whose loops are filled by the non-zero rule. The thesis's way "
        f"leaves {left} cells unresolved at the depth limit and has an error of {sampled.mae:.2g}/255; ours has "
        f"{ours.mae:.1g}/255. The titles count the curves in the cells that are shown. " + LEFT_OUT
    )
    picture = PrintedPicture(
        "discussion-loops",
        before_after(rows, [("clamped", "direct"), ("sampled", "packed")]),
        caption,
        "Shapes with loops: before, the loops are missing or wrong; after, they are there.",
    )
    part = Section("control-range", "Control range and loops (6.1.1)", text, [picture])
    return DiscussionPoint(part, "error of a picture of four loops, 1/255", before.mae, whole.mae)


def corners_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Sharp corners."""
    shape = material.example(CORNERS)
    drawing, pair, packed = shape.drawing, pair_of(shape, "sampled"), packed_of(shape)
    corners = sharp_corners(drawing)
    cells = {way: corner_cells(leaves(shape.way(way).texture), corners) for way in WAYS}
    means = {way: float(found.mean()) for way, found in cells.items()}
    x, y = corners[cells["sampled"].argmax()]
    near = (x - 1 / 64, y - 1 / 64, x + 1 / 64, y + 1 / 64)
    rows = [close_up(drawing, pair, packed), close_up(drawing, pair, packed, near)]
    text = (
        "Thesis 6.1.2: “in the case of sharp corners, the cubic Bézier fitter attempts to approximate this with a "
        "curved corner, and will keep subdividing the area of this corner until it reaches the maximally allowed "
        "fitting error.” It proposes a third kind of cell, a straight corner.",
        f"Before: with `sampled`, on average {means['sampled']:.3g} cells with curves lie within 1/64 of each of the "
        f"{len(corners)} sharp corners of `{shape.name}`, which turn by more than 30 degrees.",
        f"After: `direct` has the straight corner that the thesis proposes, and {means['direct']:.3g} such cells. "
        "`packed` needs no third kind of cell, because a leaf holds several pieces that may meet anywhere in it: "
        f"{means['packed']:.3g} cells.",
    )
    caption = (
        f"Thesis 6.1.2. Above: `{shape.name}`, by the thesis's way and by ours. Below: a square of 1/32 of its side "
        "around the corner with the most cells. Before, cells are divided towards the corner until a rounded one is "
        "within tolerance; after, the corner lies inside a leaf. The titles count the curves in the cells that are "
        "shown. " + LEFT_OUT
    )
    picture = PrintedPicture(
        "discussion-corners",
        before_after(rows, [("sampled", "packed")] * 2),
        caption,
        "Subdivision and picture at sharp corners, before and after.",
    )
    part = Section("corners", "Sharp corners (6.1.2)", text, [picture])
    return DiscussionPoint(part, f"cells at a sharp corner of {shape.name}", means["sampled"], means["packed"])


def density_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Interpolation density: how densely the outline is sampled."""
    textures = {way: subject.way(way).texture for way in WAYS}
    off = {way: off_outline(leaves(made).lines().reshape(-1, 2), subject.drawing) for way, made in textures.items()}
    pixels = {way: 1000.0 * found for way, found in off.items()}
    worst = {way: float(found.max(initial=0.0)) for way, found in pixels.items()}
    text = (
        "Thesis 6.2.1: the examples are interpolated “based on the resolution of their defined viewport”; better would "
        "be “not interpolating the curve segments, but instead cutting them up into smaller segments on the points "
        "where they cross the edge of a subdivided quad’s cell”.",
        f"Before: curves are fitted to {SAMPLES_ACROSS} samples across the unit square, and to more where a cell has "
        f"none. The outline in the texture of {subject.name} is up to {worst['sampled']:.2g} pixels away from the "
        "drawing's own outline, in a picture with a side of 1,000 pixels.",
        "After: as the thesis proposes, curves are cut at the borders of cells, and nothing is sampled. `direct` still "
        "fits one curve where several meet in a leaf, because its leaves hold only one: up to "
        f"{worst['direct']:.2g} pixels. `packed` holds the parts themselves, and only their rounding to its lattice "
        f"remains: up to {worst['packed']:.2g} pixels.",
    )
    medians = ", ".join(f"{np.median(found):.1g} by `{way}`" for way, found in pixels.items())
    caption = (
        f"Thesis 6.2.1. Left: the place where the outline of {subject.name} is farthest off by the thesis's way, with "
        "the first samples. Middle: the same place by ours. Right: the distances of points on the textures' outlines "
        "from the drawing's outline, sorted. Median distances, in pixels of a picture with a side of 1,000 pixels: "
        f"{medians}."
    )
    picture = PrintedPicture(
        "discussion-density", density(subject.drawing, textures), caption,
        "Enlarged outlines: before, beside the drawing's; after, on it. The distribution of the distances.",
    )  # fmt: skip
    part = Section("density", "Interpolation density (6.2.1)", text, [picture])
    what = f"largest distance from the outline of {subject.name}, in pixels of a picture 1,000 pixels wide"
    return DiscussionPoint(part, what, worst["sampled"], worst["packed"])


def divisions_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Cells that need not have been divided."""
    shapes = material.example(SMALL), material.example(LARGE)
    shown = [
        (f"{size}, {way}", shape.drawing, shape.way(way).texture)
        for way in ("sampled", "packed")
        for shape, size in zip(shapes, ("small", "big"), strict=True)
    ]
    counts = [int(unnecessary_quads(drawing, texture).sum()) for _, drawing, texture in shown]
    direct = sum(int(unnecessary_quads(shape.drawing, shape.way("direct").texture).sum()) for shape in shapes)
    text = (
        "Thesis 6.2.2: “the lower left quadrant is described as a single curve in the first example, but has been "
        "subdivided multiple times in the latter example. The original vector shape is defined by a single curve in "
        "that quadrant, so there is no reason why this couldn’t extend to its vector texture representation.”",
        f"Before: {counts[0]} of the quads that `sampled` makes of the small simple shape, and {counts[1]} of those of "
        "the big one, divide a square through which one cubic passes once and nothing else.",
        f"After: for both shapes together, `direct` makes {direct} such quads and `packed` {counts[2] + counts[3]}, "
        "because a square with a part of one cubic becomes a leaf before anything else is tried.",
    )
    caption = (
        "Thesis 6.2.2. The simple shape, small and big, by the thesis's way and by ours. Hatched: squares that were "
        "divided although one cubic of the drawing passes through them once and nothing else does (tested with 1,024 "
        "points on each cubic; the unit square is always divided and does not count). The titles give the number of "
        "hatched squares and the number of all quads. " + LEFT_OUT
    )
    picture = PrintedPicture(
        "discussion-divisions", unneeded_divisions(shown), caption, "Cells of a shield in two sizes, before and after."
    )
    part = Section("divisions", "Unnecessary subdivisions (6.2.2)", text, [picture])
    return DiscussionPoint(
        part, "quads around a single curve, both sizes", counts[0] + counts[1], counts[2] + counts[3]
    )


def values_point(material: Material, subject: ConvertedDrawing) -> DiscussionPoint:
    """Accuracy of MIP values."""
    drawing, tree, texture = subject.drawing, tree_of(subject, "sampled"), pair_of(subject, "sampled")
    stored = {
        "straight lines": stored_values(drawing, tree),
        "16 samples": stored_values(drawing, tree, texture),
        "packed": stored_values(drawing, decode(packed_of(subject))),
    }
    lines, samples, ours = (LEVELS * float(values.quad_off.mean()) for values in stored.values())
    whole = [LEVELS * float(values.quad_off[0]) for values in stored.values()]
    text = (
        "Thesis 6.2.3: “The generation of the MIP-values is currently done quite coarsely, by ignoring the control "
        "points P1 and P2. This could be improved by using the concept of MultiSample Anti-Aliasing and taking the "
        "average of 16 samples of each specific curve.”",
        "Before: each MIP value is the area beside straight lines from P0 to P3. The mean error of the MIP values of "
        f"the quads of {subject.name} is {lines:.2g}/255; that of the whole drawing is off by {whole[0]:.2g}/255.",
        f"The thesis's remedy, a grid of 16 samples for each curve, has a mean error of {samples:.2g}/255 (whole "
        f"drawing: {whole[1]:.2g}/255). 16 samples measure areas in steps of 1/16, which for curves as flat as these "
        + ("is less accurate than a straight line." if samples > lines else "is more accurate than a straight line."),
        "After: the area beside a cubic is a polynomial, which is integrated exactly. Only the rounding to the byte in "
        f"which `packed` stores it remains: a mean error of {ours:.2g}/255, at most {_most(stored['packed']):.2g}/255.",
    )
    caption = (
        f"Thesis 6.2.3. Errors of the coverage that is stored for the cells of {subject.name}, against their exact "
        "coverage: by straight lines, by 16 samples of each curve, and ours, all on one colour scale. Right: errors of "
        "the MIP values of quads, by depth."
    )
    picture = PrintedPicture(
        "discussion-values",
        stored_value_errors(stored),
        caption,
        "Cells coloured by the error of their stored coverage, and errors by depth.",
    )
    part = Section("mip-values", "Accuracy of MIP values (6.2.3)", text, [picture])
    return DiscussionPoint(part, f"mean error of {subject.name}'s MIP values, 1/255", lines, ours)


def _most(values: StoredValues) -> float:
    return LEVELS * float(values.quad_off.max())
