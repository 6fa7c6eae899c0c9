"""Elements that become groups of the drawing: opacity, blend modes and isolation, if they change the picture."""

from dataclasses import dataclass, field, replace

from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.svg.properties import BLENDS
from vexture.svg.style import ElementStyle

MOST_BOXES = 500
"""Most paths in a veil that are compared with one another."""

ISOLATING = ("clip-path", "filter", "mask")
"""Properties that isolate an element with any value but "none"; 2D transforms do not."""

Box = tuple[float, float, float, float]
"""Left, bottom, right and top, in the drawing's coordinates."""


@dataclass(slots=True, eq=False)
class Veil:
    """An element that is composited by itself according to the standard (Compositing and Blending 1, 3.2).

    It becomes a group only if the picture would differ without one.
    """

    outer: "Veil | None"
    opacity: float
    blend: Blend = Blend.NORMAL
    boxes: list[Box] = field(default_factory=list)
    overlaps: bool = False
    mixes: bool = False  # True if its content has a blend mode, which must not affect what is outside
    mask: Mask = Mask.NONE  # property by which it masks the veil around it
    masks: "list[Veil]" = field(default_factory=list)  # veils that mask it
    is_pattern: bool = False  # True if it holds a pattern, masked by the filled or stroked shape

    def enter(self, outer: "Veil | None", box: Box) -> None:
        """Insert this independent veil of a pattern into another veil, with a box of everything that it paints."""
        self.outer = outer
        if outer is not None:
            outer.add(box)
        while outer is not None and self.overlaps:
            outer.overlaps = True
            outer = None if outer.mask else outer.outer

    def mask_pattern(self, opacity: float) -> "Veil":
        """Make this the veil of a pattern; return the veil of the shape that masks it, with an opacity."""
        self.is_pattern = True
        self.masks.append(Veil(self, opacity, mask=Mask.OPACITY))
        return self.masks[-1]

    def add(self, box: Box) -> None:
        """Add the box of a path; more than `MOST_BOXES` boxes count as overlapping."""
        veil: Veil | None = self
        while veil is not None and not veil.overlaps:  # around an overlapping veil, all veils overlap
            veil.overlaps = len(veil.boxes) == MOST_BOXES or any(meet(box, other) for other in veil.boxes)
            veil.boxes.append(box)
            if veil.mask:
                break
            if veil.outer is not None and veil.blend is not Blend.NORMAL:
                veil.outer.mixes = True
            veil = veil.outer

    @property
    def is_group(self) -> bool:
        """True if its paths cannot have its opacity one by one, or if a blend mode reveals that they are together."""
        blends = self.blend is not Blend.NORMAL and (self.outer is None or self.outer.overlaps)
        return bool(self.mask or self.masks) or blends or (self.overlaps and (self.opacity < 1.0 or self.mixes))


def meet(a: Box, b: Box) -> bool:
    """Return whether the interiors of two boxes intersect."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def veil_of(style: ElementStyle, outer: Veil | None, is_clip: bool = False) -> Veil | None:
    """Return the veil of an element, or the veil around it if the element is not composited by itself.

    In a clip only outlines count, so only further clips and masks matter.
    """
    if not style.own:
        return outer
    isolated = any(style[name].lower() != "none" for name in ISOLATING)
    if is_clip:
        return Veil(outer, 1.0) if isolated else outer
    opacity, blend = style.opacity("opacity"), BLENDS[style["mix-blend-mode"].lower()]
    if opacity == 1.0 and blend is Blend.NORMAL and not isolated and style["isolation"].lower() != "isolate":
        return outer
    return Veil(outer, opacity, blend)


def group_paths(paths: list[Path], veils: list[Veil | None]) -> tuple[list[Path], tuple[Group, ...]]:
    """Put paths, each with its innermost veil, into groups; multiply the opacities of other veils into the paths."""
    groups: list[Group] = []
    places: dict[Veil | None, tuple[int, float]] = {None: (-1, 1.0)}  # index of the group, and opacity of its paths
    done = []
    for path, innermost in zip(paths, veils, strict=True):
        unknown = []
        veil = innermost
        while veil not in places:
            assert veil is not None
            unknown.append(veil)
            veil = veil.outer
        while unknown:
            veil = unknown.pop()
            place, opacity = places[veil.outer]
            if veil.mask:
                opacity = 1.0
            own, each = (veil.opacity, 1.0) if veil.overlaps else (1.0, veil.opacity)
            opacity *= each
            if veil.is_group:
                if veil.is_pattern:  # the opacity also belongs to the shape, which may replace the pattern
                    own, opacity = own * opacity, 1.0
                groups.append(Group(place, own, veil.blend, veil.mask, veil.is_pattern))
                place = len(groups) - 1
            places[veil] = place, opacity
            unknown += [mask for mask in veil.masks if mask not in unknown]  # including masks that show nothing
        place, opacity = places[innermost]
        if innermost is not None:
            path = replace(path, paint=path.paint.fade(opacity), group=place)
        done.append(path)
    return done, tuple(groups)


def masking(groups: tuple[Group, ...]) -> list[bool]:
    """Return for each group whether its content only masks others."""
    found = list[bool]()
    for group in groups:
        found.append(bool(group.mask) or (group.outer >= 0 and found[group.outer]))
    return found


def has_colors(drawing: Drawing) -> bool:
    """Return whether the visible part of a drawing has several colours; opacities and masks do not count."""
    masks = masking(drawing.groups)
    paints = {path.paint for path in drawing.paths if path.group < 0 or not masks[path.group]}
    return len({paint.color for paint in paints}) > 1 or any(paint.is_varied for paint in paints)


def drop_empty_groups(paths: tuple[Path, ...], groups: tuple[Group, ...]) -> tuple[tuple[Path, ...], tuple[Group, ...]]:
    """Drop groups without paths; an empty mask hides what it masks."""
    held = {path.group for path in paths}
    for place in reversed(range(len(groups))):
        if place in held:
            held.add(groups[place].outer)
    for place, group in enumerate(groups):
        if group.mask and group.outer in held:
            held.add(place)
    remaining = [place for place in range(len(groups)) if place in held]
    if len(remaining) == len(groups):
        return paths, groups
    places = {-1: -1} | {place: new for new, place in enumerate(remaining)}
    moved = tuple(replace(path, group=places[path.group]) for path in paths)
    return moved, tuple(replace(groups[place], outer=places[groups[place].outer]) for place in remaining)
