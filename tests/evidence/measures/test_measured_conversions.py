"""What is measured of a conversion is what it makes."""

from pathlib import Path

import pytest

import vexture
from both_encodings import decode
from vexture.base.errors import LimitError
from vexture_evidence.measures.conversions import measure_conversion
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, example

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><path d="{path}"/></svg>'


def drawn(folder: Path, path: str) -> ConvertedDrawing:
    file = folder / "drawn.svg"
    file.write_text(SVG.format(path=path))
    return ConvertedDrawing(file)


def test_a_pair_is_measured_at_8_and_at_16_bits():
    shape = ConvertedDrawing(example("thumb"))
    for way in ("sampled", "direct"):
        found = measure_conversion(shape, way)
        for bits, size in ((8, found.bytes_8), (16, found.bytes_16)):
            texture = vexture.convert(example("thumb"), encoding="thesis", strategy=way, bits=bits)
            assert size == sum(map(len, texture.to_png()))
        assert (found.quads, found.curves) == (len(texture.quads), len(texture.curves) - 2)
        assert found.depth == texture.depth + 1
        assert found.bytes_packed is found.fps is None
        assert found.ms > 0.0


def test_a_packed_texture_is_one_file():
    found = measure_conversion(ConvertedDrawing(example("thumb")), "packed")
    texture = vexture.convert(example("thumb"), split=None)
    tree = decode(texture)
    assert found.bytes_packed == pytest.approx(len(texture.to_ktx2()), abs=32)  # the source's name may be in it
    assert (found.quads, found.curves, found.depth) == (len(tree.count), len(tree.curves), texture.depth + 1)
    assert found.bytes_8 is found.bytes_16 is None


def test_what_8_bits_cannot_hold_has_16(tmp_path):
    teeth = "".join(f"L{x / 4} {60 if x % 2 else 40}" for x in range(401))
    shape = drawn(tmp_path, f"M0 100{teeth}L100 100Z")
    found = measure_conversion(shape, "direct")
    assert found.bytes_8 is None
    assert found.bytes_16 > 0


def test_what_cannot_be_held_is_refused_once(tmp_path, monkeypatch):
    shape = drawn(tmp_path, "M0 0H50V50Z")
    calls = []

    def refuse(*given, **parameters):
        calls.append(parameters)
        raise LimitError("too much")

    monkeypatch.setattr("vexture_evidence.measures.shape.convert_by", refuse)
    for _ in range(2):
        with pytest.raises(LimitError, match="too much"):
            shape.way("direct")
    assert len(calls) == 1


def test_what_would_take_minutes_is_refused(tmp_path):
    teeth = "".join(f"L{x / 2} {60 if x % 2 else 40}" for x in range(201))
    shape = drawn(tmp_path, f"M0 100{teeth}L100 100Z")
    assert len(shape.way("direct").tree.kind) > 3000
    with pytest.raises(LimitError, match="minutes"):
        shape.way("sampled")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_an_empty_drawing_has_one_quad(tmp_path, way):
    found = measure_conversion(drawn(tmp_path, ""), way)
    assert (found.quads, found.curves, found.depth) == (1, 0, 1)
