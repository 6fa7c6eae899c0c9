"""Numbers that are no depths: classes of depth, masks, states, colours, and numbers that stand for none."""

import netCDF4
import numpy as np
import pytest
import rasterio
from rasterio.enums import ColorInterp
from rasterio.transform import Affine

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import line_of
from vexture_geo.base.depth_ranges import DepthRange
from vexture_geo.depth.depths import read_depths

CRS = "EPSG:32610"
CELL, ROWS, COLUMNS = 10.0, 8, 12
PLACE = Affine(CELL, 0.0, 500_000.0, 0.0, -CELL, 4_000_080.0)
INF = np.inf
BOUNDS = [[0.0, 0.5], [0.5, 1.0], [1.0, 5.0], [5.0, 9.96921e36]]
MEANINGS = "0.000m_to_0.500m 0.500m_to_1.000m 1.000m_to_5.000m above_5.000m"
FLAGS = {"flag_values": np.arange(1, 5, dtype="i1"), "flag_meanings": MEANINGS}


def columns(*numbers):
    """Numbers that fill as many columns each, by time, y and x."""
    line = np.repeat(numbers, COLUMNS // len(numbers))
    return np.broadcast_to(line, (1, ROWS, COLUMNS))


def netcdf(path, variables, dtype="i1", bounds=None):
    """A file of variables: numbers by time, y and x, and attributes."""
    with netCDF4.Dataset(path, "w") as file:
        for name, count in (("time", None), ("y", ROWS), ("x", COLUMNS)):
            file.createDimension(name, count)
        file.epsg_code = CRS
        for name, first, count in (("x", 500_005.0, COLUMNS), ("y", 4_000_005.0, ROWS)):
            file.createVariable(name, "f8", (name,))[:] = first + CELL * np.arange(count)
        if bounds is not None:
            file.createDimension("class", len(bounds))
            file.createDimension("two", 2)
            file.createVariable("class_bounds_hs", "f8", ("class", "two"))[:] = bounds
        for name, (numbers, about) in variables.items():
            one = file.createVariable(name, dtype, ("time", "y", "x"), fill_value=about.pop("_FillValue", False))
            one.set_auto_maskandscale(False)
            one.setncatts(about)
            one[:] = numbers
    return path


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


def geotiff(path, numbers, **profile):
    bands = np.asarray(numbers)
    bands = bands if bands.ndim == 3 else bands[None]
    count, rows, across = bands.shape
    with rasterio.open(
        path, "w", driver="GTiff", width=across, height=rows, count=count, dtype=bands.dtype, crs=CRS,
        transform=PLACE, **profile,
    ) as file:  # fmt: skip
        file.write(bands)
    return path


def read(path, **options):
    return read_depths(path, path.name, **options)


def said(extent):
    return line_of("file", extent.notes)


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


def test_states_of_wet_and_dry_are_areas_without_depth(tmp_path):
    flags = {"flag_values": np.arange(2, dtype="i1"), "flag_meanings": "dry wet"}
    extent = read(netcdf(tmp_path / "run.nc", {"state": (columns(0, 1), flags)}))
    (step,) = extent.steps
    assert (step.depth, step.classes) == (None, None)
    assert width(step.drawing, extent.frame) == pytest.approx(60.0, abs=0.1)


@pytest.mark.parametrize("numbers", [(0, 1), (0, 255), (255, 1), (0, 1.0)])
def test_masks_are_areas_without_depth(tmp_path, numbers):
    dtype = "f4" if isinstance(numbers[1], float) else "u1"
    paths = [
        geotiff(tmp_path / "mask.tif", columns(*numbers).astype(dtype)),
        netcdf(tmp_path / "mask.nc", {"extent": (columns(*numbers), {})}, dtype),
    ]
    for path in paths:
        extent = read(path)
        (step,) = extent.steps
        assert (step.depth, step.deeper, step.classes) == (None, (), None)
        assert width(step.drawing, extent.frame) == pytest.approx(60.0, abs=0.1)
        assert "is read as water of no known depth; if they are depths, write their unit into the file" in said(extent)


def test_numbers_of_masks_are_depths_where_the_file_says_a_unit(tmp_path):
    path = netcdf(tmp_path / "depth.nc", {"depth": (columns(0, 1), {"units": "m"})})
    assert np.nanmax(read(path).steps[0].depth) == 1.0
    path = geotiff(tmp_path / "depth.tif", columns(0, 1).astype("u1"))
    with rasterio.open(path, "r+") as file:
        file.units = ("m",)
    assert np.nanmax(read(path).steps[0].depth) == 1.0


def test_a_mask_is_known_by_all_its_times(tmp_path):
    numbers = np.concatenate([columns(0, 0), columns(0, 1), columns(0, 2)])
    path = netcdf(tmp_path / "run.nc", {"depth": (numbers, {})}, "f4")
    assert [float(np.nanmax(step.depth)) for step in read(path).steps] == [0.0, 1.0, 2.0]


@pytest.mark.parametrize("photometric", ["RGB", "palette"])
def test_pictures_are_refused(tmp_path, photometric):
    pixels = np.arange(ROWS * COLUMNS, dtype="u1").reshape(ROWS, COLUMNS)
    is_rgb = photometric == "RGB"
    path = geotiff(tmp_path / "photo.tif", np.stack([pixels] * 3) if is_rgb else pixels, photometric=photometric)
    if not is_rgb:
        with rasterio.open(path, "r+") as file:
            file.write_colormap(1, {k: (k, 0, 0, 255) for k in range(100)})
            file.colorinterp = [ColorInterp.palette]
    with pytest.raises(SourceError, match="its numbers are those of colours, and no depths"):
        read(path)


def test_whole_numbers_without_a_unit_are_named(tmp_path):
    path = geotiff(tmp_path / "classes.tif", columns(0, 1, 2, 3).astype("u1"))
    assert "whole numbers without a unit, taken as metres" in said(read(path))


@pytest.mark.parametrize(
    ("dtype", "fill", "about"),
    [
        ("f4", 9999.0, {}),
        ("f4", 999.0, {"units": "m"}),
        ("f4", 9999.0, {"units": "cm"}),
        ("f4", -99999.0, {"units": "mm"}),
        ("u2", 65535, {"scale_factor": 0.001}),
        ("i2", 32767, {"scale_factor": 0.01, "units": "m"}),
        ("i2", -32767, {"scale_factor": 0.01, "units": "m"}),
    ],
)
def test_undeclared_fill_values_are_unknown_and_named(tmp_path, dtype, fill, about):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(fill, 200), dict(about))}, dtype)
    extent = read(path)
    depth = extent.steps[0].depth
    assert np.isnan(depth[:, :100]).all()
    unit = {"cm": 0.01, "mm": 0.001}.get(about.get("units"), 1.0) * about.get("scale_factor", 1.0)
    np.testing.assert_allclose(depth[:, 140:], 200 * unit, rtol=1e-6)
    assert "taken as unknown; declare them, as _FillValue or nodata" in said(extent)


def test_a_deep_sea_keeps_its_depths_of_nines(tmp_path):
    path = netcdf(tmp_path / "sea.nc", {"depth": (columns(999, 800), {"units": "m"})}, "f4")
    assert np.nanmax(read(path).steps[0].depth) == 999.0


@pytest.mark.parametrize(("fill", "depth"), [(99.0, 3.0), (99.99, 9.5), (999.9, 0.5), (-1.0, 2.0), (-99.0, 2.0)])
@pytest.mark.parametrize("about", [{"units": "m"}, {"units": "ft"}])
def test_small_undeclared_fill_values_of_depths_are_unknown(tmp_path, fill, depth, about):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(fill, 0.0, depth), about)}, "f4")
    extent = read(path)
    assert np.isnan(extent.steps[0].depth[:, 10]).all()
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(depth * (0.3048 if about["units"] == "ft" else 1.0))
    assert f"'depth' has values of {fill:g}, taken as unknown" in said(extent)


@pytest.mark.parametrize(
    ("numbers", "unit", "note"),
    [
        ((0.0, 12.0, 99.0), "m", "has values of 99, read as depths; if they stand for none, declare them"),
        ((0.0, 99.0), "m", "has values of 99, read as depths"),
        ((0.0, 5.0, 99.0), "cm", ""),
        ((0.0, 60.0, 99.0), "m", ""),
        ((0.0, 5.0, 98.0), "m", ""),
    ],
)
def test_depths_of_nines_that_may_be_water_stay(tmp_path, numbers, unit, note):
    path = netcdf(tmp_path / "run.nc", {"depth": (columns(*numbers), {"units": unit})}, "f4")
    extent = read(path)
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(numbers[-1] * (0.01 if unit == "cm" else 1.0))
    assert note in said(extent)
    assert bool(note) == bool(extent.notes)


def test_a_pit_of_few_cells_stays(tmp_path):
    numbers = columns(0.0, 5.0).copy()
    numbers[..., 0, :3] = 99.0
    extent = read(netcdf(tmp_path / "run.nc", {"depth": (numbers, {"units": "m"})}, "f4"))
    assert np.nanmax(extent.steps[0].depth) == 99.0
    assert "read as depths" in said(extent)


def test_beds_and_levels_below_zero_stay(tmp_path):
    fields = {"bed_level": (columns(-1.0, -1.0, 1.0), {"units": "m"}), "water_level": (columns(0.0), {"units": "m"})}
    extent = read(netcdf(tmp_path / "run.nc", fields, "f4"))
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(1.0, abs=0.1)
    assert extent.notes == ()


def test_undeclared_fill_values_of_rasters_are_unknown(tmp_path):
    path = geotiff(tmp_path / "depth.tif", columns(9999.0, 0.5).astype("f4"))
    assert np.nanmax(read(path).steps[0].depth) == 0.5
    path = geotiff(tmp_path / "whole.tif", columns(32767, 50).astype("i2"))
    with rasterio.open(path, "r+") as file:
        file.scales, file.units = (0.01,), ("m",)
    extent = read(path)
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(0.5)
    assert "band 1 has values of 327.67, taken as unknown" in said(extent)
