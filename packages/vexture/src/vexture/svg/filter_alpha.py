"""Functions of colours on the content of filters: they act on the paints, with the exactness that groups allow."""

from dataclasses import replace
from typing import Final

import numpy as np

from vexture.drawing.drawing import Path
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Color, Paint
from vexture.svg.compositing import Box, masking
from vexture.svg.filter_colors import ColorFunction, change_paint, pass_values, recolor_paint
from vexture.svg.filter_composite import outside
from vexture.svg.filter_content import FilterContent, InexactError, flood, stack
from vexture.svg.filter_pixels import to_linear

ONE_BY_ONE: Final = "translucent shapes that overlap are changed one by one"
SOFT: Final = "the change of soft opacities is not exact"


def recolor(content: FilterContent, color: Color, element: str | None = None) -> FilterContent:
    """Return the content in one colour, with its opacities; it gets a name, if there is one."""
    groups = tuple(
        group if group.blend in (Blend.NORMAL, Blend.PLUS_LIGHTER) else replace(group, blend=Blend.NORMAL)
        for group in content.groups
    )  # all other modes have the opacity of the normal one
    hidden = {id(path) for path in repeated_outlines(content)}

    def change(path: Path) -> Paint | None:
        return None if id(path) in hidden else recolor_paint(path.paint, color)

    return FilterContent(content.paths, groups).with_paints(change, element)


def repeated_outlines(content: FilterContent) -> list[Path]:
    """Return the paths that add no opacity, because an opaque path of the same group has the same outlines."""
    opaque: set[tuple[object, ...]] = set()
    translucent: list[tuple[tuple[object, ...], Path]] = []
    for path in content.visible:
        outlines = path.group, path.fill_rule, *(contour.tobytes() for contour in path.contours)
        if path.paint.is_opaque and outlines not in opaque:
            opaque.add(outlines)
        else:
            translucent.append((outlines, path))
    return [path for outlines, path in translucent if outlines in opaque]


def change_colors(
    content: FilterContent, function: ColorFunction, region: Box, element: str, remarks: dict[str, None]
) -> FilterContent:
    """Return the content after a function of colours; `remarks` get what is not exact."""
    if function.reads_colors:
        return alpha_of_colors(content, function, region, element, remarks)
    if function.constant is not None:
        changed = recolor(content, function.constant, element)
    else:
        changed = change_each(content, function, remarks)
    if function.keeps_alpha:
        return changed
    empty = function.color((0.0, 0.0, 0.0), 0.0)
    if empty[1] > 0.0:
        return fill_region(changed, function, Paint(*empty), region, element)
    return change_alpha(changed, function, remarks)


def change_each(content: FilterContent, function: ColorFunction, remarks: dict[str, None]) -> FilterContent:
    """Return the content with the colours of each path changed, but not their opacities."""
    colors = function.of_colors
    if not content.is_plain:
        remarks["its blend modes mix the changed colours"] = None
    if function.mixes_alpha and any(path.paint.blur is not None for path in content.visible):
        remarks[SOFT] = None
    is_affine = function.matrix is not None and not function.is_linear and not function.mixes_alpha
    if not is_affine and not content.is_opaque and content.overlaps:
        remarks[ONE_BY_ONE] = None
    return content.with_paints(lambda path: change_paint(path.paint, colors))


def fill_region(
    content: FilterContent, function: ColorFunction, empty: Paint, region: Box, element: str
) -> FilterContent:
    """Return the content after a function that makes transparency visible."""
    rest, full = empty.opacity, function.alpha(1.0)
    ground = flood(region, Paint(empty.color), element)
    is_affine = function.matrix is not None or abs(function.alpha(0.5) - (rest + full) / 2.0) < 1e-9
    same = not content.visible or content.color == empty.color
    if same and is_affine and full <= rest:
        part = 1.0 - full / rest
        return outside(ground, content.fade(part)).fade(rest)
    if same and is_affine and rest < 1.0:
        return stack([ground.fade(rest), content.fade((full - rest) / (1.0 - rest))])
    if content.is_opaque and (full >= 1.0 or not content.overlaps):
        if full >= 1.0:
            return stack([ground.fade(rest), content])
        return stack([outside(ground.fade(rest), content), content.fade(full)])
    raise InexactError("it makes transparency visible in several colours")


def change_alpha(content: FilterContent, function: ColorFunction, remarks: dict[str, None]) -> FilterContent:
    """Return the content with its opacities changed by a function that keeps transparency."""
    full = function.alpha(1.0)
    is_scale = all(abs(function.alpha(part) - part * full) < 1e-9 for part in (0.25, 0.5, 0.75))
    if is_scale or content.is_opaque:
        return content.fade(full)
    opacities = dict[int, float]({-1: 1.0})
    for place, group in enumerate(content.groups):
        opacities[place] = 1.0 if group.mask else opacities[group.outer] * group.opacity
    if content.overlaps and any(function.alpha(alpha_of(path, opacities)) < 1.0 for path in content.visible):
        remarks[ONE_BY_ONE] = None
    masks = masking(content.groups)
    if not all(path.paint.is_opaque for path in content.paths if path.group >= 0 and masks[path.group]):
        remarks[SOFT] = None

    alphas = only_alpha(function)

    def change(path: Path) -> Paint:
        paint = path.paint.fade(opacities[path.group])
        if paint.blur is not None:
            opacity = function.alpha(paint.opacity)
            if any(abs(function.alpha(part * paint.opacity) - part * opacity) > 0.01 for part in (0.2, 0.5, 0.8)):
                remarks[SOFT] = None
            return replace(paint, opacity=opacity)
        return change_paint(paint, alphas)

    groups = tuple(group if masks[place] else replace(group, opacity=1.0) for place, group in enumerate(content.groups))
    return FilterContent(content.with_paints(change).paths, groups)


def alpha_of(path: Path, opacities: dict[int, float]) -> float:
    """Return the least opacity of a path that is not soft."""
    paint = path.paint
    own = min(stop.opacity for stop in paint.gradient.stops) if paint.gradient is not None else paint.opacity
    return own * opacities[path.group]


def only_alpha(function: ColorFunction) -> ColorFunction:
    """Return the same function without its change of colours."""
    if function.matrix is None:
        assert function.channels is not None
        return ColorFunction(channels=(pass_values, pass_values, pass_values, function.channels[3]))
    matrix = np.eye(4, 5)
    matrix[3] = function.matrix[3]
    return ColorFunction(matrix)


def alpha_of_colors(
    content: FilterContent, function: ColorFunction, region: Box, element: str, remarks: dict[str, None]
) -> FilterContent:
    """Return the content with opacities that depend on colours: a rectangle of one colour, masked by them."""
    color, constant = function.color((0.0, 0.0, 0.0), 0.0)
    if constant > 0.0 or function.constant is None:
        raise InexactError("it makes opacities of colours, in several colours or where nothing is")
    matrix = np.zeros((4, 5))
    assert function.matrix is not None
    matrix[:3] = function.matrix[3]
    matrix[3, 3] = 1.0
    if not content.is_opaque:
        remarks[SOFT] = None
    grey = content.with_paints(lambda path: grey_paint(path.paint, ColorFunction(matrix), function.is_linear))
    box = content.box
    return FilterContent() if box is None else flood(box, Paint(color), element).masked_by(grey, Mask.LUMINANCE)


def grey_paint(paint: Paint, function: ColorFunction, is_linear: bool) -> Paint:
    """Return a paint in the greys whose luminance a function yields, of colours in linear light if `is_linear`."""
    if not is_linear:
        return change_paint(paint, function)
    lit = change_paint(paint, ColorFunction(channels=(to_linear, to_linear, to_linear, pass_values)))
    return change_paint(lit, function)
