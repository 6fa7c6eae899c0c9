"""Drawings for the renderers' tests: simple ones, and random ones that are as degenerate as can be."""

import numpy as np
from hypothesis import strategies as st

from vexture.drawing.drawing import Drawing, FillRule, Path

KAPPA = 4 / 3 * (np.sqrt(2) - 1)


def contour(corners, controls):
    """Closed contour from its corners (n, 2) and its inner control points (n, 2, 2)."""
    start = np.array(corners, dtype=np.float64)
    inner = np.array(controls, dtype=np.float64)
    return np.stack([start, inner[:, 0], inner[:, 1], np.roll(start, -1, axis=0)], axis=1)


def circle(x=0.5, y=0.5, radius=0.4):
    """Four cubics, counter-clockwise."""
    unit = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)], dtype=np.float64)
    after = np.roll(unit, -1, axis=0)
    inner = np.stack([unit + KAPPA * after, after + KAPPA * unit], axis=1)
    return contour((x, y) + radius * unit, (x, y) + radius * inner)


def circles(rng, count, radius=0.12):
    return [circle(*rng.uniform(0.2, 0.8, 2), radius * rng.uniform(0.3, 1.5)) for _ in range(count)]


def scribble(rng, count):
    """A contour of random cubics that crosses itself all over."""
    return contour(rng.uniform(0, 1, (count, 2)), rng.uniform(-0.2, 1.2, (count, 2, 2)))


def backward(closed):
    """The same contour in the other direction."""
    return np.ascontiguousarray(closed[::-1, ::-1])


def drawing(*contours, rule=FillRule.NONZERO):
    """One path."""
    return Drawing((Path(tuple(contours), rule),))


def pentagram(rule):
    angles = np.pi / 2 + 4 * np.pi / 5 * np.arange(5)
    corners = list(zip(0.5 + 0.48 * np.cos(angles), 0.5 + 0.48 * np.sin(angles), strict=True))
    return Drawing.polygon(corners, fill_rule=rule)


coordinates = st.one_of(st.integers(0, 8).map(lambda k: k / 8), st.floats(0, 1, allow_subnormal=False))
points = st.tuples(coordinates, coordinates)


def straight(corners):
    """Polygon."""
    side = np.roll(corners, -1, axis=0) - corners
    return contour(corners, np.stack([corners + side / 3, corners + side * (2 / 3)], axis=1))


@st.composite
def degenerate_contours(draw, others):
    """A polygon, loops and cusps on a coarse lattice, or one of the others again, reversed or moved by a hair."""
    repeats = ["again", "reversed", "nearly"] if others else []
    kind = draw(st.sampled_from(["curved", "straight", *repeats]))
    if kind in ("curved", "straight"):
        corners = np.array(draw(st.lists(points, min_size=2, max_size=5)))
        if kind == "straight":
            return straight(corners)
        count = 2 * len(corners)
        return contour(corners, np.reshape(draw(st.lists(points, min_size=count, max_size=count)), (-1, 2, 2)))
    other = draw(st.sampled_from(others))
    if kind == "nearly":
        return np.minimum(other + draw(st.sampled_from([1e-6, 1e-9, 1e-12, 1e-15])), 1.0)
    return other if kind == "again" else backward(other)


@st.composite
def degenerate_drawings(draw):
    """One to four such contours, in one path or several."""
    contours = []
    for _ in range(draw(st.integers(1, 4))):
        contours.append(draw(degenerate_contours(contours)))
    paths = []
    while contours:
        taken = draw(st.integers(1, len(contours)))
        paths.append(Path(tuple(contours[:taken]), draw(st.sampled_from(FillRule))))
        contours = contours[taken:]
    return Drawing(tuple(paths))


def camera(size, position, height, angles, focal):
    """View of the plane of the unit square by a pinhole camera above it; `angles`: heading, pitch (0 = down), roll."""
    heading, pitch, roll = angles

    def turn(angle, i, j):
        matrix = np.eye(3)
        matrix[[i, j], [i, j]], matrix[i, j], matrix[j, i] = np.cos(angle), -np.sin(angle), np.sin(angle)
        return matrix

    to_ray = np.array([[1, 0, -size[0] / 2], [0, -1, size[1] / 2], [0, 0, -focal]]) / focal
    ray = turn(heading, 0, 1) @ turn(pitch, 1, 2) @ turn(roll, 0, 1) @ to_ray
    # a ray meets the plane at position + height (dx, dy)/(-dz)
    return np.array([height * ray[0] - position[0] * ray[2], height * ray[1] - position[1] * ray[2], -ray[2]])


@st.composite
def cameras(draw, size):
    """Cameras that see something of the plane: the drawing before, below and behind them, the horizon anywhere."""
    number = st.floats(0, 1)
    position, height = draw(st.tuples(number, number)), draw(st.floats(0.05, 1))
    angles = draw(st.floats(0, 2 * np.pi)), draw(st.floats(0, 1.5)), draw(st.floats(0, 2 * np.pi))
    return camera(size, position, height, angles, max(size) * draw(st.floats(0.3, 2)))
