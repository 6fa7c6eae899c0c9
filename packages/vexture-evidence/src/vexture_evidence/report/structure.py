"""Figures 3.10 to 3.12, 4.13 and 4.16 of the thesis: the tree, its lists, its depths, its files."""

from typing import Any

import numpy as np

from vexture.base.errors import LimitError
from vexture.renderers.exact import render_exact
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.cells import subdivisions
from vexture_evidence.figures.lists import counts, hierarchy, lists
from vexture_evidence.figures.textures import count_text, textures
from vexture_evidence.measures.leaves import leaves, quads
from vexture_evidence.measures.metrics import LEVELS
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, file_bytes
from vexture_evidence.measures.thesis_numbers import STRUCTURE
from vexture_evidence.report.section import Material, Printed, PrintedPicture, Section, Table
from vexture_evidence.report.shapes import textures_of

AREA_SIDE = 500
"""Side of the exact picture whose mean is the drawing's area, in pixels; the mean is the same for any side."""


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
        f"This section shows how the drawing `{shape.name}` is stored. The unit square is divided into four cells, and "
        "each cell is divided again if it contains more than a leaf can hold. A texture holds two lists: the quads, of "
        "four cells each, and the curves of the leaves. An outline along the border of a cell needs no curve in the "
        "cell.",
    )
    table = _table(made, material.own, refused)
    trees = [_hierarchy(way, made, material.own) for way in ("sampled", "packed") if way in made]
    shown = next(way for way in ("direct", "packed") if way in made)
    items: list[Any] = [table, *trees, _lists(shape, shown, made[shown]), _depths(made), _files(shape, made)]
    return Section("structure", "The tree and its lists", text, items)


def _table(textures_by_way: dict[str, ThesisTexture | Texture], is_own: bool, refused: list[str]) -> Table:
    rows: list[list[Any]] = []
    if not is_own:
        share = 100 * STRUCTURE.cells / STRUCTURE.grid
        rows.append(["thesis, printed", *map(Printed, (*STRUCTURE, round(share, 2)))])
    for way in WAYS:
        if way in textures_by_way:
            found = counts(textures_by_way[way])
            rows.append([way, *found, 100.0 * found.cells / found.grid])
        else:
            rows.append([way, *[None] * 5])
    caption = (
        "Thesis 3.4. Cells of both lists, four for each quad and one for each curve, compared with the uniform grid of "
        "the smallest cells, which they replace. A tree without small cells replaces a coarser grid, and its share is "
        f"larger; compare the numbers of cells rather than the shares. {' '.join(refused)}"
    ).strip()
    head = ["way", "quads", "curves", "cells of both lists", "cells of the grid", "share, %"]
    return Table("cells", caption, head, rows)


def _hierarchy(way: str, textures_by_way: dict[str, ThesisTexture | Texture], is_own: bool) -> PrintedPicture:
    found = counts(textures_by_way[way])
    printed = ""
    if way == "sampled" and not is_own:
        printed = (
            f" The thesis's own duck: ⟦{STRUCTURE.quads} quads, {STRUCTURE.curves} curves, {STRUCTURE.cells} cells, "
            f"{STRUCTURE.cells / STRUCTURE.grid:.2%} of {STRUCTURE.grid:,}⟧."
        )
    caption = (
        f"Thesis 3.10, `{way}`. Left: the cells, with their curves. Right: the quads by depth; a grey cell refers to "
        f"the quad below it, and the other cells are leaves. {count_text(found.quads, 'quad')} and "
        f"{count_text(found.curves, 'curve')} make {found.cells:,} cells"
    )
    if way == "packed":
        caption += (
            ". A leaf holds several pieces here, so sharp corners and thin parts need no small cells. Horizontal "
            "lines that no leaf holds are dotted."
        )
    else:
        caption += f", {found.cells / found.grid:.2%} of the grid's {found.grid:,}.{printed}"
    return PrintedPicture(
        f"hierarchy-{way}", hierarchy(textures_by_way[way]), caption, "The cells of a drawing and the tree of its quads"
    )


def _lists(shape: ConvertedDrawing, way: str, texture: ThesisTexture | Texture) -> PrintedPicture:
    area = float(render_exact(shape.drawing, (AREA_SIDE, AREA_SIDE)).mean(dtype=np.float64))
    root = float(quads(shape.way(way).tree).coverage[0])
    caption = (
        f"Thesis 3.11 and 3.12, `{way}`. The two lists, by the depth of each entry, and the coverage of each entry in "
        "percent. A quad's coverage represents everything below the quad where it is smaller than a pixel (the thesis "
        "calls it the MIP value), and is the mean of its cells' coverage. The coverage of the first quad is "
        f"{100 * root:.3f}%. The drawing's exact area is {100 * area:.3f}%, which differs by "
        f"{LEVELS * abs(root - area):.2g}/255."
    )
    return PrintedPicture("lists", lists(texture), caption, "Quads and curves by depth, and how much of each is filled")


def _depths(textures_by_way: dict[str, ThesisTexture | Texture]) -> PrintedPicture:
    deepest = {way: int(leaves(texture).depth.max()) for way, texture in textures_by_way.items()}
    said = ", ".join(f"{depth} for `{way}`" for way, depth in deepest.items())
    caption = (
        f"Thesis 4.13. The depth of the cells; darker is deeper. The largest depths are {said}: the most steps that a "
        "shader takes to find a pixel's curves. If a leaf holds only one curve, the deepest cells are at corners."
    )
    return PrintedPicture(
        "depths", subdivisions(textures_by_way, shades="depth"), caption, "Cells of a drawing, coloured by depth"
    )


def _files(shape: ConvertedDrawing, textures_by_way: dict[str, ThesisTexture | Texture]) -> PrintedPicture:
    shown: dict[str, ThesisTexture | Texture] = {}
    note = ""
    if "direct" in textures_by_way:
        try:
            small = shape.way("direct", 8).texture
            shown[f"direct, 8 bits: {file_bytes(small):,} bytes"] = small
        except LimitError as error:
            note = f" 8 bits cannot hold it: {error}."
        shown[f"direct, 16 bits: {file_bytes(textures_by_way['direct']):,} bytes"] = textures_by_way["direct"]
    shown[f"packed: {file_bytes(textures_by_way['packed']):,} bytes"] = textures_by_way["packed"]
    caption = (
        "Thesis 4.16. The textures as images at one scale, turned by 90 degrees, so that each quad or curve is one "
        "column. The pixels of a pair are shown in their own colours. A texel of a packed texture is a column of four "
        "words: red is a word's low half, green its high half, and the words of quads have some blue." + note
    )
    return PrintedPicture("textures", textures(shown), caption, "Texels of the textures as coloured squares")
