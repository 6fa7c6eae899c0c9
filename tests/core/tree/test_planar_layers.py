"""The layers of a drawing, as arrays."""

import numpy as np

from degenerate import polygon
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.tree.planar.layers import layers_of
from vexture.tree.planar.rows import rows_of
from vexture.tree.planar.source import source_of

SQUARE = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
RED, GLASS = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.5, 1.0), 0.5)


def test_only_what_is_opaque_and_in_no_group_covers() -> None:
    groups = (Group(opacity=0.5), Group(0, 1.0, Blend.MULTIPLY), Group(0, mask=Mask.OPACITY))
    places = ((RED, -1), (GLASS, -1), (RED, 0), (RED, 1), (GLASS, 2))
    paths = tuple(Path((SQUARE,), paint=paint, group=group) for paint, group in places)
    source = source_of(Drawing(paths, groups=groups))
    layers = layers_of(source, rows_of(source, 0), 0)
    assert layers.opaque.tolist() == [True, False, True, True, False]
    assert layers.covers.tolist() == [True, False, False, False, False]
    np.testing.assert_allclose(layers.rgba[:2], [(1.0, 0.0, 0.0, 1.0), (0.0, 0.25, 0.5, 0.5)])
    assert (layers.depth.tolist(), layers.outer.tolist()) == ([0, 1, 1], [-1, 0, 0])
    assert layers.masked.tolist() == [1, 0, 0]
    assert len(set(layers.keys.tolist())) == len(paths)
    assert (layers.shade == -1).all()


def test_paths_of_one_element_look_alike() -> None:
    names = (("a", RED), ("b", RED), ("a", RED), ("a", GLASS))
    source = source_of(Drawing(tuple(Path((SQUARE,), paint=paint, element=name) for name, paint in names)), True)
    looks = layers_of(source, rows_of(source, 1), 1).look.tolist()
    assert looks[0] == looks[2]
    assert len(set(looks)) == 3
