"""Content of filters, which their steps read and produce: small drawings in the user units of an element, y down."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Final

import numpy as np

from vexture.bezier.bounds import bounds
from vexture.bezier.clip import clip_contour
from vexture.drawing.drawing import Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Color, Paint
from vexture.svg.compositing import MOST_BOXES, Box, masking, meet
from vexture.svg.gradients import rows
from vexture.svg.outline import ShapeOutline
from vexture.svg.transform import Identity, Transform, map_points

MOST_PATHS: Final = 10_000
"""Most paths of the content of one step."""

SLIVER: Final = 1e-3
"""Largest part of a content, in user units, that a region does not cut: files round their regions to this."""

SLIVER_SHARE: Final = 1e-4
"""The same as a share of the region's smaller side, if that is less."""

PLAIN: Final = frozenset({Blend.NORMAL, Blend.PLUS_LIGHTER})
"""Blend modes that mix colours without changing them."""


class FilterLimitError(Exception):
    """A filter that cannot be drawn; the message says why."""


class InexactError(FilterLimitError):
    """A step that has no exact form for its inputs; it can be sampled."""


@dataclass(frozen=True, eq=False)
class FilterContent:
    """Paths and groups, as those of a drawing."""

    paths: tuple[Path, ...] = ()
    groups: tuple[Group, ...] = ()

    @cached_property
    def visible(self) -> list[Path]:
        """Paths that are no part of a mask and not fully transparent."""
        masks = masking(self.groups)
        return [
            path
            for path in self.paths
            if path.contours and path.paint.opacity > 0.0 and not (path.group >= 0 and masks[path.group])
        ]

    @cached_property
    def boxes(self) -> list[Box]:
        """Boxes of the visible paths: left, top, right and bottom."""
        return [box_of(path) for path in self.visible]

    @cached_property
    def box(self) -> Box | None:
        """Box around everything visible; None if nothing is."""
        boxes = self.boxes
        if not boxes:
            return None
        (left, top), (right, bottom) = np.min(boxes, axis=0)[:2].tolist(), np.max(boxes, axis=0)[2:].tolist()
        return left, top, right, bottom

    @cached_property
    def overlaps(self) -> bool:
        """True if two visible paths may overlap."""
        boxes = self.boxes
        return len(boxes) > MOST_BOXES or any(meet(a, b) for a, b in combinations(boxes, 2))

    @property
    def is_plain(self) -> bool:
        """True if no blend mode mixes colours to others."""
        return all(group.blend in PLAIN for group in self.groups)

    @property
    def is_opaque(self) -> bool:
        """True if everything visible is opaque."""
        return all(path.paint.is_opaque for path in self.visible) and all(
            group.opacity >= 1.0 and not group.mask for group in self.groups
        )

    @property
    def color(self) -> Color | None:
        """The only colour; None if there are several, or none."""
        if not self.is_plain:
            return None
        colors = {color for path in self.visible for color in colors_of(path.paint)}
        return colors.pop() if len(colors) == 1 else None

    @property
    def only_path(self) -> Path | None:
        """The path, if there is only one, and no group."""
        return self.paths[0] if len(self.paths) == 1 and not self.groups else None

    def move(self, matrix: Transform) -> "FilterContent":
        """Return the content after an affine map."""
        if matrix == Identity:
            return self
        inverse = rows(matrix.inverse())
        moved = (
            replace(
                path,
                contours=tuple(map_points(contour, matrix) for contour in path.contours),
                paint=path.paint.after(inverse),
            )
            for path in self.paths
        )
        return FilterContent(tuple(moved), self.groups)

    def cut(self, region: Box | None) -> "FilterContent":
        """Return the part inside a region; None is everything."""
        box = self.box
        if region is None or box is None:
            return self if box is not None else FilterContent()
        spare = min(SLIVER, SLIVER_SHARE * max(min(region[2] - region[0], region[3] - region[1]), 0.0))
        near = [abs(side - edge) <= spare for side, edge in zip(box, region, strict=True)]
        low = [min(box[k], region[k]) if near[k] else region[k] for k in (0, 1)]
        high = [max(box[k], region[k]) if near[k] else region[k] for k in (2, 3)]
        if box[0] >= low[0] and box[1] >= low[1] and box[2] <= high[0] and box[3] <= high[1]:
            return self
        return self.cut_to(low, high)

    def cut_to(self, low: list[float], high: list[float]) -> "FilterContent":
        """Return the part between two corners."""
        found = []
        if low[0] < high[0] and low[1] < high[1]:
            for path in self.paths:
                least, most = path.box
                if (least >= low).all() and (most <= high).all():
                    found.append(path)
                    continue
                parts = (clip_contour(contour, (low[0], low[1]), (high[0], high[1])) for contour in path.contours)
                contours = tuple(part for part in parts if len(part))
                if contours:
                    found.append(replace(path, contours=contours))
        return FilterContent(tuple(found), self.groups) if found else FilterContent()

    def with_paints(self, change: Callable[[Path], Paint | None], element: str | None = None) -> "FilterContent":
        """Return the content with other paints of all paths outside masks; None as a paint drops the path.

        They get the name `element`, if there is one.
        """
        masks, found = masking(self.groups), []
        for path in self.paths:
            if path.group >= 0 and masks[path.group]:
                found.append(path)
                continue
            paint = change(path)
            if paint is not None:
                found.append(replace(path, paint=paint, element=path.element if element is None else element))
        return FilterContent(tuple(found), self.groups)

    def fade(self, opacity: float) -> "FilterContent":
        """Return the content with an opacity."""
        if opacity <= 0.0:
            return FilterContent()
        if opacity >= 1.0:
            return self
        outside = all(group.outer < 0 for group in self.groups if group.opacity < 1.0)
        if self.is_plain and outside and not self.overlaps:
            return self.with_paints(lambda path: path.paint.fade(opacity))
        return self.inside(Group(opacity=opacity))

    def inside(self, group: Group) -> "FilterContent":
        """Return the content in a group."""
        return FilterContent(*put_inside(self, group, 0))

    @property
    def in_isolation(self) -> "FilterContent":
        """The content in a group, if it has blend modes that would also affect what is below."""
        if all(group.blend is Blend.NORMAL or group.outer >= 0 for group in self.groups):
            return self
        return self.inside(Group())

    def masked_by(self, mask: "FilterContent", kind: Mask) -> "FilterContent":
        """Return the content, masked."""
        if not self.visible:
            return FilterContent()
        masks, inner = put_inside(mask, Group(0, mask=kind), 1)
        shown, groups = shift_groups(self, 1 + len(inner), 0)
        return FilterContent((*masks, *shown), (Group(), *inner, *groups))


def check_count(paths: int) -> None:
    """Raise a `FilterLimitError` if a content has too many paths."""
    if paths > MOST_PATHS:
        raise FilterLimitError(f"a step has {paths:,} paths or more; the limit is {MOST_PATHS:,}")


def box_of(path: Path) -> Box:
    """Return the bounding box of a path with contours."""
    return bounds(np.concatenate(path.contours))


def shift_groups(content: FilterContent, count: int, outer: int) -> tuple[tuple[Path, ...], tuple[Group, ...]]:
    """Renumber groups after `count` others; what is in none is then in the group `outer`."""
    paths = tuple(
        replace(path, group=path.group + count if path.group >= 0 else outer) if count or outer != path.group else path
        for path in content.paths
    )
    groups = tuple(replace(group, outer=group.outer + count if group.outer >= 0 else outer) for group in content.groups)
    return paths, groups


def put_inside(content: FilterContent, group: Group, count: int) -> tuple[tuple[Path, ...], tuple[Group, ...]]:
    """Put content into a group that comes after `count` others."""
    paths, groups = shift_groups(content, count + 1, count)
    return paths, (group, *groups)


def stack(contents: Iterable[FilterContent]) -> FilterContent:
    """Return contents painted on one another, from the lowest."""
    return join(content.in_isolation for content in contents)


def blend_group(upper: FilterContent, lower: FilterContent, mode: Blend) -> FilterContent:
    """Return a content blended onto another one."""
    return join([lower.in_isolation, upper.inside(Group(blend=mode))]).inside(Group())


def join(contents: Iterable[FilterContent]) -> FilterContent:
    """Return contents after one another."""
    paths: list[Path] = []
    groups: list[Group] = []
    for content in contents:
        check_count(len(paths) + len(content.paths))
        more, inner = shift_groups(content, len(groups), -1)
        paths += more
        groups += inner
    return FilterContent(tuple(paths), tuple(groups))


def flood(box: Box, paint: Paint, element: str = "") -> FilterContent:
    """Return a filled rectangle."""
    left, top, right, bottom = box
    if paint.opacity <= 0.0 or not (left < right and top < bottom):
        return FilterContent()
    outline = ShapeOutline.rectangle(left, top, right - left, bottom - top)
    return FilterContent((Path((outline.loop,), paint=paint, element=element),))


def is_rectangle(path: Path) -> bool:
    """Return whether a path is an upright rectangle."""
    if len(path.contours) != 1 or len(path.contours[0]) != 4:
        return False
    ends = path.contours[0][:, 0]
    upright = np.ptp(path.contours[0], axis=1).min(axis=1) == 0.0
    corners = {(x, y) for x in set(ends[:, 0].tolist()) for y in set(ends[:, 1].tolist())}
    return bool(upright.all()) and len(corners) == 4 and {(x, y) for x, y in ends.tolist()} == corners


def colors_of(paint: Paint) -> set[Color]:
    """Return the colours of a paint; two, whatever they are, if it is one of several that are not listed."""
    if paint.gradient is not None:
        return {stop.color for stop in paint.gradient.stops if stop.opacity > 0.0}
    if paint.picture is not None and paint.picture.color is None:
        return set() if not paint.picture.pixels[..., 3].any() else colors_of_pixels(paint)
    if paint.effect is not None or (paint.blur is not None and paint.blur.has_colors):
        return {(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)}
    return {paint.color}


def colors_of_pixels(paint: Paint) -> set[Color]:
    """Return black for a black picture, and two colours for any other."""
    assert paint.picture is not None
    black = (0.0, 0.0, 0.0)
    return {black, (1.0, 1.0, 1.0)} if paint.picture.pixels[..., :3].any() else {black}


def meeting(a: Box, b: Box) -> Box | None:
    """Return the part that two boxes share; None if there is none."""
    left, top, right, bottom = max(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), min(a[3], b[3])
    return (left, top, right, bottom) if left < right and top < bottom else None


def holds(outer: Box, inner: Box) -> bool:
    """Return whether a box contains another one, but for slivers."""
    spare = min(SLIVER, SLIVER_SHARE * max(min(outer[2] - outer[0], outer[3] - outer[1]), 0.0))
    return (
        inner[0] >= outer[0] - spare
        and inner[1] >= outer[1] - spare
        and inner[2] <= outer[2] + spare
        and inner[3] <= outer[3] + spare
    )
