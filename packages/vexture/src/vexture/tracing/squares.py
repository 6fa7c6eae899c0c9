"""Pixel art: pictures made of squares; each colour becomes the exact outline of its squares."""

from math import gcd
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.tracing.colours import LEVEL

MOST_CELLS: Final = 64
"""Most squares on the longer side, and four times as many if each one is several pixels wide."""

MOST_INKS: Final = 64
"""Most colours of pixel art."""

STEP: Final = 48.0
"""Difference of neighbours, in levels, above which there is an edge; a pixel between two edges may be a mixture."""

NEAR_THE_LINE: Final = 12.0
"""Largest distance, in levels, of a mixture from the straight line between its two colours."""

MOST_MIXED: Final = 0.12
MOST_MIXED_INKS: Final = 1 / 6
MOST_OPACITIES: Final = 4
"""Limits for pixel art: mixtures as a fraction of the pixels on edges; colours that occur mainly as mixtures, if any,
as a fraction of all; and opacities of translucent colours. Smooth edges exceed them, as measured on drawings of 12
to 64 pixels."""

SOME: Final = 64
"""Rows and columns of a sample of the pixels."""

Pixels = NDArray[np.uint8]


def cells_of(pixels: Pixels) -> Pixels | None:
    """Return the squares of pixel art, (rows, columns, 4) of sRGB and opacity; None for any other picture.

    Pixel art has few colours. Either it is small and has no smooth edges, or each of its squares is several pixels
    wide.
    """
    some = pixels[:: max(pixels.shape[0] // SOME, 1), :: max(pixels.shape[1] // SOME, 1)]
    if len(np.unique(visible_colours(some).reshape(-1, 4).view(np.uint32))) > MOST_INKS:  # most photographs end here
        return None
    pixels = visible_colours(pixels)
    times = _times(pixels)
    cells = pixels[::times, ::times]
    if _is_gradual(cells):
        return None
    if max(cells.shape[:2]) > (MOST_CELLS if times == 1 else 4 * MOST_CELLS):
        return None
    if len(np.unique(cells.reshape(-1, 4), axis=0)) > MOST_INKS:
        return None
    return cells if times > 1 or not _has_smooth_edges(cells) else None


def visible_colours(pixels: Pixels) -> Pixels:
    """Return pixels in which those that are invisible have no colour."""
    return np.where(pixels[..., 3:] > 0, pixels, np.uint8(0))


def _is_gradual(cells: Pixels) -> bool:
    """Return whether most of the squares that differ from a neighbour differ only slightly."""
    levels = cells.astype(np.int16)
    steps = [np.abs(levels[1:] - levels[:-1]), np.abs(levels[:, 1:] - levels[:, :-1])]
    largest = np.concatenate([step.max(axis=2).ravel() for step in steps])
    return bool(largest.any() and np.median(largest[largest > 0]) <= LEVEL)


def _times(pixels: Pixels) -> int:
    """Return the largest side of squares of one colour that make up the picture."""
    across = (pixels[:, 1:] != pixels[:, :-1]).any(axis=(0, 2))
    down = (pixels[1:] != pixels[:-1]).any(axis=(1, 2))
    places = (int(place) + 1 for change in (across, down) for place in np.flatnonzero(change))
    return gcd(*pixels.shape[:2], *places)


def _has_smooth_edges(cells: Pixels) -> bool:
    """Return whether edges run through pixels, which then have mixed colours."""
    values = cells.astype(np.float32)
    values[..., :3] *= values[..., 3:] / 255.0
    mixed, edge = (np.zeros(cells.shape[:2], np.bool_) for _ in range(2))
    for own, is_mixed, is_edge in ((values, mixed, edge), (np.swapaxes(values, 0, 1), mixed.T, edge.T)):
        is_step = np.linalg.norm(own[1:] - own[:-1], axis=2) > STEP
        is_edge[1:] |= is_step
        is_edge[:-1] |= is_step
        is_mixed[1:-1] |= _is_between(own[1:-1], own[:-2], own[2:])
    _, ink, count = np.unique(cells.reshape(-1, 4), axis=0, return_inverse=True, return_counts=True)
    often = np.bincount(ink.ravel(), mixed.ravel(), len(count))
    only_mixed = often > 0.5 * count
    opacities = np.unique(cells[..., 3])
    return bool(
        often[only_mixed].sum() > MOST_MIXED * edge.sum()
        or only_mixed.sum() > max(1.0, MOST_MIXED_INKS * len(count))
        or ((opacities > 0) & (opacities < 255)).sum() > MOST_OPACITIES
    )


def _is_between(colour: NDArray[np.float32], a: NDArray[np.float32], b: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Return whether a colour is a mixture of two others that differ from it and from each other."""
    way, away = b - a, colour - a
    length = np.linalg.norm(way, axis=2)
    share = (away * way).sum(axis=2) / np.maximum(length * length, 1e-9)
    off = np.linalg.norm(away - share[..., None] * way, axis=2)
    return np.asarray((length > STEP) & (off <= NEAR_THE_LINE) & (np.abs(share - 0.5) < 0.4), np.bool_)


def squares_document(cells: Pixels, background: NDArray[np.float32] | None, whole: bool) -> tuple[bytes, bool]:
    """Return the SVG of all colours, large areas first, and whether the picture has a background.

    `background` is premultiplied, 0..255; if it is None, the lighter of two colours is the background. The background
    is left out. With `whole`, only transparent pixels are left out.
    """
    inks, number, count = np.unique(cells.reshape(-1, 4), axis=0, return_inverse=True, return_counts=True)
    number = number.reshape(cells.shape[:2])
    levels = inks.astype(np.float32)
    levels[:, :3] *= levels[:, 3:] / 255.0
    left_out = set()
    if background is not None:
        off = np.abs(levels - background).max(axis=1)
        left_out = {int(off.argmin())} if off.min() <= LEVEL else set()
    elif len(inks) == 2:
        left_out = {int(levels.sum(axis=1).argmax())}
    hidden = {ink for ink in range(len(inks)) if inks[ink, 3] == 0 or (ink in left_out and not whole)}
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {cells.shape[1]} {cells.shape[0]}">']
    for ink in np.argsort(-count, kind="stable").tolist():
        if ink not in hidden:
            red, green, blue, opacity = inks[ink].tolist()
            paint = f'fill="#{red:02x}{green:02x}{blue:02x}" fill-opacity="{opacity / 255.0}"'
            lines.append(f'<path {paint} d="{squares(number == ink)}"/>')
    return "\n".join([*lines, "</svg>"]).encode(), background is not None or bool(left_out)


def squares(mask: NDArray[np.bool_]) -> str:
    """Return the outline of cells as SVG path data, with each side once; the inside is where it winds clockwise.

    Sides have the cells to their right. If two cells touch only at a corner, the outline turns right and separates
    them.

    Examples
    --------
    >>> squares(np.array([[True, True], [True, False]]))
    'M0 0H2V1H1V2H0Z'
    """
    ahead = _sides(mask)
    parts = []
    while ahead:
        first = (point, heading) = next(iter(ahead))  # at a corner, the leftmost of those to the right
        data = f"M{point[0]} {point[1]}"
        while (point, heading) in ahead:
            point_at = ahead.pop((point, heading))
            turns = ((heading + turn) % 4 for turn in (1, 0, -1))
            following = next((way for way in turns if (point_at, way) in ahead or (point_at, way) == first), heading)
            if following != heading and (point_at, following) != first:
                data += f"V{point_at[1]}" if heading % 2 else f"H{point_at[0]}"
            point, heading = point_at, following
        parts.append(data + "Z")
    return "".join(parts)


def _sides(mask: NDArray[np.bool_]) -> dict[tuple[tuple[int, int], int], tuple[int, int]]:
    """Return the ends of all sides between cells and non-cells, by start and heading: right, down, left, up."""
    cells = np.pad(mask, 1)
    inside = cells[1:-1, 1:-1]
    outside = (~cells[:-2, 1:-1], ~cells[1:-1, 2:], ~cells[2:, 1:-1], ~cells[1:-1, :-2])
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    sides = {}
    for heading, beyond in enumerate(outside):
        (x, y), (right, down) = corners[heading], corners[(heading + 1) % 4]
        for row, column in np.argwhere(inside & beyond).tolist():
            sides[(column + x, row + y), heading] = (column + right, row + down)
    return sides
