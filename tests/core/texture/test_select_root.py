"""Shapes and layers that `root` selects, and lines about those that there are not."""

import re

import pytest
from test_texture_encode import chain, texture_of

from vexture.base.errors import ParameterError
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode as encode_packed
from vexture.texture.root import Root
from vexture.texture.select_root import layers_of, place_of

SHAPES = [Root("anchor"), Root("apple")]


def test_a_shape_is_found_by_its_name() -> None:
    assert place_of(SHAPES, "apple") == 1


def test_of_several_shapes_one_is_to_be_chosen() -> None:
    message = "texture holds 2 shapes (anchor, apple); choose one by `root`"
    with pytest.raises(ParameterError, match=f"^{re.escape(message)}$"):
        place_of(SHAPES, None)


def test_an_unknown_name_is_answered_with_those_there_are() -> None:
    message = "texture: no shape 'anker'; there are 'anchor', 'apple'"
    with pytest.raises(ParameterError, match=f"^{re.escape(message)}$"):
        place_of(SHAPES, "anker")


def test_layers_of_a_drawing_and_one_layer() -> None:
    logo = [Root("logo/1", paint=Paint()), Root("logo/2", paint=Paint((1.0, 0.0, 0.0)))]
    assert layers_of(logo, None) == [0, 1]
    assert layers_of([*logo, Root("map")], "logo") == [0, 1]
    assert layers_of(logo, "logo/2") == [1]


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
