"""Parameters of conversions reach what they are for, and others get one line."""

from dataclasses import replace

import numpy as np
import pytest

import vexture
from vexture.base.errors import ParameterError
from vexture.base.tolerance import UNSEEN
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode
from vexture.texture.root import Root
from vexture.tree.build import build_tree

RED, GLASS = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0), 0.5)


def star(points: int, name: str, paint: Paint = RED) -> Drawing:
    """Star polygon, which crosses itself."""
    angles = np.arange(points) * (2.0 * np.pi * (points // 2) / points)
    drawing = Drawing.polygon(list(zip(0.5 + 0.4 * np.cos(angles), 0.5 + 0.4 * np.sin(angles), strict=True)))
    return Drawing((replace(drawing.paths[0], paint=paint),), name=name)


def texels_of(drawing: Drawing, **parameters: float) -> np.ndarray:
    return encode([build_tree(drawing, **parameters)], [Root("")], name="").texels


@pytest.mark.parametrize(
    "parameters",
    [
        {"capacity": 2},
        {"capacity": 5},
        {"max_depth": 2},
        {"precision": 1e-7},
        {"precision": 1e-6, "capacity": 1, "max_depth": 9},
    ],
)
def test_parameters_reach_the_tree(parameters: dict[str, float]) -> None:
    drawing = star(25, "star")
    texels = vexture.convert(drawing, tolerance=0, **parameters).texels
    np.testing.assert_array_equal(texels, texels_of(drawing, **parameters))
    assert texels.shape != texels_of(drawing).shape or (texels != texels_of(drawing)).any()


def test_tolerance_reaches_the_tree_and_the_root() -> None:
    drawing = star(9, "star")
    texture = vexture.convert(drawing, tolerance=0.01)
    np.testing.assert_array_equal(texture.texels, texels_of(drawing, tolerance=0.01))
    assert texture.roots[0].tolerance == 0.01


@pytest.mark.parametrize(("given", "tolerance"), [({}, UNSEEN), ({"precision": 1e-6}, 0.0)])
def test_the_automatic_tolerance_is_unseen_and_none_for_deep_zoom(given, tolerance) -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    drawing = Drawing.polygon(list(zip(0.5 + 0.4 * np.cos(angles), 0.5 + 0.4 * np.sin(angles), strict=True)))
    assert texels_of(drawing, tolerance=UNSEEN).size < texels_of(drawing).size
    for texture in (vexture.convert(drawing, **given), vexture.convert(drawing, tolerance="auto", **given)):
        assert texture.roots[0].tolerance == tolerance
        np.testing.assert_array_equal(texture.texels, texels_of(drawing, tolerance=tolerance, **given))


@pytest.mark.parametrize(
    ("parameters", "says"),
    [
        ({"encoding": "pcx"}, "must be 'packed' or 'thesis'"),
        ({"encoding": "thesis", "bits": 12}, "8 or 16"),
        ({"encoding": "thesis", "tolerance": 0.0}, "tolerance"),
        ({"encoding": "thesis", "strategy": "best"}, "must be 'direct' or 'sampled'"),
        ({"split": "size"}, "`split` is 'size'"),
        ({"tolerance": -1e-9}, "`tolerance` -1e-09"),
        ({"tolerance": float("nan")}, "`tolerance` nan"),
        ({"tolerance": float("inf")}, "`tolerance` inf"),
        ({"capacity": 0}, "1..15"),
        ({"capacity": 16}, "1..15"),
        ({"max_depth": 0}, "1..20"),
        ({"max_depth": 21}, "1..20"),
        ({"max_depth": 3.5}, "`max_depth` 3.5 is no whole number in 1..20"),
        ({"max_depth": True}, "`max_depth` True is no whole number"),
        ({"encoding": "thesis", "max_depth": 3.5}, "`max_depth` 3.5 is no whole number"),
        ({"capacity": "4"}, "`capacity` '4' is no whole number in 1..15"),
        ({"precision": "1e-7"}, "`precision` '1e-7' is no number"),
        ({"tolerance": True}, "`tolerance` True is no number"),
        ({"precision": 0.0}, "`precision` 0.0"),
        ({"precision": float("nan")}, "`precision` nan"),
        ({"select": "#a"}, "`select` is '#a'.* vexture.read.path, select="),
    ],
)
def test_parameters_that_do_not_fit_get_one_line(parameters: dict[str, object], says: str) -> None:
    with pytest.raises(ParameterError, match=says) as caught:
        vexture.convert(star(5, "star"), **parameters)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("parameters", "says"),
    [
        ({"bits": 16}, "`bits` is 16, but the encoding packed has no such parameter"),
        ({"strategy": "direct"}, "`strategy` is 'direct', but the encoding packed"),
        ({"encoding": "thesis", "capacity": 4}, "`capacity` is 4, but the encoding thesis"),
        ({"encoding": "thesis", "precision": 0.1}, "`precision` is 0.1, but the encoding thesis"),
        ({"encoding": "thesis", "split": "paint"}, "`split` is 'paint', but the encoding thesis"),
    ],
)
def test_parameters_of_another_encoding_are_refused(parameters: dict[str, object], says: str) -> None:
    with pytest.raises(TypeError, match=says) as caught:
        vexture.convert(star(5, "star"), **parameters)
    assert "\n" not in str(caught.value)
