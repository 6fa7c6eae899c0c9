"""Gradients at the edges of shapes, in views that are small, turned, and stretched 6:1, against the exact renderer."""

import numpy as np
import pytest
from hand import need_gpu

import vexture
from vexture.conversion.reading import read_drawing
from vexture.renderers.exact import render_exact_colours

MOST = 2 / 255
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><defs>{}</defs>{}</svg>'
STAR = "M92 31 L12 58 L81 88 L35 6 L47 95 Z"
HARD = (
    '<stop offset="0" stop-color="#fff"/><stop offset=".5" stop-color="#e8981a"/>'
    '<stop offset=".5" stop-color="#2a120b" stop-opacity=".5"/><stop offset="1" stop-color="red"/>'
)
LINEAR = f'<linearGradient id="g" x1=".73" y1=".46" x2=".5" y2=".63">{HARD}</linearGradient>'
REPEAT = (
    '<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="50" cy="40" r="15" fx="47" spreadMethod="repeat">'
    f"{HARD}</radialGradient>"
)
CONE = f'<radialGradient id="g" cx=".4" cy=".5" r=".2" fx=".9" fy=".4" fr=".05">{HARD}</radialGradient>'
CONES = CONE.replace("<radialGradient", '<radialGradient spreadMethod="repeat"')
SMALLER = (
    '<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="50" cy="40" r="12" fr="18" spreadMethod="repeat">'
    f"{HARD}</radialGradient>"
)
STEEP = '<radialGradient id="g"><stop offset=".5"/><stop offset=".51" stop-color="#fff"/></radialGradient>'
STEEP_BOTH = (
    '<linearGradient id="h" x2="0" y2="1"><stop offset=".5" stop-color="#f84"/><stop offset=".515" stop-color="#026"/>'
    '</linearGradient><linearGradient id="g" x2="0" y2="1"><stop offset=".5" stop-color="#fc3"/>'
    '<stop offset=".515" stop-color="#fc3" stop-opacity="0"/></linearGradient>'
)
CROSSED = (
    '<linearGradient id="g" spreadMethod="reflect" x2=".4"><stop stop-color="#fff"/><stop offset="1"/>'
    '</linearGradient><linearGradient id="h" spreadMethod="reflect" x2=".3" y2=".3"><stop stop-color="red"/>'
    '<stop offset="1" stop-color="red" stop-opacity="0"/></linearGradient>'
)
WIDE_CONE = '<radialGradient id="g" cx=".6205" cy=".6205" r=".16" fx=".5244" fy=".4923"><stop/><stop/></radialGradient>'
LEAF = '<path d="M2 3C0 -14 10 -15 24 -27C23 2 22 47 19 85C19 92 7 93 3 92C-4 68 7 31 2 3" fill="url(#g)"/>'
BOTH_WAYS = (
    '<linearGradient id="g"><stop stop-color="#c20"/><stop offset="1" stop-color="#4a0"/></linearGradient>'
    '<linearGradient id="h" x2="0" y2="1"><stop/><stop offset="1" stop-color="#aa0"/></linearGradient>'
)
FILLED = f'<path d="{STAR}" fill="url(#g)"/>'
UNDER = '<path d="M20 10 H90 V70 H20 Z" fill="{}"/>'
DRAWINGS = {
    "linear, hard stop": SVG.format(LINEAR, FILLED),
    "radial, repeated": SVG.format(REPEAT, FILLED),
    "radial, cone": SVG.format(CONE, FILLED),
    "radial, repeated cones": SVG.format(CONES, FILLED),
    "radial, repeated inwards": SVG.format(SMALLER, FILLED),
    "radial, steep": SVG.format(STEEP, '<circle cx="47" cy="52" r="45" fill="url(#g)"/>'),
    "two ramps": SVG.format(CROSSED, FILLED + FILLED.replace("#g", "#h")),
    "steep ramps on one another": SVG.format(STEEP_BOTH, UNDER.format("url(#h)") + UNDER.format("url(#g)")),
    "dodge": SVG.format(LINEAR, FILLED + f'<g style="mix-blend-mode:color-dodge">{UNDER.format("#fff")}</g>'),
    "difference of ramps": SVG.format(
        BOTH_WAYS,
        UNDER.format("url(#g)") + f'<g style="mix-blend-mode:difference">{UNDER.format("url(#h)")}</g>',
    ),
    "hue of grey": SVG.format(
        "", UNDER.format("#0f7d3a") + f'<g style="mix-blend-mode:hue" opacity=".7"><path d="{STAR}" fill="#999"/></g>'
    ),
}
VIEWS = {"whole": (0, 1), "turned": (17, 1), "6:1": (0, 6), "6:1 turned": (30, 6)}


def view_of(size: int, degrees: float, stretch: float):
    """The (3, 3) matrix from pixels to the unit square about its middle."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    matrix = np.eye(3)
    matrix[:2, :2] = [[c, -s], [s, c]] @ np.diag([stretch / size, -1 / size])
    matrix[:2, 2] = 0.5 - matrix[:2, :2] @ [size / 2, size / 2]
    return matrix


@pytest.mark.parametrize("name", DRAWINGS)
def test_gradients_are_exact_at_edges_in_every_view(name: str) -> None:
    drawing = read_drawing(DRAWINGS[name].encode(), name="drawing.svg")
    texture = vexture.convert(drawing)
    for size in (37, 61):
        for view, (degrees, stretch) in VIEWS.items():
            matrix = view_of(size, degrees, stretch)
            found = texture.render(size=(size, size), view=matrix, renderer="cpu")
            gap = np.abs(found - render_exact_colours(drawing, (size, size), matrix)).max()
            assert gap < MOST, (view, size, 255 * gap)


def test_a_cone_almost_as_wide_as_half_of_the_plane_is_exact_at_its_sides() -> None:
    """The middle of a part of what was in it could be in the cone behind its tip, where there is no colour."""
    drawing = read_drawing(SVG.format(WIDE_CONE, LEAF).encode(), name="drawing.svg")
    step = 0.0035533
    matrix = np.array([[step, step, -0.257322], [step, -step, 0.592], [0.0, 0.0, 1.0]])
    gap = np.abs(vexture.convert(drawing).render((99, 60), matrix) - render_exact_colours(drawing, (99, 60), matrix))
    assert gap.max() < MOST, 255 * gap.max()


def test_a_pixel_of_many_faces_with_many_gradients_costs_no_more_than_drivers_allow() -> None:
    """Mesa's software driver ends the loops of a pixel after 65,535 rounds, wherever they are: the rest was missing."""
    need_gpu()
    numbers = range(8)
    stop = '<stop offset="{}" stop-color="#{}{}8"/>'
    stops = ["".join(stop.format(at / 12, (k + at) % 9, at % 9) for at in range(12)) for k in numbers]
    ramp = '<linearGradient id="g{0}" gradientTransform="rotate({0}0)">{1}</linearGradient>'
    ramps = [ramp.format(k, stops[k]) for k in numbers]
    lines = [f'<path d="M{x} 0h3v100h-3z M0 {x}h100v3h-100z" fill="#00f" opacity=".5"/>' for x in range(0, 100, 6)]
    over = '<path d="M0 0H100V100H0z" fill="url(#g{})" style="mix-blend-mode:difference"/>'
    above = [over.format(k) for k in numbers]
    texture = vexture.convert(read_drawing(SVG.format("".join(ramps), "".join(lines + above)).encode(), name="a.svg"))
    for size in (3, 5, 11):
        gap = np.abs(texture.render(size, renderer="gpu") - texture.render(size, renderer="cpu")).max()
        assert gap < 1 / 255, (size, 255 * gap)
