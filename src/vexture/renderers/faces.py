"""Colours of faces, for the exact renderer.

A *face* is where the same paths are inside, and so has one colour: theirs, composited as SVG and CSS say. Each path is
drawn over what is below it in its group; a group is composited by itself, on nothing, then laid on what is below it.

A sweep meets the same faces in slab after slab. Each path has a random number of 64 bits, the numbers of the paths
inside together (by exclusive or) name the face, and the colours of the faces met last are kept under their names.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing, FillRule
from vexture.group import Blend, Mask
from vexture.kernels import kernel
from vexture.renderers.blend import lay
from vexture.renderers.slabs import Sweep, add_edge, cross

__all__ = ["Faces", "Stack", "colour_slab"]

KEPT: Final = 2**16
"""Faces whose colours are kept, a power of two; 2.6 MB."""

RUN: Final = 64
"""Paths that are counted together: a new face looks only into runs in which some path is inside."""


class Stack(NamedTuple):
    """The paths of a drawing from the lowest up, as arrays, and the groups around them."""

    evenodd: NDArray[np.bool_]  # (paths,)
    paints: NDArray[np.float64]  # (paths, 4): premultiplied
    groups: NDArray[np.int64]  # (paths,): of `Path`
    names: NDArray[np.int64]  # (paths,): random
    outer: NDArray[np.int64]  # (groups,): of `Group`, as the next two
    opacities: NDArray[np.float64]  # (groups,)
    blends: NDArray[np.int64]  # (groups,)
    masks: NDArray[np.int64]  # (groups,): of `Group`
    masked: NDArray[np.int64]  # (groups,): how many masks a group has

    @classmethod
    def of(cls, drawing: Drawing) -> "Stack":
        """The stack of a drawing."""
        paths, groups, bits = drawing.paths, drawing.groups, np.iinfo(np.int64)
        paints = np.array([(*path.paint.color, 1.0) for path in paths], np.float64)
        return cls(
            np.array([path.fill_rule == FillRule.EVENODD for path in paths]),
            paints * np.array([[path.paint.opacity] for path in paths]),
            np.array([path.group for path in paths], np.int64),
            np.random.default_rng(0).integers(bits.min, bits.max, len(paths), endpoint=True),
            np.array([group.outer for group in groups], np.int64),
            np.array([group.opacity for group in groups], np.float64),
            np.array([group.blend for group in groups], np.int64),
            np.array([group.mask for group in groups], np.int64),
            np.array(
                [sum(mask.outer == place for mask in groups if mask.mask) for place in range(len(groups))], np.int64
            ),
        )


class Faces(NamedTuple):
    """Where a sweep is, from left to right, and the colours of the faces that it met."""

    winding: NDArray[np.int64]  # (paths,)
    inside: NDArray[np.int64]  # (paths/RUN,): how many of each run
    left: NDArray[np.float64]  # (4,): colour on the left of a chord
    names: NDArray[np.int64]  # (KEPT,): at the place that its last bits say; at first 0, where nothing is inside
    colours: NDArray[np.float64]  # (KEPT, 4): premultiplied
    levels: NDArray[np.float64]  # (groups + 1, 4): the drawing and each of its groups, as far as composited
    shown: NDArray[np.float64]  # (groups,): what is left of each by its masks
    missing: NDArray[np.int64]  # (groups,): its masks of which nothing was met

    @classmethod
    def of(cls, stack: Stack) -> "Faces":
        """None so far."""
        paths = len(stack.names)
        return cls(
            np.zeros(paths, np.int64),
            np.zeros(-(-paths // RUN), np.int64),
            np.zeros(4),
            np.zeros(KEPT, np.int64),
            np.zeros((KEPT, 4)),
            np.zeros((len(stack.outer) + 1, 4)),
            np.ones(len(stack.outer)),
            np.zeros(len(stack.outer), np.int64),
        )


@kernel(allocates=False)
def colour_slab(
    sweep: Sweep,
    owners: NDArray[np.int32],
    height: float,
    stack: Stack,
    faces: Faces,
    change: NDArray[np.float64],
) -> None:
    """Add the chords of a slab at which the colour changes, by as much as it changes; `change` is (width + 2, 4)."""
    active, left = sweep.active[: sweep.counts[0]], faces.left
    name = 0
    left[:] = 0.0
    for k in range(len(active)):
        owner = owners[active[k]]
        path = abs(owner) - 1
        step = cross(owner, faces.winding, stack.evenodd)
        if step != 0:
            faces.inside[path // RUN] += step
            name ^= stack.names[path]
            place = find_face(name, stack, faces)
            right = faces.colours[place]
            jump = right[0] - left[0], right[1] - left[1], right[2] - left[2], right[3] - left[3]
            if jump != (0.0, 0.0, 0.0, 0.0):
                add_edge(sweep.highs[k], sweep.lows[k], height, jump, change)
                for channel in range(4):
                    left[channel] = right[channel]
    for chord in active:
        path = abs(owners[chord]) - 1
        faces.winding[path] = 0
        faces.inside[path // RUN] = 0


@kernel(allocates=False)
def find_face(name: int, stack: Stack, faces: Faces) -> int:
    """Place of a face's colour, which is composited unless it is kept there."""
    place = name & (KEPT - 1)
    if faces.names[place] != name:
        faces.names[place] = name
        composite(stack, faces, faces.colours[place])
    return place


@kernel(allocates=False)
def composite(stack: Stack, faces: Faces, colour: NDArray[np.float64]) -> None:
    """Write the colour of all paths that are inside, from the lowest up."""
    levels = faces.levels
    levels[0, :] = 0.0
    group = -1
    for run in range(len(faces.inside)):
        if faces.inside[run] > 0:
            for path in range(run * RUN, min((run + 1) * RUN, len(stack.names))):
                winding = faces.winding[path]
                if (winding & 1 != 0) if stack.evenodd[path] else (winding != 0):
                    change_group(group, stack.groups[path], stack, faces)
                    group = stack.groups[path]
                    lay(stack.paints[path], 1.0, Blend.NORMAL, levels[group + 1])
    change_group(group, -1, stack, faces)
    for channel in range(4):
        colour[channel] = levels[0, channel]


@kernel(allocates=False)
def change_group(inner: int, wanted: int, stack: Stack, faces: Faces) -> None:
    """Go from one group to another: end some, and begin others with nothing.

    A group stands after the one around it, so the later of two groups is not around the other.
    """
    while inner != wanted:
        if inner > wanted:
            end_group(inner, stack, faces)
            inner = stack.outer[inner]
        else:
            faces.levels[wanted + 1, :] = 0.0
            faces.shown[wanted] = 1.0
            faces.missing[wanted] = stack.masked[wanted]
            wanted = stack.outer[wanted]


@kernel(allocates=False)
def end_group(group: int, stack: Stack, faces: Faces) -> None:
    """Lay a group on the one around it, or let it mask that. Of a mask where nothing is, nothing is left to be seen."""
    outer, colour = stack.outer[group], faces.levels[group + 1]
    left = faces.shown[group] * stack.opacities[group] if faces.missing[group] == 0 else 0.0
    if stack.masks[group] == Mask.NONE:
        lay(colour, left, stack.blends[group], faces.levels[outer + 1])
        return
    if stack.masks[group] == Mask.LUMINANCE:
        left *= 0.2125 * colour[0] + 0.7154 * colour[1] + 0.0721 * colour[2]
    else:
        left *= colour[3]
    faces.shown[outer] *= left
    faces.missing[outer] -= 1
