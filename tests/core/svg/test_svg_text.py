"""Texts look like what resvg draws with the same fonts, or like a plainer file that says the same."""

from pathlib import Path

import pytest
from plainer_texts import PLAINER, ROOT, plainer_text
from svg_reference import different_part
from svg_texts import drawn, read

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture.drawing.drawing import Drawing

FOLDER = Path(__file__).parent / "fixtures" / "text"


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.svg")))
def test_looks_like_the_reference(name: str) -> None:
    path = FOLDER / f"{name}.svg"
    assert different_part(path, read(path), plainer_text(name)) < 0.001


def test_fixtures_are_all_there() -> None:
    names = {path.stem for path in FOLDER.glob("*.svg")}
    assert len(names) > 200
    assert set(PLAINER) <= names


def notes(drawing: Drawing) -> list[str]:
    return [f"{note.kind}: {note}" for note in drawing.notes]


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


def test_fonts_are_for_svg_and_must_be_there(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"`fonts` 'a\.ttf' is for the texts of an SVG; leave it out"):
        vexture.read(b'{"type": "Polygon", "coordinates": []}', fonts=["a.ttf"])
    file = tmp_path / "text.svg"
    file.write_text(f"<svg {ROOT}><text y='50'>a</text></svg>")
    with pytest.raises(SourceError, match=r"no-such\.ttf"):
        vexture.read(file, fonts=["no-such.ttf"])
