"""How a material shows a drawing, and appearances that cannot be."""

import pytest

import vexture
from room_model import glb_content, make_room

KITE = vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])


@pytest.fixture(scope="module")
def kite():
    return vexture.convert(KITE)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"mode": "glow"}, "`mode` is 'glow'; it must be one of 'paint', 'mix', 'cut', 'alpha'"),
        ({"wrap": "mirror"}, "`wrap` is 'mirror'; it must be one of 'none', 'clamp', 'repeat'"),
        ({"tex_coord": 2}, "`tex_coord` is 2; it must be one of 0, 1"),
        ({"color": "red"}, "`color` is for the mode mix; leave it out"),
        ({"invert": True}, "`invert` is for the mode mix or cut or alpha; leave it out"),
        ({"mode": "cut", "threshold": 2}, "`threshold` is 2; it must be a coverage, 0 to 1"),
        ({"mode": "mix", "color": "rgb(0 0 0 / 0.5)"}, "`color` is 'rgb(0 0 0 / 0.5)'; give an opaque CSS colour"),
        ({"scale": (1,)}, "`scale` is (1,); it must be two finite numbers"),
        ({"scale": (2, 0)}, "`scale` is (2, 0); by 0 the drawing is a line; give other numbers"),
        ({"rotation": float("nan")}, "`rotation` is nan; it must be a finite number"),
        ({"root": "nobody"}, "drawing: no shape 'nobody'; there is 'drawing'"),
        ({"mode": "cut", "root": 1}, "drawing: no shape 1; they are numbered 0 to 0"),
    ],
)
def test_an_appearance_that_cannot_be_is_refused(kite, given, message):
    with pytest.raises(vexture.ParameterError) as caught:
        vexture.read_model(glb_content(*make_room())).with_drawing("Sign", kite, **given)
    assert str(caught.value).startswith(message)
