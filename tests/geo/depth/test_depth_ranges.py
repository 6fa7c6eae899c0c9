"""Classes of depth: their ranges, by the flags of a variable."""

import netCDF4
import numpy as np
import pytest
from small_grids import CELL, CRS, columns, netcdf, read, said

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.base.depth_ranges import DepthRange

INF = np.inf
BOUNDS = [[0.0, 0.5], [0.5, 1.0], [1.0, 5.0], [5.0, 9.96921e36]]
MEANINGS = "0.000m_to_0.500m 0.500m_to_1.000m 1.000m_to_5.000m above_5.000m"
FLAGS = {"flag_values": np.arange(1, 5, dtype="i1"), "flag_meanings": MEANINGS}


def mesh(path, numbers, about):
    """Numbers on a row of square faces."""
    count = len(numbers)
    with netCDF4.Dataset(path, "w") as file:
        file.epsg_code = CRS
        for name, size in (("nodes", 2 * count + 2), ("faces", count), ("corners", 4)):
            file.createDimension(name, size)
        topology = file.createVariable("mesh2d", "i4", ())
        topology.setncatts({
            "cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "node_x node_y",
            "face_node_connectivity": "face_nodes",
        })  # fmt: skip
        x, y = np.meshgrid(500_000.0 + CELL * np.arange(count + 1), 4_000_000.0 + CELL * np.arange(2))
        file.createVariable("node_x", "f8", ("nodes",))[:] = x.ravel()
        file.createVariable("node_y", "f8", ("nodes",))[:] = y.ravel()
        first = np.arange(count)[:, None]
        around = np.array([0, 1, count + 2, count + 1])
        file.createVariable("face_nodes", "i4", ("faces", "corners"))[:] = first + around
        depth = file.createVariable("waterdepth", "i1", ("faces",))
        depth.setncatts(about)
        depth[:] = numbers
    return path


def width(drawing, frame):
    """Metres from west to east of an area of stripes that begins in the east."""
    x0, _, x1, _ = frame.box
    low = min(path.box[0, 0] for path in drawing.paths)
    return (x1 - low) / (x1 - x0) * frame.metres[0]


@pytest.mark.parametrize(
    "about",
    [
        {**FLAGS, "units": "m", "flag_bounds": "class_bounds_hs"},
        {**FLAGS, "units": "m"},
        {"flag_values": "1 2 3 4", "flag_meanings": MEANINGS},
        {"flag_values": "1b, 2b, 3ub, 4s", "flag_meanings": MEANINGS},
        {**FLAGS, "flag_meanings": "below_0.5 0.5_to_1.0 1-5 >5", "units": "m"},
        {**FLAGS, "flag_meanings": "dry 50cm_to_100cm 100cm_to_500cm more_than_500cm", "units": "m"},
        {**FLAGS, "flag_meanings": "below_50 50_to_100 100_to_500 over_500", "units": "cm"},
    ],
)
@pytest.mark.parametrize("name", ["mesh2d_waterdepth", "kind"])
def test_classes_of_depth_are_ranges_and_no_metres(tmp_path, name, about):
    path = netcdf(tmp_path / "run.nc", {name: (columns(1, 2, 3, 4), dict(about))}, bounds=BOUNDS)
    extent = read(path, depths=(1.0, 5.0))
    (step,) = extent.steps
    assert step.depth is None
    assert step.classes.ranges == (DepthRange(0.5, 1.0), DepthRange(1.0, 5.0), DepthRange(5.0, INF))
    assert step.classes.contours == (1.0, 5.0)
    assert np.unique(step.classes.ranks[:, ::64]).tolist() == [0, 1, 2, 3]
    assert width(step.drawing, extent.frame) == pytest.approx(90.0, abs=0.1)
    assert [width(area, extent.frame) for area in step.deeper] == pytest.approx([60.0, 30.0], abs=0.1)
    assert "it holds classes of depth, from 0.5 to 1 m to over 5 m" in said(extent)


def test_classes_on_a_mesh_end_at_the_sides_of_their_faces(tmp_path):
    extent = read(mesh(tmp_path / "run.nc", [1, 1, 2, 3, 4, 4], dict(FLAGS)), depths=(1.0, 5.0))
    (step,) = extent.steps
    assert width(step.drawing, extent.frame) == pytest.approx(40.0, abs=0.1)
    assert [width(area, extent.frame) for area in step.deeper] == pytest.approx([30.0, 20.0], abs=0.1)
    assert step.classes.ranks[0, [10, 107, 149, 250]].tolist() == [0, 1, 2, 3]


def test_a_class_of_dry_ground_is_dry_and_one_around_the_least_depth_is_water(tmp_path):
    about = {**FLAGS, "flag_meanings": "0_to_0.02 0.02_to_0.1 0.1_to_2 above_2"}
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(1, 2, 3, 4), about)})
    extent = read(path)
    assert extent.steps[0].classes.ranges[0] == DepthRange(0.02, 0.1)
    assert "its class 0.02 to 0.1 m counts as water, with `hmin` 0.05 m in it" in said(extent)
    assert read(path, hmin=0.1).steps[0].classes.ranges[0] == DepthRange(0.1, 2.0)
    extent = read(netcdf(tmp_path / "other.nc", {"depth": (columns(1, 2), dict(FLAGS))}))
    assert "its class 0 to 0.5 m holds dry ground too, and counts as dry" in said(extent)


def test_borders_of_classes_are_those_of_the_file(tmp_path):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(1, 2, 3, 4), dict(FLAGS))})
    extent = read(path, depths=(0.2, 1.0))
    assert extent.steps[0].classes.contours == (1.0, 5.0)
    assert "maps of its classes have borders at 1 and 5 m, where the file has them" in said(extent)
    many = {
        "flag_values": np.arange(40, dtype="i1"),
        "flag_meanings": " ".join(f"{k / 10:g}_to_{(k + 1) / 10:g}" for k in range(40)),
    }
    path = netcdf(tmp_path / "many.nc", {"depth": (columns(0, 39), many)})
    assert read(path, depths=(0.25, 1.0, 2.0)).steps[0].classes.contours == (1.0, 2.0)
    assert len(read(path, depths=(0.25,)).steps[0].classes.contours) == 7


@pytest.mark.parametrize(
    "meanings",
    ["internal closed boundary open", "low medium high extreme", "1.0 2.0 3.0", "0_to_2 1_to_3 3_to_4 4_to_5"],
)
def test_flags_of_anything_else_are_no_depths(tmp_path, meanings):
    flags = {"flag_values": np.arange(1, 5, dtype="i1"), "flag_meanings": meanings, "units": "m"}
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(1, 2, 3, 4), dict(flags))})
    with pytest.raises(SourceError, match=r"'depth' holds flags \(.*\) that are no ranges of depth"):
        read(path)
    path = netcdf(tmp_path / "both.nc", {"depth": (columns(1, 2), dict(flags)), "wd": (columns(0, 3), {"units": "m"})})
    assert np.nanmax(read(path).steps[0].depth) == 3.0
    with pytest.raises(ParameterError, match="'depth' holds flags"):
        read(path, variable="depth")


def test_classes_of_water_levels_and_of_speeds_are_not_taken_for_numbers(tmp_path):
    bed = (columns(-1, -2), {"units": "m", "standard_name": "altitude"})
    path = netcdf(tmp_path / "level.nc", {"s1": (columns(1, 2), dict(FLAGS)), "bl": bed})
    with pytest.raises(SourceError, match="'s1' holds classes of water levels"):
        read(path)
    depth = (columns(1, 2), {"units": "m"})
    path = netcdf(tmp_path / "speed.nc", {"depth": depth, "ucmag": (columns(1, 2), dict(FLAGS))})
    assert read(path).steps[0].speed is None


@pytest.mark.parametrize(
    ("values", "meanings", "why"),
    [
        ([1, 2, 3, 4], "dry 0.1-0.5m 0.5-1m", "there are 4 flag_values, and 3 ranges for them"),
        ([1, 2, 3, 4], "dry 0.1-0.8m 0.5-1m >1m", "0.1 to 0.8 m and 0.5 to 1 m overlap"),
        ([1, 2], "dry deep", "'deep' is none"),
        ([1, 2], "dry 2-1m", "'2-1m' ends where it begins, or below"),
        ("one two", "dry wet", "flag_values are missing, or no numbers"),
    ],
)
def test_what_is_wrong_with_flags_is_told_and_how_to_write_them(tmp_path, values, meanings, why):
    flags = {"flag_values": values if isinstance(values, str) else np.array(values, "i1"), "flag_meanings": meanings}
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(1, 2), flags)})
    with pytest.raises(SourceError, match=rf"no ranges of depth: {why}; write each as 0\.5-1m, .* flag_bounds"):
        read(path)
