"""The guide for coastal data, read to its end on small files: it does what it says, as it stands there."""

from pathlib import Path

import numpy as np
import pyogrio
import pytest
import xarray
from floods import BOUNDS, CRS, depths, geotiff, scene_of, sea, series, wkt

import vexture
from guides import GUIDES, Reader, blocks_of, free_port
from vexture.texture.load import texture_from


def map_file(path: Path) -> Path:
    """What D-Flow FM writes: depths and levels of the bed on the faces of a mesh, at two times."""
    columns, rows = 24, 12
    west, south, east, north = BOUNDS
    x, y = np.meshgrid(np.linspace(west, east, columns + 1), np.linspace(south, north, rows + 1))
    node = np.arange(x.size).reshape(x.shape)
    faces = np.stack([part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1])], axis=1)
    bed = -2.0 + 4.0 * (x.ravel()[faces].mean(axis=1) - west) / (east - west)
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": 2,
        "node_coordinates": "mesh2d_node_x mesh2d_node_y",
        "face_node_connectivity": "mesh2d_face_nodes",
        "face_dimension": "mesh2d_nFaces",
        "node_dimension": "mesh2d_nNodes",
    }
    on_faces = {"mesh": "mesh2d", "location": "face", "grid_mapping": "projected_coordinate_system", "units": "m"}
    faces_of = ("mesh2d_nFaces",)
    data = {
        "mesh2d": ((), 0, topology),
        "projected_coordinate_system": ((), 0, {"crs_wkt": wkt()}),
        "mesh2d_node_x": ("mesh2d_nNodes", x.ravel(), {"standard_name": "projection_x_coordinate", "units": "m"}),
        "mesh2d_node_y": ("mesh2d_nNodes", y.ravel(), {"standard_name": "projection_y_coordinate", "units": "m"}),
        "mesh2d_face_nodes": (("mesh2d_nFaces", "mesh2d_nMax_face_nodes"), faces + 1, {"start_index": 1}),
        "mesh2d_waterdepth": (("time", *faces_of), np.maximum([[0.0], [0.7]] - bed, 0.0), on_faces),
        "mesh2d_flowelem_bl": (faces_of, bed, on_faces),
        "time": ("time", [0.0, 3600.0], {"units": "seconds since 2026-02-14 00:00:00 +00:00"}),
    }
    xarray.Dataset(data).to_netcdf(path)
    return path


def geopackage(path: Path) -> Path:
    _, _, geometry, _ = pyogrio.raw.read(sea(path.with_suffix(".geojson")))
    pyogrio.raw.write(path, geometry, [], [], geometry_type="Polygon", crs=CRS, driver="GPKG")
    return path


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.usefixtures("page_is_built")
def test_the_guide_for_coastal_data_does_what_it_says(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    map_file(folder / "fm_map.nc")
    series(folder / "depth.nc", [0.4, 0.5, 0.6])
    geopackage(folder / "extents.gpkg")
    geotiff(folder / "now.tif", depths(0.5))
    geotiff(folder / "next.tif", depths(0.7))
    geotiff(folder / "aerial.tif", np.full((3, 20, 40), 90, np.uint8))
    series(folder / "run_map.nc", [0.4, 0.5])
    with Reader(folder, {"8000": free_port(), "8001": free_port()}) as reader:
        for block in blocks_of("coastal-data"):
            reader.take(block)
            if "vexture push" in block.text:
                assert "version" in reader.said
    steps = {name: scene_of(folder / f"{name}.html")["flood"]["steps"] for name in ("run", "surge", "extent")}
    assert {name: len(each) for name, each in steps.items()} == {"run": 2, "surge": 3, "extent": 1}
    assert steps["run"][1]["facts"]["time"] == "2026-02-14T01:00:00+00:00"
    surge = scene_of(folder / "surge.html")["flood"]
    assert surge["title"] == "A surge"
    assert not any("drawn" in note for note in surge["notes"]), "the ground is not the picture that was given"
    assert vexture.fold_from((folder / "surge.fold.ktx2").read_bytes()).cycle == 6.0
    texture = texture_from((folder / "surge.ktx2").read_bytes(), "surge")
    assert [bool(texture.contains([(0.55, 0.5)], root)[0]) for root in range(3)] == [False, False, True]


def test_the_trouble_that_the_guide_quotes_is_what_is_said(tmp_path: Path) -> None:
    text = (GUIDES / "coastal-data.md").read_text(encoding="utf-8")
    with pytest.raises(vexture.SourceError, match="it names no reference system of its coordinates") as caught:
        vexture.read_extent(geotiff(tmp_path / "nowhere.tif", depths(), crs=None))
    assert "it names no reference system of its coordinates" in text
    assert "`crs` EPSG:" in str(caught.value)
