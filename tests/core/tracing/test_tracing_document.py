"""Outlines of traced pictures, and how many pieces they may have."""

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image, ImageFilter
from traced_drawings import SHAPES, area, distances, gray

import vexture
from vexture.base.errors import LimitError
from vexture.svg.read import svg_drawing
from vexture.tracing.document import MOST_CURVES, MOST_PIECES, _trace_mask


@pytest.mark.parametrize("radius", [1, 2])
def test_outline_of_a_blurred_scan_stays_at_the_middle_of_its_edges(radius):
    drawing = vexture.read_svg(SHAPES / "duck.svg")
    blurred = Image.fromarray(gray(drawing, 300)).filter(ImageFilter.GaussianBlur(radius))
    mean, outward = distances(drawing, vexture.trace(np.asarray(blurred)), 300)
    assert mean < 0.4
    assert abs(outward) < 0.2


def test_no_point_of_an_outline_is_far_off():
    circle = svg_drawing(b'<svg viewBox="0 0 240 240"><circle cx="80" cy="80" r="50"/></svg>', "circle.svg")
    contour = vexture.trace(gray(circle, 240)).paths[0].contours[0]
    t = np.linspace(0.0, 1.0, 9)[:, None, None]
    curves = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    points = 240 * sum(weight * contour[:, place] for place, weight in enumerate(curves))
    assert np.abs(np.hypot(points[..., 0] - 80, points[..., 1] - 160) - 50).max() < 0.7


def test_thin_lines_are_kept():
    image = np.full((100, 100), 255, np.uint8)
    image[50] = 40
    image[20:40, 70] = 40
    traced = vexture.trace(image)
    assert area(traced) == pytest.approx(0.012, rel=0.15)


@pytest.mark.slow
@pytest.mark.parametrize(("cell", "drawn"), [(1, False), (20, True)])
@pytest.mark.filterwarnings("ignore::vexture.SourceWarning")
def test_noise_ends_in_a_drawing_or_in_one_line(cell, drawn):
    cells = np.random.default_rng(cell).integers(0, 2, (600 // cell, 600 // cell))
    noise = np.kron(cells, np.ones((cell, cell))).astype(np.uint8) * 255
    if drawn:
        assert 0 < vexture.trace(noise, "noise").segments <= MOST_CURVES
    else:
        with pytest.raises(LimitError, match=r"^noise: .*; the limit is |the limit; "):
            vexture.trace(noise, "noise")


def test_mask_with_more_pieces_than_vtracer_counts_never_reaches_it():
    mask = np.add.outer(np.arange(400), np.arange(400)) % 2 == 0
    with pytest.raises(LimitError, match=f"80,000 pieces; the limit is {MOST_PIECES:,}"):
        _trace_mask(mask, 1)


def test_without_vtracer_it_is_said_what_to_install():
    code = """
import sys
sys.modules["vtracer"] = None
import numpy, vexture
try:
    vexture.trace(numpy.eye(80), "eye")
except vexture.DeviceError as error:
    print(error)
"""
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert outcome.stdout == "eye: tracing a picture needs the package vtracer: pip install 'vexture[trace]'\n"
