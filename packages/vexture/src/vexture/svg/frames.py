"""The frame of a drawing: what its outermost element sets, or else what is painted."""

from math import ceil, floor, log10
from typing import Final, TypeAlias

import numpy as np

from vexture.base.errors import SourceError
from vexture.bezier.bounds import bounds
from vexture.drawing.drawing import Path
from vexture.drawing.group import Group
from vexture.svg.report import Report
from vexture.svg.scene import SvgScene
from vexture.svg.spatial import TRANSFORMS
from vexture.svg.transform import Identity, Transform
from vexture.svg.values import Viewport, is_relative
from vexture.svg.viewport import ANONYMOUS, THINNEST, Rectangle

Size: TypeAlias = tuple[float, float]

Bounds: TypeAlias = tuple[float, float, float, float]
"""Least x, least y, largest x and largest y."""

LITTLE: Final = 0.5
"""A drawing that is less wide and less high than this part of its frame fills a small part of it."""

ROUNDING: Final = 1e-9
"""Part of a frame's longer side by which rounding may move what touches the frame's sides."""

Frame: TypeAlias = tuple[Size, Viewport, Transform]
"""Size of a drawing in pixels, the root's viewport, and the map from user units to pixels."""

EMPTY: Final[Frame] = (0.0, 0.0), Viewport(0.0, 0.0), Identity
"""Frame that shows nothing."""


def frame(scene: SvgScene) -> Frame:
    """Frame that the outermost element sets; `EMPTY`, with a note, if a side is zero."""
    root, style = scene.root, scene.style
    box = scene.view(root)
    absolute = Viewport(0.0, 0.0, style.font_size)
    sides = []
    for name in ("width", "height"):
        text = style[name]
        relative = text.lower() == "auto" or is_relative(text)
        sides.append(None if relative else absolute.length(text, 0.0, style.font_size))
    width, height = sides
    if any(side is not None and side < THINNEST for side in (*sides, *(box or ())[2:])):
        scene.report.remark("its width or height is zero, at which nothing is shown")
        return EMPTY
    if box is not None:
        ratio = box[2] / box[3]
        if width is None and height is None:
            width, height = box[2:]
        size = (width or (height or 0.0) * ratio, height or (width or 0.0) / ratio)
        return size, viewport_of(scene, box[2:], size), scene.fit(root, box, *size)
    given = width is not None, height is not None
    size = (width or ANONYMOUS[0], height or ANONYMOUS[1])
    if not all(given):
        scene.report.remark(
            missing_size_note(scene, size, {(True, False): "height", (False, True): "width"}.get(given, "size"))
        )
    return size, viewport_of(scene, size), Identity


def painted_frame(scene: SvgScene) -> Frame:
    """Frame around what is painted, with a note; `EMPTY` if nothing is."""
    viewport = viewport_of(scene, ANONYMOUS)
    box = painted_box(scene, viewport)
    if box is None:
        return EMPTY
    x, y, width, height = round_box(box)
    told = "it has no viewBox and no size; its frame is what it paints"
    scene.report.remark(f'{told}, viewBox="{view_box_text((x, y, width, height))}"')
    return (width, height), viewport, Identity.translate(-x, -y)


def viewport_of(scene: SvgScene, sides: Size, size: Size | None = None) -> Viewport:
    """Viewport of a size in user units; `size` is that in pixels, if it is another."""
    return Viewport(*sides, scene.style.font_size, size)


def painted_box(
    scene: SvgScene,
    viewport: Viewport,
    matrix: Transform = Identity,
    size: Size | None = None,
    *,
    is_whole: bool = False,
) -> Rectangle | None:
    """Bounding box of what is seen in a viewport, before the frame cuts it; None if that is nothing.

    `matrix` and `size` are as in `Scene.paint`. `is_whole` asks for the box of the whole document, of which a part may
    be chosen.
    """
    fonts, page = scene.typesetter.files, scene.cascade.page
    chosen = None if is_whole else scene.chosen
    silent = SvgScene(scene.root, Report(), scene.images, chosen, fonts=fonts, page=page)  # notes come later
    painted, groups = silent.paint(viewport, matrix, None, size)
    return visible_box(painted, groups)


def visible_box(paths: list[Path], groups: tuple[Group, ...]) -> Rectangle | None:
    """Bounding box of paths, each inside those that mask the groups around it; None if it is empty."""
    shown: list[list[Bounds | None]] = [[] for _ in range(len(groups) + 1)]  # in each group; the last is in none
    masks: list[list[Bounds | None]] = [[] for _ in range(len(groups) + 1)]
    for path in paths:
        if path.contours:
            shown[path.group].append(bounds(np.concatenate(path.contours)))
    for place in reversed(range(len(groups))):  # from the innermost one
        group = groups[place]
        (masks if group.mask else shown)[group.outer].append(visible_bounds(shown[place], masks[place]))
    box = visible_bounds(shown[-1], [])
    return None if box is None else (box[0], box[1], box[2] - box[0], box[3] - box[1])


def visible_bounds(parts: list[Bounds | None], masks: list[Bounds | None]) -> Bounds | None:
    """Box around some boxes, as far as it is in each of those of masks; None is an empty one."""
    boxes = [box for box in parts if box is not None]
    if not boxes or None in masks:
        return None
    left, low = np.min(boxes, axis=0)[:2]
    right, high = np.max(boxes, axis=0)[2:]
    for mask in masks:
        assert mask is not None
        left, low, right, high = max(left, mask[0]), max(low, mask[1]), min(right, mask[2]), min(high, mask[3])
    return (float(left), float(low), float(right), float(high)) if left <= right and low <= high else None


def round_box(box: Rectangle) -> Rectangle:
    """A box around another one in whole units, or of a small one in parts of ten.

    Examples
    --------
    >>> round_box((1.5, -2.25, 20.0, 20.0)), round_box((0.015, 0.0, 0.5, 0.25))
    ((1.0, -3.0, 21.0, 21.0), (0.01, 0.0, 0.51, 0.25))
    """
    x, y, width, height = box
    digits = max(0, 1 - floor(log10(max(width, height, THINNEST))))
    units = 10.0**digits
    left, top = floor(round(x * units, 6)), floor(round(y * units, 6))
    right, bottom = ceil(round((x + width) * units, 6)), ceil(round((y + height) * units, 6))
    wide, high = max(right - left, 1), max(bottom - top, 1)
    return left / units, top / units, wide / units, high / units


def view_box_text(box: Rectangle) -> str:
    """A box as `viewBox` has it."""
    return " ".join(f"{value:.10g}" for value in box)


def missing_size_note(scene: SvgScene, size: Size, lacking: str) -> str:
    """Message of a note about a drawing that lacks a size and a `viewBox`, and the `viewBox` that would fit it."""
    told = f"it has no viewBox and no {lacking}, and is {size[0]:g} x {size[1]:g}, as in browsers"
    box = painted_box(scene, viewport_of(scene, size), Identity, size, is_whole=True)
    if box is None or fits(box, size):
        return told
    if is_cut(box, size):
        wrong, gain = "which cuts it", "shows all"
    else:
        wrong, gain = "of which it fills a small part", "fills all of it"
    fitting = view_box_text(round_box(box))
    remedy = f' (with viewBox="{fitting}" it {gain})' if fits_with(scene, fitting) else ""
    return f"{told}, {wrong}{remedy}"


def is_cut(box: Rectangle, size: Size) -> bool:
    """Whether a box reaches beyond a frame."""
    left, top, right, bottom = box[0], box[1], box[0] + box[2], box[1] + box[3]
    spare = max(size) * ROUNDING
    return min(left, top) < -spare or right > size[0] + spare or bottom > size[1] + spare


def fits(box: Rectangle, size: Size) -> bool:
    """Whether a frame shows all of a box, which fills more than a small part of it."""
    return not is_cut(box, size) and (box[2] >= LITTLE * size[0] or box[3] >= LITTLE * size[1])


def fits_with(scene: SvgScene, box: str) -> bool:
    """Whether a drawing is known to fit the frame of a `viewBox`, to which percentages and media refer, too."""
    root = scene.root
    if not scene.style.own.keys().isdisjoint(TRANSFORMS):  # they move the frame itself, which cuts before that
        return False
    before = root.get("viewBox")
    root.set("viewBox", box)
    try:
        silent = SvgScene(root, Report(), scene.images, fonts=scene.typesetter.files, page=scene.cascade.page)
        size, viewport, matrix = frame(silent)
        found = painted_box(silent, viewport, matrix, size, is_whole=True)
        return found is not None and fits(found, size)
    except SourceError:  # it is too much there
        return False
    finally:
        if before is None:
            del root.attrib["viewBox"]
        else:
            root.set("viewBox", before)
