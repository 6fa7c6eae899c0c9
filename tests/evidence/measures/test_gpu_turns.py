"""Turns of a shader's loops are those that can be counted by hand."""

import numpy as np
import pytest

import corpora
import gpu_cost
from vexture.drawing.drawing import Drawing
from vexture.renderers import cpu
from vexture_evidence.measures import gpu_turns, programs
from vexture_evidence.measures.bands import BANDS, band_texture
from vexture_evidence.measures.gpu_model import LANES
from vexture_evidence.measures.gpu_turns import Turns, band_lane, packed_lane, run_waves

PIXEL = 1.0 / 256.0


def square(side):
    low, high = 0.5 - side / 2, 0.5 + side / 2
    return Drawing.polygon([(low, low), (high, low), (high, high), (low, high)])


def turns_around(drawing, name, x, y):
    """Turns of a wave of pixels, the middle of one of which is a point, and the sum of those of its lanes."""
    view = np.array([[PIXEL, 0.0, x - 4.5 * PIXEL], [0.0, PIXEL, y - 4.5 * PIXEL], [0.0, 0.0, 1.0]])
    turns = Turns(gpu_cost.SHAPES[name])
    if name == "bands":
        lane = band_lane(turns, band_texture(drawing, BANDS), view)
    else:
        lane = packed_lane(turns, programs.packed_texture(drawing), view, is_flat=name == "flat")
    run_waves(turns, lane, [(0, 0)])
    lanes = {key: value * LANES for key, value in turns.per_pixel().items() if value}
    return {key: value for key, value in turns.per_wave().items() if value}, lanes


@pytest.mark.parametrize("name", ["flat", "any"])
def test_turns_along_an_edge_of_a_square(name):
    """The root's leaves hold the corners; a column of eight pixels is on the edge, which is straight: one step."""
    wave, lanes = turns_around(square(0.6), name, 0.2, 0.4)
    once = {"cells": 1, "descend": 1, "leaf": 1, "pieces": 1}
    close = {"close": 1, "steps": 1} | ({"parts": 1} if name == "any" else {})
    assert wave == {**once, **close}
    assert lanes == {key: LANES * value for key, value in once.items()} | {
        key: 8 * value for key, value in close.items()
    }


@pytest.mark.parametrize("name", ["flat", "any"])
def test_turns_in_the_middle_of_a_square(name):
    """One pixel is in all four leaves, of 1, 2, 1 and 2 pieces; 14 others are in two. The lanes wait for each other."""
    wave, lanes = turns_around(square(0.6), name, 0.5, 0.5)
    cells = 49 + 14 * 2 + 4
    # pieces of the right leaves end on their left edges: these are first, second and fourth leaves of lanes
    cut = {} if name == "flat" else {"cut": 4, "more": 3, "edge": 3}
    assert wave == {"cells": 4, "descend": 4, "leaf": 4, "pieces": 2 + 2 + 1 + 2, **cut}
    assert {key: lanes[key] for key in ("cells", "descend", "leaf")} == dict.fromkeys(
        ("cells", "descend", "leaf"), cells
    )
    assert lanes.get("cut", 0) == (0 if name == "flat" else 14 * 2 + 4)


@pytest.mark.parametrize("is_flat", [True, False])
def test_turns_of_a_deep_tree_are_those_that_its_fetches_tell(is_flat):
    """The mirror fetches the root for each cell, each quad on the way to it, and each of its pieces; squares beside the
    footprint cost the shader a cell, and the mirror nothing."""
    texture = programs.packed_texture(corpora.fractal_coastline(12_288, 1))
    pixel = 1.0 / gpu_turns.SIDE
    view = np.array([[pixel, 0.0, 0.0], [0.0 if is_flat else pixel, pixel, 0.0], [0.0, 0.0, 1.0]])
    turns, fetched, beside = Turns(gpu_cost.SHAPES["flat" if is_flat else "any"]), [], []
    notes = {"texel": lambda found, *_: fetched.append(found), "is_beside": lambda found, *_: beside.append(found)}
    coverage = gpu_turns.observe_kernel(cpu.view_coverage, notes, {})
    for lane in (
        packed_lane(turns, texture, view, is_flat),
        lambda pixel: coverage(texture.texels, is_flat, texture.roots[0].quad, (0, 0), view, pixel),
    ):
        run_waves(turns, lane, [(0, 0)])
    lanes = turns.lanes
    assert lanes["quad"] > sum(beside)
    assert lanes["leaf"] > 0
    assert any(beside) != is_flat
    assert lanes["cells"] == lanes["leaf"] + lanes["quad"]
    assert lanes["descend"] == lanes["leaf"] + lanes["quads"]
    assert len(fetched) == lanes["cells"] - sum(beside) + lanes["quads"] + lanes["pieces"]
    assert lanes["more"] == len(beside)


def test_turns_of_the_bands():
    """Each ray passes one edge of the square and stops at the one behind it; beyond the square there are none."""
    each = {"level": 2, "level_ahead": 1, "level_crossed": 1}
    wave, lanes = turns_around(square(0.6), "bands", 0.5, 0.4)
    assert wave == {"inside": 1, **each, **{key.replace("level", "upright"): value for key, value in each.items()}}
    assert lanes == {key: LANES * value for key, value in wave.items()}
    assert turns_around(square(0.6), "bands", 0.1, 0.4) == ({}, {})


def test_a_mirror_that_calls_other_functions_is_named(monkeypatch):
    monkeypatch.setattr("vexture_evidence.measures.gpu_turns.flat.ends", lambda piece: None)
    with pytest.raises(LookupError, match="the mirror does not call better_t"):
        packed_lane(Turns(gpu_cost.SHAPES["flat"]), programs.packed_texture(square(0.6)), np.eye(3), is_flat=True)
