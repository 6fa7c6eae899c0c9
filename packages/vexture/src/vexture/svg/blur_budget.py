"""Sizes of the grids of blurs: parts that are not seen are left out, and all together fit a budget."""

from collections.abc import Hashable, Sequence
from dataclasses import replace
from heapq import heapify, heappop, heappush
from itertools import count
from math import ceil
from typing import Final

import numpy as np

from vexture.drawing.blur import SPACING, Blur, Window
from vexture.drawing.drawing import Path
from vexture.svg.report import Report

MOST_TEXELS: Final = 60_000
"""Most texels of the grids of one drawing, with all their levels: 0.9 MiB. One index numbers the blocks of each."""

WIDER: Final = 1.25
"""Factor of the deviation of a blur that is too large."""

MOST_WIDER: Final = 256.0
"""Largest product of such factors. A blur beyond is left out."""

OPACITIES, COLORS = 16, 4
"""Coefficients in a texel."""

EDGE: Final = 1e-9
"""Part of the source that a window extends beyond what is seen, against rounding."""

Key = tuple[Hashable, ...]


def fit_blurs(paths: Sequence[Path], report: Report) -> tuple[Path, ...]:
    """Cut the windows of blurs to what is seen of them, and widen the largest blurs until all fit; note those."""
    windows: dict[Key, Window] = {}
    blurs: dict[Key, Blur] = {}
    for path in paths:
        blur = path.paint.blur
        window = None if blur is None else seen_window(path, blur)
        if blur is not None and window is not None:
            key = key_of(blur)
            windows[key] = around(windows.get(key, window), window)
            blurs[key] = blur
    factors = factors_of({key: replace(blur, window=windows[key]) for key, blur in blurs.items()})
    for reason in ("widened", "left out"):
        number = sum((factor > MOST_WIDER) == (reason == "left out") and factor > 1.0 for factor in factors.values())
        if number:
            limit = f"the blurs of a drawing take at most {MOST_TEXELS:,} texels"
            report.simplification(f"{number:,} of {len(blurs):,} blurs {reason} ({limit}; draw fewer or smaller ones)")
    fitted = []
    for path in paths:
        blur = path.paint.blur
        if blur is not None:
            key = key_of(blur)
            if seen_window(path, blur) is None or factors[key] > MOST_WIDER:
                if blur.is_inverted and key not in factors:
                    fitted.append(replace(path, paint=replace(path.paint, blur=None)))  # it is far from the source
                continue
            across, up = (deviation * factors[key] for deviation in blur.deviations)
            path = replace(
                path, paint=replace(path.paint, blur=replace(blur, window=windows[key], deviations=(across, up)))
            )
        fitted.append(path)
    return tuple(fitted)


def key_of(blur: Blur) -> Key:
    """Return what the grid of a blur depends on, but for its window."""
    return id(blur.source), blur.deviations, blur.has_colors, blur.is_linear


def seen_window(path: Path, blur: Blur) -> Window | None:
    """Return the part of the window of a blur in the box of its path; None if there is none."""
    (left, low), (right, high) = path.box.tolist()
    corners = np.array([(x, y, 1.0) for x in (left, right) for y in (low, high)])
    mapped = np.einsum("nk,jk->nj", corners, np.array(blur.to_source))
    (x, y), (end, top) = (mapped.min(axis=0) - EDGE).tolist(), (mapped.max(axis=0) + EDGE).tolist()
    window = blur.window
    seen = max(window[0], x), max(window[1], y), min(window[2], end), min(window[3], top)
    return seen if seen[0] < seen[2] and seen[1] < seen[3] else None


def around(first: Window, second: Window) -> Window:
    """Return the window around two others."""
    return min(first[0], second[0]), min(first[1], second[1]), max(first[2], second[2]), max(first[3], second[3])


def factors_of(blurs: dict[Key, Blur]) -> dict[Key, float]:
    """Return for each blur the factor of its deviations with which all fit; more than `MOST_WIDER` leaves it out."""
    factors = dict.fromkeys(blurs, 1.0)
    sizes = {key: texels_of(blur, 1.0) for key, blur in blurs.items()}
    total = sum(sizes.values())
    order = count()  # of equal sizes, the first ones are widened first
    heap = [(-size, next(order), key) for key, size in sizes.items()]
    heapify(heap)
    while total > MOST_TEXELS and heap:
        _, _, key = heappop(heap)
        factors[key] *= WIDER
        size = 0 if factors[key] > MOST_WIDER else texels_of(blurs[key], factors[key])
        total += size - sizes[key]
        sizes[key] = size
        if size:
            heappush(heap, (-size, next(order), key))
    return factors


def texels_of(blur: Blur, factor: float) -> int:
    """Return the number of texels of the grid of a blur with wider deviations.

    All levels together are a third larger than the first one.
    """
    left, low, right, high = blur.window
    across, up = (SPACING * factor * deviation for deviation in blur.deviations)
    coefficients = ((right - left) / across + 4.0) * ((high - low) / up + 4.0)
    return ceil(4.0 / 3.0 * coefficients / (COLORS if blur.has_colors else OPACITIES))
