"""Areas of a picture whose colour changes smoothly: gradients if possible, otherwise steps of colour.

There is no edge where neighbours hardly differ, and a flat colour stays constant over such an area. An area whose
colour does not is shaded.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.tracing.colours import Colours, Image, bin_colours, dilate, is_flat, noise, smooth
from vexture.tracing.fades import Fade, fade_of

SHADED: Final = 16.0
NOISES: Final = 12.0
USUAL: Final = (0.04, 0.96)
"""Least range of colours in a shaded area, between these two quantiles, in levels of 255: a constant plus a multiple of
the noise, which is large at the edges of a JPEG."""

STEEP: Final = 64.0
BENT: Final = 5.0
"""Limits in levels for a pixel of a shaded area: for the difference of its neighbours, and for twice its own difference
from their mean. An edge, even a blurred one, exceeds one of them."""

LEAST_AREA: Final = 64
LEAST_PART: Final = 0.004
"""Fewest pixels of a shaded area, and its least fraction of the picture; smaller ones are JPEG noise, or invisible."""

MOST_AREAS: Final = 64
"""Most gradients of a picture, for its largest shaded areas; the others are drawn in steps."""

GROWTH: Final = 12
ALIKE: Final = 8.0
"""Pixels by which a shaded area may grow, such as over JPEG noise at edges, and the largest difference, in levels, of
these pixels from its steps."""

LIKE_BACKGROUND: Final = 1.0
NEAR_BACKGROUND: Final = 2.5
"""Largest differences, in levels, of a pixel and of its tone from the background if it belongs to that. A gradient that
ends in the background has a ragged end in pixels; the detected gradient has a smooth end inside it."""

STEP: Final = 2.5
MOST_STEPS: Final = 64
MOST_SOFT_STEPS: Final = 24
"""Limits for colours drawn in steps: root mean square error in levels, and number of steps, which is lower for
translucent colours, since each one shows through all those painted over it."""

ROUNDS: Final = 4
"""Rounds in which each colour moves to the mean of its nearest pixels."""

TRANSLUCENT: Final = 250.0
"""Least opacity, in levels, of colours that count as opaque."""

NONE_HERE: Final = -1
"""Number of an unknown tone."""


class Tone(NamedTuple):
    """The paint of an area: a premultiplied colour, or a gradient and its mean."""

    colour: Colours
    fade: Fade | None = None

    @property
    def is_opaque(self) -> bool:
        """True if nothing shows through it."""
        opacities = self.colour[3] if self.fade is None else self.fade.colours[:, 3]
        return bool(np.min(opacities) >= TRANSLUCENT)

    def at(self, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> Colours:
        """Return the premultiplied colour of pixels, (4,) or (pixels, 4)."""
        return self.colour if self.fade is None else self.fade.at(columns + 0.5, rows + 0.5)


class Shading(NamedTuple):
    """Tones of the shaded areas; for each pixel, (h, w), its tone's number, and whether there is no edge around it."""

    tones: tuple[Tone, ...]
    number: NDArray[np.int16]
    even: NDArray[np.bool_]

    @property
    def samples(self) -> Colours:
        """Colours of the shading, for gradients those of their stops."""
        found = [tone.colour[None] if tone.fade is None else tone.fade.along(tone.fade.offsets) for tone in self.tones]
        return np.concatenate([np.empty((0, 4)), *found]).astype(np.float32)


def shading_of(image: Image, background: Colours | None) -> Shading:
    """Find the shaded areas of a premultiplied picture: first even changes (gradients), then slow changes."""
    flat = is_flat(image)
    even = flat | _is_even(image)
    own = even if background is None else even & _differs(image, background, LIKE_BACKGROUND)
    number = np.full(even.shape, NONE_HERE, np.int16)
    tones: list[Tone] = []
    left = np.zeros_like(even)
    wide = pieces(own)
    for piece in (wide, pieces(own & flat)):
        for area in _shaded_areas(image, piece):
            area &= number == NONE_HERE
            fade = fade_of(image, area) if len(tones) < MOST_AREAS and area.sum() >= LEAST_AREA else None
            if fade is not None:
                _number(number, len(tones), image, area, fade, background)
                tones.append(Tone(image[area].mean(axis=0), fade))
            elif piece is not wide:
                left |= np.isin(wide, np.unique(wide[area]))
    left &= own & (number == NONE_HERE)
    if left.any():
        steps = steps_of(image[left], MOST_STEPS if (image[left, 3] >= TRANSLUCENT).all() else MOST_SOFT_STEPS)
        free = number == NONE_HERE
        if background is not None:
            free &= _differs(image, background, NEAR_BACKGROUND)
            steps = steps[_differs(steps, background, NEAR_BACKGROUND)]
        if len(steps):
            _number_steps(number, len(tones), np.where(left[..., None], smooth(image, left), image), left, free, steps)
        tones += [Tone(colour) for colour in steps]
    return Shading(tuple(tones), number, even)


def _number_steps(
    number: NDArray[np.int16],
    first: int,
    image: Image,
    area: NDArray[np.bool_],
    free: NDArray[np.bool_],
    steps: Colours,
) -> None:
    """Number the pixels of an area drawn in steps, and pixels around it with nearly the same colours."""
    around = area | (dilate(area, GROWTH) & free)
    values = image[around]
    which = nearest(values, steps)
    alike = np.zeros_like(area)
    alike[around] = np.linalg.norm(values - steps[which], axis=1) <= ALIKE
    grown = area
    for _ in range(GROWTH):
        grown = area | (dilate(grown) & alike)
    number[around] = np.where(grown[around], first + which, number[around])


def _number(
    number: NDArray[np.int16], tone: int, image: Image, area: NDArray[np.bool_], fade: Fade, background: Colours | None
) -> None:
    """Number the pixels of a gradient: those of its area, and those around it with its colours."""
    box = tuple(
        slice(max(int(found[0]) - GROWTH, 0), int(found[-1]) + 1 + GROWTH)
        for found in (np.flatnonzero(area.any(axis=1)), np.flatnonzero(area.any(axis=0)))
    )
    shown, grown, pixels = number[box], area[box], image[box]
    rows, columns = np.indices(grown.shape)
    levels = fade.at(columns.ravel() + box[1].start + 0.5, rows.ravel() + box[0].start + 0.5).reshape(pixels.shape)
    alike = (shown == NONE_HERE) & ~_differs(pixels, levels, fade.off)
    for _ in range(GROWTH):
        grown = grown | (dilate(grown) & alike)
    if background is not None:
        grown = grown & _differs(levels, background, NEAR_BACKGROUND)
    shown[grown] = tone


def _differs(colours: Colours, others: Colours, by: float) -> NDArray[np.bool_]:
    """Return whether colours, in the last axis, differ from others in any channel."""
    return np.asarray((np.abs(colours - others) > by).any(axis=-1), np.bool_)


def _is_even(image: Image) -> NDArray[np.bool_]:
    """Return a mask of the pixels around which the colour changes evenly."""
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="reflect", reflect_type="odd")  # the border is extrapolated
    height, width = image.shape[:2]
    even = np.ones((height, width), np.bool_)
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        before = padded[1 - down : 1 - down + height, 1 - right : 1 - right + width]
        after = padded[1 + down : 1 + down + height, 1 + right : 1 + right + width]
        even &= (np.abs(after - before) <= STEEP).all(axis=2)
        even &= (np.abs(after + before - 2.0 * image) <= BENT).all(axis=2)
    return even


def pieces(mask: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Number the connected pieces of a mask, by sides; 0 is outside, and numbers from 1 may have gaps.

    Runs in rows are joined with those that they touch below, until all runs of a piece have one number.
    """
    padded = np.pad(mask, ((0, 0), (1, 0)))
    begins = padded[:, 1:] & ~padded[:, :-1]
    run = np.where(mask, np.cumsum(begins.ravel()).reshape(mask.shape), 0)
    both = mask[1:] & mask[:-1]
    above, below = run[:-1][both], run[1:][both]
    again = (above[1:] == above[:-1]) & (below[1:] == below[:-1])
    once = np.concatenate([np.ones(min(1, len(above)), np.bool_), ~again])
    above, below = above[once], below[once]
    parent = np.arange(int(run.max()) + 1 if run.size else 1)
    while True:
        least = np.minimum(parent[above], parent[below])
        if (parent[above] == parent[below]).all():
            return np.asarray(parent[run], np.intp)
        np.minimum.at(parent, parent[above], least)
        np.minimum.at(parent, parent[below], least)
        while (parent[parent] != parent).any():
            parent = parent[parent]


def _shaded_areas(image: Image, piece: NDArray[np.intp]) -> Iterator[NDArray[np.bool_]]:
    """Yield the areas with varying colours, the largest first."""
    count = np.bincount(piece.ravel())
    count[0] = 0
    order = np.argsort(piece, axis=None, kind="stable")
    starts = np.cumsum(np.concatenate([[0], np.bincount(piece.ravel())]))
    pixels = image.reshape(-1, 4)
    for number in np.argsort(-count, kind="stable").tolist():
        if count[number] < max(LEAST_AREA, LEAST_PART * piece.size):
            break
        places = order[starts[number] : starts[number + 1]]
        low, high = np.quantile(pixels[places], USUAL, axis=0)
        if (high - low).max() > SHADED:
            area = np.zeros(piece.shape, np.bool_)
            area.flat[places] = True
            if (high - low).max() > SHADED + NOISES * noise(image, area):
                yield area


def steps_of(pixels: Colours, most: int) -> Colours:
    """Reduce many colours to few: split the worst group until the error is small or there are `most` colours."""
    means, counts = bin_colours(pixels)
    group = np.zeros(len(means), np.intp)
    spread = [_spread(means, counts)]
    while len(spread) < most and sum(spread) > STEP * STEP * counts.sum():
        worst = int(np.argmax(spread))
        own = np.flatnonzero(group == worst)
        middle = np.average(means[own], axis=0, weights=counts[own])
        away = means[own] - middle
        axis = np.linalg.eigh(np.einsum("n,ni,nj->ij", counts[own], away, away))[1][:, -1]
        beyond = away @ axis > 0.0
        if beyond.all() or not beyond.any():
            break
        group[own[beyond]] = len(spread)
        spread[worst] = _spread(means[own[~beyond]], counts[own[~beyond]])
        spread.append(_spread(means[own[beyond]], counts[own[beyond]]))
    for _ in range(ROUNDS):
        sums = np.stack([np.bincount(group, counts * means[:, channel]) for channel in range(4)], axis=1)
        weights = np.bincount(group, counts)
        steps = (sums[weights > 0] / weights[weights > 0, None]).astype(np.float32)
        group = nearest(means, steps)
    return steps


def _spread(means: Colours, counts: NDArray[np.intp]) -> float:
    """Return the sum of the squared distances of colours from their mean."""
    away = means - np.average(means, axis=0, weights=counts)
    return float((counts * np.einsum("ni,ni->n", away, away)).sum())


def nearest(pixels: Colours, colours: Colours) -> NDArray[np.intp]:
    """Return the number of the nearest colour of each pixel."""
    best, least = np.zeros(len(pixels), np.intp), np.full(len(pixels), np.inf, np.float32)
    for number, colour in enumerate(colours):
        away = pixels - colour
        distance = np.einsum("ni,ni->n", away, away)
        closer = distance < least
        best[closer], least[closer] = number, distance[closer]
    return best
