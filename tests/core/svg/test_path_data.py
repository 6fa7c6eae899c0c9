"""The grammar of path data."""

import numpy as np
import pytest

from vexture.svg.path_data import path_outlines


@pytest.mark.parametrize(
    ("data", "valid", "ends"),
    [
        ("M0 0h1v1z", 9, [(0, 0)]),
        ("m5 5z", 5, [(5, 5)]),
        ("M5 5", 4, []),
        ("", 0, []),
        ("L1 1", 0, []),
        ("M0 0 L10", 5, []),
        ("M0 0L10 10 20", 11, [(10, 10)]),
        ("M0 0L99.5", 4, []),
        ("M0,0,1,1,,2,2", 8, [(1, 1)]),
        ("M0 0 L NaN 3", 5, []),
        ("M1. 2", 0, []),
        ("M0 0zz", 6, [(0, 0)]),
        ("M.5.5.6.6-1-1", 13, [(-1, -1)]),
        ("M1e3-1E-2L5 5e1", 15, [(5, 50)]),
        ("M1 1a1 1 0 00.5.5", 17, [(1.5, 1.5)]),
        ("M1 1a1 1 0 01.5.5zl1 1", 22, [(1, 1), (2, 2)]),
        ("M1 1A1 1 0 2 0 5 5", 4, []),
        ("M007 00.5L010 1", 15, [(10, 1)]),
        ("M0 0a1 1 007 00010 020", 22, [(10, 20)]),
        ("M0 0a1 1 0 00000 020h1", 22, [(1, 20)]),
        ("M0 0h1 2 3v-1", 13, [(6, -1)]),
        ("M0 0C1 1 2 2 3 3 4 4 5 5", 17, [(3, 3)]),
        ("M0 0L1 1M5 5", 12, [(1, 1)]),
        ("M0 0A1 1 0 1 100.5 , 5", 22, [(0.5, 5)]),
    ],
)
def test_where_path_data_ends(data: str, valid: int, ends: list[tuple[float, float]]) -> None:
    outlines, length = path_outlines(data, 1e-3)
    assert length == valid
    assert [tuple(outline.cubics[-1, 3].tolist()) for outline in outlines] == ends


def test_smooth_commands_mirror_only_their_own_kind() -> None:
    ((curve,), _) = path_outlines("M0 0C0 1 1 1 1 0S2 -1 2 0T4 0t2 0", 1e-3)
    assert curve.cubics[1, 1].tolist() == [1, -1]
    assert curve.cubics[2, 1].tolist() == [2, 0]
    ((wave,), _) = path_outlines("M0 0Q1 1 2 0T4 0", 1e-3)
    assert wave.cubics[1, 1].tolist() == pytest.approx([2 + 2 / 3, -2 / 3])


def test_closing_returns_to_the_start() -> None:
    (first, second), _ = path_outlines("M1 1h5v5zl1 0", 1e-3)
    assert first.closed
    assert not second.closed
    assert second.cubics[0, 0].tolist() == [1, 1]


def test_flags_of_arcs_need_no_space() -> None:
    (compact,), _ = path_outlines("M0 0A60,60 0 0 100 50z", 1e-3)
    (spaced,), _ = path_outlines("M0 0 A 60 60 0 0 1 00 50 z", 1e-3)
    np.testing.assert_array_equal(compact.cubics, spaced.cubics)


@pytest.mark.parametrize("radii", ["5e-324 5", "5 5e-324", "0 5", "5e-324 0", "1e-200 1e-50"])
def test_arcs_of_radii_next_to_nothing_are_lines(radii: str) -> None:
    (outline,), valid = path_outlines(data := f"M1 1A{radii} 0 0 1 9 5", 1e-3)
    assert valid == len(data)
    np.testing.assert_allclose(outline.cubics, [np.linspace((1, 1), (9, 5), 4)])


@pytest.mark.parametrize("radius", ["1e-9", "1e-200", "5e-324"])
def test_arcs_too_small_to_join_their_ends_are_enlarged(radius: str) -> None:
    (tiny,), _ = path_outlines(f"M1 1A{radius} {radius} 0 0 1 9 1", 1e-3)
    (half,), _ = path_outlines("M1 1A4 4 0 0 1 9 1", 1e-3)
    np.testing.assert_allclose(tiny.cubics, half.cubics, atol=1e-12)
