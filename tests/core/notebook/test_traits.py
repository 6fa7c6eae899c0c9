"""Traits of widgets: what they accept of what users write, and one line for the rest."""

import numpy as np
import pytest

from vexture.base.errors import ParameterError

traitlets = pytest.importorskip("traitlets")
from vexture.notebook.traits import (  # noqa: E402
    ChoiceTrait,
    ColoursTrait,
    LabelTrait,
    NumberTrait,
    PixelsTrait,
    RectangleTrait,
)


class Shown(traitlets.HasTraits):
    width = PixelsTrait(None, allow_none=True)
    label = LabelTrait()
    mode = ChoiceTrait(("paint", "silhouette"), "paint")
    step = NumberTrait()
    view = RectangleTrait()
    colors = ColoursTrait()


@pytest.mark.parametrize(
    ("name", "value", "stored"),
    [
        ("width", np.int64(7), 7),
        ("width", None, None),
        ("label", 11.0, "11"),
        ("label", np.datetime64("2024-01-31"), "2024-01-31"),
        ("step", np.float32(0.5), 0.5),
        ("step", "3", 3.0),
        ("view", np.array([0, 0, 1, 2]), (0.0, 0.0, 1.0, 2.0)),
        ("colors", {1.0: "red", "a": None}, {"1": "red", "a": None}),
    ],
)
def test_what_users_write_is_stored_as_plain_values(name, value, stored):
    shown = Shown(**{name: value})
    assert getattr(shown, name) == stored
    assert type(getattr(shown, name)) is type(stored)


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("width", "100%", "`width` is '100%'; give a whole number of pixels, 1 or more"),
        ("width", True, "`width` is True; give a whole number of pixels, 1 or more"),
        ("width", 0, "`width` is 0; give a whole number of pixels, 1 or more"),
        ("label", np.arange(3), "`label` is a ndarray; give one name, as of a feature or a column"),
        ("mode", "paints", "`mode` is 'paints'; give 'paint' or 'silhouette'"),
        ("step", "x" * 99, f"`step` is '{'x' * 56}...; give a number"),
        ("view", (0, 0, 1), "`view` is (0.0, 0.0, 1.0); give four numbers: left, bottom, width and height"),
        ("view", 3, "`view` is 3; give four numbers: left, bottom, width and height"),
        ("colors", ["red"], "`colors` is ['red']; give a mapping of names, such as {'sun': 'red'}"),
    ],
)
def test_other_values_are_refused_in_a_line_and_change_nothing(name, value, line):
    shown = Shown(view=(0, 0, 1, 1))
    before = getattr(shown, name)
    with pytest.raises(ParameterError) as refused:
        setattr(shown, name, value)
    assert str(refused.value).replace("(0, 0, 1)", "(0.0, 0.0, 1.0)") == line
    assert getattr(shown, name) == before
