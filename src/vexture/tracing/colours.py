"""The flat colours of a picture, and the share of each in every pixel.

Pixels are premultiplied by their opacity, (h, w, 4) in 0..255: a pixel on an edge then lies on the straight line
between the two colours beside it, also if one of them is transparent.
"""

from itertools import combinations
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.errors import LimitError

__all__ = ["LEVEL", "Mixture", "background_of", "flat_colours", "mixture", "widened"]

MOST_COLOURS: Final = 24
"""Most colours besides the background."""

LEVEL: Final = 16
"""Levels of 255 by which a border or an area of one colour may vary: noise of JPEG and of scanners."""

APART: Final = 36.0
"""Levels. Colours that are nearer to one another count as one."""

OFF_THE_LINE: Final = 48.0
"""Levels. A pixel that is farther from all mixtures of two colours has a colour of its own."""

UNIFORM: Final = 0.75
"""Share of the border that must have one colour for it to be the background."""

REACH: Final = 3
"""Pixels from an edge within which the colours beside it are searched."""

BETTER: Final = 1.0
"""Levels. Of two mixtures that describe a pixel equally well within this, the one of the nearer colours is taken."""

FEWEST: Final = 4
LEAST: Final = 2e-4
"""Fewest pixels of a colour, and smallest share of the picture for a colour that no area has."""

MOST_BINS: Final = 4096

MOSTLY: Final = 0.5
MOST_UNEXPLAINED: Final = 0.1
"""A picture is a photograph if less than `MOSTLY` of its pixels have a flat colour, or if no mixture of flat colours
describes more than `MOST_UNEXPLAINED` of them."""

MOST_WORK: Final = 40_000_000
"""Most mixtures to try, all pairs of colours for each pixel on an edge: some seconds."""

Image = NDArray[np.float32]
Colours = NDArray[np.float32]


class Mixture(NamedTuple):
    """Two colours of each pixel, by number, and the share of the first; arrays of (h, w)."""

    first: NDArray[np.uint8]
    second: NDArray[np.uint8]
    share: NDArray[np.float32]

    def of(self, colour: int) -> NDArray[np.float32]:
        """Share of a colour in each pixel."""
        share = np.where(self.first == colour, self.share, np.float32(0.0))
        share += np.where(self.second == colour, 1.0 - self.share, np.float32(0.0))
        return share


def widened(mask: NDArray[np.bool_], by: int = 1) -> NDArray[np.bool_]:
    """Mask dilated by a number of pixels, also diagonally."""
    for _ in range(by):
        rows = np.copy(mask)
        rows[1:] |= mask[:-1]
        rows[:-1] |= mask[1:]
        mask = np.copy(rows)
        mask[:, 1:] |= rows[:, :-1]
        mask[:, :-1] |= rows[:, 1:]
    return mask


def background_of(image: Image) -> Colours | None:
    """Colour of the background: transparent if any pixel is, else the colour of the border if that is uniform."""
    if (image[..., 3] < 128.0).any():
        return np.zeros(4, np.float32)
    border = np.concatenate([image[0], image[-1], image[:, 0], image[:, -1]])
    colour = np.median(border, axis=0).astype(np.float32)
    alike: NDArray[np.bool_] = (np.abs(border - colour) <= LEVEL).all(axis=1)
    if alike.mean() < UNIFORM:
        return None
    return np.asarray(np.rint(border[alike].mean(axis=0)), np.float32)


def flat_colours(image: Image, background: Colours | None) -> Colours | None:
    """Colours whose mixtures make up the picture, the background first; None of a photograph, which has too many.

    The colours of areas come first, by frequency, then those that only thin lines have, by distance from the others.
    """
    colours = [] if background is None else [background]
    most = MOST_COLOURS + len(colours)
    flat = _is_flat(image)
    for colour in _binned(image[flat])[0]:
        if len(colours) < most and all(np.linalg.norm(colour - other) > APART for other in colours):
            colours.append(colour)
    everything = _binned(image.reshape(-1, 4))
    if len(everything[0]) > MOST_COLOURS and _share_near(*everything, _stacked(colours)) < MOSTLY:
        return None
    means, counts = _binned(image[~flat], LEAST * flat.size)
    while len(means):
        off = _off_the_lines(means, _stacked(colours))
        unexplained = off > OFF_THE_LINE
        if not unexplained.any():
            break
        if len(colours) >= most:
            if counts[unexplained].sum() > MOST_UNEXPLAINED * flat.size:
                return None
            break
        colours.append(means[int(off.argmax())])
    return np.rint(_stacked(colours))


def _stacked(colours: list[Colours]) -> Colours:
    return np.array(colours, np.float32).reshape(-1, 4)


def _share_near(means: NDArray[np.float32], counts: NDArray[np.intp], colours: Colours) -> float:
    """Share of pixels that have nearly one of the colours."""
    if not len(colours):
        return 0.0
    near = np.linalg.norm(means[:, None] - colours[None], axis=2).min(axis=1) <= APART
    return float(counts[near].sum() / counts.sum())


def _is_flat(image: Image) -> NDArray[np.bool_]:
    """Pixels that differ little from all their neighbours."""
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    high = np.maximum(np.maximum(padded[:-2], padded[1:-1]), padded[2:])
    low = np.minimum(np.minimum(padded[:-2], padded[1:-1]), padded[2:])
    high = np.maximum(np.maximum(high[:, :-2], high[:, 1:-1]), high[:, 2:])
    low = np.minimum(np.minimum(low[:, :-2], low[:, 1:-1]), low[:, 2:])
    return np.asarray((high - low <= LEVEL).all(axis=2), np.bool_)


def _binned(pixels: NDArray[np.float32], least: float = 0.0) -> tuple[NDArray[np.float32], NDArray[np.intp]]:
    """Means of similar colours and the number of pixels of each, by frequency."""
    if not len(pixels):
        return np.empty((0, 4), np.float32), np.empty(0, np.intp)
    step = np.minimum(pixels / 8.0, 31.0).astype(np.int64)
    key = ((step[:, 0] * 32 + step[:, 1]) * 32 + step[:, 2]) * 32 + step[:, 3]
    _, inverse, counts = np.unique(key, return_inverse=True, return_counts=True)
    sums = np.stack([np.bincount(inverse, pixels[:, channel]) for channel in range(4)], axis=1)
    frequent = np.argsort(-counts, kind="stable")[:MOST_BINS]
    frequent = frequent[counts[frequent] >= min(max(FEWEST, least), int(counts.max()))]
    return (sums[frequent] / counts[frequent, None]).astype(np.float32), counts[frequent]


def _off_the_lines(pixels: NDArray[np.float32], colours: Colours) -> NDArray[np.float32]:
    """Distance of each pixel from the nearest mixture of two colours."""
    if not len(colours):
        return np.full(len(pixels), np.inf, np.float32)
    off: NDArray[Any] = np.linalg.norm(pixels[:, None] - colours[None], axis=2).min(axis=1)
    for a, b in combinations(colours, 2):
        off = np.minimum(off, _along(pixels, a, b)[1])
    return np.asarray(off, np.float32)


def _along(pixels: NDArray[np.float32], a: Colours, b: Colours) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Share of `a` in the mixture with `b` that is nearest to each pixel, and the distance to it."""
    way = a - b
    away = pixels - b
    along, length = np.einsum("ij,j", away, way), float(np.einsum("i,i", way, way))
    share = np.clip(along / max(length, 1e-9), 0.0, 1.0).astype(np.float32)
    away -= share[:, None] * way
    return share, np.sqrt(np.einsum("ij,ij->i", away, away), dtype=np.float32)


def mixture(image: Image, colours: Colours) -> Mixture:
    """Colours that each pixel is a mixture of.

    A pixel on an edge is a mixture of the colours of two areas beside it: a gray between black and white is no area of
    gray, even if the picture has such a gray elsewhere. If no such mixture describes it, areas a little farther away
    are tried, and then any colour, for lines too thin to show theirs anywhere.
    """
    first, distance = _nearest(image, colours)
    pure = distance <= APART / 2.0
    pure &= ~_passed_on_the_way(colours, first, pure)
    areas = [pure & (first == number) for number in range(len(colours))]
    beside = np.array([widened(area) for area in areas])
    place = np.flatnonzero(~pure | (beside.sum(axis=0, dtype=np.uint8) > 1))
    pairs = sorted(
        combinations(range(len(colours)), 2),
        key=lambda pair: float(np.linalg.norm(colours[pair[0]] - colours[pair[1]])),
    )
    if len(place) * len(pairs) > MOST_WORK:
        raise LimitError(f"has {len(place):,} pixels on edges of {len(colours)} colours; smooth it, or scale it down")
    beside = beside.reshape(len(colours), -1)[:, place]
    near = np.array([widened(area, REACH).ravel()[place] for area in areas])
    pixels = image.reshape(-1, 4)[place]
    best = np.full(len(place), np.inf, np.float32)
    one, other, part = first.flat[place], first.flat[place], np.ones(len(place), np.float32)
    for number in range(len(colours)):
        away = np.linalg.norm(pixels - colours[number], axis=1)
        closer = near[number] & (away < best)
        best[closer], one[closer], other[closer] = away[closer], number, number
    for around, least, poor in ((beside, 2, 0.0), (near, 2, APART / 2.0), (near, 1, OFF_THE_LINE)):
        sought = best > poor
        for a, b in pairs:
            known = around[a] & around[b] if least == 2 else around[a] | around[b]
            chosen = np.flatnonzero(sought & known)
            share, off = _along(pixels[chosen], colours[a], colours[b])
            closer = off < best[chosen] - BETTER
            chosen = chosen[closer]
            best[chosen], one[chosen], other[chosen], part[chosen] = off[closer], a, b, share[closer]
    second, shares = first.copy(), np.ones(first.shape, np.float32)
    first.flat[place], second.flat[place], shares.flat[place] = one, other, part
    return Mixture(first, second, shares)


def _nearest(image: Image, colours: Colours) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Number of the nearest colour of each pixel, and the distance."""
    number = np.zeros(image.shape[:2], np.uint8)
    least = np.full(image.shape[:2], np.inf, np.float32)
    for place, colour in enumerate(colours):
        away = image - colour
        distance = np.sqrt(np.einsum("ijk,ijk->ij", away, away))
        closer = distance < least
        number[closer], least[closer] = place, distance[closer]
    return number, least


def _solid(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Morphological opening of a mask by a square of 3 x 3 pixels."""
    return widened(~widened(~np.pad(mask, 1, mode="edge")))[1:-1, 1:-1]


def _passed_on_the_way(colours: Colours, first: NDArray[np.uint8], pure: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels of thin areas whose colour is only a mixture of two others beside them."""
    passed = np.zeros_like(pure)
    between: dict[int, list[tuple[int, int]]] = {}
    for number, colour in enumerate(colours):
        others = [other for other in range(len(colours)) if other != number]
        for a, b in combinations(others, 2):
            if _along(colour[None], colours[a], colours[b])[1][0] <= APART:
                between.setdefault(number, []).append((a, b))
    own = [pure & (first == number) for number in range(len(colours))]
    sure = [_solid(mask) if number in between else mask for number, mask in enumerate(own)]
    reach = [widened(mask, 2) for mask in sure]
    for number, pairs in between.items():
        thin = own[number] & ~sure[number]
        for a, b in pairs:
            passed |= thin & reach[a] & reach[b]
    return passed
