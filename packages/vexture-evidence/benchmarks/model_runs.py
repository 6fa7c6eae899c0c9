"""Synthetic output of flood models: an estuary on a mesh, whole or in partitions like those of D-Flow FM."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import netCDF4
import numpy as np
from numpy.typing import NDArray

EPSG: Final = 28992
CORNER: Final = (100_000.0, 400_000.0)
EDGE: Final = 20.0
"""Metres, of a face."""

JITTER: Final = 0.2
"""Edges by which nodes are off a regular grid."""

TRIANGLES: Final = 0.2
"""Share of the cells of the grid that are two triangles: a third of the faces."""

RANGE: Final = (-0.5, 2.5)
"""Metres: lowest and highest water of a run."""

DELAY: Final = 20_000.0
"""Metres in which the tide is later by a radian."""

FILL: Final = -999


class Mesh(NamedTuple):
    """Places of nodes, (n, 2); numbers of the nodes of faces from 0, (m, 4), -1 as the last of a triangle.

    Heights of the bed are of nodes and of faces.
    """

    nodes: NDArray[np.float64]
    faces: NDArray[np.int64]
    node_bed: NDArray[np.float64]
    face_bed: NDArray[np.float64]

    def part(self, chosen: NDArray[np.bool_]) -> "Mesh":
        """Some faces, with their nodes numbered again."""
        faces = self.faces[chosen]
        used, numbers = np.unique(faces[faces >= 0], return_inverse=True)
        numbered = np.full(faces.shape, -1)
        numbered[faces >= 0] = numbers
        return Mesh(self.nodes[used], numbered, self.node_bed[used], self.face_bed[chosen])


def estuary(faces: int, seed: int) -> Mesh:
    """A mesh of about `faces` faces: a sea in the west, a channel that winds inland, flats with hollows and dikes."""
    random = np.random.default_rng(seed)
    side = max(2, round(np.sqrt(faces / (1.0 + TRIANGLES))))
    row, column = np.mgrid[0 : side + 1, 0 : side + 1]
    place = np.stack([column, row], axis=-1).astype(np.float64)
    place[1:-1, 1:-1] += random.uniform(-JITTER, JITTER, (side - 1, side - 1, 2))
    node = np.arange((side + 1) ** 2).reshape(side + 1, side + 1)
    quads = np.stack([node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]], axis=-1).reshape(-1, 4)
    split = random.uniform(size=len(quads)) < TRIANGLES
    a, b, c, d = quads[split].T
    none = np.full(len(a), -1)
    cut = np.stack([np.stack([a, b, c, none], axis=1), np.stack([a, c, d, none], axis=1)], axis=1).reshape(-1, 4)
    made = np.concatenate([quads[~split], cut])
    order = np.argsort(np.concatenate([np.flatnonzero(~split), np.repeat(np.flatnonzero(split), 2)]), kind="stable")
    made = made[order]
    nodes = place.reshape(-1, 2)
    bed = _bed(nodes / side, random)
    count = (made >= 0).sum(axis=1)
    face_bed = np.where(made >= 0, bed[made], 0.0).sum(axis=1) / count
    return Mesh(nodes * EDGE + CORNER, made, bed, face_bed)


def _bed(place: NDArray[np.float64], random: np.random.Generator) -> NDArray[np.float64]:
    """Heights of the bed in metres at places of the unit square."""
    x, y = place.T
    height = 6.0 * (x - 0.35)
    channel = np.abs(y - 0.5 - 0.15 * np.sin(9.0 * x)) / 0.03
    height -= 5.0 * (1.2 - x) * np.exp(-(channel**2))
    for octave in range(7):
        waves = random.normal(size=(6, 2)) * 2.0 * np.pi * 1.7**octave
        phases = random.uniform(0.0, 2.0 * np.pi, 6)
        height += 0.35 * 0.62**octave * np.sin(place @ waves.T + phases).sum(axis=1)
    return np.asarray(height)


def _levels(mesh: Mesh, middles: NDArray[np.float64], steps: int) -> Any:
    """Level of the water on all faces at each step in turn; it is below the bed where it is dry."""
    along = (middles[:, 0] - CORNER[0]) / DELAY
    low, high = RANGE
    for step in range(steps):
        tide = 0.5 - 0.5 * np.cos(2.0 * np.pi * (step + 0.5) / steps - along)
        yield np.maximum(low + (high - low) * tide, mesh.face_bed)


def write_run(path: Path, mesh: Mesh, steps: int, depth: bool = True, **more: NDArray[np.int64]) -> Path:
    """Write a map file; `more` are numbers of the faces by their names. Without depths, it has levels and the bed."""
    count = (mesh.faces >= 0).sum(axis=1)
    middles = np.where((mesh.faces >= 0)[..., None], mesh.nodes[mesh.faces], 0.0).sum(axis=1) / count[:, None]
    with netCDF4.Dataset(path, "w") as file:
        sizes = {"mesh2d_nNodes": len(mesh.nodes), "mesh2d_nFaces": len(mesh.faces), "mesh2d_nMax_face_nodes": 4}
        for name, size in {**sizes, "time": None}.items():
            file.createDimension(name, size)
        topology = file.createVariable("mesh2d", "i4")
        topology.setncatts(
            {
                "cf_role": "mesh_topology",
                "topology_dimension": 2,
                "node_coordinates": "mesh2d_node_x mesh2d_node_y",
                "face_node_connectivity": "mesh2d_face_nodes",
                "face_dimension": "mesh2d_nFaces",
                "node_dimension": "mesh2d_nNodes",
                "face_coordinates": "mesh2d_face_x mesh2d_face_y",
            }
        )
        system = file.createVariable("projected_coordinate_system", "i4")
        system.epsg = EPSG
        for axis, name in enumerate("xy"):
            about = {"units": "m", "standard_name": f"projection_{name}_coordinate"}
            _write_variable(file, f"mesh2d_node_{name}", ("mesh2d_nNodes",), mesh.nodes[:, axis], about)
            _write_variable(file, f"mesh2d_face_{name}", ("mesh2d_nFaces",), middles[:, axis], about)
        nodes = np.where(mesh.faces >= 0, mesh.faces + 1, FILL)
        corners = file.createVariable(
            "mesh2d_face_nodes", "i4", ("mesh2d_nFaces", "mesh2d_nMax_face_nodes"), fill_value=FILL
        )
        corners.setncatts({"cf_role": "face_node_connectivity", "start_index": np.int32(1)})
        corners[:] = nodes
        on_nodes, on_faces = ({"mesh": "mesh2d", "location": place} for place in ("node", "face"))
        bed = {"standard_name": "altitude", "units": "m"}
        _write_variable(file, "mesh2d_node_z", ("mesh2d_nNodes",), mesh.node_bed, {**bed, **on_nodes})
        _write_variable(file, "mesh2d_flowelem_bl", ("mesh2d_nFaces",), mesh.face_bed, {**bed, **on_faces})
        for name, values in more.items():
            _write_variable(file, name, ("mesh2d_nFaces",), values.astype(np.int32), on_faces)
        when = file.createVariable("time", "f8", ("time",))
        when.units = "seconds since 2026-01-01 00:00:00 +00:00"
        when[:] = 600.0 * np.arange(steps)
        name = "mesh2d_waterdepth" if depth else "mesh2d_s1"
        standard = "sea_floor_depth_below_sea_surface" if depth else "sea_surface_height"
        water = file.createVariable(name, "f8", ("time", "mesh2d_nFaces"), chunksizes=(1, len(mesh.faces)))
        water.setncatts({"standard_name": standard, "units": "m", **on_faces})
        for step, level in enumerate(_levels(mesh, middles, steps)):
            water[step] = level - mesh.face_bed if depth else level
    return path


def _write_variable(
    file: Any, name: str, dimensions: Sequence[str], values: NDArray[Any], about: dict[str, str]
) -> None:
    variable = file.createVariable(name, "i4" if values.dtype.kind == "i" else "f8", dimensions)
    variable.setncatts(about)
    variable[:] = values


def write_partitions(folder: Path, mesh: Mesh, steps: int, count: int, depth: bool = True) -> list[Path]:
    """Write a run as `count` map files, each with the faces of others that touch its own; return their paths."""
    used = mesh.faces >= 0
    across = np.where(used, mesh.nodes[mesh.faces, 0], 0.0).sum(axis=1) / used.sum(axis=1)
    up = np.where(used, mesh.nodes[mesh.faces, 1], 0.0).sum(axis=1) / used.sum(axis=1)
    turned = across + 0.5 * up
    edges = np.quantile(turned, np.arange(1, count) / count)
    domain = np.searchsorted(edges, turned, side="right")
    paths = []
    for number in range(count):
        own = domain == number
        touched = np.zeros(len(mesh.nodes), np.bool_)
        touched[mesh.faces[own][used[own]]] = True
        kept = (touched[mesh.faces] & used).any(axis=1)
        paths.append(
            write_run(
                folder / f"run_{number:04d}_map.nc",
                mesh.part(kept),
                steps,
                depth,
                mesh2d_flowelem_domain=domain[kept],
                mesh2d_flowelem_globalnr=np.flatnonzero(kept) + 1,
            )
        )
    return paths
