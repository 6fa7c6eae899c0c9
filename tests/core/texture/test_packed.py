"""Trees to packed textures and back; what a texture says of itself; texels from strangers."""

import json
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_ktx2 import by_ktx_parse

from both_encodings import decode, encode, info
from strategies import packed_trees
from vexture.base import layout
from vexture.base.errors import FormatError, LimitError, ParameterError
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


@given(packed_trees())
def test_depth(tree: Tree) -> None:
    depth = np.zeros(len(tree.count), int)
    for quad, cell in np.argwhere(tree.is_quad):
        depth[tree.first_quad[quad] + tree.is_quad[quad, :cell].sum()] = depth[quad] + 1
    texture = encode(tree, to_source=TRANSFORM, name="x")
    assert texture.depth == info(texture)["depth"] == info(texture)["roots"][0]["depth"] == depth.max()


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


def test_roots_by_name_and_place() -> None:
    texture = encode_packed([chain(1)] * 3, [Root("arrow-up"), Root("arrow-down"), Root("zebra")], name="icons")
    assert texture.root("zebra").quad == texture.root(2).quad == 2
    with pytest.raises(ParameterError, match=r"icons: no shape 'arow-up'; near names are 'arrow-up'; there are 3"):
        texture.root("arow-up")
    for place in (3, -1):
        with pytest.raises(ParameterError, match=rf"no shape {place}; they are numbered 0 to 2"):
            texture.root(place)


@pytest.mark.parametrize("root", [True, 1.0, 0.5, [0]])
def test_a_root_of_another_type_is_refused(root: object) -> None:
    texture = texture_of([chain(1)] * 2)
    for ask in (texture.root, texture.coverage, texture.render):
        with pytest.raises(TypeError, match=r"shapes: `root` is .*; it must be a name or a whole number"):
            ask(root) if ask == texture.root else ask(8, root=root)


def test_repr_is_one_short_line() -> None:
    assert repr(texture_of([chain(3)] * 2000)) == "<Texture 'shapes': 2048 x 3 texels, shapes: 2000>"


def test_points_that_are_none_or_no_numbers() -> None:
    texture = texture_of([chain(1)])
    found = texture.contains(np.zeros((0, 2)), root=0)
    assert (found.shape, found.dtype) == ((0,), bool)
    for points in ("x", [("a", "b")], [(1, 2), (3,)]):
        with pytest.raises(ParameterError, match="`points` is no array of numbers"):
            texture.contains(points)


def test_info_is_json() -> None:
    roots = [Root("a", to_source=TRANSFORM, crs="EPSG:4326", tolerance=1e-4, paint=Paint((1.0, 0.5, 0.0), 0.25))]
    told = json.loads(json.dumps(info(encode_packed([chain(2)], roots, name="n", source="a.svg"))))
    assert (told["encoding"], told["version"], told["name"], told["source"]) == ("packed", "1", "n", "a.svg")
    assert told["bytes"] == 16 * told["width"] * told["height"]
    (root,) = told["roots"]
    assert root["paint"] == {"color": [1.0, 0.5, 0.0], "opacity": 0.25}
    assert (root["transform"], root["crs"], root["tolerance"]) == (TRANSFORM.tolist(), "EPSG:4326", 1e-4)


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


def put(texel: int, word: int, value: int) -> Callable[[Texture], None]:
    return lambda texture: texture.texels[0].__setitem__((texel, word), value)


FAULTS: dict[str, tuple[Callable[[Texture], None], str]] = {
    "a quad is itself": (put(0, 0, 0), "quad 0 has 1 quads from texel 0; they must lie after it"),
    "a quad beyond": (put(0, 0, 8), "quad 0 has 1 quads from texel 8"),
    "a quad far beyond": (put(0, 0, 2**32 - 1), "quad 0 has 1 quads from texel 4294967295"),
    "a quad is a curve": (put(0, 0, 2), "texel 2 is referred to twice"),
    "curves beyond": (put(1, 1, 7), "quad 1 has 2 curves from texel 7"),
    "curves before": (put(1, 1, 0), "quad 1 has 2 curves from texel 0"),
    "curves shared": (put(1, 1, 3), "texel 3 is referred to twice"),
    "a quad with a count": (put(0, 2, 0x0C_88_0C_00), "quad 0, cell 2 is 136, which is no valid cell"),
    "a constant with a winding": (put(1, 2, 0x04_00_00_14), "quad 1, cell 3 is 4"),
    "curves without a winding": (put(1, 2, 0x00_00_00_10), "quad 1, cell 0 is 16"),
    "an end beyond": (put(4, 0, 32769), "curve 4 has an end at 32769; the limit is 32768"),
    "an end above": (put(5, 3, 40000 << 16), "curve 5 has an end at 40000"),
    "padding": (put(7, 3, 1), "texel 7 belongs to no root and is not 0"),
    "a lost curve": (put(1, 2, 0x00_00_00_0C), "texel 5 belongs to no root"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults_of_the_texels(name: str) -> None:
    texture = leaf_pair()
    texture.check()
    change, expected = FAULTS[name]
    change(texture)
    with pytest.raises(FormatError) as caught:
        texture.check()
    assert expected in str(caught.value)
    assert str(caught.value).endswith("convert the drawing again")


def test_a_root_inside_another_or_beyond() -> None:
    texture = leaf_pair()
    for quad, expected in ((1, "texel 1 is referred to twice"), (8, "a root is quad 8 of 8 texels")):
        with pytest.raises(FormatError, match=expected):
            Texture(texture.texels, (Root("a"), Root("b", quad))).check()


def test_quads_of_one_depth_that_share() -> None:
    texels = np.zeros((1, 4, 4), np.uint32)
    texels[0, :3] = (1, 0, 0x80_80, 0), (0, 3, 0x0C, 0), (0, 3, 0x0C, 0)
    with pytest.raises(FormatError, match="texel 3 is referred to twice, as a curve now"):
        Texture(texels, (Root("a"),)).check()


def test_the_depth_limit() -> None:
    texture_of([chain(layout.MOST_DEPTH)]).check()
    with pytest.raises(FormatError, match="lies at depth 20; the limit is 19"):
        texture_of([chain(layout.MOST_DEPTH + 1)]).check()


def test_quads_and_curves_in_another_order() -> None:
    """What another writer lays out otherwise is the same tree."""
    texels, moved = leaf_pair().texels[0], np.zeros((1, 8, 4), np.uint32)
    texels[2:6, 1] = range(4)
    moved[0, [0, 1, 2, 5, 6, 7]] = texels[[0, 2, 3, 1, 4, 5]]
    moved[0, 0, :2], moved[0, 5, 1] = (5, 1), 6
    other = Texture(moved, (Root("a"),))
    other.check()
    same(decode(other), decode(Texture(texels[None], (Root("a"),))))


@given(st.integers(0, 2**32), st.integers(1, 64))
def test_random_texels_are_refused_or_a_tree(seed: int, roots: int) -> None:
    random = np.random.default_rng(seed)
    texels = random.integers(0, 2**32, (1, 64, 4), np.uint32)
    texels[:, :, :2] %= 80
    texels[:, :, 2] = random.choice(np.array([0, 0x80, 0x0C00, 0x80_00_14_00], np.uint32), (1, 64))
    texture = Texture(texels, tuple(Root(str(k), k) for k in range(roots)))
    try:
        texture.check()
    except FormatError:
        return
    for k in range(roots):
        decode(texture, k)


def test_200000_texels_are_checked_by_arrays() -> None:
    tree = chain(16)
    texture = encode_packed([tree] * 12_500, [Root("x")] * 12_500, name="many")
    texture.check()
    texture.texels[-1, 0, 0] = 7
    assert len(texture.flat) >= 200_000


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
