"""What basic shapes of CSS a clip may be, and what is left out and named."""

import pytest

import vexture
from vexture.svg.clip_shapes import clip_element

NOTES = "left out: clip-path '{}'"


def drawn(value: str, style: str = "") -> vexture.Drawing:
    text = f'<style>{style}</style><rect x="10" y="20" width="40" height="30" style="clip-path: {value}"/>'
    return vexture.read(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{text}</svg>'.encode())


@pytest.mark.parametrize(
    "value",
    [
        *("circle(-1px)", "circle(1px 2px)", "circle(at)", "circle(at 1px 2px 3px)", "circle(at right 1px left 1px)"),
        *("ellipse(1px)", "ellipse(1px -1px)", "ellipse(at one two)", "circle () fill-box", "calc(1px)"),
        *("inset()", "inset(1px 1px 1px 1px 1px)", "inset(1px round)", "inset(1px round -1px)", "inset(a)"),
        *("rect(1px)", "rect(1px 2px 3px b)", "xywh(1px 1px -1px 1px)", "xywh(1px)"),
        *("polygon(1px)", "polygon(1px a)", "path(M0 0)", "circle() margin", "circle() fill-box view-box"),
        *(
            "circle(calc(1px + 2))",
            "polygon()",
            "inset(1px round 1px / 2px / 3px)",
            "shape(from 0 0, line to 1px 1px)",
            "fill-box view-box",
            "box",
        ),
    ],
)
def test_what_is_no_known_shape_is_named(value: str) -> None:
    with pytest.warns(vexture.SourceWarning) as caught:
        drawing = drawn(value)
    assert NOTES.format(value) in str(caught[0].message)
    assert drawing.groups == ()
    assert [path.contours[0].shape for path in drawing.paths] == [(4, 4, 2)]


@pytest.mark.parametrize(
    "value", ["CIRCLE(20%) Fill-Box", "Inset(2px Round 3px)", "View-Box", "POLYGON(0 0, 9PX 0, 0 9px)"]
)
def test_names_and_units_in_any_case(value: str) -> None:
    assert drawn(value).notes == ()


def test_an_escaped_character_in_a_path_is_no_path() -> None:
    with pytest.warns(vexture.SourceWarning, match="left out: clip-path"):
        vexture.read(
            b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
            b'<style>rect { clip-path: path("\\1 M0 0h3v3z") }</style><rect width="9" height="9"/></svg>'
        )


@pytest.mark.parametrize(
    ("value", "x", "y", "r"),
    [
        ("circle(at top)", 20.0, 0.0, 0.0),
        ("circle(closest-side at 25% 50%)", 10.0, 15.0, 10.0),
        ("circle(farthest-side at right 5px bottom 10px)", 35.0, 20.0, 35.0),
        ("circle(1em at top 6px left 10%)", 4.0, 6.0, 16.0),
        ("circle(9px at bottom right)", 40.0, 30.0, 9.0),
    ],
)
def test_positions_and_radii(value: str, x: float, y: float, r: float) -> None:
    clip = clip_element(value, lambda name: (5.0, 7.0, 40.0, 30.0), 16.0, 16.0)
    assert clip is not None
    assert [float(clip[0].get(name)) for name in ("cx", "cy", "r")] == [5.0 + x, 7.0 + y, r]


def test_a_shape_around_nothing_is_no_loss() -> None:
    with pytest.warns(vexture.SourceWarning):
        drawing = vexture.read(
            b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g clip-path="circle()"></g></svg>'
        )
    assert [str(note) for note in drawing.notes] == ["nothing in it is painted"]


@pytest.mark.parametrize("value", ["url(#a)", "url('#a')", "URL(#a)", "shape(from 0 0)", "circle (1px)"])
def test_what_is_no_shape_measures_nothing(value: str) -> None:
    """The box of a group costs as much as all that it shows, at each level of nested clips again."""
    asked = list[str]()
    assert clip_element(value, asked.append, 16.0, 16.0) is None
    assert asked == []
