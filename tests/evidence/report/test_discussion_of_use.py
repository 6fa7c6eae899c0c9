"""Points of chapter 6 on the use of textures: their figures are those of the measures."""

import pytest

from vexture_evidence.report.discussion_of_use import crossings_point, editing_point
from vexture_evidence.report.section import Material, PrintedPicture

pytestmark = pytest.mark.slow  # test_report_is_whole makes these points too


@pytest.fixture(scope="module")
def material():
    return Material([])


def test_editing_is_timed_for_the_duck_and_changes_nothing_else(material):
    point = editing_point(material, material.example("holes"))
    (picture,) = point.section.items
    assert isinstance(picture, PrintedPicture)
    assert point.quantity == "time to convert the duck, ms"
    assert point.before > 0.0 < point.after
    assert f"{point.after:.1f} ms" in point.section.text[2]
    assert f"{point.before:.0f} ms here by `sampled`" in point.section.text[1]


def test_a_point_has_its_name_in_the_chapter_and_is_better_after(material):
    point = crossings_point(material, material.example("duck"))
    assert "6." in point.section.title
    assert point.after < point.before / 3
