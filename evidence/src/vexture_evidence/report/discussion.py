"""The thesis's chapter 6, answered point by point: what it says is missing, before and after."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from vexture.errors import LimitError
from vexture_evidence.measures.shape import Shape
from vexture_evidence.report.discussed import Point, tree_of
from vexture_evidence.report.discussed_conversion import (
    corners_point,
    density_point,
    divisions_point,
    loops_point,
    values_point,
)
from vexture_evidence.report.discussed_use import crossings_point, editing_point, lines_point, lists_point
from vexture_evidence.report.section import Material, Section, Table

__all__ = ["section"]

DUCK = "duck"

MOST_SEGMENTS: Final = 500
"""A larger drawing of the user's is not sampled again and again: the points are shown on the duck."""

POINTS: Final[tuple[Callable[[Material, Shape], Point], ...]] = (
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
        "Every point of the thesis's chapter 6, and two of chapter 4: one measured figure before, by the thesis's own "
        "way (`sampled`) or with its rule restored, and after.",
        ("point", "measured", "before", "after"),
        [(point.section.title, point.what, point.before, point.after) for point in points],
    )
    parts = [
        replace(point.section, facts={"measured": point.what, "before": point.before, "after": point.after}
                | dict(point.section.facts))
        for point in points
    ]  # fmt: skip
    text = (
        "The thesis's last chapter but one says what its method could not do yet. Here is each point in its words, "
        "what the thesis's way makes of it, and what became of it.",
        f"Where any drawing shows the point it is shown on {subject.name}, else on the example drawing that shows it "
        "best. Errors of pictures are mean absolute differences from the exact coverage over the pixels that the shape "
        "touches, in the picture or in truth, in 1/255. Pictures are rendered on the CPU.",
        *([f"Why not on the drawing that this page is about: {why}"] if why else []),
    )
    return Section("discussion", "Chapter 6, answered", text, [table, *parts])


def _subject(material: Material) -> tuple[Shape, str]:
    """The drawing that points are shown on which any drawing shows: the report's own, or why not."""
    own, duck = material.main, material.example(DUCK)
    segments = own.drawing.segments
    if segments > MOST_SEGMENTS:
        return duck, f"{own.name} has {segments:,} segments; up to {MOST_SEGMENTS} are sampled again and again."
    try:
        drawn = all(len(tree_of(own, way).curves) for way in ("sampled", "direct"))
    except LimitError as error:
        return duck, str(error)
    return (own, "") if drawn else (duck, f"{own.name} has no outline.")
