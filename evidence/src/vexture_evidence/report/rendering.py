"""How the pixels come about: few of them, edges, the cut-off, the cubic's solutions, tolerances, a receding plane."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from vexture.errors import LimitError
from vexture_evidence.figures.edges import edges
from vexture_evidence.figures.plane import plane
from vexture_evidence.figures.resolutions import exaggerated, resolutions
from vexture_evidence.figures.solutions import solutions
from vexture_evidence.figures.tolerances import tolerances
from vexture_evidence.measures.plane import Receding, receding
from vexture_evidence.measures.rendered import (
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
from vexture_evidence.report.section import Material, Picture, Section, Table

__all__ = ["section"]

SIDE: Final = 128
"""Pixels of the pictures of solved curves."""

TEXT: Final = (
    "The thesis draws a pixel by what it finds at the pixel's centre: the stored coverage of a quad that is smaller "
    "than the pixel (a MIP value), or 4 x 4 points against the one curve of the leaf there. Both are measured here "
    "against the exact area of the shape in the pixel's square, and so is the packed texture's shader, which computes "
    "that area. Errors are means over the pixels that the shape touches, in the picture or "
    "in truth, in steps of 1/255.",
)


def section(material: Material) -> Section:
    """Make the part of the report that is about renderings.

    Parameters
    ----------
    material : Material
        Its main drawing is the one shown; the curves and the plane are the same in all reports.
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
    """Why the thesis's pictures are missing; empty if they are not."""
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
        " Columns: one pixel to 16 x 16. The centre alone hits or misses; a MIP value helps only pixels that a whole "
        "quad fits into; the blue pixels of the third row come from leaves and keep their stairs; 16 samples smooth "
        "those, but each of them sees no other curve than the centre's, and in few pixels that is not the shape. (At 1 "
        "x 1 a quad is exactly as large as the pixel. The rule as printed stops at quads that are smaller, so it "
        "takes the quarter in which the centre lies.)"
    )  # fmt: skip
    caption = (
        f"Thesis 3.13. The drawing `{material.main.name}` in few pixels.{stored} Mean errors at {len(last.truth)} x "
        f"{len(last.truth)} pixels: {_listed(errors)}.{_refusal(material)}"
    )
    table = Table(
        "errors-at-sizes",
        f"Mean error of `{material.main.name}` at each size, 1/255",
        ("way", *(f"{len(view.truth)} px" for view in rendered)),
        [(name, *(view.errors[name].mae for view in rendered)) for name in last.images],
    )
    picture = Picture(
        "few-pixels", resolutions(rendered), caption, "A drawing in 1 to 16 pixels a side by several methods"
    )
    return Section("few-pixels", "Few pixels", (), (picture, table))


def _edges(material: Material) -> Section:
    rendered = at_edge(material.main)
    errors = rendered.errors
    ours = errors[PACKED]
    said = f"packed {ours.mae:.3g} on average and {ours.max:.2g} at most"
    if GRID in errors:
        said = f"16 samples are off by {errors[GRID].mae:.3g} on average and {errors[GRID].max:.0f} at most, {said}"
    assert rendered.to_unit is not None
    across = len(rendered.truth) * float(np.hypot(*rendered.to_unit[:2, 0]))
    caption = (
        f"Thesis 4.14. A piece of the outline of `{material.main.name}`, {across:.3g} of the drawing wide and turned "
        f"by {TURNED:.0f} degrees, without and with "
        f"supersampling as the thesis has it, by the packed texture, and by the truth; below, the error of each pixel. "
        f"In 1/255 {said}.{_refusal(material)}"
    )
    picture = Picture("edges", edges(rendered), caption, "Pixels of an outline by several methods, and their errors")
    return Section("edges", "Edges", (), (picture,), {"errors": {name: e._asdict() for name, e in errors.items()}})


def _cut_off(material: Material) -> Section:
    try:
        drawn = cut_off_at(material.main)
    except LimitError:
        return Section("cut-off", "Where the descent ends", (f"Thesis 4.15 is not shown.{_refusal(material)}",))
    shares = {f"{len(picture.image)} px": float(picture.from_mip.mean()) for picture in drawn}
    caption = (
        f"Thesis 4.15. Quads smaller than {EXAGGERATED:.0f} pixels drawn by their MIP values (grey: lighter is "
        f"fuller), so that one sees where the descent ends; blue and orange pixels are in and out by a leaf. As the "
        f"picture grows from {len(drawn[0].image)} to {len(drawn[-1].image)} pixels, MIP values retreat from "
        f"{100 * drawn[0].from_mip.mean():.0f}% of the pixels to {100 * drawn[-1].from_mip.mean():.0f}%, into the "
        f"places with the finest detail."
    )
    picture = Picture("cut-off", exaggerated(drawn), caption, "MIP values of large quads at five sizes of the picture")
    return Section("cut-off", "Where the descent ends", (), (picture,), {"share of MIP values": shares})


def _solutions(material: Material) -> Section:
    gpu = material.device is not None
    rows, facts = [], {}
    for number, case in enumerate(SOLUTIONS, 1):
        cpu = solve(case)
        row: list[Any] = [f"{number} {case.name}", _several(cpu.t), None, _several(cpu.heights), None, None, None, None]
        if gpu:
            found = roots_by_gpu(case)
            row[2], row[4] = _several(found.t), _several(found.heights)
            row[5:] = [_farthest(found.t, cpu.t), _farthest(found.heights, cpu.heights)]
            row.append(int((by_cpu(case, SIDE) != by_gpu(case, SIDE)).sum()))
        rows.append(row)
        facts[case.name] = {"p1": case.p1, "p2": case.p2, "x": case.x, "t": cpu.t, "heights": cpu.heights}
    compared = (
        f"Left of each pair float64 on the CPU, right the shader itself in float32 on {material.device}. The largest "
        f"difference of a root is {max(row[5] for row in rows):.1g}; of {len(SOLUTIONS) * SIDE**2:,} pixels "
        f"{sum(row[7] for row in rows)} differ."
        if gpu
        else "There is no OpenGL on this machine, so the GPU's pictures are left out."
    )
    caption = (
        "Thesis 4.9, 4.10. A curve for each of the nine solution paths of Figure 3.5, in the basis of its chord (P0 at "
        "0, P3 at 1, filled below), solved where the dashed line is: dots are what the solver finds on the curve, with "
        "their t and heights. The two parts of a double root touch the line without crossing it; they are left out, "
        f"because they change nothing between in and out (thesis 3.3.3). {compared}"
    )
    picture = Picture("solution-paths", solutions(side=SIDE, gpu=gpu), caption, "Nine cubic curves with their roots")
    table = Table(
        "solutions",
        "Roots of the nine curves, and the curves' heights there" + ("" if gpu else "; dashes: no OpenGL here"),
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
        "with one ten times as large, and packed, which fits nothing and so needs none. Below, the marked square, "
        f"where they are worst; the orange line is the drawing's own outline. Mean errors in that square: "
        f"{_listed({name: error.mae for name, error in near.items()})}.{_refusal(material)}"
    )
    table = Table(
        "tolerances",
        "Tolerance and what follows from it; distances in thousandths of the drawing's side, before quantisation",
        ("way", "tolerance", "largest distance", "curves", "bytes on the GPU", "error: whole", "error: marked square"),
        [
            (fit.name, 1e3 * fit.tolerance, 1e3 * fit.deviation, fit.curves, fit.nbytes, errors[fit.name].mae,
             near[fit.name].mae)
            for fit in fitted
        ],
    )  # fmt: skip
    drawn = tolerances(material.main.drawing, whole, close, square)
    picture = Picture("tolerance", drawn, caption, "A drawing converted with three tolerances, whole and enlarged")
    return Section("tolerance", "A tolerance too loose", (), (picture, table))


def _plane() -> Section:
    found = receding()
    errors, far = found.rendered.errors, _far(found)
    caption = (
        f"Thesis 2.7. A plane of {found.tiles} x {found.tiles} dots that recedes. One fetch from a raster texture "
        "aliases where a pixel holds many texels. Its mip-map, filtered alike in all directions, turns that to grey "
        "long before the dots are gone. Near the eye both blur: they have "
        f"{found.raster_side} x {found.raster_side} texels, which with the mip-map take as much memory as the packed "
        "texture. The thesis's shader, as it is kept here (`sampled`), takes MIP values where a pixel is longer than a "
        "quad is wide. The packed texture's integrates over the pixel's own footprint. Mean errors: "
        f"{_listed({name: error.mae for name, error in errors.items()})}. In the far quarter of the picture: "
        f"{_listed(far)}."
    )
    table = Table(
        "plane-errors",
        "The receding plane: memory on the GPU and mean errors, 1/255",
        ("way", "bytes on the GPU", "error: whole picture", "error: far quarter"),
        [(name, found.nbytes[name], error.mae, far[name]) for name, error in errors.items()],
    )
    picture = Picture("plane", plane(found), caption, "Dots on a receding plane by four methods and the truth")
    return Section("plane", "A pattern that recedes", (), (picture, table))


def _far(found: Receding) -> dict[str, float]:
    """Mean errors of the upper quarter of the picture."""
    rows = len(found.rendered.truth) // 4
    upper = {name: image[:rows] for name, image in found.rendered.images.items()}
    return {name: error.mae for name, error in Rendered(upper, found.rendered.truth[:rows]).errors.items()}


def _listed(errors: dict[str, float]) -> str:
    return "; ".join(f"{name} {error:.3g}" for name, error in errors.items())


def _several(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.4f}" for value in values) or "none"
