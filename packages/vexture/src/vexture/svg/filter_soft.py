"""Gaussian blurs of the content of filters (Filter Effects 1, 9.14), as paths with soft paints."""

from collections.abc import Iterator
from typing import Final

from vexture.drawing.affine import Affine
from vexture.drawing.blur import REACH, Blur
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Color, Paint
from vexture.svg.compositing import Box, drop_empty_groups
from vexture.svg.filter_content import MOST_PATHS, FilterContent, FilterLimitError, flood, meeting

SHARP: Final = 2e-5
"""Deviation, in sizes of the content, up to which nothing is blurred."""

THIN: Final = 1 / 256
"""Deviation across a direction that is not blurred, as a share of the size of the content."""

ONE_WAY: Final = "a blur in one direction is a little blurred in the other one, too"

MOST_NESTED: Final = 6
"""Most blurs of blurs inside one another."""

MOST_SPENT: Final = 100_000
"""Most paths that the steps of all filters of a drawing may have, those of each step anew."""

FINEST, COARSEST = 8, 5
"""Binary logarithms of the pixels on a side of sampled pictures, of the first few filters and of the last ones."""

MOST_SAMPLED: Final = 40
"""Most filters of a drawing with sampled pictures, which may take about 200,000 texels."""

AT_ONCE: Final = 3
"""Filters with sampled pictures of the same density."""

FARTHEST: Final = 1e6
"""Largest deviation in sizes of the content. Then nothing of it is seen."""


def blur_content(
    content: FilterContent,
    deviations: tuple[float, float],
    region: Box,
    element: str,
    is_linear: bool,
    remarks: dict[str, None],
    sources: "Sources",
) -> FilterContent:
    """Return a content blurred by deviations along x and y; `region` is the part that is seen.

    It is one rectangle, with the name `element`. Of one colour, only the opacity is blurred.
    """
    box = content.box
    if max(deviations) <= 0.0 or box is None:
        return content
    width, height = box[2] - box[0], box[3] - box[1]
    size = max(width, height)
    deviations = (deviations[0] * (deviations[0] > SHARP * size), deviations[1] * (deviations[1] > SHARP * size))
    if max(deviations) <= 0.0:
        return content
    if min(width, height) <= 0.0 or max(deviations) > FARTHEST * size:
        return FilterContent()
    thin = THIN * min(size, max(deviations) * REACH)
    if min(deviations) <= 0.0:
        remarks[ONE_WAY] = None
    across, up = (max(deviation, thin) if deviation <= 0.0 else deviation for deviation in deviations)
    around = (box[0] - REACH * across, box[1] - REACH * up, box[2] + REACH * across, box[3] + REACH * up)
    seen = meeting(around, region)
    if seen is None:
        return FilterContent()
    source = source_of(content, box)
    if not source.paths:
        return FilterContent()
    sources.check(source)
    color = content.color
    (side, _, left), (_, _, top) = source.to_source.tolist()
    to_source: Affine = (1.0 / side, 0.0, -left / side), (0.0, -1.0 / side, top / side)
    window = (
        (seen[0] - left) / side,
        (top - seen[3]) / side,
        (seen[2] - left) / side,
        (top - seen[1]) / side,
    )
    blur = Blur(
        source,
        to_source,
        (across / side, up / side),
        window,
        has_colors=color is None,
        is_linear=color is None and is_linear,
    )
    return flood(seen, Paint(mean_color(content) if color is None else color, blur=blur), element)


def source_of(content: FilterContent, box: Box) -> Drawing:
    """Return the drawing of a content with a box."""
    left, top, right, bottom = box
    drawing = Drawing.from_source(content.paths, (left, top, right - left, bottom - top), groups=content.groups)
    paths, groups = drop_empty_groups(drawing.paths, drawing.groups)
    return Drawing(paths, drawing.to_source, drawing.name, groups=groups, sides=drawing.sides)


def mean_color(content: FilterContent) -> Color:
    """Return the mean of the colours of a content."""
    colors = [path.paint.color for path in content.visible]
    red, green, blue = (sum(color[k] for color in colors) / len(colors) for k in range(3))
    return red, green, blue


def sources_in(drawing: Drawing) -> Iterator[Drawing]:
    """Yield the drawings that paints of a drawing blur or sample."""
    for path in drawing.paths:
        if path.paint.blur is not None:
            yield path.paint.blur.source
        if path.paint.effect is not None:
            yield from path.paint.effect.sources


class Sources:
    """The sources of the blurs of a drawing, with their depth and the number of paths that they take to draw."""

    def __init__(self) -> None:
        self.known: dict[int, tuple[Drawing, int, int]] = {}
        self.sampled: dict[int, tuple[int, object]] = {}  # filters with sampled steps, by identity, with their place
        self.spent = 0  # paths of all steps so far

    def depth_of(self, graph: object) -> int:
        """Return the binary logarithm of the pixels on a side of the sampled pictures of a filter.

        The first filters of a drawing get the most.
        """
        if len(self.sampled) > MOST_SAMPLED:
            raise FilterLimitError(f"more than {MOST_SAMPLED} filters are sampled; use fewer")
        place = self.sampled.setdefault(id(graph), (len(self.sampled), graph))[0]
        return max(FINEST - place // AT_ONCE, COARSEST)

    def spend(self, count: int) -> None:
        """Count paths; raise a `FilterLimitError` if there are too many."""
        self.spent += count
        if self.spent > MOST_SPENT:
            raise FilterLimitError(f"the steps of all filters have {self.spent:,} paths; the limit is {MOST_SPENT:,}")

    def check(self, drawing: Drawing) -> None:
        """Raise a `FilterLimitError` if a source has too many blurs, or too many inside one another."""
        _, depth, count = self.measure(drawing)
        if depth > MOST_NESTED:
            raise FilterLimitError(f"blurs are nested {depth} deep; the limit is {MOST_NESTED}")
        if count > MOST_PATHS:
            raise FilterLimitError(f"blurs in a blur have {count:,} paths; the limit is {MOST_PATHS:,}")

    def measure(self, drawing: Drawing) -> tuple[Drawing, int, int]:
        """Return a drawing with its depth and its number of paths."""
        if id(drawing) not in self.known:
            inner = [self.measure(source) for source in sources_in(drawing)]  # as deep as the limit
            depth = 1 + max((depth for _, depth, _ in inner), default=0)
            self.known[id(drawing)] = drawing, depth, len(drawing.paths) + sum(count for _, _, count in inner)
        return self.known[id(drawing)]
