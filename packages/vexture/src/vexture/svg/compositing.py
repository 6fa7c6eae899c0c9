"""Elements that are groups of the drawing: opacity, blend modes and isolation, where a picture shows them."""

from dataclasses import dataclass, field, replace

from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.svg.properties import BLENDS
from vexture.svg.style import ElementStyle

MOST_BOXES = 500
"""Paths in a veil that are compared with one another."""

ISOLATING = ("clip-path", "filter", "mask")
"""Properties that isolate an element, whatever they are beside "none"; 2D transforms do not."""

Box = tuple[float, float, float, float]
"""Left, bottom, right and top, in the drawing's coordinates."""


@dataclass(slots=True, eq=False)
class Veil:
    """An element that the standard composites by itself (Compositing and Blending 1, 3.2), and what it paints.

    It becomes a group only where the picture would differ without.
    """

    outer: "Veil | None"
    opacity: float
    blend: Blend = Blend.NORMAL
    boxes: list[Box] = field(default_factory=list)
    overlaps: bool = False
    mixes: bool = False  # whether something that is painted in it has a blend mode, which must not see beyond
    mask: Mask = Mask.NONE  # whether it masks the veil around it
    masks: "list[Veil]" = field(default_factory=list)  # that mask it
    is_pattern: bool = False  # whether a pattern fills or strokes a shape in it, and that shape is its mask

    def enter(self, outer: "Veil | None", box: Box) -> None:
        """Put a veil of its own, that of a pattern, with all that it paints in a box, into another."""
        self.outer = outer
        if outer is not None:
            outer.add(box)
        while outer is not None and self.overlaps:
            outer.overlaps = True
            outer = None if outer.mask else outer.outer

    def mask_pattern(self, opacity: float) -> "Veil":
        """Make it the veil of a pattern, and return that of the shape that masks it, of an opacity."""
        self.is_pattern = True
        self.masks.append(Veil(self, opacity, mask=Mask.OPACITY))
        return self.masks[-1]

    def add(self, box: Box) -> None:
        """Add the box of a path; those of more than `MOST_BOXES` are taken to overlap."""
        veil: Veil | None = self
        while veil is not None and not veil.overlaps:  # around a veil that overlaps, all do
            veil.overlaps = len(veil.boxes) == MOST_BOXES or any(meet(box, other) for other in veil.boxes)
            veil.boxes.append(box)
            if veil.mask:
                break
            if veil.outer is not None and veil.blend is not Blend.NORMAL:
                veil.outer.mixes = True
            veil = veil.outer

    @property
    def is_group(self) -> bool:
        """Whether its paths cannot have its opacity by themselves, or a blend mode shows that they are together."""
        blends = self.blend is not Blend.NORMAL and (self.outer is None or self.outer.overlaps)
        return bool(self.mask or self.masks) or blends or (self.overlaps and (self.opacity < 1.0 or self.mixes))


def meet(a: Box, b: Box) -> bool:
    """Whether the insides of two boxes have a point in common."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def veil_of(style: ElementStyle, outer: Veil | None, is_clip: bool = False) -> Veil | None:
    """The veil of an element inside the outermost one; the one around it if it is not composited by itself.

    In a clip only outlines count, so that nothing but another clip or mask makes a difference.
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
    """Put paths, each with the innermost veil around it, into groups; they get the opacities of the other veils."""
    groups: list[Group] = []
    places: dict[Veil | None, tuple[int, float]] = {None: (-1, 1.0)}  # the group, and the opacity of paths in it
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
                if veil.is_pattern:  # its opacity is that of the shape, too, which may stand for it
                    own, opacity = own * opacity, 1.0
                groups.append(Group(place, own, veil.blend, veil.mask, veil.is_pattern))
                place = len(groups) - 1
            places[veil] = place, opacity
            unknown += [mask for mask in veil.masks if mask not in unknown]  # also those that show nothing
        place, opacity = places[innermost]
        if innermost is not None:
            path = replace(path, paint=path.paint.fade(opacity), group=place)
        done.append(path)
    return done, tuple(groups)


def masking(groups: tuple[Group, ...]) -> list[bool]:
    """Whether what is in each group only masks others."""
    found = list[bool]()
    for group in groups:
        found.append(bool(group.mask) or (group.outer >= 0 and found[group.outer]))
    return found


def has_colors(drawing: Drawing) -> bool:
    """Whether what is seen of a drawing has more than one colour; opacities and masks make none."""
    masks = masking(drawing.groups)
    paints = {path.paint for path in drawing.paths if path.group < 0 or not masks[path.group]}
    return len({paint.color for paint in paints}) > 1 or any(paint.gradient is not None for paint in paints)


def drop_empty_groups(paths: tuple[Path, ...], groups: tuple[Group, ...]) -> tuple[tuple[Path, ...], tuple[Group, ...]]:
    """Paths and their groups, without the groups that hold none of them; a mask that is empty hides what it masks."""
    held = {path.group for path in paths}
    for place in reversed(range(len(groups))):
        if place in held:
            held.add(groups[place].outer)
    for place, group in enumerate(groups):
        if group.mask and group.outer in held:
            held.add(place)
    kept = [place for place in range(len(groups)) if place in held]
    if len(kept) == len(groups):
        return paths, groups
    places = {-1: -1} | {place: new for new, place in enumerate(kept)}
    moved = tuple(replace(path, group=places[path.group]) for path in paths)
    return moved, tuple(replace(groups[place], outer=places[groups[place].outer]) for place in kept)
