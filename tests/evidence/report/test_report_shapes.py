"""The section on the example drawings."""

import pytest

from vexture_evidence.measures.thesis_numbers import TABLE_5_1
from vexture_evidence.report import shapes
from vexture_evidence.report.section import Material

pytestmark = pytest.mark.slow  # test_report_is_whole makes these sections too


def test_every_example_is_the_figure_of_its_number():
    material = Material([])
    material.shapes = tuple(map(material.example, list(TABLE_5_1)[:2]))
    captions = [item.caption for item in shapes.section(material).items]
    assert [caption[:25] for caption in captions] == ["Thesis 5.1. Simple small.", "Thesis 5.2. Simple big. `"]
    assert "13 quads, 18 curves" in captions[0]
