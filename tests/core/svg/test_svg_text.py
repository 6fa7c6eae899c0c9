"""Texts look like what resvg draws with the same fonts, or like a plainer file that says the same."""

import base64
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import pytest
from plainer_texts import HEBREW, PLAINER, ROOT, advance, plainer_text
from svg_reference import different_part

import vexture
from same_fonts import FONTS
from vexture.base.deadline import within
from vexture.base.errors import LimitError, ParameterError, SourceError, SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FOLDER = Path(__file__).parent / "fixtures" / "text"


def read(path: Path, **options: Any) -> Drawing:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path, **{"fonts": [FONTS], **options})


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.svg")))
def test_looks_like_the_reference(name: str) -> None:
    path = FOLDER / f"{name}.svg"
    assert different_part(path, read(path), plainer_text(name)) < 0.001


def test_fixtures_are_all_there() -> None:
    names = {path.stem for path in FOLDER.glob("*.svg")}
    assert len(names) > 200
    assert set(PLAINER) <= names


def drawn(folder: Path, body: str, head: str = "", **options: Any) -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f"<svg {ROOT}>{head}{body}</svg>", encoding="utf-8")
    return read(file, **options)


def notes(drawing: Drawing) -> list[str]:
    return [f"{note.kind}: {note}" for note in drawing.notes]


def test_a_text_has_one_name_unless_a_part_has_its_own(tmp_path: Path) -> None:
    body = '<text id="t" y="50">a<tspan fill="red">b</tspan><tspan id="s" stroke="blue">c</tspan>d</text>'
    assert [path.element for path in drawn(tmp_path, body).paths] == ["t", "t", "s", "s/stroke", "t"]


def test_a_part_of_a_text_can_be_selected(tmp_path: Path) -> None:
    body = '<text x="10" y="50" fill="red">one <tspan class="s" fill="blue">two</tspan></text>'
    whole, part = drawn(tmp_path, body), drawn(tmp_path, body, select=".s")
    assert [path.paint.hex for path in whole.paths] == ["#ff0000", "#0000ff"]
    assert [path.paint.hex for path in part.paths] == ["#0000ff"]
    assert (part.paths[0].contours[0] == whole.paths[1].contours[0]).all()
    with pytest.raises(LimitError, match="matches 1 element that paints nothing"):
        drawn(tmp_path, '<text><tspan class="s"> </tspan></text><path d="M0 0H9V9"/>', select=".s")


def test_missing_fonts_and_characters_are_named_with_what_is_used(tmp_path: Path) -> None:
    body = '<text y="50" font-family="No Such Font">ab</text><text y="70" font-family="cmr10">a\u0634</text>'
    found = notes(drawn(tmp_path, body))
    assert any(note.startswith("simplified: font 'No Such Font' drawn in ") for note in found)
    assert any(
        note.startswith("simplified: character '\u0634' (U+0634), which 'cmr10' lacks, drawn in ") for note in found
    )
    assert len(found) == 2
    for family in ("No Such Font, DejaVu Sans", "serif", ""):
        assert not notes(drawn(tmp_path, f'<text y="50" font-family="{family}">ab</text>'))


@pytest.mark.parametrize(
    ("body", "note"),
    [
        ("<text>a<textPath href='#x'>b</textPath></text>", "left out: <textPath> in line 1 without a path"),
        ("<text>a<tref href='#x'/></text>", "left out: <tref> of '#x'"),
        ("<text x='1 b'>abc</text>", "invalid: x='1 b' of <text> in line 1"),
        ("<text rotate='1turn'>abc</text>", "invalid: rotate='1turn' of <text> in line 1"),
        ("<text textLength='-1'>abc</text>", "invalid: textLength='-1' of <text> in line 1"),
        ("<text y='1e13'>abc</text>", "left out: <text> in line 1: the number 1e13 is too large; the limit is 1e+12"),
        (
            "<text y='9' style='text-decoration: underline; text-underline-offset: 3px'>a</text>",
            "simplified: text-decoration 3px drawn where and as the font says",
        ),
        (
            "<text><textPath path='M0 9H99' method='stretch'>b</textPath></text>",
            "simplified: textPath with method stretch drawn with align",
        ),
        (
            "<style>@font-face { font-family: F; src: url( '#f') }</style><text y='9'>a</text>",
            "left out: font 'F', an SVG font, which is not supported; give it by `fonts`",
        ),
        (
            "<text y='9' font-weight='1001'>a</text>",
            "invalid: font-weight='1001' of <text> in line 1",
        ),
        (
            "<style>@font-face { font-family: F; src: url(https://example.org/f.woff2) }</style><text y='9'>a</text>",
            "left out: font 'F', which is not in the file; give it by `fonts`",
        ),
        (
            "<style>@font-face { font-family: F; src: url(data:font/ttf,abc) }</style><text y='9'>a</text>",
            "left out: font 'F': holds no font; give a TrueType, OpenType, WOFF or WOFF2 font",
        ),
    ],
)
def test_notes(tmp_path: Path, body: str, note: str) -> None:
    assert note in notes(drawn(tmp_path, body))


@pytest.mark.parametrize(
    ("body", "message", "elements"),
    [
        ("<text id='t' y='9' font-family='Nope'>a<tspan id='s'>b</tspan></text>", "font 'Nope' drawn in ", ["t", "s"]),
        ("<text id='t' y='9' font-family='Nope'>a\uebadb</text>", "font 'Nope' drawn in DejaVu Sans", ["t"]),
        (
            "<text id='t' y='9'>a<tspan id='s'>\uebad</tspan></text>",
            "character (U+EBAD), which 'DejaVu Sans' lacks, ",
            ["s"],
        ),
        ("<text>a<tref id='r'/></text>", "<tref> of ''", ["r"]),
        ("<text><textPath id='p'>b</textPath></text>", '<textPath id="p"> in line 1 without a path', ["p"]),
        ("<text id='t' y='9'>a<animate/></text>", "animation", ["t"]),
        ("<g style='text-shadow: 1px 1px red'><text id='t' y='9'>a<tspan>b</tspan></text></g>", "text-shadow", ["t"]),
        (
            "<text y='9'>a<tspan id='s' style='text-transform: full-width'>b</tspan></text>",
            "text-transform full-width",
            ["s"],
        ),
        ("<text y='9'>a<tspan id='s' clip-path='url(#c)'>b</tspan></text>", "clip-path of a <tspan>", ["s"]),
        ("<text y='9'>a<tspan id='s' mask='url(#m)'>b</tspan></text>", "mask of a <tspan>", ["s"]),
        ("<g kerning='8'><text id='t' y='9'>a<tspan>b</tspan></text></g>", "kerning 8", ["t"]),
        (
            "<text id='t' style='writing-mode: sideways-lr'>a</text>",
            "writing-mode sideways-lr drawn as sideways-rl",
            ["t"],
        ),
        (
            "<text y='9'>a<tspan id='s' text-decoration='underline zigzag'>b</tspan></text>",
            "text-decoration zigzag drawn where and as the font says",
            ["s"],
        ),
    ],
)
def test_notes_name_their_elements_once(tmp_path: Path, body: str, message: str, elements: list[str]) -> None:
    (note,) = (note for note in drawn(tmp_path, body).notes if note.is_loss)
    assert note.message.startswith(message)
    assert [element.name for element in note.elements] == elements
    assert note.count == len(elements)


def test_selectors_stay_with_their_character(tmp_path: Path) -> None:
    plain, chosen = (
        drawn(tmp_path, f'<text y="50" font-family="cmr10">a{selector}</text>') for selector in ("", "\U000e0101")
    )
    assert not chosen.notes
    assert (plain.paths[0].box == chosen.paths[0].box).all()


def test_a_font_in_the_drawing(tmp_path: Path) -> None:
    data = base64.b64encode((FONTS / "cmr10.ttf").read_bytes()).decode()
    style = f"<style>@font-face {{ font-family: 'My Own'; src: url('data:font/ttf;base64,{data}') }}</style>"
    own = drawn(tmp_path, '<text y="50" font-family="My Own">Ship</text>', style)
    known = drawn(tmp_path, '<text y="50" font-family="cmr10">Ship</text>')
    assert not own.notes
    assert all((a == b).all() for a, b in zip(own.paths[0].contours, known.paths[0].contours, strict=True))


def test_fonts_are_for_svg_and_must_be_there(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"`fonts` 'a\.ttf' is for the texts of an SVG; leave it out"):
        vexture.read(b'{"type": "Polygon", "coordinates": []}', fonts=["a.ttf"])
    file = tmp_path / "text.svg"
    file.write_text(f"<svg {ROOT}><text y='50'>a</text></svg>")
    with pytest.raises(SourceError, match=r"no-such\.ttf"):
        vexture.read(file, fonts=["no-such.ttf"])


def test_hostile_texts_end_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="texts have more than 200,000 characters; draw less text, or as outlines"):
        drawn(tmp_path, f"<text>{'a' * 150_000}{'<tspan/>' * 50_001}</text>")
    paths = "<text>" + "<textPath path='M0 0H9'>abcdefgh</textPath>" * 9_000 + "</text>"
    with within(0.2), pytest.raises(LimitError, match="converting takes longer than"):
        drawn(tmp_path, paths)
    far = drawn(tmp_path, '<text y="50" font-size="1e11">a</text><text y="50" letter-spacing="1e12">ab</text>')
    assert far.paths or far.notes


def test_parts_with_an_opacity_are_groups_of_their_own(tmp_path: Path) -> None:
    body = '<text y="50">a<tspan opacity="0.5" stroke="red">b<tspan opacity="0.5" stroke="red">c</tspan></tspan></text>'
    drawing = drawn(tmp_path, body)
    assert not drawing.notes
    assert [(group.outer, group.opacity) for group in drawing.groups] == [(-1, 0.5), (0, 0.5)]
    assert [path.group for path in drawing.paths] == [-1, 0, 0, 1, 1]


@pytest.mark.parametrize(
    "words",
    ["dashed 1e-9px", "wavy 1e-9px", "dotted -3px", "double 0", "red blue", "wavy 1e9px", "x(" * 200_000],
)
def test_any_decoration_leaves_the_letters(tmp_path: Path, words: str) -> None:
    drawing = drawn(tmp_path, f'<text y="50" text-decoration="underline {words}">ship</text>')
    assert len(drawing.paths) == 2
    assert sum(len(contour) for path in drawing.paths for contour in path.contours) < 1_000


def test_a_length_of_zero_does_not_squeeze(tmp_path: Path) -> None:
    bodies = [f'<text y="50" {length} lengthAdjust="spacingAndGlyphs">ab</text>' for length in ("", 'textLength="0"')]
    natural, zero = (drawn(tmp_path, body).paths[0] for body in bodies)
    assert (natural.box == zero.box).all()


def test_the_box_of_a_text_is_that_of_its_cells(tmp_path: Path) -> None:
    clip = '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width="0.5" height="1"/></clipPath>'
    drawing = drawn(tmp_path, f'<text x="10" y="50" clip-path="url(#c)">{"h" * 4}</text>', clip)
    right = max(contour[..., 0].max() for path in drawing.paths for contour in path.contours)
    assert 100 * right <= 10 + 2 * advance("h") + 1e-9
    assert 100 * right > 10 + 2 * advance("h") - advance("h") / 2


@pytest.mark.parametrize(
    ("package", "text", "needs"),
    [
        ("uharfbuzz", "Ship", "fonts need the package uharfbuzz"),
        ("bidi.algorithm", HEBREW, "text from right to left needs the package python-bidi"),
        ("bidi.algorithm", "Ship", ""),
    ],
)
def test_without_a_package_a_text_is_left_out(package: str, text: str, needs: str) -> None:
    program = f"""
import sys
sys.modules[{package!r}] = None
from vexture.svg.read import svg_drawing
drawing = svg_drawing('<svg viewBox="0 0 9 9"><text y="9">{text}</text></svg>'.encode(), "text.svg")
print(*drawing.notes, sep="; ")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    noted = f"<text>: {needs}; install it: pip install 'vexture[text]'; nothing in it is painted" if needs else ""
    assert done.stdout.strip() == noted
