"""A stack of paths as a *program*: the operations that give its colour at any point.

Solids are composited as SVG defines it, source-over in sRGB, and groups of solids separately, so a stack of flat
colours becomes one solid. Gradients and pictures remain operations, in painting order. `KEEP` sets the colour so far
aside, and the matching `MIX` composites the group on it, or masks it by the group. A mask that holds one of them comes
after all that it masks.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MASKS, MOST_KEPT, MOST_PROGRAM, MOST_STOPS, PAINT_ONE
from vexture.drawing.group import Blend
from vexture.tree.planar.blend import blend_over, masking
from vexture.tree.planar.layers import PlanarLayers
from vexture.tree.planar.shades import COUNT, FOCUS, PICTURE, flat_shade, shade_over

ONE = float(PAINT_ONE)
"""Steps in which paints are stored. Colours are equal if they are equal in these steps."""

SOLID, SHADE, KEEP, MIX = range(4)
"""Codes of operations: paint a solid; paint a gradient or picture; begin a group; end a group."""

NORMAL = int(Blend.NORMAL)


class Operations(NamedTuple):
    """Operations in painting order, one in each row."""

    code: NDArray[np.int64]
    number: NDArray[
        np.int64
    ]  # a gradient's or picture's number; of `MIX` its blend mode or `MASKS` + mask, above 16 opacity bits
    rgba: NDArray[np.float64]  # (room, 4): premultiplied colours of solids


@kernel
def new_operations(layers: PlanarLayers, stack: NDArray[np.int32]) -> Operations:
    """Arrays with room for the operations of a stack."""
    room = len(stack) + 1
    for k in range(len(stack)):
        group = layers.group[stack[k]]
        room += 2 * (layers.depth[group] + 1) if group >= 0 else 0
    return Operations(np.zeros(room, np.int64), np.zeros(room, np.int64), np.zeros((room, 4)))


@kernel(allocates=False)
def _solid(ops: Operations, count: int, base: int, rgba: NDArray[np.float64], opacity: float) -> int:
    """Append a solid to a group that begins at operation `base`; return the new number of operations."""
    alpha = rgba[3] * opacity
    if alpha <= 0.0:
        return count
    if alpha >= 1.0:
        count = base
    if count == base or ops.code[count - 1] != SOLID:
        ops.code[count], ops.number[count] = SOLID, 0
        for c in range(4):
            ops.rgba[count, c] = 0.0
        count += 1
    blend_over(ops.rgba[count - 1], rgba, opacity, NORMAL)
    return count


@kernel(allocates=False)
def _blends(ops: Operations, start: int, count: int) -> bool:
    """Whether any of the operations blends with the colour below other than source-over, or masks it."""
    inside = 0
    for k in range(start, count):
        if ops.code[k] == KEEP:
            inside += 1
        elif ops.code[k] == MIX:
            inside -= 1
            if inside == 0 and ops.number[k] >> 16 != NORMAL:
                return True
    return False


@kernel(allocates=False)
def _reverse(ops: Operations, first: int, end: int) -> None:
    for k in range((end - first) // 2):
        low, high = first + k, end - 1 - k
        ops.code[low], ops.code[high] = ops.code[high], ops.code[low]
        ops.number[low], ops.number[high] = ops.number[high], ops.number[low]
        for c in range(4):
            ops.rgba[low, c], ops.rgba[high, c] = ops.rgba[high, c], ops.rgba[low, c]


@kernel(allocates=False)
def _swap(ops: Operations, first: int, second: int, end: int) -> None:
    """Let the operations first..second-1 and second..end-1 change places."""
    _reverse(ops, first, second)
    _reverse(ops, second, end)
    _reverse(ops, first, end)


@kernel(allocates=False)
def _end_group(ops: Operations, count: int, base: int, start: int, opacity: float, blend: int) -> int:
    """End the group of the `KEEP` at `start`, inside a group that begins at `base`; return the number of operations."""
    if count == start + 1:
        return start
    onto = start - base  # operations below it, in the group around it
    if count == start + 2 and ops.code[start + 1] == SOLID:
        rgba = ops.rgba[start + 1]
        if blend == NORMAL or onto == 0:
            return _solid(ops, start, base, rgba, opacity)
        if onto == 1 and ops.code[base] == SOLID:
            blend_over(ops.rgba[base], rgba, opacity, blend)
            return start
    if opacity == 1.0 and (onto == 0 or (blend == NORMAL and not _blends(ops, start + 1, count))):
        _swap(ops, start, start + 1, count)  # drops the `KEEP`, as source-over is associative
        return count - 1
    ops.code[count] = MIX
    ops.number[count] = ((blend if onto > 0 else NORMAL) << 16) | int(np.rint(ONE * opacity))
    return count + 1


@kernel(allocates=False)
def _is_in(layers: PlanarLayers, group: int, around: int) -> bool:
    """Whether a group, or -1 for none, is the group `around` or lies in it."""
    while group >= 0 and layers.depth[group] > layers.depth[around]:
        group = layers.outer[group]
    return group == around


@kernel(allocates=False)
def _leave(
    layers: PlanarLayers,
    ops: Operations,
    count: int,
    around: NDArray[np.int64],
    starts: NDArray[np.int64],
    mask_state: NDArray[np.float64],
    level: int,
) -> int:
    """End the innermost group, or let it mask the one around it; return the new number of operations.

    For each open group, `starts` holds the place of its `KEEP` and the start of what it paints, which is after its
    masks with gradients or pictures until the group ends. `mask_state` holds the share that its other masks leave, and
    the number of its masks that have not been met.
    """
    g, start, mask = around[level], starts[level, 0], layers.mask[around[level]]
    left = layers.opacity[g] * (mask_state[level, 0] if mask_state[level, 1] == 0.0 else 0.0)
    count = start + 1 if left == 0.0 or count == starts[level, 1] else count
    if count > start + 1:
        _swap(ops, start + 1, starts[level, 1], count)
    if mask == 0:
        return _end_group(ops, count, starts[level - 1, 1], start, left, layers.blend[g])
    mask_state[level - 1, 1] -= 1.0
    if count == start + 1 or (count == start + 2 and ops.code[start + 1] == SOLID):
        mask_state[level - 1, 0] *= left * masking(ops.rgba[start + 1], mask) if count > start + 1 else 0.0
        return start
    ops.code[count], ops.number[count] = MIX, (MASKS + mask) << 16 | int(np.rint(ONE * left))
    _swap(ops, starts[level - 1, 1], start, count + 1)
    starts[level - 1, 1] += count + 1 - start
    return count + 1


@kernel(allocates=False)
def _band(layers: PlanarLayers, stack: NDArray[np.int32], k: int) -> int:
    """Number of the gradient's band for a path in a stack: the count of the path's regions that follow it there."""
    after = k + 1
    while after < len(stack) and layers.cut[stack[after]] == stack[k]:
        after += 1
    return after - k - 1


@kernel
def compose(layers: PlanarLayers, stack: NDArray[np.int32], is_flat: bool, ops: Operations) -> int:
    """Write the operations of a stack of paths; return how many, or -1 if no paint can hold them.

    A stack of flat colours becomes one solid, or none. With `is_flat`, gradients and pictures
    count as solids of their mean colours.
    """
    deepest = 1
    for g in range(len(layers.depth)):
        deepest = max(deepest, layers.depth[g] + 2)
    around, starts, shown = np.empty(deepest, np.int64), np.empty((deepest, 2), np.int64), np.ones((deepest, 2))
    level, count, colour = 0, 0, np.empty(4)  # open groups, and operations
    starts[0, 0], starts[0, 1] = -1, 0
    for k in range(len(stack) + 1):
        if k < len(stack) and layers.cut[stack[k]] >= 0:
            continue
        group = layers.group[stack[k]] if k < len(stack) else -1
        while level > 0 and not _is_in(layers, group, around[level]):
            count = _leave(layers, ops, count, around, starts, shown, level)
            level -= 1
        if k == len(stack):
            break
        while level <= (layers.depth[group] if group >= 0 else -1):
            g = group
            while layers.depth[g] > level:
                g = layers.outer[g]
            level += 1
            around[level], shown[level, 0], shown[level, 1] = g, 1.0, layers.masked[g]
            ops.code[count], ops.number[count] = KEEP, 0
            starts[level, 0], starts[level, 1] = count, count + 1
            count += 1
        path = stack[k]
        if is_flat or layers.shade[path] < 0:
            count = _solid(ops, count, starts[level, 1], layers.rgba[path], 1.0)
            continue
        count = starts[level, 1] if layers.opaque[path] else count
        number = layers.bands[layers.shade[path] + _band(layers, stack, k)]
        if flat_shade(layers.shades, number, colour):
            count = _solid(ops, count, starts[level, 1], colour, 1.0)
            continue
        ops.code[count], ops.number[count] = SHADE, number
        count += 1
    return count if is_flat or _fits(layers, ops, count) else -1


@kernel(allocates=False)
def _fits(layers: PlanarLayers, ops: Operations, count: int) -> bool:
    """Whether a shader can run the operations: they, their stops and their nested groups must be few."""
    texels, stops, kept, most = 0, 0, 0, 0
    for k in range(count):
        texels += 1
        if ops.code[k] == SHADE:
            row = layers.shades.rows[ops.number[k]]
            texels += 2 if row[FOCUS] >= 0.0 or row[FOCUS] == PICTURE else 0
            stops += int(row[COUNT])
        elif ops.code[k] == KEEP:
            kept += 1
            most = max(most, kept)
        elif ops.code[k] == MIX:
            kept -= 1
    return texels <= MOST_PROGRAM and stops <= MOST_STOPS and most <= MOST_KEPT


@kernel(allocates=False)
def key_of_operations(ops: Operations, count: int) -> int:
    """Hash of the operations, with colours in steps of 1/65535; 0 only for no operation or one solid."""
    if count == 0 or (count == 1 and ops.code[0] == SOLID):
        return 0
    key = count
    for k in range(count):
        word = ops.number[k]
        for c in range(4):
            word = (word << 16) ^ int(np.rint(ONE * ops.rgba[k, c])) if ops.code[k] == SOLID else word
        for part in (ops.code[k], word):
            key = (key ^ part) * 0x5851F42D4C957F2D  # multiplier of Knuth's MMIX
            key ^= key >> 29
    return key if key != 0 else 1


@kernel(allocates=False)
def colour_at(
    layers: PlanarLayers,
    ops: Operations,
    count: int,
    middle: tuple[float, float],
    size: tuple[float, float],
    work: NDArray[np.float64],
    out: NDArray[np.float64],
) -> None:
    """Write the premultiplied colour (4,) of operations in the middle of a box of the unit square.

    A picture has its mean over the box; with a size of (0, 0) it is the colour at the point. `work` is scratch, (room,
    4).
    """
    level = 0
    for c in range(4):
        work[0, c] = 0.0
    for k in range(count):
        code = ops.code[k]
        if code == SOLID:
            blend_over(work[level], ops.rgba[k], 1.0, NORMAL)
        elif code == SHADE:
            shade_over(layers.shades, ops.number[k], middle, size, out)
            blend_over(work[level], out, 1.0, NORMAL)
        elif code == KEEP:
            level += 1
            for c in range(4):
                work[level, c] = 0.0
        else:
            level -= 1
            opacity, how = (ops.number[k] & PAINT_ONE) / ONE, ops.number[k] >> 16
            if how < MASKS:
                blend_over(work[level], work[level + 1], opacity, how)
            else:
                left = opacity * masking(work[level + 1], how - MASKS)
                for c in range(4):
                    work[level, c] *= left
    for c in range(4):
        out[c] = work[0, c]
