"""Restyling data of a planar map: the elements of its drawing, and the elements of which each paint is composited."""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.base.notes import Note
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group, groups_around
from vexture.drawing.paint import Paint

DIGITS: Final = 6
"""Decimals of an element's colour and opacity, finer than the steps of 1/65535 in which paints are stored."""

MOST_NESTED: Final = 100
"""Most groups nested in one another. A file with deeper nesting would take long to read."""

SHADED: Final = "gradient, of its mean colour, as colours that can be changed are flat"
PICTURED: Final = "picture, of its mean colour, as colours that can be changed are flat"


@dataclass(frozen=True, slots=True, eq=False)
class PlanarStyle:
    """The n elements of a planar map, in painting order, and the elements that make up each of its p paints.

    An element is all paths of one name, one paint and one group. They get a new colour together.

    Parameters
    ----------
    names : tuple of str
        As in `Path.element`; several elements may have one name, and many have none.
    rgba : (n, 4) float64 array
        Colours and opacities, not premultiplied, to six decimals.
    group : (n,) int64 array
        The innermost group around each, as a place in `groups`; -1 if there is none.
    hides : (n,) bool array
        Whether the map lacks something below, because the element's opaque colour hides it.
    groups : tuple of Group
        As in `Drawing.groups`.
    starts : (p + 1,) int64 array
    members : int32 array
        Paint j is made of the elements `members[starts[j] : starts[j + 1]]`, from below; an element may be repeated.
    """

    names: tuple[str, ...]
    rgba: NDArray[np.float64]
    group: NDArray[np.int64]
    hides: NDArray[np.bool_]
    groups: tuple[Group, ...]
    starts: NDArray[np.int64]
    members: NDArray[np.int32]

    @property
    def top(self) -> NDArray[np.int64]:
        """The topmost visible element of each paint, (p,); -1 without any."""
        some = np.diff(self.starts) > 0
        top = np.full(len(some), -1)
        top[some] = self.members[self.starts[1:][some] - 1]
        if any(group.mask for group in self.groups):
            for paint, (start, end) in enumerate(pairwise(self.starts.tolist())):
                seen = self._visible_elements(self.members[start:end].tolist())
                top[paint] = seen[-1] if seen else -1
        return top

    def _visible_elements(self, stack: list[int]) -> list[int]:
        """Return the elements of a stack that are not in masks and are not hidden by an empty mask."""
        around = {element: groups_around(self.groups, int(self.group[element])) for element in set(stack)}
        open_groups = {group for found in around.values() for group in found}
        hidden = {g.outer for place, g in enumerate(self.groups) if g.mask and place not in open_groups}
        hidden |= {place for place, group in enumerate(self.groups) if group.mask}
        return [element for element in stack if hidden.isdisjoint(around[element])]

    def check_groups(self) -> None:
        """Raise a `LimitError` if groups are nested too deeply.

        Raise a `SourceError` if they are not nested properly, or if a group's elements are not consecutive.
        """
        depth: list[int] = []
        for group in self.groups:
            depth.append(depth[group.outer] + 1 if 0 <= group.outer < len(depth) else 1)
        if max(depth, default=0) > MOST_NESTED:
            raise LimitError(f"groups are {max(depth)} deep; the limit of what can be restyled is {MOST_NESTED}")
        if self.groups or (self.group != -1).any():
            Drawing(tuple(Path((), group=group) for group in self.group.tolist()), groups=self.groups)


def round_colours(rgba: Any) -> NDArray[np.float64]:
    """Round colours to the digits that a style stores."""
    return np.round(np.asarray(rgba, np.float64).reshape(-1, 4), DIGITS)


def restylable(drawing: Drawing) -> Drawing:
    """Replace gradients and pictures by their mean colours, and drop soft paints; notes give their numbers."""
    if any(path.paint.is_soft for path in drawing.paths):
        return restylable(drawing.without_softness())
    shaded = sum(path.paint.gradient is not None for path in drawing.paths)
    pictured = sum(path.paint.picture is not None for path in drawing.paths)
    notes = [Note("simplified", text, count) for text, count in ((SHADED, shaded), (PICTURED, pictured)) if count]
    if not notes:
        return drawing
    paths = tuple(replace(path, paint=Paint(path.paint.color, path.paint.opacity)) for path in drawing.paths)
    return replace(drawing, paths=paths, notes=(*drawing.notes, *notes))


def elements_of(drawing: Drawing) -> tuple[list[Path], NDArray[np.int64]]:
    """First path of each element of a drawing, in order, and the number of each path's element."""
    paints: dict[Paint, int] = {}
    known: dict[
        int, int
    ] = {}  # by identity: most paths share their paints, and hashing a paint takes longer than the rest
    places: dict[tuple[str, int, int], int] = {}
    first: list[Path] = []
    numbers: list[int] = []
    for path in drawing.paths:
        paint = known.get(id(path.paint))
        if paint is None:
            paint = known[id(path.paint)] = paints.setdefault(path.paint, len(paints))
        place = places.setdefault((path.element, paint, path.group), len(places))
        if place == len(first):
            first.append(path)
        numbers.append(place)
    return first, np.array(numbers, np.int64)


def style_of(drawing: Drawing, planar: Any) -> PlanarStyle:
    """Style of a drawing's `PlanarMap` that was built to be restyled."""
    first, number = elements_of(drawing)
    hides = np.zeros(len(first), np.bool_)
    hides[number[list(planar.hiding)]] = True
    style = PlanarStyle(
        tuple(path.element for path in first),
        round_colours([(*path.paint.color, path.paint.opacity) for path in first]),
        np.array([path.group for path in first], np.int64),
        hides,
        drawing.groups,
        planar.starts,
        number[planar.members].astype(np.int32),
    )
    style.check_groups()
    return style
