"""Drawings and their conversions, each made once."""

import pytest

from vexture.base.errors import LimitError, SourceError
from vexture.conversion.pipeline import convert
from vexture_evidence.measures import shape as measured
from vexture_evidence.measures.shape import ConvertedDrawing, example, file_bytes


@pytest.mark.slow
def test_bytes_of_a_packed_file_are_those_that_the_command_writes(tmp_path):
    shape = ConvertedDrawing(example("duck"))
    convert(shape.path, split=None).save(tmp_path / "duck.ktx2")
    assert file_bytes(shape.way("packed").texture) == (tmp_path / "duck.ktx2").stat().st_size


def test_a_conversion_is_made_once_for_each_way_and_number_of_bits():
    shape = ConvertedDrawing(example("duck"), "a duck")
    assert shape.name == "a duck"
    assert shape.way("direct") is shape.way("direct", 16)
    small = shape.way("direct", 8)
    assert small is not shape.way("direct")
    assert 0 < file_bytes(small.texture) < file_bytes(shape.way("direct").texture)


def test_what_an_encoding_cannot_hold_is_refused_again(monkeypatch):
    shape = ConvertedDrawing(example("duck"))
    monkeypatch.setattr(measured, "MOST_FOR_SAMPLED", 3)
    with pytest.raises(LimitError, match="so sampled would take minutes; the limit of a report is 3"):
        shape.way("sampled")
    monkeypatch.undo()
    with pytest.raises(LimitError, match="the limit of a report is 3"):
        shape.way("sampled")


def test_examples_that_are_not_there_are_named():
    with pytest.raises(SourceError, match=r"unicorn\.svg: no such example drawing"):
        example("unicorn")
