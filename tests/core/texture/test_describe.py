"""Facts about the shapes of a texture, ready for JSON."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_texture_encode import chain, texture_of

from both_encodings import encode, info
from strategies import packed_trees
from vexture.base import layout
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.tree.tree import Tree

FORESTS = st.lists(packed_trees(max_quads=8), min_size=1, max_size=4)
TRANSFORM = np.array([[24.0, 0.0, -1.5], [0.0, -24.0, 1 / 3]])


@settings(max_examples=40)
@given(FORESTS)
def test_every_quad_and_curve_is_a_texel_of_its_own(trees: list[Tree]) -> None:
    texture = texture_of(trees)
    total = sum(len(tree.count) + len(tree.curves) for tree in trees)
    told = info(texture)
    assert told["texels"] == total
    assert len(texture.flat) - total < texture.texels.shape[1]
    for tree, root in zip(trees, told["roots"], strict=True):
        assert (root["quads"], root["curves"]) == (len(tree.count), len(tree.curves))
        assert root["coverage"] == pytest.approx(tree.coverage[0].mean(), abs=0.5 / layout.COVERAGE_ONE)


@settings(max_examples=40)
@given(packed_trees())
def test_depth(tree: Tree) -> None:
    depth = np.zeros(len(tree.count), int)
    for quad, cell in np.argwhere(tree.is_quad):
        depth[tree.first_quad[quad] + tree.is_quad[quad, :cell].sum()] = depth[quad] + 1
    texture = encode(tree, to_source=TRANSFORM, name="x")
    assert texture.depth == info(texture)["depth"] == info(texture)["roots"][0]["depth"] == depth.max()


def test_info_is_json() -> None:
    roots = [Root("a", to_source=TRANSFORM, crs="EPSG:4326", tolerance=1e-4, paint=Paint((1.0, 0.5, 0.0), 0.25))]
    told = json.loads(json.dumps(info(encode_packed([chain(2)], roots, name="n", source="a.svg"))))
    assert (told["encoding"], told["version"], told["name"], told["source"]) == ("packed", "1", "n", "a.svg")
    assert told["bytes"] == 16 * told["width"] * told["height"]
    (root,) = told["roots"]
    assert root["paint"] == {"color": [1.0, 0.5, 0.0], "opacity": 0.25}
    assert (root["transform"], root["crs"], root["tolerance"]) == (TRANSFORM.tolist(), "EPSG:4326", 1e-4)
