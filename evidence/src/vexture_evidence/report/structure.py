"""Figures 3.10 to 3.12, 4.13 and 4.16: the tree, its lists, its depths, its files."""

from typing import Any

import numpy as np

from vexture.errors import LimitError
from vexture.renderers.exact import render_exact
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.cells import subdivisions
from vexture_evidence.figures.lists import counts, hierarchy, lists
from vexture_evidence.figures.textures import number, textures
from vexture_evidence.measures.leaves import leaves, quads
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.printed import STRUCTURE
from vexture_evidence.measures.shape import WAYS, Shape, file_bytes
from vexture_evidence.report.section import Material, Picture, Printed, Section, Table
from vexture_evidence.report.shapes import textures_of

__all__ = ["section"]

AREA_SIDE = 500
"""Pixels of the exact picture whose mean is a drawing's area, whatever its size."""


def section(material: Material) -> Section:
    """Show how one drawing is stored.

    Examples
    --------
    >>> [item.name for item in section(Material([])).items][:2]
    ['cells', 'hierarchy-sampled']
    """
    shape = material.main
    made, refused = textures_of(shape)
    text = (
        f"How the drawing `{shape.name}` is stored. The unit square is divided into four cells, and each of these "
        "again where it holds more than a leaf can say. A texture holds the quads, four cells each, and the curves "
        "of the leaves, as two lists. An outline along the border of a cell needs no curve in it.",
    )
    table = _table(made, material.own, refused)
    trees = [_hierarchy(way, made, material.own) for way in ("sampled", "packed") if way in made]
    shown = next(way for way in ("direct", "packed") if way in made)
    items: list[Any] = [table, *trees, _lists(shape, shown, made[shown]), _depths(made), _files(shape, made)]
    return Section("structure", "The tree and its lists", text, items)


def _table(made: dict[str, ThesisTexture | Texture], own: bool, refused: list[str]) -> Table:
    rows: list[list[Any]] = []
    if not own:
        share = 100 * STRUCTURE.cells / STRUCTURE.grid
        rows.append(["thesis, printed", *map(Printed, (*STRUCTURE, round(share, 2)))])
    for way in WAYS:
        if way in made:
            found = counts(made[way])
            rows.append([way, *found, 100.0 * found.cells / found.grid])
        else:
            rows.append([way, *[None] * 5])
    caption = (
        "Thesis 3.4. Cells of both lists, four for each quad and one for each curve, against the regular grid of the "
        "smallest cells that they replace. A tree that needs no small cells replaces a coarser grid, so compare the "
        f"numbers of cells: the share says more of deep trees. {' '.join(refused)}"
    ).strip()
    head = ["way", "quads", "curves", "cells of both lists", "cells of the grid", "share, %"]
    return Table("cells", caption, head, rows)


def _hierarchy(way: str, made: dict[str, ThesisTexture | Texture], own: bool) -> Picture:
    found = counts(made[way])
    printed = ""
    if way == "sampled" and not own:
        printed = (
            f" The thesis's own duck: ⟦{STRUCTURE.quads} quads, {STRUCTURE.curves} curves, {STRUCTURE.cells} cells, "
            f"{STRUCTURE.cells / STRUCTURE.grid:.2%} of {STRUCTURE.grid:,}⟧."
        )
    caption = (
        f"Thesis 3.10, `{way}`. Left: the cells, with their curves. Right: the quads by depth; a gray cell refers to "
        f"the quad below, the others are leaves. {number(found.quads, 'quad')} and {number(found.curves, 'curve')} "
        f"are {found.cells:,} cells"
    )
    if way == "packed":
        caption += (
            ": a leaf holds several pieces here, so sharp corners and thin parts need no small cells. Horizontal "
            "lines that no leaf holds are dotted."
        )
    else:
        caption += f", {found.cells / found.grid:.2%} of the grid's {found.grid:,}.{printed}"
    return Picture(
        f"hierarchy-{way}", hierarchy(made[way]), caption, "The cells of a drawing and the tree of its quads"
    )


def _lists(shape: Shape, way: str, texture: ThesisTexture | Texture) -> Picture:
    area = float(render_exact(shape.drawing, (AREA_SIDE, AREA_SIDE)).mean(dtype=np.float64))
    root = float(quads(shape.way(way).tree).coverage[0])
    caption = (
        f"Thesis 3.11 and 3.12, `{way}`. The two lists, level with the depth that each entry comes from, and the "
        "percentage of each that is filled, which stands for all below it where that is smaller than a pixel (the "
        f"thesis calls it MIP value). A quad's is the mean of its cells': the first says {100 * root:.3f}%, and the "
        f"drawing's exact area is {100 * area:.3f}%, {LEVELS * abs(root - area):.2g}/255 from it."
    )
    return Picture("lists", lists(texture), caption, "Quads and curves by depth, and how much of each is filled")


def _depths(made: dict[str, ThesisTexture | Texture]) -> Picture:
    deepest = {way: int(leaves(texture).depth.max()) for way, texture in made.items()}
    said = ", ".join(f"{depth} for `{way}`" for way, depth in deepest.items())
    caption = (
        f"Thesis 4.13. How deep the tree is, the darker the deeper: {said}. A shader takes so many steps at most to "
        "find a pixel's curves. Depth gathers at corners where a leaf holds one curve only."
    )
    return Picture("depths", subdivisions(made, shades="depth"), caption, "Cells of a drawing, coloured by depth")


def _files(shape: Shape, made: dict[str, ThesisTexture | Texture]) -> Picture:
    shown: dict[str, ThesisTexture | Texture] = {}
    note = ""
    if "direct" in made:
        try:
            small = shape.way("direct", 8).texture
            shown[f"direct, 8 bits: {file_bytes(small):,} bytes"] = small
        except LimitError as error:
            note = f" 8 bits cannot hold it: {error}."
        shown[f"direct, 16 bits: {file_bytes(made['direct']):,} bytes"] = made["direct"]
    shown[f"packed: {file_bytes(made['packed']):,} bytes"] = made["packed"]
    caption = (
        "Thesis 4.16. The textures as images, turned by 90 degrees: one column for each quad or curve, and at one "
        "scale. The pixels of a pair are shown in their own colours. A texel of a packed texture is four words: red "
        "is a word's low half, green its high half, and quads have some blue." + note
    )
    return Picture("textures", textures(shown), caption, "Texels of the textures as coloured squares")
