"""The page of a report: what it shows of sections, and what its JSON keeps."""

import json
import re

import numpy as np
import pytest
from lxml import html

from vexture_evidence.figures.style import panels, show
from vexture_evidence.report.page import json_text, known, page, pictures_of, png_of
from vexture_evidence.report.section import Printed, PrintedPicture, Section, Table


def picture(name="coverage"):
    figure, axes = panels(1, 1, titles=("Half",))
    show(axes[0, 0], np.array([[0.0, 1.0]]))
    return PrintedPicture(name, figure, "Half of it, by `show`; ⟦53.1 ms⟧.", "A white and a dark pixel")


def sections():
    table = Table(
        "bytes",
        "Bytes & more.",
        ["shape", "thesis: bytes", "thesis: ms", "ours: bytes"],
        [["<duck>", Printed(866), Printed(53.1), np.int64(1234)], ["cake", None, float("nan"), 0.000012]],
    )
    inner = Section("inner", "Inner", ("A `word`.",), (picture(),), {"mae": np.float32(0.5)})
    return [Section("sizes", "Sizes", ("First < second.",), (table, inner), {"ratio": 2.0})]


@pytest.fixture
def made():
    return html.fromstring(page("What & why", {"processor": "<one>", "cores": 2}, ["Lead."], sections()))


def test_page_shows_every_part_once(made):
    assert [made.findtext(".//h1"), made.findtext(".//h2"), made.findtext(".//h3")] == ["What & why", "Sizes", "Inner"]
    paragraphs = [paragraph.text for paragraph in made.xpath("//main/p")]
    assert (paragraphs[0], paragraphs[2], len(paragraphs)) == ("Lead.", "First < second.", 4)
    assert made.xpath("//dd/text()") == ["<one>", "2"]
    assert [link.get("href") for link in made.xpath("//nav//a")] == ["#sizes", "#inner"]
    (image,) = made.xpath("//figure//img")
    assert image.get("src") == "figures/coverage.png"
    assert image.get("alt") == "A white and a dark pixel"
    assert "".join(made.xpath("//figcaption")[0].itertext()) == "Half of it, by show; 53.1 ms."
    assert made.xpath("//figcaption/span[@class='printed']/text()") == ["53.1 ms"]


def test_section_table_and_picture_of_one_name_are_told_apart():
    one = Section("bytes", "Bytes", (), [Table("bytes", "", ["x"], [["row"]]), picture("bytes")])
    anchors = html.fromstring(page("", {}, [], [one])).xpath("//@id")
    assert anchors == ["bytes", "table-bytes", "figure-bytes"]


def test_links_within_the_page_lead_somewhere(made):
    anchors = set(made.xpath("//@id"))
    assert {link[1:] for link in made.xpath("//nav//a/@href")} <= anchors


def test_table_marks_what_was_printed_and_groups_its_columns(made):
    assert [(cell.text, cell.get("colspan")) for cell in made.xpath("//th[@colspan]")] == [
        (None, "1"), ("thesis", "2"), ("ours", "1"),
    ]  # fmt: skip
    rows = [[cell.text for cell in row.findall("td")] for row in made.xpath("//tbody/tr")]
    assert rows == [["<duck>", "866", "53.1", "1,234"], ["cake", "–", "–", "1.2·10"]]
    assert [cell.text for cell in made.xpath("//td[@class='printed']")] == ["866", "53.1"]


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.0, "0"), (0.5, "0.500"), (12.345, "12.3"), (-123.4, "-123"), (1e5, "100,000"), (7, "7"), (True, "yes")],
)
def test_numbers_have_three_significant_digits(value, shown):
    made = page("", {}, [], [Section("a", "", (), [Table("t", "", ["x", "y"], [["row", value]])])])
    assert re.findall(r"<td>([^<]*)</td>", made) == [shown]


def test_page_fetches_nothing(made):
    policy = made.xpath("//meta[@http-equiv]/@content")[0]
    assert policy.startswith("default-src 'none'")
    assert not made.xpath("//script|//link")


def test_json_keeps_whole_numbers_and_says_what_was_printed():
    facts = json.loads(json_text({"cores": 2}, sections()))
    assert facts["machine"] == {"cores": 2}
    assert facts["sizes"]["ratio"] == 2.0
    assert facts["sizes"]["inner"] == {"title": "Inner", "mae": 0.5}
    assert facts["sizes"]["bytes"]["rows"] == [
        ["<duck>", {"printed": 866}, {"printed": 53.1}, 1234], ["cake", None, None, 1.2e-05],
    ]  # fmt: skip
    assert known({"array": (np.float64(1.5), np.inf)}) == {"array": [1.5, None]}


def test_pictures_are_found_in_sections_within_sections():
    (found,) = pictures_of(sections())
    assert png_of(found).startswith(b"\x89PNG")
