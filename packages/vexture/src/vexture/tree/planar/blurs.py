"""Replace the blurs of a drawing by splines, pictures whose pixels are coefficients, and effects by their pixels."""

from collections.abc import Hashable
from dataclasses import replace
from math import ceil, log2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.base.layout import LATTICE, MOST_PICTURE_SIDE
from vexture.drawing.affine import compose_affine
from vexture.drawing.blur import SPACING, Blur
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.tree.bounds import DEFAULT_DEPTH, DISPLACEMENT, bounds_of
from vexture.tree.planar.build import DEFAULT_MAP_CAPACITY, grow_drawing
from vexture.tree.planar.pixels import pixels_of_words
from vexture.tree.planar.raster import raster_of
from vexture.tree.planar.splines import BlurAxis, blurred_words
from vexture.tree.tree import MOST_QUADS

CELLS: Final = 2.0
"""Cells of the raster in a deviation. A Gaussian sampled at this rate repeats itself with a factor of 1e-34."""

LEAST_RASTER, MOST_RASTER = 4, 11
"""Depths of rasters. A blur that is finer than the finest raster is blurred by its cells as well."""

MOST_COEFFICIENTS: Final = 750_000
"""Most coefficients of a blur: with its levels, it has fewer blocks than an index of 16 bits can number."""

Key = tuple[Hashable, ...]


def with_splines(drawing: Drawing) -> Drawing:
    """Return the drawing with a picture in the place of each blur and effect.

    Examples
    --------
    >>> square = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> blur = Blur(square, ((1, 0, 0), (0, 1, 0)), (0.1, 0.1), (0, 0, 1, 1))
    >>> soft = replace(square, paths=(replace(square.paths[0], paint=Paint((1, 0, 0), blur=blur)),))
    >>> picture = with_splines(soft).paths[0].paint.picture
    >>> [round(picture.color_at(x, 0.5)[3], 2) for x in (0.0, 0.1, 0.5)]
    [0.5, 0.84, 1.0]
    """
    if not any(path.paint.is_soft for path in drawing.paths):
        return drawing
    known: dict[Key, NDArray[np.uint8]] = {}
    paints: dict[int, Paint] = {}
    paths = []
    for path in drawing.paths:
        paint = paints.get(id(path.paint))
        if paint is None:
            paint = paints[id(path.paint)] = _without_softness(path.paint, known)
        paths.append(path if paint is path.paint else replace(path, paint=paint))
    return replace(drawing, paths=tuple(paths))


def _without_softness(paint: Paint, known: dict[Key, NDArray[np.uint8]]) -> Paint:
    """Return a paint with a picture in the place of a blur or effect.

    `known` holds pixels by what they depend on.
    """
    blur, effect = paint.blur, paint.effect
    if effect is not None:
        key: Key = (id(effect.process), *map(id, effect.sources), effect.depth)
        if key not in known:
            rasters = tuple(_raster(source, effect.depth, 4)[::-1] for source in effect.sources)
            known[key] = effect.to_bytes(rasters)
        return Paint.from_picture(Picture(effect.to_pixels, known[key], Sampling.LINEAR, paint.opacity))
    if blur is None:
        return paint
    key = (id(blur.source), blur.deviations, blur.window, blur.has_colors, blur.is_linear)
    if key not in known:
        known[key] = _coefficients(blur)
    (across, up), (left, low) = blur.deviations, blur.window[:2]
    to_columns = (
        (1.0 / (SPACING * across), 0.0, 1.5 - left / (SPACING * across)),
        (0.0, 1.0 / (SPACING * up), 1.5 - low / (SPACING * up)),
    )
    sampling = Sampling.SPLINE if blur.has_colors else Sampling.INVERSE if blur.is_inverted else Sampling.OPACITY
    color = None if blur.has_colors else paint.color
    to_pixels = compose_affine(to_columns, blur.to_source)
    return Paint.from_picture(Picture(to_pixels, known[key], sampling, paint.opacity, color))


def _raster(source: Drawing, depth: int, components: int) -> NDArray[np.float64]:
    """Mean colours of squares of a drawing, with the parameters and the result of `raster_of`."""
    precision = DISPLACEMENT * 0.5**depth / LATTICE
    bounds = bounds_of(0.0, DEFAULT_DEPTH, DEFAULT_MAP_CAPACITY, precision, MOST_QUADS)
    state = grow_drawing(with_splines(source), bounds)
    assert state is not None  # there is no limit of texels
    raster: NDArray[np.float64] = raster_of(*state, depth, components)
    return raster


def _coefficients(blur: Blur) -> NDArray[np.uint8]:
    """Pixels (rows, columns, 1 or 4) of a blur; rows go up."""
    components, (columns, rows) = 4 if blur.has_colors else 1, blur.size
    if columns * rows > MOST_COEFFICIENTS or max(columns, rows) > MOST_PICTURE_SIDE:
        raise LimitError(
            f"a blur takes {columns:,} x {rows:,} coefficients; the limit is {MOST_COEFFICIENTS:,}; "
            "make the deviation larger or the blurred part smaller"
        )
    depth = min(max(ceil(log2(CELLS / min(blur.deviations))), LEAST_RASTER), MOST_RASTER)
    (left, low), (across, up), side = blur.window[:2], blur.deviations, float(1 << depth)
    steps = SPACING * side * across, SPACING * side * up
    words = blurred_words(
        _raster(blur.source, depth, components),
        BlurAxis(low * side - steps[1], steps[1], rows, up * side),
        BlurAxis(left * side - steps[0], steps[0], columns, across * side),
        int(blur.is_linear),
    )
    return pixels_of_words(words, components)
