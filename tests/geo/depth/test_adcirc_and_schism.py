"""Meshes of ADCIRC and SCHISM, as these models write them: a beach that falls by 1 m in 100 m, read as extents."""

from datetime import UTC, datetime

import netCDF4
import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.renderers.exact import render_exact
from vexture_geo.depth.depths import read_depths

SIDE = 9
FILL = -99999.0


def beach():
    """Places of nodes in steps of 100 m, their depths below the geoid, and triangles between them."""
    row, column = np.mgrid[0:SIDE, 0:SIDE]
    node = np.arange(SIDE**2).reshape(SIDE, SIDE)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return column.ravel() * 100.0, row.ravel() * 100.0, 4.0 - column.ravel(), triangles


def adcirc(path, variables, about_mesh, steps=2):
    """File of ADCIRC: numbers with names of dimensions, nodes counted from 1, and depths below the geoid."""
    x, y, depth, triangles = beach()
    with netCDF4.Dataset(path, "w", format="NETCDF4_CLASSIC") as file:
        for name, size in {"time": None, "node": SIDE**2, "nele": len(triangles), "nvertex": 3, "mesh": 1}.items():
            file.createDimension(name, size)
        file.createDimension("max_nvdll", 5)
        file.createVariable("max_nvdll", "i4").assignValue(5)
        file.createVariable("nbdv", "i4", ("max_nvdll",))
        about = {"x": ("longitude", "degrees_east"), "y": ("latitude", "degrees_north")}
        for name, places, middle in (("x", x, -72.0), ("y", y, 40.0)):
            axis = file.createVariable(name, "f8", ("node",))
            axis[:] = middle + places * 1e-5
            axis.standard_name, axis.units = about[name]
        file.createVariable("element", "i4", ("nele", "nvertex"))[:] = triangles + 1
        file["element"].start_index = 1
        mesh = file.createVariable("adcirc_mesh", "i4", ("mesh",))
        mesh.setncatts({**about_mesh, "node_coordinates": "x y", "face_node_connectivity": "element"})
        time = file.createVariable("time", "f8", ("time",))
        time.units = "seconds since 2008-08-23 00:00:00 UTC"
        time[:] = 3600.0 * np.arange(steps)
        bed = file.createVariable("depth", "f8", ("node",))
        bed.setncatts({"long_name": "distance  below geoid", "standard_name": "depth below geoid", "units": "m"})
        bed[:] = depth
        for name, (values, dims, standard, units) in variables.items():
            one = file.createVariable(name, "f8", dims, fill_value=FILL)
            one.setncatts({"standard_name": standard, "units": units})
            one[:] = values
    return path


def levels():
    """Levels of 0 and 1 m, and the fill value where the ground is above them."""
    *_, depth, _ = beach()
    return np.stack([np.where(depth + level > 0.0, level, FILL) for level in (0.0, 1.0)])


def wet_columns(extent):
    """Share of the frame under water at each time, in columns of nodes."""
    x0, y0, x1, y1 = np.multiply(extent.frame.box, 160.0).round().astype(int)
    return [render_exact(step.drawing, (160, 160))[y0:y1, x0:x1].mean() * (SIDE - 1) for step in extent.steps]


@pytest.mark.parametrize(
    "about_mesh", [{"cf_role": "mesh_topology", "topology_dimension": 2}, {"standard_name": "mesh_topology"}]
)
def test_water_levels_of_adcirc(tmp_path, about_mesh):
    zeta = {"zeta": (levels(), ("time", "node"), "sea_surface_height_above_geoid", "m")}
    extent = read_depths(adcirc(tmp_path / "fort.63.nc", zeta, about_mesh), "fort.63.nc")
    assert extent.frame.crs == "EPSG:4326"
    assert extent.frame.bounds == pytest.approx((-72.0, 40.0, -71.992, 40.008))
    assert [step.time for step in extent.steps] == [datetime(2008, 8, 23, hour, tzinfo=UTC) for hour in (0, 1)]
    assert wet_columns(extent) == pytest.approx([3.95, 4.95], abs=0.1)  # a depth of 5 cm is the shore
    assert [np.nanmax(step.depth) for step in extent.steps] == pytest.approx([4.0, 5.0], abs=0.05)


def test_highest_water_levels_of_adcirc(tmp_path):
    found = {
        "zeta_max": (levels()[1], ("node",), "maximum_sea_surface_height_above_geoid", "m"),
        "time_of_zeta_max": (0.0 * levels()[1], ("node",), "time_of_maximum_sea_surface_height_above_geoid", "sec"),
    }
    about = {"cf_role": "mesh_topology", "topology_dimension": 2}
    extent = read_depths(adcirc(tmp_path / "maxele.63.nc", found, about), "maxele.63.nc")
    assert wet_columns(extent) == pytest.approx([4.95], abs=0.1)
    assert np.nanmax(extent.steps[0].depth) == pytest.approx(5.0, abs=0.05)


def test_a_run_of_adcirc_without_steps_is_said_to_have_none(tmp_path):
    zeta = {"zeta": (levels()[:0], ("time", "node"), "sea_surface_height_above_geoid", "m")}
    path = adcirc(tmp_path / "fort.63.nc", zeta, {"cf_role": "mesh_topology"}, steps=0)
    with pytest.raises(SourceError, match="dimension 'time' has no steps"):
        read_depths(path, path.name)


@pytest.mark.parametrize("names", [("elevation", "dryFlagNode"), ("elev", "wetdry_node")])
def test_water_levels_of_schism(tmp_path, names):
    """Its depth is that of the bed, and counts downwards; a dry node keeps the level that it had last."""
    x, y, depth, triangles = beach()
    with netCDF4.Dataset(tmp_path / "out2d_1.nc", "w") as file:
        for name, size in {"time": 2, "node": SIDE**2, "face": len(triangles), "corner": 4, "one": 1}.items():
            file.createDimension(name, size)
        mesh = file.createVariable("SCHISM_hgrid", "i4", ("one",))
        mesh.setncatts({"cf_role": "mesh_topology", "topology_dimension": 2})
        mesh.setncatts({"node_coordinates": "node_x node_y", "face_node_connectivity": "face_nodes"})
        for name, places in (("node_x", x + 5e5), ("node_y", y + 4e6)):
            file.createVariable(name, "f8", ("node",))[:] = places
            file[name].standard_name = f"projection_{name[-1]}_coordinate"
        nodes = file.createVariable("face_nodes", "i4", ("face", "corner"), fill_value=-1)
        nodes.start_index = 1
        nodes[:] = np.pad(triangles + 1, [(0, 0), (0, 1)], constant_values=-1)
        file.createVariable("time", "f8", ("time",))[:] = [0.0, 1.0]
        file["time"].units = "hours since 2026-01-01"
        file.createVariable("depth", "f4", ("node",))[:] = depth
        file.createVariable(names[0], "f4", ("time", "node"))[:] = np.full((2, SIDE**2), 1.0)
        file.createVariable(names[1], "f4", ("time", "node"))[:] = [depth <= 0.0, depth <= -1.0]
    extent = read_depths(tmp_path / "out2d_1.nc", "out2d_1.nc", crs="EPSG:32610")
    assert wet_columns(extent) == pytest.approx([4.0, 4.95], abs=0.55)
    assert [np.nanmax(step.depth) for step in extent.steps] == pytest.approx([5.0, 5.0], abs=0.05)
    assert extent.bed is not None
    assert np.nanmax(extent.bed) == pytest.approx(4.0, abs=0.05)
