"""The exact renderer's blurs: by closed forms, by quadrature, and by one another."""

from dataclasses import replace
from math import cos, erf, pi, radians, sin

import numpy as np
import pytest
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.bezier.convert import ellipse_cubics
from vexture.drawing.affine import Affine
from vexture.drawing.blur import Blur, Window
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import BLACK, Gradient, Paint, Stop
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import view_matrix, window

Values = NDArray[np.float64]

LEVEL = 1 / 255
SAME: Affine = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
SQUARE: Window = (0.0, 0.0, 1.0, 1.0)
ORANGE = (1.0, 0.5, 0.0)
ORANGE_PAINT = Paint(ORANGE)

ERF = np.vectorize(erf, otypes=[np.float64])


def below(x: Values) -> Values:
    """Integral of the normal distribution up to x."""
    return np.asarray(0.5 + 0.5 * ERF(x / np.sqrt(2.0)))


def rectangle(box: Window, paint: Paint = BLACK, group: int = -1) -> Path:
    left, low, right, high = box
    path = Drawing.polygon([(left, low), (right, low), (right, high), (left, high)]).paths[0]
    return replace(path, paint=paint, group=group)


def blurred(source: Drawing, deviations: tuple[float, float], paint: Paint = ORANGE_PAINT, **rest: object) -> Path:
    """The unit square, painted with a blur."""
    arguments = {"to_source": SAME, "window": SQUARE, **rest}
    return rectangle(SQUARE, replace(paint, blur=Blur(source, deviations=deviations, **arguments)))  # type: ignore[arg-type]


def means(low: float, high: float, deviation: float, sides: Values) -> Values:
    """Means of a blurred interval between consecutive places."""

    def integral(x: Values) -> Values:  # of `below`
        return np.asarray(x * below(x) + np.exp(-0.5 * x * x) / np.sqrt(2.0 * pi))

    both = deviation * (integral((sides - low) / deviation) - integral((sides - high) / deviation))
    return np.asarray(np.diff(both) / np.diff(sides))


def box_means(box: Window, deviations: tuple[float, float], size: int) -> Values:
    """Opacities of a blurred rectangle in a square image."""
    sides = np.arange(size + 1) / size
    across, up = means(box[0], box[2], deviations[0], sides), means(box[1], box[3], deviations[1], sides)
    return np.asarray(up[::-1, None] * across)


def along(x: float, y: float, angle: float, length: float, count: int = 60) -> tuple[Values, Values, Values]:
    """A view of a row of very thin pixels, and points in each, (count, 9)."""
    step, (right, up) = length / count, (cos(radians(angle)), sin(radians(angle)))
    thin = 1e-3 * step
    matrix = np.array(
        [[step * right, -thin * up, x + 0.5 * thin * up], [step * up, thin * right, y - 0.5 * thin * right]]
    )
    places = step * (np.arange(9 * count).reshape(count, 9) + 0.5) / 9
    return matrix, x + places * right, y + places * up


def worst(one: NDArray[np.floating], other: NDArray[np.floating]) -> float:
    return float(np.abs(one - other).max()) / LEVEL


# ---- closed forms


@pytest.mark.parametrize("deviation", [0.3, 0.05, 0.011])
@pytest.mark.parametrize("size", [1, 3, 16, 150])
def test_a_blurred_rectangle_is_a_product_of_differences_of_erf(deviation: float, size: int) -> None:
    box, deviations = (0.2003, 0.3, 0.7007, 0.6), (deviation, 1.7 * deviation)
    image = render_exact_colours(Drawing((blurred(Drawing((rectangle(box),)), deviations),)), size)
    expected = box_means(box, deviations, size)[..., None] * (*ORANGE, 1.0)
    assert worst(image, expected) < 0.05


@pytest.mark.parametrize("place", [0.4, 0.401, 0.402, 0.4037])
def test_values_across_an_edge_are_those_of_erf(place: float) -> None:
    """Edges anywhere between cells, in pixels much smaller than the deviation."""
    deviation = 0.02
    drawing = Drawing((blurred(Drawing((rectangle((0.0, 0.0, place, 1.0)),)), (deviation, deviation)),))
    matrix, x, _ = along(0.32, 0.5, 0.0, 0.17, 200)
    row = render_exact_colours(drawing, (200, 1), matrix)[0, :, 3]
    assert worst(row, below((place - x) / deviation).mean(axis=1)) < 0.07
    assert np.ptp(row) > 0.99


@pytest.mark.parametrize("radius", [0.05, 0.25])
@pytest.mark.parametrize("angle", [0.0, 33.0])
def test_a_blurred_disc_by_quadrature(radius: float, angle: float) -> None:
    deviation = 0.04
    contour = ellipse_cubics((0.5, 0.5), (radius, radius), 1e-7)
    drawing = Drawing((blurred(Drawing((Path((contour,)),)), (deviation, deviation)),))
    matrix, x, y = along(0.5, 0.5, angle, 0.45)
    row = render_exact_colours(drawing, (60, 1), matrix)[0, :, 3]
    nodes, weights = np.polynomial.legendre.leggauss(400)
    angles = 0.5 * pi * nodes  # heights are sines of angles, so that the ends need no care
    heights, halves = radius * np.sin(angles), radius * np.cos(angles)
    parts = weights * 0.5 * pi * halves * np.exp(-0.5 * ((y[..., None] - 0.5 - heights) / deviation) ** 2)
    across = x[..., None] - 0.5
    chords = below((halves - across) / deviation) - below((-halves - across) / deviation)
    expected = (parts * chords).sum(axis=2).mean(axis=1) / (deviation * np.sqrt(2.0 * pi))
    assert worst(row, expected) < 0.05


def test_a_blur_that_is_turned_and_sheared() -> None:
    """The drawing's point is mapped to that of the source, where deviations apply."""
    to_source: Affine = ((0.8, 0.4, -0.1), (-0.3, 0.9, 0.2))
    box, deviations = (0.3, 0.3, 0.62, 0.7), (0.05, 0.1)
    drawing = Drawing((blurred(Drawing((rectangle(box),)), deviations, to_source=to_source),))
    matrix, x, y = along(0.1, 0.1, 40.0, 1.1)
    row = render_exact_colours(drawing, (60, 1), matrix)[0, :, 3]
    u, v = (a * x + b * y + c for a, b, c in to_source)
    across = below((u - box[0]) / deviations[0]) - below((u - box[2]) / deviations[0])
    up = below((v - box[1]) / deviations[1]) - below((v - box[3]) / deviations[1])
    inside = ((u > 0) & (u < 1) & (v > 0) & (v < 1)).all(axis=1)
    assert inside.sum() > 40
    assert worst(row[inside], (across * up)[inside].mean(axis=1)) < 0.05


def test_views_in_perspective_and_turned_agree_with_very_many_points() -> None:
    box, deviation = (0.3, 0.3, 0.62, 0.7), 0.02
    drawing = Drawing((blurred(Drawing((rectangle(box),)), (deviation, deviation)),))
    tilted = np.array([[0.2, 0.02, 0.1], [0.03, -0.15, 0.9], [0.1, 0.05, 1.0]])
    turned = view_matrix(window(0.3, 0.3, 0.3, 0.3, 30.0), (4, 4))
    for matrix in (tilted, turned):
        sides = (np.arange(4 * 250) + 0.5) / 250
        X, Y, W = (a * sides + b * sides[:, None] + c for a, b, c in matrix)
        u, v = X / W, Y / W
        across = below((u - box[0]) / deviation) - below((u - box[2]) / deviation)
        up = below((v - box[1]) / deviation) - below((v - box[3]) / deviation)
        expected = (across * up).reshape(4, 250, 4, 250).mean(axis=(1, 3))
        assert worst(render_exact_colours(drawing, 4, matrix)[..., 3], expected) < 0.05


def test_a_pixel_of_very_many_deviations() -> None:
    """Small dots, all of which a pixel's few points could miss."""
    boxes = [(x, y, x + 0.004, y + 0.004) for x in np.arange(0.013, 0.98, 0.031) for y in np.arange(0.01, 0.98, 0.037)]
    deviations = (0.003, 0.002)
    source = Drawing(tuple(rectangle(box) for box in boxes))
    expected = sum(box_means(box, deviations, 2) for box in boxes)
    assert worst(render_exact_colours(Drawing((blurred(source, deviations),)), 2)[..., 3], np.asarray(expected)) < 0.02


# ---- what is blurred


def test_blurs_of_blurs_add_their_variances() -> None:
    inner = blurred(Drawing((rectangle((0.35, 0.4, 0.62, 0.6)),)), (0.03, 0.04))
    drawing = Drawing((blurred(Drawing((inner,)), (0.04, 0.03)),))
    expected = box_means((0.35, 0.4, 0.62, 0.6), (0.05, 0.05), 40)
    assert worst(render_exact_colours(drawing, 40)[..., 3], expected) < 0.1


def test_a_ramp_in_colours_is_blurred_to_itself() -> None:
    """Far from its ends and borders."""
    stops = Stop(0.0, (1.0, 0.0, 0.2)), Stop(1.0, (0.0, 1.0, 0.4), 0.5)
    ramp = Paint.from_gradient(Gradient(SAME, stops))
    source = Drawing((rectangle(SQUARE, ramp),))
    drawing = Drawing((blurred(source, (0.02, 0.02), has_colors=True),))
    view = window(0.3, 0.3, 0.4, 0.4)
    exact = render_exact_colours(Drawing((rectangle(SQUARE, replace(ramp, opacity=1.0)),)), 9, view)
    found = render_exact_colours(drawing, 9, view)
    # premultiplied, colours are parabolas: the deviation's square times half the second derivative is added
    change = 0.02**2 * np.array([0.5, -0.5, -0.1, 0.0])
    assert worst(found, exact + change) < 0.02


def test_colours_with_the_opacity_of_the_paint() -> None:
    box = (0.3, 0.3, 0.7, 0.6)
    source = Drawing((rectangle(box, Paint((0.2, 0.4, 1.0), 0.5)),))
    drawing = Drawing((blurred(source, (0.05, 0.05), Paint(opacity=0.75), has_colors=True),))
    expected = box_means(box, (0.05, 0.05), 20)[..., None] * (0.2, 0.4, 1.0, 1.0) * 0.375
    assert worst(render_exact_colours(drawing, 20), expected) < 0.05


def test_the_opposite_opacity() -> None:
    box = (0.3, 0.3, 0.7, 0.6)
    source = Drawing((rectangle(box, Paint((0.0, 1.0, 0.0), 0.5)),))
    drawing = Drawing((blurred(source, (0.05, 0.05), Paint(ORANGE, 0.75), is_inverted=True),))
    expected = 0.75 * (1.0 - 0.5 * box_means(box, (0.05, 0.05), 20))
    assert worst(render_exact_colours(drawing, 20), expected[..., None] * (*ORANGE, 1.0)) < 0.05


def test_linear_light() -> None:
    """Black beside white: the values of erf, encoded as sRGB; the edge itself is not blurred in sRGB at first."""
    deviation, place = 0.03, 0.5013
    black, white = Paint(), Paint((1.0, 1.0, 1.0))
    source = Drawing((rectangle((0.0, 0.0, place, 1.0), black), rectangle((place, 0.0, 1.0, 1.0), white)))
    drawing = Drawing((blurred(source, (deviation, deviation), has_colors=True, is_linear=True),))
    matrix, x, _ = along(0.38, 0.5, 0.0, 0.24, 2000)
    row = render_exact_colours(drawing, (2000, 1), matrix)[0]
    light = below((x - place) / deviation)
    grey = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
    expected = np.stack([grey, grey, grey, np.ones_like(light)], axis=2).mean(axis=1)
    assert worst(row, expected) < 0.3


def test_groups_and_masks_of_the_source() -> None:
    """A red square, masked to its left half by luminance: half of white, and half of black."""
    paths = (
        rectangle((0.2, 0.2, 0.8, 0.8), Paint((1.0, 0.0, 0.0)), 0),
        rectangle((0.0, 0.0, 0.5, 1.0), Paint((1.0, 1.0, 1.0)), 1),
    )
    source = Drawing(paths, groups=(Group(opacity=0.8), Group(0, mask=Mask.LUMINANCE)))
    drawing = Drawing((blurred(source, (0.05, 0.05)),))
    expected = 0.8 * box_means((0.2, 0.2, 0.5, 0.8), (0.05, 0.05), 20)
    assert worst(render_exact_colours(drawing, 20)[..., 3], expected) < 0.05


def test_a_picture_as_the_source() -> None:
    pixels = np.array([[[255, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
    picture = Picture(((2.0, 0.0, 0.0), (0.0, -1.0, 1.0)), pixels, Sampling.PIXELS)
    drawing = Drawing((blurred(Drawing((rectangle(SQUARE, Paint.from_picture(picture)),)), (0.05, 0.05)),))
    assert worst(render_exact_colours(drawing, 20)[..., 3], box_means((0.0, 0.0, 0.5, 1.0), (0.05, 0.05), 20)) < 0.05


# ---- where it is painted


def test_faces_cut_a_blur_and_groups_blend_with_it() -> None:
    """Below the diagonal, multiplied with green: of orange, only the green component is left."""
    path = blurred(Drawing((rectangle((0.0, 0.0, 0.5, 1.0)),)), (0.05, 0.05))
    half = replace(Drawing.polygon([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]).paths[0], paint=path.paint, group=0)
    green = rectangle(SQUARE, Paint((0.0, 1.0, 0.0)))
    image = render_exact_colours(Drawing((green, half), groups=(Group(blend=Blend.MULTIPLY),)), 32)
    whole = np.broadcast_to(1.0 - 0.5 * means(0.0, 0.5, 0.05, np.arange(33) / 32), (32, 32))
    inside = np.arange(32)[::-1, None] + 8 < np.arange(32)  # far below the diagonal
    inside &= (np.arange(32)[:, None] > 7) & (np.arange(32)[:, None] < 24)
    assert worst(image[..., 1][inside], whole[inside]) < 0.05
    above = np.arange(32)[::-1, None] > np.arange(32) + 1
    assert (image[above] == (0.0, 1.0, 0.0, 1.0)).all()


def test_a_gradient_and_other_blurs_below_a_blur() -> None:
    """With as many points as a gradient needs, with fixed ones, and with those of blend modes: the same colours."""
    ramp = Gradient(((40.0, 0.0, 0.0), (0.0, 1.0, 0.0)), (Stop(0.0, ORANGE), Stop(1.0, (0.0, 0.0, 1.0))))
    flat = replace(ramp, stops=(Stop(0.0, (0.2, 0.4, 0.6)),))
    blurs = [blurred(Drawing((rectangle((0.2, 0.2, x, 0.7)),)), (0.03, 0.02), Paint(ORANGE, 0.6)) for x in (0.5, 0.8)]

    def rendered(*below: Path) -> NDArray[np.float32]:
        return render_exact_colours(Drawing((*below, *blurs), groups=(Group(blend=Blend.LIGHTEN),)), 12)

    one = rendered(rectangle(SQUARE, Paint((0.2, 0.4, 0.6))))
    assert worst(one, rendered(rectangle(SQUARE, Paint.from_gradient(flat)))) < 0.02
    lighter = rectangle(SQUARE, Paint((0.2, 0.4, 0.6)), group=0)
    assert worst(one, rendered(rectangle(SQUARE), lighter)) < 0.02
    mixed = rendered(rectangle(SQUARE, Paint.from_gradient(replace(ramp, to_ramp=((1.0, 0.0, 0.0), SAME[1])))))
    left = [1.0 - 0.6 * box_means((0.2, 0.2, x, 0.7), (0.03, 0.02), 240) for x in (0.5, 0.8)]
    through = (left[0] * left[1])[..., None]
    t = ((np.arange(240) + 0.5) / 240)[:, None]
    colour = (1.0 - t) * ORANGE + t * (0.0, 0.0, 1.0)
    expected = (colour * through + (1.0 - through) * ORANGE).reshape(12, 20, 12, 20, 3).mean(axis=(1, 3))
    assert worst(mixed[..., :3], expected) < 0.05


def test_colours_at_the_window_continue() -> None:
    source = Drawing((rectangle((0.0, 0.0, 0.5, 1.0)),))
    drawing = Drawing((blurred(source, (0.1, 0.1), window=(0.45, 0.4, 0.6, 0.6)),))
    image = render_exact_colours(drawing, 40)[..., 3]
    assert worst(image, np.broadcast_to(image[20], (40, 40))) < 0.02
    assert image[20, :18] == pytest.approx(np.full(18, below(np.array(0.5))), abs=1e-3)
    assert image[20, 24:] == pytest.approx(np.full(16, below(np.array(-1.0))), abs=1e-3)
    assert image[20, 20] == pytest.approx(below(np.array(-0.125)), abs=1e-3)


def test_copies_share_a_grid_and_have_their_own_colours(monkeypatch: pytest.MonkeyPatch) -> None:
    from vexture.renderers import faces

    calls = []
    original = faces.blurred_spline
    monkeypatch.setattr(faces, "blurred_spline", lambda *each: calls.append(each) or original(*each))
    shadow = blurred(Drawing((rectangle((0.2, 0.2, 0.8, 0.8)),)), (0.05, 0.05))
    left = rectangle((0.0, 0.0, 0.5, 1.0), shadow.paint)
    right = rectangle((0.5, 0.0, 1.0, 1.0), replace(shadow.paint, color=(0.0, 0.0, 1.0), opacity=0.5))
    image = render_exact_colours(Drawing((left, right)), 20)
    assert len(calls) == 1
    assert image[10, 9] == pytest.approx((1.0, 0.5, 0.0, 1.0), abs=2e-3)
    assert image[10, 10] == pytest.approx((0.0, 0.0, 0.5, 0.5), abs=2e-3)


def test_very_small_blurs_are_refused_unless_a_part_is_shown() -> None:
    drawing = Drawing((blurred(Drawing((rectangle((0.0, 0.0, 0.5, 1.0)),), name="card"), (1e-4, 1e-4)),))
    with pytest.raises(LimitError, match=r"a blur of card shows 10,000 x 10,000 of its deviations; the limit"):
        render_exact_colours(drawing, 16)
    row = render_exact_colours(drawing, (20, 1), np.array([[2e-5, 0.0, 0.4998], [0.0, -2e-5, 0.5]]))[0, :, 3]
    assert worst(row, means(-1.0, 0.5, 1e-4, 0.4998 + 2e-5 * np.arange(21))) < 0.07
