"""Faces for the exact renderer: the paths that cover a point, and their composited colour.

A *face* is the set of points that lie inside the same paths. Its colour is composited from the paints of these paths as
SVG and CSS define. Each path is drawn over the lower paths of its group. A group is composited by itself on a
transparent background, then laid on the content below it. A face of flat paints has one colour; if a gradient, a
picture or a blur is visible, the colour varies from point to point.

A sweep meets the same faces in slab after slab. Each path has a random number of 64 bits. The exclusive or of the
numbers of the paths inside names the face, and recent faces are cached by their names.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Sampling
from vexture.renderers.blend import lay
from vexture.renderers.gaussians import Render, blurred_spline
from vexture.renderers.ramps import Ramps, shade
from vexture.renderers.samples import Samples, sample
from vexture.renderers.smooth import Spline, Splines, shade_spline

KEPT: Final = 2**16
"""Size of the cache of faces, a power of two; 3.7 MB."""

MEMBERS: Final = 2**20
"""Size of the cache of the paths of faces with gradients; 8 MB."""

RUN: Final = 64
"""Paths per run: a new face searches only the runs in which a path is inside."""

FLAT: Final = -1
"""Start of a face without gradients and pictures."""


class PathStack(NamedTuple):
    """The paths of a drawing, from the lowest up, and their groups, as arrays."""

    evenodd: NDArray[np.bool_]  # (paths,)
    paints: NDArray[np.float64]  # (paths, 4): premultiplied
    shades: NDArray[np.int64]  # (paths,): the ramp of each, after all ramps the picture, then the spline, or -1
    covering: NDArray[np.bool_]  # (paths,): does it hide all below
    groups: NDArray[np.int64]  # (paths,): `Path.group`
    names: NDArray[np.int64]  # (paths,): random numbers
    outer: NDArray[np.int64]  # (groups,): `Group.outer`; the next three are members of `Group`, too
    opacities: NDArray[np.float64]  # (groups,)
    blends: NDArray[np.int64]  # (groups,)
    masks: NDArray[np.int64]  # (groups,)
    masked: NDArray[np.int64]  # (groups,): number of masks of a group
    ramps: Ramps
    samples: Samples
    splines: Splines
    is_linear: bool  # are colours of faces in linear light
    has_corners: bool  # may blend modes bend the colour of smooth paints sharply

    @classmethod
    def of_drawing(
        cls, drawing: Drawing, view: NDArray[np.float64], size: tuple[int, int], render: Render, is_linear: bool
    ) -> "PathStack":
        """Stack of a drawing in an image; `view` is the (3, 3) matrix from pixel coordinates to the unit square.

        `render` is the exact renderer, for the sources of blurs.
        """
        paths, groups, bits = drawing.paths, drawing.groups, np.iinfo(np.int64)
        paints = np.array([(*path.paint.color, 1.0) for path in paths], np.float64)
        kinds = np.array([kind_of(path.paint) for path in paths])
        gradients = [path.paint.gradient for path in paths if path.paint.gradient is not None]
        pictures = [path.paint.picture for path in paths if path.paint.picture is not None and is_sampled(path.paint)]
        splines = splines_of([path.paint for path in paths], view, size, render)
        shades, before = np.full(len(paths), -1), 0
        for kind, count in enumerate((len(gradients), len(pictures), len(splines))):
            shades[kinds == kind] = before + np.arange(count)
            before += count
        return cls(
            np.array([path.fill_rule == FillRule.EVENODD for path in paths]),
            paints * np.array([[path.paint.opacity] for path in paths]),
            shades,
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
            Ramps.of_gradients(gradients, view),
            Samples.of_pictures(pictures, view),
            Splines.of_paints(splines, view),
            is_linear,
            any(group.blend != Blend.NORMAL for group in groups),
        )


def is_sampled(paint: Paint) -> bool:
    """Return whether a paint is a picture with seams between its pixels."""
    return paint.picture is not None and paint.picture.sampling <= Sampling.LINEAR


def kind_of(paint: Paint) -> int:
    """Return the kind of a paint: 0 for a ramp, 1 for a picture, 2 for a spline; -1 for a flat colour."""
    if paint.gradient is not None:
        return 0
    return -1 if not paint.is_varied else 1 if is_sampled(paint) else 2


def splines_of(paints: list[Paint], view: NDArray[np.float64], size: tuple[int, int], render: Render) -> list[Spline]:
    """Return the splines of some paints; blurs of one source in one place share a grid."""
    found, blurs = list[Spline](), dict[tuple[object, ...], Spline]()
    for paint in paints:
        blur = paint.blur
        if blur is not None:
            key = id(blur.source), blur.to_source, blur.deviations, blur.window, blur.has_colors, blur.is_linear
            if key not in blurs:
                blurs[key] = blurred_spline(blur, view, size, render)
            found.append(blurs[key].with_paint(paint.color, paint.opacity, blur.is_inverted))
        elif paint.picture is not None and not is_sampled(paint):
            found.append(Spline.of_picture(paint.picture))
    return found


class SweepFaces(NamedTuple):
    """State of a sweep from left to right, and the cached faces."""

    winding: NDArray[np.int64]  # (paths,)
    inside: NDArray[np.int64]  # (paths/RUN,): number of paths inside, of each run
    left: NDArray[np.float64]  # (4,): colour on the left of a chord
    names: NDArray[np.int64]  # (KEPT,): indexed by its last bits; initially 0, the name of the empty face
    colours: NDArray[np.float64]  # (KEPT, 4): premultiplied; 0 for a face of varying colour
    starts: NDArray[np.int64]  # (KEPT,): start of a face's paths among the members, or FLAT
    ends: NDArray[np.int64]  # (KEPT,): end of the face's paths
    members: NDArray[np.int64]  # (MEMBERS + paths,): visible paths of each face, from the lowest up
    used: NDArray[np.int64]  # (1,): number of members in use
    levels: NDArray[np.float64]  # (groups + 2, 4): colours so far of the drawing and its groups; a paint's colour
    shown: NDArray[np.float64]  # (groups,): factor that a group's masks leave of it
    missing: NDArray[np.int64]  # (groups,): number of its masks that have not been met

    @classmethod
    def at_start(cls, stack: PathStack) -> "SweepFaces":
        """Start a sweep without faces."""
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
    """Find the index of the face of all paths that are inside; composite it unless it is cached.

    If its members do not fit, they are written behind the cached ones, where the next such face overwrites them.
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
    """Clear the cache if more than half of the members are in use."""
    if faces.used[0] > MEMBERS // 2:
        faces.names[:] = 0
        faces.colours[0] = 0.0
        faces.starts[0] = FLAT
        faces.used[0] = 0


@kernel(allocates=False)
def gather(stack: PathStack, faces: SweepFaces, start: int) -> int:
    """Append the paths that are inside to the members, from the topmost that hides all below; return the new end."""
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
    """Composite the colour of a face's members, from the lowest up, at a point of the image."""
    levels, paint = faces.levels, faces.levels[len(faces.levels) - 1]
    levels[0, :] = 0.0
    group = -1
    for path in faces.members[start:end]:
        change_group(group, stack.groups[path], stack, faces)
        group = stack.groups[path]
        if stack.shades[path] >= 0:
            shade_point(stack, stack.shades[path], x, y, paint)
            lay(paint, 1.0, Blend.NORMAL, levels[group + 1])
        else:
            lay(stack.paints[path], 1.0, Blend.NORMAL, levels[group + 1])
    change_group(group, -1, stack, faces)
    for channel in range(4):
        colour[channel] = levels[0, channel]
    if stack.is_linear:
        decode(colour)


@kernel(allocates=False)
def decode(colour: NDArray[np.float64]) -> None:
    """Convert a premultiplied colour from sRGB to linear light, in place."""
    opacity = colour[3]
    for channel in range(3):
        encoded = min(colour[channel] / opacity, 1.0) if opacity > 0.0 else 0.0
        linear = encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4
        colour[channel] = opacity * linear


@kernel(allocates=False)
def shade_point(stack: PathStack, k: int, x: float, y: float, colour: NDArray[np.float64]) -> None:
    """Write the premultiplied colour of a varying paint, numbered as in `PathStack.shades`, at a point."""
    ramps, samples = len(stack.ramps.radial), len(stack.samples.starts)
    if k < ramps:
        shade(stack.ramps, k, x, y, colour)
    elif k < ramps + samples:
        sample(stack.samples, k - ramps, x, y, colour)
    else:
        shade_spline(stack.splines, k - ramps - samples, x, y, colour)


@kernel(allocates=False)
def change_group(inner: int, target: int, stack: PathStack, faces: SweepFaces) -> None:
    """Go from one group to another: end some groups, and begin others as transparent.

    A group's index is larger than that of its outer group, so the larger of two indices is not around the other.
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
    """Lay a group on its outer group, or mask the outer group with it; a mask without content hides all."""
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
