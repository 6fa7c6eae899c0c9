"""Filters without blurs: their pictures are those of equal drawings without a filter."""

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact_colours
from vexture.svg.read import svg_drawing

SHAPES = '<rect x="20" y="20" width="40" height="40" fill="#f00"/><circle cx="60" cy="60" r="20" fill="#00f"/>'
GREYS = SHAPES.replace("#f00", "rgb(21.3%,21.3%,21.3%)").replace("#00f", "rgb(7.2%,7.2%,7.2%)")
WHOLE = 'filterUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"'
SRGB = 'color-interpolation-filters="sRGB"'
BLACK = SHAPES.replace("#f00", "#000").replace("#00f", "#000")
WHITE = SHAPES.replace("#f00", "#fff").replace("#00f", "#fff")
MASK = '<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100">'
RECTANGLE = '<rect width="100" height="100" fill="{}"/>'
GREEN = RECTANGLE.format("#0a0")


def drawing_of(body: str) -> Drawing:
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    return svg_drawing(f"{head}{body}</svg>".encode(), "a.svg")


def filtered(steps: str, shapes: str = SHAPES, attributes: str = f"{WHOLE} {SRGB}") -> Drawing:
    return drawing_of(f'<filter id="f" {attributes}>{steps}</filter><g filter="url(#f)">{shapes}</g>')


def assert_same(found: Drawing, expected: str) -> None:
    wanted = drawing_of(expected)
    ours, plain = (render_exact_colours(each, 50) for each in (found, wanted))
    assert np.abs(ours.astype(float) - plain).max() < 1.0 / 255.0
    assert [note.message for note in found.notes if note.kind != "remark"] == []


FLOOD = '<feFlood flood-color="#0a0" result="flood"/>'
STEPS = {
    "offset": ('<feOffset dx="10" dy="-5"/>', f'<g transform="translate(10 -5)">{SHAPES}</g>'),
    "flood": ('<feFlood flood-color="#0a0" flood-opacity="50%"/>', '<rect width="100" height="100" fill="#00aa0080"/>'),
    "flood in a subregion": (
        '<feFlood x="10" y="20" width="30" height="10" flood-color="#0a0"/>',
        '<rect x="10" y="20" width="30" height="10" fill="#0a0"/>',
    ),
    "subregion beyond the region": ('<feFlood x="120" width="30" flood-color="#0a0"/>', ""),
    "subregion cuts": (
        '<feOffset x="30" y="0" width="30" height="50"/>',
        f'<clipPath id="c"><rect x="30" width="30" height="50"/></clipPath><g clip-path="url(#c)">{SHAPES}</g>',
    ),
    "merge": (
        f'{FLOOD}<feMerge><feMergeNode in="flood"/><feMergeNode in="SourceGraphic"/></feMerge>',
        GREEN + SHAPES,
    ),
    "merge with the step before": (
        '<feOffset dx="20"/><feMerge><feMergeNode in="SourceGraphic"/><feMergeNode/></feMerge>',
        f'{SHAPES}<g transform="translate(20)">{SHAPES}</g>',
    ),
    "unused steps": ('<feImage href="none.png"/><feOffset in="SourceGraphic"/>', SHAPES),
    "saturate": ('<feColorMatrix type="saturate" values="0"/>', GREYS),
    "invert": (
        '<feComponentTransfer><feFuncR type="table" tableValues="1 0"/><feFuncG type="table" tableValues="1 0"/>'
        '<feFuncB type="linear" slope="-1" intercept="1"/></feComponentTransfer>',
        SHAPES.replace("#f00", "#0ff").replace("#00f", "#ff0"),
    ),
    "gamma of opaque colours": (
        '<feFlood flood-color="#800"/><feComponentTransfer><feFuncR type="gamma" amplitude="0.5" exponent="2"/>'
        "</feComponentTransfer>",
        RECTANGLE.format(f"rgb({50 * (136 / 255) ** 2}%,0%,0%)"),
    ),
    "one colour and opacity": (
        '<feColorMatrix values="0 0 0 0 0  0 0 0 0 0.5  0 0 0 0 1  0 0 0 0.5 0"/>',
        f'<g opacity="0.5">{SHAPES.replace("#f00", "rgb(0%,50%,100%)").replace("#00f", "rgb(0%,50%,100%)")}</g>',
    ),
    "source alpha": ('<feOffset in="SourceAlpha"/>', BLACK),
    "inverse of alpha": (
        '<feColorMatrix values="0 0 0 0 0  0 0 0 0 0.667  0 0 0 0 0  0 0 0 -1 1"/>',
        f'{MASK}{RECTANGLE.format("#fff")}{BLACK}</mask><rect width="100" height="100" fill="rgb(0%,66.7%,0%)" '
        'mask="url(#m)"/>',
    ),
    "flood in the source": (
        f'{FLOOD}<feComposite in2="SourceGraphic" operator="in"/>',
        SHAPES.replace("#f00", "#0a0").replace("#00f", "#0a0"),
    ),
    "source in a shape": (
        '<feOffset dx="20" result="a"/><feComposite in="SourceGraphic" in2="a" operator="in"/>',
        f'{MASK}<g transform="translate(20)">{WHITE}</g></mask><g mask="url(#m)">{SHAPES}</g>',
    ),
    "source out of a shape": (
        '<feOffset dx="20" result="a"/><feComposite in="SourceGraphic" in2="a" operator="out"/>',
        f'{MASK}{RECTANGLE.format("#fff")}<g transform="translate(20)">{BLACK}</g></mask>'
        f'<g mask="url(#m)">{SHAPES}</g>',
    ),
    "atop": (
        f'<feOffset dx="20" result="a"/>{FLOOD}<feComposite in="flood" in2="a" operator="atop" x="50"/>',
        f'<clipPath id="c"><rect x="50" width="50" height="100"/></clipPath><g clip-path="url(#c)">'
        f'<g transform="translate(20)">{SHAPES.replace("#f00", "#0a0").replace("#00f", "#0a0")}</g></g>',
    ),
    "xor": (
        '<feFlood width="50" flood-color="#0a0"/><feComposite in2="SourceGraphic" operator="xor"/>',
        f'{MASK}{RECTANGLE.format("#fff")}{BLACK}</mask><rect width="50" height="100" fill="#0a0" mask="url(#m)"/>'
        f'<clipPath id="c"><rect x="50" width="50" height="100"/></clipPath><g clip-path="url(#c)">{SHAPES}</g>',
    ),
    "multiply": (
        f'{FLOOD}<feBlend in="SourceGraphic" in2="flood" mode="multiply"/>',
        f'<g style="isolation: isolate">{GREEN}<g style="mix-blend-mode: multiply">{SHAPES}</g></g>',
    ),
    "sum": (
        f'{FLOOD}<feComposite in="SourceGraphic" in2="flood" operator="arithmetic" k2="1" k3="0.5"/>',
        f'<g style="isolation: isolate"><g opacity="0.5">{GREEN}</g>'
        f'<g style="mix-blend-mode: plus-lighter">{SHAPES}</g></g>',
    ),
    "difference": (
        '<feOffset in="SourceAlpha" dx="20" result="a"/>'
        '<feComposite in="a" in2="SourceAlpha" operator="arithmetic" k2="-1" k3="1"/>',
        f'{MASK}{RECTANGLE.format("#fff")}<g transform="translate(20)">{BLACK}</g></mask><g mask="url(#m)">{BLACK}</g>',
    ),
    "tile": (
        '<feFlood x="10" y="10" width="20" height="10" flood-color="#0a0"/><feOffset x="10" y="10" width="40"'
        ' height="20"/><feTile/>',
        "".join(
            f'<rect x="{x}" y="{y}" width="20" height="10" fill="#0a0"/>'
            for x in (-30, 10, 50, 90)
            for y in (-10, 10, 30, 50, 70, 90)
        ),
    ),
    "luminance to alpha": (
        f'{FLOOD}<feColorMatrix type="luminanceToAlpha"/>',
        RECTANGLE.format(f"rgba(0,0,0,{0.7154 * 170 / 255})"),
    ),
}


@pytest.mark.parametrize("name", STEPS)
def test_steps_act_on_shapes(name: str) -> None:
    steps, expected = STEPS[name]
    assert_same(filtered(steps), expected)


def test_colours_change_in_linear_light_by_default() -> None:
    steps = '<feColorMatrix type="saturate" values="0"/>'
    grey = 100 * (1.055 * 0.213 ** (1 / 2.4) - 0.055)
    found = filtered(steps, '<rect width="50" height="100" fill="#f00"/>', WHOLE)
    assert_same(found, f'<rect width="50" height="100" fill="rgb({grey}%,{grey}%,{grey}%)"/>')


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("invert(1)", SHAPES.replace("#f00", "#0ff").replace("#00f", "#ff0")),
        ("opacity(50%)", f'<g opacity="0.5">{SHAPES}</g>'),
        ("brightness(0.5)", SHAPES.replace("#f00", "#800000").replace("#00f", "#000080")),
        ("drop-shadow(20px 0 0 #0a0)", None),
        ("saturate(0)", GREYS),
        ("hue-rotate(0deg)", SHAPES),
        ("opacity(0.5) opacity(0.5)", f'<g opacity="0.25">{SHAPES}</g>'),
        ("drop-shadow(20px 0) invert(1)", None),
    ],
)
def test_functions_of_css_are_steps(value: str, expected: str | None) -> None:
    if expected is None:
        color = "#fff" if "invert" in value else "#0a0"
        shadow = SHAPES.replace("#f00", color).replace("#00f", color)
        shapes = SHAPES.replace("#f00", "#0ff").replace("#00f", "#ff0") if "invert" in value else SHAPES
        expected = f'<g transform="translate(20)">{shadow}</g>{shapes}'
    assert_same(drawing_of(f'<g style="filter: {value}">{SHAPES}</g>'), expected)


@pytest.mark.parametrize(
    "value", ["blur(-1px)", "blur(2)", "blur(50%)", "drop-shadow(1px)", "sepia(-1)", "hue-rotate(3)"]
)
def test_an_invalid_function_is_noted_and_has_no_effect(value: str) -> None:
    found = drawing_of(f'<g style="filter: {value}">{SHAPES}</g>')
    assert [note.kind for note in found.notes] == ["invalid"]
    assert len(found.paths) == 2


WIDE = 'filterUnits="userSpaceOnUse" x="-100" y="-100" width="300" height="300"'
OFFSET = f'<filter id="f" {WIDE}><feOffset dx="20"/></filter>'
MOVED = f'<g transform="translate(20)">{SHAPES}</g>'
PLACES = {
    "clip after it": (
        f'<clipPath id="c"><rect width="60" height="100"/></clipPath><g filter="url(#f)" clip-path="url(#c)">{SHAPES}'
        "</g>",
        f'<clipPath id="c"><rect width="60" height="100"/></clipPath><g clip-path="url(#c)">{MOVED}</g>',
    ),
    "opacity after it": (f'<g filter="url(#f)" opacity="0.5">{SHAPES}</g>', f'<g opacity="0.5">{MOVED}</g>'),
    "turned units": (
        f'<g transform="rotate(90 50 50)" filter="url(#f)">{SHAPES}</g>',
        f'<g transform="rotate(90 50 50)">{MOVED}</g>',
    ),
    "beyond a viewport": (
        '<svg width="50" height="100"><rect x="-20" width="20" height="9" filter="url(#f)"/></svg>',
        '<rect width="20" height="9"/>',
    ),
    "within a viewport": (
        '<svg width="50" height="100"><rect x="20" width="20" height="9" filter="url(#f)"/></svg>',
        '<rect x="40" width="10" height="9"/>',
    ),
    "use": (
        f'<defs><g id="g">{SHAPES}</g></defs><use href="#g" filter="url(#f)"/>',
        MOVED,
    ),
    "nested": (
        f'<g filter="url(#f)"><g filter="url(#f)">{SHAPES}</g></g>',
        f'<g transform="translate(40)">{SHAPES}</g>',
    ),
    "in a mask": (
        f'<mask id="n"><g filter="url(#f)">{WHITE}</g></mask><g mask="url(#n)">{GREEN}</g>',
        f'<mask id="n"><g transform="translate(20)">{WHITE}</g></mask><g mask="url(#n)">{GREEN}</g>',
    ),
    "image of an element": (
        f'<defs><g id="g">{SHAPES}</g></defs><filter id="i" {WHOLE}><feImage href="#g" x="10" width="60"/></filter>'
        '<g filter="url(#i)"><rect width="9" height="9"/></g>',
        f'<clipPath id="c"><rect x="10" width="60" height="100"/></clipPath><g clip-path="url(#c)">'
        f'<g transform="translate(10)">{SHAPES}</g></g>',
    ),
    "image of a drawing": (
        f'<filter id="i" {WHOLE}><feImage x="10" width="40" height="20" href="data:image/svg+xml,%3Csvg '
        "xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'%3E%3Crect width='9' height='9'/%3E%3C/svg%3E\"/>"
        '</filter><g filter="url(#i)"><rect width="9" height="9"/></g>',
        '<rect x="20" width="18" height="18"/>',
    ),
    "pattern": (
        '<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse"><rect width="5" height="5"/></pattern>'
        '<rect width="40" height="40" fill="url(#p)" filter="url(#f)"/>',
        '<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse"><rect width="5" height="5"/></pattern>'
        '<rect x="20" width="40" height="40" fill="url(#p)"/>',
    ),
    "blend inside": (
        f'{GREEN}<g filter="url(#f)"><rect width="50" height="50" fill="#f00"/>'
        '<rect width="50" height="50" fill="#ff0" style="mix-blend-mode: difference"/></g>',
        f'{GREEN}<g style="isolation: isolate" transform="translate(20)"><rect width="50" height="50" fill="#f00"/>'
        '<rect width="50" height="50" fill="#ff0" style="mix-blend-mode: difference"/></g>',
    ),
}


@pytest.mark.parametrize("name", PLACES)
def test_a_filter_acts_where_its_element_stands(name: str) -> None:
    body, expected = PLACES[name]
    assert_same(drawing_of(OFFSET + body), expected)


def test_units_are_parts_of_the_bounding_box() -> None:
    attributes = 'primitiveUnits="objectBoundingBox" x="0" y="0" width="2" height="1"'
    found = filtered('<feOffset dx="0.5"/>', attributes=attributes)
    assert_same(found, f'<g transform="translate(30)">{SHAPES}</g>')


def test_the_default_region_is_a_tenth_wider_than_the_box() -> None:
    found = filtered('<feFlood flood-color="#0a0"/>', '<rect x="20" y="20" width="50" height="50"/>', SRGB)
    assert_same(found, '<rect x="15" y="15" width="60" height="60" fill="#0a0"/>')


def test_gradients_change_by_their_stops() -> None:
    ramp = '<linearGradient id="g"><stop stop-color="{}"/><stop offset="1" stop-color="{}"/></linearGradient>'
    fill = '<rect width="100" height="100" fill="url(#g)"/>'
    body = f'{ramp.format("#f00", "#0f0")}<g style="filter: invert(1)">{fill}</g>'
    assert_same(drawing_of(body), f"{ramp.format('#0ff', '#f0f')}{fill}")


@pytest.mark.parametrize("shape", ["<g/>", '<path d="M10 10h50" stroke="#000"/>'])
def test_without_a_box_nothing_is_drawn_as_in_browsers(shape: str) -> None:
    assert filtered("<feOffset/>", shape, "").paths == ()


def test_em_is_the_font_size_of_the_filter() -> None:
    flood = '<feFlood flood-color="#0a0"/>'
    sides = 'x="1em" y="1em" width="2em" height="2em"'
    found = filtered(flood, attributes=f'filterUnits="userSpaceOnUse" {sides} style="font-size: 10px"')
    assert_same(found, '<rect x="10" y="10" width="20" height="20" fill="#0a0"/>')
