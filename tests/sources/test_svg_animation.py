"""What is drawn of animated drawings whose first frame shows nothing, and what is said of animations."""

import pytest

from vexture import Drawing
from vexture.notes import check_losses
from vexture.svg.read import svg_drawing

REST = "its first frame shows nothing; it is drawn as it is without its animation"
END = "its first frame shows nothing; it is drawn as its animation ends"
NEVER = "its animation shows nothing at its start and at its end"
NOTHING = "nothing in it is painted"
UNCLEAR = "animation whose first frame is not known, drawn without it"

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
        '<animateTransform attributeName="transform" type="rotate" from="0" dur="1s"/>',
        '<animateTransform attributeName="transform" type="rotate" from="0" dur="2s" begin="-1s"/>',
        '<animateTransform attributeName="/" values="1;2" dur="2s" begin="-1s"/>',
        *(f'<set attributeName="{name}" to="1"/>' for name in ("xml:space", "a b", "1", "svg:width", "/", "{", "{x}y")),
        '<animateMotion values="1;x" keyPoints="2;;" dur="1s"/>',
        '<animate href="#none" attributeName="x" to="1"/>',
        "<style>@keyframes { from } @keyframes k { 300% { x: 1 } x { } } path { animation: k 1s, , 0s none }</style>",
        "<style>@keyframes k { to { x: 1px } } path { animation: k 1e-9s -9e11s infinite steps(0) }</style>",
        "<style>@keyframes k { to { x: 1px } } path { animation: k 1s -0.5s steps(3, none) 1e300 }</style>",
        "<style>@keyframes k { from { --b: 0 } to { --b: 1 } } path { animation: k 2s -1s }</style>",
        "<style>@keyframes k { from { font: inherit } to { font: inherit } } path { animation: k 2s -1s }</style>",
        "<style>@keyframes k { to { transform: rotate3d(1deg) } } path { animation: k 2s -1s }</style>",
        "<style>@keyframes k { to { transform-origin: center } } path { transform-origin: /**/; animation: k 2s -1s }"
        "</style>",
    ],
)
def test_broken_animations_are_survived(broken: str) -> None:
    assert len(drawn(SQUARE.format("", broken) + "<path d='M0 0h9v9z'/>").paths) == 2


@pytest.mark.parametrize(
    "declared",
    [
        "from { transform: rotate(10deg) } to { transform: rotateX(40deg) }",
        "from { transform: translate(1em) } to { transform: rotate(9deg) }",
        "from { transform: perspective(9px) } to { transform: perspective(90px) }",
        "from { transform: rotate(9deg); animation-composition: accumulate }",
        "from { scale: 2; animation-composition: accumulate }",
        "from { fill: currentColor; animation-composition: add }",
        "from { rotate: x 10deg } to { rotate: 40deg }",
        "from { font-weight: bolder } to { font-weight: 100 }",
        "from { filter: none } to { filter: blur(2px) }",
    ],
)
def test_what_is_between_two_frames_is_named_where_it_is_not_known(declared: str) -> None:
    rules = (
        f"@keyframes k {{ {declared} }} path {{ transform: translate(1px); scale: 1; animation: k 2s -0.5s linear }}"
    )
    drawing = drawn(f"<style>{rules}</style>{SQUARE.format('', '')}")
    assert [(note.message, note.count) for note in drawing.notes] == [
        ("animation", 1),
        (UNCLEAR, 1),
    ]
    still = drawn(f"<style>path {{ transform: translate(1px); scale: 1 }}</style>{SQUARE.format('', '')}")
    assert [path.contours[0].tolist() for path in drawing.paths] == [path.contours[0].tolist() for path in still.paths]


@pytest.mark.parametrize(
    ("attributes", "is_known"),
    [
        ('attributeName="width" values="1;2%"', True),
        ('attributeName="width" values="1;2s"', False),
        ('attributeName="transform" values="rotate(0);rotate(90)"', True),  # which no browser follows
        ('attributeName="fill" from="red" by="currentColor"', False),
        ('attributeName="stroke-dasharray" values="1;2 3"', True),  # which jumps
        ('attributeName="viewBox" values="0 0 1 1;0 0 1"', False),
    ],
)
def test_attributes_between_two_values(attributes: str, is_known: bool) -> None:
    drawing = drawn(f'<rect width="9" height="9"><animate {attributes} dur="2s" begin="-0.5s"/></rect>')
    assert (UNCLEAR not in [note.message for note in drawing.notes]) == is_known


def test_moves_are_added_as_they_are_done() -> None:
    rules = "@keyframes k { from { scale: 2; translate: 1px; rotate: 20deg; opacity: 50%; x: 10% } }"
    own = "scale: 1.5 2; translate: 10% 2px; rotate: 25deg; opacity: 0.25; x: 1px"
    summed = "scale: 3 4; translate: calc(10% + 1px) 2px; rotate: 45deg; opacity: 0.75; x: calc(1px + 10%)"
    square = '<rect width="1" height="1"/>'
    moving = drawn(f"<style>{rules} rect {{ {own}; animation: k 2s; animation-composition: add }}</style>{square}")
    still = drawn(f"<style>rect {{ {summed} }}</style>{square}")
    for shown, expected in zip(moving.paths, still.paths, strict=True):
        assert shown.paint == expected.paint
        assert shown.contours[0] == pytest.approx(expected.contours[0])


def test_an_element_with_very_many_animations_is_named() -> None:
    """A list of them is read in one sweep: 20,000 took minutes."""
    rules = "@keyframes k { from { opacity: 0.5 } }"
    shown = []
    for count in (1_000, 20_000):
        drawing = drawn(
            f"<style>{rules} path {{ animation: {','.join(['k 1s steps(1, end)'] * count)} }}</style>"
            + SQUARE.format("", "")
        )
        shown.append((drawing.paths[0].paint.opacity, UNCLEAR in [note.message for note in drawing.notes]))
    assert shown == [(0.5, False), (1.0, True)]


def test_half_of_a_straight_way_is_half() -> None:
    rules = "@keyframes k { from { fill: none } to { fill: #f00 } } .k { animation: k 2s -1s linear }"
    squares = SQUARE.format("", "") + SQUARE.format(' class="k"', "")
    assert len(drawn(f"<style>{rules}</style>{squares}").paths) == 2


def test_animated_custom_properties_have_no_effect_on_important_ones() -> None:
    rules = "@keyframes k { from { --c: #f00; fill: var(--c) } } path { --c: #0f0 !important; animation: k 1s }"
    (path,) = drawn(f"<style>{rules}</style>{SQUARE.format('', '')}").paths
    assert path.paint.color == (0, 1, 0)
