"""Programs: the paints of faces with visible gradients."""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import MASKS, PAINT_ONE
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Gradient
from vexture.tree.planar.compose import KEEP, SHADE, SOLID, Operations
from vexture.tree.planar.faces import operations_of
from vexture.tree.planar.layers import PlanarLayers


class Solid(NamedTuple):
    """Paint a colour over the colour so far."""

    rgba: tuple[int, int, int, int]  # premultiplied, in steps of 1/65535


class Keep(NamedTuple):
    """Begin a group: set the colour so far aside, and start from nothing."""


class Mix(NamedTuple):
    """End a group: composite it on the colour that was set aside, or mask that colour by it."""

    opacity: int  # in steps of 1/65535
    how: Blend | Mask


Operation: TypeAlias = Solid | Gradient | Keep | Mix
"""A step of a program; a gradient is painted over the colour so far."""

Program: TypeAlias = tuple[Operation, ...]


def programs_of(
    gradients: Sequence[Gradient], layers: PlanarLayers, stacks: Sequence[NDArray[np.int32]]
) -> tuple[dict[int, Program], int]:
    """Programs of the stacks that need one, by their places, and the number of stacks that had to be flattened."""
    programs: dict[int, Program] = {}
    flattened = 0
    for place, stack in enumerate(stacks if gradients else ()):
        if (layers.shade[stack] >= 0).any():
            count, ops, is_flat = operations_of(layers, stack)
            ops, flattened = Operations(*ops), flattened + is_flat
            if (ops.code[:count] != SOLID).any():
                programs[place] = tuple(_operation(ops, k, gradients) for k in range(count))
    return programs, flattened


def _operation(ops: Operations, k: int, gradients: Sequence[Gradient]) -> Operation:
    code, number = int(ops.code[k]), int(ops.number[k])
    if code == SOLID:
        red, green, blue, alpha = np.rint(PAINT_ONE * ops.rgba[k].clip(0.0, 1.0)).astype(int).tolist()
        return Solid((red, green, blue, alpha))
    if code == SHADE:
        return gradients[number]
    return Keep() if code == KEEP else Mix(number & PAINT_ONE, ending_of(number >> 16))


def ending_of(number: int) -> Blend | Mask:
    """Blend or mask that ends a group, by its number in a program."""
    return Blend(number) if number < MASKS else Mask(number - MASKS)


def number_of_ending(ending: Blend | Mask) -> int:
    """Number of a blend or mask in a program."""
    return MASKS + ending if isinstance(ending, Mask) else int(ending)
