"""New colours for the elements of planar maps: a new table of paints and new means for the same tree."""

import difflib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.base.kernels import kernel
from vexture.base.layout import (
    CELL_BITS,
    COUNT_SHIFT,
    COVERAGE_ONE,
    IS_MEAN,
    LATTICE,
    PAINT_ONE,
    QUAD_FLAG,
)
from vexture.bezier.area import integral_x_dy
from vexture.drawing.paint import Paint
from vexture.texture.curves import read_leaf_curve, texels_of_cell
from vexture.texture.map_texels import write_paints
from vexture.texture.numbers import means_place, read_base, read_sides
from vexture.texture.pick import style_of_root
from vexture.texture.planar import head_of, paints_from
from vexture.texture.root import Root
from vexture.tree.planar.faces import composite_stacks
from vexture.tree.planar.source import group_arrays
from vexture.tree.planar.style import PlanarStyle, round_colours

Colour: TypeAlias = str | Sequence[float] | Paint | None
"""A CSS colour, three or four components in 0..1, a flat paint, or None for full transparency."""

NOTHING: Final = (0.0, 0.0, 0.0, 0.0)
MOST_NEAR: Final = 5
"""Most names that a message proposes."""

BYTE = (1 << CELL_BITS) - 1


def restyle_texels(
    flat: NDArray[np.uint32],
    roots: tuple[Root, ...],
    places: Sequence[int],
    colours: Mapping[str, Colour],
    texture: str,
) -> tuple[NDArray[np.uint32], tuple[Root, ...]]:
    """Recolour elements in some of the shapes; return new texels and roots. Errors as in `Texture.with_paints`."""
    rgba = checked_colours(roots, places, colours, texture)
    names = {name: k for k, name in enumerate(colours)}
    texels, new = flat.copy(), list(roots)
    for place in places:
        style = style_of_root(roots[place])
        styled = _replace_colours(style, names, rgba)
        changed = (styled != style.rgba).any(axis=1)
        if not changed.any():
            continue
        restyle = replace(style, rgba=styled)
        _repaint(texels, roots[place].quad, restyle, changed)
        for k, root in enumerate(roots):
            if root.is_map and root.quad == roots[place].quad:
                new[k] = replace(root, style=restyle)
    return texels, tuple(new)


def checked_colours(
    roots: Sequence[Root], places: Sequence[int], colours: Mapping[str, Colour], texture: str
) -> NDArray[np.float64]:
    """Check new colours for elements of some shapes; return components (n, 4). Errors as in `Texture.with_paints`."""
    if not isinstance(colours, Mapping) or not all(isinstance(name, str) for name in colours):
        raise ParameterError("the colours are no mapping of elements' names, such as {'sun': 'red'}")
    names = {name: k for k, name in enumerate(colours)}
    rgba = round_colours([components(name, colour) for name, colour in colours.items()])
    styles = [style_of_root(roots[place]) for place in places]
    _check_names(names, {name for style in styles for name in style.names} - {""}, texture)
    for style in styles:
        styled = _replace_colours(style, names, rgba)
        faded = (styled != style.rgba).any(axis=1) & style.hides & (styled[:, 3] < 1.0)
        if faded.any():
            k = int(faded.argmax())
            raise ParameterError(
                f"{style.names[k]!r} gets the opacity {styled[k, 3]:g}, but the texture does not have what it hides; "
                "make it opaque, or convert the drawing with that colour"
            )
    return rgba


def _replace_colours(style: PlanarStyle, names: Mapping[str, int], rgba: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colour components of all elements of a style, with new colours for some of them."""
    which = np.array([names.get(name, -1) for name in style.names], np.int64)
    styled = style.rgba.copy()
    styled[which >= 0] = rgba[which[which >= 0]]
    return styled


def components(name: str, colour: Any) -> tuple[float, ...]:
    """Red, green, blue and opacity, in 0..1, of a colour from the user."""
    if isinstance(colour, str) and colour.strip().lower() != "none":
        from vexture.drawing.colors import Color, parse_color  # late: only texts need CSS

        parsed = parse_color(colour)
        if isinstance(parsed, Color):
            return (*parsed.rgb, parsed.alpha)
    elif colour is None or isinstance(colour, str):
        return NOTHING
    elif isinstance(colour, Paint):
        if not colour.is_varied:
            return (*colour.color, colour.opacity)
    elif isinstance(colour, Sequence | np.ndarray) and len(colour) in (3, 4):
        with suppress(TypeError, ValueError):
            parts = tuple(float(part) for part in (*colour, 1.0)[:4])
            if all(0.0 <= part <= 1.0 for part in parts):
                return parts
    raise ParameterError(
        f"the colour of {name!r} is {str(colour)[:60]!r}; "
        "give a CSS colour of sRGB, three or four numbers in 0..1, or None"
    )


def _check_names(names: Mapping[str, int], known: set[str], texture: str) -> None:
    """Raise a `ParameterError` for a name that no element has; propose similar names."""
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=MOST_NEAR) or sorted(known)[:MOST_NEAR]
            listed = ", ".join(map(repr, near)) or "none, as the drawing names no element"
            raise ParameterError(f"{texture}: no element {name!r}; near names are {listed}; there are {len(known)}")


def _repaint(flat: NDArray[np.uint32], quad: int, style: PlanarStyle, changed: NDArray[np.bool_]) -> None:
    """Write the colours of all paints that contain a changed element, and all means."""
    head = head_of(flat, quad)
    groups = group_arrays(style.groups)
    colours = composite_stacks(style.rgba, style.group, *groups, style.starts, style.members)
    times = np.append(0, np.cumsum(changed[style.members]))
    anew = times[style.starts[1:]] > times[style.starts[:-1]]
    table = paints_from(flat[head.paint_texels], head.used)
    table[anew] = np.rint(PAINT_ONE * np.clip(colours[anew], 0.0, 1.0))
    write_paints(table, flat[head.paint_texels])
    renew_means(flat, quad, head.cells, table / PAINT_ONE)


@kernel
def _count_quads(flat: NDArray[np.uint32], root: int) -> int:
    """Count the quads of a map; they are consecutive, and each precedes its children."""
    quad, stop = root, root + 1
    while quad < stop:
        below = 0
        for k in range(4):
            below += 1 if int(flat[quad, 2]) >> CELL_BITS * k & BYTE == QUAD_FLAG else 0
        if below > 0:
            stop = max(stop, int(flat[quad, 0]) + below)
        quad += 1
    return stop - root


@kernel
def _set_leaf_mean(
    flat: NDArray[np.uint32],
    base: int,
    cell: int,
    first: tuple[int, int],
    root: int,
    table: NDArray[np.float64],
    curve: NDArray[np.float64],
    mean: NDArray[np.float64],
) -> None:
    """Write the mean colour (4,) of a leaf (FORMAT.md, D.8); `curve` is scratch.

    `cell` is the leaf's byte; `first` holds the texel and the number of its first curve.
    """
    for c in range(4):
        mean[c] = table[base, c]
    for i in range(cell >> COUNT_SHIFT):
        read_leaf_curve(flat, first[0], cell, i, curve)
        area = (curve[0, 1] - curve[3, 1]) / LATTICE + integral_x_dy(curve) / LATTICE**2
        area += 1.0 - curve[0, 1] / LATTICE if curve[0, 0] == 0.0 else 0.0
        area -= 1.0 - curve[3, 1] / LATTICE if curve[3, 0] == 0.0 else 0.0
        left, right = read_sides(flat, root, first[1] + i)
        for c in range(4):
            mean[c] += area * (table[left, c] - table[right, c])


@kernel
def renew_means(flat: NDArray[np.uint32], root: int, cells: int, table: NDArray[np.float64]) -> None:
    """Write the mean of each cell of a valid map from a table of paints; leaves with only a mean keep it.

    `cells` is the index of the first texel of cells, from the map's head.
    """
    quads, curve = _count_quads(flat, root), np.empty((4, 2))
    means = np.empty((quads, 4, 4))
    for place in range(quads - 1, -1, -1):
        below, at = int(flat[root + place, 0]) - root, int(flat[root + place, 1])
        number = int(flat[root + place, 3])
        here = cells + means_place(flat, root, root + place)
        for k in range(4):
            cell, mean = int(flat[root + place, 2]) >> CELL_BITS * k & BYTE, means[place, k]
            if cell == QUAD_FLAG:
                for c in range(4):
                    mean[c] = 0.25 * (means[below, 0, c] + means[below, 1, c] + means[below, 2, c] + means[below, 3, c])
                below += 1
            elif cell == IS_MEAN:
                for c in range(4):
                    mean[c] = (int(flat[here, k]) >> CELL_BITS * c & BYTE) / COVERAGE_ONE
            else:
                base = read_base(flat, root, root + place, k)
                _set_leaf_mean(flat, base, cell, (at, number), root, table, curve, mean)
                at += texels_of_cell(cell)
                number += cell >> COUNT_SHIFT
            word, alpha = 0, min(max(mean[3], 0.0), 1.0)
            for c in range(4):
                word |= int(np.rint(COVERAGE_ONE * min(max(mean[c], 0.0), alpha))) << CELL_BITS * c
            flat[here, k] = word
