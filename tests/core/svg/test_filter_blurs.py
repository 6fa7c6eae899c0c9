"""Blurs and shadows of SVG: the paints and paths that they become."""

import numpy as np
import pytest

from vexture.drawing.blur import REACH, Blur
from vexture.drawing.drawing import SOFTENED, Drawing, Path
from vexture.drawing.group import Mask
from vexture.svg.blur_budget import MOST_TEXELS, texels_of
from vexture.svg.filter_soft import ONE_WAY
from vexture.svg.read import svg_drawing
from vexture.tree.planar.style import restylable

FLOOD = '<feFlood flood-opacity="0" result="BackgroundImageFix"/>'
HARD = '<feColorMatrix in="SourceAlpha" values="0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 127 0" result="hardAlpha"/>'
FAINT = '<feColorMatrix values="0 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0.25 0"/>'
SHAPE = '<feBlend in="SourceGraphic" in2="BackgroundImageFix" result="shape"/>'
FIGMA = {
    "layer": (f'{FLOOD}{SHAPE}<feGaussianBlur stdDeviation="5" result="effect1_foregroundBlur"/>', (0, 0, 100, 100)),
    "drop": (
        f'{FLOOD}{HARD}<feOffset dy="4"/><feGaussianBlur stdDeviation="2"/>{FAINT}'
        '<feBlend in2="BackgroundImageFix" result="effect1_dropShadow"/>'
        '<feBlend in="SourceGraphic" in2="effect1_dropShadow" result="shape"/>',
        (16, 20, 68, 68),
    ),
    "drop outside": (
        f'{FLOOD}{HARD}<feOffset dy="4"/><feGaussianBlur stdDeviation="2"/>'
        f'<feComposite in2="hardAlpha" operator="out"/>{FAINT}'
        '<feBlend in2="BackgroundImageFix" result="effect1_dropShadow"/>'
        '<feBlend in="SourceGraphic" in2="effect1_dropShadow" result="shape"/>',
        (16, 20, 68, 68),
    ),
    "inner": (
        f'{FLOOD}{SHAPE}{HARD}<feOffset dy="4"/><feGaussianBlur stdDeviation="2"/>'
        f'<feComposite in2="hardAlpha" operator="arithmetic" k2="-1" k3="1"/>{FAINT}<feBlend in2="shape"/>',
        (20, 20, 60, 64),
    ),
}
SQUARE = '<rect id="card" x="20" y="20" width="60" height="60" rx="8" fill="#D9D9D9"/>'
TWO = '<rect x="20" y="20" width="30" height="30" fill="#f00"/><rect x="50" y="50" width="30" height="30" fill="#00f"/>'


def drawing_of(body: str) -> Drawing:
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    return svg_drawing(f"{head}{body}</svg>".encode(), "a.svg")


def filtered(steps: str, shapes: str = SQUARE, attributes: str = 'color-interpolation-filters="sRGB"') -> Drawing:
    return drawing_of(f'<filter id="f" {attributes}>{steps}</filter><g id="group" filter="url(#f)">{shapes}</g>')


def figma(name: str, shapes: str = SQUARE) -> Drawing:
    steps, (x, y, width, height) = FIGMA[name]
    region = f'filterUnits="userSpaceOnUse" x="{x}" y="{y}" width="{width}" height="{height}"'
    return filtered(steps, shapes, f'{region} color-interpolation-filters="sRGB"')


def blur_of(path: Path) -> Blur:
    assert path.paint.blur is not None
    return path.paint.blur


def in_pixels(blur: Blur) -> tuple[np.ndarray, np.ndarray]:
    """Deviations and window of a blur, in units of an upright drawing of 100 units, y up."""
    scale = np.array([blur.to_source[0][0], blur.to_source[1][1]])
    shift = np.array([blur.to_source[0][2], blur.to_source[1][2]])
    corners = (np.array(blur.window).reshape(2, 2) - shift) / scale
    return 100.0 * np.array(blur.deviations) / scale, 100.0 * corners


def test_a_blurred_layer_is_one_rectangle() -> None:
    found = figma("layer")
    (path,) = found.paths
    blur = blur_of(path)
    assert (path.paint.hex, path.element, found.groups, found.notes) == ("#d9d9d9", "card", (), ())
    assert (blur.has_colors, blur.is_inverted, blur.is_linear) == (False, False, False)
    deviations, window = in_pixels(blur)
    assert deviations == pytest.approx([5.0, 5.0])
    assert window == pytest.approx(np.array([[20 - REACH * 5] * 2, [80 + REACH * 5] * 2]), abs=1e-6)
    assert 100 * path.box == pytest.approx(window)
    (source,) = blur.source.paths
    assert source.box == pytest.approx(np.array([[0.0, 0.0], [1.0, 1.0]]))
    assert source.paint.hex == "#d9d9d9"


def test_a_drop_shadow_is_a_rectangle_below_its_shape() -> None:
    shadow, card = figma("drop").paths
    assert (shadow.paint.hex, shadow.element, shadow.group) == ("#ff000040", "group/filter", -1)
    assert (card.paint.hex, card.element, card.paint.blur) == ("#d9d9d9", "card", None)
    deviations, window = in_pixels(blur_of(shadow))
    assert deviations == pytest.approx([2.0, 2.0])
    assert window == pytest.approx(np.array([[16, 12], [84, 80]]), abs=1e-6)  # the region cuts it


def test_a_shadow_outside_its_shape_is_masked() -> None:
    found = figma("drop outside")
    *mask, shadow, card = found.paths
    assert [found.groups[path.group].mask for path in mask] == [Mask.LUMINANCE] * 2
    assert [path.paint.hex for path in (*mask, shadow)] == ["#ffffff", "#000000", "#ff000040"]
    assert found.groups[shadow.group].outer == card.group == -1


def test_an_inner_shadow_is_the_shape_with_an_inverted_blur() -> None:
    found = figma("inner")
    card, shadow = found.paths
    assert found.groups == ()
    assert [contour.tolist() for contour in shadow.contours] == [contour.tolist() for contour in card.contours]
    assert (shadow.paint.hex, blur_of(shadow).is_inverted) == ("#ff000040", True)
    (source,) = blur_of(shadow).source.paths
    assert source.paint.hex == "#000000"


def test_an_inner_shadow_of_several_shapes_is_masked() -> None:
    found = figma("inner", TWO)
    assert found.notes == ()
    assert not any(path.paint.blur.is_inverted for path in found.paths if path.paint.blur is not None)
    assert [group.mask for group in found.groups].count(Mask.LUMINANCE) == 1


def test_a_function_of_css_is_not_cut() -> None:
    (path,) = drawing_of(f'<g style="filter: blur(5px)">{SQUARE}</g>').paths
    shadow, card = drawing_of(f'<g style="filter: drop-shadow(3px 4px 2px #00f8)">{SQUARE}</g>').paths
    assert in_pixels(blur_of(path))[0] == pytest.approx([5.0, 5.0])
    deviations, window = in_pixels(blur_of(shadow))
    assert deviations == pytest.approx([2.0, 2.0])
    assert window.mean(axis=0) == pytest.approx([53.0, 46.0])
    assert (shadow.paint.hex, card.paint.hex) == ("#0000ff88", "#d9d9d9")


def test_several_colours_are_blurred_together_in_linear_light_by_default() -> None:
    (path,) = filtered('<feGaussianBlur stdDeviation="3"/>', TWO).paths
    (linear,) = filtered('<feGaussianBlur stdDeviation="3"/>', TWO, "").paths
    assert (blur_of(path).has_colors, blur_of(path).is_linear) == (True, False)
    assert (blur_of(linear).has_colors, blur_of(linear).is_linear) == (True, True)
    assert len(blur_of(path).source.paths) == 2
    (alpha,) = filtered('<feGaussianBlur in="SourceAlpha" stdDeviation="3"/>', TWO).paths
    assert not blur_of(alpha).has_colors


@pytest.mark.parametrize("deviation", ["0", "-1", "3 -1", "0 0"])
def test_no_deviation_is_no_blur(deviation: str) -> None:
    (path,) = filtered(f'<feGaussianBlur stdDeviation="{deviation}"/>').paths
    assert path.paint.blur is None


def test_a_blur_in_one_direction_is_little_blurred_in_the_other_one() -> None:
    found = filtered('<feGaussianBlur stdDeviation="3 0"/>')
    across, up = in_pixels(blur_of(found.paths[0]))[0]
    assert across == pytest.approx(3.0)
    assert 0.0 < up < 0.25
    assert [note.message for note in found.notes] == [f"filter of blur ({ONE_WAY})"]


def test_a_blur_of_a_blur_is_one_of_its_picture() -> None:
    (path,) = filtered('<feGaussianBlur stdDeviation="3"/><feGaussianBlur stdDeviation="4"/>').paths
    (inner,) = blur_of(path).source.paths
    assert in_pixels(blur_of(path))[0] == pytest.approx([4.0, 4.0])
    assert 60 < 100 / blur_of(path).to_source[0][0] < 82  # the blurred rectangle
    assert blur_of(inner).source.paths[0].paint.blur is None


def test_a_turned_element_turns_its_blur() -> None:
    body = (
        f'<filter id="f"><feGaussianBlur stdDeviation="4 2"/></filter><g filter="url(#f)" transform="{{}}">{SQUARE}</g>'
    )
    (path,) = drawing_of(body.format("rotate(90 50 50)")).paths
    (a, b, _), (c, d, _) = blur_of(path).to_source
    assert (a, d) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert abs(b) == pytest.approx(abs(c))
    assert blur_of(path).deviations == pytest.approx((4 / 60, 2 / 60))


def test_a_shadow_beyond_the_frame_has_a_small_grid() -> None:
    near = drawing_of('<rect width="90" height="90" style="filter: drop-shadow(0 0 1px)"/>')
    far = drawing_of('<rect x="-800" width="890" height="90" style="filter: drop-shadow(0 0 1px)"/>')
    assert blur_of(far.paths[0]).size[0] <= blur_of(near.paths[0]).size[0] + 8


def test_large_grids_fit_the_budget_with_a_note() -> None:
    squares = "".join(
        f'<rect x="{10 * k}" y="{10 * j}" width="8" height="8" style="filter: blur({0.03 + k / 1000}px)"/>'
        for k in range(9)
        for j in range(9)
    )
    found = drawing_of(squares)
    blurs = [blur_of(path) for path in found.paths]
    assert len(blurs) == 81
    assert sum(texels_of(blur, 1.0) for blur in blurs) <= MOST_TEXELS
    (note,) = found.notes
    assert "blurs widened" in note.message
    assert f"{MOST_TEXELS:,}" in note.message


def test_layers_silhouettes_and_restyling_leave_soft_paints_out() -> None:
    found = figma("drop")
    for plain in (found.flat(), found.without_masks(), restylable(found)):
        assert [path.paint.hex for path in plain.paths] == ["#d9d9d9"]
        assert [(note.kind, note.message, note.count) for note in plain.notes] == [("left out", SOFTENED, 1)]
    assert [layer.name for layer in found.layers()] == ["a/1-#d9d9d9"]


BOMBS = {
    "merge": "".join(
        f'<feMerge result="a"><feMergeNode in="{before}"/><feMergeNode in="{before}"/></feMerge>'
        for before in ["SourceGraphic"] + ["a"] * 30
    ),
    "offset and blur": "".join(
        '<feGaussianBlur stdDeviation="1"/><feMerge result="a"><feMergeNode/><feMergeNode in="a"/></feMerge>'
        for _ in range(30)
    ),
    "tiles": '<feOffset x="20" y="20" width="1e-3" height="1e-3"/><feTile x="0" y="0" width="100" height="100"/>',
    "steps": "<feOffset/>" * 2000,
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_filter_bomb_is_left_out(name: str) -> None:
    found = filtered(BOMBS[name])
    (note,) = found.notes
    assert note.kind == "left out"
    assert "limit is" in note.message
    assert [path.paint.hex for path in found.paths] == ["#d9d9d9"]


@pytest.mark.parametrize("deviation", ["1e-9", "1e9", "1e300", "nan", "1e-300"])
def test_extreme_deviations_are_drawn_or_noted(deviation: str) -> None:
    for attributes in ("", 'x="-1e9" y="-1e9" width="2e9" height="2e9" filterUnits="userSpaceOnUse"'):
        found = filtered(f'<feGaussianBlur stdDeviation="{deviation}"/>', SQUARE, attributes)
        assert found.paths or found.notes


@pytest.mark.slow
def test_filters_in_filters_are_drawn_up_to_a_depth() -> None:
    depth = 60
    body = "".join('<g style="filter: drop-shadow(1px 0)">' for _ in range(depth)) + SQUARE + "</g>" * depth
    found = drawing_of(body)
    assert any("nested more than" in note.message for note in found.notes)
