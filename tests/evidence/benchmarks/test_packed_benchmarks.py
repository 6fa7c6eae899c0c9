"""The benchmarks of the packed texture measure what they say."""

import doctest
from pathlib import Path

import numpy as np
import pytest

import corpora
import packed_conversion
import packed_fidelity
import seams
import size
import speed
import targets
import views
from vexture.base.errors import DeviceError
from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.exact import render_exact
from vexture.tree.build import build_tree
from vexture_evidence.measures import programs

SIDE = seams.SIDE


def test_examples_in_the_docstrings():
    found = [doctest.testmod(module) for module in (size, speed, targets)]
    assert all(one.attempted and not one.failed for one in found)


def stepped(angle, before, behind):
    """Half-plane picture of an outline in pixels through the middle, displaced before and behind it."""
    cosine, sine = np.cos(angle), np.sin(angle)
    far = 2.0 * SIDE
    along = [(-far, before), (0.0, before), (0.0, behind), (far, behind), (far, far), (-far, far)]
    points = [(SIDE / 2 + cosine * s - sine * d, SIDE / 2 + sine * s + cosine * d) for s, d in along]
    reach = 8.0 * SIDE  # everything inside a unit square of that many pixels
    square = Drawing.polygon([((x + reach / 2) / reach, 1.0 - (y + reach / 2) / reach) for x, y in points])
    view = np.array([[1.0 / reach, 0.0, 0.5], [0.0, -1.0 / reach, 0.5], [0.0, 0.0, 1.0]])
    return render_exact(square, (SIDE, SIDE), view), (float(cosine), float(sine))


@pytest.mark.parametrize("angle", [0.0, 0.3, 0.8, 1.5707963, 2.5, 4.0])
@pytest.mark.parametrize("step", [0.05, 0.4, -1.0])
def test_a_step_is_measured_in_pixels(angle, step):
    picture, direction = stepped(angle, 1.3, 1.3 + step)
    truth, _ = stepped(angle, 0.0, 0.0)
    assert seams.step_of(picture - truth, direction) == pytest.approx(abs(step), abs=0.01 + 0.05 * abs(step))


@pytest.mark.parametrize("angle", [0.0, 0.3, 0.8, 2.5])
def test_an_outline_displaced_as_a_whole_has_no_step(angle):
    picture, direction = stepped(angle, 3.0, 3.0)
    truth, _ = stepped(angle, 0.0, 0.0)
    assert seams.step_of(picture - truth, direction) < 0.01


def test_a_notch_at_the_border_is_a_step():
    truth, direction = stepped(0.4, 0.0, 0.0)
    crack = truth.copy()
    crack[SIDE // 2 - 1 : SIDE // 2 + 1, SIDE // 2 - 1 : SIDE // 2 + 1] = 0.0
    assert seams.step_of(crack - truth, direction) > 0.3


def test_crossings_lie_on_the_outline_and_on_borders():
    circle = corpora.round_shapes()[0]
    found = list(seams.crossings(build_tree(circle, precision=1e-6)))
    assert len(found) > 20
    for point, tangent in found:
        assert np.hypot(*(point - 0.5)) == pytest.approx(0.4, abs=2e-4)
        assert abs((point - 0.5) @ tangent) < 0.05
        assert min(np.abs(point * 64 - np.rint(point * 64))) < 1e-9  # leaves of 1/64 or larger


def test_shifted_views_show_the_whole_drawing():
    glyph = Drawing.polygon([(0.2, 0.3), (0.7, 0.3), (0.7, 0.9)])
    for case in packed_fidelity.CASES:
        area = 0.15 * (case.pixels**2 / case.stretch)
        for view in views.views_with_shifts(glyph, case.pixels, 3, seed=1, turn=case.turn, stretch=case.stretch):
            picture = render_exact(glyph, *view)
            assert picture.sum() == pytest.approx(area, rel=1e-3)


def test_views_of_the_times_show_the_outline():
    for drawing in corpora.round_shapes():
        for view, tile in speed.views_of(drawing, seed=1).values():
            picture = render_exact(drawing, *view)
            assert view.size == tile
            assert 0.02 < picture.mean() < 0.98


def test_targets_are_never_met_by_what_was_not_measured():
    unknown = targets.Target("nothing", None, 1.0, 0.5)
    assert not unknown.reaches(unknown.least)
    assert targets.target_facts([unknown])[0]["met"] is False
    assert "missed" in targets.target_table([unknown])


def test_sizes_of_a_square_by_hand():
    """One quad and four pieces; five texels of 8 bytes, 32 heads and two lists of two entries for the bands."""
    square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    facts = size.set_facts(size.SizeSet("squares", [square, square], 100))
    tree = build_tree(square)
    assert facts["packed"]["raw"] == 2 * 16 * (len(tree.count) + len(tree.curves))
    assert facts["bands"] == {"shared": 2 * 184, "unshared": 2 * (40 + 128 + 256), "left_out": 0}
    assert facts["thesis_16"]["raw"] == 2 * facts["thesis_8"]["raw"] > 0
    assert facts["edges"] == 8


def test_a_form_that_cannot_hold_a_drawing_says_so():
    ring = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75)], fill_rule=FillRule.EVENODD)
    assert size.band_facts([ring], 16) == {"shared": 0, "unshared": 0, "left_out": 1}


def test_within_a_tolerance_means_fewer_bytes():
    island = corpora.fractal_coastline(12_288, seed=1)
    raw = [size.set_facts(size.SizeSet("", [island], 0, 255, tolerance))["packed"]["raw"] for tolerance in (1e-9, 1e-3)]
    assert raw[1] < 0.5 * raw[0]


def test_a_batch_counts_what_it_converts():
    shapes = corpora.round_shapes()
    facts = packed_conversion.batch_facts("round", shapes, 1)
    assert facts["edges"] == sum(shape.segments for shape in shapes)
    assert facts["edges_per_second"] == pytest.approx(facts["edges"] / (facts["ms"] * 1e-3 * len(shapes)))
    assert len(packed_conversion.atlas(shapes).roots) == len(shapes)


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="the system does not tell its peak memory")
def test_peak_memory_is_seen():
    before = packed_conversion.peak_memory(reset=True)
    held = np.ones(64 << 17)
    assert 0.9 < (packed_conversion.peak_memory() - before) * 1024 / held.nbytes < 1.5
    del held
    assert packed_conversion.peak_memory(reset=True) - before < 16 << 10


def test_a_case_tells_a_right_picture_from_a_wrong_one():
    try:
        programs.driver()
    except DeviceError as error:
        pytest.skip(str(error))
    circle, ribbon = corpora.round_shapes()[::2]
    packed = programs.packed_texture(circle)
    shaders = packed_fidelity.programs_for(circle, packed, 16)
    case = packed_fidelity.ScaledCase(32, 30.0)
    facts = packed_fidelity.case_facts(circle, packed, shaders, case, 2, seed=1)
    assert facts["any"]["mae"] < 0.3 < facts["bands"]["mae"]
    assert facts["any"]["apart"] < 1.0
    other = packed_fidelity.case_facts(circle, programs.packed_texture(ribbon), shaders, case, 2, seed=1)
    assert other["any"]["apart"] > 100.0
    swapped = packed_fidelity.programs_for(ribbon, packed, 16)
    assert (
        packed_fidelity.case_facts(circle, packed, {"bands": swapped["bands"]}, case, 2, seed=1)["bands"]["mae"] > 30.0
    )
