"""The thesis's chapter 6, answered point by point: each limit of its method, before and after."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from vexture.base.errors import LimitError
from vexture_evidence.measures.shape import ConvertedDrawing
from vexture_evidence.report.discussion_of_conversion import (
    corners_point,
    density_point,
    divisions_point,
    loops_point,
    values_point,
)
from vexture_evidence.report.discussion_of_use import crossings_point, editing_point, lines_point, lists_point
from vexture_evidence.report.discussion_point import DiscussionPoint, tree_of
from vexture_evidence.report.section import Material, Section, Table

DUCK = "duck"

MOST_SEGMENTS: Final = 500
"""Limit on the user's drawing: with more segments repeated sampling takes too long, and the duck is shown instead."""

POINTS: Final[tuple[Callable[[Material, ConvertedDrawing], DiscussionPoint], ...]] = (
    loops_point,
    corners_point,
    density_point,
    divisions_point,
    values_point,
    lines_point,
    crossings_point,
    lists_point,
    editing_point,
)


def section(material: Material) -> Section:
    """Make the section: a table of all points, then one part for each.

    Parameters
    ----------
    material : Material
    """
    subject, why = _subject(material)
    points = [make(material, subject) for make in POINTS]
    table = Table(
        "points",
        "Every point of the thesis's chapter 6, and two of chapter 4, each with one measured quantity: before, by the "
        "thesis's own way (`sampled`) or with the thesis's rule restored, and after, by ours.",
        ("point", "measured", "before", "after"),
        [(point.section.title, point.quantity, point.before, point.after) for point in points],
    )
    parts = [
        replace(point.section, facts={"measured": point.quantity, "before": point.before, "after": point.after}
                | dict(point.section.facts))
        for point in points
    ]  # fmt: skip
    text = (
        "Chapter 6 of the thesis, the last but one, says what its method could not do yet. This section quotes each "
        "point in the thesis's words and shows the result of the thesis's way and of ours.",
        f"A point that any drawing shows is shown on {subject.name}; other points are shown on the example drawing "
        "that shows them best. Errors of pictures are mean absolute differences from the exact coverage, in 1/255, "
        "over the pixels that the shape touches in the picture or in the truth (the exact coverage). Pictures are "
        "rendered on the CPU.",
        *([f"The drawing that this page is about is not used for these points: {why}"] if why else []),
    )
    return Section("discussion", "Chapter 6, answered", text, [table, *parts])


def _subject(material: Material) -> tuple[ConvertedDrawing, str]:
    """The drawing for the points that any drawing shows: the report's main one, or the duck and the reason."""
    own, duck = material.main, material.example(DUCK)
    segments = own.drawing.segments
    if segments > MOST_SEGMENTS:
        return duck, f"{own.name} has {segments:,} segments, and sampling more than {MOST_SEGMENTS} takes long."
    try:
        drawn = all(len(tree_of(own, way).curves) for way in ("sampled", "direct"))
    except LimitError as error:
        return duck, str(error)
    return (own, "") if drawn else (duck, f"{own.name} has no outline.")
