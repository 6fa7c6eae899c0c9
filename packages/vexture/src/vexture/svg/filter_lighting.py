"""Light on a surface whose height is the opacity of a picture (Filter Effects 1, 9.10, 9.19 and 11)."""

from math import cos, radians, sin
from typing import Final

import numpy as np

from vexture.svg.filter_frame import Numbers, PixelFrame, Pixels, Rectangle, edge_positions, sample_rows
from vexture.svg.filter_operations import DistantLight, Lighting, SpotLight, Triple
from vexture.svg.filter_pixels import limit_colors

RIM: Final = 0.016
"""Width of the soft rim of a spot light's cone, as a difference of cosines; the width in Chromium."""

MOST_EXPONENT: Final = 1e4
"""Greatest exponent of a highlight or a spot light."""

MOST: Final = 1e15
"""Greatest number of a surface or a place, in user units: squares of more would overflow."""

LEAST_LENGTH: Final = 1e-9
"""Least distance of neighbours, in user units."""


def limit(number: float) -> float:
    """Limit a number to `MOST` on both sides of 0."""
    return min(max(number, -MOST), MOST)


def light(pixels: Pixels, frame: PixelFrame, lighting: Lighting, color: Triple, bounds: Rectangle) -> Pixels:
    """Return the light that a surface reflects: opaque and matt, or, with an exponent, its highlights.

    Parameters
    ----------
    pixels : (rows, columns, 4) array
        Its opacity is the height of the surface.
    frame : PixelFrame
    lighting : Lighting
    color : (float, float, float)
        Colour of the light in the colour space of the primitive.
    bounds : (left, top, right, bottom)
        Edges of the picture. Slopes at these edges are those of the neighbours inside.

    Returns
    -------
    (rows, columns, 4) array
    """
    height, constant = limit(lighting.surface_scale) * pixels[..., 3], limit(lighting.constant)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        slope_x, slope_y = surface_slopes(height, frame, lighting.lengths, bounds)
        to_light, strength = _light_rays(lighting, frame, height)
        if lighting.exponent is None:
            share = _cosine((-slope_x, -slope_y, np.ones_like(height)), to_light)
            lit = constant * share.clip(0.0, 1.0) * strength
            colors = [lit * component for component in color]
            return limit_colors(np.stack([*colors, np.ones_like(lit)], axis=2))
        halfway = (to_light[0], to_light[1], to_light[2] + 1.0)
        share = _cosine((-slope_x, -slope_y, np.ones_like(height)), halfway).clip(0.0, 1.0)
        exponent = float(np.clip(lighting.exponent, -MOST_EXPONENT, MOST_EXPONENT))
        lit = np.nan_to_num(constant * share**exponent * strength).clip(0.0, None)
        colors = [(lit * component).clip(0.0, 1.0) for component in color]
        return np.stack([*colors, np.maximum.reduce(colors)], axis=2)


def surface_slopes(
    height: Numbers, frame: PixelFrame, lengths: tuple[float, float], bounds: Rectangle
) -> tuple[Numbers, Numbers]:
    """Return the slopes along x and y by the Sobel kernels of 9.10, which are twice those of the surface.

    Each kernel is a difference along one axis times a mean along the other. At an edge, where a neighbour is missing,
    the difference is one-sided, and the mean has weights 2 and 1 instead of 1, 2 and 1.

    Parameters
    ----------
    height : (rows, columns) array
    frame : PixelFrame
    lengths : (float, float)
        Distances of neighbours in user units; `height` is linear between pixels.
    bounds : (left, top, right, bottom)

    Returns
    -------
    tuple of two (rows, columns) arrays
    """
    left, top, right, bottom = edge_positions(frame, bounds)
    across, down = (left, right), (top, bottom)
    by_x, by_y = (min(max(length, LEAST_LENGTH), MOST) for length in lengths)
    dx, dy = by_x / frame.width, by_y / frame.height
    slopes_x = _means(_differences(height.T, dx, across, by_x).T, dy, down)
    slopes_y = _means(_differences(height, dy, down, by_y).T, dx, across).T
    return slopes_x, slopes_y


def _neighbours(
    values: Numbers, distance: float, edges: tuple[float, float]
) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """Return the values before and after each row, and whether they exist: 1 or 0 (rows, 1)."""
    places = np.arange(float(len(values)))
    before, after = places - distance, places + distance
    slack = 1e-9
    has_before = (before >= edges[0] - slack).astype(np.float64)[:, None]
    has_after = (after <= edges[1] + slack).astype(np.float64)[:, None]
    return (
        sample_rows(values, before, edges, "duplicate"),
        sample_rows(values, after, edges, "duplicate"),
        has_before,
        has_after,
    )


def _differences(values: Numbers, distance: float, edges: tuple[float, float], length: float) -> Numbers:
    before, after, has_before, has_after = _neighbours(values, distance, edges)
    count = has_before + has_after
    rise = has_after * (after - values) + has_before * (values - before)
    return np.where(count > 0.0, 2.0 / np.maximum(count, 1.0), 0.0) * rise / length


def _means(values: Numbers, distance: float, edges: tuple[float, float]) -> Numbers:
    before, after, has_before, has_after = _neighbours(values, distance, edges)
    sums = has_before * before + 2.0 * values + has_after * after
    return np.asarray(sums / (has_before + 2.0 + has_after))


_Vectors = tuple[Numbers | float, Numbers | float, Numbers | float]


def _light_rays(lighting: Lighting, frame: PixelFrame, height: Numbers) -> tuple[_Vectors, Numbers | float]:
    """Return unit vectors from the surface to the light, and the light's strength."""
    source = lighting.light
    if isinstance(source, DistantLight):
        azimuth, elevation = radians(source.azimuth), radians(source.elevation)
        return (cos(azimuth) * cos(elevation), sin(azimuth) * cos(elevation), sin(elevation)), 1.0
    x, y, z = map(limit, source.place)
    to_light = (x - frame.xs[None, :], y - frame.ys[:, None], z - height)
    distance = np.sqrt(to_light[0] ** 2 + to_light[1] ** 2 + to_light[2] ** 2)
    distance[distance == 0.0] = 1.0
    rays = (to_light[0] / distance, to_light[1] / distance, to_light[2] / distance)
    return rays, _spot_strength(source, rays) if isinstance(source, SpotLight) else 1.0


def _spot_strength(spot: SpotLight, rays: _Vectors) -> Numbers:
    axis = [limit(place) - limit(target) for place, target in zip(spot.place, spot.target, strict=True)]
    cosines = _cosine(rays, (axis[0], axis[1], axis[2]))
    exponent = float(np.clip(spot.exponent, 0.0, MOST_EXPONENT))
    strength = np.where(cosines > 0.0, cosines.clip(0.0, 1.0) ** exponent, 0.0)
    if spot.cone is None:
        return strength
    rim = cos(radians(min(abs(spot.cone), 90.0)))
    return np.asarray(strength * ((cosines - rim) / RIM).clip(0.0, 1.0))


def _cosine(a: _Vectors, b: _Vectors) -> Numbers:
    """Return the cosine of the angle between vectors; 0 where one has no length."""
    product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    squares = (a[0] ** 2 + a[1] ** 2 + a[2] ** 2) * (b[0] ** 2 + b[1] ** 2 + b[2] ** 2)
    return np.nan_to_num(product / np.sqrt(np.maximum(squares, 1e-300)))
