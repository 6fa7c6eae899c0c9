"""The section on other renderers: each is timed and judged."""

import pytest

from vexture_evidence.measures.shape import ConvertedDrawing, example
from vexture_evidence.report.comparison import compare
from vexture_evidence.report.renderers import bands_part, renderers_part
from vexture_evidence.report.section import Material, Section

pytestmark = pytest.mark.slow  # test_report_is_whole makes this section too


def tables_of(part):
    for item in part.items:
        if isinstance(item, Section):
            yield from tables_of(item)
        elif hasattr(item, "rows"):
            yield item


@pytest.fixture(scope="module")
def duck():
    return compare(ConvertedDrawing(example("duck")))


def row(table, name):
    return next(dict(zip(table.head, values, strict=True)) for values in table.rows if values[0] == name)


def test_renderers_are_timed_and_judged():
    table = next(tables_of(renderers_part([ConvertedDrawing(example("duck")), ConvertedDrawing(example("ocean"))])))
    duck = row(table, "duck")
    assert all(value > 0 for key, value in duck.items() if key.startswith("milliseconds"))
    assert duck["mean error: packed"] < 0.1 < min(duck["mean error: skia"], duck["mean error: resvg"])


def test_bands_are_drawn_where_they_can_be():
    material = Material([])
    if material.device is None:
        pytest.skip("no OpenGL")
    shapes = [material.example(name) for name in ("ocean", "duck", "simple-duo")]
    table = next(tables_of(bands_part(shapes, material.device)))
    ocean, duck = row(table, "ocean"), row(table, "duck")
    assert ocean["mean error: packed"] < ocean["mean error: bands"] < 5.0
    assert all(value is None for key, value in duck.items() if key.endswith("bands"))
    assert duck["milliseconds a frame: packed"] > 0
    assert "duck is filled by the even-odd rule" in table.caption
    assert "simple-duo has 2 paths" in table.caption
    assert "ocean" not in table.caption
