"""Lines on maps: curved where a map bends them, parted where it is torn."""

import numpy as np
import pytest
import shapely
from projected import EQUAL_EARTH, WORLD, in_system

from vexture_geo.base.crs import transform_points
from vexture_geo.maps.lines import lines_along, rings_along
from vexture_geo.vector.features import Lines


def test_a_line_is_curved_where_a_map_bends_it_and_parted_where_it_is_torn():
    parallel = shapely.LineString([(-60, 60), (60, 60)])
    features, _ = in_system([parallel], "EPSG:3035")
    truth = transform_points(np.stack([np.linspace(-60, 60, 2001), np.full(2001, 60.0)], axis=1), WORLD, "EPSG:3035")
    line = shapely.LineString(features.lines.points)
    assert shapely.hausdorff_distance(line, shapely.LineString(truth)) < 2e-5 * np.ptp(truth[:, 0])
    across, _ = in_system([shapely.LineString([(170, 10), (-170, 10)])], EQUAL_EARTH)
    assert len(across.lines.ends) == 2
    assert np.abs(np.diff(across.lines.points[: across.lines.ends[0], 0])).max() < 2e6
    assert across.lines.feature.tolist() == [0, 0]


def test_lines_on_web_mercator_go_on_beyond_the_antimeridian_and_end_at_its_edge():
    features, _ = in_system([shapely.LineString([(179, 10), (-179, 10)])], "EPSG:3857")
    assert np.ptp(features.lines.points[:, 0]) < 3e5
    features, said = in_system([shapely.LineString([(0, 80), (0, 90)])], "EPSG:3857")
    assert features.lines.points[:, 1].max() == pytest.approx(20037508.34, rel=1e-6)
    assert any("85.05" in line for line in said)


def test_there_and_back():
    lines = Lines(np.arange(10.0).reshape(5, 2), np.array([2, 5]), np.array([4, 7]))
    rings = rings_along(lines)
    assert rings.points[:, 0].tolist() == [0, 2, 4, 6, 8, 6]
    again = lines_along(rings)
    assert (again.points == lines.points).all()
    assert again.ends.tolist() == [2, 5]
    assert again.feature.tolist() == [4, 7]
