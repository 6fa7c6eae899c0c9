"""A widget's view as an array and as a PNG."""

from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import vexture
from vexture.notebook.picture import WHOLE, home_of, png_of, render_view


@pytest.mark.parametrize(
    ("background", "mode", "pixel"),
    [("white", "RGB", (255, 128, 128)), ("#00f", "RGB", (128, 0, 128)), ("transparent", "RGBA", (255, 0, 0, 128))],
)
def test_a_translucent_red_on_a_background(background, mode, pixel):
    data = png_of(np.full((2, 3, 4), (0.5, 0.0, 0.0, 0.5), np.float32), background)
    with Image.open(BytesIO(data)) as picture:
        assert (picture.mode, picture.size, picture.getpixel((2, 1))) == (mode, (3, 2), pixel)


def test_home_is_the_box_of_what_is_drawn():
    high = vexture.convert(vexture.Drawing.polygon([(0.25, 0.5), (0.5, 0.5), (0.5, 1.0), (0.25, 1.0)]))
    assert home_of(high, None) == pytest.approx((0.23, 0.48, 0.29, 0.54))
    assert render_view(high, 1, (0.25, 0.5, 0.25, 0.25), "silhouette", None)[0, 0].tolist() == [0, 0, 0, 1]


@pytest.mark.filterwarnings("ignore:.*nothing in it is painted")
def test_home_of_nothing_is_the_whole_square():
    assert home_of(vexture.convert(vexture.Drawing(())), None) == WHOLE
