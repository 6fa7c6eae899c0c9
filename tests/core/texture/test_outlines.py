"""For those who bring their own renderer: points inside, and outlines back as SVG."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import corpora
import degenerate
from both_encodings import encode
from strategies import packed_trees
from vexture import read_svg
from vexture.base.errors import VextureError
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing
from vexture.drawing.drawing import Path as Outline
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact
from vexture.texture.encode import encode as encode_packed
from vexture.texture.outlines import outlines, svg_document
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.build import build_tree
from vexture.tree.tree import Tree

SIZE = (128, 128)
ONE_LEVEL = 1 / 255
CLEAR = 1e-4  # unit-square units: chords of the brute force, rounding to leaves of half the square

T_JUNCTIONS = (155, 157, 277, 300, 322, 331, 339, 356, 365)
SEEDS = [*range(40), *T_JUNCTIONS]  # in these, pieces end on others
SQUARE = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])


def converted(drawing: Drawing) -> Texture:
    return encode(build_tree(drawing), to_source=drawing.to_source, name=drawing.name)


def back(texture: Texture, folder: Path) -> Drawing:
    path = folder / "back.svg"
    path.write_text(texture.to_svg(), encoding="utf-8")
    return read_svg(path)


def letters() -> list[Drawing]:
    try:
        return corpora.glyphs(corpora.dejavu_sans(), "agR&8@")
    except VextureError as error:
        pytest.skip(str(error))


def icons() -> list[Drawing]:
    try:
        return [read_svg(path) for path in corpora.mdi(4, seed=3) + corpora.simple_icons(4, seed=3)]
    except VextureError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("drawings", [letters, icons])
def test_svg_of_real_drawings(tmp_path: Path, drawings) -> None:
    for drawing in drawings():
        found = back(converted(drawing), tmp_path)
        assert abs(render_exact(found, SIZE) - render_exact(drawing, SIZE)).max() < ONE_LEVEL
        at = drawing.to_source @ (0.3, 0.6, 1.0)
        upwards = np.linalg.det(drawing.to_source[:, :2]) > 0.0  # fonts are drawn upwards, and turned in the document
        np.testing.assert_allclose(found.to_source @ (0.3, 0.6, 1.0), at * (1, -1) if upwards else at, atol=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_svg_of_degenerate_drawings(tmp_path: Path, seed: int) -> None:
    drawing = degenerate.drawing(seed)
    texture = converted(drawing)
    closed = Drawing((Outline(tuple(outlines(texture.flat, 0))),))
    expected = render_exact(drawing, SIZE)
    assert abs(render_exact(closed, SIZE) - expected).max() < ONE_LEVEL
    if expected.any():  # an empty document has nothing to warn of but its emptiness
        assert abs(render_exact(back(texture, tmp_path), SIZE) - expected).max() < ONE_LEVEL


def with_lines(tree: Tree) -> Tree:
    """Tree whose pieces are straight."""
    lines = np.rint(line_cubics(*np.moveaxis(tree.curves[:, [0, 3]].astype(float), 1, 0)))
    return replace(tree, curves=lines.astype(np.int32))


@settings(max_examples=40)
@given(packed_trees(max_depth=2, max_quads=4).map(with_lines), st.integers(0, 2**32))
def test_outlines_are_closed_and_wind_as_the_leaves_say(tree: Tree, seed: int) -> None:
    """Even where pieces and corner windings are random, so that windings are anything."""
    texture = encode(tree, to_source=np.eye(2, 3), name="x")
    points = np.random.default_rng(seed).random((200, 2))
    closed = Drawing((Outline(tuple(outlines(texture.flat, 0))),))
    (windings,), distance = degenerate.path_windings(closed, points, chords=1)
    clear = distance > CLEAR
    np.testing.assert_array_equal(texture.contains(points)[clear], windings[clear] > 0)


def painted() -> Texture:
    to_source = np.array([[20.0, 0.0, 3.0], [0.0, -20.0, 25.0]])
    triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    roots = [
        Root("<back> & \0", to_source=to_source, paint=Paint((0.0, 51 / 255, 1.0))),
        Root("front", to_source=to_source, paint=Paint((0.3, 0.55555, 1.0), 0.25)),
        Root("outline", to_source=to_source),
    ]
    return encode_packed([build_tree(SQUARE), build_tree(triangle), build_tree(triangle)], roots, name='a "b"')


def test_layers_keep_their_paint(tmp_path: Path) -> None:
    texture = painted()
    found = back(texture, tmp_path)
    assert [path.paint.opacity for path in found.paths] == [1.0, 0.25, 1.0]
    colors = [path.paint.color for path in found.paths]
    np.testing.assert_allclose(colors, [(0.0, 0.2, 1.0), (0.3, 0.55555, 1.0), (0.0, 0.0, 0.0)], atol=1e-9)
    np.testing.assert_array_equal(found.to_source, texture.roots[0].to_source)


def test_the_document_as_text() -> None:
    text = painted().to_svg(0)
    assert text.splitlines() == [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="3 5 20 20">',
        '<title>a "b"</title>',
        '<path fill="#0033ff" d="M8 20L18 20L18 10L8 10Z"><title>&lt;back&gt; &amp; \ufffd</title></path>',
        "</svg>",
    ]


def test_one_shape_of_many() -> None:
    texture = painted()
    assert texture.to_svg("front") == texture.to_svg(1) != texture.to_svg(0)
    assert texture.to_svg().count("<path ") == 3
    assert texture.to_svg("front").count("<path ") == 1


def test_nothing_at_all() -> None:
    texture = Texture(np.zeros((1, 1, 4), np.uint32), (Root("x"),))
    assert outlines(texture.flat, 0) == []
    assert 'd=""' in texture.to_svg()


def test_outline_of_full_cells_is_the_unit_square() -> None:
    full = np.array([[0, 0, 0, 0xFFFFFFFF]], np.uint32)
    np.testing.assert_allclose(outlines(full, 0)[0][:, 0], [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])


def test_svg_document_of_an_empty_shape() -> None:
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -1 1 1">',
        "<title>an example</title>",
        '<path transform="scale(1 -1)" d=""><title>nothing</title></path>',
        "</svg>",
        "",
    ]
    assert svg_document([(Root("nothing"), [])], "an example") == "\n".join(lines)
