"""Rendering: few pixels, edges, the cut-off, the solutions of a cubic, tolerances, and a receding plane."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from vexture.base.errors import LimitError
from vexture_evidence.figures.edges import edges
from vexture_evidence.figures.plane import plane
from vexture_evidence.figures.resolutions import exaggerated_cut_off, resolutions
from vexture_evidence.figures.solutions import solutions
from vexture_evidence.figures.tolerances import tolerances
from vexture_evidence.measures.plane import Receding, receding
from vexture_evidence.measures.renderings import (
    EXAGGERATED,
    GRID,
    PACKED,
    TURNED,
    Rendered,
    at_edge,
    at_sizes,
    cut_off_at,
    with_tolerances,
)
from vexture_evidence.measures.solutions import SOLUTIONS, by_cpu, by_gpu, roots_by_gpu, solve
from vexture_evidence.report.section import Material, PrintedPicture, Section, Table

SIDE: Final = 128
"""Side of the pictures of solved curves, in pixels."""

TEXT: Final = (
    "The thesis's shader looks up the pixel's centre in the quad-tree. If it reaches a quad that is smaller than the "
    "pixel, it uses the coverage that is stored for this quad (the MIP value); otherwise it tests 4 x 4 points of the "
    "pixel against the one curve of the leaf. Both are measured here against the exact area of the shape in the "
    "pixel's square, and so is the shader of the packed texture, which computes that area. Errors are means over the "
    "pixels that the shape touches in the picture or in the truth (the exact coverage), in steps of 1/255.",
)


def section(material: Material) -> Section:
    """Make the section on rendering.

    Parameters
    ----------
    material : Material
        Its main drawing is shown; the solved curves and the plane are the same in all reports.
    """
    parts = (
        _sizes(material),
        _edges(material),
        _cut_off(material),
        _solutions(material),
        _tolerance(material),
        _plane(),
    )
    return Section("rendering", "From textures to pixels", TEXT, parts)


def _refusal(material: Material) -> str:
    """Reason why the thesis's pictures are missing; empty if they are not."""
    try:
        material.main.way("sampled")
    except LimitError as error:
        return f" The thesis's encoding cannot hold this drawing: {error}."
    return ""


def _sizes(material: Material) -> Section:
    rendered = at_sizes(material.main)
    last = rendered[-1]
    errors = {name: error.mae for name, error in last.errors.items()}
    stored = "" if last.from_mip is None else (
        " The columns show 1 x 1 to 16 x 16 pixels. A single test at the centre gives full or empty pixels only. A MIP "
        "value helps only pixels that are larger than a quad. The blue pixels of the third row come from leaves and "
        "keep their stair-steps. 16 samples smooth these, but all of them are tested against the one curve at the "
        "pixel's centre, which in a picture of few pixels does not represent the shape. (At 1 x 1 the root quad is "
        "exactly as large as the pixel. The rule as printed stops at quads that are smaller, so it takes the quarter "
        "in which the centre lies.)"
    )  # fmt: skip
    caption = (
        f"Thesis 3.13. The drawing `{material.main.name}` in pictures of few pixels.{stored} Mean errors at "
        f"{len(last.truth)} x {len(last.truth)} pixels: {_format_errors(errors)}.{_refusal(material)}"
    )
    table = Table(
        "errors-at-sizes",
        f"Mean error of `{material.main.name}` at each size, 1/255",
        ("way", *(f"{len(view.truth)} px" for view in rendered)),
        [(name, *(view.errors[name].mae for view in rendered)) for name in last.images],
    )
    picture = PrintedPicture(
        "few-pixels", resolutions(rendered), caption, "A drawing in 1 to 16 pixels a side by several methods"
    )
    return Section("few-pixels", "Few pixels", (), (picture, table))


def _edges(material: Material) -> Section:
    rendered = at_edge(material.main)
    errors = rendered.errors
    ours = errors[PACKED]
    said = f"packed is off by {ours.mae:.3g} on average and {ours.max:.2g} at most"
    if GRID in errors:
        said = f"16 samples are off by {errors[GRID].mae:.3g} on average and {errors[GRID].max:.0f} at most, {said}"
    assert rendered.to_unit is not None
    across = len(rendered.truth) * float(np.hypot(*rendered.to_unit[:2, 0]))
    caption = (
        f"Thesis 4.14. A piece of the outline of `{material.main.name}`, {across:.3g} of the drawing wide and turned "
        f"by {TURNED:.0f} degrees: by the thesis's way without and with supersampling, by the packed texture, and the "
        f"exact coverage. Below: the error of each pixel. Errors in 1/255: {said}.{_refusal(material)}"
    )
    picture = PrintedPicture(
        "edges", edges(rendered), caption, "Pixels of an outline by several methods, and their errors"
    )
    return Section("edges", "Edges", (), (picture,), {"errors": {name: e._asdict() for name, e in errors.items()}})


def _cut_off(material: Material) -> Section:
    try:
        drawn = cut_off_at(material.main)
    except LimitError:
        return Section("cut-off", "Where the descent ends", (f"Thesis 4.15 is not shown.{_refusal(material)}",))
    shares = {f"{len(picture.image)} px": float(picture.from_mip.mean()) for picture in drawn}
    caption = (
        f"Thesis 4.15. To show where the descent ends, quads smaller than {EXAGGERATED:.0f} pixels are drawn by their "
        "MIP values here (grey: lighter means fuller). Blue and orange pixels are inside and outside the shape "
        f"according to a leaf. As the picture grows from {len(drawn[0].image)} to {len(drawn[-1].image)} pixels a "
        f"side, the share of pixels with MIP values falls from {100 * drawn[0].from_mip.mean():.0f}% to "
        f"{100 * drawn[-1].from_mip.mean():.0f}%; they remain at the places with the finest detail."
    )
    picture = PrintedPicture(
        "cut-off", exaggerated_cut_off(drawn), caption, "MIP values of large quads at five sizes of the picture"
    )
    return Section("cut-off", "Where the descent ends", (), (picture,), {"share of MIP values": shares})


def _solutions(material: Material) -> Section:
    gpu = material.device is not None
    rows, facts = [], {}
    for number, case in enumerate(SOLUTIONS, 1):
        cpu = solve(case)
        row: list[Any] = [
            f"{number} {case.name}",
            _format_roots(cpu.t),
            None,
            _format_roots(cpu.heights),
            None,
            None,
            None,
            None,
        ]
        if gpu:
            found = roots_by_gpu(case)
            row[2], row[4] = _format_roots(found.t), _format_roots(found.heights)
            row[5:] = [_farthest(found.t, cpu.t), _farthest(found.heights, cpu.heights)]
            row.append(int((by_cpu(case, SIDE) != by_gpu(case, SIDE)).sum()))
        rows.append(row)
        facts[case.name] = {"p1": case.p1, "p2": case.p2, "x": case.x, "t": cpu.t, "heights": cpu.heights}
    compared = (
        "The left picture of each pair is computed in float64 on the CPU, the right one by the shader itself, in "
        f"float32 on {material.device}. The largest difference between roots is {max(row[5] for row in rows):.1g}; "
        f"{sum(row[7] for row in rows)} of {len(SOLUTIONS) * SIDE**2:,} pixels differ."
        if gpu
        else "There is no OpenGL on this machine, so the pictures from the GPU are left out."
    )
    caption = (
        "Thesis 4.9, 4.10. One cubic for each of the nine solution paths of Figure 3.5, in the coordinates of its "
        "chord (P0 at 0, P3 at 1, filled below), solved for the x of the dashed line. Dots mark the roots that the "
        "solver finds, given by their t and heights. At a double root the curve touches the line without crossing it; "
        "double roots are left out, because they do not change whether a point is inside or outside (thesis 3.3.3). "
        f"{compared}"
    )
    picture = PrintedPicture(
        "solution-paths", solutions(side=SIDE, gpu=gpu), caption, "Nine cubic curves with their roots"
    )
    table = Table(
        "solutions",
        "Roots of the nine curves, and the curves' heights there" + ("" if gpu else ". Dashes: no OpenGL here"),
        (
            "path",
            "t: CPU",
            "t: GPU",
            "heights: CPU",
            "heights: GPU",
            "largest difference: of t",
            "largest difference: of a height",
            "pixels that differ",
        ),
        rows,
    )
    return Section("solution-paths", "Nine ways to solve a cubic", (), (picture, table), facts)


def _farthest(found: Sequence[float], true: Sequence[float]) -> float:
    """Largest difference between roots; infinite where one is missing."""
    return float(np.abs(np.subtract(found, true)).max()) if len(found) == len(true) else float("inf")


def _tolerance(material: Material) -> Section:
    fitted, whole, close, square = with_tolerances(material.main)
    errors, near = whole.errors, close.errors
    caption = (
        f"Thesis 5.12. `{material.main.name}` by the thesis's way with a tolerance that suits its smallest detail, "
        "by the same way with a tolerance ten times as large, and by `packed`, which fits no curves and so needs no "
        "tolerance. Below: the marked square, where the errors are largest; the orange line is the drawing's own "
        f"outline. Mean errors in that square: {_format_errors({name: error.mae for name, error in near.items()})}."
        f"{_refusal(material)}"
    )
    table = Table(
        "tolerances",
        "Effects of the tolerance; distances in thousandths of the drawing's side, before quantisation",
        ("way", "tolerance", "largest distance", "curves", "bytes on the GPU", "error: whole", "error: marked square"),
        [
            (fit.name, 1e3 * fit.tolerance, 1e3 * fit.deviation, fit.curves, fit.nbytes, errors[fit.name].mae,
             near[fit.name].mae)
            for fit in fitted
        ],
    )  # fmt: skip
    drawn = tolerances(material.main.drawing, whole, close, square)
    picture = PrintedPicture(
        "tolerance", drawn, caption, "A drawing converted with three tolerances, whole and enlarged"
    )
    return Section("tolerance", "A tolerance too loose", (), (picture, table))


def _plane() -> Section:
    found = receding()
    errors, far = found.rendered.errors, _far(found)
    caption = (
        f"Thesis 2.7. A receding plane of {found.tiles} x {found.tiles} dots. A single fetch from a raster texture "
        "aliases where a pixel covers many texels. Its mip-map, filtered alike in all directions, turns the pattern "
        "grey long before the dots become too small to see. Near the eye both blur: they have "
        f"{found.raster_side} x {found.raster_side} texels, which with the mip-map take as much memory as the packed "
        "texture. The thesis's shader, as kept here (`sampled`), takes MIP values where a pixel's footprint is longer "
        "than a quad is wide. The shader of the packed texture integrates over the pixel's own footprint. Mean errors: "
        f"{_format_errors({name: error.mae for name, error in errors.items()})}. In the far quarter of the picture: "
        f"{_format_errors(far)}."
    )
    table = Table(
        "plane-errors",
        "The receding plane: memory on the GPU and mean errors, 1/255",
        ("way", "bytes on the GPU", "error: whole picture", "error: far quarter"),
        [(name, found.nbytes[name], error.mae, far[name]) for name, error in errors.items()],
    )
    picture = PrintedPicture("plane", plane(found), caption, "Dots on a receding plane by four methods and the truth")
    return Section("plane", "A pattern that recedes", (), (picture, table))


def _far(found: Receding) -> dict[str, float]:
    """Mean errors of the upper quarter of the picture."""
    rows = len(found.rendered.truth) // 4
    upper = {name: image[:rows] for name, image in found.rendered.images.items()}
    return {name: error.mae for name, error in Rendered(upper, found.rendered.truth[:rows]).errors.items()}


def _format_errors(errors: dict[str, float]) -> str:
    return "; ".join(f"{name} {error:.3g}" for name, error in errors.items())


def _format_roots(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.4f}" for value in values) or "none"
