"""Texts as drawings: where their glyphs are, in which order, and what is said about fonts and characters."""

import numpy as np
import pytest
from made import BLUE, RED, composite, fill_shape, made_font, solid, stack_paints

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.fonts.text import TextOptions, text_drawing

ADVANCE = 0.9
"""Of all letters of the made fonts, in ems; their squares begin at 0.1 and end at 0.8."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fonts")
    letters = dict.fromkeys("AVאב(", "square")
    (folder / "plain.ttf").write_bytes(made_font(letters, kerning=[("u0041", "u0056", -80)]))
    paint = composite("XOR", fill_shape("square", solid(RED)), fill_shape("disc", solid(BLUE)))
    paints = {"B": stack_paints(fill_shape("square", solid(RED)), fill_shape("tall", solid(BLUE))), "C": paint}
    (folder / "colours.ttf").write_bytes(made_font(dict.fromkeys("BC", "square"), paints, family="Colours"))
    return folder


def drawn(folder, text, font="plain.ttf", **options):
    return text_drawing(text, TextOptions(folder / font, **options))


def places(drawing):
    """Letters of a drawing with their lower left corners in units of the source, y down."""
    found = []
    for path in drawing.paths:
        x, y = path.box[0]
        found.append((path.element, *np.round(drawing.to_source @ (x, y, 1.0), 9).tolist()))
    return found


def test_letters_are_kerned_and_in_ems_from_the_baseline(folder):
    assert places(drawn(folder, "AVA")) == [("A", 0.1, 0.0), ("V", 0.92, 0.0), ("A", 1.82, 0.0)]
    assert places(drawn(folder, "AV", features=["-kern"], size=10.0)) == [("A", 1.0, 0.0), ("V", 10.0, 0.0)]


def test_the_box_is_that_of_the_lines(folder):
    found = drawn(folder, "AA\nA")  # 1.8 wide, from 0.8 above to 1.2 below the first baseline
    np.testing.assert_allclose(found.to_source, [[2.0, 0.0, -0.1], [0.0, -2.0, 1.2]], atol=1e-12)


@pytest.mark.parametrize(
    ("align", "direction", "start"),
    [("start", "ltr", 0.0), ("center", "ltr", 0.45), ("end", "ltr", 0.9), ("start", "rtl", 0.9), ("end", "rtl", 0.0)],
)
def test_lines_are_aligned_in_the_direction_of_the_text(folder, align, direction, start):
    found = places(drawn(folder, "AA\nA", align=align, direction=direction, line_height=1.5))
    assert found[2] == ("A", pytest.approx(start + 0.1), 1.5)


def test_text_of_both_directions_is_in_visual_order(folder):
    assert [letter for letter, *_ in places(drawn(folder, "אבAV"))] == ["A", "V", "ב", "א"]
    assert [letter for letter, *_ in places(drawn(folder, "אבAV", direction="ltr"))] == ["ב", "א", "A", "V"]


def test_a_colour_font_is_a_planar_map_and_takes_the_opacity_as_a_whole(folder):
    found = drawn(folder, "BC", "colours.ttf")
    assert found.is_coloured
    assert {path.element for path in found.paths} == {"B", "C"}
    faded = drawn(folder, "BC", "colours.ttf", paint=Paint(opacity=0.5))
    pictures = [vexture.render(drawing, size=60, renderer="exact") for drawing in (found, faded)]
    np.testing.assert_allclose(pictures[1], pictures[0] * 0.5, atol=2 / 255)


def test_a_gradient_goes_over_the_whole_text(folder):
    gradient = Gradient(((1 / 1.8, 0, 0), (0, 1, 0)), (Stop(0, (1, 0, 0)), Stop(1, (0, 0, 1))))
    image = vexture.render(drawn(folder, "AA", paint=Paint.from_gradient(gradient)), size=180, renderer="exact")
    for column in (20, 70, 110, 160):
        assert image[90, column, 2] == pytest.approx((column + 0.5) / 180, abs=0.01)


def test_what_stands_in_for_a_font_or_character_is_named(folder):
    found = drawn(folder, "AB☃", ".", family="Made")
    told = [str(note) for note in found.notes]
    assert "character 'B' (U+0042), which Made lacks, and such in Colours" in told
    assert places(found)[1][0] == "B"
    other = drawn(folder, "A", family="Nowhere", style="italic")
    assert [str(note) for note in other.notes] == [
        "font 'Nowhere' drawn in Made",
        "italic style, which Made lacks, drawn upright",
    ]


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """Folders of faces by weight: a family in three styles without a regular one, one with it, and a single face."""
    root = tmp_path_factory.mktemp("weights")
    for place, weight, style, info in (
        ("heavy", 700, "Bold", {}),
        ("heavy", 900, "Black", {}),
        ("heavy", 700, "Bold Italic", {"fsSelection": 1}),
        ("sloped", 400, "Italic", {"fsSelection": 1}),
        ("sloped", 700, "Bold Italic", {"fsSelection": 1}),
        ("narrow", 400, "Condensed", {"usWidthClass": 3}),
        ("narrow", 700, "Condensed Bold", {"usWidthClass": 3}),
        ("regular", 400, "Regular", {}),
        ("regular", 700, "Bold", {}),
        ("single", 700, "Bold", {}),
    ):
        (root / place).mkdir(exist_ok=True)
        content = made_font({"A": "left"}, weight=weight, style=style, **info)
        (root / place / f"made-{style.lower().replace(' ', '-')}.ttf").write_bytes(content)
    return root


CHOOSE = "choose another by `weight` and `style`, or give its file"


@pytest.mark.parametrize(
    ("place", "options", "said"),
    [
        ("heavy", {}, "weight 400, normal, so that made-bold.ttf is used (Made, weight 700, normal)"),
        ("heavy", {"weight": 300}, "weight 300, normal, so that made-bold.ttf is used (Made, weight 700, normal)"),
        ("heavy", {"weight": 700, "style": "italic"}, None),
        ("heavy/made-black.ttf", {}, None),
        ("sloped", {}, "weight 400, normal, so that made-italic.ttf is used (Made, weight 400, italic)"),
        ("narrow", {}, "weight 400, normal, so that made-condensed.ttf is used (Made, weight 400, normal, stretch 75)"),
        ("regular", {}, None),
        ("regular", {"weight": 600}, "weight 600, normal, so that made-bold.ttf is used (Made, weight 700, normal)"),
        ("single", {}, None),
        ("single", {"weight": 400.2}, None),
        ("single", {"weight": 200}, "weight 200, normal, so that made-bold.ttf is used (Made, weight 700, normal)"),
    ],
)
def test_the_file_that_stands_in_for_a_weight_is_named_where_there_is_a_choice(weights, place, options, said):
    notes = Notes()
    TextOptions(weights / place, **options).choice(notes, "A")
    found = [str(note) for note in notes.in_order if note.kind == "remark"]
    assert found == ([] if said is None else [f"no face has {said}; {CHOOSE}"])


def test_joiners_and_variation_selectors_stay_with_their_character(folder):
    found = drawn(folder, "A\ufe0fV\u200dA", ".", family="Made")
    assert found.notes == ()


def test_a_character_that_no_font_has_is_left_out_by_name(folder):
    with pytest.warns(vexture.SourceWarning, match=r"simplified: character \(U\+10FFFF\), which no font has"):
        vexture.text("A\U0010ffff", font=folder / "plain.ttf")


def test_the_default_font_is_shaped_in_its_weight(default_faces):
    widths = [vexture.text("Harbour", family="Noto Sans", weight=weight).to_source[0, 0] for weight in (100, 900)]
    assert widths[0] < widths[1]


def test_an_empty_text_is_an_empty_drawing(folder):
    for text in ("", " \n\t", "\x07"):
        found = drawn(folder, text)
        assert found.paths == ()
        assert [str(note) for note in found.notes] == ["nothing in it is painted"]


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"align": "left"}, "`align` is 'left'; it must be start, center, end"),
        ({"direction": "up"}, "`direction` is 'up'; it must be auto, ltr, rtl"),
        ({"weight": 0}, "`weight` is 0; it must be 1 to 1000"),
        ({"weight": "bold"}, "`weight` is 'bold'; it must be 1 to 1000"),
        ({"size": float("inf")}, "`size` is inf; it must be above 0 and below 1e"),
        ({"size": 1e300}, "`size` is 1e"),
        ({"stretch": 0.0}, "`stretch` is 0; it must be above 0"),
        ({"line_height": -1}, "`line_height` is -1; it must be above 0"),
        ({"paint": "red"}, "`paint` is 'red'; it must be a Paint"),
    ],
)
def test_options_out_of_range_are_named(option, message):
    with pytest.raises(vexture.ParameterError, match=message):
        vexture.text("A", **option)
    with pytest.raises(vexture.LimitError, match="`text` has 100,001 characters"):
        vexture.text("A" * 100_001)
    with pytest.raises(vexture.ParameterError, match="`text` is 5; it must be text"):
        vexture.text(5)


def test_characters_that_no_font_has_are_one_note(folder):
    notes = drawn(folder, "A" + "".join(map(chr, range(0x10FFF0, 0x10FFFC))) + "\U0010fff0").notes
    assert [str(note) for note in notes] == [
        "12 characters that no font has, as boxes: "
        + " ".join(f"(U+{code:X})" for code in range(0x10FFF0, 0x10FFF8))
        + " and 4 more"
    ]


def test_a_text_of_which_no_font_has_anything_is_an_error(folder):
    with pytest.raises(SourceError, match=r"no font has any of the characters '.*'; give a `font` that has them"):
        drawn(folder, "\U0010ffff \U0010fff0")


def test_features_are_several(folder):
    with pytest.raises(ParameterError, match=r"`features` is 'liga'; it must be several, as \['smcp', '-liga'\]"):
        drawn(folder, "A", features="liga")
