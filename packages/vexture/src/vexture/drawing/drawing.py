"""The normal form of all sources, from which quadtrees are built.

A `Drawing` is a list of painted `Path` objects in the unit square: x to the right, **y up**, origin at the bottom
left. Every contour is closed and made of cubics only; a straight line is a cubic with its inner control points at
one and two thirds.
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from copy import copy
from dataclasses import dataclass, field, replace
from enum import IntEnum
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.deadline import check_time
from vexture.base.errors import SourceError
from vexture.base.notes import Note
from vexture.bezier.convert import line_cubics
from vexture.drawing.affine import Affine
from vexture.drawing.contours import check_contours, join_contours, together
from vexture.drawing.group import Blend, Group, Mask, groups_around
from vexture.drawing.paint import BLACK, Paint
from vexture.drawing.unit_square import clip_contours, tidy_contours

SHARED_OPACITY: Final = "opacity of a group, which each of its shapes has by itself"
BLENDING, MASKING, SHADED = "mix-blend-mode", "clip-path or mask", "gradient shown as its mean colour"
PICTURED: Final = "picture shown as its mean colour"
SOLID: Final = "pattern shown as solid"
SOFTENED: Final = "blur or effect, which has no outline"
"""Notes on what layers and silhouettes lose: neither has groups or soft paints, and layers have no gradients."""

IDENTITY = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


class FillRule(IntEnum):
    """Rule by which a winding number is inside: nonzero, or odd."""

    NONZERO = 0
    EVENODD = 1


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """Closed contours that are filled together by one fill rule.

    Parameters
    ----------
    contours : tuple of (n, 4, 2) float64 arrays
        Cubics P0 P1 P2 P3 in unit-square units. Each cubic starts, bit for bit, at the end of the one before it, and
        the first starts at the end of the last.
    fill_rule : FillRule
    paint : Paint
    group : int
        Index of the innermost group around it in `Drawing.groups`; -1 if there is none.
    element : str
        Name of the source's element that the path draws, for picking and restyling. Several paths may share a name; it
        is empty if the element has none.
    hides : bool
        True if the path hides something that the drawing leaves out. A map made for restyling then keeps it opaque.

    Raises
    ------
    SourceError
        If a contour has another shape, is not closed or is not finite.
    """

    contours: tuple[NDArray[np.float64], ...]
    fill_rule: FillRule = FillRule.NONZERO
    paint: Paint = BLACK
    group: int = -1
    element: str = ""
    hides: bool = False

    def __post_init__(self) -> None:
        check_contours(self.contours)

    @classmethod
    def unchecked(
        cls,
        contours: tuple[NDArray[np.float64], ...],
        fill_rule: FillRule,
        paint: Paint,
        group: int = -1,
        element: str = "",
        hides: bool = False,
    ) -> "Path":
        """Make a path from contours that are known to be finite and closed; a check would take most of the time."""
        path, assign = object.__new__(cls), object.__setattr__  # a loop takes three times as long
        assign(path, "contours", contours)
        assign(path, "fill_rule", fill_rule)
        assign(path, "paint", paint)
        assign(path, "group", group)
        assign(path, "element", element)
        assign(path, "hides", hides)
        return path

    @classmethod
    def _unchecked(cls, contours: tuple[NDArray[np.float64], ...], like: "Path", to_source: Affine) -> "Path":
        """Make a path from valid contours; its other attributes are those of `like`, with the paint moved."""
        return cls.unchecked(
            contours, like.fill_rule, like.paint.after(to_source), like.group, like.element, like.hides
        )

    @property
    def box(self) -> NDArray[np.float64]:
        """Bounding box of all control points, (2, 2): least and greatest coordinates; it contains the whole path."""
        if not self.contours:
            return np.array([[np.inf, np.inf], [-np.inf, -np.inf]])
        points = join_contours(self.contours)
        return np.stack([points.min(axis=(0, 1)), points.max(axis=(0, 1))])


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """Painted paths in the unit square, in painting order.

    Its *silhouette* is the union of everything painted.

    Parameters
    ----------
    paths : tuple of Path
        In painting order; all coordinates lie in [0, 1].
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    name : str
        Name of the shape in messages and files.
    crs : str or None
        Coordinate reference system of the source's units, if it has one.
    notes : tuple of Note
        Everything that the reader left out, simplified or found invalid.
    groups : tuple of Group
        Each group comes after the group around it. The paths of a group and of its inner groups are consecutive.
    sides : tuple of float
        Width and height of the source's box, which is centred in the unit square; the longer side is 1.

    Examples
    --------
    >>> square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    >>> square.segments
    4
    """

    paths: tuple[Path, ...]
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    name: str = "drawing"
    crs: str | None = None
    notes: tuple[Note, ...] = ()
    groups: tuple[Group, ...] = ()
    sides: tuple[float, float] = (1.0, 1.0)

    def __post_init__(self) -> None:
        self._check_groups()
        if np.shape(self.to_source) != (2, 3) or not np.isfinite(self.to_source).all():
            raise SourceError(f"{self.name}: to_source must be a finite (2, 3) array")
        begins = join_contours(together([path.contours for path in self.paths]))[:, 0]
        inside = (begins[:, axis].min() >= 0.0 and begins[:, axis].max() <= 1.0 for axis in range(2))
        if len(begins) and not all(inside):
            raise SourceError(f"{self.name}: a contour leaves the unit square; clip or scale it first")

    def _check_groups(self) -> None:
        """Raise a `SourceError` unless groups are nested, and the paths of each group are consecutive."""
        if not self.groups and all(path.group == -1 for path in self.paths):
            return
        for place, group in enumerate(self.groups):
            if not -1 <= group.outer < place:
                raise SourceError(f"{self.name}: group {place} lies in group {group.outer}, which is not before it")
        ended: set[int] = set()
        open_groups: list[int] = []
        for path in self.paths:
            if not -1 <= path.group < len(self.groups):
                raise SourceError(f"{self.name}: a path is in group {path.group}, of {len(self.groups)}")
            around = self.around(path.group)
            ended.update(set(open_groups) - set(around))
            open_groups = around
            if not ended.isdisjoint(around):
                raise SourceError(f"{self.name}: paths of group {path.group} do not follow one another")

    def around(self, group: int) -> list[int]:
        """Return the groups from the outermost to a given one, which may be -1."""
        return groups_around(self.groups, group)

    @property
    def segments(self) -> int:
        """Number of cubics."""
        return sum(len(contour) for path in self.paths for contour in path.contours)

    @property
    def is_coloured(self) -> bool:
        """True if the drawing has more than one colour.

        That is with several paints, a gradient or picture, or groups, which change colours.

        Examples
        --------
        >>> Drawing.polygon([(0, 0), (1, 0), (0, 1)]).is_coloured
        False
        """
        paints = {path.paint for path in self.paths}
        return len(paints) > 1 or bool(self.groups) or any(paint.is_varied for paint in paints)

    def layers(self) -> "tuple[Drawing, ...]":
        """Split the drawing by paint; drawn in order, the layers reproduce the drawing in its colours.

        Consecutive paths with the same opaque paint form one layer. A translucent paint would show twice where two
        paths overlap, so paths with such a paint share a layer only if their boxes do not touch. Layers have no groups:
        each path gets the opacities of all groups around it, and blends normally. Gradients and pictures become their
        mean colours.

        Returns
        -------
        tuple of Drawing
            In painting order, each with one paint, named ``name/number-colour`` and counted from 1. Each has the notes
            of the drawing and those on lost groups, gradients and pictures. The tuple is empty if nothing is painted.

        Examples
        --------
        >>> square = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]).paths[0].contours
        >>> red, blue = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0), 0.5)
        >>> logo = Drawing(tuple(Path(square, paint=paint) for paint in (red, red, blue, blue)), name="logo")
        >>> [(layer.name, len(layer.paths)) for layer in logo.layers()]
        [('logo/1-#ff0000', 2), ('logo/2-#0000ff80', 1), ('logo/3-#0000ff80', 1)]
        """
        if self.groups or any(path.paint.is_varied for path in self.paths):
            return self.flat().layers()
        boxes = np.array([path.box for path in self.paths]).reshape(-1, 2, 2)
        starts: list[int] = []
        for place, path in enumerate(self.paths):
            check_time(self.name)
            if starts and path.paint == self.paths[starts[-1]].paint:
                above, below = boxes[place], boxes[starts[-1] : place]
                apart = (above[0] > below[:, 1]) | (above[1] < below[:, 0])
                if path.paint.opacity >= 1.0 or apart.any(axis=1).all():
                    continue
            starts.append(place)
        return tuple(
            self._part(start, end, f"{self.name}/{number}-{self.paths[start].paint.hex}")
            for number, (start, end) in enumerate(pairwise([*starts, len(self.paths)]), 1)
        )

    def flat(self) -> "Drawing":
        """Return the drawing without groups, masks, gradients, pictures and soft paints.

        Each path gets the opacities of the groups around it, and a shape filled with a pattern becomes solid. Notes
        list what a picture of the result lacks.
        """
        if any(path.paint.is_soft for path in self.paths):
            return self.without_softness().flat()
        opacities, hidden = {-1: 1.0}, set[int]()
        patterns = {place for place, group in enumerate(self.groups) if group.pattern}
        for place, group in enumerate(self.groups):
            opacities[place] = opacities[group.outer] * group.opacity
            if group.outer in hidden or bool(group.mask) != (group.outer in patterns):
                hidden.add(place)
        hidden |= patterns
        visible = [path for path in self.paths if path.group not in hidden]
        paints = (path.paint.fade(opacities[path.group]) for path in visible)
        flat = (Paint(paint.color, paint.opacity) for paint in paints)
        paths = tuple(replace(path, paint=paint, group=-1) for path, paint in zip(visible, flat, strict=True))
        return replace(self, paths=paths, groups=(), notes=(*self.notes, *self._lost()))

    def without_masks(self) -> "Drawing":
        """Return the drawing without its masks and soft paints, for its silhouette; notes count them."""
        if any(path.paint.is_soft for path in self.paths):
            return self.without_softness().without_masks()
        if not any(group.mask for group in self.groups):
            return self
        plain = self.flat()
        lost = tuple(note for note in plain.notes[len(self.notes) :] if note.message in (MASKING, SOLID))
        return replace(plain, notes=(*self.notes, *lost))

    def without_softness(self) -> "Drawing":
        """Return the drawing without blurs, effects and all that they mask; a note counts their paths."""
        soft = [path for path in self.paths if path.paint.is_soft]
        masks = {place for path in soft for place in self.around(path.group) if self.groups[place].mask}
        hidden = {self.groups[mask].outer for mask in masks}
        clear = (path for path in self.paths if not path.paint.is_soft)
        paths = tuple(path for path in clear if hidden.isdisjoint(self.around(path.group)))
        notes = (Note("left out", SOFTENED, len(soft)),) if soft else ()
        return replace(self, paths=paths, notes=(*self.notes, *notes))

    def _lost(self) -> Iterator[Note]:
        """Yield notes on what layers lose of groups and gradients; the opacity of a group of one path is not lost."""
        sizes = Counter(path.group for path in self.paths)
        for place in reversed(range(len(self.groups))):
            if self.groups[place].pattern:
                sizes[place] = min(sizes[place], 1)  # the shape that it fills
            sizes[self.groups[place].outer] += sizes[place]
        shared = sum(group.opacity < 1.0 and sizes[place] > 1 for place, group in enumerate(self.groups))
        blended = sum(group.blend is not Blend.NORMAL and sizes[place] > 0 for place, group in enumerate(self.groups))
        patterns = sum(group.pattern for group in self.groups)
        masks = sum(group.mask is not Mask.NONE for group in self.groups) - patterns
        shaded = sum(path.paint.gradient is not None for path in self.paths)
        pictured = sum(path.paint.picture is not None for path in self.paths)
        messages = SHARED_OPACITY, BLENDING, MASKING, SOLID, SHADED, PICTURED
        for message, count in zip(messages, (shared, blended, masks, patterns, shaded, pictured), strict=True):
            if count:
                yield Note("simplified", message, count)

    def _part(self, start: int, end: int, name: str) -> "Drawing":
        """Return a drawing of some of the paths, without checking them again."""
        part = copy(self)
        object.__setattr__(part, "paths", self.paths[start:end])
        object.__setattr__(part, "name", name)
        return part

    @classmethod
    def polygon(cls, *contours: Iterable[tuple[float, float]], fill_rule: FillRule = FillRule.NONZERO) -> "Drawing":
        """Make a drawing of one path with straight sides, from its corners in unit-square units.

        Examples
        --------
        >>> Drawing.polygon([(0, 0), (1, 0), (0, 1)]).paths[0].contours[0][0]
        array([[0.        , 0.        ],
               [0.33333333, 0.        ],
               [0.66666667, 0.        ],
               [1.        , 0.        ]])
        """
        closed = []
        for contour in contours:
            start = np.array(list(contour), dtype=np.float64)
            closed.append(line_cubics(start, np.roll(start, -1, axis=0)))
        return cls((Path(tuple(closed), fill_rule),))

    @classmethod
    def from_source(
        cls,
        paths: Iterable[Path],
        box: tuple[float, float, float, float],
        name: str = "drawing",
        groups: tuple[Group, ...] = (),
    ) -> "Drawing":
        """Bring the paths of a source into the normal form.

        The source's box keeps its aspect ratio, is centred in the unit square and is flipped to y up. Parts outside the
        box are clipped. Cubics of zero length and contours that enclose nothing are dropped.

        Parameters
        ----------
        paths : iterable of Path
            In the units of the source, **y down**.
        box : tuple of float
            Least x, least y, width and height of the visible part, in the units of the source.
        name : str
        groups : tuple of Group

        Raises
        ------
        SourceError
            If the box has no area, or a coordinate is too far from it.

        Examples
        --------
        >>> wide = Path((line_cubics(*np.array([[(0, 0), (4, 0), (0, 2)], [(4, 0), (0, 2), (0, 0)]], float)),))
        >>> drawing = Drawing.from_source([wide], (0, 0, 4, 2))
        >>> drawing.paths[0].contours[0][:, 0]
        array([[0.  , 0.75],
               [1.  , 0.75],
               [0.  , 0.25]])
        >>> drawing.to_source @ (1, 0.75, 1)
        array([4., 0.])
        """
        x, y, width, height = box
        size = max(width, height)
        if not (min(width, height) > 0.0 and np.isfinite(size) and np.isfinite(1.0 / size)):
            raise SourceError(f"the drawing's box is {width:g} x {height:g}; both must be above 0")
        to_source = np.array([[size, 0.0, x - (size - width) / 2], [0.0, -size, y + height + (size - height) / 2]])
        sides = (width / size, height / size)
        low = np.array([(1.0 - side) / 2 for side in sides])
        listed = list(paths)
        contours = [contour for path in listed for contour in path.contours]
        if not contours:
            return cls((), to_source, name, groups=groups, sides=sides)
        cubics = (join_contours(contours) - (x, y)) / size + low
        cubics[..., 1] = 1.0 - cubics[..., 1]
        ends = np.cumsum([len(contour) for contour in contours])
        tidy = tidy_contours(*clip_contours(cubics, ends, low, 1.0 - low))
        normal = []
        a, b, c, d, e, f = to_source.ravel().tolist()
        rows = ((a, b, c), (d, e, f))
        at = 0
        for path in listed:
            after = at + len(path.contours)
            inside = tuple(tidy[k] for k in range(at, after) if k in tidy)
            at = after
            if inside:
                normal.append(Path._unchecked(inside, path, rows))
        return cls(tuple(normal), to_source, name, groups=groups, sides=sides)
