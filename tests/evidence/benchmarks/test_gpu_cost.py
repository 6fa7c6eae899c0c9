"""The model of GPUs counts what it says, and stops if a compiler makes other loops than it knows."""

import doctest
import shutil

import numpy as np
import pytest

import corpora
import gpu_cost
from vexture.drawing.drawing import Drawing
from vexture.renderers import cpu
from vexture_evidence.measures import gpu_compiler, gpu_turns, programs
from vexture_evidence.measures.bands import BANDS, band_texture
from vexture_evidence.measures.gpu_model import FAMILIES, LANES, ONCE, ScopeShape, block_cycles, blocks_of, read_program
from vexture_evidence.measures.gpu_turns import Turns, band_lane, packed_lane, run_waves

PIXEL = 1.0 / 256.0


def test_examples_in_the_docstrings():
    found = doctest.testmod(gpu_cost)
    assert found.attempted
    assert not found.failed


@pytest.mark.parametrize("family", FAMILIES)
def test_the_driver_compiles_the_loops_that_are_counted(family):
    try:
        with gpu_compiler.toolchain() as tools:
            made = {
                name: tools.compile_shader(name, gpu_cost.SOURCES[name], FAMILIES[family].name)
                for name in gpu_cost.SHAPES
            }
    except gpu_compiler.ToolchainError as error:
        pytest.skip(str(error))
    for name, shape in gpu_cost.SHAPES.items():
        found = read_program(name, made[name].assembly, shape)
        assert sum(len(block.lines) for block in found.blocks) == made[name].statistics["Instructions"]


@pytest.mark.parametrize("lacking", ["cc", "radeon_icd"])
def test_what_is_missing_is_named_in_one_line(lacking, monkeypatch, capsys):
    if lacking == "cc":
        monkeypatch.setenv("PATH", "")
    elif not all(map(shutil.which, gpu_compiler.PACKAGES)):
        pytest.skip("the compilers are missing, and that is named first")
    monkeypatch.setattr(gpu_compiler, "DRIVERS", [])
    monkeypatch.setattr("sys.argv", ["gpu_cost.py"])
    gpu_cost.main()
    printed = capsys.readouterr().out
    assert printed.startswith("skipped: there is no ")
    assert lacking in printed
    assert printed.count("\n") == 1


LOOPS = """
BB0:
    v_mov_b32 v0, 0
BB1:
    v_cmp_lt_i32 vcc, 9, v0
    s_cbranch_scc0 BB6
BB2:
    v_add_u32 v0, v0, 1
    s_cbranch_execz BB4
BB3:
    image_load v1, v0, s[0:7]
BB4:
    v_add_u32 v0, v0, v1
    s_branch BB1
BB6:
    v_mov_b32 v2, v0
    s_endpgm
"""


def test_a_loop_is_checked_once_more_than_it_turns():
    found = read_program("loops", LOOPS, ScopeShape("cells(quads*?)")).cycles(
        {"cells": 5.0, "quads": 3.0}, FAMILIES["GCN5"]
    )
    valu = FAMILIES["GCN5"].valu
    assert {name: (one.valu, one.fetch) for name, one in found.items()} == {
        ONCE: (2 * valu, 0.0),
        "cells": ((6 + 5 + 5) * valu, 0.0),
        "quads": (0.0, 3.0 * FAMILIES["GCN5"].fetch),
    }


@pytest.mark.parametrize(
    "expected", ["cells", "cells(quads?)", "cells*(quads*?)", "cells(quads*? more)", "cells(quads*)"]
)
def test_other_loops_are_named_and_not_assigned(expected):
    with pytest.raises(RuntimeError, match=r"loops: the compiler made loop\(if\*\); expected"):
        read_program("loops", LOOPS, ScopeShape(expected))


@pytest.mark.parametrize(
    ("lines", "alone"),
    [
        ("v_mul_f32 v0, v1, v2\n v_mul_f32 v3, v4, v5", 4.0),
        ("v_mul_f32 v0, v1, v2\n v_mul_f32 v3, v0, v5", 8.0),  # the second waits for the first one's result
        ("v_rcp_f32 v0, v1\n v_rcp_f32 v2, v3\n v_mov_b32 v4, 0", 12.0),  # there is one unit for roots
        ("image_load v0, v1, s[0:7]\n v_mov_b32 v2, 0\n s_waitcnt vmcnt(0)\n v_mov_b32 v3, v0", 202.0),
        ("s_load_dwordx8 s[0:7], s[8:9], 0\n s_waitcnt lgkmcnt(0)\n v_mov_b32 v0, s0", 52.0),
    ],
)
def test_cycles_of_a_wave_alone(lines, alone):
    (block,) = blocks_of(f"BB0:\n {lines}")
    assert block_cycles(block, FAMILIES["RDNA2"]).alone == alone


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
