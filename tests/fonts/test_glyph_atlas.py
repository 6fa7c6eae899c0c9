"""Atlases of fonts: text that is laid out by their metrics is the text that `vexture.text` draws."""

import json

import numpy as np
import pytest
from made import BLUE, RED, filled, made_font, solid, stacked

import vexture
from vexture.fonts.text import TextOptions, text_drawing


@pytest.fixture(scope="module")
def font(tmp_path_factory):
    file = tmp_path_factory.mktemp("atlas") / "made.ttf"
    paints = {"C": stacked(filled("square", solid(RED)), filled("tall", solid(BLUE)))}
    letters = {"A": "left", "V": "disc", "C": "square"}
    file.write_bytes(
        made_font(letters, paints, kerning=[("u0041", "u0056", -80), ("u0056", "u0041", 30)], alike={"Α": "A"})
    )
    return file


def test_text_by_the_metrics_is_where_the_text_is(font):
    made = vexture.font_atlas(font, "AV ")
    glyphs, kerning = made.metrics["glyphs"], made.metrics["kerning"]
    assert kerning == {"A": {"V": -0.08}, "V": {"A": 0.03}}
    drawing = text_drawing("AVA VA", TextOptions(font))
    boxes = [path.box @ drawing.to_source[:, :2].T + drawing.to_source[:, 2] for path in drawing.paths]
    x, found = 0.0, []
    for letter, following in zip("AVA VA", [*"VA VA", None], strict=True):
        entry = glyphs[letter]
        if entry["shape"] is not None:
            left, bottom, right, top = entry["box"]
            found.append([[x + left, -bottom], [x + right, -top]])
        x += entry["advance"] + kerning.get(letter, {}).get(following, 0.0)
    np.testing.assert_allclose(found, boxes, atol=1e-6)


def test_a_shape_is_its_glyph_in_the_square_that_the_metrics_name(font):
    made = vexture.font_atlas(font, "AC")
    entry = made.metrics["glyphs"]["A"]
    x, y, side = entry["square"]
    root = made.texture.roots[entry["shape"]]
    np.testing.assert_allclose(root.to_source, [[side, 0.0, x], [0.0, side, y]], atol=1e-6)
    inside = np.array([(0.3, 0.35), (0.05, 0.35), (0.55, 0.35)])  # of the left half, in ems
    assert made.texture.contains((inside - (x, y)) / side, entry["shape"]).tolist() == [True, False, False]
    assert entry["bearings"] == [0.1, 0.4]


def test_colours_are_a_map_and_glyphs_that_are_alike_share_a_shape(font):
    made = vexture.font_atlas(font, "CAΑ ")  # the second is Greek
    assert [(root.name, root.is_map) for root in made.texture.roots] == [("C", True), ("A", False), (".notdef", False)]
    assert [root.paint for root in made.texture.roots] == [None, None, None], "programs colour them"
    assert [made.metrics["glyphs"][letter]["shape"] for letter in "CAΑ"] == [0, 1, 1]
    assert made.metrics["glyphs"][" "] == {"shape": None, "advance": 0.9}
    assert made.metrics["lines"] == {
        "ascender": 0.8,
        "descender": -0.2,
        "line_gap": 0.0,
        "x_height": 0.5,
        "cap_height": 0.7,
        "underline": [-0.1, 0.05],
        "strikeout": made.metrics["lines"]["strikeout"],
    }


def test_missing_characters_are_named(font):
    with pytest.warns(vexture.SourceWarning, match=r"left out: character 'Z' \(U\+005A\), which Made lacks"):
        made = vexture.font_atlas(font, "AZ")
    assert made.metrics["missing"] == ["Z"]
    box = made.metrics["notdef"]
    assert made.texture.roots[box["shape"]].name == ".notdef"
    assert (box["box"], box["advance"]) == ([0.05, 0.0, 0.45, 0.7], 0.9)
    with pytest.raises(vexture.SourceError, match=r"Made has none of what is asked for \(2 characters\)"):
        vexture.font_atlas(font, "XY")
    with pytest.raises(vexture.SourceError, match="show nothing"):
        vexture.font_atlas(font, " ")
    with pytest.raises(vexture.LimitError, match="4,097 characters, of at most 4,096"):
        vexture.font_atlas(font, map(chr, range(0x4E00, 0x4E00 + 4097)))


def test_both_files_are_written(font, tmp_path):
    target = vexture.font_atlas(font, "AV", tolerance=0.0).save(tmp_path / "a.ktx2")
    assert [root.name for root in vexture.load(target).roots] == ["A", "V", ".notdef"]
    assert json.loads((tmp_path / "a.json").read_text())["glyphs"]["V"]["shape"] == 1


@pytest.mark.parametrize(
    ("characters", "message"),
    [
        ("", "`characters` is empty; give some, such as a text that holds them"),
        (["A", "AV"], "`characters` holds 'AV', which is not one character; give them one by one"),
        ([65], "`characters` holds 65, which is not one character; give them one by one"),
    ],
)
def test_characters_that_are_none_are_refused(characters, message):
    with pytest.raises(vexture.errors.ParameterError) as caught:
        vexture.font_atlas(characters=characters)
    assert str(caught.value) == message


def test_characters_that_a_font_lacks_are_named_by_the_parameter():
    with pytest.raises(
        vexture.errors.SourceError, match=r"has none of what is asked for .1 character.; give others as `characters`$"
    ):
        vexture.font_atlas(characters="\ue000")
