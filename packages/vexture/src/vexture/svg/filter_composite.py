"""Composition of the content of filters (Filter Effects 1, 9.3 and 9.8)."""

from dataclasses import replace
from typing import Final

from vexture.drawing.blur import REACH, Blur
from vexture.drawing.drawing import Path
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Paint
from vexture.svg.compositing import Box, meet
from vexture.svg.filter_colors import recolor_paint
from vexture.svg.filter_content import (
    FilterContent,
    InexactError,
    blend_group,
    flood,
    holds,
    is_rectangle,
    meeting,
    stack,
)

WHITE, BLACK = Paint((1.0, 1.0, 1.0)), (0.0, 0.0, 0.0)

SAME: Final = 1e-6
"""Largest difference of factors that count as equal."""

FACTORS: Final = "its factors {} are not drawn for such shapes"


def inside(content: FilterContent, around: FilterContent) -> FilterContent:
    """Return the first content where the second one is, times its opacity."""
    box, other = content.box, around.box
    if box is None or other is None or not meet(box, other):
        return FilterContent()
    only, mask = content.only_path, around.only_path
    if only is not None and is_flat(only.paint) and is_rectangle(only):
        part = around.cut(box) if not holds(box, other) else around
        colored = part.with_paints(lambda path: recolor_paint(path.paint, only.paint.color), only.element)
        if around.is_plain:
            return colored.fade(only.paint.opacity)
    if mask is not None and is_flat(mask.paint) and is_rectangle(mask):
        return content.cut(other).fade(mask.paint.opacity)
    return content.masked_by(around, Mask.OPACITY)


def outside(content: FilterContent, around: FilterContent) -> FilterContent:
    """Return the first content where the second one is not: times 1 minus its opacity."""
    box, other = content.box, around.box
    if box is None or other is None or not meet(box, other):
        return content
    only, soft = content.only_path, around.only_path
    if only is not None and soft is not None and is_flat(only.paint):
        blur = inverse_of(soft, box)
        if blur is not None:
            return FilterContent((replace(only, paint=replace(only.paint, blur=blur)),))
    shared = meeting(box, other) or box
    black = around.with_paints(lambda path: recolor_paint(path.paint, BLACK))
    if not around.is_plain:
        black = FilterContent(black.paths, tuple(replace(group, blend=Blend.NORMAL) for group in black.groups))
    ground = flood((*box[:2], *box[2:]), WHITE)
    return content.masked_by(stack([ground, black.cut(shared)]), Mask.LUMINANCE)


def is_flat(paint: Paint) -> bool:
    """Return whether a paint is one colour."""
    return not paint.is_varied


def inverse_of(soft: Path, box: Box) -> Blur | None:
    """Return the inverted blur of a path that shows all of it inside a box; None if it is something else."""
    blur = soft.paint.blur
    if blur is None or blur.is_inverted or soft.paint.opacity < 1.0 or not is_rectangle(soft):
        return None
    (across, turned, left), (skewed, up, low) = blur.to_source
    if turned or skewed or not across or not up:
        return None
    (x, y), (right, bottom) = soft.box.tolist()
    corners = sorted(across * at + left for at in (x, right)), sorted(up * at + low for at in (y, bottom))
    inner = sorted(across * at + left for at in (box[0], box[2])), sorted(up * at + low for at in (box[1], box[3]))
    least, most = source_box(blur)
    for axis, deviation in enumerate(blur.deviations):
        reach = (1.0 - SAME) * REACH * deviation
        begins = corners[axis][0] <= max(inner[axis][0] + SAME, least[axis] - reach)
        ends = corners[axis][1] >= min(inner[axis][1] - SAME, most[axis] + reach)
        if not (begins and ends):
            return None
    return replace(blur, has_colors=False, is_linear=False, is_inverted=True)


def source_box(blur: Blur) -> tuple[list[float], list[float]]:
    """Return the corners of the source of a blur."""
    boxes = [path.box for path in blur.source.paths]
    least, most = (
        [function(float(box[k][axis]) for box in boxes) for axis in (0, 1)] for k, function in ((0, min), (1, max))
    )
    return least, most


def add_light(upper: FilterContent, lower: FilterContent) -> FilterContent:
    """Return the sum of two contents."""
    box, other = upper.box, lower.box
    if box is None or other is None or not meet(box, other):
        return stack([lower, upper])
    return blend_group(upper, lower, Blend.PLUS_LIGHTER)


def blend(upper: FilterContent, lower: FilterContent, mode: Blend) -> FilterContent:
    """Return the first content blended onto the second one."""
    if mode is Blend.NORMAL or not upper.paths or not lower.paths:
        return stack([lower, upper])
    return blend_group(upper, lower, mode)


def composite(upper: FilterContent, lower: FilterContent, operator: str) -> FilterContent:
    """Return the first content composited with the second one by an operator of Porter and Duff."""
    match operator:
        case "in":
            return inside(upper, lower)
        case "out":
            return outside(upper, lower)
        case "atop":
            if lower.is_opaque:
                return stack([lower, inside(upper, lower)])
            return add_light(inside(upper, lower), outside(lower, upper))
        case "xor":
            return add_light(outside(upper, lower), outside(lower, upper))
        case "lighter":
            return add_light(upper, lower)
    return stack([lower, upper])


def combine(upper: FilterContent, lower: FilterContent, factors: tuple[float, float, float, float]) -> FilterContent:
    """Return the arithmetic composite of two contents, if there is an equal one of other operators.

    It is k1 i1 i2 + k2 i1 + k3 i2 + k4 for colours times opacities, and for opacities.
    """
    product, first, second, constant = factors
    if abs(constant) > SAME:
        raise InexactError(FACTORS.format(list_factors(factors)))
    if not upper.visible or not lower.visible:
        return scale(upper, first, factors) if upper.visible else scale(lower, second, factors)
    if abs(product) <= SAME:
        return combine_sums(upper, lower, factors)
    rest = first, second
    both = multiply(upper, lower)
    if both is None:
        raise InexactError(FACTORS.format(list_factors(factors)))
    if product > 0.0 and rest == (0.0, 0.0):
        return scale(both, product, factors)
    if product < 0.0 and lower.color == (1.0, 1.0, 1.0) and abs(first + product) <= SAME and second == 0.0:
        return scale(outside(upper, lower), first, factors)
    if product < 0.0 and upper.color == (1.0, 1.0, 1.0) and abs(second + product) <= SAME and first == 0.0:
        return scale(outside(lower, upper), second, factors)
    if product > 0.0 and first >= 0.0 and second >= 0.0:
        return add_light(
            scale(both, product, factors), add_light(scale(upper, first, factors), scale(lower, second, factors))
        )
    raise InexactError(FACTORS.format(list_factors(factors)))


def combine_sums(
    upper: FilterContent, lower: FilterContent, factors: tuple[float, float, float, float]
) -> FilterContent:
    """Return the arithmetic composite without a product."""
    _, first, second, _ = factors
    if first >= 0.0 and second >= 0.0:
        return add_light(scale(upper, first, factors), scale(lower, second, factors))
    if first <= 0.0 and second <= 0.0:
        return FilterContent()
    less, more, part, whole = (upper, lower, -first, second) if first < 0.0 else (lower, upper, -second, first)
    is_even = less.color is not None and less.color == more.color
    if is_even and more.is_opaque and part <= 1.0 and abs(whole - 1.0) <= SAME:
        return outside(more, less.fade(part))
    raise InexactError(FACTORS.format(list_factors(factors)))


def multiply(upper: FilterContent, lower: FilterContent) -> FilterContent | None:
    """Return the product of two contents; None if both have several colours."""
    if upper.color is None and lower.color is None:
        return None
    factor = upper.color or lower.color
    other, mask = (lower, upper) if upper.color is not None else (upper, lower)
    if factor is None:
        return None
    if factor != (1.0, 1.0, 1.0):
        color = other.color
        if color is None:
            return None
        red, green, blue = (a * b for a, b in zip(color, factor, strict=True))
        other = other.with_paints(lambda path: recolor_paint(path.paint, (red, green, blue)))
    return inside(other, mask)


def scale(content: FilterContent, factor: float, factors: tuple[float, float, float, float]) -> FilterContent:
    """Return the content with its light and opacity multiplied."""
    if factor <= 1.0 + SAME:
        return content.fade(factor)
    if content.is_opaque and content.color == BLACK:
        return content
    raise InexactError(FACTORS.format(list_factors(factors)))


def list_factors(factors: tuple[float, float, float, float]) -> str:
    """Return the text of factors."""
    return ", ".join(f"{factor:g}" for factor in factors)
