"""Programs of planar maps: what is composited, and what stays to be painted."""

from dataclasses import replace

import numpy as np
import pytest

from degenerate import circle
from gradient_drawings import (
    BANDS,
    DRAWINGS,
    FADING,
    LENS,
    SQUARE,
    UPWARDS,
    WARM,
    linear,
    painted_path,
    radial,
)
from planar import colour_paths, colours_at, paints_at
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.tree.planar.build import build_map
from vexture.tree.planar.compose import Operations, colour_at
from vexture.tree.planar.faces import operations_of
from vexture.tree.planar.layers import layers_of
from vexture.tree.planar.map import PlanarMap
from vexture.tree.planar.programs import Keep, Mix, Solid
from vexture.tree.planar.rows import rows_of
from vexture.tree.planar.source import source_of

HALF_GREY = Paint((0.5, 0.5, 0.5), 0.5)
GREY = Solid((16384, 16384, 16384, 32768))


def program_at(planar: PlanarMap, point) -> tuple:
    (paint,) = paints_at(planar, point)
    return planar.programs[paint]


def test_a_program_is_what_is_seen_from_below() -> None:
    up, glow = UPWARDS.paint.gradient, radial((0.4, 0.5), 0.3, WARM)
    hidden = painted_path(LENS, linear((0, 0), (1, 0), WARM))
    red, grey = painted_path(SQUARE, Paint((1, 0, 0))), painted_path(SQUARE, HALF_GREY)
    groups = (Group(opacity=0.6), Group(0, 0.5), Group(opacity=0.5, blend=Blend.SCREEN))
    inside, centre = painted_path(LENS, glow, 1), (0.4, 0.45)
    for paths, program in (
        ((red, UPWARDS), (up,)),
        ((hidden, UPWARDS, grey), (up, GREY)),
        ((UPWARDS, grey, grey), (up, Solid((24576, 24576, 24576, 49151)))),
        ((UPWARDS, painted_path(LENS, HALF_GREY, 0)), (up, Solid((9830, 9830, 9830, 19660)))),
        ((UPWARDS, painted_path(LENS, HALF_GREY, 2)), (up, Keep(), GREY, Mix(32768, Blend.SCREEN))),
        (
            (UPWARDS, inside, painted_path(LENS, HALF_GREY, 0)),
            (up, Keep(), Keep(), glow, Mix(32768, Blend.NORMAL), GREY, Mix(39321, Blend.NORMAL)),
        ),
        ((painted_path(LENS, glow, 2), grey), (Keep(), glow, Mix(32768, Blend.NORMAL), GREY)),
    ):
        assert program_at(build_map(Drawing(paths, groups=groups)), centre) == program
    of = Drawing(
        (
            UPWARDS,
            painted_path(SQUARE, Paint((1, 0, 0)), 0),
            painted_path(LENS, glow, 0),
            painted_path(SQUARE, Paint(), 0),
        ),
        groups=groups,
    )
    assert program_at(build_map(of), centre) == (up, Solid((0, 0, 0, 39321)))  # black hides the group's others


def test_a_mask_that_holds_a_gradient_comes_after_what_it_masks() -> None:
    up, fade = UPWARDS.paint.gradient, linear((0, 0), (1, 0), WARM)
    red, solid = painted_path(LENS, Paint((1, 0, 0)), 0), Solid((65535, 0, 0, 65535))
    above, below = Mix(65535, Mask.LUMINANCE), Mix(65535, Mask.OPACITY)
    out = Mix(65535, Blend.NORMAL)
    mask, half = Group(0, mask=Mask.LUMINANCE), Group(0, 0.5, mask=Mask.OPACITY)
    inside, flat = painted_path(SQUARE, fade, 1), painted_path(SQUARE, Paint((1, 1, 1)), 2)
    for paths, program in (
        ((UPWARDS, inside, red), (up, Keep(), solid, Keep(), fade, above, out)),
        ((UPWARDS, red, inside), (up, Keep(), solid, Keep(), fade, above, out)),
        ((inside, red), (solid, Keep(), fade, above)),
        ((UPWARDS, inside, red, flat), (up, Keep(), solid, Keep(), fade, above, Mix(32768, Blend.NORMAL))),
        ((UPWARDS, inside), (up,)),
        ((UPWARDS, inside, red, painted_path(SQUARE, fade, 0)), (up, Keep(), fade, Keep(), fade, above, out)),
    ):
        groups = (Group(), mask, half)[: 3 if flat in paths else 2]
        assert program_at(build_map(Drawing(paths, groups=groups)), (0.4, 0.45)) == program
    both = (UPWARDS, inside, painted_path(SQUARE, fade, 2), red)
    two = (Group(), mask, Group(0, mask=Mask.OPACITY))
    program = (up, Keep(), solid, Keep(), fade, above, Keep(), fade, below, out)
    assert program_at(build_map(Drawing(both, groups=two)), (0.4, 0.45)) == program


MOST_LAYERS = 7  # of more, groups may be too deep in one another


@pytest.mark.parametrize("seed", range(60))
def test_programs_of_random_groups_are_right(seed: int) -> None:
    """Gradients and flat colours in groups in one another, some of them masks, before or after what they mask."""
    rng = np.random.default_rng(seed)
    layers = Drawing(tuple(painted_path(SQUARE, Paint()) for _ in range(rng.integers(2, MOST_LAYERS))))
    of = colour_paths(layers, rng)
    shades = [linear(rng.random(2), rng.random(2), stops) for stops in (WARM, FADING, BANDS, FADING)]
    paints = [
        Paint.from_gradient(shades[k]) if k < len(shades) else path.paint
        for k, path in zip(rng.permutation(8)[: len(of.paths)], of.paths, strict=True)
    ]
    of = replace(of, paths=tuple(replace(path, paint=paint) for path, paint in zip(of.paths, paints, strict=True)))
    source, stack = source_of(of, True), np.arange(len(of.paths), dtype=np.int32)
    layers = layers_of(source, rows_of(source, 1), 1)
    count, ops, is_flat = operations_of(layers, stack)
    assert not is_flat
    points = rng.random((20, 2))
    wanted, _ = colours_at(of, points)
    work, found = np.zeros((len(ops[0]) + 1, 4)), np.zeros(4)
    for point, colour in zip(points, wanted, strict=True):
        colour_at(layers, Operations(*ops), count, tuple(point.tolist()), (0.0, 0.0), work, found)
        np.testing.assert_allclose(found, colour, atol=2e-5)  # opacities have 16 bits


def test_gradients_in_too_many_groups_are_flat_and_noted() -> None:
    groups = tuple(Group(k - 1, 0.9) for k in range(5))
    paths = tuple(painted_path(LENS, linear((0, 0), (1, 0), FADING), k - 1) for k in range(6))
    for deep, flat in ((4, 0), (5, 1)):
        conversion = run(Drawing((UPWARDS, *paths[:deep]), groups=groups), Parameters("faces"))
        assert [note.count for note in conversion.notes] == [1] * flat
        (paint,) = paints_at(conversion.tree, (0.4, 0.45))
        assert (paint in conversion.tree.programs) != flat


def test_too_many_gradients_on_one_another_are_flat() -> None:
    glow = [
        painted_path(
            circle((0.5, 0.5), 0.4 - 0.001 * k), linear((0, k / 99), (1, 0), (*WARM[:2], Stop(1, (0, 0, 0), 0.5)))
        )
        for k in range(70)
    ]
    conversion = run(Drawing((UPWARDS, *glow)), Parameters("faces"))
    assert 0 < conversion.notes[0].count < 70
    assert max(map(len, conversion.tree.programs.values())) == 64


def test_one_layer_of_a_gradient_is_a_map() -> None:
    of = DRAWINGS["highlight"]
    texture = run(of, Parameters("faces")).texture
    assert texture.roots[0].is_map
    assert abs(texture.render(8)[4, 4] - colours_at(of, np.array([[0.5625, 0.4375]]))[0][0]).max() < 0.02


def test_a_group_that_makes_no_difference_is_no_part_of_a_program() -> None:
    """Such as that of a clip: without it, groups within are not too deep for a pixel."""
    square = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]).paths[0].contours
    shade = Paint.from_gradient(Gradient(((1, 0, 0), (0, 1, 0)), (Stop(0, (1, 0, 0)), Stop(1, (0, 0, 1)))))
    groups = (Group(), Group(0, 0.85), Group(1, blend=Blend.MULTIPLY))
    paths = [Path(square, paint=shade, group=group) for group in (0, 1, 2)]
    planar = build_map(Drawing(tuple(paths), groups=groups))
    assert planar is not None
    assert planar.flattened == 0
