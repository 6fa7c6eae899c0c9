"""The scene of a drawing: uses, and elements in one another."""

import warnings

import numpy as np
import pytest

import vexture
from vexture.base.errors import SourceError, SourceWarning


@pytest.mark.slow  # as the file use-bomb.svg is
def test_uses_that_show_one_another_too_often_are_an_error() -> None:
    names = "abcdefghij"
    groups = "".join(f'<g id="{a}">' + "".join(f'<use href="#{b}"/>' for b in names) + "</g>" for a in names)
    with pytest.raises(SourceError, match="<use> shows more than 50,000 elements"):
        vexture.read(f"<svg>{groups}</svg>".encode(), name="a.svg")


def drawn(body: str) -> vexture.Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
        return vexture.read(f"{root}{body}</svg>".encode(), name="a.svg")


def boxes(drawing: vexture.Drawing) -> list[list[float]]:
    """Left, top, right and bottom of each path, in user units."""
    sides = (path.box.ravel() * 100.0 for path in drawing.paths)
    return [np.round((left, 100 - high, right, 100 - low), 6).tolist() for left, low, right, high in sides]


SQUARE = '<rect id="r" width="10" height="10"/>'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (f'<defs>{SQUARE}</defs><use href="#r" x="5" y="7"/>', [[5, 7, 15, 17]]),
        (f'<defs>{SQUARE}</defs><use href="#r" x="5" transform="scale(2)"/>', [[10, 0, 30, 20]]),
        (f'{SQUARE}<g transform="translate(20)"><use href="#r"/></g>', [[0, 0, 10, 10], [20, 0, 30, 10]]),
        (
            f'<symbol id="s" viewBox="0 0 10 10">{SQUARE}</symbol><use href="#s" x="50" width="20" height="40"/>',
            [[50, 10, 70, 30]],
        ),
        (f'<svg x="20" y="30" width="5" height="50">{SQUARE}</svg>', [[20, 30, 25, 40]]),
        (f'<svg x="20" width="5" height="50" overflow="visible">{SQUARE}</svg>', [[20, 0, 30, 10]]),
        (f'<svg width="50" height="20" viewBox="0 0 10 10">{SQUARE}</svg>', [[15, 0, 35, 20]]),
    ],
)
def test_elements_stand_where_uses_and_viewports_put_them(body: str, expected: list[list[float]]) -> None:
    assert boxes(drawn(body)) == expected


def test_a_switch_shows_the_first_child_whose_conditions_hold() -> None:
    children = [
        '<rect systemLanguage="de" width="1" height="9"/>',
        '<rect requiredExtensions="urn:x" width="2" height="9"/>',
        '<rect systemLanguage="fr, en-GB" width="3" height="9"/>',
        '<rect width="4" height="9"/>',
    ]
    assert boxes(drawn(f"<switch>{''.join(children)}</switch>")) == [[0, 0, 3, 9]]


def test_properties_of_a_use_are_inherited_by_what_it_shows() -> None:
    drawing = drawn(f'<defs fill="red">{SQUARE}</defs><use href="#r" fill="blue"/>')
    assert [path.paint.hex for path in drawing.paths] == ["#0000ff"]


def test_elements_that_are_only_referred_to_paint_nothing() -> None:
    parts = ("defs", "symbol", "clipPath", "mask", "marker", "pattern", "linearGradient")
    assert drawn("".join(f"<{part}>{SQUARE}</{part}>" for part in parts)).paths == ()
