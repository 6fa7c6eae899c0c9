import math

import numpy as np
import pytest
import skia
from exact_references import convex_coverage, coverage_of_row
from exact_shapes import (
    backward,
    camera,
    cameras,
    circle,
    circles,
    contour,
    degenerate_drawings,
    drawing,
    pentagram,
    scribble,
)
from hypothesis import example, given, settings
from hypothesis import strategies as st

from vexture.base.errors import LimitError, ParameterError
from vexture.base.tolerance import FLATNESS, SCANLINE
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture.renderers.flatten import CHORD_LIMIT
from vexture.renderers.view import SIZE_LIMIT, fit, window

PROMISE = 0.03 / 255
RULES = [FillRule.NONZERO, FillRule.EVENODD]
patient = settings(deadline=None)  # the first example may have to wait for the compiler


def to_pixel(view):
    return np.linalg.inv(view)[:2]


def max_difference(a, b):
    return float(np.abs(np.asarray(a, np.float64) - b).max())


# ---- what is known in closed form


@patient
@given(st.lists(st.floats(0.01, 0.99), min_size=4, max_size=4))
def test_upright_rectangle_is_a_product_of_overlaps(numbers):
    (x0, x1), (y0, y1) = sorted(numbers[:2]), sorted(numbers[2:])
    size, pixel = (9, 7), 1 / 7
    left = (9 - 7) / 2
    along = np.diff(np.clip(np.arange(10)[:, None], left + x0 / pixel, left + x1 / pixel), axis=0).ravel()
    down = np.diff(np.clip(np.arange(8)[:, None], (1 - y1) / pixel, (1 - y0) / pixel), axis=0).ravel()
    image = render_exact(Drawing.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), size)
    assert max_difference(image, np.outer(down, along)) < 1e-6


@patient
@given(st.floats(0, 2 * math.pi), st.floats(-0.8, 0.8))
def test_half_plane_in_one_pixel(angle, offset):
    """Area of {n.p <= d} in the unit square: (d+^2 - (d-a)+^2 - (d-b)+^2 + (d-a-b)+^2)/(2ab) for n = (a, b) > 0."""
    normal, along = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    pixel, far = 0.01, 0.3
    edge = (0.5, 0.5) + offset * pixel * normal
    corners = [
        edge + far * along,
        edge - far * along,
        edge - far * along - far * normal,
        edge + far * along - far * normal,
    ]
    image = render_exact(
        Drawing.polygon(corners), (1, 1), window(0.5 - pixel / 2, 0.5 - pixel / 2, pixel, pixel).matrix((1, 1))
    )
    a, b = sorted(np.abs(normal))
    d = offset + (a + b) / 2
    if a < 1e-6:
        expected = min(max(d / b, 0), 1)
    else:
        expected = sum(s * max(e, 0) ** 2 for s, e in [(1, d), (-1, d - a), (-1, d - b), (1, d - a - b)]) / (2 * a * b)
    assert image[0, 0] == pytest.approx(expected, abs=2e-6)


@given(st.integers(3, 6), st.floats(0, 7), st.floats(0.02, 0.45), st.integers(0, 2**32))
@settings(patient, max_examples=50)
def test_convex_polygons_by_clipping(count, angle, radius, seed):
    rng = np.random.default_rng(seed)
    angles = np.sort(angle + 2 * np.pi * (np.arange(count) + rng.uniform(-0.2, 0.2, count)) / count)
    corners = 0.5 + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    view = window(*rng.uniform(0, 0.4, 2), *rng.uniform(0.3, 1, 2), rng.uniform(0, 360)).matrix((9, 8))
    matrix = to_pixel(view)
    expected = convex_coverage(corners @ matrix[:, :2].T + matrix[:, 2], (9, 8))
    assert max_difference(render_exact(Drawing.polygon(corners), (9, 8), view), expected) < 1e-6


@pytest.mark.parametrize("size", [1, 7, 300])
def test_area_of_curves(size):
    """The sum over the pixels is the polynomial area of the curves, the integral of x dy."""
    ring = circle()
    x, y = ring[..., 0].T, ring[..., 1].T
    weights = np.array([[-10, 6, 3, 1], [-6, 0, 3, 3], [-3, -3, 0, 6], [-1, -3, -6, 10]]) / 20
    area = np.einsum("is,ij,js->", x, weights, y)
    total = render_exact(drawing(ring), (size, size)).sum(dtype=np.float64)
    assert total == pytest.approx(area * size**2, abs=FLATNESS * 2 * np.pi * 0.4 * size + 1e-6)


def test_pentagram_rules_differ_by_its_heart():
    nonzero, evenodd = (render_exact(pentagram(rule), (64, 64)).sum(dtype=float) / 64**2 for rule in RULES)
    # the inner pentagon's radius is the outer one's over phi^2; area of a pentagon = 5/2 sin(72 deg) r^2
    heart = 2.5 * math.sin(math.radians(72)) * (0.48 * 2 / (3 + math.sqrt(5))) ** 2
    assert nonzero - evenodd == pytest.approx(heart, abs=1e-6)


def test_empty_drawings_are_empty():
    for nothing in (Drawing(()), Drawing((Path(()),)), drawing(contour([(0.2, 0.3)], [[(0.2, 0.3), (0.2, 0.3)]]))):
        assert not render_exact(nothing, (5, 4)).any()


def test_result_type():
    image = render_exact(drawing(circle()), (5, 4))
    assert image.dtype == np.float32
    assert image.shape == (4, 5)
    assert image.min() >= 0
    assert image.max() == 1


# ---- refinement and the second truth


@given(degenerate_drawings(), st.integers(0, 2**32))
@settings(patient, max_examples=25)
def test_degenerate_drawings_agree_with_exact_scanlines(shape, seed):
    rng = np.random.default_rng(seed)
    size = (7, 5)
    upright = rng.random() < 0.5
    view = (
        fit(size)
        if upright
        else window(*rng.uniform(0, 0.4, 2), *rng.uniform(0.3, 1, 2), rng.uniform(0, 360)).matrix(size)
    )
    image = render_exact(shape, size, view)
    row = int(rng.integers(size[1]))
    assert max_difference(image[row], coverage_of_row(shape, to_pixel(view), size[0], row)) < PROMISE
    assert max_difference(image, render_exact(shape, size, view, flatness=FLATNESS / 10)) < PROMISE


@pytest.mark.slow
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("kind", ["scribble", "circles", "union", "pentagram", "star", "loop", "cusp"])
def test_crossing_curves_agree_with_exact_scanlines(kind, rule):
    rng = np.random.default_rng(7)
    loop = contour([(0.2, 0.2), (0.8, 0.2)], [[(1.4, 1.2), (-0.4, 1.2)], [(0.6, 0.2), (0.4, 0.2)]])
    cusp = contour([(0.2, 0.2), (0.8, 0.2)], [[(1.0, 1.0), (0.0, 1.0)], [(0.6, 0.3), (0.4, 0.1)]])
    shape = {
        "scribble": lambda: drawing(scribble(rng, 12), rule=rule),
        "circles": lambda: drawing(*circles(rng, 12), rule=rule),
        "union": lambda: Drawing(tuple(Path((c, circle()), rule) for c in circles(rng, 8))),
        "pentagram": lambda: pentagram(rule),
        "star": lambda: Drawing.polygon(rng.uniform(0, 1, (60, 2)), fill_rule=rule),
        "loop": lambda: drawing(loop, rule=rule),
        "cusp": lambda: drawing(cusp, rule=rule),
    }[kind]()
    for size in (8, 61):
        view = window(0.01, 0.02, 0.95, 0.96, rotate=17.0).matrix((size, size))
        image = render_exact(shape, (size, size), view)
        row = size // 2
        assert max_difference(image[row], coverage_of_row(shape, to_pixel(view), size, row)) < PROMISE
        assert max_difference(image, render_exact(shape, (size, size), view, flatness=FLATNESS / 10)) < PROMISE


def test_flatness_is_what_limits_the_error():
    """Coarse chords are visibly wrong, finer ones less so: the default is far below what refinement changes."""
    shape, size = drawing(circle()), (100, 100)
    fine = render_exact(shape, size, flatness=FLATNESS / 100)
    errors = [max_difference(render_exact(shape, size, flatness=f), fine) for f in (1e-1, 1e-2, 1e-3, FLATNESS)]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 0.03
    assert errors[3] < PROMISE / 4


# ---- invariance


def crowd():
    """Everything at once: a scribble, overlapping circles and a pentagram, three paths of both rules."""
    rng = np.random.default_rng(3)
    return Drawing(
        (Path((scribble(rng, 9),), FillRule.EVENODD), Path(tuple(circles(rng, 9))), *pentagram(RULES[1]).paths)
    )


def test_a_larger_image_averages_to_the_smaller_one():
    large = render_exact(crowd(), (160, 160)).astype(np.float64)
    assert max_difference(large.reshape(40, 4, 40, 4).mean(axis=(1, 3)), render_exact(crowd(), (40, 40))) < PROMISE / 3


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_quarter_turns(turns):
    straight, turned = (
        render_exact(crowd(), (40, 40), window(0, 0, 1, 1, rotate=angle).matrix((40, 40))) for angle in (0, 90 * turns)
    )
    assert max_difference(turned, np.rot90(straight, turns)) < PROMISE / 3


@pytest.mark.parametrize(("right", "down"), [(5, 3), (-6, 2), (0, -17), (-39, 0)])
def test_shift_by_whole_pixels(right, down):
    """What lies left of the image still counts, what lies elsewhere does not: a crop shows what the whole showed."""
    whole = np.zeros((120, 120))
    whole[40:80, 40:80] = render_exact(crowd(), (40, 40))
    view = fit((40, 40))
    view[:2, 2] -= view[:2, :2] @ (right, down)
    crop = whole[40 - down : 80 - down, 40 - right : 80 - right]
    assert max_difference(render_exact(crowd(), (40, 40), view), crop) < PROMISE / 3


def test_painting_twice_or_backward_changes_nothing():
    once = render_exact(crowd(), (40, 40))
    paths = crowd().paths
    twice = render_exact(Drawing(paths + paths), (40, 40))
    reversed_ = Drawing(tuple(Path(tuple(map(backward, p.contours)), p.fill_rule) for p in paths))
    assert max_difference(twice, once) < 1e-6
    assert max_difference(render_exact(reversed_, (40, 40)), once) < 1e-6


def test_coincident_contours():
    ring, size = circle(), (40, 40)
    once = render_exact(drawing(ring), size)
    assert max_difference(render_exact(drawing(ring, ring), size), once) < 1e-6
    assert max_difference(render_exact(drawing(ring, ring, ring, rule=FillRule.EVENODD), size), once) < 1e-6
    for gone in (drawing(ring, ring, rule=FillRule.EVENODD), drawing(ring, backward(ring))):
        assert max_difference(render_exact(gone, size), 0) < 1e-6


# ---- views


def test_projective_view_of_a_polygon():
    view = np.array([[0.11, 0.01, 0.05], [0.005, -0.1, 0.95], [0.003, 0.05, 0.8]])
    corners = np.array([(0.15, 0.2), (0.9, 0.1), (0.7, 0.85), (0.3, 0.8)])
    seen = np.column_stack([corners, np.ones(4)]) @ np.linalg.inv(view).T
    expected = convex_coverage(seen[:, :2] / seen[:, 2:], (12, 9))
    assert 10 < expected.sum() < 100
    assert max_difference(render_exact(Drawing.polygon(corners), (12, 9), view), expected) < 1e-6


@pytest.mark.parametrize("flatness", [0.3, 0.01, FLATNESS])
@pytest.mark.parametrize("bend", ["round", "away", "across"])
def test_flatness_holds_in_perspective(bend, flatness):
    """Against a polygon with very many corners on the curve, on a plane whose horizon is the image's upper edge.

    A chord's segment has 2/3 of the flatness times its length as its area, and two sides may share a pixel.
    """
    view = np.array([[0.5, 0, 0], [0, 0, 2], [0, 1, 0]])  # x/y goes sideways, 1/y into the distance
    shape = {
        "round": drawing(circle(0.5, 0.5, 0.45)),
        "away": drawing(contour([(0.1, 0.04), (0.9, 0.04)], [[(0.4, 0.9), (0.6, 0.9)], [(0.6, 0.04), (0.4, 0.04)]])),
        "across": drawing(contour([(0.2, 0.04), (0.2, 0.9)], [[(0.8, 0.3), (0.8, 0.6)], [(0.2, 0.6), (0.2, 0.3)]])),
    }[bend]
    t = np.linspace(0, 1, 20001)[:-1, None]
    p0, p1, p2, p3 = np.moveaxis(shape.paths[0].contours[0][:, :, None], 1, 0)
    dense = ((1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3).reshape(-1, 2)
    expected = render_exact(Drawing.polygon(dense), (64, 64), view)
    image = render_exact(shape, (64, 64), view, flatness=flatness)
    assert 0.01 < expected.mean() < 0.9
    assert max_difference(image, expected) < 2 / 3 * 2 * math.sqrt(2) * flatness


@given(cameras((9, 8)))
@example(camera((9, 8), (0.5, 0.5), 0.2, (0, 1.2, 0.3), 3.6))  # far to the left or right of the image,
@example(camera((9, 8), (0.5, 0.5), 0.2, (0, 1.2, 4.5), 3.6))  # or above or below it, lies what is behind the eye
@patient
def test_cameras_over_a_plain(view):
    """A square below, before and behind the eye, clipped in space, then projected: no sky shows a mirrored picture."""
    corners = np.array([(0.1, 0.05), (0.95, 0.1), (0.9, 0.9), (0.05, 0.95), (0.03, 0.4)])
    nearest = 1 / (view[2] @ np.array([(0, 0, 1), (9, 0, 1), (0, 8, 1), (9, 8, 1)]).T).max()
    seen, space = [], np.column_stack([corners, np.ones(5)]) @ np.linalg.inv(view).T
    for p, q in zip(space, np.roll(space, -1, axis=0), strict=True):
        p_in, q_in = p[2] - 0.1 * nearest, q[2] - 0.1 * nearest
        if p_in >= 0:
            seen.append(p[:2] / p[2])
        if (p_in >= 0) != (q_in >= 0):
            at = p + p_in / (p_in - q_in) * (q - p)
            seen.append(at[:2] / at[2])
    expected = convex_coverage(np.array(seen), (9, 8)) if len(seen) > 2 else np.zeros((8, 9))
    assert max_difference(render_exact(Drawing.polygon(corners), (9, 8), view), expected) < 1e-6


def test_deep_zoom_sees_the_tangent():
    """At 10^6 pixels per unit, a circle's edge is its tangent to 1e-5 pixels."""
    direction = np.array([math.cos(math.pi / 4), math.sin(math.pi / 4)])
    at = 0.5 + 0.4 * direction  # the middle of the first cubic lies on the circle
    size, pixel = (6, 6), 1e-6
    view = window(*(at - 3 * pixel), 6 * pixel, 6 * pixel).matrix(size)
    across = np.array([direction[0], -direction[1]])  # outward, y down
    along = np.array([-across[1], across[0]])
    corners = np.array([3, 3]) + 50 * np.array([along, along - across, -along - across, -along])
    assert max_difference(render_exact(drawing(circle()), size, view), convex_coverage(corners, size)) < PROMISE


# ---- another rasteriser


def test_skia_agrees_loosely():
    skia_path = pytest.importorskip("vexture_evidence.measures.peers", reason="it needs vexture-evidence").skia_path
    size, shape = 256, crowd()
    image = np.zeros((size, size), np.uint8)
    for path in shape.paths:
        outline = skia_path(path, np.array([[size, 0, 0], [0, -size, size], [0, 0, 1]]))
        surface = skia.Surface(size, size)
        surface.getCanvas().drawPath(outline, skia.Paint(AntiAlias=True, Color=skia.ColorBLACK))
        image = np.maximum(image, surface.toarray()[..., 3])  # the union, but for pixels on two borders
    difference = np.abs(render_exact(shape, (size, size)) - image / 255)
    assert difference.mean() < 1 / 255
    assert (difference > 0.1).mean() < 0.01


# ---- limits


@pytest.mark.parametrize("size", [(0, 4), (4, -1), (SIZE_LIMIT + 1, 4), (1.5, 2)])
def test_bad_size(size):
    with pytest.raises(ParameterError, match=str(SIZE_LIMIT)):
        render_exact(drawing(circle()), size)


@pytest.mark.parametrize("matrix", [np.zeros((2, 3)), np.full((3, 3), np.nan), np.eye(4)])
def test_bad_matrix(matrix):
    with pytest.raises(ParameterError, match="view"):
        render_exact(drawing(circle()), (4, 4), matrix)


@pytest.mark.parametrize("flatness", [0, -1, np.nan, 1e-12])
def test_bad_flatness(flatness):
    with pytest.raises(ParameterError, match="flatness"):
        render_exact(drawing(circle()), (4, 4), flatness=flatness)


def test_too_many_chords():
    with pytest.raises(LimitError, match=f"limit is {CHORD_LIMIT}"):
        render_exact(drawing(scribble(np.random.default_rng(1), 40)), (1000, 1000), flatness=SCANLINE)


TRIANGLE = Drawing.polygon([(0, 0), (1, 0), (0, 1)])


def test_exact_coverage_of_a_triangle() -> None:
    image = render_exact(TRIANGLE, (2, 2))
    np.testing.assert_allclose(image, [(0.5, 0.0), (1.0, 0.5)])
    assert image.dtype == np.float32
