"""The leaves of a tree are those that its docstring defines, met one by one."""

import numpy as np
import pytest

import decode_by_format as by_format
import packed_walk
import vexture
from vexture.base.errors import ParameterError
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.leaves import leaves, quads, tree_of
from vexture_evidence.measures.shape import convert_by, example

SHAPES = ("duck", "holes", "simple-quartet")


@pytest.mark.parametrize("name", SHAPES)
def test_packed_leaves_are_those_of_the_plain_walk(name):
    texture = vexture.convert(example(name))
    found = leaves(texture)
    plain = packed_walk.leaves(tree_of(texture))
    rows = np.stack([found.x, found.y, found.side, found.depth, found.coverage], axis=1)
    expected = {(leaf.x, leaf.y): leaf for leaf in plain}
    assert len(rows) == len(expected)
    for k, row in enumerate(rows):
        leaf = expected[tuple(row[:2])]
        assert row[2:].tolist() == [leaf.side, leaf.depth, leaf.coverage]
        own = found.curves[found.owner == k]
        np.testing.assert_allclose((own - row[:2]) / row[2], leaf.curves.reshape(-1, 4, 2), atol=1e-9)


@pytest.mark.parametrize("name", SHAPES)
def test_thesis_leaves_are_those_that_the_pixels_say(name):
    texture = vexture.convert(example(name), encoding="thesis")
    found = leaves(texture)
    squares = {leaf[:2]: leaf for leaf in by_format.walk(texture).leaves}
    assert len(found.x) == len(squares)
    lines = found.lines(by_format.CHORDS)
    for k, (x, y) in enumerate(zip(found.x, found.y, strict=True)):
        leaf = squares[x, y]
        assert (found.side[k], found.depth[k]) == (leaf.side, leaf.depth)
        own = np.nonzero(found.owner == k)[0]
        assert len(own) == (0 if leaf.is_constant else 1)
        if len(own) and leaf.is_corner:
            assert found.is_corner[own[0]]
            expected = np.array((x, y)) + leaf.side * by_format.line(texture, leaf)
            np.testing.assert_allclose(lines[own[0], [0, by_format.CHORDS // 2, -1]], expected, atol=1e-12)
        elif len(own):
            np.testing.assert_allclose(
                lines[own[0]], np.array((x, y)) + leaf.side * by_format.line(texture, leaf), atol=1e-12
            )


@pytest.mark.parametrize("encoding", ["packed", "thesis"])
def test_leaves_of_an_empty_drawing_are_four_empty_quarters(encoding):
    found = leaves(vexture.convert(Drawing(()), encoding=encoding))
    assert found.side.tolist() == [0.5] * 4
    assert not found.coverage.any()
    assert found.lines().shape == (0, 17, 2)


def test_a_shape_of_an_atlas_is_chosen_by_its_name():
    both = vexture.atlas([example("duck"), example("holes")])
    alone = leaves(vexture.convert(example("holes")))
    chosen = leaves(both, "holes")
    assert np.array_equal(chosen.curves, alone.curves)
    assert not np.array_equal(leaves(both, "duck").x, alone.x)
    with pytest.raises(ParameterError, match=r"choose one by `root`"):
        leaves(both)


@pytest.mark.parametrize("encoding", ["packed", "thesis"])
def test_leaves_tile_the_unit_square(encoding):
    needle = Drawing.polygon([(0.1, 0.5), (0.9, 0.501), (0.9, 0.502)])
    found = leaves(convert_by(needle, {"encoding": encoding}).tree)
    assert (found.side**2).sum() == 1.0
    assert len(set(zip(found.x, found.y, strict=True))) == len(found.x)
    assert found.x.min() == found.y.min() == 0.0
    assert (found.x + found.side).max() == (found.y + found.side).max() == 1.0


@pytest.mark.parametrize("encoding", ["packed", "thesis"])
def test_quads_and_leaves_are_the_cells_of_quads(encoding):
    tree = convert_by(example("duck"), {"encoding": encoding}).tree
    above, found = quads(tree), leaves(tree)
    assert sorted(above.child[above.child >= 0]) == list(range(1, len(above.x)))
    inner = above.child >= 0
    assert (above.depth[above.child[inner]] == above.depth[np.nonzero(inner)[0]] + 1).all()
    assert above.side.tolist() == (0.5**above.depth).tolist()
    # what is filled of a quad is what is filled of the leaves in it
    for quad in range(len(above.x)):
        right, top = above.x[quad] + above.side[quad], above.y[quad] + above.side[quad]
        within = (above.x[quad] <= found.x) & (found.x < right) & (above.y[quad] <= found.y) & (found.y < top)
        area = found.coverage[within] @ found.side[within] ** 2
        assert above.coverage[quad] == pytest.approx(area / above.side[quad] ** 2, abs=1e-6)
