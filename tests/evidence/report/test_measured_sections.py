"""Sections on conversions, drawings and structure: measured figures beside printed ones, for any drawing."""

import pytest
from lxml import html

from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, example
from vexture_evidence.measures.thesis_numbers import TABLE_5_1
from vexture_evidence.report import conversion, shapes, structure
from vexture_evidence.report.page import json_text, page, pictures_of
from vexture_evidence.report.section import Material, Printed, Table

pytestmark = pytest.mark.slow  # test_report_is_whole makes these sections too

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100">{paths}</svg>'
TEETH = "".join(f"L{x / 8} {60 if x % 2 else 40}" for x in range(1601))
PATHS = {
    "empty": "",
    "star": '<path fill-rule="evenodd" fill="#08f" d="M100 5L130 95 55 40H145L70 95Z"/><circle r="30"/>',
    "many": f'<path d="M0 100{TEETH}L200 100Z"/>',
}


@pytest.fixture(params=PATHS)
def own(request, tmp_path):
    file = tmp_path / f"{request.param}.svg"
    file.write_text(SVG.format(paths=PATHS[request.param]))
    return Material([file, example("holes")])


@pytest.fixture(scope="module")
def examples():
    """Three of the examples, as a report without sources has them."""
    material = Material([])
    material.shapes = tuple(map(material.example, ("simple-small", "duck", "ocean")))
    return material


def tables(section):
    return {item.name: item for item in section.items if isinstance(item, Table)}


def column(table, head):
    place = list(table.head).index(head)
    return [row[place] for row in table.rows]


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_own_drawings_make_whole_sections_with_nothing_printed(own):
    sections = [part.section(own) for part in (conversion, shapes, structure)]
    for section in sections:
        for table in tables(section).values():
            assert all(len(row) == len(table.head) for row in table.rows), table.name
            assert not any(isinstance(cell, Printed) for row in table.rows for cell in row)
    names = [picture.name for picture in pictures_of(sections)]
    assert len(names) == len(set(names))
    assert "printed" not in json_text({}, sections)
    made = html.fromstring(page("Own", {}, [], sections))
    assert [heading.text for heading in made.iter("h2")] == [section.title for section in sections]
    assert len(made.xpath("//tbody/tr")) == sum(len(table.rows) for part in sections for table in tables(part).values())
    assert made.xpath("//img/@src") == [f"figures/{name}.png" for name in names]


def test_table_5_1_has_the_thesis_beside_all_our_ways(examples):
    section = conversion.section(examples)
    first, second = tables(section)["conversion"], tables(section)["size-and-speed"]
    assert all(len(row) == len(first.head) for row in first.rows)
    assert all(len(row) == len(second.head) for row in second.rows)
    for table, head, field in (
        (first, "thesis, printed: ms", "ms"),
        (first, "thesis, printed: quads", "quads"),
        (first, "segments: thesis", "segments"),
        (second, "source: thesis", "svg"),
        (second, "thesis, printed: 16 bits", "bytes_16"),
        (second, "thesis, printed: fps", "fps"),
    ):
        expected = [getattr(TABLE_5_1[shape.name], field) for shape in examples.shapes]
        assert column(table, head) == list(map(Printed, expected))
    for way in WAYS:
        trees = [shape.way(way).tree for shape in examples.shapes]
        assert column(first, f"{way}: curves") == [len(tree.curves) for tree in trees]
        assert column(first, f"{way}: quads") == [len(tree.coverage) for tree in trees]
    files = [len(shape.way("packed").texture.to_ktx2()) for shape in examples.shapes]
    assert column(second, "packed: bytes") == files
    assert column(second, "source: ours") == [shape.path.stat().st_size for shape in examples.shapes]
    if examples.device:
        assert min(column(second, "packed: fps")) > 0


def test_what_an_encoding_cannot_hold_is_a_dash_and_a_reason(examples, monkeypatch):
    from vexture.base.errors import LimitError

    way = ConvertedDrawing.way

    def refusing(self, name, bits=None):
        if name == "sampled":
            raise LimitError("70,000 quads; the limit is 65,000")
        return way(self, name, bits)

    monkeypatch.setattr(ConvertedDrawing, "way", refusing)
    section = conversion.section(examples)
    assert column(tables(section)["conversion"], "sampled: ms") == [None] * 3
    assert "70,000 quads" in tables(section)["conversion"].caption
    assert "70,000 quads" in shapes.section(examples).items[0].caption
    parts = structure.section(examples)
    assert ["sampled", *[None] * 5] in tables(parts)["cells"].rows


def test_list_too_long_for_8_bits_is_a_dash_and_a_reason(tmp_path):
    file = tmp_path / "teeth.svg"
    teeth = "".join(f"L{x} {60 if x % 2 else 40}" for x in range(201))
    file.write_text(SVG.format(paths=f'<path d="M0 100{teeth}L200 100Z"/>'))
    table = tables(conversion.section(Material([file])))["size-and-speed"]
    assert column(table, "direct: 8 bits") == [None]
    assert "No bytes at 8 bits" in table.caption
