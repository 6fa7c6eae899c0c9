"""Chapter 6 is answered whole, with figures that can be checked, for any drawing."""

import json
import re

import pytest

from vexture_evidence.report.discussion import section
from vexture_evidence.report.page import json_text, page, pictures_of
from vexture_evidence.report.section import Material, PrintedPicture, Section

pytestmark = pytest.mark.slow  # test_report_is_whole makes this section too

POINTS = ("6.1.1", "6.1.2", "6.2.1", "6.2.2", "6.2.3", "6.3", "6.4", "4.3.1", "4.2")


@pytest.fixture(scope="module")
def made():
    return section(Material([]))


def test_every_point_has_its_words_a_picture_and_two_figures(made):
    table, *points = made.items
    assert len(points) == len(POINTS)
    for point, number, row in zip(points, POINTS, table.rows, strict=True):
        assert isinstance(point, Section)
        assert number in point.title
        assert row[0] == point.title
        assert f"Thesis {number}" in point.text[0]
        assert "“" in point.text[0]
        assert any(text.startswith("Before: ") for text in point.text)
        assert any(text.startswith("After: ") for text in point.text)
        assert [type(item) for item in point.items] == [PrintedPicture]


def test_everything_is_better_after(made):
    for name, _, before, after in made.items[0].rows:
        if name.startswith("List limits"):
            assert before < after
        elif not name.startswith("Editing"):  # that is a time
            assert after < before / 3


def test_page_and_json_take_it(made):
    text = page("chapter", {}, [], [made])
    for point in made.items[1:]:
        assert f'id="{point.anchor}"' in text
    assert len({picture.name for picture in pictures_of([made])}) == len(POINTS)
    assert json.loads(json_text({}, [made]))["discussion"]["lines"]["before"] == made.items[0].rows[5][2]
    assert not re.search(r"\bnan\b|\binf\b", " ".join(picture.caption for picture in pictures_of([made])))


@pytest.mark.parametrize(
    "content",
    [
        "",
        pytest.param('<path d="M1 1h7v3h-4z"/>', marks=pytest.mark.slow),
        '<path d="M1 1h7v1h-7z" fill-rule="evenodd"/>',
    ],
)
@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_any_drawing_may_be_the_subject(tmp_path, content):
    path = tmp_path / "own drawing.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 5">{content}</svg>')
    material = Material([path])
    made = section(material)
    expected = "own drawing" if content else "duck"
    assert expected in made.items[0].rows[2][1]
    assert any("own drawing has no outline" in text for text in made.text) == (not content)
