"""Trees to packed textures and back."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_ktx2 import by_ktx_parse

from both_encodings import decode, encode
from strategies import packed_trees
from vexture.base import layout
from vexture.base.errors import FormatError, LimitError
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.tree import Tree

FIELDS = ("is_quad", "count", "winding", "first_quad", "first_curve", "curves")
FORESTS = st.lists(packed_trees(max_quads=8), min_size=1, max_size=4)
TRANSFORM = np.array([[24.0, 0.0, -1.5], [0.0, -24.0, 1 / 3]])


def texture_of(trees: list[Tree]) -> Texture:
    return encode_packed(trees, [Root(f"shape {k}") for k in range(len(trees))], name="shapes")


def same(a: Tree, b: Tree) -> None:
    for field in FIELDS:
        x, y = getattr(a, field), getattr(b, field)
        assert x.dtype == y.dtype
        np.testing.assert_array_equal(x, y, field)


@settings(max_examples=40)
@given(FORESTS)
def test_decode_is_the_inverse_of_encode(trees: list[Tree]) -> None:
    texture = texture_of(trees)
    texture.check()
    for k, tree in enumerate(trees):
        found = decode(texture, k)
        same(found, tree)
        assert abs(found.coverage - tree.coverage).max() <= 0.5 / layout.COVERAGE_ONE + 1e-12
    again = encode_packed([decode(texture, root.name) for root in texture.roots], texture.roots, name="again")
    np.testing.assert_array_equal(again.texels, texture.texels)


def test_rows_of_a_large_texture() -> None:
    tree = chain(3)
    texture = encode_packed([tree] * 2000, [Root(str(k)) for k in range(2000)], name="many")
    assert texture.texels.shape == (3, 2048, 4)
    texture.check()
    assert texture.depth == 2
    same(decode(texture, 1999), tree)


def test_one_name_for_both_encodings() -> None:
    texture = encode(chain(2), to_source=TRANSFORM, name="delft", crs="EPSG:28992")
    root = texture.root("delft")
    assert (texture.name, root.crs) == ("delft", "EPSG:28992")
    np.testing.assert_array_equal(root.to_source, TRANSFORM)


def test_repr_is_one_short_line() -> None:
    assert repr(texture_of([chain(3)] * 2000)) == "<Texture 'shapes': 2048 x 3 texels, shapes: 2000>"


def test_what_cannot_be_encoded() -> None:
    with pytest.raises(LimitError, match="no shapes"):
        encode_packed([], [], name="nothing")
    with pytest.raises(FormatError, match="at least one root"):
        Texture(np.zeros((1, 1, 4), np.uint32), ())
    texture = encode(chain(1), to_source=np.full((2, 3), np.inf), name="x")
    with pytest.raises(LimitError, match="not finite"):
        texture.to_ktx2()
    texture = encode_packed([chain(1)], [Root("x" * (1 << 24))], name="x")
    with pytest.raises(LimitError, match="the limit is 16777216; use several textures"):
        texture.to_ktx2()


@pytest.mark.parametrize("shape", [(1, 3, 4), (2, 4, 4), (0, 2048, 4), (1, 4096, 4), (1, 4, 3), (4, 4)])
def test_arrays_of_other_shapes(shape: tuple[int, ...]) -> None:
    with pytest.raises(FormatError):
        Texture(np.zeros(shape, np.uint32), (Root("x"),))


def chain(quads: int) -> Tree:
    """Quads in each other's first cell; all other cells are empty."""
    is_quad = np.zeros((quads, 4), bool)
    is_quad[:-1, 0] = True
    zeros, first = np.zeros((quads, 4)), np.minimum(np.arange(quads) + 1, quads).astype(np.int32)
    none = np.zeros(quads, np.int32)
    curves = np.zeros((0, 4, 2), np.int32)
    return Tree(is_quad, zeros.astype(np.uint8), zeros.astype(np.int8), first, none, zeros, curves, 0.0, 0)


def leaf_pair() -> Texture:
    """A root (0) with a quad (1) and two leaves of one curve each (2, 3); quad 1 holds a leaf of two (4, 5)."""
    texels = np.zeros((1, 8, 4), np.uint32)
    texels[0, 0] = 1, 2, 0x0C_80_0C_00, 0
    texels[0, 1] = 9, 4, 0x00_00_00_14, 0xFF
    texels[0, 2:6] = 32768 << 16 | 32768
    return Texture(texels, (Root("a"), Root("the same", 0)))


def test_quads_and_curves_in_another_order() -> None:
    """What another writer lays out otherwise is the same tree."""
    texels, moved = leaf_pair().texels[0], np.zeros((1, 8, 4), np.uint32)
    texels[2:6, 1] = range(4)
    moved[0, [0, 1, 2, 5, 6, 7]] = texels[[0, 2, 3, 1, 4, 5]]
    moved[0, 0, :2], moved[0, 5, 1] = (5, 1), 6
    other = Texture(moved, (Root("a"),))
    other.check()
    same(decode(other), decode(Texture(texels[None], (Root("a"),))))


def test_another_reader_finds_the_roots(tmp_path) -> None:
    roots = [Root('"quoted"', to_source=TRANSFORM, crs="EPSG:4326", paint=Paint((0.0, 0.2, 1.0))), Root("形")]
    texture = encode_packed([chain(2), chain(3)], roots, name="two", source="two.svg")
    told = by_ktx_parse(texture.to_ktx2(), tmp_path)
    texts = {key: value.rstrip("\0") for key, value in told["texts"]}
    assert json.loads(texts.pop("vexture.roots")) == [
        {
            "name": '"quoted"',
            "quad": 0,
            "transform": [24, 0, -1.5, 0, -24, 1 / 3],
            "tolerance": 0,
            "crs": "EPSG:4326",
            "paint": {"color": [0, 0.2, 1], "opacity": 1},
        },
        {"name": "形", "quad": 2, "transform": [1, 0, 0, 0, 1, 0], "tolerance": 0},
    ]
    assert texts == {
        "KTXwriter": "vexture",
        "vexture.encoding": "packed",
        "vexture.version": "1",
        "vexture.name": "two",
        "vexture.source": "two.svg",
    }
    assert bytes.fromhex(told["texels"]) == texture.texels.tobytes()
