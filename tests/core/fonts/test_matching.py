"""Faces that stand in for those that a text asks for, in the order of CSS Fonts."""

import pytest

from vexture.fonts.matching import Traits, preference


def order(weights, wanted, style="normal", stretch=100.0):
    """Weights in the order in which they stand in for one."""
    faces = [Traits((weight, weight), (100.0, 100.0), ("normal",)) for weight in weights]
    return [face.weights[0] for face in sorted(faces, key=lambda face: preference(face, wanted, style, stretch))]


@pytest.mark.parametrize(
    ("wanted", "expected"),
    [
        (400, [400, 450, 500, 350, 100, 600, 900]),
        (450, [450, 500, 400, 350, 100, 600, 900]),
        (500, [500, 450, 400, 350, 100, 600, 900]),
        (300, [100, 350, 400, 450, 500, 600, 900]),
        (700, [900, 600, 500, 450, 400, 350, 100]),
    ],
)
def test_weights_stand_in_as_css_says(wanted, expected):
    assert order([900, 100, 500, 400, 600, 350, 450], wanted) == expected


def test_stretch_comes_before_style_and_style_before_weight():
    offered = {
        "narrow": Traits((400, 400), (75, 75), ("italic",)),
        "italic": Traits((900, 900), (100, 100), ("italic",)),
        "oblique": Traits((400, 400), (100, 100), ("oblique",)),
        "variable": Traits((100, 900), (100, 100), ("normal",)),
        "wide": Traits((400, 400), (125, 125), ("italic",)),
    }

    def ranked(*wanted):
        return sorted(offered, key=lambda name: preference(offered[name], *wanted))

    assert ranked(400, "italic", 100) == ["italic", "oblique", "variable", "narrow", "wide"]
    assert ranked(400, "normal", 100) == ["variable", "oblique", "italic", "narrow", "wide"]
    assert ranked(400, "italic", 110)[0] == "wide"
