"""What is drawn of animated drawings whose first frame shows nothing, and what is said of animations."""

import pytest

from vexture import Drawing
from vexture.notes import check_losses
from vexture.svg.read import svg_drawing

REST = "its first frame shows nothing; it is drawn as it is without its animation"
END = "its first frame shows nothing; it is drawn as its animation ends"
NEVER = "its animation shows nothing at its start and at its end"
NOTHING = "nothing in it is painted"

FADES = "@keyframes k { from { opacity: 0 } to { opacity: 1 } }"
SQUARE = '<path d="M0 0h9v9z"{}>{}</path>'


def drawn(body: str) -> Drawing:
    return svg_drawing(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{body}</svg>'.encode(), "a.svg")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (f"<style>{FADES} path {{ animation: k 1s }}</style>{SQUARE.format('', '')}", ["animation", REST]),
        (
            f"<style>{FADES} path {{ opacity: 0; animation: k 1s 2s forwards }}</style>{SQUARE.format('', '')}",
            ["animation", END],
        ),
        (
            SQUARE.format(' opacity="0"', '<animate attributeName="opacity" to="1" dur="1s" begin="2s"/>'),
            ["animation", END],
        ),
        (SQUARE.format("", '<set attributeName="display" to="none"/>'), ["animation", REST]),
        (SQUARE.format("", '<animate attributeName="fill" values="red;blue" dur="1s"/>'), ["animation"]),
    ],
)
def test_a_drawing_that_begins_with_nothing_is_drawn_as_it_is_later(body: str, said: list[str]) -> None:
    drawing = drawn(body)
    assert [note.message for note in drawing.notes] == said
    assert len(drawing.paths) == 1


def test_a_drawing_that_shows_nothing_at_any_time_is_empty_and_no_error() -> None:
    hidden = SQUARE.format(' opacity="0"', '<animate attributeName="opacity" values="0;1;0" dur="1s"/>')
    drawing = drawn(hidden)
    assert [note.message for note in drawing.notes] == [NOTHING, NEVER]
    check_losses("a.svg", drawing.notes, is_empty=not drawing.paths)


def test_what_is_animated_by_style_sheets_is_named_once_and_keyframes_without_use_are_not() -> None:
    rules = "@keyframes k { from { r: 3px } } @keyframes other { from { r: 1px } }"
    drawing = drawn(f'<style>{rules} .k {{ animation: k 1s 5s }}</style><circle id="sun" class="k" r="2"/>')
    (note,) = drawing.notes
    assert (note.message, note.count, [subject.name for subject in note.elements]) == ("animation", 1, ["sun"])
    assert drawn(f"<style>{rules}</style>{SQUARE.format('', '')}").notes == ()


@pytest.mark.parametrize(
    "animation",
    [
        '<animate attributeName="x" values="0;5;1" calcMode="paced" begin="-1s" dur="3s"/>',
        '<animate attributeName="fill" from="1" to="2" additive="sum" dur="3s"/>',
        '<animate attributeName="x" from="1e99" to="0" begin="-1s" dur="3s" repeatCount="1e99"/>',
        '<animateMotion path="" dur="1s"/>',
    ],
)
def test_animations_that_are_not_computed_change_nothing(animation: str) -> None:
    drawing = drawn(f'<rect width="9" height="9" fill="#f00">{animation}</rect>')
    assert drawing.paths == drawn('<rect width="9" height="9" fill="#f00"/>').paths or len(drawing.paths) == 1
    assert "animation" in [note.message for note in drawing.notes]


@pytest.mark.parametrize(
    "broken",
    [
        "<animate/>",
        '<set attributeName="" to="1"/>',
        '<animate attributeName="x" values=";;" keyTimes="0;nan;2" dur="0s" begin="-9999999999999999s"/>',
        '<animate attributeName="x" values="1;2" keyTimes="0;0" dur="1s" begin="-0.5s"/>',
        '<animate attributeName="x" values="1;2" calcMode="spline" keySplines="9 9 9 9" dur="1s" begin="-0.5s"/>',
        '<animateTransform attributeName="transform" type="bend" values="1"/>',
        '<animateMotion values="1;x" keyPoints="2;;" dur="1s"/>',
        '<animate href="#none" attributeName="x" to="1"/>',
        "<style>@keyframes { from } @keyframes k { 300% { x: 1 } x { } } path { animation: k 1s, , 0s none }</style>",
        "<style>@keyframes k { to { x: 1px } } path { animation: k 1e-9s -9e11s infinite steps(0) }</style>",
        "<style>@keyframes k { to { x: 1px } } path { animation: k 1s -0.5s steps(3, none) 1e300 }</style>",
    ],
)
def test_broken_animations_are_survived(broken: str) -> None:
    assert len(drawn(SQUARE.format("", broken) + "<path d='M0 0h9v9z'/>").paths) == 2
