"""Transforms in space, seen straight from above: against products of matrices that NumPy makes."""

from math import cos, radians, sin

import numpy as np
import pytest

from vexture.svg.spatial import Attribute, css_transform, element_transform, property_transform, rotation, to_plane
from vexture.svg.transform import Identity, Transform
from vexture.svg.values import Viewport

LENGTH = Viewport(200.0, 100.0).along(16.0)
C, S = cos(radians(30)), sin(radians(30))


def plane(text: str) -> Transform | None:
    found = css_transform(text, LENGTH)
    return None if found is None else to_plane(found)[0]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("translate(10%, 10%)", (1, 0, 0, 1, 20, 10)),
        ("translate(3px) scale(2, 50%)", (2, 0, 0, 0.5, 3, 0)),
        ("rotate(30deg)", (C, S, -S, C, 0, 0)),
        ("rotateZ(30deg)", (C, S, -S, C, 0, 0)),
        ("rotateX(30deg)", (1, 0, 0, C, 0, 0)),
        ("rotateY(30deg)", (C, 0, 0, 1, 0, 0)),
        ("rotateX(90deg) rotateX(-90deg)", (1, 0, 0, 1, 0, 0)),
        ("rotateY(90deg) translateZ(5px)", (0, 0, 0, 1, 5, 0)),
        ("rotate3d(0, 0, 7, 30deg)", (C, S, -S, C, 0, 0)),
        ("rotate3d(0, 0, 0, 30deg)", (1, 0, 0, 1, 0, 0)),
        ("scale3d(2, 3, 4)", (2, 0, 0, 3, 0, 0)),
        ("matrix3d(1,2,0,0, 3,4,0,0, 0,0,1,0, 5,6,0,1)", (1, 2, 3, 4, 5, 6)),
        ("skewX(45deg)", (1, 0, 1, 1, 0, 0)),
        ("none", (1, 0, 0, 1, 0, 0)),
    ],
)
def test_functions_are_those_of_the_standard(text: str, expected: tuple[float, ...]) -> None:
    assert plane(text) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    ["translate(3)", "rotate(30)", "scale(2px)", "melt(3)", "matrix3d(1)", "rotate3d(1, 2, 3)", "red", "scale(1) x"],
)
def test_what_is_not_valid_is_none(text: str) -> None:
    assert plane(text) is None


@pytest.mark.parametrize("seed", range(5))
def test_turns_about_any_axis_keep_it_and_have_their_angle(seed: int) -> None:
    x, y, z, turn = np.random.default_rng(seed).uniform(-3, 3, 4)
    matrix = rotation(x, y, z, turn)[:3, :3]
    np.testing.assert_allclose(matrix @ (x, y, z), (x, y, z), atol=1e-12)
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(matrix) == pytest.approx(1.0)
    assert np.trace(matrix) == pytest.approx(1.0 + 2.0 * cos(turn))
    across = np.cross((x, y, z), (1.0, 0.0, 0.0))
    assert np.cross(across, matrix @ across) @ (x, y, z) * np.sign(sin(turn)) > 0.0


def test_properties_apply_in_the_order_of_the_standard() -> None:
    values = {"transform": "translate(1px, 0)", "scale": "2", "rotate": "90deg", "translate": "10px"}
    flat, invalid, deep = element_transform(values, LENGTH)
    assert flat == pytest.approx((0, 2, -2, 0, 10, 2))
    assert (invalid, deep) == ([], False)


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("rotate", "x 60deg", (1, 0, 0, 0.5, 0, 0)),
        ("rotate", "60deg 0 1 0", (0.5, 0, 0, 1, 0, 0)),
        ("scale", "2 3 4", (2, 0, 0, 3, 0, 0)),
        ("translate", "1px 2px 3px", (1, 0, 0, 1, 1, 2)),
        ("translate", "none", (1, 0, 0, 1, 0, 0)),
    ],
)
def test_single_properties(name: str, text: str, expected: tuple[float, ...]) -> None:
    found = property_transform(name, text, LENGTH)
    assert found is not None
    assert to_plane(found)[0] == pytest.approx(expected, abs=1e-12)


def test_invalid_properties_and_perspectives_are_named() -> None:
    flat, invalid, deep = element_transform({"rotate": "30", "scale": "2"}, LENGTH)
    assert (flat, invalid, deep) == (Identity.scale(2.0), ["rotate"], False)
    assert element_transform({"transform": "perspective(100px) rotateX(30deg)"}, LENGTH)[2]
    assert not element_transform({"transform": "perspective(none) rotateX(30deg)"}, LENGTH)[2]


def test_attributes_have_no_units() -> None:
    assert element_transform({"transform": Attribute("translate(3) rotate(90)")}, LENGTH)[0] == pytest.approx(
        (0, 1, -1, 0, 3, 0)
    )
    assert element_transform({"transform": "translate(3) rotate(90)"}, LENGTH)[1] == ["transform"]


def test_a_depth_of_the_origin_moves_the_axis_of_a_turn() -> None:
    flat, _, _ = element_transform({"rotate": "y 90deg", "transform-origin": "0 0 5px"}, LENGTH)
    assert flat.dx == pytest.approx(-5.0)
