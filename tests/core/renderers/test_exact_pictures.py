"""The exact renderer's pictures: by hand, by exact weights of rows and columns, and by very many points."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.drawing.affine import Affine
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import view_matrix, window

LEVEL = 1 / 255
WHOLE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
TURNED: Affine = ((7.0, 2.5, -1.0), (1.5, -6.0, 5.5))


def noise(columns: int, rows: int, seed: int = 0) -> NDArray[np.uint8]:
    """Premultiplied pixels of all opacities."""
    pixels = np.random.default_rng(seed).integers(0, 256, (rows, columns, 4)).astype(np.uint8)
    pixels[..., :3] = np.minimum(pixels[..., :3], pixels[..., 3:])
    return pixels


def noisy(to_pixels: Affine, columns: int, rows: int, sampling: Sampling, opacity: float = 1.0) -> Picture:
    """A picture of noise, of colours or, if the sampling says so, of opacities of a flat colour."""
    if sampling.components == 4:
        return Picture(to_pixels, noise(columns, rows), sampling, opacity)
    return Picture(to_pixels, noise(columns, rows)[..., 3:].copy(), sampling, opacity, (1.0, 0.25, 0.5))


def upright(columns: int, rows: int) -> Affine:
    """The map of a picture that fills the unit square."""
    return (float(columns), 0.0, 0.0), (0.0, -float(rows), float(rows))


def painted(picture: Picture, corners: list[tuple[float, float]] = WHOLE, group: int = -1) -> Path:
    return replace(Drawing.polygon(corners).paths[0], paint=Paint.from_picture(picture), group=group)


def shares(places: NDArray[np.float64], count: int, sampling: Sampling) -> NDArray[np.float64]:
    """Share of each of some pixels in a row in the means between consecutive places, (places - 1, count)."""

    def step(x: NDArray[np.float64]) -> NDArray[np.float64]:  # integral of a box, or of a hat, up to x
        if sampling is Sampling.PIXELS:
            return np.clip(x, 0.0, 1.0)
        if sampling >= Sampling.SPLINE:
            places = np.clip(x + 1.5, 0.0, 4.0)
            powers = [sign * np.maximum(places - k, 0.0) ** 4 / 24 for k, sign in enumerate((1, -4, 6, -4, 1))]
            return np.asarray(sum(powers))
        rising, falling = np.clip(x + 0.5, 0.0, 1.0), np.clip(x - 0.5, 0.0, 1.0)
        return 0.5 * rising**2 + falling - 0.5 * falling**2

    beyond = int(np.ceil(np.abs(places).max())) + 2  # pixels beyond both ends, which continue the borders
    every = np.arange(-beyond, count + beyond)
    integral = step(places[:, None] - every)
    each = np.diff(integral, axis=0) / np.diff(places)[:, None]
    found = np.zeros((len(each), count))
    np.add.at(found.T, np.clip(every, 0, count - 1), each.T)
    return found


def means(picture: Picture, size: int) -> NDArray[np.float64]:
    """The means of an upright picture over the pixels of a square image that it fills or more."""
    (across, _, left), (_, down, top) = picture.to_pixels
    sides = np.arange(size + 1) / size
    rows, columns = picture.pixels.shape[:2]
    by_rows = shares(top + down * (1.0 - sides), rows, picture.sampling)
    by_columns = shares(left + across * sides, columns, picture.sampling)
    sums: NDArray[np.float64] = np.einsum("ri,cj,ijk->rck", by_rows, by_columns, picture.pixels, optimize=True)
    return painted_with(picture, sums / 255)


def painted_with(picture: Picture, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Premultiplied colours of a picture where its pixels, or means of them, have some values in 0..1."""
    if picture.color is not None:
        values = 1.0 - values if picture.sampling is Sampling.INVERSE else values
        values = values * (*picture.color, 1.0)
    return picture.opacity * values


def colours_at(picture: Picture, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """`Picture.color_at` of many points."""
    column, row = (a * x + b * y + c for a, b, c in picture.to_pixels)
    rows, columns = picture.pixels.shape[:2]
    total = np.zeros((*x.shape, picture.sampling.components))
    across, down = (shares_at(place, picture.sampling) for place in (column, row))
    for i, share in across:
        for j, part in down:
            at = np.clip(j, 0, rows - 1), np.clip(i, 0, columns - 1)
            total += (share * part)[..., None] * picture.pixels[at]
    return painted_with(picture, total / 255)


def shares_at(place: NDArray[np.float64], sampling: Sampling) -> list[tuple[NDArray[np.int64], NDArray[np.float64]]]:
    """Columns or rows that have a part in the colours at some places, and their shares."""
    if sampling is Sampling.PIXELS:
        return [(np.floor(place).astype(int), np.ones_like(place))]
    first = np.floor(place - 0.5).astype(int)
    t = place - 0.5 - first
    if sampling is Sampling.LINEAR:
        return [(first, 1.0 - t), (first + 1, t)]
    weights = (1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3
    return [(first - 1 + k, weight / 6) for k, weight in enumerate(weights)]


def many_points(picture: Picture, matrix: NDArray[np.float64], size: int, finer: int) -> NDArray[np.float64]:
    """Means over very many points of each pixel of a square image; `matrix` maps its pixels to the unit square."""
    sides = (np.arange(size * finer) + 0.5) / finer
    x, y = np.meshgrid(sides, sides)
    X, Y, W = (a * x + b * y + c for a, b, c in matrix)
    found = colours_at(picture, X / W, Y / W).reshape(size, finer, size, finer, 4)
    whole: NDArray[np.float64] = found.mean(axis=(1, 3))
    return whole


def square_view(size: int) -> NDArray[np.float64]:
    return np.array([[1 / size, 0, 0], [0, -1 / size, 1], [0, 0, 1]])


def worst(one: NDArray[np.floating], other: NDArray[np.floating]) -> float:
    return float(np.abs(one - other).max()) / LEVEL


@pytest.mark.parametrize("sampling", list(Sampling))
def test_many_points_are_those_of_the_picture(sampling: Sampling) -> None:
    picture = noisy(TURNED, 5, 4, sampling, 0.75)
    x, y = np.random.default_rng(1).random((2, 200))
    expected = [picture.color_at(*point) for point in zip(x, y, strict=True)]
    assert np.allclose(colours_at(picture, x, y), expected, rtol=0.0, atol=1e-12)


# ---- upright


def test_an_edge_of_pixels_in_a_pixel_is_exact() -> None:
    """Of the first pixel three quarters, of the second one a quarter."""
    ends = np.array([[[255, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
    red = Picture(((1.0, 0.0, 0.25), (0.0, 1.0, 0.0)), ends, Sampling.PIXELS)
    assert render_exact_colours(Drawing((painted(red),)), 1)[0, 0] == pytest.approx([0.75, 0.0, 0.0, 0.75], abs=1e-6)


def test_a_line_between_centres_is_exact() -> None:
    """Half of it constant beyond the first centre; then a quarter of the way to the next: 1 - (1/4)(1/4)/2."""
    ends = np.array([[[255, 0, 0, 255], [0, 0, 0, 0]]], np.uint8)
    red = Picture(((0.75, 0.0, 0.0), (0.0, 1.0, 0.0)), ends)
    expected = (0.5 + 0.25 - 0.25**2 / 2) / 0.75
    assert render_exact_colours(Drawing((painted(red),)), 1)[0, 0, 0] == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("sampling", list(Sampling))
@pytest.mark.parametrize("columns", [3, 37, 111])
def test_upright_pictures_are_exact(sampling: Sampling, columns: int) -> None:
    picture = noisy(upright(columns, columns), columns, columns, sampling, 0.6)
    assert worst(render_exact_colours(Drawing((painted(picture),)), 37), means(picture, 37)) < 0.003


@pytest.mark.parametrize("sampling", [Sampling.PIXELS, Sampling.LINEAR])
def test_upright_pictures_of_many_pixels_are_exact(sampling: Sampling) -> None:
    picture = noisy(upright(512, 512), 512, 512, sampling, 0.6)
    assert worst(render_exact_colours(Drawing((painted(picture),)), 37), means(picture, 37)) < 0.001


@pytest.mark.parametrize("sampling", list(Sampling))
def test_borders_continue(sampling: Sampling) -> None:
    picture = noisy(((3.0, 0.0, 1.0), (0.0, -3.0, 1.5)), 2, 2, sampling)
    assert worst(render_exact_colours(Drawing((painted(picture),)), 5), means(picture, 5)) < 0.001


def test_a_flat_slope_meets_every_column() -> None:
    """An edge that crosses all columns of the image, and more of the picture than can be cut, in one row of pixels."""
    picture = Picture(((1600.0, 0.0, 0.0), (0.0, 1.0, 0.0)), noise(1600, 1), Sampling.PIXELS)
    corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1 / 16)]
    row = render_exact_colours(Drawing((painted(picture, corners),)), 16)[15]
    heights = 1.0 - (np.arange(1600) + 0.5) / 1600
    expected = (picture.pixels[0] * LEVEL * heights[:, None]).reshape(16, 100, 4).mean(axis=1)
    assert worst(row, expected) < 0.001


def test_more_columns_in_a_pixel_than_can_be_cut_are_refused() -> None:
    picture = Picture(((4000.0, 0.0, 0.0), (0.0, 1.0, 0.0)), noise(4000, 1))
    with pytest.raises(LimitError, match="more than 1,024 columns and rows of a picture meet a line in one pixel"):
        render_exact_colours(Drawing((painted(picture),), name="strip"), 2)
    assert worst(render_exact_colours(Drawing((painted(picture),)), 4), means(picture, 4)) < 0.001


# ---- turned


@pytest.mark.parametrize("sampling", list(Sampling))
def test_turned_pictures_by_very_many_points(sampling: Sampling) -> None:
    picture = noisy(TURNED, 6, 5, sampling)
    image = render_exact_colours(Drawing((painted(picture),)), 4)
    assert worst(image, many_points(picture, square_view(4), 4, 300)) < 0.3


@pytest.mark.parametrize("sampling", list(Sampling))
def test_very_many_turned_pixels_in_one(sampling: Sampling) -> None:
    """More corners in a pixel than it is cut at."""
    turned = ((45.0, 25.0, -5.0), (20.0, -45.0, 35.0))
    picture = noisy(turned, 50, 50, sampling)
    image = render_exact_colours(Drawing((painted(picture),)), 1)
    assert worst(image, many_points(picture, square_view(1), 1, 1000)) < 0.2


@pytest.mark.parametrize("angle", [1e-6, 1e-15])
def test_very_many_pixels_that_are_hardly_turned(angle: float) -> None:
    """Rows that cross a pixel of the image within much less than its cuts."""
    straight = Picture(upright(120, 120), noise(120, 120), Sampling.PIXELS)
    turned = replace(straight, to_pixels=((120.0, 120.0 * angle, 0.0), (120.0 * angle, -120.0, 120.0)))
    assert worst(render_exact_colours(Drawing((painted(turned),)), 2), means(straight, 2)) < 0.02


def test_pictures_in_perspective() -> None:
    picture = Picture(upright(8, 8), noise(8, 8), Sampling.PIXELS)
    matrix = np.array([[0.2, 0.02, 0.1], [0.03, -0.15, 0.9], [0.1, 0.05, 1.0]])
    image = render_exact_colours(Drawing((painted(picture),)), 4, matrix)
    corners = [(0, 0), (4, 0), (4, 4), (0, 4)]
    inside = [matrix @ (*corner, 1.0) for corner in corners]
    assert all(0 < p[0] / p[2] < 1 and 0 < p[1] / p[2] < 1 for p in inside)
    assert worst(image, many_points(picture, matrix, 4, 300)) < 0.3


def test_a_view_turns_a_picture() -> None:
    picture = Picture(upright(16, 16), noise(16, 16))
    matrix = view_matrix(window(0.3, 0.3, 0.3, 0.3, 30.0), (5, 5))
    image = render_exact_colours(Drawing((painted(picture),)), 5, matrix)
    assert worst(image, many_points(picture, matrix, 5, 300)) < 0.1


# ---- together


def test_a_mean_of_a_product_is_none_of_means() -> None:
    """Stripes of black and white multiplied by themselves are themselves; by their neighbours, black."""
    stripes = np.zeros((1, 64, 4), np.uint8)
    stripes[..., 3] = 255
    stripes[:, ::2, :3] = 255
    picture = Picture(upright(64, 1), stripes, Sampling.PIXELS)
    twice = Drawing((painted(picture), painted(picture, group=0)), groups=(Group(blend=Blend.MULTIPLY),))
    assert render_exact_colours(twice, 2)[0, 0] == pytest.approx([0.5, 0.5, 0.5, 1.0], abs=1e-5)
    other = replace(picture, to_pixels=((64.0, 0.0, 1.0), (0.0, -1.0, 1.0)))  # a stripe further: nothing is left
    none = Drawing((painted(picture), painted(other, group=0)), groups=(Group(blend=Blend.MULTIPLY),))
    assert render_exact_colours(none, 2)[0, 0, 0] == pytest.approx(0.0, abs=1e-5)


def test_an_opaque_picture_hides_and_a_translucent_one_does_not() -> None:
    pixels = np.full((1, 1, 4), 255, np.uint8)
    below = replace(Drawing.polygon(WHOLE).paths[0], paint=Paint((1.0, 0.0, 0.0)))
    white = painted(Picture(upright(1, 1), pixels))
    assert render_exact_colours(Drawing((below, white)), 1)[0, 0].tolist() == [1.0, 1.0, 1.0, 1.0]
    faded = replace(white, paint=white.paint.fade(0.5))
    assert render_exact_colours(Drawing((below, faded)), 1)[0, 0] == pytest.approx([1.0, 0.5, 0.5, 1.0], abs=1e-6)


def test_a_picture_masks_by_its_luminance() -> None:
    pixels = np.array([[[255, 255, 255, 255], [0, 0, 0, 255]]], np.uint8)
    mask = painted(Picture(upright(2, 1), pixels, Sampling.PIXELS), group=1)
    green = replace(Drawing.polygon(WHOLE).paths[0], paint=Paint((0.0, 1.0, 0.0)), group=0)
    masked = Drawing((green, mask), groups=(Group(), Group(0, mask=Mask.LUMINANCE)))
    image = render_exact_colours(masked, (2, 1), [[0.5, 0, 0], [0, -1, 1]])
    assert image[0].tolist() == [pytest.approx([0.0, 1.0, 0.0, 1.0], abs=1e-5), [0.0, 0.0, 0.0, 0.0]]


def test_copies_of_a_picture_share_its_pixels_and_other_pictures_have_their_own() -> None:
    one = Picture(upright(2, 2), noise(2, 2, 1), Sampling.PIXELS)
    two = Picture(upright(2, 2), noise(2, 2, 2), Sampling.PIXELS)
    halves = [(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)], [(0.5, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 1.0)]
    image = render_exact_colours(Drawing((painted(two, halves[0]), painted(one, halves[1]))), 2)
    expected = np.concatenate([two.pixels[:, :1], one.pixels[:, 1:]], axis=1) * LEVEL
    assert worst(image, expected) < 0.001
