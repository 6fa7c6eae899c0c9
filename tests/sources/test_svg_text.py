"""Texts look like what resvg draws with the same fonts, or like a plainer file that says the same."""

import base64
import subprocess
import sys
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from fontTools.ttLib import TTFont
from svg_reference import FONTS, different_part

import vexture
from vexture.deadline import within
from vexture.drawing import Drawing
from vexture.errors import LimitError, ParameterError, SourceError, SourceWarning
from vexture.svg.read import read_svg

FOLDER = Path(__file__).parent / "fixtures" / "text"
ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" font-family="DejaVu Sans" font-size="16"'
SIZE = 16.0
HEBREW = "\u05e1\u05e4\u05d9\u05e0\u05d4"
SHIPS = '<text x="5" y="60" font-size="30">Ships</text>'


@cache
def font() -> TTFont:
    return TTFont(FONTS / "DejaVuSans.ttf")


def advance(text: str, size: float = SIZE) -> float:
    glyphs = [font().getBestCmap()[ord(character)] for character in text]
    return sum(font()["hmtx"][glyph][0] for glyph in glyphs) * size / font()["head"].unitsPerEm


def top_and_bottom(character: str) -> tuple[float, float]:
    glyph = font()["glyf"][font().getBestCmap()[ord(character)]]
    return glyph.yMax / font()["head"].unitsPerEm, glyph.yMin / font()["head"].unitsPerEm


def letters(text: str, x: float, y: float, size: float = SIZE, gap: float = 0.0) -> str:
    """Letters in places of their own, so that nothing but their advances matters."""
    places = []
    for character in text:
        places.append(f"{x:.6f}")
        x += advance(character, size) + gap
    return f'<text x="{" ".join(places)}" y="{y}" font-size="{size}">{text}</text>'


def bolder(size: float) -> float:
    """Width of the stroke by which Skia makes letters bolder."""
    return size * (1 / 24 + (1 / 32 - 1 / 24) * (size - 9) / (36 - 9))


def upright() -> str:
    """Letters that lie on their side, and symbols upright in the middle of lines as high as the font's."""
    over, under = (getattr(font()["hhea"], name) * SIZE / 2048 for name in ("ascent", "descent"))
    down, drawn = 10.0, ""
    for character in "a\u2605b\u2660":
        if character.isalpha():
            turned = f"translate({50 - (over + under) / 2} {down}) rotate(90)"
            drawn += f'<text transform="{turned}">{character}</text>'
            down += advance(character)
            continue
        baseline = down + (over - under) / 2 + sum(top_and_bottom(character)) * SIZE / 2
        drawn += f'<text x="{50 - advance(character) / 2}" y="{baseline}">{character}</text>'
        down += over - under
    return drawn


# what PyPI's resvg does not know, or draws otherwise than the specification says, in words that it and we know alike
PLAINER = {
    # "a collapsible space following another collapsible space is collapsed", also of another element, and no other
    "between-spaces": '<text x="5" y="50">a b c</text>',
    "spaces-default-in-preserved": '<text x="5" y="50" xml:space="preserve">a  b c d  e</text>',
    "tspan-not-displayed": '<text x="10" y="50">one six</text>',
    "white-space-pre": '<text x="10" y="50" xml:space="preserve">  a  b </text>',
    "bidi-override": '<text x="10" y="50">a pihs one</text>',
    "direction-rtl-latin": '<text x="90" y="50" text-anchor="end">!ship</text>',
    "direction-rtl": f'<text x="90" y="50" text-anchor="end">ship {HEBREW}</text>',
    "dominant-middle": f'<text x="10" y="{50 + top_and_bottom("x")[0] * SIZE / 2}">Harbour</text>',
    "alignment-middle": '<text x="10" y="50">one</text>'
    f'<text x="{10 + advance("one")}" y="{50 + top_and_bottom("x")[0] * SIZE / 2}">two</text>',
    "feature-settings": letters("office", 10, 50, 24),
    "font-shorthand": '<text x="5" y="50" font-style="italic" font-weight="bold" font-size="20">Harbour</text>',
    "font-size-adjust": f'<text x="5" y="50" font-size="{SIZE * 0.4 / top_and_bottom("x")[0]}">Ship</text>',
    "font-size-words": '<text x="5" y="30" font-size="13">small</text>'
    '<text x="5" y="60" font-size="19.2">larger</text>',
    "font-weight-bolder": '<text x="5" y="50"><tspan font-weight="bold">a</tspan>b<tspan font-weight="bold">c</tspan>'
    "</text>",
    # "user agents should not apply optional ligatures when letter-spacing is not zero" (CSS Text 3, 8.2)
    "letter-spacing-no-ligature": letters("office", 5, 50, 20, 1.0),
    "path-data": '<path id="p" d="M10 50H90" fill="none"/><text><textPath href="#p">ship</textPath></text>',
    # "effectively reverses the path direction" (SVG 2, 11.8.2)
    "path-side": '<path id="p" d="M90 50H10" fill="none"/><text><textPath href="#p">ship</textPath></text>',
    # what follows goes on from the end of the path (SVG 2, 11.5, "Position on path")
    "path-text-after": '<path id="p" d="M10 70C10 10 90 10 90 70" fill="none"/>'
    '<text><textPath href="#p">path</textPath></text>'
    f'<text x="{90 + advance(" ")}" y="70">b</text>',
    "pattern-fill": f'<clipPath id="c">{SHIPS}</clipPath><g clip-path="url(#c)" fill="red">'
    + "".join(f'<rect x="{x}" width="3" height="100"/>' for x in range(0, 100, 6))
    + "</g>",
    "small-caps": f'<text x="5" y="50">H<tspan font-size="{0.7 * SIZE}">ARBOUR</tspan></text>',
    "synthetic-bold": '<text x="5" y="50" font-family="cmr10" font-size="24" stroke="black" '
    f'stroke-width="{bolder(24)}">Ship</text>',
    "synthetic-oblique": '<text transform="translate(5 50) skewX(-14)" font-family="cmr10" font-size="24">Ship</text>',
    # the last gap does not count for the anchor, as in browsers
    "text-length-middle": letters("ship", 10, 50, SIZE, (80 - advance("ship")) / 3),
    "text-length-with-tspans": f'<text x="10" y="50" letter-spacing="{(80 - advance("abcdef")) / 5}">'
    'ab<tspan fill="red">cd</tspan>ef</text>',
    "text-transform": '<text x="5" y="50">SHIPS</text>',
    "vertical-upright-symbols": upright(),
}


def read(path: Path, **options: Any) -> Drawing:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path, **{"fonts": [FONTS], **options})


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.svg")))
def test_looks_like_the_reference(name: str) -> None:
    path = FOLDER / f"{name}.svg"
    plainer = PLAINER.get(name)
    assert different_part(path, read(path), plainer and f"<svg {ROOT}>{plainer}</svg>") < 0.001


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
        ("<text>a<tref href='#x'/></text>", "left out: <tref> in a text"),
        ("<text x='1 b'>abc</text>", "invalid: x='1 b' of <text> in line 1"),
        ("<text rotate='1turn'>abc</text>", "invalid: rotate='1turn' of <text> in line 1"),
        ("<text textLength='-1'>abc</text>", "invalid: textLength='-1' of <text> in line 1"),
        ("<text y='1e13'>abc</text>", "left out: <text> in line 1: the number 1e13 is too large; the limit is 1e+12"),
        (
            "<text y='9' text-decoration='wavy underline'>a</text>",
            "simplified: text-decoration wavy drawn as a solid line",
        ),
        (
            "<text><textPath path='M0 9H99' method='stretch'>b</textPath></text>",
            "simplified: textPath with method stretch drawn with align",
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
