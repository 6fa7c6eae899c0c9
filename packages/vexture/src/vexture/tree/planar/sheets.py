"""Cutting a drawing of many layers into sheets, each a planar map, which are drawn over one another.

The texels of a planar map grow with the square of the number of outlines that cross or run beside one another: 800
concentric translucent discs need a million, while their layers need ten thousand. So a map has a budget. A drawing that
exceeds it is cut into sheets of consecutive layers. A sheet has as many layers as their share of the budget allows.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final, NamedTuple, Unpack

from vexture.base.layout import MOST_KEPT
from vexture.base.notes import Note
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend
from vexture.drawing.paint import Paint
from vexture.tree.bounds import TreeParameters
from vexture.tree.build import build_tree
from vexture.tree.planar.blurs import with_splines
from vexture.tree.planar.build import build_map
from vexture.tree.planar.map import PlanarMap
from vexture.tree.tree import Tree

FLATTENED: Final = (
    f"gradients by their mean colours: too many on one another, or in more than {MOST_KEPT} groups in one another"
)
"""Note about flattened faces of planar maps."""

SEVERAL: Final = "so many crossing shapes are {} maps on one another; what is below shows through where they touch"
"""Note about several sheets."""

LEAST_BUDGET: Final = 1 << 17
"""Texels that any drawing may have, two megabytes. A coat of arms in a flag needs one megabyte, and is exact only as
one sheet."""

BUDGET: Final = 2
"""Texels of all sheets for each cubic and path, about twice as many as the drawing's layers need."""

SPARED: Final = 8
"""A sheet may leave 1/8 of its texels unused, because finding the most layers that fit would take twice as long."""

STEPS: Final = 4
"""Numbers of layers that are tried between one number and its double."""


class Sheet(NamedTuple):
    """Consecutive paths of a drawing and their map, or one layer and its tree."""

    drawing: Drawing
    tree: PlanarMap | Tree

    @property
    def paint(self) -> Paint | None:
        """Paint of a layer; None for a map."""
        return self.drawing.paths[0].paint if isinstance(self.tree, Tree) else None

    def with_name(self, name: str, number: int) -> "Sheet":
        """Return the sheet with a name like those of a drawing's layers."""
        what = "faces" if self.paint is None else self.paint.hex
        return Sheet(replace(self.drawing, name=f"{name}/{number}-{what}"), self.tree)


def sheets_of(drawing: Drawing, restyle: bool = False, **parameters: Unpack[TreeParameters]) -> list[Sheet]:
    """Sheets of a drawing, the lowest first: one, unless its map needs too many texels.

    A drawing that is one layer of one colour needs no map, unless it is to be restyled. `parameters` and errors are
    those of `build_map`. A `precision` does not affect the cutting: the texels that it adds grow with the length of
    outlines, as those of layers do, not with their crossings.
    """
    drawing = with_splines(drawing)
    precision = parameters.pop("precision", None)
    sheets = _within_budget(drawing, restyle, **parameters)
    if precision is None:
        return sheets
    parameters["precision"] = precision
    return [Sheet(one.drawing, _rebuild_sheet(one, restyle, **parameters)) for one in sheets]


def _rebuild_sheet(sheet: Sheet, restyle: bool, **parameters: Unpack[TreeParameters]) -> PlanarMap | Tree:
    """Build the map or tree of a sheet again, with other parameters."""
    if isinstance(sheet.tree, Tree):
        return build_tree(sheet.drawing, **parameters)
    planar = build_map(sheet.drawing, restyle=restyle, **parameters)
    assert planar is not None
    return planar


def _within_budget(drawing: Drawing, restyle: bool, **parameters: Unpack[TreeParameters]) -> list[Sheet]:
    """Sheets of a drawing, each within its share of the budget."""
    layers = () if restyle or drawing.is_coloured else drawing.layers()
    if len(layers) == 1:
        return [Sheet(layers[0], build_tree(layers[0], **parameters))]
    budget = max(BUDGET * (drawing.segments + len(drawing.paths)), LEAST_BUDGET)
    whole = build_map(drawing, most_texels=budget, restyle=restyle, **parameters)
    if whole is not None:
        return [Sheet(drawing, whole)]
    items = _items(drawing)

    def try_sheet(first: int, last: int) -> Sheet | None:
        part = _part(drawing, items[first:last], len(items))
        is_layer = last == first + 1 and len(items[first]) == 1 and part.paths[0].group < 0 and _is_flat(part.paths)
        if is_layer and not restyle:
            return Sheet(part, build_tree(part, **parameters))
        share = budget * (last - first) // len(items) if last > first + 1 else None
        planar = build_map(part, most_texels=share, restyle=restyle, **parameters)
        return None if planar is None else Sheet(part, planar)

    found = _greedy(len(items), budget / len(items), try_sheet)
    return [sheet.with_name(drawing.name, number) for number, sheet in enumerate(found, 1)]


def _is_flat(paths: Sequence[Path]) -> bool:
    """Whether no path has a gradient or picture."""
    return not any(path.paint.is_varied for path in paths)


def notes_of_sheets(sheets: Sequence[Sheet]) -> tuple[Note, ...]:
    """Notes about faces with mean colours instead of gradients, and about several sheets."""
    count = sum(sheet.tree.flattened for sheet in sheets if isinstance(sheet.tree, PlanarMap))
    notes = [Note("simplified", FLATTENED, count)] if count else []
    if len(sheets) > 1:
        notes.append(Note("simplified", SEVERAL.format(len(sheets))))
    return tuple(notes)


def _greedy(count: int, share: float, tried: Callable[[int, int], Sheet | None]) -> list[Sheet]:
    """Sheets of `count` items, each with about as many items as fit.

    A sheet fills at least 7/8 of its share, or has no room for one more step of items. `tried` makes a sheet of the
    items first..last-1, or returns None if they need too many texels; it always makes a sheet of a single item. `share`
    is the number of texels for one item. The search begins at the number of items in the sheet below, with steps that
    double until they pass the goal, and then halve.
    """
    sheets: list[Sheet] = []
    first = below = 0
    while first < count:
        sizes = _sizes(count - first)
        fitting, failing, at, step = -1, len(sizes), min(below, len(sizes) - 1), 1
        best: Sheet | None = None
        while failing - fitting > 1:
            made = tried(first, first + sizes[at])
            if made is None:
                failing = at
            else:
                best, fitting = made, at
                if SPARED * made.tree.texels >= (SPARED - 1) * share * sizes[at]:
                    break
            if fitting >= 0 and failing < len(sizes):
                at = (fitting + failing) // 2
            else:
                at = min(max(at + (step if made else -step), 0), len(sizes) - 1)
                step *= 2
        assert best is not None
        sheets.append(best)
        first, below = first + sizes[fitting], fitting
    return sheets


def _sizes(most: int) -> list[int]:
    """Numbers of items that are tried, up to `most`.

    Examples
    --------
    >>> _sizes(13)
    [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 13]
    """
    sizes, step = [*range(1, 2 * STEPS)], 2
    while sizes[-1] < most:
        sizes += [step * (STEPS + k) for k in range(STEPS)]
        step *= 2
    return [size for size in sizes if size < most] + [most]


def _items(drawing: Drawing) -> list[list[Path]]:
    """Paths of a drawing in runs that cannot be cut: an outermost group, and all paths below if it blends with them."""
    items: list[list[Path]] = []
    before = -1
    for path in drawing.paths:
        around = drawing.around(path.group)
        outermost = around[0] if around else -1
        if outermost >= 0 and outermost == before:
            items[-1].append(path)
        elif outermost >= 0 and drawing.groups[outermost].blend is not Blend.NORMAL:
            items = [[*(below for item in items for below in item), path]]
        else:
            items.append([path])
        before = outermost
    return items


def _part(drawing: Drawing, items: Sequence[list[Path]], count: int) -> Drawing:
    """Drawing of some of its items; the drawing itself if they are all."""
    return replace(drawing, paths=tuple(path for item in items for path in item)) if len(items) < count else drawing
