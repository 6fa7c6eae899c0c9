"""Patterns of an SVG, at the edges of the standard and of our limits; elsewhere the fixtures are compared."""

import numpy as np
import pytest
from pattern_drawings import DISC, DOT, FILLED, HEAD, PATTERN, RECT, SIZE, dots, drawing_of, gap

import vexture
from vexture.base.errors import SourceError, SourceWarning
from vexture.drawing.group import Group, Mask
from vexture.renderers.exact import render_exact

DOTS = PATTERN.format('width="10" height="10"', DOT)


STRETCHED = 'viewBox="0 0 10 10" preserveAspectRatio="none"'
FALLBACK = 'fill="url(#p) lime"'
CASES = {
    "usual": (dots(SIZE), [100], ["#ff0000"]),
    "no width": (dots('height="10"'), [], []),
    "no height, fallback": (dots('width="10" height="0"', FALLBACK), [1], ["#00ff00"]),
    "negative width": (dots('width="-10" height="10"'), [], []),
    "width without meaning": (dots('width="abc" height="10"'), [], []),
    "hardly a width": (dots('width="1e-300" height="10"'), [], []),
    "very many strips in one": (
        PATTERN.format(f'width="10" height="1e-11" {STRETCHED}', '<path d="M0 0h5v10H0z"/>') + RECT.format(FILLED),
        [10],
        ["#000000"],
    ),
    "negative corner": (dots(SIZE + ' x="-1010" y="-2010"'), [100], ["#ff0000"]),
    "singular transform": (dots(SIZE + ' patternTransform="scale(0 1)"'), [], []),
    "singular transform, fallback": (dots(SIZE + ' patternTransform="scale(0 1)"', FALLBACK), [1], ["#00ff00"]),
    "invalid transform": (dots(SIZE + ' patternTransform="melt(3)"'), [100], ["#ff0000"]),
    "invalid units": (dots(SIZE.replace("10", "50") + ' patternContentUnits="melt"'), [4], ["#ff0000"]),
    "no content": (PATTERN.format(SIZE, "<!-- none -->") + RECT.format(FILLED), [], []),
    "no content, fallback": (PATTERN.format(SIZE, "") + RECT.format(FALLBACK), [1], ["#00ff00"]),
    "content that is not painted": (PATTERN.format(SIZE, "<foreignObject/>") + RECT.format(FALLBACK), [], []),
    "references in a circle": (
        f'<pattern id="p" href="#q"/><pattern id="q" href="#p" {SIZE}/>{RECT.format(FILLED)}',
        [],
        [],
    ),
    "a reference to no pattern": (dots(SIZE + ' href="#a"'), [100], ["#ff0000"]),
    "display and opacity of a pattern": (dots(SIZE + ' display="none" opacity="0"'), [100], ["#ff0000"]),
    "invisible fill": (dots(SIZE, FILLED + ' fill-opacity="0"'), [], []),
    "a shape without area": (DOTS + '<path d="M0 15H50" fill="url(#p)"/>', [], []),
    "no more than a tile": (DOTS + '<rect x="10" y="20" width="10" height="10" fill="url(#p)"/>', [1], ["#ff0000"]),
    "a shape outside": (DOTS + '<rect x="-90" width="80" height="50" fill="url(#p)"/>', [], []),
    "a bounding box": (
        f'<pattern id="p" width=".1" height="20%">{DOT}</pattern>{RECT.format(FILLED)}',
        [50],
        ["#ff0000"],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_edges_of_the_standard(name: str) -> None:
    body, contours, colors = CASES[name]
    drawing = drawing_of(body)
    assert [len(path.contours) for path in drawing.paths] == contours
    assert [path.paint.hex for path in drawing.paths] == colors
    assert drawing.groups == ()


@pytest.mark.parametrize(
    ("attributes", "said"),
    [
        ('height="10" width="-10"', "invalid and ignored: width='-10' of <pattern id=\"p\">"),
        (SIZE + ' patternTransform="melt(3)"', "patternTransform='melt.*' of <pattern id=\"p\">"),
        (SIZE + ' patternContentUnits="melt"', "patternContentUnits='melt' of <pattern id=\"p\">"),
        (SIZE + ' preserveAspectRatio="melt"', "preserveAspectRatio='melt' of <pattern id=\"p\">"),
    ],
)
def test_invalid_values_are_named_once(attributes: str, said: str) -> None:
    with pytest.warns(SourceWarning, match=f"{said} in line 1(;.*)?$"):
        vexture.read(f"{HEAD}{dots(attributes)}{RECT.format(FILLED)}</svg>".encode())


def test_a_hatching_is_as_if_written_by_hand() -> None:
    hatching = PATTERN.format('width="4" height="4" patternTransform="rotate(45)"', '<path d="M0 0H2V4H0z"/>')
    lines = "".join(f'<path d="M{x} -200h2v400h-2z"/>' for x in range(-200, 200, 4))
    clip = f'<clipPath id="c">{DISC.format("")}</clipPath>'
    by_hand = f'{clip}<g clip-path="url(#c)"><g transform="rotate(45)">{lines}</g></g>'
    assert gap(hatching + DISC.format(FILLED), by_hand) < 2e-6


def test_a_shape_masks_its_pattern_and_a_rectangle_cuts_it() -> None:
    masked = drawing_of(DOTS + DISC.format(FILLED + ' fill-opacity="0.5"'))
    assert masked.groups == (Group(pattern=True), Group(0, mask=Mask.OPACITY))
    mask, content = masked.paths
    assert (mask.group, mask.paint.opacity, content.group, content.paint.opacity) == (1, 0.5, 0, 1.0)
    cut = drawing_of(DOTS + RECT.format(FILLED + ' fill-opacity="0.5"'))
    assert (cut.groups, cut.paths[0].paint.opacity) == ((), 0.5)


def test_paths_of_a_pattern_have_the_name_of_the_shape() -> None:
    inside = '<rect id="b" width="5" height="5" stroke="red"/>'
    body = PATTERN.format(SIZE, inside) + RECT.format(FILLED) + DISC.format('fill="none" stroke="url(#p)"')
    names = [path.element for path in drawing_of(body).paths]
    assert names == ["a", "a", "", "a/stroke", "a/stroke"]
    texture = vexture.convert(drawing_of(DOTS + DISC.format(FILLED)), restyle=True)
    assert texture.element_at([(0.55, 0.55)]).name.tolist() == ["a"]
    red = texture.with_paints({"a": "blue"}).render(size=100)
    assert red[..., 2].max() == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_silhouettes_and_layers_show_the_shape_that_a_pattern_fills(opacity: float) -> None:
    translucent = f'{FILLED} fill-opacity="{opacity}"'
    drawing = drawing_of(f'{DOTS}<g opacity="0.5">{DISC.format(translucent)}</g>')
    disc = drawing_of(DISC.format(""))
    (layer,) = drawing.layers()
    assert (layer.paths[0].paint.hex[:7], layer.paths[0].paint.opacity) == ("#808080", 0.5 * opacity)
    assert [str(note) for note in layer.notes] == ["pattern shown as solid"]
    silhouette = drawing.without_masks()
    assert [str(note) for note in silhouette.notes] == ["pattern shown as solid"]
    for shown in (layer, silhouette):
        np.testing.assert_array_equal(render_exact(shown, (40, 40)), render_exact(disc, (40, 40)))


def test_a_silhouette_has_the_tiles_of_a_rectangle_and_nothing_of_a_mask() -> None:
    (path,) = drawing_of(DOTS + RECT.format(FILLED)).without_masks().paths
    assert len(path.contours) == 100
    mask = f'<mask id="m">{DISC.format(FILLED)}</mask>'
    silhouette = drawing_of(f'{DOTS}{mask}<rect width="50" height="9" mask="url(#m)"/>').without_masks()
    assert [len(path.contours[0]) for path in silhouette.paths] == [4]
    assert [str(note) for note in silhouette.notes] == ["clip-path or mask", "pattern shown as solid"]


def test_a_pattern_is_in_a_file_without_size_too() -> None:
    drawing = drawing_of(DOTS + '<circle cx="30" cy="40" r="10" fill="url(#p)"/>', HEAD.replace("viewBox", "data-box"))
    assert "is 300 x 150, as in browsers" in drawing.notes[0].message
    assert len(drawing.paths[1].contours) == 4


@pytest.mark.slow
def test_a_pattern_in_a_pattern_is_as_if_written_by_hand() -> None:
    """With a gradient and a transform at each level."""
    ramp = '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    small = PATTERN.format('x="1" width="5" height="6" patternTransform="rotate(30) scale(1.2)"', "{}")
    tile = '<rect width="3" height="4" fill="url(#g)"/>'
    disc = '<circle cx="12" cy="14" r="11" {}/>'
    large = PATTERN.format('width="30" height="30" patternTransform="translate(9 2) rotate(10)"', disc.format(FILLED))
    nested = ramp + small.format(tile) + large.replace('"p"', '"q"') + DISC.format(FILLED.replace("p)", "q)"))
    tiles = "".join(f'<g transform="translate({1 + 5 * i} {6 * j})">{tile}</g>' for i in range(8) for j in range(-3, 5))
    turned = f'<g clip-path="url(#d)"><g transform="rotate(30) scale(1.2)">{tiles}</g></g>'
    places = ((i, j) for i in range(-2, 5) for j in range(-2, 5))
    copies = "".join(f'<g transform="translate({30 * i} {30 * j})">{turned}</g>' for i, j in places)
    clips = f'<clipPath id="c">{DISC.format("")}</clipPath><clipPath id="d">{disc.format("")}</clipPath>'
    by_hand = f'<g clip-path="url(#c)"><g transform="translate(9 2) rotate(10)">{copies}</g></g>'
    assert gap(nested, ramp + clips + by_hand) < 2e-6


def test_a_pattern_is_read_once_for_all_shapes_in_one_place() -> None:
    pattern = PATTERN.format(SIZE, DOT + "<image href='a.png'/>")
    with pytest.warns(SourceWarning, match=r"left out: image 'a\.png' \([^)]*\)$"):
        vexture.read(f"{HEAD}{pattern}{RECT.format(FILLED) * 3}</svg>".encode())


def test_patterns_in_patterns_end() -> None:
    """Each shows the next twice, of two sizes: 2 to the power of 30 first tiles."""
    inside = '<rect width="5" height="5" fill="url(#p{0})"/><rect x="5" y="5" width="5" height="4" fill="url(#p{0})"/>'
    pattern = '<pattern id="p{}" width="10%" height="10%" viewBox="0 0 10 10">{}</pattern>'
    chain = "".join(pattern.format(k, inside.format(k + 1)) for k in range(30))
    with pytest.raises(SourceError, match="clips, markers, masks and patterns show more than 50,000 elements"):
        drawing_of(f'{chain}<pattern id="p30" {SIZE}>{DOT}</pattern>{inside.format(0)}')


def test_patterns_nested_too_deeply_are_an_error() -> None:
    square = '<rect width="5" height="5" fill="url(#p{})"/>'
    chain = "".join(f'<pattern id="p{k}" width="1" height="1">{square.format(k + 1)}</pattern>' for k in range(40))
    with pytest.raises(
        SourceError, match=r"^[^:]*: the 32nd <rect> in line 1: its clips, markers, masks and patterns are nested more"
    ):
        drawing_of(chain + square.format(0))
