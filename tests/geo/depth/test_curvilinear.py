"""Grids whose cells have two coordinates each, as SFINCS, Delft3D-FLOW and ROMS write them, of a round lake."""

import numpy as np
import pytest
import shapely
import xarray

from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.renderers.exact import render_exact
from vexture_geo.base.crs import transform_points
from vexture_geo.depth.curvilinear import corners_of, grid_series, places_of_grid
from vexture_geo.depth.depths import read_depths
from vexture_geo.depth.netcdf import open_dataset

MIDDLE, RADIUS, SLOPE = np.array([500_400.0, 4_090_300.0]), 200.0, 0.02
CELL, COUNT = 10.0, 56
LEVELS = (-1.0, -0.5)
TIME = ("time", np.array([0.0, 3600.0]), {"units": "seconds since 2026-01-02 00:00:00", "standard_name": "time"})
FILL = -99999.0


def cone(x, y):
    """Height of the bed of a round lake: 0 at its shore."""
    return SLOPE * (np.hypot(x - MIDDLE[0], y - MIDDLE[1]) - RADIUS)


def true_area(level, hmin=0.05):
    return np.pi * (RADIUS + (level - hmin) / SLOPE) ** 2


def wet(drawing):
    """The area of a drawing and its middle, in the units of its source, of its only contour as shapely has it."""
    (contour,) = [contour for path in drawing.paths for contour in path.contours]
    t = np.linspace(0.0, 1.0, 16, endpoint=False)[:, None, None]
    p0, p1, p2, p3 = contour.transpose(1, 0, 2)
    points = (1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t * t * p2 + t**3 * p3
    points = points.transpose(1, 0, 2).reshape(-1, 2) @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    shape = shapely.Polygon(points)
    return shape.area, np.array(shape.centroid.coords[0])


def read(path, **options):
    return read_depths(path, path.name, **options)


def judge(extent, share=0.01):
    """The wet areas and the deepest place are those of the lake."""
    for step, level in zip(extent.steps, LEVELS, strict=True):
        area, middle = wet(step.drawing)
        assert area == pytest.approx(true_area(level), rel=share)
        assert np.hypot(*(middle - MIDDLE)) < 0.1 * CELL
        assert np.nanmax(step.depth) == pytest.approx(SLOPE * RADIUS + level, abs=0.2)


def places(turn=0.0, bend=0.0, count=COUNT, cell=CELL):
    """Middles of cells around the lake, (n, m), turned by degrees, and bent by a share of a cell in a cell."""
    n, m = np.mgrid[0:count, 0:count] - (count - 1) / 2
    n, m = n + bend * np.sin(m / 9.0) * count / 8, m + bend * np.cos(n / 7.0) * count / 8
    cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return MIDDLE[0] + cell * (cos * m - sin * n), MIDDLE[1] + cell * (sin * m + cos * n)


def levels_above(bed):
    """Water levels at all times, NaN where it is dry."""
    levels = np.broadcast_to(np.reshape(LEVELS, (-1, 1, 1)), (len(LEVELS), *bed.shape))
    return np.where(levels - bed > 0.01, levels, np.nan)


def sfincs(path, turn=0.0, crs=None, inactive=None, cell=CELL, **more):
    """A regular grid as SFINCS writes it: coordinates in 32 bits, corners, levels, a mask and the largest values."""
    x, y = places(turn, cell=cell)
    bed = cone(x, y)
    zs = levels_above(bed)
    mask = np.ones(x.shape, np.float32)
    if inactive is not None:
        mask[inactive] = 0.0
    about = {"coordinates": "x y", "units": "m"}
    level = {"standard_name": "sea_surface_height_above_mean_sea_level", **about}
    most = {"standard_name": "maximum of sea_surface_height_above_mean_sea_level", **about}
    corner = {"standard_name": "projection_x_coordinate", "grid_mapping": "crs"}, {"grid_mapping": "crs"}
    corner_x, corner_y = (np.pad(one, ((0, 1), (0, 1)), mode="edge") for one in (x, y))
    data = {
        "x": (("n", "m"), np.float32(x), {"standard_name": "projection_x_coordinate", "grid_mapping": "crs"}),
        "y": (("n", "m"), np.float32(y), {"standard_name": "projection_y_coordinate", "grid_mapping": "crs"}),
        "corner_x": (("corner_n", "corner_m"), np.float32(corner_x), corner[0]),
        "corner_y": (("corner_n", "corner_m"), np.float32(corner_y), corner[1]),
        "crs": crs or ((), 32610, {"EPSG": "-", "epsg_code": "EPSG:32610"}),
        "sfincsgrid": ((), 0, {"cf_role": "grid_topology", "topology_dimension": 2}),
        "msk": (("n", "m"), mask, {"standard_name": "land_binary_mask", **about}),
        "zb": (("n", "m"), np.float32(bed), {"standard_name": "altitude", **about}),
        "zs": (("time", "n", "m"), np.float32(zs), level),
        "zsmax": (("timemax", "n", "m"), np.float32(zs[-1:] + 1.0), most),
        "timemax": ("timemax", TIME[1][-1:], TIME[2]),
        **more,
    }
    dataset = xarray.Dataset(data, {"time": TIME})
    dataset.to_netcdf(path, encoding={name: {"_FillValue": FILL} for name in ("zs", "zb", "msk", "zsmax", "x", "y")})
    return path


@pytest.mark.parametrize("turn", [0.0, 30.0, 117.0])
def test_sfincs(tmp_path, turn):
    extent = read(sfincs(tmp_path / "sfincs_map.nc", turn))
    assert extent.frame.crs == "EPSG:32610"
    assert [step.time.hour for step in extent.steps] == [0, 1]
    judge(extent)
    known = np.isfinite(extent.bed)
    assert known.all() if turn == 0.0 else 0.5 < known.mean() < 0.9
    side = (extent.frame.bounds[2] - extent.frame.bounds[0]) / (COUNT * CELL)
    cos, sin = abs(np.cos(np.radians(turn))), abs(np.sin(np.radians(turn)))
    assert side == pytest.approx(cos + sin, rel=0.01)


@pytest.mark.parametrize(("turn", "cell"), [(0.0, CELL), (30.0, CELL), (30.0, 2.0)])
def test_a_regular_grid_is_rows_and_columns_however_it_is_turned(tmp_path, turn, cell):
    """It is read as a raster, for a fraction of a mesh's cost, and the rounding to a quarter of a metre is undone."""
    with open_dataset(sfincs(tmp_path / "map.nc", turn, cell=cell), None) as dataset:
        series = grid_series(dataset, places_of_grid(dataset, None), None, None, Notes())
    n, m = np.mgrid[0:COUNT, 0:COUNT]
    found = series.lattice.place(np.column_stack([m.ravel(), n.ravel()]).astype(float))
    np.testing.assert_allclose(found, np.column_stack([one.ravel() for one in places(turn, cell=cell)]), atol=0.05)


def test_sfincs_with_depths_reads_them_and_not_the_largest(tmp_path):
    x, y = places()
    depth = np.nan_to_num(levels_above(cone(x, y)) - cone(x, y))
    h = (("time", "n", "m"), depth, {"standard_name": "depth", "coordinates": "x y"})
    hmax = (("time", "n", "m"), depth + 1.0, {"coordinates": "x y"})
    judge(read(sfincs(tmp_path / "map.nc", h=h, hmax=hmax)))


def test_the_largest_level_of_a_run_is_above_the_bed_too(tmp_path):
    path = sfincs(tmp_path / "map.nc")
    (step,) = read(path, variable="zsmax").steps
    assert np.nanmax(step.depth) == pytest.approx(SLOPE * RADIUS + LEVELS[-1] + 1.0, abs=0.2)


def test_cells_that_a_model_has_not_are_dry(tmp_path):
    """Also those with values, here of a lake that is cut off by the mask."""
    west = np.s_[:, : COUNT // 2]
    extent = read(sfincs(tmp_path / "map.nc", inactive=west))
    for step, level in zip(extent.steps, LEVELS, strict=True):
        assert wet(step.drawing)[0] == pytest.approx(true_area(level) / 2, rel=0.02)


@pytest.mark.parametrize(
    ("about", "value", "found"),
    [
        ({"EPSG": "-", "epsg_code": "EPSG:"}, 32610, "EPSG:32610"),
        ({"epsg": 32610}, 0, "EPSG:32610"),
        ({"EPSG": "EPSG:28992"}, 1, "EPSG:28992"),
        ({"EPSG": "-"}, 1, None),
    ],
)
def test_reference_systems_as_sfincs_writes_them(tmp_path, about, value, found):
    path = sfincs(tmp_path / "map.nc", crs=((), value, about))
    if found is None:
        with pytest.raises(SourceError, match="it names no reference system"):
            read(path)
    else:
        assert read(path).frame.crs == found


def test_sfincs_on_a_quadtree(tmp_path):
    """Cells of two sizes, the finer ones around the lake's south-west."""
    nodes, faces = [], []
    for row in range(COUNT // 2):
        for column in range(COUNT // 2):
            parts = 2 if row < COUNT // 4 and column < COUNT // 4 else 1
            size = 2 * CELL / parts
            for r in range(parts):
                for c in range(parts):
                    west, south = column * 2 * CELL + c * size, row * 2 * CELL + r * size
                    faces.append(range(len(nodes), len(nodes) + 4))
                    nodes += [(west, south), (west + size, south), (west + size, south + size), (west, south + size)]
    nodes, faces = np.array(nodes) - COUNT * CELL / 2 + MIDDLE, np.array(faces)
    nodes, numbers = np.unique(nodes, axis=0, return_inverse=True)
    faces = numbers.ravel()[faces]
    bed = cone(*nodes[faces].mean(axis=1).T)
    zs = np.where(np.array(LEVELS)[:, None] - bed > 0.01, np.array(LEVELS)[:, None], np.nan)
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "mesh2d_node_x mesh2d_node_y"}
    topology |= {"face_node_connectivity": "mesh2d_face_nodes", "face_dimension": "nmesh2d_face"}
    data = {
        "mesh2d": ((), 0, topology),
        "mesh2d_node_x": ("nmesh2d_node", nodes[:, 0], {"standard_name": "projection_x_coordinate"}),
        "mesh2d_node_y": ("nmesh2d_node", nodes[:, 1], {"standard_name": "projection_y_coordinate"}),
        "mesh2d_face_nodes": (("nmesh2d_face", "max_nmesh2d_face_nodes"), faces + 1, {"start_index": 1}),
        "crs": ((), 32610, {"EPSG": "-"}),
        "zb": ("nmesh2d_face", bed, {"standard_name": "altitude", "mesh": "mesh2d", "location": "face"}),
        "zs": (("time", "nmesh2d_face"), zs, {"mesh": "mesh2d", "location": "face"}),
    }
    path = tmp_path / "sfincs_map.nc"
    xarray.Dataset(data, {"time": TIME}).to_netcdf(path)
    extent = read(path)
    assert extent.frame.crs == "EPSG:32610"
    judge(extent, share=0.03)


def delft3d(path, fill=0.0, bend=0.25, turned=False):
    """A grid as Delft3D-FLOW writes it: bent, without cells far from the lake, depths of the bed downwards."""
    x, y = places(turn=20.0, bend=bend)
    bed = cone(x, y)
    gone = bed > SLOPE * 60.0
    xz, yz = (np.where(gone, fill, one) for one in (x, y))
    order = ("N", "M") if turned else ("M", "N")
    s1 = np.where(gone, 0.0, np.maximum(np.reshape(LEVELS, (-1, 1, 1)), bed))
    at = {"units": "m", "coordinates": "XZ YZ"}
    data = {
        "XCOR": (("MC", "NC"), x - 5.0, {"standard_name": "projection_x_coordinate", "units": "m"}),
        "YCOR": (("MC", "NC"), y - 5.0, {"standard_name": "projection_y_coordinate", "units": "m"}),
        "XZ": (order, xz, {"standard_name": "projection_x_coordinate", "units": "m"}),
        "YZ": (order, yz, {"standard_name": "projection_y_coordinate", "units": "m"}),
        "KCS": (order, np.where(gone, 0, 1), {"long_name": "Non-active/active water-level point"}),
        "DP0": (("MC", "NC"), -bed, {"long_name": "Initial bottom depth at grid points (positive down)"}),
        "DPS0": (order, np.where(gone, -999.0, -bed), {"long_name": "Initial bottom depth at zeta points"} | at),
        "S1": (("time", *order), s1, {"long_name": "Water-level in zeta point"} | at),
        "U1": (("time", "KMAX", "MC", order[1]), np.zeros((2, 3, *x.shape)), {"units": "m/s"}),
    }
    xarray.Dataset(data, {"time": TIME}).to_netcdf(path)
    return path


@pytest.mark.parametrize("fill", [0.0, np.nan, -999.999])
def test_delft3d_flow(tmp_path, fill):
    extent = read(delft3d(tmp_path / "trim.nc", fill), crs="EPSG:32610")
    west, south, east, north = extent.frame.bounds
    assert (np.array([west, south]) > MIDDLE - 300.0).all()
    assert (np.array([east, north]) < MIDDLE + 300.0).all()
    judge(extent)


def test_delft3d_flow_without_a_reference_system_asks_for_it(tmp_path):
    with pytest.raises(SourceError, match="it names no reference system of its coordinates; give `crs`"):
        read(delft3d(tmp_path / "trim.nc"))


def roms(path, wet=True, around=0.0, bend=0.25):
    """A grid as ROMS writes it: longitude and latitude, bathymetry, and masks of land and of what is wet now."""
    x, y = places(turn=20.0, bend=bend)
    bed = cone(x, y)
    lon, lat = transform_points(np.column_stack([x.ravel(), y.ravel()]), "EPSG:32610", "EPSG:4326").T
    lon, lat = (one.reshape(x.shape) for one in (lon + around, lat))
    lon = np.where(lon > 180.0, lon - 360.0, lon)
    dry = np.reshape(LEVELS, (-1, 1, 1)) - bed < 0.1
    zeta = np.where(dry, 0.1 + bed, np.reshape(LEVELS, (-1, 1, 1)))
    land_here = bed > SLOPE * 60.0
    zeta = np.where(land_here, 1e37, zeta)
    at = ("eta_rho", "xi_rho")
    data = {
        "lon_rho": (at, lon, {"units": "degree_east", "standard_name": "longitude"}),
        "lat_rho": (at, lat, {"units": "degree_north", "standard_name": "latitude"}),
        "lon_u": (("eta_u", "xi_u"), lon[:, 1:], {"units": "degree_east"}),
        "lat_u": (("eta_u", "xi_u"), lat[:, 1:], {"units": "degree_north"}),
        "mask_rho": (at, np.where(land_here, 0.0, 1.0), {"long_name": "mask on RHO-points"}),
        "h": (at, -bed, {"long_name": "bathymetry at RHO-points", "units": "meter", "coordinates": "lon_rho lat_rho"}),
        "zeta": (("ocean_time", *at), zeta, {"units": "meter", "coordinates": "lon_rho lat_rho ocean_time"}),
        "ubar": (("ocean_time", "eta_u", "xi_u"), zeta[:, :, 1:] * 0.0, {"coordinates": "lon_u lat_u ocean_time"}),
        "eta_rho": ("eta_rho", np.arange(0.5, COUNT), {"axis": "Y"}),
        "xi_rho": ("xi_rho", np.arange(0.5, COUNT), {"axis": "X"}),
    }
    if wet:
        data["wetdry_mask_rho"] = (("ocean_time", *at), np.where(dry | land_here, 0.0, 1.0), {})
    xarray.Dataset(data, {"ocean_time": ("ocean_time", *TIME[1:])}).to_netcdf(path)
    return path


def test_roms(tmp_path):
    extent = read(roms(tmp_path / "ocean_his.nc"), hmin=0.1)
    assert extent.frame.crs == "EPSG:4326"
    assert [step.time.hour for step in extent.steps] == [0, 1]
    (x0, y0, x1, y1), (width, height) = extent.frame.box, extent.frame.metres
    for step, level in zip(extent.steps, LEVELS, strict=True):
        drawn = render_exact(step.drawing, (256, 256), [[(x1 - x0) / 256, 0, x0], [0, (y0 - y1) / 256, y1]])
        assert drawn.mean() * width * height == pytest.approx(true_area(level, 0.1), rel=0.01)
        assert np.nanmax(step.depth) == pytest.approx(SLOPE * RADIUS + level, abs=0.2)
        assert np.nanmax(extent.bed) < SLOPE * 400.0


def test_a_slightly_bent_grid_in_degrees_keeps_its_places(tmp_path):
    """Cells are off by a fifteenth of one: of degrees in 64 bits that is no rounding."""
    with open_dataset(roms(tmp_path / "ocean_his.nc", bend=0.01), None) as dataset:
        series = grid_series(dataset, places_of_grid(dataset, None), None, None, Notes())
        middles = series.nodes[series.faces].mean(axis=1)
        true = np.column_stack([dataset[name].values.ravel() for name in ("lon_rho", "lat_rho")])
    np.testing.assert_allclose(middles, true, atol=0.02 * CELL / 111_000)


def test_a_grid_across_the_antimeridian_is_whole(tmp_path):
    here = read(roms(tmp_path / "here.nc"))
    there = read(roms(tmp_path / "there.nc", around=180.0 - np.mean(here.frame.bounds[::2])))
    assert there.frame.metres == pytest.approx(here.frame.metres, rel=1e-6)
    for one, other in zip(here.steps, there.steps, strict=True):
        np.testing.assert_allclose(
            render_exact(one.drawing, (64, 64)), render_exact(other.drawing, (64, 64)), atol=2e-3
        )


def straight(path, kind):
    """The lake on rows and columns, uneven ones, with coordinates along them or for each cell, or the latter bent."""
    along = CELL * np.cumsum(0.75 + 0.5 * (np.arange(COUNT) % 3 == 1))
    x, y = along - along.mean() + MIDDLE[0], along - along.mean() + MIDDLE[1]
    xs, ys = np.meshgrid(x, y)
    bed = cone(xs, ys)
    data = {"zb": (("j", "i"), bed, {}), "zs": (("time", "j", "i"), levels_above(bed), {})}
    standard = [{"standard_name": f"projection_{axis}_coordinate", "units": "m"} for axis in "xy"]
    if kind == "rows and columns":
        data = {
            name: (tuple({"j": "y", "i": "x"}.get(d, d) for d in dims), *rest) for name, (dims, *rest) in data.items()
        }
        data |= {"x": ("x", x, standard[0]), "y": ("y", y, standard[1])}
        data |= {"lon": (("y", "x"), xs * 0.0 + 4.0, {"units": "degrees_east"})}
        data |= {"lat": (("y", "x"), ys * 0.0 + 52.0, {"units": "degrees_north"})}
        data |= {"lon_c": (("yc", "xc"), xs, {"units": "degrees_east"})}
        data |= {"lat_c": (("yc", "xc"), ys, {"units": "degrees_north"}), "angle": (("yc", "xc"), ys * 0.0, {})}
    else:
        xs = xs + (1.5 * np.sin(np.arange(COUNT))[:, None] if kind == "bent" else 0.0)
        data |= {"xc": (("j", "i"), xs, standard[0]), "yc": (("j", "i"), ys, standard[1])}
    xarray.Dataset(data, {"time": TIME}, {"epsg": 32610}).to_netcdf(path)
    return path


@pytest.mark.parametrize("kind", ["two for each cell", "bent"])
def test_coordinates_of_each_cell_give_what_those_along_rows_and_columns_give(tmp_path, kind):
    original = read(straight(tmp_path / "original.nc", "rows and columns"))
    copy = read(straight(tmp_path / "copy.nc", kind), frame=original.frame)
    judge(original)
    for one, other in zip(original.steps, copy.steps, strict=True):
        off = render_exact(one.drawing, (64, 64)) - render_exact(other.drawing, (64, 64))
        apart = np.nanmax(np.abs(one.depth - other.depth))
        assert (np.abs(off).max(), apart) < ((1e-6, 1e-6) if kind != "bent" else (0.25, 1.0))
        assert abs(off.mean()) < 2e-3


def test_bounds_of_cells_in_the_file_are_their_corners(tmp_path):
    """Cells of which the middles are not amid the corners: those of the file cover twice the width."""
    path = straight(tmp_path / "bent.nc", "bent")
    with xarray.open_dataset(path, decode_cf=False) as dataset:
        dataset = dataset.load()
    x, y = corners_of(np.stack([dataset["xc"], dataset["yc"]], axis=-1), np.ones((COUNT, COUNT), bool)).transpose(
        2, 0, 1
    )
    around = [np.s_[:-1, :-1], np.s_[:-1, 1:], np.s_[1:, 1:], np.s_[1:, :-1]]
    for key, axis in (("xc", MIDDLE[0] + 2.0 * (x - MIDDLE[0])), ("yc", y)):
        dataset[f"{key}_bnds"] = (("j", "i", "nv"), np.stack([axis[part] for part in around], axis=-1))
        dataset[key].attrs["bounds"] = f"{key}_bnds"
    dataset.to_netcdf(tmp_path / "bounds.nc")
    plain, wide = read(path), read(tmp_path / "bounds.nc")
    for one, other in zip(plain.steps, wide.steps, strict=True):
        assert wet(other.drawing)[0] == pytest.approx(2.0 * wet(one.drawing)[0], rel=0.02)


@pytest.mark.parametrize("up", [2.0, -2.0])
def test_corners_of_straight_cells_are_exact(up):
    """Also of those with neighbours on no side of one axis, where they are square, whichever way the rows run."""
    n, m = np.mgrid[0:5, 0:6].astype(float)
    known = np.ones(n.shape, bool)
    known[0, 0] = known[2, 2] = known[3, 3] = False
    found = corners_of(np.stack([100.0 + 2.0 * m, 50.0 + up * n], axis=-1), known)
    n, m = np.mgrid[0:6, 0:7] - 0.5
    true = np.stack([100.0 + 2.0 * m, 50.0 + up * n], axis=-1)
    assert np.isnan(found[0, 0]).all()
    np.testing.assert_allclose(found[np.isfinite(found[..., 0])], true[np.isfinite(found[..., 0])], atol=1e-9)


@pytest.mark.parametrize("along", [0, 1])
def test_a_channel_of_one_cell_is_as_wide_as_its_cells_are_long(along):
    n, m = np.mgrid[0:5, 0:6].astype(float)
    centres = np.stack([100.0 + 3.0 * m - n, 50.0 + m + 2.0 * n], axis=-1)
    channel = np.zeros(n.shape, bool)
    channel[(2, slice(None)) if along else (slice(None), 2)] = True
    corners = np.moveaxis(corners_of(centres, channel), along, 0)[:, 2:4]
    across, way = corners[:, 1] - corners[:, 0], np.array([(-1.0, 2.0), (3.0, 1.0)][along])
    np.testing.assert_allclose(np.hypot(*across.T), np.hypot(*way))
    np.testing.assert_allclose(across @ way, 0.0, atol=1e-9)


def test_corners_of_uneven_cells_are_between_their_middles():
    across = np.array([0.0, 8.0, 9.0, 10.0, 11.0, 19.0])
    x, y = np.meshgrid(across, across)
    found = corners_of(np.stack([x, y], axis=-1), np.ones(x.shape, bool))
    assert (found[1:-1, 1:-1, 0] > across[:-1]).all()
    assert (found[1:-1, 1:-1, 0] < across[1:]).all()


def test_coordinates_without_a_place_are_refused_in_one_line(tmp_path):
    with xarray.open_dataset(sfincs(tmp_path / "map.nc"), decode_times=False) as dataset:
        dataset.load().assign(x=dataset["x"] * np.nan).to_netcdf(tmp_path / "lost.nc")
    with pytest.raises(SourceError, match="coordinates 'x' and 'y' hold no place"):
        read(tmp_path / "lost.nc")


def test_a_bed_with_a_time_of_its_own_is_refused_in_one_line(tmp_path):
    with xarray.open_dataset(sfincs(tmp_path / "map.nc"), decode_times=False) as dataset:
        later = dataset["zb"].expand_dims({"later": 3})
        dataset.load().assign(zb=later).to_netcdf(tmp_path / "later.nc")
    with pytest.raises(SourceError, match="variable 'zb' also has the dimension 'later', which the depths have not"):
        read(tmp_path / "later.nc")
