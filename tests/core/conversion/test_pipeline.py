"""Conversion with its parameters: packed by default, split by paint, parts of drawings, many shapes in one texture."""

from dataclasses import replace
from pathlib import Path as File
from typing import Any

import numpy as np
import pytest

import vexture
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.tolerance import UNSEEN
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run, run_encoding
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Group
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode
from vexture.texture.load import texture_from
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture.tree.build import build_tree

RED, GLASS = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0), 0.5)
LOGO = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><rect width="20" height="10" fill="#00f"/>'
    '<path id="word" d="M2 2C4 9 9 2 9 8L3 9z" fill="white"/><circle cx="14" cy="5" r="3" fill="red"/></svg>'
)


def star(points: int, name: str, paint: Paint = RED) -> Drawing:
    """Star polygon, which crosses itself."""
    angles = np.arange(points) * (2.0 * np.pi * (points // 2) / points)
    drawing = Drawing.polygon(list(zip(0.5 + 0.4 * np.cos(angles), 0.5 + 0.4 * np.sin(angles), strict=True)))
    return Drawing((replace(drawing.paths[0], paint=paint),), name=name)


def texels_of(drawing: Drawing, **parameters: float) -> np.ndarray:
    return encode([build_tree(drawing, **parameters)], [Root("")], name="").texels


def contours() -> tuple[np.ndarray, ...]:
    return star(5, "").paths[0].contours


@pytest.fixture
def logo(tmp_path: File) -> File:
    file = tmp_path / "logo.svg"
    file.write_text(LOGO)
    return file


def test_packed_is_the_default(logo: File) -> None:
    texture = vexture.convert(logo, split=None)
    drawing = vexture.read_svg(logo)
    assert isinstance(texture, Texture)
    np.testing.assert_array_equal(texture.texels, texels_of(drawing, tolerance=UNSEEN))
    (root,) = texture.roots
    assert (root.name, root.tolerance, root.paint, texture.name, texture.source) == (
        "logo",
        UNSEEN,
        None,
        "logo",
        "logo.svg",
    )
    np.testing.assert_array_equal(root.to_source, drawing.to_source)
    assert isinstance(vexture.convert(logo, encoding="thesis"), ThesisTexture)


def test_split_makes_a_root_of_each_layer(logo: File) -> None:
    texture = vexture.convert(logo, split="paint")
    layers = vexture.read_svg(logo).layers()
    assert [root.name for root in texture.roots] == ["logo/1-#0000ff", "logo/2-#ffffff", "logo/3-#ff0000"]
    assert [root.paint for root in texture.roots] == [layer.paths[0].paint for layer in layers]
    assert all((root.to_source == layers[0].to_source).all() for root in texture.roots)
    trees = [build_tree(layer, tolerance=UNSEEN) for layer in layers]
    np.testing.assert_array_equal(texture.texels, encode(trees, texture.roots, name="").texels)
    assert texture.name == "logo"


def test_split_of_nothing_is_one_empty_root() -> None:
    texture = vexture.convert(Drawing((), name="nothing"), split="paint")
    assert [(root.name, root.paint) for root in texture.roots] == [("nothing", None)]
    assert not texture.texels[0, 0, 2:].any()


def test_split_keeps_translucent_paths_apart() -> None:
    drawing = Drawing((Path(contours(), paint=GLASS), Path(contours(), paint=GLASS)), name="glass")
    assert [root.paint for root in vexture.convert(drawing, split="paint").roots] == [GLASS, GLASS]


@pytest.mark.parametrize("encoding", ["packed", "thesis"])
def test_select_converts_a_part_where_it_is(logo: File, encoding: str) -> None:
    def part_of(select: str) -> Any:
        if encoding == "packed":
            return run(logo, Parameters(select=select))
        return run_encoding(logo, encoding, select=select)

    part = part_of("#word")
    assert part.drawing.segments == 3
    np.testing.assert_array_equal(part.drawing.to_source, vexture.read_svg(logo).to_source)
    with pytest.raises(LimitError, match=r"logo.svg: `select` '#none' matches no element"):
        part_of("#none")


def test_conversion_keeps_what_lies_between(logo: File) -> None:
    split = run(logo, Parameters("paint"))
    assert (len(split.trees), split.drawing.name) == (3, "logo")
    assert split.tree is split.trees[0]
    assert split.seconds > 0.0
    thesis = run_encoding(logo, "thesis")
    assert thesis.trees == (thesis.tree,)
    assert len(thesis.texture.quads) == len(thesis.tree.kind)


@pytest.mark.parametrize("capacity", [4, 1])
def test_widest_leaf(capacity: int) -> None:
    """Found by walking every leaf of the tree from the root."""
    tree = build_tree(star(7, "star"), capacity=capacity)
    widths, stack = [0.0], [(0, 0.5)]
    while stack:
        quad, width = stack.pop()
        widths += [width] * bool(tree.count[quad].any())
        first = tree.first_quad[quad]
        stack += [(first + k, width / 2) for k in range(tree.is_quad[quad].sum())]
    assert tree.widest_leaf == max(widths) > 0.0
    assert build_tree(Drawing(())).widest_leaf == 0.0


def test_colours_are_kept_and_one_colour_is_a_silhouette(logo: File) -> None:
    five = star(5, "five", GLASS)
    texture = vexture.convert(logo)
    np.testing.assert_array_equal(texture.texels, vexture.convert(logo, split="faces").texels)
    assert [(root.name, root.is_map) for root in texture.roots] == [("logo", True)]
    both = vexture.atlas([logo, five])
    assert [(root.name, root.is_map, root.paint) for root in both.roots] == [
        ("logo", True, None),
        ("five", False, GLASS),
    ]
    alone, uncoloured = vexture.convert(five), vexture.convert(five, split=None)
    np.testing.assert_array_equal(alone.texels, uncoloured.texels)
    assert [texture.roots[0].paint for texture in (alone, uncoloured)] == [GLASS, None]
    np.testing.assert_array_equal(texture_from(alone.to_ktx2(), "five").render(9), vexture.render(five, 9))
    overlapping = replace(five, paths=(*five.paths, *star(7, "seven", GLASS).paths))
    assert vexture.convert(overlapping).roots[0].is_map, "it is twice as dark where it overlaps itself"
    grouped = replace(five, groups=(Group(-1, 0.5),), paths=tuple(replace(path, group=0) for path in five.paths))
    assert vexture.convert(grouped).roots[0].is_map
    assert not vexture.convert(Drawing(())).roots[0].is_map


def test_atlas_holds_each_drawing_as_it_is_alone(logo: File) -> None:
    drawings = [star(5, "five"), vexture.read_svg(logo), star(11, "eleven")]
    texture = vexture.atlas([drawings[0], logo, drawings[2]], name="signs", capacity=3, split=None)
    assert [root.name for root in texture.roots] == ["five", "logo", "eleven"]
    assert (texture.name, texture.source) == ("signs", None)
    trees = [build_tree(drawing, capacity=3) for drawing in drawings]
    np.testing.assert_array_equal(texture.texels, encode(trees, texture.roots, name="").texels)
    assert [root.quad for root in texture.roots] == np.cumsum(
        [0, *(len(tree.count) + len(tree.curves) for tree in trees[:2])]
    ).tolist()


def test_atlas_of_layers(logo: File) -> None:
    texture = vexture.atlas([logo, star(5, "star", GLASS)], split="paint")
    names = ["logo/1-#0000ff", "logo/2-#ffffff", "logo/3-#ff0000", "star/1-#0000ff80"]
    assert [root.name for root in texture.roots] == names
    assert texture.roots[3].paint == GLASS


@pytest.mark.parametrize("sources", [lambda file: file, str, lambda file: iter([file]), vexture.read_svg])
def test_atlas_of_one(logo: File, sources: object) -> None:
    assert [root.name for root in vexture.atlas(sources(logo)).roots] == ["logo"]  # type: ignore[operator]


def test_two_shapes_of_one_name_are_not_mixed_up(logo: File, tmp_path: File) -> None:
    (tmp_path / "b").mkdir()
    twin = tmp_path / "b" / "logo.svgz"
    twin.write_text(LOGO)
    for split in (None, "paint"):
        with pytest.raises(ParameterError, match="rename one") as caught:
            vexture.atlas([logo, twin], split=split)
        assert str(caught.value).startswith(f"{twin}: ")
        assert str(logo) in str(caught.value)
    with pytest.raises(ParameterError, match="'drawing' already"):
        vexture.atlas([star(5, "drawing"), star(7, "drawing")])


def test_a_bad_source_is_named(logo: File, tmp_path: File) -> None:
    bad = tmp_path / "bad.svg"
    bad.write_text("no svg")
    with pytest.raises(SourceError, match=r"bad\.svg: holds nothing that can be read"):
        vexture.atlas([logo, bad])
    with pytest.raises(SourceError, match=r"gone\.svg: cannot be read"):
        vexture.atlas([logo, tmp_path / "gone.svg"])
    with pytest.raises(ParameterError, match="no drawings"):
        vexture.atlas([])
