"""Programs: the paints of faces with visible gradients or pictures."""

from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MASKS, PAINT_ONE
from vexture.drawing.group import Blend, Mask
from vexture.tree.growth import longer
from vexture.tree.planar.compose import KEEP, SHADE, SOLID
from vexture.tree.planar.faces import operations_of
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.shades import Shade, Shades, shade_of


class Solid(NamedTuple):
    """Paint a colour over the colour so far."""

    rgba: tuple[int, int, int, int]  # premultiplied, in steps of 1/65535


class Keep(NamedTuple):
    """Begin a group: set the colour so far aside, and start from nothing."""


class Mix(NamedTuple):
    """End a group: composite it on the colour that was set aside, or mask that colour by it."""

    opacity: int  # in steps of 1/65535
    how: Blend | Mask


Operation: TypeAlias = Solid | Shade | Keep | Mix
"""A step of a program; a gradient or picture is painted over the colour so far."""

Program: TypeAlias = tuple[Operation, ...]


class ProgramTable(NamedTuple):
    """The programs of a map as arrays: program k has the operations starts[k]..starts[k + 1]-1."""

    paint: NDArray[np.int64]  # (programs,): paint that it is, in rising order
    starts: NDArray[np.int64]  # (programs + 1,)
    code: NDArray[np.int64]  # (operations,), and their other columns, as in `Operations`
    number: NDArray[np.int64]
    rgba: NDArray[np.float64]  # (operations, 4)


@kernel
def programs_of(
    layers: PlanarLayers, starts: NDArray[np.int64], members: NDArray[np.int32]
) -> tuple[ProgramTable, int]:
    """Programs of the stacks that need one, and the number of stacks that had to be flattened.

    Stack k is `members[starts[k] : starts[k + 1]]`, and its number is its paint's.
    """
    paints, end, flattened = 0, 0, 0
    paint, begin = np.zeros(0, np.int64), np.zeros(1, np.int64)
    code, number, rgba = np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 4))
    for place in range(len(starts) - 1):
        stack = members[starts[place] : starts[place + 1]]
        if not _has_shade(layers, stack):
            continue
        count, ops, is_flat = operations_of(layers, stack)
        flattened += is_flat
        if not _is_program(ops.code, count):
            continue
        paint, begin = longer(paint, paints + 1), longer(begin, paints + 2)
        code, number, rgba = longer(code, end + count), longer(number, end + count), longer(rgba, end + count)
        for k in range(count):
            code[end + k], number[end + k] = ops.code[k], ops.number[k]
            for c in range(4):
                rgba[end + k, c] = ops.rgba[k, c]
        paint[paints], begin[paints + 1] = place, end + count
        paints, end = paints + 1, end + count
    return ProgramTable(paint[:paints], begin[: paints + 1], code[:end], number[:end], rgba[:end]), flattened


@kernel(allocates=False)
def _has_shade(layers: PlanarLayers, stack: NDArray[np.int32]) -> bool:
    """Whether any path of a stack has a gradient or picture."""
    for k in range(len(stack)):
        if layers.shade[stack[k]] >= 0:
            return True
    return False


@kernel(allocates=False)
def _is_program(code: NDArray[np.int64], count: int) -> bool:
    """Whether operations are more than one colour."""
    for k in range(count):
        if code[k] != SOLID:
            return True
    return False


def list_programs(table: ProgramTable, shades: Shades) -> dict[int, Program]:
    """Programs of paints, by the paints' numbers."""
    return {
        paint: tuple(_operation(table, k, shades) for k in range(start, end))
        for paint, (start, end) in zip(table.paint.tolist(), pairwise(table.starts.tolist()), strict=True)
    }


def _operation(table: ProgramTable, k: int, shades: Shades) -> Operation:
    code, number = int(table.code[k]), int(table.number[k])
    if code == SOLID:
        red, green, blue, alpha = np.rint(PAINT_ONE * table.rgba[k].clip(0.0, 1.0)).astype(int).tolist()
        return Solid((red, green, blue, alpha))
    if code == SHADE:
        return shade_of(shades, number)
    return Keep() if code == KEEP else Mix(number & PAINT_ONE, ending_of(number >> 16))


def ending_of(number: int) -> Blend | Mask:
    """Blend or mask that ends a group, by its number in a program."""
    return Blend(number) if number < MASKS else Mask(number - MASKS)


def number_of_ending(ending: Blend | Mask) -> int:
    """Number of a blend or mask in a program."""
    return MASKS + ending if isinstance(ending, Mask) else int(ending)
