"""Outlines of strokes, against the distance from the path for round strokes, and against closed formulas."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vexture.bezier.convert import ellipse_cubics, line_cubics
from vexture.bezier.joins import BEVEL, BUTT, MITER, MITER_CLIP, ROUND_CAP, ROUND_JOIN, SQUARE
from vexture.bezier.stroke import stroke_path

TOLERANCE = 1e-3
FLAT = 0.06 * TOLERANCE
"""Error of the polygons of these tests."""
EDGE = TOLERANCE + 1.1 * FLAT
T = np.linspace(0.0, 1.0, 300, endpoint=False)[:, None]


def style(width, cap=BUTT, join=MITER, limit=4.0, offset=0.0):
    return np.array([width, cap, join, limit, TOLERANCE, offset], np.float64)


def lines(*points):
    points = np.array(points, np.float64)
    return line_cubics(points[:-1], points[1:])


def stroke(cubics, closed, kind, dashes=()):
    dashes = np.array(dashes, np.float64)
    contours, counts = stroke_path(cubics, np.array([len(cubics)]), np.array([closed]), kind, dashes)
    found = np.split(contours, np.cumsum(counts)[:-1]) if len(counts) else []
    for contour in found:
        assert (contour[:, 3] == np.roll(contour[:, 0], -1, axis=0)).all()
    return found


def points_on(cubics):
    s = 1.0 - T
    p0, p1, p2, p3 = np.moveaxis(cubics[:, None], 2, 0)
    return (s**3 * p0 + 3 * s * s * T * p1 + 3 * s * T * T * p2 + T**3 * p3).reshape(-1, 2)


def area(contours):
    total = 0.0
    for contour in contours:
        x, y = points_on(contour).T
        total += float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)
    return total


def windings(contours, places):
    total = np.zeros(len(places), np.int64)
    for contour in contours:
        polygon = points_on(contour)
        a = polygon - places[:, None]
        b = np.roll(polygon, -1, axis=0) - places[:, None]
        left = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
        total += ((a[..., 1] <= 0) & (b[..., 1] > 0) & (left > 0)).sum(axis=1)
        total -= ((a[..., 1] > 0) & (b[..., 1] <= 0) & (left < 0)).sum(axis=1)
    return total


def distances(path, places):
    """Distance from each place to a polyline."""
    start, step = path[:-1], np.diff(path, axis=0)
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    found = []
    for place in places:
        share = np.clip(((place - start) * step).sum(axis=1) / square, 0.0, 1.0)
        found.append(np.hypot(*(start + share[:, None] * step - place).T).min())
    return np.array(found)


def check_round(cubics, closed, half, seed, count=20):
    """Places are in a round stroke if, and only if, they are nearer to the path than half the width."""
    path = np.concatenate([points_on(cubics), cubics[-1:, 3], *([cubics[:1, 0]] if closed else [])])
    random = np.random.default_rng(seed)
    around = path[random.integers(0, len(path), 2 * count)]
    angle, off = random.uniform(0, 2 * np.pi, 2 * count), 10 ** random.uniform(-3.5, -0.5, 2 * count)
    radius = half * (1.0 + random.choice([-1.0, 1.0], 2 * count) * off)
    near = around + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    places = np.concatenate([near, random.uniform(path.min(axis=0) - half, path.max(axis=0) + half, (count, 2))])
    step = np.diff(path, axis=0)
    chosen = random.permutation(np.flatnonzero(np.hypot(*step.T) > 0))[:count]
    across = step[chosen, ::-1] * [-1.0, 1.0] / np.hypot(*step[chosen].T)[:, None]
    for reach in (half - EDGE, half + EDGE, -half + EDGE, -half - EDGE):
        places = np.concatenate([places, (path[chosen] + path[chosen + 1]) / 2.0 + reach * across])
    distance = distances(path, places)
    sure = np.abs(distance - half) > TOLERANCE + FLAT
    winding = windings(stroke(cubics, closed, style(2 * half, ROUND_CAP, ROUND_JOIN)), places)
    assert (winding >= 0)[sure].all()
    np.testing.assert_array_equal((winding > 0)[sure], (distance < half)[sure])


def check_cracks(cubics, closed, half):
    """What lies inside of a round stroke is covered, next to its contours, too: no gap opens between two of them."""
    path = np.concatenate([points_on(cubics), cubics[-1:, 3], *([cubics[:1, 0]] if closed else [])])
    contours = stroke(cubics, closed, style(2 * half, ROUND_CAP, ROUND_JOIN))
    polygon = np.concatenate([points_on(contour) for contour in contours])[7::20]
    step = np.concatenate([np.roll(points_on(contour), -1, axis=0) - points_on(contour) for contour in contours])[7::20]
    inside = (distances(path, polygon) < half - 1.5 * TOLERANCE) & (np.hypot(*step.T) > 0)
    across = 0.1 * TOLERANCE * step[inside, ::-1] * [-1.0, 1.0] / np.hypot(*step[inside].T)[:, None]
    for side in (-across, across):
        assert (windings(contours, polygon[inside] + side) > 0).all()


def odd_curve(kind, random):
    """A cubic that almost has a cusp, lies almost on a line, or has an arm next to nothing."""
    points = random.uniform(0, 10, (4, 2))
    small = 10 ** random.uniform(-8, -0.5)
    if kind == "cusp":
        return np.array([(0, 0), (10, 10), (0, 10), (10, 0)]) + random.normal(size=(4, 2)) * small
    if kind == "line":
        points[:, 1] = points[0, 1] + 0.3 * (points[:, 0] - points[0, 0]) + random.normal(size=4) * small
    elif kind == "arm":
        points[1] = points[0] + random.normal(size=2) * small
    else:
        points[2] = points[3]
    return points


@pytest.mark.parametrize("kind", ["cusp", "line", "arm", "end"])
@pytest.mark.parametrize("half", [0.05, 0.7, 9.0])
def test_odd_curves_have_round_strokes(kind, half):
    """No place further outside than the tolerance is covered, and none further inside is not."""
    for seed in range(4):
        random = np.random.default_rng(seed)
        check_round(odd_curve(kind, random)[None], seed % 2 == 1, half, seed, 15)


@pytest.mark.parametrize(
    ("kind", "half", "seed"),
    [
        # hooks and near-cusps that are smaller than an eighth of the tolerance
        *(("arm", 0.05, 38), ("arm", 0.7, 38), ("arm", 0.7, 58), ("arm", 0.05, 47), ("cusp", 0.7, 7)),
        ("line", 0.05, 0),
        ("arm", 0.05, 46),  # an inflection in the first thousandth, and a tight bend behind it
        ("end", 9.0, 9),  # an end without an arm in a bend that is tight all over
    ],
)
def test_odd_curves_have_strokes_without_cracks(kind, half, seed):
    curve = odd_curve(kind, np.random.default_rng(seed))[None]
    check_round(curve, seed % 2 == 1, half, seed, 60)
    check_cracks(curve, seed % 2 == 1, half)


def path_of(*points):
    """Cubics through points, of which every third is an end."""
    points = np.array(points, np.float64)
    return np.stack([points[k : k + 4] for k in range(0, len(points) - 1, 3)])


def cornered(*ends):
    """Cubics that follow each other, without their common ends twice: (4, 2) for curves, (2, 2) for lines."""
    parts = [np.array(part, np.float64) for part in ends]
    return np.concatenate([part[None] if len(part) == 4 else line_cubics(part[:1], part[1:]) for part in parts])


@pytest.mark.parametrize(
    ("cubics", "closed", "half"),
    [
        (
            path_of((-0.009395, 0.018883), (10.016754, 10.004903), (0.00439, 9.994882), (10.003508, -0.005091)),
            0,
            0.3677,
        ),
        # a bend that crosses itself far from its corner, with long curves that turn the other way
        (
            path_of(
                *((9.992864, -0.010909), (0.244726, 6.644489), (0.680851, 4.537604), (1.855116, 0.786158)),
                *((0.341851, 3.096999), (4.113989, 6.76845), (5.088027, 7.950128)),
            ),
            *(False, 0.0497),
        ),
    ],
)
def test_a_near_cusp_and_a_loop_have_strokes_without_cracks(cubics, closed, half):
    check_round(cubics, bool(closed), half, 1, 200)
    check_cracks(cubics, bool(closed), half)


BEND = [
    *(((20.147, 12.854), (13.207, 19.793)), ((13.207, 19.793), (13.005, 19.995), (12.701, 20.056), (12.436, 19.946))),
    *(((12.436, 19.946), (12.172, 19.837), (12.0, 19.579), (12.0, 19.293)), ((12.0, 19.293), (12.0, 16.0))),
]
"""A rounded corner of an icon, in thousandths: its arcs are not quite tangent to its sides."""

BADGE = path_of(
    *((7.298, 3.712), (7.009, 3.427), (6.921, 2.996), (7.075, 2.621), (7.229, 2.245), (7.594, 2.0), (8.0, 2.0)),
    *((10.667, 2.0), (13.333, 2.0), (16.0, 2.0), (16.406, 2.0), (16.772, 2.245), (16.926, 2.62), (17.08, 2.996)),
    *((16.992, 3.427), (16.703, 3.712), (15.373, 5.042), (14.042, 6.372), (12.712, 7.702), (12.524, 7.893)),
    *((12.268, 8.0), (12.0, 8.0), (11.733, 8.001), (11.476, 7.893), (11.288, 7.703), (9.958, 6.373), (8.628, 5.042)),
    (7.298, 3.712),
)
"""Arcs of the radius of half the width."""

TIP = path_of(
    *((16.13, 21.05), (17.78, 21.68), (19.81, 21.89), (21.0, 21.96), (21.26, 21.978), (21.514, 21.883)),
    *((21.699, 21.699), (21.883, 21.514), (21.978, 21.26), (21.96, 21.0), (21.89, 19.342), (21.587, 17.703)),
    (21.06, 16.13),
)
"""A short arc between long curves."""


@pytest.mark.parametrize(
    ("cubics", "closed", "unit"),
    [
        (cornered(*BEND), False, 3.84),
        (cornered(*BEND[1:]), False, 3.84),
        (BADGE, True, 0.96),
        (TIP, False, 0.96),
    ],
)
def test_bends_of_icons_are_as_exact_as_the_tolerance(cubics, closed, unit):
    """Icons are rounded to thousandths; `unit` is the tolerance in them."""
    check_round(cubics / unit, closed, 1.0 / unit, 1, 400)
    check_cracks(cubics / unit, closed, 1.0 / unit)


@pytest.mark.parametrize("half", [0.3, 2.0, 6.0])
@pytest.mark.parametrize("closed", [False, True])
def test_random_curves_have_round_strokes(half, closed):
    for seed in range(9):
        random = np.random.default_rng(seed)
        points = random.uniform(0, 10, (3 * (1 + seed % 3) + 1, 2))
        if seed % 3 == 0:
            points = np.round(points / 3) * 3
        check_round(np.stack([points[k : k + 4] for k in range(0, len(points) - 1, 3)]), closed, half, seed)


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (10, 10), (0, 10), (10, 0)],  # a cusp
        [(0, 0), (10.001, 10), (0, 10), (10, 0)],  # almost one, from either side
        [(0, 0), (9.999, 10), (0, 10), (10, 0)],
        [(0, 0), (20, 0), (-10, 0), (10, 0)],  # a line that turns back twice
        [(0, 0), (20, 1e-7), (-10, 0), (10, 0)],
        [(0, 0), (0, 0), (10, 5), (10, 0)],  # ends without arms
        [(0, 0), (0, 10), (10, 0), (10, 0)],
        [(0, 0), (0, 0), (10, 5), (10, 5)],
        [(0, 0), (8, 8), (-8, 8), (0, 0)],  # a loop
        [(0, 0), (5, 1), (5, 1), (0, 2)],
    ],
)
def test_degenerate_cubics(points):
    for half in (0.2, 1.0, 5.0):
        check_round(np.array([points], np.float64), False, half, 1)


@settings(derandomize=True, max_examples=25, deadline=None)
@given(
    st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=7, max_size=7),
    st.sampled_from([0.1, 1.0, 3.0]),
    st.booleans(),
)
def test_control_points_on_a_lattice(points, half, closed):
    points = np.array(points, np.float64)
    check_round(np.stack([points[:4], points[3:]]), closed, half, 5, 15)


def test_a_bend_between_two_samples_is_seen():
    """A third of a turn within a few hundredths of the parameter, on the side where it makes a wide arc."""
    points = [(0.0263, 9.10407), (9.84803, 2.86297), (8.13661, 0.82408), (4.3828, 8.17704)]
    check_round(np.array([points]), False, 6.0, 13, 300)


def test_a_tight_arc_leaves_no_hole():
    arc = ellipse_cubics((0.0, 0.0), (1.0, 1.0), 1e-9)
    contours = stroke(arc, True, style(2 * 1.5))
    assert windings(contours, np.array([[0.0, 0.0], [0.3, 0.2], [0.9, 0.0], [2.4, 0.0]])).min() >= 1
    assert windings(contours, np.array([[2.6, 0.0]])) == 0


@pytest.mark.parametrize(("cap", "expected"), [(BUTT, 80.0), (SQUARE, 96.0), (ROUND_CAP, 80.0 + np.pi * 4.0)])
def test_caps(cap, expected):
    assert area(stroke(lines((0, 0), (20, 0)), False, style(4.0, cap))) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(("cap", "expected"), [(SQUARE, 16.0), (ROUND_CAP, np.pi * 4.0)])
@pytest.mark.parametrize("closed", [False, True])
def test_a_point_has_only_its_caps(cap, expected, closed):
    assert area(stroke(lines((5, 5), (5, 5)), closed, style(4.0, cap))) == pytest.approx(expected, rel=1e-3)


def test_a_point_with_butt_caps_is_nothing():
    assert stroke(lines((5, 5), (5, 5)), False, style(4.0)) == []


@pytest.mark.parametrize(
    ("join", "limit", "outside"),
    [
        *((MITER, 4.0, 4.0), (MITER, 1.2, 2.0), (BEVEL, 4.0, 2.0), (ROUND_JOIN, 4.0, np.pi)),
        # a clip at 1.2 of half the width 2 cuts a triangle of height 2 sqrt(2) - 2.4 from the tip
        *((MITER_CLIP, 4.0, 4.0), (MITER_CLIP, 1.2, 4.0 - (2 * 2**0.5 - 2.4) ** 2)),
    ],
)
def test_joins_of_a_right_angle(join, limit, outside):
    """A square of twice ten, a square of the corner inside, and what the join adds."""
    for turn in (-1, 1):
        contours = stroke(lines((0, 0), (10, 0), (10, 10 * turn)), False, style(4.0, BUTT, join, limit))
        assert area(contours) == pytest.approx(80.0 - 4.0 + outside, rel=1e-4)  # the corner inside counts once
        assert len(contours[0]) <= 10


def test_a_closed_square_is_a_frame():
    contours = stroke(lines((0, 0), (10, 0), (10, 10), (0, 10), (0, 0)), True, style(2.0))
    assert [abs(area([contour])) for contour in contours] == pytest.approx([144.0, 64.0])
    assert [len(contour) for contour in contours] == [4, 4]


def test_a_mirrored_path_has_the_mirrored_stroke():
    curve = np.array([[[0.0, 0.0], [9.0, 1.0], [-4.0, 7.0], [6.0, 8.0]]])
    for join in (MITER, BEVEL, MITER_CLIP):
        one = area(stroke(curve, True, style(1.5, BUTT, join)))
        assert area(stroke(curve * [-1.0, 1.0], True, style(1.5, BUTT, join))) == pytest.approx(one, rel=1e-4)


def test_bends_as_tight_as_the_stroke_have_few_cubics():
    """The inner side of a rounded corner is a corner, and that of a circle is next to nothing."""
    corner = ellipse_cubics((10.0, 10.0), (2.0, 2.0), 1e-4)[:2]  # a quarter
    x, y = corner[0, 0], corner[-1, 3]
    path = np.concatenate([lines(x + np.array([0.0, -20.0]), x), corner, lines(y, y + np.array([-20.0, 0.0]))])
    for half in (1.9999, 2.0, 2.0001, 3.0):
        (contour,) = stroke(path, False, style(2 * half))
        assert len(contour) <= 9
        check_round(path, False, half, 3)
    circle = ellipse_cubics((0.0, 0.0), (2.0, 2.0), 1e-4)
    _, *inner = stroke(circle, True, style(4.0))
    assert sum(map(len, inner)) <= 4
    assert all(np.abs(contour).max() < TOLERANCE for contour in inner)


def test_work_on_one_curve_is_limited():
    """Numbers of 1e300 cannot be fitted: the answer is coarse, but it comes."""
    curve = np.array([[[0.0, 0.0], [1e300, 1e300], [-1e300, 3e299], [1.0, 1.0]]])
    with np.errstate(all="ignore"):
        assert len(stroke_path(curve, np.array([1]), np.array([False]), style(2.0), np.zeros(0))[0]) < 9000


def test_steps_without_length_make_no_joins():
    plain = stroke(lines((0, 0), (10, 0), (10, 10)), False, style(2.0))
    noisy = stroke(lines((0, 0), (10, 0), (10 + 2e-6, -3e-6), (10, 10), (10, 10)), False, style(2.0))
    assert len(noisy[0]) == len(plain[0])
    assert area(noisy) == pytest.approx(area(plain), rel=1e-6)
