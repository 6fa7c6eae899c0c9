"""The text of the thesis's shaders: its numbers, and the sizes of the texture that it draws."""

import re

import pytest
from hand import EMPTY, FULL, TREE, texture_of

from vexture.base.errors import FormatError
from vexture.thesis import layout, method
from vexture.thesis.shader_text import TextureSizes, constants, view_source


@pytest.mark.parametrize("module", [layout, method])
def test_the_numbers_are_pythons(module: object) -> None:
    text = constants(module)  # type: ignore[arg-type]
    for kind, name, value in re.findall(r"^const (int|float) (\w+) = (.*);$", text, re.MULTILINE):
        assert {"int": int, "float": float}[kind](value) == getattr(module, name)
    assert "const int CELL_ORDER[4]" in constants(layout)
    assert "const float CONTROL_MIN = -1.25;" in constants(layout)
    assert "const int SAMPLES = 4;" in constants(method)


def test_the_bounds_of_the_loops_are_the_textures() -> None:
    assert TextureSizes.of_texture(texture_of([FULL, EMPTY, FULL, EMPTY])).levels == 1
    assert TextureSizes.of_texture(texture_of(TREE)).levels == 3
    assert "const int LEVELS = 3;\nconst int FOLD_HEIGHT = 100;\n" in view_source(
        "330", TextureSizes.of_texture(texture_of(TREE), 100)
    )


def test_a_quad_below_itself_is_refused() -> None:
    texture = texture_of([[FULL] * 4, FULL, FULL, FULL])
    texture.quads[1, 0] = 65535, 0, 0
    with pytest.raises(FormatError, match="below itself"):
        TextureSizes.of_texture(texture)
