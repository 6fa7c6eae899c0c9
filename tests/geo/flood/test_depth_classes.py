"""Classes of depth: areas of all that is as deep, and the planar map of them."""

import colorsys

import numpy as np
import pytest
from floods import depths, flood, geotiff, scene_of

import vexture
from vexture.renderers.exact import render_exact
from vexture_geo.base.extent import Step
from vexture_geo.flood.depth_classes import class_drawing, colors_of

CONTOURS = (0.5, 1.5)


@pytest.fixture(scope="module")
def extent(tmp_path_factory):
    """A beach in the west half of a box, 2 m deep at its western border."""
    path = geotiff(tmp_path_factory.mktemp("depths") / "depth.tif", depths())
    return vexture.read_extent(path, depths=CONTOURS)


def share_of(drawing, frame):
    """Share of the frame's width that a drawing covers, in its middle."""
    x0, _, x1, _ = frame.box
    row = render_exact(drawing, (1024, 1024))[512]
    return (row[round(1024 * x0) : round(1024 * x1)]).mean()


def test_areas_end_where_the_water_is_so_deep(extent):
    (step,) = extent.steps
    assert len(step.deeper) == len(CONTOURS)
    for depth, area in zip(CONTOURS, step.deeper, strict=True):
        assert share_of(area, extent.frame) == pytest.approx(0.5 * (1.0 - depth / 2.0), abs=2e-3)
        assert (render_exact(area, (64, 64)) <= render_exact(step.drawing, (64, 64)) + 1e-6).all()
        assert (area.name, area.crs) == (step.drawing.name, step.drawing.crs)


@pytest.mark.parametrize("wrong", [0.05, -1.0, float("nan"), float("inf")])
def test_depths_of_no_class_are_refused(tmp_path, wrong):
    path = geotiff(tmp_path / "depth.tif", depths())
    with pytest.raises(vexture.ParameterError, match=r"`depths` holds .* m; all must be above `hmin`, 0.05 m"):
        vexture.read_extent(path, depths=[1.0, wrong])


def test_a_map_has_the_color_of_the_deepest_class_at_each_place(extent):
    classes = (0.0, *CONTOURS)
    drawing = class_drawing(extent.steps[0], classes, 0.05, "classes")
    picture = vexture.convert(drawing, split="faces").render(64)
    x0, y0, x1, y1 = extent.frame.box
    row = round(64 * (1.0 - 0.5 * (y0 + y1)))
    found = [picture[row, int(64 * (x0 + (x1 - x0) * share))] for share in (0.05, 0.3, 0.45, 0.7)]
    wanted = [[int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)] for color in colors_of(3)[::-1]]
    for seen, color in zip(found, wanted, strict=False):
        assert seen == pytest.approx([*color, 1.0], abs=1 / 255)
    assert found[3][3] == 0.0


def test_nothing_wet_or_of_no_known_depth_has_no_map(extent):
    (step,) = extent.steps
    assert class_drawing(Step(step.drawing), (0.0,), 0.05, "none") is None
    assert class_drawing(step, (0.0, 0.5), 0.05, "other contours") is None
    dry = Step(vexture.Drawing(()), depth=step.depth)
    assert class_drawing(dry, (0.0,), 0.05, "dry") is None


def test_colors_grow_darker_so_that_their_order_is_seen_in_gray():
    for count in range(1, 9):
        colors = colors_of(count)
        bright = [colorsys.rgb_to_yiq(*(int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)))[0] for color in colors]
        assert bright == sorted(bright, reverse=True)
        assert len(set(colors)) == count


def test_the_page_has_a_map_for_each_step_and_the_colors_of_its_legend(tmp_path):
    path = geotiff(tmp_path / "depth.tif", np.stack([depths(), np.zeros((20, 40), np.float32)]))
    page = tmp_path / "page.html"
    outcome = flood("--extent", path, "--time-dim", "band", "--depths", "0.5,1.5", "-o", page)
    assert outcome.returncode == 0, outcome.stderr
    told = scene_of(page)["flood"]
    assert told["depths"] == [
        {"from": depth, "color": color} for depth, color in zip((0.0, *CONTOURS), colors_of(3), strict=True)
    ]
    assert ["classes" in step["views"] for step in told["steps"]] == [True, False]  # the second is dry
