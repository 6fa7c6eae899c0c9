"""Other renderers draw the same drawing, rule and view as ours."""

import numpy as np
import pytest

from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.exact import render_exact
from vexture.svg.read import read_svg
from vexture_evidence.measures.metrics import errors
from vexture_evidence.measures.peers import render_resvg, render_skia, svg_text
from vexture_evidence.measures.shape import ConvertedDrawing, example

NAMES = ["duck", "simple-quartet", "ocean"]
RECEDING = np.array([[0.01, 0.0, -0.1], [0.0, -0.01, 1.1], [0.0, 0.004, 1.0]])
STAR = [(0.5, 0.95), (0.2, 0.05), (0.95, 0.6), (0.05, 0.6), (0.8, 0.05)]


@pytest.mark.parametrize("size", [(128, 128), (120, 90)], ids=str)
@pytest.mark.parametrize("name", NAMES)
def test_the_drawing_is_in_its_place(name, size):
    drawing = ConvertedDrawing(example(name)).drawing
    truth = render_exact(drawing, size)
    for image in (render_resvg(drawing, size), render_skia(drawing, size)):
        assert image.shape == truth.shape
        assert image.dtype == np.float32
        assert errors(image, truth).mae < 3.0


def test_skia_takes_a_receding_view():
    drawing = ConvertedDrawing(example("duck")).drawing
    truth = render_exact(drawing, (100, 100), RECEDING)
    assert 0.1 < truth.mean() < 0.9
    assert errors(render_skia(drawing, (100, 100), RECEDING), truth).mae < 3.0


@pytest.mark.parametrize(("rule", "full"), [(FillRule.NONZERO, 1.0), (FillRule.EVENODD, 0.0)])
def test_both_know_the_fill_rules(rule, full):
    star = Drawing.polygon(STAR, fill_rule=rule)
    for image in (render_resvg(star, (64, 64)), render_skia(star, (64, 64))):
        assert image[36, 32] == full
        assert errors(image, render_exact(star, (64, 64))).mae < 8.0


def test_an_empty_drawing_is_empty():
    for image in (render_resvg(Drawing(()), (8, 4)), render_skia(Drawing(()), (8, 4))):
        assert image.shape == (4, 8)
        assert not image.any()


def test_the_document_is_the_drawing(tmp_path):
    drawing = ConvertedDrawing(example("holes")).drawing
    (tmp_path / "again.svg").write_text(svg_text(drawing, (64, 64)))
    again = read_svg(tmp_path / "again.svg")
    assert np.abs(render_exact(again, (64, 64)) - render_exact(drawing, (64, 64))).max() < 1e-3
