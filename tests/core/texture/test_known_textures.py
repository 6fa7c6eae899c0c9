"""Textures of one texel, their roots and their files."""

import re
from pathlib import Path

import numpy as np
import pytest

from vexture.base.errors import DeviceError, ParameterError
from vexture.drawing.paint import Paint
from vexture.texture.decode import decode
from vexture.texture.files import file_name, target_of, writable
from vexture.texture.ktx2 import read_ktx2, write_ktx2
from vexture.texture.outlines import outlines
from vexture.texture.plot import cells_of
from vexture.texture.root import Root, read_roots, roots_text
from vexture.texture.select_root import layers_of, place_of
from vexture.texture.svg_text import svg_document
from vexture.texture.texture import Texture

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


def test_a_full_cell_is_decoded() -> None:
    texels = np.array([[[0, 0, 0, 0xFF]]], np.uint32)
    np.testing.assert_allclose(decode(Texture(texels, (Root("a quarter"),))).coverage, [(1.0, 0.0, 0.0, 0.0)])


def test_file_names_of_drawings() -> None:
    assert file_name("../../etc/passwd") == "_.._etc_passwd"
    assert file_name("") == "drawing"
    assert file_name("kaart van Delft") == "kaart van Delft"


def test_a_packed_texture_goes_in_a_folder_or_to_the_path_itself() -> None:
    assert target_of("maps/", "delft") == Path("maps/delft.ktx2")
    assert target_of("maps/all.ktx2", "delft") == Path("maps/all.ktx2")


def test_a_folder_in_a_file_cannot_be_made() -> None:
    message = "/dev/null/report: cannot be written (/dev/null is no folder); choose another place"
    with pytest.raises(DeviceError, match=f"^{re.escape(message)}$"):
        writable(Path("/dev/null/report"))


def test_texts_of_a_ktx2_file_are_kept() -> None:
    data = write_ktx2(np.ones((1, 2, 4), np.uint32), {"KTXwriter": "an example"})
    assert read_ktx2(data, "ones")[1] == {"KTXwriter": "an example"}


def test_outline_of_full_cells_is_the_unit_square() -> None:
    full = np.array([[0, 0, 0, 0xFFFFFFFF]], np.uint32)
    np.testing.assert_allclose(outlines(full, 0)[0][:, 0], [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])


def test_the_first_cell_is_at_the_bottom_left() -> None:
    cells = cells_of(np.array([[0, 0, 0, 0xFF]], np.uint32), 0)
    np.testing.assert_allclose(cells[0], (0.0, 0.0, 0.5, 1.0, 1.0))


def test_text_of_a_root_is_compact() -> None:
    text = '[{"name":"agate","quad":5,"transform":[1,0,0,0,1,0],"tolerance":1e-06}]'
    assert roots_text((Root("agate", 5, tolerance=1e-6),)) == text


def test_a_root_is_read() -> None:
    text = '[{"name": "agate", "quad": 5, "transform": [1, 0, 0, 0, 1, 0], "tolerance": 0}]'
    assert read_roots(text)[0].quad == 5


def test_svg_document_of_an_empty_shape() -> None:
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -1 1 1">',
        "<title>an example</title>",
        '<path transform="scale(1 -1)" d=""><title>nothing</title></path>',
        "</svg>",
        "",
    ]
    assert svg_document([(Root("nothing"), [])], "an example") == "\n".join(lines)
