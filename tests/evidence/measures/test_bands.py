"""The competitor is a fair one: it does what its description says, and its pixels are right."""

import doctest
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import corpora
import views
from vexture.base.errors import DeviceError, LimitError, SourceError
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.renderers.exact import render_exact
from vexture_evidence.measures import bands, programs
from vexture_evidence.measures.metrics import errors

SQUARE = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])


@pytest.fixture(scope="module")
def six():
    """The six glyphs of the fidelity tables."""
    try:
        return corpora.glyphs(corpora.dejavu_sans(), "agR&8@")
    except SourceError as error:
        pytest.skip(str(error))


@pytest.fixture
def gpu():
    try:
        return programs.driver()
    except DeviceError as error:
        pytest.skip(str(error))


def test_examples_in_the_docstrings():
    found = doctest.testmod(views)
    assert found.attempted
    assert not found.failed


HEIGHTS = st.integers(-(2**20), 2**20).map(lambda number: number / 2**20)  # of smaller ones the grid's products vanish


@given(st.tuples(*[HEIGHTS] * 3))
def test_eligible_roots_are_the_changes_of_side(heights):
    """Counted on a fine grid of t: falls minus rises across 0, whatever the roots do between."""
    t = np.linspace(0, 1, 1001)
    y1, y2, y3 = heights
    above = y1 * (1 - t) ** 2 + 2 * y2 * t * (1 - t) + y3 * t**2 > 0
    above[0], above[-1] = y1 > 0, y3 > 0
    code = bands.eligible_roots() >> 2 * ((y1 > 0) + 2 * (y2 > 0) + 4 * (y3 > 0)) & 3
    assert (code & 1) - (code >> 1) == int(above[0]) - int(above[-1])
    if above.any() and not above.all():
        assert code


def test_quadratics_come_back_exactly(six):
    (contour, *_) = bands.quadratic_contours(six[0])
    cubics = six[0].paths[0].contours[0]
    assert len(contour) == len(cubics)
    raised = contour[:, 1] * 2 / 3 + contour[:, 0] / 3
    assert np.abs(raised - cubics[:, 1]).max() < 1e-15


def test_cubics_are_within_the_tolerance():
    (circle,) = bands.quadratic_contours(corpora.round_shapes()[0], 1e-4)
    t = np.linspace(0, 1, 50)[:, None]
    points = [(1 - t) ** 2 * p[0] + 2 * t * (1 - t) * p[1] + t**2 * p[2] for p in circle]
    off = np.abs(np.hypot(*(np.concatenate(points) - 0.5).T) - 0.4)
    assert 1e-5 < off.max() < 1e-4 + 1.1e-4  # the cubic circle is itself 1.1e-4 off
    assert np.array_equal(circle[1:, 0], circle[:-1, 2])


def test_a_ray_through_a_band_meets_the_curves_of_its_list_only(six):
    for drawing in six:
        made = bands.band_texture(drawing)
        low, density = made.box[:2], made.box[2:]
        curves = np.concatenate(bands.quadratic_contours(drawing))
        for axis in (1, 0):
            for level in np.random.default_rng(1).random(200) * bands.BANDS:
                head = int(made.lists[int(level) + (0 if axis else bands.BANDS)])
                listed = made.lists[head >> bands.COUNT_BITS :][: head & (1 << bands.COUNT_BITS) - 1]
                texels = [made.outlines[[i, i + 1]].reshape(-1)[:6].reshape(3, 2) for i in listed]
                reach = [points[:, 1 - axis].max() for points in texels]
                assert reach == sorted(reach, reverse=True)
                value = low[axis] + level / density[axis]
                crossed = (curves[:, :, axis].min(axis=1) < value) & (curves[:, :, axis].max(axis=1) > value)
                found = [(p[:, axis].min() < value) & (p[:, axis].max() > value) for p in texels]
                assert sum(found) == crossed.sum()


def test_size_is_that_of_the_definition():
    """Four lines: five texels of 8 bytes; 32 heads; one list of two for each direction, for all its bands alike."""
    made = bands.band_texture(SQUARE)
    assert made.published_bytes == 5 * 8 + 32 * 4 + 2 * 2 * 4
    assert made.unshared_bytes == 5 * 8 + 32 * 4 + 32 * 2 * 4


def test_even_odd_and_empty_drawings_are_refused():
    path = replace(SQUARE.paths[0], fill_rule=FillRule.EVENODD)
    with pytest.raises(LimitError, match="even-odd"):
        bands.band_texture(Drawing((path,)))
    with pytest.raises(LimitError, match="is empty"):
        bands.band_texture(Drawing((Path(()),)))


@pytest.mark.usefixtures("gpu")
@pytest.mark.parametrize(("pixels", "published"), [(64, 2.2), (16, 7.5), (8, 12.0), (4, 19.0)])
def test_its_errors_are_those_that_are_known_of_it(six, pixels, published):
    found = []
    for drawing in six:
        program = programs.band_program(bands.band_texture(drawing))
        taken = list(views.views_with_shifts(drawing, pixels, 4, seed=1))
        images = np.stack([program.image(*view) for view in taken])
        found.append(errors(images, np.stack([render_exact(drawing, *view) for view in taken])).mae)
    assert 0.8 * published < np.mean(found) < 1.1 * published


@pytest.mark.usefixtures("gpu")
@pytest.mark.parametrize("pixels", [64, 512, pytest.param(2048, marks=pytest.mark.slow)])
def test_inside_is_one_and_outside_is_none(six, pixels):
    for drawing in [*six, *corpora.round_shapes(), corpora.fractal_coastline(768, seed=1)]:
        made = bands.band_texture(drawing)
        (view,) = views.views_with_shifts(drawing, pixels, 1, seed=1)
        image, truth = programs.band_program(made).image(*view), render_exact(drawing, *view)
        around = np.pad(truth, 1, "edge")
        near = [
            around[1 + y : 1 + y + truth.shape[0], 1 + x : 1 + x + truth.shape[1]]
            for x in (-1, 0, 1)
            for y in (-1, 0, 1)
        ]
        inside, outside = np.min(near, axis=0) > 1 - 1e-6, np.max(near, axis=0) < 1e-6
        assert np.abs(image[inside] - 1).max(initial=0) < 1 / 255
        assert image[outside].max() < 1 / 255


@pytest.mark.usefixtures("gpu")
def test_rays_are_weighted_by_how_near_they_cross():
    """An edge of slope 2, 0.2 pixels right of the pixel's centre and 0.4 below it: 0.3 by one ray, 0.1 by the other."""
    steep = Drawing.polygon([(0.3, 0.1), (0.9, 0.1), (0.9, 0.9), (0.7, 0.9)])
    pixel = 1 / 64
    view = np.array([[pixel, 0.0, 0.5 - 0.7 * pixel], [0.0, -pixel, 0.5 + 0.5 * pixel], [0.0, 0.0, 1.0]])
    (coverage,) = programs.band_program(bands.band_texture(steep)).image((1, 1), view).ravel()
    assert coverage == pytest.approx((0.3 * 0.6 + 0.1 * 0.2) / 0.8, abs=1e-4)
