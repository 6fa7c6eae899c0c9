"""The report's part on renderings: that it is whole, that its captions say what was measured, without a GPU too."""

import json
import re

import pytest

from vexture.base.errors import LimitError
from vexture_evidence.measures.renderings import at_sizes
from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.report.page import json_text, pictures_of
from vexture_evidence.report.rendering import section
from vexture_evidence.report.section import Material, Table

pytestmark = pytest.mark.slow  # test_report_is_whole makes this section too

FIGURES = ["3.13", "4.14", "4.15", "4.9, 4.10", "5.12", "2.7"]


class Refused(ConvertedDrawing):
    """A drawing that is too large for the thesis's encoding, without the minutes that making such a one takes."""

    def way(self, way, bits=None):
        if way == "sampled":
            raise LimitError("70000 curves; 16 bits hold 65000")
        return super().way(way, bits)


@pytest.fixture(scope="module")
def material():
    return Material([])


@pytest.fixture(scope="module")
def made(material):
    return section(material)


def tables(part):
    return {item.name: item for item in part.items if isinstance(item, Table)}


def test_every_figure_of_the_thesis_is_there(made):
    captions = [picture.caption for picture in pictures_of([made])]
    assert [re.match(r"Thesis ([\d., ]+)\. ", caption)[1] for caption in captions] == FIGURES
    facts = json.loads(json_text({}, [made]))[made.anchor]
    assert facts["title"] == made.title
    parts = {part.anchor: part for part in made.items}
    assert parts.keys() <= facts.keys()
    for name, part in parts.items():
        assert {table: facts[name][table]["head"] for table in tables(part)} == {
            table.name: list(table.head) for table in tables(part).values()
        }


def test_captions_and_tables_say_what_was_measured(made, material):
    sizes = made.items[0]
    last = at_sizes(material.main)[-1]
    rows = {row[0]: row[1:] for row in tables(sizes)["errors-at-sizes"].rows}
    for name, error in last.errors.items():
        assert rows[name][-1] == error.mae
        assert f"{name} {error.mae:.3g}" in sizes.items[0].caption
    assert len(rows["packed"]) == 5


def test_solutions_agree_with_the_gpu(made, material):
    table = tables(made.items[3])["solutions"]
    assert len(table.rows) == 9
    if material.device is not None:
        assert max(row[5] for row in table.rows) < 1e-6
        assert max(row[6] for row in table.rows) < 1e-6
        assert material.device in made.items[3].items[0].caption


def test_without_a_gpu_and_without_the_thesis_it_says_so():
    material = Material([example("simple-small")])
    material.device = None
    material.shapes = (Refused(example("simple-small")),)
    part = section(material)
    captions = " ".join(picture.caption for picture in pictures_of([part])) + " ".join(part.items[2].text)
    assert captions.count("70000 curves") == 4
    assert "no OpenGL" in captions
    assert all([row[2], *row[4:]] == [None] * 5 for row in tables(part.items[3])["solutions"].rows)
