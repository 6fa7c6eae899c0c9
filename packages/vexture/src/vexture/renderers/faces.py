"""Faces, for the exact renderer: which paths are inside, and what colour they have together.

A *face* is where the same paths are inside. Its colour is theirs, composited as SVG and CSS say. Each path is drawn
over what is below it in its group; a group is composited by itself, on nothing, then laid on what is below it. A face
of flat paints has one colour; where a gradient is seen, it has one at each point.

A sweep meets the same faces in slab after slab. Each path has a random number of 64 bits, the numbers of the paths
inside together (by exclusive or) name the face, and the faces met last are kept under their names.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.group import Blend, Mask
from vexture.renderers.blend import lay
from vexture.renderers.ramps import Ramps, shade

KEPT: Final = 2**16
"""Faces that are kept, a power of two; 3.7 MB."""

MEMBERS: Final = 2**20
"""Paths that are kept of the faces with gradients; 8 MB."""

RUN: Final = 64
"""Paths that are counted together: a new face looks only into runs in which some path is inside."""

FLAT: Final = -1
"""Start of a face without gradients."""


class PathStack(NamedTuple):
    """The paths of a drawing from the lowest up, as arrays, and the groups around them."""

    evenodd: NDArray[np.bool_]  # (paths,)
    paints: NDArray[np.float64]  # (paths, 4): premultiplied
    shades: NDArray[np.int64]  # (paths,): the ramp of each, or -1
    covering: NDArray[np.bool_]  # (paths,): whether nothing below is seen
    groups: NDArray[np.int64]  # (paths,): of `Path`
    names: NDArray[np.int64]  # (paths,): random
    outer: NDArray[np.int64]  # (groups,): of `Group`, as the next two
    opacities: NDArray[np.float64]  # (groups,)
    blends: NDArray[np.int64]  # (groups,)
    masks: NDArray[np.int64]  # (groups,): of `Group`
    masked: NDArray[np.int64]  # (groups,): how many masks a group has
    ramps: Ramps

    @classmethod
    def of_drawing(cls, drawing: Drawing, view: NDArray[np.float64]) -> "PathStack":
        """The stack of a drawing in an image; the view is a (3, 3) matrix from pixel coordinates to the unit square."""
        paths, groups, bits = drawing.paths, drawing.groups, np.iinfo(np.int64)
        paints = np.array([(*path.paint.color, 1.0) for path in paths], np.float64)
        gradients = [path.paint.gradient for path in paths]
        shaded = np.array([gradient is not None for gradient in gradients])
        return cls(
            np.array([path.fill_rule == FillRule.EVENODD for path in paths]),
            paints * np.array([[path.paint.opacity] for path in paths]),
            np.where(shaded, np.cumsum(shaded) - 1, -1),
            np.array([path.paint.is_opaque and path.group == -1 for path in paths]),
            np.array([path.group for path in paths], np.int64),
            np.random.default_rng(0).integers(bits.min, bits.max, len(paths), endpoint=True),
            np.array([group.outer for group in groups], np.int64),
            np.array([group.opacity for group in groups], np.float64),
            np.array([group.blend for group in groups], np.int64),
            np.array([group.mask for group in groups], np.int64),
            np.array(
                [sum(mask.outer == place for mask in groups if mask.mask) for place in range(len(groups))], np.int64
            ),
            Ramps.of_gradients([gradient for gradient in gradients if gradient is not None], view),
        )


class SweepFaces(NamedTuple):
    """State of a sweep from left to right, and the faces that it has met."""

    winding: NDArray[np.int64]  # (paths,)
    inside: NDArray[np.int64]  # (paths/RUN,): how many of each run
    left: NDArray[np.float64]  # (4,): colour on the left of a chord
    names: NDArray[np.int64]  # (KEPT,): at the place that its last bits say; at first 0, where nothing is inside
    colours: NDArray[np.float64]  # (KEPT, 4): premultiplied; 0 of a face with gradients
    starts: NDArray[np.int64]  # (KEPT,): place of a face's paths among the members, or FLAT
    ends: NDArray[np.int64]  # (KEPT,): where they end
    members: NDArray[np.int64]  # (MEMBERS + paths,): those that are seen of each face, from the lowest up
    used: NDArray[np.int64]  # (1,): members
    levels: NDArray[np.float64]  # (groups + 2, 4): the drawing and its groups, as far as composited; one paint
    shown: NDArray[np.float64]  # (groups,): what is left of each by its masks
    missing: NDArray[np.int64]  # (groups,): its masks of which nothing was met

    @classmethod
    def at_start(cls, stack: PathStack) -> "SweepFaces":
        """Start a sweep, with no face so far."""
        paths = len(stack.names)
        return cls(
            np.zeros(paths, np.int64),
            np.zeros(-(-paths // RUN), np.int64),
            np.zeros(4),
            np.zeros(KEPT, np.int64),
            np.zeros((KEPT, 4)),
            np.full(KEPT, FLAT),
            np.zeros(KEPT, np.int64),
            np.zeros(MEMBERS + paths, np.int64),
            np.zeros(1, np.int64),
            np.zeros((len(stack.outer) + 2, 4)),
            np.ones(len(stack.outer)),
            np.zeros(len(stack.outer), np.int64),
        )


@kernel(allocates=False)
def find_face(name: int, stack: PathStack, faces: SweepFaces) -> int:
    """Place of the face of all paths that are inside, which is composited unless it is kept there.

    Members for which there is no more room are written behind the others, until the next such face.
    """
    place = name & (KEPT - 1)
    if faces.names[place] != name:
        start = int(min(faces.used[0], MEMBERS))
        end = gather(stack, faces, start)
        varies = False
        for path in faces.members[start:end]:
            varies = varies or stack.shades[path] >= 0
        faces.names[place] = name
        faces.starts[place] = start if varies else FLAT
        faces.ends[place] = end
        faces.colours[place] = 0.0
        if not varies:
            composite(stack, faces, start, end, 0.0, 0.0, faces.colours[place])
        elif end <= MEMBERS:
            faces.used[0] = end
        else:
            faces.names[place] = ~name
    return place


@kernel(allocates=False)
def forget(faces: SweepFaces) -> None:
    """Forget all faces, if more than half of the members are used."""
    if faces.used[0] > MEMBERS // 2:
        faces.names[:] = 0
        faces.colours[0] = 0.0
        faces.starts[0] = FLAT
        faces.used[0] = 0


@kernel(allocates=False)
def gather(stack: PathStack, faces: SweepFaces, start: int) -> int:
    """Write the paths that are inside among the members, from the highest that covers all; return where they end."""
    end = start
    for run in range(len(faces.inside)):
        if faces.inside[run] > 0:
            for path in range(run * RUN, min((run + 1) * RUN, len(stack.names))):
                winding = faces.winding[path]
                if (winding & 1 != 0) if stack.evenodd[path] else (winding != 0):
                    if stack.covering[path]:
                        end = start
                    faces.members[end] = path
                    end += 1
    return end


@kernel(allocates=False)
def composite(
    stack: PathStack, faces: SweepFaces, start: int, end: int, x: float, y: float, colour: NDArray[np.float64]
) -> None:
    """Write the colour of a face's members, from the lowest up, at a point of the image."""
    levels, paint = faces.levels, faces.levels[len(faces.levels) - 1]
    levels[0, :] = 0.0
    group = -1
    for path in faces.members[start:end]:
        change_group(group, stack.groups[path], stack, faces)
        group = stack.groups[path]
        if stack.shades[path] >= 0:
            shade(stack.ramps, stack.shades[path], x, y, paint)
            lay(paint, 1.0, Blend.NORMAL, levels[group + 1])
        else:
            lay(stack.paints[path], 1.0, Blend.NORMAL, levels[group + 1])
    change_group(group, -1, stack, faces)
    for channel in range(4):
        colour[channel] = levels[0, channel]


@kernel(allocates=False)
def change_group(inner: int, target: int, stack: PathStack, faces: SweepFaces) -> None:
    """Go from one group to another: end some, and begin others with nothing.

    A group stands after the one around it, so the later of two groups is not around the other.
    """
    while inner != target:
        if inner > target:
            end_group(inner, stack, faces)
            inner = stack.outer[inner]
        else:
            faces.levels[target + 1, :] = 0.0
            faces.shown[target] = 1.0
            faces.missing[target] = stack.masked[target]
            target = stack.outer[target]


@kernel(allocates=False)
def end_group(group: int, stack: PathStack, faces: SweepFaces) -> None:
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
