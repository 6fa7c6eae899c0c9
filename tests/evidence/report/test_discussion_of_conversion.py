"""Points of chapter 6 on conversion: their figures are those of the measures."""

import pytest

from vexture_evidence.measures.thesis_limits import unnecessary_quads
from vexture_evidence.report.discussion_of_conversion import LARGE, SMALL, divisions_point, values_point
from vexture_evidence.report.section import Material

pytestmark = pytest.mark.slow  # test_report_is_whole makes these points too


@pytest.fixture(scope="module")
def material():
    return Material([])


def test_unneeded_divisions_are_those_of_both_sizes(material):
    point = divisions_point(material, material.example("duck"))
    shapes = [material.example(name) for name in (SMALL, LARGE)]
    wanted = [int(unnecessary_quads(shape.drawing, shape.way("sampled").texture).sum()) for shape in shapes]
    assert point.before == sum(wanted) > 0
    assert point.after == 0
    assert point.section.text[1].startswith(f"Before: {wanted[0]} of the quads")


def test_only_rounding_remains_of_the_errors_of_stored_values(material):
    point = values_point(material, material.example("duck"))
    assert point.after <= 0.5  # half of a step of a byte
    assert point.before > 3.0 * point.after
