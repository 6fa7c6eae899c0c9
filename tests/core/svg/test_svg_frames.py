"""What a drawing without a size and a `viewBox` is told: the `viewBox` that frames what it paints."""

import pytest

from vexture.bezier.bounds import bounds
from vexture.drawing.drawing import Drawing
from vexture.svg.read import svg_drawing

ICON = '<path d="M2 2h20v20h-20z"/>'
HUGE = '<path d="M0 0h999v999z" {}="url(#m)"/>'
DISC = '<circle cx="9" cy="9" r="8" fill="#fff"/>'
SMALL, CUT = "of which it fills a small part", "which cuts it"


def drawing_of(body: str, root: str) -> Drawing:
    """A drawing with attributes of its outermost element."""
    return svg_drawing(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>'.encode(), "icon.svg")


@pytest.mark.parametrize(
    ("body", "root", "box"),
    [
        pytest.param(ICON, "", "2 2 20 20", id="icon"),
        pytest.param(f'<g fill="none" stroke="#000" stroke-width="3">{ICON}</g>', "", "0 0 24 24", id="stroke"),
        pytest.param('<path d="M.25 .5h.5v.25h-.5z"/>', 'width="60"', "0.25 0.5 0.5 0.25", id="less-than-a-unit"),
        pytest.param(f'<clipPath id="m">{DISC}</clipPath>{HUGE.format("clip-path")}', "", "1 1 16 16", id="clip"),
        pytest.param(f'<mask id="m">{DISC}</mask>{HUGE.format("mask")}', "", "1 1 16 16", id="mask"),
    ],
)
def test_view_box_that_frames_a_speck_is_named(body: str, root: str, box: str) -> None:
    (note,) = drawing_of(body, root).notes
    assert note.message.endswith(f', {SMALL} (with viewBox="{box}" it fills all of it)')
    assert drawing_of(body, f'viewBox="{box}" {root}').notes == ()


@pytest.mark.parametrize(
    ("body", "root", "wrong"),
    [
        pytest.param('<rect width="10%" height="10%"/>', "", SMALL, id="percentages"),
        pytest.param('<rect width="5vw" height="5vh"/>', "", SMALL, id="units-of-the-view"),
        pytest.param('<rect width="100%" height="9"/><circle r="500"/>', "", CUT, id="wider-with-it"),
        pytest.param(ICON, 'transform="rotate(90) scale(2)"', CUT, id="turned-about-its-middle"),
        pytest.param(ICON, 'transform="translate(30 9)"', SMALL, id="moved"),
        pytest.param(
            f"<style>@media (max-width: 99px) {{ path {{ transform: scale(9) }} }}</style>{ICON}", "", SMALL, id="media"
        ),
    ],
)
def test_no_view_box_is_named_that_would_not_frame_a_drawing(body: str, root: str, wrong: str) -> None:
    (note,) = (note for note in drawing_of(body, root).notes if "no viewBox" in note.message)
    assert note.message.endswith(wrong)


def test_view_box_that_is_named_shows_all_of_what_is_cut() -> None:
    drawing = drawing_of('<path d="M280.5 -7.25h60v60z"/>', "")
    said = 'which cuts it (with viewBox="280 -8 61 61" it shows all)'
    assert [note.message.endswith(said) for note in drawing.notes] == [True]
    (path,) = drawing_of('<path d="M280.5 -7.25h60v60z"/>', 'viewBox="280 -8 61 61"').paths
    left, low, right, high = bounds(path.contours[0])
    assert 0.0 < left < right < 1.0
    assert 0.0 < low < high < 1.0


def test_drawing_that_is_clipped_to_its_page_is_not_said_to_be_cut() -> None:
    clip = '<clipPath id="m"><circle cx="150" cy="75" r="70"/></clipPath>'
    (note,) = drawing_of(clip + HUGE.format("clip-path"), "").notes
    assert note.message.endswith("as in browsers")
