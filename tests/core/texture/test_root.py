"""Roots as text, and back."""

import json
import zlib

import pytest
from test_restyle import faces

import vexture
from degenerate import polygon
from vexture.base.errors import FormatError
from vexture.base.layout import MOST_STYLE_BYTES, TEXT_ROOTS, TEXT_STYLES
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.texture.ktx2 import read_value, write_ktx2
from vexture.texture.load import texture_from
from vexture.texture.root import Root, read_roots, roots_text


def test_text_of_a_root_is_compact() -> None:
    text = '[{"name":"agate","quad":5,"transform":[1,0,0,0,1,0],"tolerance":1e-06}]'
    assert roots_text((Root("agate", 5, tolerance=1e-6),)) == text


def test_a_root_is_read() -> None:
    text = '[{"name": "agate", "quad": 5, "transform": [1, 0, 0, 0, 1, 0], "tolerance": 0}]'
    assert read_roots(text)[0].quad == 5


RED = Paint((1.0, 0.0, 0.0))
SQUARE = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
STYLE = {"elements": [{"name": "a", "color": [1, 0, 0]}], "groups": [], "stacks": [[], [0]]}
GROUP = {"outer": -1, "opacity": 1, "blend": "normal"}


@pytest.mark.parametrize(
    ("style", "message"),
    [
        (7, "style is 7; it must be an object"),
        ({}, "elements is None; it must be a list"),
        (STYLE | {"elements": [{"color": [1, 0, 0]}]}, "it must be an object with a name"),
        (STYLE | {"elements": [{"name": "a", "color": [1, 0, 2]}]}, "its numbers must be in 0..1"),
        (STYLE | {"elements": [{"name": "a", "color": [1, 0, 0], "group": 0}]}, "a path is in group 0, of 0"),
        (STYLE | {"elements": [{"name": "a", "color": [1, 0, 0], "hides": 1}]}, "hides is a truth"),
        (STYLE | {"groups": [GROUP | {"blend": "glow"}]}, "it must be an object with outer and blend"),
        (STYLE | {"groups": [GROUP | {"outer": k - 1} for k in range(101)]}, "groups are 101 deep; the limit of"),
        (STYLE | {"groups": [GROUP | {"outer": 3}]}, "group 0 lies in group 3, which is not before it"),
        (STYLE | {"groups": [GROUP | {"opacity": 2}]}, "a group has opacity 2; it must be in 0..1"),
        (STYLE | {"stacks": [[], [1]]}, "a stack names none of 1 element;"),
        (STYLE | {"stacks": [[], [0.0]]}, "a stack names none of 1 element;"),
        (STYLE | {"stacks": [[], 0]}, "a stack is 0; it must be a list"),
        (STYLE | {"stacks": [[]]}, "has 2 paints, and stacks of 1"),
    ],
)
def test_a_style_that_breaks_the_format_is_refused_in_a_line(style, message: str) -> None:
    texture = faces(Drawing((Path((SQUARE,), paint=RED, element="a"),)))
    texts = texture.texts()
    roots = json.loads(texts[TEXT_ROOTS])
    assert {key: roots[0]["style"][key] for key in STYLE} == STYLE
    roots[0]["style"] = style
    with pytest.raises(FormatError) as error:
        texture_from(write_ktx2(texture.texels, texts | {TEXT_ROOTS: json.dumps(roots)}, True), "broken")
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def crowd(count: int) -> vexture.Texture:
    squares = [
        polygon([(k / count, 0), ((k + 1) / count, 0), ((k + 1) / count, 1), (k / count, 1)]) for k in range(count)
    ]
    return faces(Drawing(tuple(Path((square,), paint=RED, element=f"parcel {k}") for k, square in enumerate(squares))))


def test_long_styles_are_deflated_and_read() -> None:
    texture = crowd(60)
    data, plain = texture.to_ktx2(), texture.to_ktx2(deflate=False)
    assert read_value(plain, TEXT_STYLES) is None
    assert read_value(crowd(2).to_ktx2(), TEXT_STYLES) is None
    deflated = read_value(data, TEXT_STYLES)
    assert deflated is not None
    assert len(deflated) < len(texture.texts()[TEXT_ROOTS]) / 5
    for other in (texture_from(data, "deflated"), texture_from(plain, "plain")):
        assert other.texts() == texture.texts()
        assert other.element_at([(0.51, 0.5)]).name.tolist() == ["parcel 30"]


@pytest.mark.parametrize(
    ("length", "stored", "message"),
    [
        (0, b"", "vexture.styles says that it has 0 bytes; the limit is"),
        (MOST_STYLE_BYTES + 1, zlib.compress(b"[null]"), "vexture.styles says that it has 67108865 bytes"),
        (MOST_STYLE_BYTES, zlib.compress(b"[null]"), "14 bytes of styles; they cannot inflate to 67108864"),
        (7, zlib.compress(b"[null]"), "vexture.styles has 6 bytes and says 7"),
        (5, zlib.compress(b"[null]"), "vexture.styles has 6 bytes and says 5"),
        (6, b"[null]", "the styles cannot be inflated"),
        (6, zlib.compress(b"[null]") + b"\0", "the 15 bytes of styles do not end where they should"),
        (1, zlib.compress(b"["), "vexture.styles is not JSON"),
        (2, zlib.compress(b"[]"), "vexture.styles is no list of one style for each of 1 roots"),
        (4, zlib.compress(b"[{}]"), "elements is None; it must be a list"),
    ],
)
def test_deflated_styles_that_break_the_format_are_refused_in_a_line(length: int, stored: bytes, message: str) -> None:
    texture = crowd(2)
    texts = texture.texts() | {TEXT_STYLES: length.to_bytes(4, "little") + stored}
    with pytest.raises(FormatError) as error:
        texture_from(write_ktx2(texture.texels, texts, True), "broken")
    assert message in str(error.value)
    assert "\n" not in str(error.value)
