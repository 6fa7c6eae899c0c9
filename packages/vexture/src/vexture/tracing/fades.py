"""Detection of gradients in pixels: colours that depend on the position along a line or the distance from a point.

Across lines of equal colour, the slope of the colour points along the gradient; for circles and ellipses it is normal
to them. Both conditions are linear equations in the unknowns, solved by least squares over all pixels.
"""

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.tracing.colours import noise

BINS: Final = 64
"""Positions along a gradient at which its colour is averaged."""

OFF: Final = 1.0
NOISES: Final = 3.0
MOST_NOISE: Final = 2.5
"""Limits for the mean difference of pixels from a gradient: `OFF` levels of 255 plus `NOISES` times the noise, of which
at most `MOST_NOISE` counts. Noise is the difference of pixels from the means of their neighbours."""

FAR: Final = 3.0
FAR_SHARE: Final = 0.98
"""Factor of that limit within which this fraction of the pixels must be."""

STRAIGHT: Final = 1.25
"""Error, in levels, up to which a stop is left out."""

SEEN: Final = 16.0
"""Least opacity, in levels, at which a stop's colour is certain enough; below, that of the next stop is taken."""

FEWEST: Final = 32
"""Fewest slopes that determine a gradient's direction."""

REACH: Final = 2
PART: Final = 1 / 30
"""Distance between the pixels from which a slope is computed, in pixels and as a fraction of the area's size; over
few pixels, the rounding to 8 bits exceeds the slope."""

MOST: Final = 40_000
"""Most pixels for fitting a gradient; larger areas are sampled at regular intervals."""

BEYOND: Final = 2.0
"""Extension of a gradient at both ends, in pixels, for the pixels on the edge of its area."""

LONGEST: Final = 20.0
"""Largest aspect ratio of an ellipse."""

Floats = NDArray[np.floating[Any]]
Levels = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Fade:
    """A gradient in pixel coordinates, y down; the centre of the first pixel is (0.5, 0.5)."""

    to_ramp: Floats  # (2, 3): to coordinates whose x, or distance from the origin, is the position on the ramp
    radial: bool
    offsets: Floats  # (stops,), 0..1
    colours: Floats  # (stops, 4), not premultiplied, 0..255
    off: float = 0.0  # largest difference of its pixels, in levels

    def at(self, x: Floats, y: Floats) -> Levels:
        """Return the premultiplied levels at points, (points, 4)."""
        return np.asarray(self.along(self.place(x, y)), np.float32)

    def place(self, x: Floats, y: Floats) -> Floats:
        """Return the positions of points on the ramp."""
        (a, b, c), (d, e, f) = self.to_ramp
        along = a * x + b * y + c
        return np.asarray(np.hypot(along, d * x + e * y + f) if self.radial else along, np.float64)

    def along(self, place: Floats) -> Floats:
        """Return the premultiplied levels at positions on the ramp, (positions, 4)."""
        plain = np.stack([np.interp(place, self.offsets, self.colours[:, channel]) for channel in range(4)], axis=1)
        plain[:, :3] *= plain[:, 3:] / 255.0
        return plain

    def svg(self, name: str, factor: int) -> str:
        """Return its SVG element, for a picture enlarged by a factor."""
        whole = np.linalg.inv(np.vstack([self.to_ramp, (0.0, 0.0, 1.0)]))[:2] * factor
        matrix = " ".join(str(float(value)) for value in whole.T.ravel())
        kind, shape = ("radial", 'cx="0" cy="0" r="1"') if self.radial else ("linear", 'x1="0" y1="0" x2="1" y2="0"')
        stops = "".join(
            f'<stop offset="{offset}" stop-color="rgb({red},{green},{blue})" stop-opacity="{opacity / 255.0}"/>'
            for offset, (red, green, blue, opacity) in zip(
                self.offsets.tolist(), self.colours.round(3).tolist(), strict=True
            )
        )
        place = f'gradientUnits="userSpaceOnUse" gradientTransform="matrix({matrix})"'
        return f'<{kind}Gradient id="{name}" {shape} {place}>{stops}</{kind}Gradient>'


def fade_of(image: Levels, area: NDArray[np.bool_]) -> Fade | None:
    """Return the gradient of an area of a premultiplied picture; None if the area has none.

    Linear gradients are tried first, then circles, then ellipses.
    """
    rows, columns = np.nonzero(area)
    every = -(-len(rows) // MOST)
    rows, columns = rows[::every], columns[::every]
    x, y, own = columns + 0.5, rows + 0.5, image[rows, columns].astype(np.float64)
    points, slopes = _slopes(image, area, rows, columns, round(PART * float(area.sum()) ** 0.5))
    if len(points) < FEWEST:
        return None
    most = OFF + NOISES * min(noise(image, area), MOST_NOISE)
    middle, size = points.mean(axis=0), max(float(points.std()), 1.0)
    for shape in (_line, _circle, _ellipse):
        found = shape((points - middle) / size, slopes)
        if found is not None:
            matrix, start = found
            to_ramp = np.column_stack([matrix / size, start - matrix @ middle / size])
            fade = _with_stops(to_ramp, shape is not _line, x, y, own)
            off = np.abs(fade.at(x, y) - own).max(axis=1)
            if off.mean() <= most and np.quantile(off, FAR_SHARE) <= FAR * most:
                return replace(fade, off=FAR * most)
    return None


def _slopes(
    image: Levels, area: NDArray[np.bool_], rows: NDArray[np.intp], columns: NDArray[np.intp], reach: int
) -> tuple[Floats, Floats]:
    """Return the points of an area whose surroundings lie in it, and the slopes of each channel there, both (n, 2)."""
    height, width = area.shape
    reach = max(reach, REACH)
    inside = (rows >= reach) & (rows < height - reach) & (columns >= reach) & (columns < width - reach)
    rows, columns = rows[inside], columns[inside]
    around = [(rows + down, columns + right) for down, right in ((0, reach), (0, -reach), (reach, 0), (-reach, 0))]
    known = np.logical_and.reduce([area[place] for place in around])
    after, before, below, above = (image[place].astype(np.float64)[known] for place in around)
    slopes = np.stack([after - before, below - above], axis=2).reshape(-1, 2)
    points = np.stack([columns[known] + 0.5, rows[known] + 0.5], axis=1).repeat(4, axis=0)
    return points, slopes


def _line(points: Floats, slopes: Floats) -> tuple[Floats, Floats] | None:
    """Return the map to the ramp of a linear gradient, along the direction of all slopes."""
    across, along = np.linalg.eigh(np.einsum("ni,nj->ij", slopes, slopes))[1].T
    return np.array([along, across]), np.zeros(2)


def _circle(points: Floats, slopes: Floats) -> tuple[Floats, Floats] | None:
    """Return the map to the ramp of circles: every slope points to or from their centre (d, e) / a."""
    (x, y), (right, down) = points.T, slopes.T
    a, d, e = _least(np.stack([right * y - down * x, down, -right], axis=1))
    if abs(a) < 1e-6:
        return None
    return np.eye(2), -np.array([d, e]) / a


def _ellipse(points: Floats, slopes: Floats) -> tuple[Floats, Floats] | None:
    """Return the map to the ramp of ellipses p'Qp = 2 p'(d, e) + const: every slope is a multiple of Qp - (d, e)."""
    (x, y), (right, down) = points.T, slopes.T
    terms = [-down * x, right * x - down * y, right * y, down, -right]
    a, h, b, d, e = _least(np.stack(terms, axis=1))
    sign = 1.0 if a + b > 0.0 else -1.0
    values, axes = np.linalg.eigh(sign * np.array([[a, h], [h, b]]))
    if values[0] <= values[1] / LONGEST**2:
        return None
    root = axes @ np.diag(np.sqrt(values)) @ axes.T
    inverse = axes @ np.diag(1.0 / np.sqrt(values)) @ axes.T
    return root, -sign * inverse @ np.array([d, e])


def _least(terms: Floats) -> Floats:
    """Return the unit vector whose products with the terms are least."""
    return np.asarray(np.linalg.eigh(np.einsum("ni,nj->ij", terms, terms))[1][:, 0], np.float64)


def _with_stops(to_ramp: Floats, radial: bool, x: Floats, y: Floats, colours: Floats) -> Fade:
    """Return a gradient whose stops follow the mean colours of the pixels; the map need not lead to 0..1."""
    place = Fade(to_ramp, radial, np.zeros(1), np.zeros((1, 4))).place(x, y)
    beyond = BEYOND * float(np.linalg.norm(to_ramp[: 1 + radial, :2], 2))
    low, high = float(place.min()) - beyond, float(place.max()) + beyond
    start = 0.0 if radial else low  # position that becomes 0 on the ramp
    scale = 1.0 / max(high - start, 1e-9)
    to_ramp = scale * (to_ramp - np.array([[0.0, 0.0, start], [0.0, 0.0, 0.0]]))
    place, first = scale * (place - start), scale * (max(low, start) - start)
    which = np.minimum((place - first) / max(1.0 - first, 1e-9) * BINS, BINS - 1).astype(np.intp)
    count = np.bincount(which, minlength=BINS)
    known = count > 0
    means = [np.bincount(which, values, BINS)[known] / count[known] for values in (place, *colours.T)]
    offsets, levels = _extend(means[0], np.stack(means[1:], axis=1), first)
    return Fade(to_ramp, radial, *_stops(offsets, levels))


def _extend(offsets: Floats, levels: Floats, low: float) -> tuple[Floats, Floats]:
    """Extrapolate a profile to both ends of the ramp, with colours clamped to their range."""
    if len(offsets) < 2:
        return offsets, levels
    ends = []
    for end, (at, next_to) in ((low, (0, 1)), (1.0, (-1, -2))):
        slope = (levels[next_to] - levels[at]) / (offsets[next_to] - offsets[at])
        ends.append(levels[at] + (end - offsets[at]) * slope)
    levels = np.clip(np.vstack([ends[0], levels, ends[1]]), 0.0, 255.0)
    levels[:, :3] = np.minimum(levels[:, :3], levels[:, 3:])
    return np.concatenate([[low], offsets, [1.0]]), levels


def _stops(offsets: Floats, levels: Floats) -> tuple[Floats, Floats]:
    """Return the fewest stops between which all others lie on straight lines; their colours are not premultiplied."""
    plain = levels.copy()
    plain[:, :3] *= 255.0 / np.maximum(levels[:, 3:], 1e-9)
    seen = np.flatnonzero(levels[:, 3] >= min(SEEN, levels[:, 3].max()))
    nearest = seen[np.abs(np.arange(len(levels))[:, None] - seen[None]).argmin(axis=1)]
    plain[:, :3] = np.clip(plain[nearest, :3], 0.0, 255.0)
    chosen, open_parts = {0, len(offsets) - 1}, [(0, len(offsets) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        between = slice(first + 1, last)
        if last - first < 2:
            continue
        share = ((offsets[between] - offsets[first]) / (offsets[last] - offsets[first]))[:, None]
        line = (1.0 - share) * plain[first] + share * plain[last]
        line[:, :3] *= line[:, 3:] / 255.0
        off = np.abs(line - levels[between]).max(axis=1)
        if off.max() > STRAIGHT:
            middle = first + 1 + int(off.argmax())
            chosen.add(middle)
            open_parts += [(first, middle), (middle, last)]
    places = sorted(chosen)
    return offsets[places], plain[places]
