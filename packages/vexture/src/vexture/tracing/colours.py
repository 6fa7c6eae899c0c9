"""The flat colours of a picture.

Pixels are premultiplied by their opacity, (h, w, 4) in 0..255. A pixel on an edge then lies on the straight line
between the two adjacent colours, even if one of them is transparent.
"""

from itertools import combinations
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

MOST_COLOURS: Final = 24
"""Most colours besides the background."""

LEVEL: Final = 16
"""Largest variation, in levels of 255, of a border or an area of one colour: noise of JPEG and of scanners."""

APART: Final = 36.0
"""Least distance, in levels, between colours; closer ones count as one."""

OFF_THE_LINE: Final = 48.0
"""Distance, in levels, from all mixtures of two colours above which a pixel has a colour of its own."""

UNIFORM: Final = 0.75
"""Fraction of the border that must have one colour if that is the background."""

FEWEST: Final = 4
LEAST: Final = 2e-4
"""Fewest pixels of a colour, and least fraction of the picture for a colour that has no area."""

MOST_BINS: Final = 4096

MOSTLY: Final = 0.5
MOST_UNEXPLAINED: Final = 0.1
"""Limits for photographs. A picture is one if less than `MOSTLY` of its pixels are shaded or have a flat colour, or if
more than `MOST_UNEXPLAINED` of them are not mixtures of these."""

NOISE_ROWS: Final = 64
"""Rows above and below the middle of an area in which its noise is measured."""

Image = NDArray[np.float32]
Colours = NDArray[np.float32]


def background_of(image: Image) -> Colours | None:
    """Return the background colour: transparent if any pixel is, else the colour of the border if that is uniform."""
    if (image[..., 3] < 128.0).any():
        return np.zeros(4, np.float32)
    border = np.concatenate([image[0], image[-1], image[:, 0], image[:, -1]])
    colour = np.median(border, axis=0).astype(np.float32)
    alike: NDArray[np.bool_] = (np.abs(border - colour) <= LEVEL).all(axis=1)
    if alike.mean() < UNIFORM:
        return None
    return np.asarray(np.rint(border[alike].mean(axis=0)), np.float32)


def flat_colours(
    image: Image, background: Colours | None, is_shaded: NDArray[np.bool_], shades: Colours
) -> Colours | None:
    """Return the colours whose mixtures make up the picture, the background first; None for a photograph.

    The colours of areas come first, by frequency, then those of thin lines only, by distance from the others. Shaded
    pixels have none of these colours, and their neighbours may be mixtures with a colour of `shades`.
    """
    colours = [] if background is None else [background]
    most = MOST_COLOURS + len(colours)
    flat = is_flat(image) & ~is_shaded
    for colour in bin_colours(image[flat])[0]:
        if len(colours) < most and all(np.linalg.norm(colour - other) > APART for other in colours):
            colours.append(colour)
    everything = bin_colours(image[~is_shaded])
    if len(everything[0]) > MOST_COLOURS:
        near = _share_near(*everything, _stack(colours)) * (flat.size - is_shaded.sum())
        if near + is_shaded.sum() < MOSTLY * flat.size:
            return None
    means, counts = bin_colours(image[~flat & ~is_shaded], LEAST * flat.size)
    off = _off_the_lines(means, np.concatenate([_stack(colours), shades]))
    while len(means) and (off > OFF_THE_LINE).any():
        if len(colours) >= most:
            if counts[off > OFF_THE_LINE].sum() > MOST_UNEXPLAINED * flat.size:
                return None
            break
        found = means[int(off.argmax())]
        for other in (found, *colours, *shades):
            off = np.minimum(off, along(means, found, other)[1])
        colours.append(found)
    return np.rint(_stack(colours))


def _stack(colours: list[Colours]) -> Colours:
    return np.array(colours, np.float32).reshape(-1, 4)


def _share_near(means: NDArray[np.float32], counts: NDArray[np.intp], colours: Colours) -> float:
    """Return the fraction of pixels that are close to one of the colours."""
    if not len(colours):
        return 0.0
    near = np.linalg.norm(means[:, None] - colours[None], axis=2).min(axis=1) <= APART
    return float(counts[near].sum() / counts.sum())


def is_flat(image: Image) -> NDArray[np.bool_]:
    """Return a mask of the pixels that differ little from all their neighbours."""
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    high = np.maximum(np.maximum(padded[:-2], padded[1:-1]), padded[2:])
    low = np.minimum(np.minimum(padded[:-2], padded[1:-1]), padded[2:])
    high = np.maximum(np.maximum(high[:, :-2], high[:, 1:-1]), high[:, 2:])
    low = np.minimum(np.minimum(low[:, :-2], low[:, 1:-1]), low[:, 2:])
    return np.asarray((high - low <= LEVEL).all(axis=2), np.bool_)


def bin_colours(pixels: NDArray[np.float32], least: float = 0.0) -> tuple[NDArray[np.float32], NDArray[np.intp]]:
    """Return the means of similar colours and the number of pixels of each, by frequency."""
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
    """Return the distance of each pixel from the nearest mixture of two colours."""
    if not len(colours):
        return np.full(len(pixels), np.inf, np.float32)
    off: NDArray[Any] = np.linalg.norm(pixels[:, None] - colours[None], axis=2).min(axis=1)
    for a, b in combinations(colours, 2):
        off = np.minimum(off, along(pixels, a, b)[1])
    return np.asarray(off, np.float32)


def along(pixels: NDArray[np.float32], a: Colours, b: Colours) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the fraction of `a` in the mixture with `b` that is nearest to each pixel, and the distance to it.

    Each of the two is one colour, or one for each pixel.
    """
    way = a - b
    away = pixels - b
    length = np.einsum("...j,...j", way, way)
    onto = np.einsum("ij,j->i" if way.ndim == 1 else "ij,ij->i", away, way)
    share = np.clip(onto / np.maximum(length, 1e-9), 0.0, 1.0).astype(np.float32)
    away -= share[:, None] * way
    return share, np.sqrt(np.einsum("ij,ij->i", away, away), dtype=np.float32)


def smooth(image: Image, area: NDArray[np.bool_]) -> Image:
    """Return the means of an area's pixels over each pixel and its neighbours in the area."""
    weight = area.astype(np.float32)[..., None]
    values = np.concatenate([image * weight, weight], axis=2)
    for axis in (0, 1):
        padded = np.pad(values, [(1, 1) if axis == other else (0, 0) for other in range(3)])
        size = values.shape[axis]
        values = np.add.reduce([np.take(padded, np.arange(by, by + size), axis) for by in range(3)])
    return np.asarray(values[..., :4] / np.maximum(values[..., 4:], 1.0), np.float32)


def noise(image: Image, area: NDArray[np.bool_]) -> float:
    """Return the mean difference of an area's pixels from the means of their neighbours, in rows around its middle."""
    rows = np.flatnonzero(area.any(axis=1))
    middle = int(rows[len(rows) // 2])
    box = slice(max(middle - NOISE_ROWS, 0), middle + NOISE_ROWS + 1)
    off = np.abs(smooth(image[box], area[box]) - image[box])[area[box]]
    return float(off.max(axis=1).mean())


def dilate(mask: NDArray[np.bool_], by: int = 1) -> NDArray[np.bool_]:
    """Dilate a mask by a number of pixels, including diagonals."""
    for _ in range(by):
        rows = np.copy(mask)
        rows[1:] |= mask[:-1]
        rows[:-1] |= mask[1:]
        mask = np.copy(rows)
        mask[:, 1:] |= rows[:, :-1]
        mask[:, :-1] |= rows[:, 1:]
    return mask
