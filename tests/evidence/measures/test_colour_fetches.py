"""Texels read for a pixel in colours are those that its leaf and the shader's text ask for."""

import numpy as np

from vexture import window
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.renderers.view import ViewLike
from vexture_evidence.measures.colour_fetches import SheetStack, layer_boxes, pixel_fetches, spread_pixels

RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0))
STOPS = Stop(0.0, (0.0, 0.0, 0.0), 1.0), Stop(1.0, (1.0, 1.0, 1.0), 1.0)
FADE = Paint.from_gradient(Gradient(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)), STOPS))


def box(low: float, high: float, paint: Paint) -> Path:
    """A band from the lower to the upper edge of the square."""
    contours = Drawing.polygon([(low, 0.0), (high, 0.0), (high, 1.0), (low, 1.0)]).paths[0].contours
    return Path(contours, paint=paint)


def fetches(drawing: Drawing, split: str, side: int, view: ViewLike = None) -> float:
    made = run(drawing, Parameters(split))
    parts = made.drawing.layers() if split == "paint" else (drawing,)
    return pixel_fetches(SheetStack(made.texture, layer_boxes(parts)), side, view, side, seed=1)


def test_a_cell_without_pieces_costs_its_quad_its_base_and_its_paint():
    halves = Drawing((box(0.0, 0.5, RED), box(0.5, 1.0, BLUE)))
    assert fetches(halves, "faces", 2) == 4.0  # and the head of the map


def test_a_piece_that_is_not_clear_costs_itself_its_sides_and_both_paints():
    bands = Drawing((box(0.0, 0.25, RED), box(0.25, 1.0, BLUE)))
    crossed, clear = 4.0 + 1.0 + 3.0, 4.0
    assert fetches(bands, "faces", 2) == (crossed + clear) / 2


def test_a_program_is_looked_up_once_and_a_flat_colour_where_it_is_named():
    shades = Drawing((box(0.0, 1.0, RED), *(box(0.02 * k, 0.02 * k + 0.01, FADE) for k in range(1, 6))))
    flat = Drawing(tuple(Path(path.contours, paint=BLUE if path.paint is FADE else RED) for path in shades.paths))
    beside = window(0.25, 0.0, 0.25, 0.25)  # all ten pieces lie to the left of it: five texels, with sides in two
    assert fetches(flat, "faces", 1, beside) == 3.0 + 2.0 * 5 + 2.0 + 1.0 + 2.0 * 10
    assert fetches(shades, "faces", 1, beside) == 3.0 + 2.0 * 5 + 2.0 + 1.0 + 10 + 1.0


def test_layers_are_read_down_to_the_one_that_covers():
    low, high, glass = box(0.1, 0.9, RED), box(0.1, 0.9, BLUE), box(0.1, 0.9, Paint((0.0, 0.0, 1.0), 0.5))
    within, outside = window(0.3, 0.3, 0.4, 0.4), window(0.92, 0.0, 0.05, 0.05)
    alone = fetches(Drawing((low,)), "paint", 4, within)
    assert alone > 2.0  # box and head
    assert fetches(Drawing((low, high)), "paint", 4, within) == alone
    assert fetches(Drawing((low, glass)), "paint", 4, within) == 2 * alone
    assert fetches(Drawing((low, glass)), "paint", 4, outside) == 2.0  # their boxes


def test_pixels_are_spread_over_the_picture():
    pixels = np.array(list(spread_pixels(64, 4, seed=1)))
    assert sorted((pixels // 16).astype(int).tolist()) == [[x, y] for x in range(4) for y in range(4)]
    assert (pixels % 1.0 == 0.5).all()
