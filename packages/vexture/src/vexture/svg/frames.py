"""The frame of a drawing, set by its outermost element or else by the painted content."""

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
"""Fraction of the frame's width and height below which a drawing counts as small."""

ROUNDING: Final = 1e-9
"""Tolerance for rounding at the frame's sides, as a fraction of its longer side."""

Frame: TypeAlias = tuple[Size, Viewport, Transform]
"""Size of a drawing in pixels, the root's viewport, and the map from user units to pixels."""

EMPTY: Final[Frame] = (0.0, 0.0), Viewport(0.0, 0.0), Identity
"""Frame of a drawing that shows nothing."""


def frame(scene: SvgScene) -> Frame:
    """Return the frame that the outermost element sets; `EMPTY`, with a note, if a side is zero."""
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
    """Return the frame around the painted content, with a note; `EMPTY` if there is none."""
    viewport = viewport_of(scene, ANONYMOUS)
    box = painted_box(scene, viewport)
    if box is None:
        return EMPTY
    x, y, width, height = round_box(box)
    message = "it has no viewBox and no size; its frame is what it paints"
    scene.report.remark(f'{message}, viewBox="{view_box_text((x, y, width, height))}"')
    return (width, height), viewport, Identity.translate(-x, -y)


def viewport_of(scene: SvgScene, sides: Size, size: Size | None = None) -> Viewport:
    """Return a viewport with sides in user units; `size` is its size in pixels, if that is different."""
    return Viewport(*sides, scene.style.font_size, size)


def painted_box(
    scene: SvgScene,
    viewport: Viewport,
    matrix: Transform = Identity,
    size: Size | None = None,
    *,
    is_whole: bool = False,
) -> Rectangle | None:
    """Return the bounding box of the visible content in a viewport, not cut by the frame; None if there is none.

    `matrix` and `size` are as in `Scene.paint`. With `is_whole` it is the box of the whole document, even if only a
    part is selected.
    """
    fonts, page = scene.typesetter.files, scene.cascade.page
    chosen = None if is_whole else scene.chosen
    silent = SvgScene(scene.root, Report(), scene.images, chosen, fonts=fonts, page=page)  # notes come later
    painted, groups = silent.paint(viewport, matrix, None, size)
    return visible_box(painted, groups)


def visible_box(paths: list[Path], groups: tuple[Group, ...]) -> Rectangle | None:
    """Return the bounding box of paths, each cut by the masks of the groups around it; None if it is empty."""
    parts: list[list[Bounds | None]] = [[] for _ in range(len(groups) + 1)]  # for each group; last: no group
    masks: list[list[Bounds | None]] = [[] for _ in range(len(groups) + 1)]
    for path in paths:
        if path.contours:
            parts[path.group].append(bounds(np.concatenate(path.contours)))
    for place in reversed(range(len(groups))):  # from the innermost one
        group = groups[place]
        (masks if group.mask else parts)[group.outer].append(visible_bounds(parts[place], masks[place]))
    box = visible_bounds(parts[-1], [])
    return None if box is None else (box[0], box[1], box[2] - box[0], box[3] - box[1])


def visible_bounds(parts: list[Bounds | None], masks: list[Bounds | None]) -> Bounds | None:
    """Return the box around some boxes, cut by each box of masks; None is an empty box."""
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
    """Round a box outwards to whole units, or a small one to tenths.

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
    """Format a box as a `viewBox`."""
    return " ".join(f"{value:.10g}" for value in box)


def missing_size_note(scene: SvgScene, size: Size, lacking: str) -> str:
    """Return the message of a note on a drawing without size and `viewBox`, with a `viewBox` that fits it."""
    message = f"it has no viewBox and no {lacking}, and is {size[0]:g} x {size[1]:g}, as in browsers"
    box = painted_box(scene, viewport_of(scene, size), Identity, size, is_whole=True)
    if box is None or fits(box, size):
        return message
    if is_cut(box, size):
        wrong, gain = "which cuts it", "shows all"
    else:
        wrong, gain = "of which it fills a small part", "fills all of it"
    fitting = view_box_text(round_box(box))
    remedy = f' (with viewBox="{fitting}" it {gain})' if fits_with(scene, fitting) else ""
    return f"{message}, {wrong}{remedy}"


def is_cut(box: Rectangle, size: Size) -> bool:
    """Return whether a box extends beyond a frame."""
    left, top, right, bottom = box[0], box[1], box[0] + box[2], box[1] + box[3]
    spare = max(size) * ROUNDING
    return min(left, top) < -spare or right > size[0] + spare or bottom > size[1] + spare


def fits(box: Rectangle, size: Size) -> bool:
    """Return whether a frame contains a box, and the box is not too small in it."""
    return not is_cut(box, size) and (box[2] >= LITTLE * size[0] or box[3] >= LITTLE * size[1])


def fits_with(scene: SvgScene, box: str) -> bool:
    """Return whether a drawing certainly fits the frame of a `viewBox`, which also affects percentages and media."""
    root = scene.root
    if not scene.style.own.keys().isdisjoint(TRANSFORMS):  # they move the frame itself, which cuts first
        return False
    before = root.get("viewBox")
    root.set("viewBox", box)
    try:
        silent = SvgScene(root, Report(), scene.images, fonts=scene.typesetter.files, page=scene.cascade.page)
        size, viewport, matrix = frame(silent)
        found = painted_box(silent, viewport, matrix, size, is_whole=True)
        return found is not None and fits(found, size)
    except SourceError:  # too complex with that frame
        return False
    finally:
        if before is None:
            del root.attrib["viewBox"]
        else:
            root.set("viewBox", before)
