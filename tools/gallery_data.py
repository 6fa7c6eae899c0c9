"""Sources of the gallery's examples: drawings, maps, figures, a model; written beside each example."""

import csv
import json
import shutil
import sys
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Final

import numpy as np
from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "packages" / "vexture-evidence" / "benchmarks"), str(ROOT / "examples")]

import corpora  # noqa: E402
import gallery_model  # noqa: E402

COUNTIES: Final = corpora.Package("us-atlas", "3.0.1", "")
WORLD: Final = corpora.Package("world-atlas", "2.0.2", "")
FIGURES: Final = corpora.Package("vega-datasets", "3.2.1", "data")

WEATHER: Final = ("weather-sunny", "weather-cloudy", "weather-pouring", "weather-lightning")
SYMBOLS: Final = ("cat", "pine-tree", "weather-night", *WEATHER)
"""Icons of Material Design Icons."""

FLAGS: Final = ("bt", "br", "gb-wls")
"""Flags by the codes of their countries."""

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

BEACH: Final = 0.012
"""Width of a beach, in widths of its map."""

SPECIES: Final = ("American Robin", "White-tailed Deer", "American Bullfrog", "Common Gartersnake")
"""Whose habitats there are figures of."""

EARLIER: Final = {"46102": "46113", "02158": "02270"}
"""Codes of counties of today, and those that they had in 2009."""


def fetched_folder(package: corpora.Package) -> Path:
    """Folder of the files of an npm package; what is fetched is said before."""
    if not package.home.exists():
        print(f"fetching {package.name} {package.version} by npm ...", flush=True)
    return package.installed_folder() / package.folder


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
    topology: dict[str, Any] = json.loads((fetched_folder(COUNTIES) / file).read_text(encoding="utf-8"))
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


def figures(folder: Path, *, quick: bool) -> None:
    """Write figures of each county: the rate of unemployment in 2009, and how much of it is habitat of four species."""
    data = fetched_folder(FIGURES)
    found: dict[str, dict[str, float]] = {name: {} for name in ("Unemployment, 2009", *SPECIES)}
    with (data / "unemployment.tsv").open(newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            found["Unemployment, 2009"][row["id"].zfill(5)] = float(row["rate"])
    with (data / "species.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            found[row["common_name"]][row["county_id"].zfill(5)] = float(row["habitat_yearround_pct"])
    table: dict[str, Any] = {"figures": list(found), "counties": {}}
    for one in named_counties("counties-albers-10m.json", quick=quick)["objects"]["counties"]["geometries"]:
        codes = one["id"], EARLIER.get(one["id"], "")
        shares = [next((rates[code] for code in codes if code in rates), None) for rates in found.values()]
        percents = [None if share is None else round(100 * share, 1) for share in shares]
        table["counties"][one["properties"]["name"]] = percents
    (folder / "figures.json").write_text(json.dumps(table, separators=(",", ":")), encoding="utf-8")


def coast(folder: Path, *, quick: bool) -> None:
    """Write the sea of Zeeland as SVG, and the same with a beach along it; both in a square of a width of 1000."""
    geometry = json.loads((ROOT / "examples" / "coastlines" / "zeeland.geojson").read_text(encoding="utf-8"))
    rings = [np.array(ring) for part in geometry["features"][0]["geometry"]["coordinates"] for ring in part]
    low, high = (
        np.min([ring.min(axis=0) for ring in rings], axis=0),
        np.max([ring.max(axis=0) for ring in rings], axis=0),
    )
    middle, scale = (low + high) / 2, np.array([np.cos(np.radians((low + high)[1] / 2)), -1.0])
    scale *= 1000 / ((high - low)[0] * scale[0])
    path = "".join("M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in (ring - middle) * scale) + "Z" for ring in rings)
    shore = f'fill-rule="evenodd" stroke="black" stroke-linejoin="round" stroke-width="{2000 * BEACH}"'
    for name, style in (("sea", 'fill-rule="evenodd"'), ("beach", shore)):
        text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-500 -500 1000 1000"><path {style} d="{path}"/></svg>'
        (folder / f"{name}.svg").write_text(text, encoding="utf-8")


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
    file = f"countries-{'110m' if quick else '50m'}.json"
    shutil.copyfile(fetched_folder(WORLD) / file, folder / "countries.json")


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
    topology = json.loads((fetched_folder(WORLD) / file).read_text(encoding="utf-8"))
    path = []
    for geometry in topology["objects"]["land"]["geometries"]:
        rings = [ring for polygon in rings_of(topology, geometry) for ring in polygon]
        for ring in (one for whole in rings for one in unroll_ring(whole)):
            path.append("M" + "L".join(f"{x:.3f} {-y:.3f}" for x, y in ring) + "Z")
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-180 -90 360 180"><path d="{"".join(path)}"/></svg>'
    (folder / "land.svg").write_text(svg, encoding="utf-8")


def icons(folder: Path, *, quick: bool) -> None:
    """Copy the icons of Lucide."""
    (folder / "lucide").mkdir(exist_ok=True)
    files = sorted(fetched_folder(corpora.LUCIDE).glob("*.svg"))
    for file in files[:: len(files) // QUICK_ICONS] if quick else files:
        shutil.copyfile(file, folder / "lucide" / file.name)


def drawing(name: str) -> Callable[..., None]:
    """Copy a drawing of the gallery."""

    def copy_file(folder: Path, *, quick: bool) -> None:
        shutil.copyfile(ROOT / "gallery" / "drawings" / name, folder / name)

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


def packaged(package: corpora.Package, file: str) -> Callable[..., None]:
    """Copy a drawing of an npm package."""

    def copy_file(folder: Path, *, quick: bool) -> None:
        shutil.copyfile(fetched_folder(package) / file, folder / file)

    return copy_file


def bottle(folder: Path, *, quick: bool) -> None:
    """Write a bottle with a label as glTF."""
    (folder / "bottle.gltf").write_text(json.dumps(gallery_model.bottle()), encoding="utf-8")


def subset(package: corpora.Package, file: str, name: str) -> Callable[..., None]:
    """Write a font of an npm package with the characters of the messages only, as WOFF."""

    def write_font(folder: Path, *, quick: bool) -> None:
        font = TTFont(fetched_folder(package) / file)
        messages = (ROOT / "gallery" / "drawings" / "messages.json").read_text(encoding="utf-8")
        subsetter = Subsetter(Options(layout_features=["*"], hinting=False, notdef_outline=True, drop_tables=["FFTM"]))
        subsetter.populate(text=messages)
        subsetter.subset(font)
        font.flavor = "woff"
        font.save(folder / name)

    return write_font


def latin_font(folder: Path, *, quick: bool) -> None:
    """Copy the font of the npm package vexture, with Latin, Greek and Cyrillic letters."""
    shutil.copyfile(ROOT / "web" / "fonts" / "noto-sans.woff", folder / "latin.woff")


FONTS: Final = {
    **{
        script: corpora.Package(f"@fontsource/noto-sans-{script}", "5.3.0", "files")
        for script in ("georgian", "arabic", "hebrew", "devanagari", "thai")
    },
    "korean": corpora.Package("@fontsource/gowun-dodum", "5.3.0", "files"),
    "japanese": corpora.Package("@fontsource/sawarabi-gothic", "5.3.1", "files"),
}
"""Packages with fonts of scripts."""

EMOJI: Final = corpora.Package("twemoji-colr-font", "15.0.3", "")


def font_file(package: corpora.Package, script: str) -> str:
    """Name of the file with the regular face of a script in a package of Fontsource."""
    return f"{package.name.removeprefix('@fontsource/')}-{script}-400-normal.woff"


PACKAGES: Final[dict[str, corpora.Package]] = {
    "lucide": corpora.LUCIDE,
    "counties.geojson": COUNTIES,
    "counties.topojson": COUNTIES,
    "figures.json": FIGURES,
    "land.svg": WORLD,
    "countries.json": WORLD,
    **{f"{name}.svg": corpora.MDI for name in SYMBOLS},
    **{f"{name}.svg": corpora.FLAG_ICONS for name in FLAGS},
    **{f"{script}.woff": package for script, package in FONTS.items()},
    "emoji.woff": EMOJI,
}
"""Of each source that comes from an npm package, the package."""

SOURCES: Final[dict[str, Callable[..., None]]] = {
    "counties.geojson": counties,
    "counties.topojson": counties_in_degrees,
    "figures.json": figures,
    "countries.json": countries,
    "land.svg": land,
    "lucide": icons,
    "postcard.svg": postcard,
    "flood.nc": flood,
    "coast": coast,
    "bottle.gltf": bottle,
    **{f"{name}.svg": packaged(corpora.MDI, f"{name}.svg") for name in SYMBOLS},
    **{f"{name}.svg": packaged(corpora.FLAG_ICONS, f"{name}.svg") for name in FLAGS},
    **{name: drawing(name) for name in ("logo.svg", "balloon.svg", "label.svg", "messages.json")},
    **{f"{script}.woff": subset(one, font_file(one, script), f"{script}.woff") for script, one in FONTS.items()},
    "emoji.woff": subset(EMOJI, "twemoji.woff2", "emoji.woff"),
    "latin.woff": latin_font,
}
"""What writes each file that a command of gallery.toml reads: given the folder, and whether it is a quick build."""
