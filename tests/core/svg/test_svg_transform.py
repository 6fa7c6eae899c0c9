"""Transforms: of attributes, of style sheets, and those that are not valid."""

import warnings
from math import pi
from pathlib import Path

import numpy as np
import pytest

from vexture import read
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.transform import Transform, angle, map_points, parse_origin, parse_transform, scale_of
from vexture.svg.values import Viewport, number


def read_quietly(file: Path) -> Drawing:
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return read(file)


def test_transforms_that_are_not_valid_are_named(tmp_path: Path) -> None:
    file = tmp_path / "a.svg"
    body = '<path id="p" d="M0 0h9v9z" style="rotate: 1 1 30deg; scale: 2px; translate: red"/>'
    file.write_text(f'<svg viewBox="0 0 9 9" style="scale: none">{body}</svg>')
    assert [f"{note.kind}: {note}" for note in read_quietly(file).notes] == [
        "invalid: translate='red' of <path id=\"p\"> in line 1",
        "invalid: rotate='1 1 30deg' of <path id=\"p\"> in line 1",
        "invalid: scale='2px' of <path id=\"p\"> in line 1",
    ]


def number_of(text: str, axis: int) -> float | None:
    return number(text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("translate(3)", (1, 0, 0, 1, 3, 0)),
        ("translate(3, 4) scale(2)", (2, 0, 0, 2, 3, 4)),
        ("scale(2),translate(3 4)", (2, 0, 0, 2, 6, 8)),
        ("rotate(90)", (0, 1, -1, 0, 0, 0)),
        ("rotate(90 10 0)", (0, 1, -1, 0, 10, -10)),
        ("skewX(45)", (1, 0, 1, 1, 0, 0)),
        ("skewY(45)", (1, 1, 0, 1, 0, 0)),
        ("matrix(1 2 3 4 5 6)", (1, 2, 3, 4, 5, 6)),
        (" none ", (1, 0, 0, 1, 0, 0)),
    ],
)
def test_functions_of_attributes_are_those_of_svg(text: str, expected: tuple[float, ...]) -> None:
    assert parse_transform(text, number_of) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    "text", ["translate(1 2 3)", "rotate(1 2)", "scale()", "melt(3)", "scale(2", "scale(2) 3", "rotate(9deg)"]
)
def test_other_functions_are_not_valid(text: str) -> None:
    assert parse_transform(text, number_of) is None


def test_angles_of_all_units() -> None:
    for text in ("180", "180deg", "200grad", "0.5turn", "calc(90deg * 2)"):
        assert angle(text) == pytest.approx(pi)
    assert angle("2rad") == 2.0
    assert angle("3px") is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("3 4", (3, 4)),
        ("left", (0, 25)),
        ("bottom", (50, 50)),
        ("top right", (100, 0)),
        ("center 7", (50, 7)),
        ("25% 50% 9px", (25, 25)),
        ("red", None),
        ("", None),
    ],
)
def test_origins_of_words_and_lengths(text: str, expected: tuple[float, float] | None) -> None:
    assert parse_origin(text, Viewport(100.0, 50.0).along(16.0)) == expected


@pytest.mark.parametrize("seed", range(5))
def test_a_map_stretches_by_its_larger_singular_value(seed: int) -> None:
    matrix = np.random.default_rng(seed).normal(size=(2, 2))
    stretch = scale_of(Transform(*matrix.T.ravel().tolist(), 7.0, 8.0))
    assert stretch == pytest.approx(np.linalg.svd(matrix, compute_uv=False)[0])
    points = np.random.default_rng(seed).normal(size=(3, 4, 2))
    mapped = map_points(points, Transform(*matrix.T.ravel().tolist(), 7.0, 8.0))
    np.testing.assert_allclose(mapped, points @ matrix.T + (7.0, 8.0))
