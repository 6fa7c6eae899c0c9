"""Notes about animations, and broken animations; fixtures in `animation` compare what is drawn."""

import pytest

from vexture import Drawing
from vexture.base.notes import check_losses
from vexture.svg.read import svg_drawing

SQUARE = '<path d="M0 0h9v9z"{}>{}</path>'
REVEALED = "parts that only an animation makes visible are drawn as it shows them"


def drawn(body: str) -> Drawing:
    return svg_drawing(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode(), "a.svg")


@pytest.mark.parametrize(
    ("body", "notes"),
    [
        (SQUARE.format("", '<animate attributeName="fill" values="red;blue" dur="1s"/>'), ["animation"]),
        (
            SQUARE.format(' opacity="0"', '<animate attributeName="opacity" to="1" dur="1s"/>'),
            ["animation", REVEALED],
        ),
        (
            "<style>@keyframes k { to { opacity: 1 } } path { opacity: 0; animation: k 1s }</style>"
            + SQUARE.format("", ""),
            ["animation", REVEALED],
        ),
    ],
)
def test_notes_say_that_an_animation_is_left_out_and_what_it_shows(body: str, notes: list[str]) -> None:
    drawing = drawn(body)
    assert [note.message for note in drawing.notes] == notes
    assert len(drawing.paths) == 1


def test_a_drawing_that_no_animation_shows_is_empty_and_no_error() -> None:
    drawing = drawn(SQUARE.format(' opacity="0"', '<animate attributeName="fill" values="red;blue" dur="1s"/>'))
    assert [note.message for note in drawing.notes] == ["its animations show nothing more", "nothing in it is painted"]
    check_losses("a.svg", drawing.notes, is_empty=not drawing.paths)


def test_what_style_sheets_animate_is_named_once_and_keyframes_without_use_are_not() -> None:
    rules = "@keyframes k { from { r: 3px } } @keyframes other { from { r: 1px } }"
    drawing = drawn(f'<style>{rules} .k {{ animation: k 1s 5s }}</style><circle id="sun" class="k" r="2"/>')
    (note,) = drawing.notes
    assert (note.message, note.count, [subject.name for subject in note.elements]) == ("animation", 1, ["sun"])
    assert drawn(f"<style>{rules}</style>{SQUARE.format('', '')}").notes == ()


@pytest.mark.parametrize(
    "broken",
    [
        "<animate/>",
        '<set attributeName="" to="1"/>',
        '<animate attributeName="opacity" values=";;" begin=";;a."/>',
        '<animate attributeName="opacity" values="0;x;nan;1e999;-1"/>',
        '<animate attributeName="transform" values="scale("/>',
        '<animate href="#none" attributeName="opacity" to="1"/>',
        *(f'<set attributeName="{name}" to="1"/>' for name in ("xml:space", "a b", "svg:width", "/", "{", "{x}y")),
        "<style>@keyframes { from } @keyframes k { 300% { opacity: 1 } x { } } path { animation: k 1s, , 0s }</style>",
        "<style>@keyframes k { to { opacity: var(--none) } } path { animation: k }</style>",
        "<style>@keyframes k { to { stroke-dashoffset: calc(} } path { animation: k }</style>",
    ],
)
def test_broken_animations_change_nothing(broken: str) -> None:
    hidden = SQUARE.format(' opacity="0" stroke-dasharray="0"', broken)
    assert len(drawn(hidden + SQUARE.format("", broken)).paths) == 1
