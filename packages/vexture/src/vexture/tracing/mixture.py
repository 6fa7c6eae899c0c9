"""The two tones that mix in each pixel, and their shares.

Pixels are premultiplied by their opacity, (h, w, 4) in 0..255, as in `colours`.
"""

from itertools import combinations
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.tracing.colours import APART, OFF_THE_LINE, Colours, Image, along, dilate
from vexture.tracing.shading import NONE_HERE, Shading, Tone

REACH: Final = 3
"""Distance from an edge, in pixels, within which its colours are searched."""

BETTER: Final = 1.0
"""Difference in levels within which two mixtures describe a pixel equally well; the nearer colours are then taken."""

KERNEL: Final = (1 / 16, 4 / 16, 6 / 16, 4 / 16, 1 / 16)
"""Weights of the pixels in a row for the average where tones blend."""

MOST_WORK: Final = 40_000_000
"""Most mixtures to try, for all pairs of colours and all pixels on edges: some seconds."""


class Mixture(NamedTuple):
    """Two tones of each pixel, by number, and the share of the first; arrays of (h, w).

    Where tones blend, each pixel has only one. An outline along such pixels would have steps, so shares are averaged
    over a few pixels.
    """

    first: NDArray[np.int16]
    second: NDArray[np.int16]
    share: NDArray[np.float32]
    soft: NDArray[np.bool_]  # where tones blend, without an edge

    def of(self, *tones: int) -> NDArray[np.float32]:
        """Return the share of some tones in each pixel."""
        chosen = np.zeros(1 + max(int(self.first.max()), int(self.second.max()), *tones), np.float32)
        chosen[list(tones)] = 1.0
        share = np.asarray(chosen[self.first] * self.share + chosen[self.second] * (1.0 - self.share), np.float32)
        inside = np.argwhere(share > 0.0)
        if not len(inside) or not self.soft.any():
            return share
        (top, left), (bottom, right) = inside.min(axis=0), inside.max(axis=0) + 1 + len(KERNEL)
        box = (slice(max(top - len(KERNEL), 0), bottom), slice(max(left - len(KERNEL), 0), right))
        share[box] = np.where(self.soft[box], _blur(share[box]), share[box])
        return share


def _blur(share: NDArray[np.float32]) -> NDArray[np.float32]:
    """Average the pixels around each one, with the weights `KERNEL`."""
    for axis in (0, 1):
        size, reach = share.shape[axis], len(KERNEL) // 2
        padded = np.pad(share, [(reach, reach) if axis == other else (0, 0) for other in (0, 1)], mode="edge")
        share = np.add.reduce([w * np.take(padded, np.arange(by, by + size), axis) for by, w in enumerate(KERNEL)])
    return np.asarray(share, np.float32)


def mixture(image: Image, flat: Colours, shading: Shading) -> Mixture:
    """Return the tones that mix in each pixel, from the flat colours and then those of the shaded areas.

    A pixel on an edge is a mixture of the tones of two adjacent areas: a grey between black and white is not a grey
    area, even if the picture has such a grey elsewhere. If no such mixture describes it, areas a little farther away
    are tried, and then any tone, for lines too thin to show their own colour anywhere.
    """
    first, distance = _nearest(image, flat)
    is_shaded = shading.number != NONE_HERE
    first[is_shaded] = len(flat) + shading.number[is_shaded]
    pure = is_shaded | (distance <= APART / 2.0)
    pure &= ~_passed_on_the_way(flat, first, pure)
    area = np.where(pure, first, NONE_HERE).astype(np.int16)
    rows, columns = place = np.nonzero(~is_shaded & (~pure | _is_border(area)))
    tones = (*(Tone(colour) for colour in flat), *shading.tones)
    colour_of = [tone.at(rows, columns) for tone in tones]
    if len(rows) * len(flat) * (len(flat) - 1) // 2 > MOST_WORK:
        raise LimitError(f"has {len(rows):,} pixels on edges of {len(flat)} colours; smooth it, or scale it down")
    beside, near = _around(area, rows, columns, len(tones), 1), _around(area, rows, columns, len(tones), REACH)
    pixels = image[place]
    best = np.full(len(rows), np.inf, np.float32)
    one, other, part = first[place], first[place], np.ones(len(rows), np.float32)
    for number, colour in enumerate(colour_of):
        away = np.linalg.norm(pixels - colour, axis=1)
        closer = near[number] & (away < best)
        best[closer], one[closer], other[closer] = away[closer], number, number
    pairs = _pairs(tones)
    for around, least, poor in ((beside, 2, 0.0), (near, 2, APART / 2.0), (near, 1, OFF_THE_LINE)):
        sought = np.flatnonzero(best > poor)
        here = around[:, sought]
        together = here.astype(np.float32) @ here.T.astype(np.float32)
        for a, b in pairs:
            if least == 2 and not together[a, b]:
                continue
            chosen = sought[here[a] & here[b] if least == 2 else here[a] | here[b]]
            share, off = along(pixels[chosen], _at(colour_of[a], chosen), _at(colour_of[b], chosen))
            closer = off < best[chosen] - BETTER
            chosen = chosen[closer]
            best[chosen], one[chosen], other[chosen], part[chosen] = off[closer], a, b, share[closer]
    second, shares = first.copy(), np.ones(first.shape, np.float32)
    first[place], second[place], shares[place] = one, other, part
    return Mixture(first, second, shares, shading.even & dilate(is_shaded, len(KERNEL) // 2))


def _pairs(tones: tuple[Tone, ...]) -> list[tuple[int, int]]:
    """Return all pairs of tones, the nearest first."""

    def apart(pair: tuple[int, int]) -> float:
        return float(np.linalg.norm(tones[pair[0]].colour - tones[pair[1]].colour))

    return sorted(combinations(range(len(tones)), 2), key=apart)


def _at(colour: Colours, chosen: NDArray[np.intp]) -> Colours:
    """Return a colour, or those of some pixels."""
    return colour if colour.ndim == 1 else colour[chosen]


def _is_border(area: NDArray[np.int16]) -> NDArray[np.bool_]:
    """Return a mask of the pixels near two or more areas."""
    low = np.where(area == NONE_HERE, np.iinfo(np.int16).max, area)
    high = area
    for axis in (0, 1):
        size = area.shape[axis]
        around = [np.arange(size), np.maximum(np.arange(size) - 1, 0), np.minimum(np.arange(size) + 1, size - 1)]
        low = np.minimum.reduce([np.take(low, which, axis) for which in around])
        high = np.maximum.reduce([np.take(high, which, axis) for which in around])
    return np.asarray((high != NONE_HERE) & (low != high), np.bool_)


def _around(
    area: NDArray[np.int16], rows: NDArray[np.intp], columns: NDArray[np.intp], count: int, reach: int
) -> NDArray[np.bool_]:
    """Return for each area whether it has a pixel within `reach` of given pixels, including diagonals."""
    found = np.zeros((count + 1, len(rows)), np.bool_)  # the last row is for unknown areas
    padded = np.pad(area, reach, constant_values=NONE_HERE)
    each = np.arange(len(rows))
    for down in range(2 * reach + 1):
        for right in range(2 * reach + 1):
            found[padded[rows + down, columns + right], each] = True
    return found[:-1]


def _nearest(image: Image, colours: Colours) -> tuple[NDArray[np.int16], NDArray[np.float32]]:
    """Return the number of the nearest colour of each pixel, and the distance."""
    number = np.zeros(image.shape[:2], np.int16)
    least = np.full(image.shape[:2], np.inf, np.float32)
    for place, colour in enumerate(colours):
        away = image - colour
        distance = np.sqrt(np.einsum("ijk,ijk->ij", away, away))
        closer = distance < least
        number[closer], least[closer] = place, distance[closer]
    return number, least


def _solid(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the morphological opening of a mask by a square of 3 x 3 pixels."""
    return dilate(~dilate(~np.pad(mask, 1, mode="edge")))[1:-1, 1:-1]


def _passed_on_the_way(colours: Colours, first: NDArray[np.int16], pure: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return a mask of thin areas whose colour is only a mixture of two adjacent colours."""
    passed = np.zeros_like(pure)
    between: dict[int, list[tuple[int, int]]] = {}
    for number, colour in enumerate(colours):
        others = [other for other in range(len(colours)) if other != number]
        for a, b in combinations(others, 2):
            if along(colour[None], colours[a], colours[b])[1][0] <= APART:
                between.setdefault(number, []).append((a, b))
    own = [pure & (first == number) for number in range(len(colours))]
    sure = [_solid(mask) if number in between else mask for number, mask in enumerate(own)]
    reach = [dilate(mask, 2) for mask in sure]
    for number, pairs in between.items():
        thin = own[number] & ~sure[number]
        for a, b in pairs:
            passed |= thin & reach[a] & reach[b]
    return passed
