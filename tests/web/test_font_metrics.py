"""Kerning by tables and metrics of vertical text, which HarfBuzz in pages is built without, next to HarfBuzz's own."""

from pathlib import Path

import pytest
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables._k_e_r_n import KernTable_format_0
from test_typesetting import Oracle, assert_equal_places, places_of, set_texts, upright_font


def kerned_font(path: Path, apple: bool) -> Path:
    """A font with the ideographs of `upright_font`, of which some are moved together."""
    font = TTFont(upright_font(path))
    font["kern"] = newTable("kern")
    font["kern"].version = 1.0 if apple else 0
    pairs = KernTable_format_0(apple)
    pairs.version, pairs.coverage, pairs.tupleIndex = font["kern"].version, 0 if apple else 1, 0
    pairs.kernTable = {("one", "two"): 81, ("two", "one"): -77, ("one", "comma"): -150}
    font["kern"].kernTables = [pairs]
    font.save(path)
    return path


@pytest.mark.parametrize("apple", [False, True], ids=["windows", "apple"])
def test_fonts_with_a_table_of_kerning_are_kerned(tmp_path: Path, apple: bool) -> None:
    font = kerned_font(tmp_path / "kerned.ttf", apple)
    texts = ({"text": "漢字漢、"}, {"text": "漢字漢、", "features": "-kern"})
    (kerned, plain), keys = set_texts(tmp_path, [font], *texts)
    oracle = Oracle(font)
    assert_equal_places(places_of(kerned, keys), oracle.places("漢字漢、"))
    assert_equal_places(places_of(plain, keys), oracle.places("漢字漢、", {"kern": False}))
    assert kerned["places"] != plain["places"]


def test_lines_break_between_kerned_letters_as_if_alone(tmp_path: Path) -> None:
    font = kerned_font(tmp_path / "kerned.ttf", apple=False)
    style = {"maxWidth": 1.2, "lineHeight": 1}
    (broken, alone), _ = set_texts(tmp_path, [font], {"text": "漢字", **style}, {"text": "字"})
    assert [line["first"] for line in broken["lines"]] == [0, 1]
    assert broken["places"][3] == pytest.approx(alone["places"][0])
    assert broken["lines"][0]["right"] == pytest.approx(1.0)


TOPS = {"by the tops of glyphs": {"vmtx": 200}, "by origins": {"VORG": 700}, "by their middles": {}}


@pytest.mark.parametrize("name", TOPS)
def test_vertical_text_has_the_origins_of_its_font(tmp_path: Path, name: str) -> None:
    path = upright_font(tmp_path / "upright.ttf")
    font = TTFont(path)
    change = TOPS[name]
    if "vmtx" in change:
        font["vmtx"].metrics = dict.fromkeys(font.getGlyphOrder(), (900, change["vmtx"]))
    elif "VORG" in change:
        table = font["VORG"] = newTable("VORG")
        table.majorVersion, table.minorVersion, table.defaultVertOriginY = 1, 0, change["VORG"]
        table.VOriginRecords = {"two": 650}
    else:
        del font["vmtx"], font["vhea"]
    font.save(path)
    (result,), keys = set_texts(tmp_path, [path], {"text": "漢、字", "writingMode": "vertical-rl"})
    found = [
        (int(keys[shape].split(":")[2]), cluster, x - result["lines"][0]["baseline"], y)
        for shape, cluster, x, y in zip(
            result["shapes"], result["clusters"], result["places"][0::3], result["places"][1::3], strict=True
        )
    ]
    assert_equal_places(found, Oracle(path).places("漢、字", direction="ttb"))
