"""The model of GPUs: loops of a compiled program, and their cycles."""

import pytest

from vexture_evidence.measures.gpu_model import FAMILIES, ONCE, ScopeShape, block_cycles, blocks_of, read_program

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
