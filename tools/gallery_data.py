"""Sources of the gallery's examples: drawings, maps, a model; written beside each example."""

import base64
import json
import shutil
import sys
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Final

import numpy as np

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "packages" / "vexture-evidence" / "benchmarks"), str(ROOT / "examples")]

import corpora  # noqa: E402

ICONS: Final = corpora.LUCIDE
COUNTIES: Final = corpora.Package("us-atlas", "3.0.1", "")
WORLD: Final = corpora.Package("world-atlas", "2.0.2", "")

QUICK_ICONS: Final = 60
"""Icons of a quick build, for tests."""

STAMPS: Final = 6
"""Postcards in each other's stamps."""
SMALLER: Final = 0.1
"""Side of a stamp, in sides of its postcard."""

FIRST_CITY: Final = "510"
"""Codes of the Census Bureau from here on are of cities that are no part of a county."""

TURN: Final = 360.0
"""Degrees around the earth."""


def lines_of(topology: dict[str, Any]) -> list[Any]:
    """Arcs of a TopoJSON in its own coordinates."""
    transform = topology.get("transform")
    if transform is None:
        return [np.array(arc, np.float64) for arc in topology["arcs"]]
    scale, shift = transform["scale"], transform["translate"]
    return [np.cumsum(np.array(arc, np.float64), axis=0) * scale + shift for arc in topology["arcs"]]


def rings_of(topology: dict[str, Any], geometry: dict[str, Any]) -> Iterable[list[Any]]:
    """Rings of each polygon of a geometry."""
    arcs = lines_of(topology) if "read" not in topology else topology["read"]
    topology["read"] = arcs
    polygons = {"Polygon": lambda: [geometry["arcs"]], "MultiPolygon": lambda: geometry["arcs"]}
    for polygon in polygons.get(geometry["type"], list)():
        yield [np.concatenate([arcs[one] if one >= 0 else arcs[~one][::-1] for one in ring]) for ring in polygon]


def named_counties(file: str, *, quick: bool) -> dict[str, Any]:
    """The counties of the United States with the names of their states, as TopoJSON; a quick build takes one state.

    A city that is no part of the county of its name is told from it.
    """
    topology: dict[str, Any] = json.loads((COUNTIES.installed_folder() / file).read_text(encoding="utf-8"))
    states = {one["id"]: one["properties"]["name"] for one in topology["objects"]["states"]["geometries"]}
    found = [one for one in topology["objects"]["counties"]["geometries"] if not quick or one["id"].startswith("06")]
    names = [f"{one['properties']['name']}, {states[one['id'][:2]]}" for one in found]
    count = Counter(names)
    for name, one in zip(names, found, strict=True):
        is_city = count[name] > 1 and one["id"][2:] >= FIRST_CITY
        one["properties"]["name"] = name.replace(",", " (city),", 1) if is_city else name
    topology["objects"] = {"counties": topology["objects"]["counties"] | {"geometries": found}}
    return topology


def counties(folder: Path, *, quick: bool) -> None:
    """Write the counties of the United States as GeoJSON, in Albers' projection."""
    topology = named_counties("counties-albers-10m.json", quick=quick)
    features = []
    for one in topology["objects"]["counties"]["geometries"]:
        polygons = [[(ring * (1, -1)).round(3).tolist() for ring in rings] for rings in rings_of(topology, one)]
        geometry = {"type": "MultiPolygon", "coordinates": polygons}
        features.append({"type": "Feature", "properties": one["properties"], "geometry": geometry})
    text = json.dumps({"type": "FeatureCollection", "features": features})
    (folder / "counties.geojson").write_text(text, encoding="utf-8")


def counties_in_degrees(folder: Path, *, quick: bool) -> None:
    """Write the counties in degrees as TopoJSON, and about where each of them is."""
    topology = named_counties("counties-10m.json", quick=quick)
    (folder / "counties.topojson").write_text(json.dumps(topology), encoding="utf-8")
    places = {}
    for one in topology["objects"]["counties"]["geometries"]:
        for largest in sorted((rings[0] for rings in rings_of(topology, one)), key=len)[-1:]:
            places[one["properties"]["name"]] = ((largest.min(axis=0) + largest.max(axis=0)) / 2).round(2).tolist()
    (folder / "counties.json").write_text(json.dumps(places, separators=(",", ":")), encoding="utf-8")


def countries(folder: Path, *, quick: bool) -> None:
    """Copy the countries of the world."""
    shutil.copyfile(
        WORLD.installed_folder() / f"countries-{'110m' if quick else '50m'}.json", folder / "countries.json"
    )


def unroll_ring(ring: Any) -> list[Any]:
    """A ring of the sphere, in degrees, as rings of the plane whose part from -180 to 180 is what the map shows.

    A ring that crosses the 180th meridian goes on beyond it, and comes again from the other side; one around a pole
    contains it.
    """
    ring = np.array(ring, np.float64)
    steps = np.diff(ring[:, 0])
    ring[1:, 0] = ring[0, 0] + np.cumsum(steps - TURN * np.rint(steps / TURN))
    if abs(ring[-1, 0] - ring[0, 0]) > TURN / 2:
        pole = np.copysign(TURN / 4, ring[:, 1].mean())
        ring = np.concatenate([ring, [[ring[-1, 0], pole], [ring[0, 0], pole]]])
    copies = [ring + np.array([turns * TURN, 0.0]) for turns in (-1, 0, 1)]
    return [one for one in copies if one[:, 0].min() < TURN / 2 and one[:, 0].max() > -TURN / 2]


def land(folder: Path, *, quick: bool) -> None:
    """Write the land of the earth as SVG: degrees, in a frame of all of them."""
    file = "land-110m.json" if quick else "land-50m.json"
    topology = json.loads((WORLD.installed_folder() / file).read_text(encoding="utf-8"))
    path = []
    for geometry in topology["objects"]["land"]["geometries"]:
        rings = [ring for polygon in rings_of(topology, geometry) for ring in polygon]
        for ring in (one for whole in rings for one in unroll_ring(whole)):
            path.append("M" + "L".join(f"{x:.3f} {-y:.3f}" for x, y in ring) + "Z")
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-180 -90 360 180"><path d="{"".join(path)}"/></svg>'
    (folder / "land.svg").write_text(svg, encoding="utf-8")


def icons(folder: Path, *, quick: bool) -> None:
    """Copy the icons of Lucide, with their licence."""
    (folder / "lucide").mkdir(exist_ok=True)
    files = ICONS.all()
    for file in files[:: len(files) // QUICK_ICONS] if quick else files:
        shutil.copyfile(file, folder / "lucide" / file.name)


def drawing(name: str) -> Callable[..., None]:
    """Copy a drawing of the gallery or of examples/shapes."""

    def copy_file(folder: Path, *, quick: bool) -> None:
        found = [ROOT / "gallery" / "drawings" / name, ROOT / "examples" / "shapes" / name]
        shutil.copyfile(next(file for file in found if file.is_file()), folder / name)

    return copy_file


def postcard(folder: Path, *, quick: bool) -> None:
    """Write a postcard whose stamp is the same postcard, and so on, each a group ten times as small."""
    card = (ROOT / "gallery" / "drawings" / "postcard.svg").read_text(encoding="utf-8")
    inner = card[card.index(">") + 1 : card.rindex("</svg>")]
    start = card[: card.index(">") + 1]
    left, top, side = 3.0, 87.0, 100.0 * SMALLER
    stamp = f'<g transform="translate({left} {top}) scale({side / 100})">'
    text = (inner + stamp) * (STAMPS - 1) + inner + "</g>" * (STAMPS - 1)
    (folder / "postcard.svg").write_text(f"{start}{text}</svg>", encoding="utf-8")


def flood(folder: Path, *, quick: bool) -> None:
    """Make the flood of examples/05."""
    from santa_cruz.make_flood import make_flood  # of examples/, and slow to import

    make_flood(folder)


def box(center: Any, size: Any) -> tuple[Any, Any, Any, Any]:
    """Corners, normals, texture coordinates and triangles of a box; each side shows the whole drawing, upright."""
    places, normals, coordinates, triangles = [], [], [], []
    up = np.array([0.0, 1.0, 0.0])
    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)):
        normal = np.eye(3)[axis] * sign
        above = up if axis != 1 else np.array([0.0, 0.0, -1.0]) * sign
        right = np.cross(above, normal)
        for u, v in ((0, 1), (1, 1), (1, 0), (0, 0)):  # v down, as in glTF
            corner = normal + (2 * u - 1) * right + (1 - 2 * v) * above
            places.append(center + corner * np.array(size) / 2)
            extent = np.abs([right @ size, above @ size]) / np.abs([right @ size, above @ size]).min()
            coordinates.append((np.array([u, v]) - 0.5) * extent + 0.5)
            normals.append(normal)
        first = len(places) - 4
        triangles += [first, first + 1, first + 2, first, first + 2, first + 3]
    return np.float32(places), np.float32(normals), np.float32(coordinates), np.uint16(triangles)


def wheel(center: Any, radius: float, width: float, corners: int = 32) -> tuple[Any, Any, Any, Any]:
    """A cylinder across the van, with its two ends."""
    angles = np.arange(corners + 1) * (2 * np.pi / corners)
    round_ = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    side = np.array([0, 0, width / 2])
    n = corners + 1
    places = [round_ * radius + side, round_ * radius - side, round_ * radius + side, round_ * radius - side]
    normals = [round_, round_, 0 * round_ + [0, 0, 1], 0 * round_ - [0, 0, 1]]
    triangles = []
    for k in range(corners):
        triangles += [k, n + k, n + k + 1, k, n + k + 1, k + 1]
        if 0 < k < corners - 1:
            triangles += [2 * n, 2 * n + k, 2 * n + k + 1, 3 * n, 3 * n + k + 1, 3 * n + k]
    joined = np.concatenate(places) + np.array(center)
    return np.float32(joined), np.float32(np.concatenate(normals)), np.float32(joined[:, :2]), np.uint16(triangles)


def van(folder: Path, *, quick: bool) -> None:
    """Write a delivery van as glTF: boxes and wheels."""
    parts = {
        "Cargo": (box((-0.55, 1.15, 0), (2.5, 1.7, 1.5)), (0.96, 0.94, 0.9), 0.55),
        "Cab": (box((1.2, 0.9, 0), (0.96, 1.2, 1.46)), (0.82, 0.22, 0.16), 0.4),
        "Windows": (box((1.34, 1.2, 0), (0.74, 0.42, 1.48)), (0.05, 0.08, 0.11), 0.1),
        "Bumper": (box((0.0, 0.3, 0), (3.7, 0.16, 1.52)), (0.12, 0.12, 0.13), 0.6),
    }
    for number, (x, z) in enumerate((x, z) for x in (-1.15, 1.1) for z in (-0.66, 0.66)):
        parts[f"Wheel {number}"] = (wheel((x, 0.32, z), 0.32, 0.24), (0.04, 0.04, 0.04), 0.8)
    binary, views, accessors, meshes, materials, nodes = b"", [], [], [], [], []
    for place, (name, (arrays, color, roughness)) in enumerate(parts.items()):
        for array in arrays:
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
            flat = array.ndim == 1
            bounds = {} if flat else {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
            kind = "SCALAR" if flat else f"VEC{array.shape[1]}"
            accessors.append({"bufferView": len(views) - 1, "componentType": 5123 if flat else 5126, **bounds})
            accessors[-1] |= {"count": len(array), "type": kind}
            binary += array.tobytes() + bytes(-array.nbytes % 4)
        first = 4 * place
        attributes = {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}
        meshes.append({"primitives": [{"attributes": attributes, "indices": first + 3, "material": place}]})
        surface = {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": roughness}
        materials.append({"name": name, "pbrMetallicRoughness": surface})
        nodes.append({"name": name, "mesh": place})
    uri = f"data:application/octet-stream;base64,{base64.b64encode(binary).decode()}"
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary), "uri": uri}],
    }
    (folder / "van.gltf").write_text(json.dumps(document), encoding="utf-8")


SOURCES: Final[dict[str, Callable[..., None]]] = {
    "counties.geojson": counties,
    "counties.topojson": counties_in_degrees,
    "countries.json": countries,
    "land.svg": land,
    "lucide": icons,
    "postcard.svg": postcard,
    "flood.nc": flood,
    "van.gltf": van,
    **{name: drawing(name) for name in ("logo.svg", "duck.svg", "cake.svg", "flame.svg", "ocean.svg", "thumb.svg")},
}
"""What writes each file that a command of gallery.toml reads: given the folder, and whether it is a quick build."""
