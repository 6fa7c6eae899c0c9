"""Bands of gradients: at each point of a box, the band that its regions say has the colour of the gradient."""

from typing import NamedTuple

import numpy as np
import pytest

from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.tree.planar.bands import BANDS, MOST_BANDS, REGIONS, STEEP, add_bands, new_bands
from vexture.tree.planar.shades import Shades, shade_at, shade_of, shades_of

FOCI = (None, (0.0, 0.0), (0.5, 0.2), (0.3, 0.0), (1.0, 0.0), (1.5, 0.3), (0.7, 1.0), (1.8, 1.5), (0.3, 2.5))
"""Lines; nested circles; those that touch; cones, of circles that grow, stay and shrink; nested ones that shrink."""

WHOLE = np.array([[0.0, 0.0], [1.0, 1.0]])


class Bands(NamedTuple):
    gradients: list[Gradient]
    regions: list[np.ndarray]


def bands_of(gradient: Gradient, box: np.ndarray, at_all_stops: bool = False) -> Bands:
    """Bands of one gradient, as objects."""
    (row,), stops, _ = shades_of([gradient])
    found = add_bands(new_bands(4), row, stops, box, int(at_all_stops))
    shades = Shades(found.rows, found.stops, np.zeros(0, np.uint32))
    gradients = [shade_of(shades, number) for number in found.bands[: found.counts[BANDS]].tolist()]
    ends = np.cumsum(found.lengths[: found.counts[REGIONS]])
    return Bands(gradients, np.split(found.cubics, ends)[:-1])


T = np.linspace(0.0, 1.0, 33)[:-1, None]
BERNSTEIN = np.hstack([(1 - T) ** 3, 3 * T * (1 - T) ** 2, 3 * T**2 * (1 - T), T**3])


def are_inside(contour, points):
    """Whether points lie in a closed contour, by the even-odd rule on its chords."""
    if len(contour) == 0:
        return np.zeros(len(points), bool)
    begins = np.einsum("tk,nkd->ntd", BERNSTEIN, contour).reshape(-1, 2)
    ends = np.roll(begins, -1, axis=0)
    x, y = points[:, :1], points[:, 1:]
    rises = ends[:, 1] - begins[:, 1]
    at = begins[:, 0] + (y - begins[:, 1]) / np.where(rises == 0.0, 1.0, rises) * (ends[:, 0] - begins[:, 0])
    crosses = ((begins[:, 1] <= y) != (ends[:, 1] <= y)) & (at > x)
    return crosses.sum(axis=1) % 2 == 1


def random_gradient(rng, focus):
    count = rng.integers(2, 6)
    offsets = np.sort(np.round(rng.random(count), rng.integers(1, 3)))
    offsets[rng.integers(1, count)] = offsets[0]  # a hard stop
    stops = [
        Stop(float(offset), tuple(np.round(rng.random(3), 2).tolist()), float(rng.choice([0.0, 0.5, 1.0])))
        for offset in np.sort(offsets)
    ]
    to_ramp = rng.normal(size=(2, 3)) * rng.choice([1.0, 3.0])
    return Gradient(tuple(map(tuple, to_ramp.tolist())), tuple(stops), Spread(rng.integers(0, 3)), focus)


@pytest.mark.slow
@pytest.mark.parametrize("focus", FOCI)
def test_bands_have_the_colours_of_their_gradient(focus) -> None:
    rng, divided = np.random.default_rng(7), 0
    for _ in range(30):
        gradient, box = random_gradient(rng, focus), np.sort(rng.random((2, 2)), axis=0)
        bands = bands_of(gradient, box, bool(rng.integers(0, 2)))
        divided += len(bands.regions) > 0
        points = box[0] + rng.random((20, 2)) * (box[1] - box[0])
        numbers = sum((are_inside(region, points) for region in bands.regions), np.zeros(20, int))
        shades, found, wanted = shades_of([gradient, *bands.gradients]), np.zeros(4), np.zeros(4)
        for point, number in zip(points.tolist(), numbers.tolist(), strict=True):
            shade_at(shades, 0, *point, wanted)
            shade_at(shades, 1 + number, *point, found)
            np.testing.assert_allclose(found, wanted, atol=1e-3, err_msg=f"{gradient} at {point}")
    assert divided >= 5


def test_stripes_need_no_program() -> None:
    colours = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    stops = tuple(Stop(offset, colours[k]) for offset, k in ((0.0, 0), (0.5, 0), (0.5, 1), (1.0, 1)))
    stripes = Gradient(((4.0, 2.0, 0.1), (-2.0, 4.0, 0.0)), stops, Spread.REPEAT)
    square = Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]).paths[0].contours
    (planar,) = run(Drawing((Path(square, paint=Paint.from_gradient(stripes)),))).trees
    assert planar.programs == {}
    assert len(planar.paints) == 3


def test_a_cone_that_repeats_is_cut_in_each_period() -> None:
    stops = Stop(0.0, (0.0, 0.0, 0.0)), Stop(1.0, (1.0, 1.0, 1.0))
    cone = Gradient(((10.0, 0.0, 0.0), (0.0, 10.0, -5.0)), stops, Spread.REPEAT, (1.6, 0.0))
    assert len(bands_of(cone, WHOLE).regions) > 5


def test_a_steep_ramp_is_cut_at_its_stops() -> None:
    box, black, white = WHOLE, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    for focus in (None, (0.0, 0.0)):
        for wide, parts in ((0.5 * STEEP, 3), (2.0 * STEEP, 1)):
            ramp = Gradient(
                ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), (Stop(0.5, black), Stop(0.5 + wide, white)), focus=focus
            )
            gradients = bands_of(ramp, box).gradients
            assert len(gradients) == parts
            steep = next(each for each in gradients if len(each.stops) == 2)
            assert parts == 1 or [stop.offset for stop in steep.stops] == [0.0, 1.0]  # shaders divide by places


def test_a_jump_at_the_side_of_the_box_is_left_out() -> None:
    stops = tuple(Stop(offset, (shade,) * 3) for offset, shade in ((0.0, 0.0), (0.0, 0.2), (1.0, 0.8), (1.0, 1.0)))
    along = Gradient(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), stops)
    bands = bands_of(along, WHOLE)
    assert bands.regions == []
    assert [stop.color[0] for stop in bands.gradients[0].stops] == [0.2, 0.8]


def test_a_ramp_of_very_many_periods_stays_whole() -> None:
    stops = Stop(0.0, (0.0, 0.0, 0.0)), Stop(1.0, (1.0, 1.0, 1.0))
    fine = Gradient(((2.0 * MOST_BANDS, 0.0, 0.0), (0.0, 1.0, 0.0)), stops, Spread.REPEAT)
    assert bands_of(fine, WHOLE).regions == []


def test_equal_gradients_are_one_and_many_find_their_way() -> None:
    """Ramps of as many colours as need a larger table, each met twice."""
    ramps = [
        Gradient(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), (Stop(0.0, (k / 99, 0.0, 0.0)), Stop(1.0, (0.0, 0.0, 0.0))))
        for k in range(99)
    ]
    found = new_bands(4)
    for ramp in 2 * ramps:
        (row,), stops, _ = shades_of([ramp])
        found = add_bands(found, row, stops, WHOLE, 0)
    assert found.counts.tolist() == [99, 198, 198, 0, 0]
    assert found.bands[:198].tolist() == 2 * [*range(99)]
    shades = Shades(found.rows, found.stops, np.zeros(0, np.uint32))
    assert [shade_of(shades, number) for number in range(99)] == ramps


def test_equal_circles_of_one_place_paint_nothing() -> None:
    stops = Stop(0.0, (0.0, 0.0, 0.0)), Stop(1.0, (1.0, 1.0, 1.0))
    ring = Gradient(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), stops, Spread.REPEAT, (0.0, 1.0))
    assert bands_of(ring, WHOLE) == ([ring], [])
