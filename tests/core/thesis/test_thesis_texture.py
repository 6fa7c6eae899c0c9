"""The invariants of FORMAT.md on decoded data."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from both_encodings import decode, encode, info
from strategies import cell_trees
from vexture.base.errors import LimitError, ParameterError
from vexture.bezier.area import leaf_area
from vexture.thesis.layout import CONTROL_MAX, CONTROL_MIN, LIST_LIMIT
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellKind, CellTree

BITS = st.sampled_from([8, 16])
LEAF_KINDS = (CellKind.CURVE, CellKind.CORNER)


def texture_of(tree: CellTree, bits: int) -> ThesisTexture:
    return encode(tree, bits, to_source=np.eye(2, 3), name="tree")


def leaf_tree(*curves: list[list[float]], kind: CellKind = CellKind.CURVE) -> CellTree:
    """A root with up to four leaves."""
    count = len(curves)
    kinds = np.array([[kind] * count + [CellKind.EMPTY] * (4 - count)], np.uint8)
    refs = np.array([[*range(count)] + [-1] * (4 - count)], np.int32)
    return CellTree(kinds, refs, np.zeros((1, 4)), np.array(curves, float), 0.0, 0)


ACROSS = [[0.0, 0.5], [0.3, 0.5], [0.6, 0.5], [1.0, 0.5]]


@pytest.mark.slow
@given(cell_trees(), BITS)
def test_every_quad_and_curve_is_reached_once_in_order(tree: CellTree, bits: int) -> None:
    decoded = decode(texture_of(tree, bits))
    quads, curves, queue = [], [], [0]
    for quad in queue:
        quads.append(quad)
        for kind, ref in zip(decoded.kind[quad], decoded.ref[quad], strict=True):
            if kind == CellKind.QUAD:
                queue.append(int(ref))
            elif kind in LEAF_KINDS:
                curves.append(int(ref))
    assert quads == list(range(len(tree.kind)))
    assert curves == list(range(len(tree.curves)))


@pytest.mark.slow
@given(cell_trees(), BITS)
def test_coverage_of_a_quad_is_the_mean_of_its_cells(tree: CellTree, bits: int) -> None:
    texture = texture_of(tree, bits)
    decoded = decode(texture)
    stored = texture.quads[:, 0, 2] / texture.maximum
    np.testing.assert_allclose(stored, tree.quad_coverage, rtol=0, atol=0.5 / texture.maximum + 1e-12)
    np.testing.assert_allclose(decoded.quad_coverage, stored, rtol=0, atol=1e-12)
    assert decoded.coverage.min() >= 0.0
    assert decoded.coverage.max() <= 1.0


@pytest.mark.slow
@given(cell_trees())
def test_coverage_of_a_cell_comes_back(tree: CellTree) -> None:
    """Within the rounding of a leaf's curve, which moves it by up to a quantum along all of its length."""
    decoded = decode(texture_of(tree, 16))
    np.testing.assert_allclose(decoded.coverage, tree.coverage, rtol=0, atol=4e-3)


@pytest.mark.slow
@given(cell_trees(), BITS)
def test_a_tree_comes_back_within_half_a_quantum(tree: CellTree, bits: int) -> None:
    texture = texture_of(tree, bits)
    decoded = decode(texture)
    np.testing.assert_array_equal(decoded.kind, tree.kind)
    np.testing.assert_array_equal(decoded.ref, tree.ref)
    corner = np.isin(np.arange(len(tree.curves)), tree.ref[tree.kind == CellKind.CORNER])
    quantum = np.where(corner, 1.0, CONTROL_MAX - CONTROL_MIN) / texture.maximum
    inner_off = abs(decoded.curves - tree.curves)[:, 1:3].max(axis=(1, 2), initial=0.0)
    assert (inner_off <= quantum / 2 + 1e-12).all()
    ends, found = tree.curves[:, [0, 3]], decoded.curves[:, [0, 3]]
    step = 4.0 / texture.maximum
    apart = abs(ends[:, 0] - ends[:, 1]).sum(axis=1) > step
    off = abs(found - ends).sum(axis=2).max(axis=1, initial=0.0)  # around a cell corner it is the sum that counts
    assert (off <= np.where(apart, step / 2, step) + 1e-12).all()
    assert (abs(found[:, 0] - found[:, 1]).max(axis=1, initial=0.0)[...] > 0.0).all()
    assert ((found == 0.0) | (found == 1.0)).any(axis=2).all(), "ends lie on the edge exactly"
    assert decoded.deviation == 0.0
    assert decoded.unresolved == 0


@pytest.mark.slow
@given(cell_trees(), BITS, st.booleans())
def test_a_texture_comes_back_bit_for_bit(tree: CellTree, bits: int, unresolved: bool) -> None:
    if unresolved:  # coverage that the leaves do not add up to, as a depth limit leaves behind
        tree = dataclasses.replace(tree, coverage=1.0 - 0.9 * tree.coverage**2)
    texture = texture_of(tree, bits)
    again = texture_of(decode(texture), bits)
    np.testing.assert_array_equal(again.quads, texture.quads)
    np.testing.assert_array_equal(again.curves, texture.curves)


@pytest.mark.slow
@given(cell_trees())
def test_depth_is_that_of_the_deepest_quad(tree: CellTree) -> None:
    assert texture_of(tree, 16).depth == tree.quad_depth.max()


def test_written_values_of_the_red_channel() -> None:
    curve, corner = leaf_tree(ACROSS), leaf_tree(ACROSS, kind=CellKind.CORNER)
    corner.curves[0, 2] = corner.curves[0, 1]
    assert texture_of(curve, 16).quads[0, 2, 0] == 0
    assert texture_of(corner, 8).quads[0, 2, 0] == 128
    assert texture_of(corner, 16).quads[0, 2, 0] == 32768


def test_cells_lie_where_the_picture_says() -> None:
    """Top half first: cell 1 is the bottom right, the last pixel."""
    kind = np.array([[CellKind.EMPTY, CellKind.FULL, CellKind.EMPTY, CellKind.EMPTY]], np.uint8)
    tree = CellTree(kind, np.full((1, 4), -1, np.int32), np.eye(1, 4, 1), np.zeros((0, 4, 2)), 0.0, 0)
    np.testing.assert_array_equal(texture_of(tree, 8).quads[0], [[0, 255, 64], [0, 255, 64], [0, 255, 64], [0, 0, 64]])


def test_the_example_in_the_specification() -> None:
    down = [[0, 1], [1 / 3, 2 / 3], [2 / 3, 1 / 3], [1, 0]]
    tree = CellTree(
        np.array([[CellKind.FULL, CellKind.CURVE, CellKind.CURVE, CellKind.EMPTY]], np.uint8),
        np.array([[-1, 0, 1, -1]], np.int32),
        np.array([[1.0, 0.5, 0.5, 0.0]]),
        np.array([down, down], float),
        0.0,
        0,
    )
    texture = texture_of(tree, 8)
    text = (Path(__file__).parents[3] / "FORMAT.md").read_text()
    for pixels in (texture.quads, texture.curves):
        for number, row in enumerate(pixels.tolist()):
            line = " | ".join([f"| {number}", *(" ".join(map(str, pixel)) for pixel in row)]) + " |"
            assert line in text


@pytest.mark.parametrize("bits", [8, 16])
def test_a_short_chord_keeps_its_filled_side(bits: int) -> None:
    """A drop that touches the edge with both ends in one step: filled inside, or outside if turned round."""
    drop = np.array([[0.5 + 1e-7, 1.0], [1.2, 0.2], [-0.2, 0.2], [0.5, 1.0]])
    tree = leaf_tree(drop.tolist(), drop[::-1].tolist())
    decoded = decode(texture_of(tree, bits))
    of_cells = np.array([0.0, 0.0, *decoded.coverage[0, 2:]])
    of_cells[:2] = [leaf_area(curve, False) for curve in decoded.curves]
    assert of_cells[0] == pytest.approx(leaf_area(drop, False), abs=0.01)
    assert of_cells[0] < 0.4
    assert of_cells[1] > 0.6


@pytest.mark.parametrize(
    ("bits", "quads", "curves"), [(8, 257, 0), (8, 1, 255), (16, LIST_LIMIT[16] + 1, 0), (16, 1, LIST_LIMIT[16] - 1)]
)
def test_lists_too_long_name_count_limit_and_remedy(bits: int, quads: int, curves: int) -> None:
    tree = CellTree(
        np.full((quads, 4), CellKind.EMPTY, np.uint8),
        np.full((quads, 4), -1, np.int32),
        np.zeros((quads, 4)),
        np.zeros((curves, 4, 2)),
        0.0,
        0,
    )
    with pytest.raises(LimitError) as caught:
        texture_of(tree, bits)
    message = str(caught.value)
    assert str(quads if quads > 1 else curves + 2) in message
    assert str(LIST_LIMIT[bits]) in message
    assert "`tolerance`" in message
    assert "`max_depth`" in message
    assert ("`bits` 16" in message) == (bits == 8)
    assert "\n" not in message


def test_bits_other_than_8_or_16() -> None:
    with pytest.raises(ParameterError, match="`bits` is 12"):
        texture_of(leaf_tree(ACROSS), 12)


@pytest.mark.parametrize("value", [CONTROL_MAX + 1e-4, CONTROL_MIN - 1e-4, np.nan, np.inf])
@pytest.mark.parametrize("place", [1, 2])
def test_inner_points_out_of_range_are_refused_not_clamped(value: float, place: int) -> None:
    tree = leaf_tree(ACROSS, ACROSS)
    tree.curves[1, place, 1] = value
    with pytest.raises(LimitError, match="curve 1"):
        texture_of(tree, 16)


def test_a_corner_outside_its_cell_is_refused() -> None:
    tree = leaf_tree(ACROSS, kind=CellKind.CORNER)
    tree.curves[0, 1:3] = [1.01, 0.5]
    with pytest.raises(LimitError, match=r"0\.0 to 1\.0"):
        texture_of(tree, 16)


@pytest.mark.parametrize("end", [[0.1, 0.5], [0.0, 1.2], [np.nan, 0.5]])
def test_ends_off_the_edge_are_refused(end: list[float]) -> None:
    tree = leaf_tree(ACROSS)
    tree.curves[0, 0] = end
    with pytest.raises(LimitError, match="edge"):
        texture_of(tree, 16)


def test_a_transform_that_is_not_finite_is_refused() -> None:
    with pytest.raises(LimitError, match="transform"):
        encode(leaf_tree(ACROSS), 16, to_source=np.full((2, 3), np.inf), name="x")


def test_info_says_what_is_in_it() -> None:
    transform = np.array([[2.0, 0.0, 1.0], [0.0, -2.0, 3.0]])
    texture = encode(leaf_tree(ACROSS, ACROSS), 8, to_source=transform, name="two", crs="EPSG:28992")
    assert info(texture) == {
        "encoding": "thesis",
        "version": "1",
        "bits": 8,
        "name": "two",
        "quads": 1,
        "curves": 2,
        "depth": 0,
        "coverage": 0.0,
        "transform": transform.tolist(),
        "crs": "EPSG:28992",
        "cells": {"curve": 2, "quad": 0, "corner": 0, "full": 0, "empty": 2},
        "bytes": 12 + 24,
    }
