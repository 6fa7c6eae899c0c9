"""Atlases of fonts: text that is laid out by their metrics is the text that `vexture.text` draws."""

import json

import numpy as np
import pytest
from made import BLUE, RED, box, compress_font, fill_shape, made_font, solid, stack_paints

import vexture
from vexture.base.notes import Notes
from vexture.conversion.glyph_atlas import faces_of_characters
from vexture.fonts.library import font_files, of_files
from vexture.fonts.text import TextOptions, text_drawing


@pytest.fixture(scope="module")
def font(tmp_path_factory):
    file = tmp_path_factory.mktemp("atlas") / "made.ttf"
    paints = {"C": stack_paints(fill_shape("square", solid(RED)), fill_shape("tall", solid(BLUE)))}
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
    with pytest.raises(vexture.base.errors.ParameterError) as caught:
        vexture.font_atlas(characters=characters)
    assert str(caught.value) == message


def test_characters_that_a_font_lacks_are_named_by_the_parameter():
    with pytest.raises(
        vexture.base.errors.SourceError,
        match=r"has none of what is asked for .1 character.; give others as `characters`$",
    ):
        vexture.font_atlas(characters="\ue000")


@pytest.fixture(scope="module")
def web_fonts(tmp_path_factory):
    """A folder as packages of web fonts are: weights in subsets, some letters in several; and one weight of its own."""
    pytest.importorskip("brotli", reason="brotli is not installed: pip install 'vexture[text]'")
    folder = tmp_path_factory.mktemp("web-fonts")
    for weight, family, style in ((400, "Made", "Regular"), (700, "Made", "Bold"), (900, "Made Black", "Regular")):
        for subset, letters in (("cyrillic", "Aж"), ("latin", "AV"), ("latin-ext", "Aą")):
            shapes = dict.fromkeys(letters, box(100, 0, 100 + weight // 2, 700))
            kerning = [("u0041", "u0056", -weight // 10)] if "V" in letters else None
            content = made_font(shapes, family=family, weight=weight, style=style, kerning=kerning)
            (folder / f"made-{subset}-{weight}.woff2").write_bytes(compress_font(content))
    return folder


def test_characters_come_from_all_subsets_of_the_face_that_is_asked_for(web_fonts):
    with pytest.warns(vexture.SourceWarning) as caught:
        made = vexture.font_atlas(web_fonts, "AVąж字", weight=700)
    (warning,) = caught
    assert str(warning.message).endswith("left out: character '字' (U+5B57), which Made lacks")
    assert made.metrics["font"] == {"family": "Made", "weight": 700, "style": "normal", "stretch": 100.0}
    assert made.metrics["missing"] == ["字"]
    boxes = {character: entry["box"] for character, entry in made.metrics["glyphs"].items()}
    assert boxes == {character: [0.1, 0.0, 0.45, 0.7] for character in "AVąж"}
    assert [root.name for root in made.texture.roots] == ["A", "V", "ą", "ж", ".notdef"]
    assert made.metrics["kerning"] == {"A": {"V": -0.07}}, "both are of the subset that has most of the characters"


def test_only_the_subsets_that_are_used_are_unpacked(web_fonts):
    def unpacked():
        return {listed.face for listed in of_files(tuple(font_files(web_fonts))) if "_font" in vars(listed.face)}

    before = unpacked()
    choice = TextOptions(web_fonts, weight=400).choice(Notes(), "AV")
    assert [*faces_of_characters(choice, "AV").values()] == [choice.first] * 2
    assert unpacked() == before
    choice.first.outline(1)
    assert unpacked() - before == {choice.first}


def test_a_folder_of_a_family_for_each_weight_gives_that_of_the_weight(web_fonts):
    assert vexture.font_atlas(web_fonts, "Aж", weight=900).metrics["font"]["family"] == "Made Black"


def test_a_text_in_several_subsets_is_in_one_font(web_fonts):
    drawing = text_drawing("AVąж", TextOptions(web_fonts, weight=700))
    assert drawing.notes == ()
    assert len({path.box[1, 1] - path.box[0, 1] for path in drawing.paths}) == 1
