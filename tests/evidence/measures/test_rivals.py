"""Where drawings are looked at, and how ways to store them are judged."""

import numpy as np
import pytest

from vexture.base.errors import LimitError
from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.exact import render_exact
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS
from vexture_evidence.measures.raster import raster_from
from vexture_evidence.measures.rivals import (
    MANY,
    MOST_TEXELS,
    Rival,
    bands_of,
    distance_rival,
    measure_rival,
    raster_rival,
    scene_of,
    side_in_file,
    side_in_memory,
    texture_rival,
)
from vexture_evidence.measures.shape import ConvertedDrawing, example

SQUARE = ((0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75))


@pytest.fixture(scope="module")
def duck():
    return ConvertedDrawing(example("duck"))


def test_the_truth_errs_nowhere(duck):
    scene = scene_of(duck.drawing)
    truth = Rival("truth", "truth", None, 0, lambda size, view: render_exact(duck.drawing, size, view))
    assert [shown.max for shown in measure_rival(truth, scene)[1:]] == [0.0, 0.0, 0.0]
    moved = Rival("truth", "moved", None, 0, lambda size, view: render_exact(duck.drawing, size))
    assert all(shown.mae > 1.0 for shown in measure_rival(moved, scene)[1:])


def test_rasters_get_better_with_texels_and_packed_needs_none(duck):
    scene = scene_of(duck.drawing)
    outline = [measure_rival(raster_rival(duck.drawing, side), scene).outline.mae for side in (32, 128, 512)]
    assert outline == sorted(outline, reverse=True)
    field = measure_rival(distance_rival(duck.drawing, 128), scene).outline
    packed = measure_rival(texture_rival(duck.way("packed").texture, "packed"), scene).outline
    assert outline[1] > 5 * field.mae > 50 * packed.mae
    assert field.max > 100 > 4.0 > packed.max


def test_bytes_of_textures_are_those_of_their_files_and_memory(duck):
    texture = duck.way("direct").texture
    rival = texture_rival(texture, "direct")
    assert rival.file_bytes == sum(map(len, texture.to_png()))
    assert rival.gpu_bytes == texture.quads.nbytes + texture.curves.nbytes
    packed = texture_rival(duck.way("packed").texture, "packed")
    assert (packed.file_bytes, packed.gpu_bytes) == (
        len(duck.way("packed").texture.to_ktx2()),
        duck.way("packed").texture.nbytes,
    )


@pytest.mark.parametrize("limit", [1, 20, 21, 22, 1000, 87381, 10**9])
def test_the_largest_side_in_memory_is_the_largest(limit):
    side = side_in_memory(limit)
    square = Drawing.polygon(SQUARE)
    assert raster_from(square, side).nbytes <= limit
    assert side == MOST_TEXELS or raster_from(square, side + 1).nbytes > limit


def test_the_largest_side_in_a_file_fits(duck):
    side = side_in_file(lambda side: raster_from(duck.drawing, side, mips=False), 1000)
    assert raster_from(duck.drawing, side).png_bytes <= 1000 < raster_from(duck.drawing, side + 1).png_bytes


def test_bands_take_one_path_with_the_non_zero_rule():
    square = Drawing.polygon(SQUARE)
    assert bands_of(square).bands == BANDS
    with pytest.raises(LimitError, match="2 paths"):
        bands_of(Drawing(square.paths * 2))
    with pytest.raises(LimitError, match="even-odd"):
        bands_of(Drawing.polygon(SQUARE, fill_rule=FillRule.EVENODD))
    around = 2 * np.pi * np.arange(MANY + 1) / (MANY + 1)
    ring = Drawing.polygon(zip(0.5 + 0.4 * np.cos(around), 0.5 + 0.4 * np.sin(around), strict=True))
    assert bands_of(ring).bands == COASTLINE_BANDS
