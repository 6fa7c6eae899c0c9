"""The report's comparison: what it lists, what it says, and that any drawing goes through it."""

import pytest

from vexture.base.errors import LimitError
from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.report import comparison
from vexture_evidence.report.comparison import compare, pictures_part, section, shapes_part
from vexture_evidence.report.page import json_text, page, pictures_of
from vexture_evidence.report.renderers import renderers_part
from vexture_evidence.report.section import Material, Section

pytestmark = pytest.mark.slow  # test_report_is_whole makes this section too


class Refused(ConvertedDrawing):
    """A drawing that an encoding cannot hold, without the minutes that making one takes."""

    def way(self, way, bits=None):
        raise LimitError(f"{self.name} has too many curves")


def material_of(tmp_path, *bodies):
    paths = []
    for number, body in enumerate(bodies):
        paths.append(tmp_path / f"drawing-{number}.svg")
        paths[-1].write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10">{body}</svg>')
    return Material(paths)


def tables_of(part):
    for item in part.items:
        if isinstance(item, Section):
            yield from tables_of(item)
        elif hasattr(item, "rows"):
            yield item


@pytest.fixture(scope="module")
def duck():
    return compare(ConvertedDrawing(example("duck")))


@pytest.fixture(scope="module")
def made(duck):
    return pictures_part(duck)


def row(table, name):
    return next(dict(zip(table.head, values, strict=True)) for values in table.rows if values[0] == name)


def test_bytes_are_equal_where_they_are_said_to_be(made):
    table = next(tables_of(made))
    packed = row(table, "packed")
    for kind, what in (("memory", "bytes: on the GPU"), ("file", "bytes: file")):
        for method in ("raster", "distance, spread 4"):
            found = row(table, f"{method}, equal {kind}")
            assert 0.8 * packed[what] < found[what] <= packed[what]
            assert found["mean error: outline 8×"] > 10 * packed["mean error: outline 8×"]
    assert [values[1] for values in table.rows if values[0] == "raster"] == list(comparison.RASTER_SIDES)


def test_captions_say_what_was_measured(made):
    table, picture = next(tables_of(made)), list(pictures_of([made]))[1]
    assert f"{row(table, 'packed')['bytes: on the GPU']:,} bytes" in picture.caption
    assert f"{row(table, 'raster, equal memory')['texels along a side']}² texels" in picture.caption
    assert [one.name for one in pictures_of([made])] == ["error-over-bytes", "equal-bytes"]


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_any_drawing_goes_through(tmp_path, monkeypatch):
    """Nothing in it; not square and in colours; the even-odd rule: without a GPU the bands alone are missing."""
    monkeypatch.setattr(comparison, "RASTER_SIDES", (16, 32))
    monkeypatch.setattr(comparison, "DISTANCE_SIDES", (16, 32))
    colours = '<path d="M0 0H15V10H0Z" fill="red"/><circle cx="15" cy="5" r="5" fill="blue" fill-opacity=".5"/>'
    holes = '<path fill-rule="evenodd" d="M1 1H9V9H1ZM3 3H7V7H3Z"/>'
    material = material_of(tmp_path, "", colours, holes)
    material.device = None
    found = section(material)
    assert [part.title for part in found.items if "Bands" in part.title] == []
    assert "no GPU" in found.text[-1]
    assert [len(table.rows) for table in tables_of(found)][1:] == [3, 3]
    assert "NaN" not in json_text({}, [found])
    assert not set("{}") & set(page("report", {}, [], [found]).partition("</style>")[2])  # all numbers are filled in


def test_what_an_encoding_cannot_hold_is_dashes_and_a_reason(tmp_path, monkeypatch):
    monkeypatch.setattr(comparison, "RASTER_SIDES", (16, 32))
    monkeypatch.setattr(comparison, "DISTANCE_SIDES", (16, 32))
    refused = Refused(example("ocean"))
    one = compare(refused)
    parts = [pictures_part(one), shapes_part([one]), renderers_part([refused])]
    tables = [next(tables_of(part)) for part in parts]
    assert [table.caption.count("Dashes: ocean has too many curves.") for table in tables] == [1, 1, 1]
    assert row(tables[0], "packed")["bytes: file"] is None
    assert tables[1].rows == [["ocean", *[None] * (len(tables[1].head) - 1)]]
    assert tables[2].rows[0][2:] == [None] * (len(tables[2].head) - 2)
    assert [picture.name for picture in pictures_of(parts)] == ["error-over-bytes"]


def test_bytes_of_all_drawings_stand_beside_one_another(duck):
    table = next(tables_of(shapes_part([duck, compare(ConvertedDrawing(example("simple-small")))])))
    assert [values[0] for values in table.rows] == ["duck", "simple-small"]
    assert all(len(values) == len(table.head) for values in table.rows)
    assert "on 2 of 2" in table.caption
    assert row(table, "duck")["raster: memory ×"] > 5
