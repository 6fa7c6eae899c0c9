"""The accuracy and cost of planar maps beside stacked layers.

    python packages/vexture-evidence/benchmarks/colours.py [--quick] [--seed 1]

Truth is the exact colour of each pixel (`vexture.renderers.exact`). Errors are of premultiplied RGBA, in 1/255, over
all pixels of a picture: means over a set's drawings, and the largest of any. *turned* is by 30 degrees; *sheared* are
pixels that are six times as long as wide, at 45 degrees. The second table has the texels of the textures, and the CPU
time from a drawing to its texture: map and layers take turns, and a figure is the median of the turns.
"""

import argparse
import statistics
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path as File
from typing import Any, Final, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

import corpora
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture import window
from vexture.base.errors import SourceError, SourceWarning
from vexture.base.tolerance import ROUND
from vexture.bezier.convert import ellipse_cubics
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import Conversion, run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.renderers.exact import render_exact_colours
from vexture.renderers.view import ViewLike
from vexture.svg.read import read_svg, svg_drawing
from vexture_evidence.measures.machine import machine_facts, machine_line

FLAGS: Final = 30
TURNS: Final = 5
SPHERES, SHADED_FLAGS, CLIP_ART = "spheres", "flags with gradients", "clip art"
"""Names of the sets whose faces are not flat: other targets hold for the last, drawn by people."""

CLIP_ARTS: Final = 100
MOST_SEGMENTS: Final = 6000
"""Cubics of a clip art: the truth of more takes minutes."""

FAR_OFF, TOO_MANY = 40.0, 0.005
"""A picture is wrong if this share of its pixels is off by more, in 1/255."""

LARGE: Final = 100
"""Pixels across the largest picture of a large map: its truth takes minutes."""


class ColourSet(NamedTuple):
    """Drawings that share a row."""

    name: str
    drawings: Sequence[Drawing]
    is_large: bool = False


class ViewCase(NamedTuple):
    """A picture of a drawing: its pixels across, and its view."""

    name: str
    size: int
    view: Callable[[int], ViewLike]


def sheared_pixels(size: int) -> NDArray[np.float64]:
    """Pixels of the same area as upright ones, six times as long as wide, at 45 degrees."""
    long, short = 6.0**0.5 / size / 2.0**0.5, 6.0**-0.5 / size / 2.0**0.5
    steps = np.array([[long, -short], [long, short]])
    return np.column_stack([steps, 0.5 - steps @ [size / 2, size / 2]])


CASES: Final = (
    *(ViewCase(f"{size} px", size, lambda _: None) for size in (4, 16, 64, 256, 20, 100)),
    ViewCase("64 px, turned", 64, lambda _: window(0.0, 0.0, 1.0, 1.0, 30.0)),
    ViewCase("64 px, sheared", 64, sheared_pixels),
)
IN_STEP: Final = ("16 px", "64 px", "256 px")
"""Pictures whose pixels are cells; the others are not."""


def polygon(corners: NDArray[np.float64], paint: Paint) -> Path:
    return Path(Drawing.polygon(map(tuple, corners.tolist())).paths[0].contours, paint=paint)


def choropleth(cells: int, seed: int) -> Drawing:
    """Voronoi cells of random points, in random colours."""
    rng = np.random.default_rng(seed)
    frame = shapely.box(0.0, 0.0, 1.0, 1.0)
    found = shapely.voronoi_polygons(shapely.MultiPoint(rng.random((cells, 2))), extend_to=frame).geoms
    rings = [np.clip(np.array(one.intersection(frame).exterior.coords)[:-1], 0.0, 1.0) for one in found]
    paints = [Paint(tuple((rng.integers(0, 256, 3) / 255.0).tolist())) for _ in rings]
    return Drawing(tuple(map(polygon, rings, paints)), name=f"Voronoi {cells:,}")


def checkerboard(squares: int = 7) -> Drawing:
    """Squares of two colours; the borders of seven do not coincide with those of cells."""
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    places = [(x, y) for x in range(squares) for y in range(squares)]
    paths = (polygon((corners + place) / squares, Paint((sum(place) % 2,) * 3)) for place in places)
    return Drawing(tuple(paths), name="checkerboard")


def discs(count: int, seed: int) -> Drawing:
    """Translucent circles anywhere."""
    rng = np.random.default_rng(seed)
    paths = []
    for _ in range(count):
        radius, middle = rng.uniform(0.02, 0.15), rng.uniform(0.15, 0.85, 2)
        circle = ellipse_cubics(tuple(middle.tolist()), (radius, radius), ROUND)
        paths.append(Path((circle,), paint=Paint(tuple(rng.random(3).tolist()), 0.5)))
    return Drawing(tuple(paths), name=f"{count} discs")


def spheres(count: int, seed: int) -> Drawing:
    """A background, and discs with gradients of all kinds, every other one of them translucent."""
    rng = np.random.default_rng(seed)
    square = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]).paths[0].contours
    paths = [Path(square, paint=Paint.from_gradient(random_gradient(rng, np.array([0.5, 0.5]), 0.7, 1.0)))]
    for k in range(count):
        radius, middle = rng.uniform(0.05, 0.25), rng.uniform(0.25, 0.75, 2)
        circle = ellipse_cubics(tuple(middle.tolist()), (radius, radius), ROUND)
        opacity = 1.0 if k % 2 else 0.6
        paths.append(Path((circle,), paint=Paint.from_gradient(random_gradient(rng, middle, radius, opacity))))
    return Drawing(tuple(paths), name=f"{count} spheres")


def random_gradient(rng: np.random.Generator, middle: NDArray[np.float64], radius: float, opacity: float) -> Gradient:
    """Linear or radial, of two to four stops, about a circle; one in three radial ones with another focal point."""
    turn = rng.uniform(0.0, 2.0 * np.pi)
    rows = np.array([(np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))]) / radius
    moved = -rows @ middle
    to_ramp = (*rows[0].tolist(), float(moved[0])), (*rows[1].tolist(), float(moved[1]))
    offsets = np.sort(rng.random(rng.integers(2, 5))).tolist()
    stops = tuple(Stop(at, tuple(rng.random(3).tolist()), opacity) for at in offsets)
    is_radial, focus = rng.random() < 0.5, (float(rng.choice([0.0, 0.0, 0.6])), 0.0)
    return Gradient(to_ramp, stops, Spread(int(rng.integers(3))), focus if is_radial else None)


def clip_art(count: int, seed: int) -> list[Drawing]:
    """Drawings with gradients and without notes: a third each of devicon, tango and openclipart."""
    devicons = sorted((corpora.DEVICON.installed_folder() / corpora.DEVICON.folder).rglob("*.svg"))
    sources = (devicons, corpora.TANGO.files("*.svg"), corpora.OPENCLIPART.files("*.svg"))
    shares = np.diff(np.linspace(0, count, len(sources) + 1).round().astype(int)).tolist()
    return [
        drawing
        for files, share in zip(sources, shares, strict=True)
        for drawing in gradient_drawings(files, share, seed)
    ]


def gradient_drawings(files: Sequence[File], count: int, seed: int) -> list[Drawing]:
    """Choose `count` drawings with gradients at random from files."""
    found: list[Drawing] = []
    for file in np.random.default_rng(seed).permutation(files).tolist():
        if len(found) == count:
            break
        if b"Gradient" not in file.read_bytes():
            continue
        try:
            drawing = svg_drawing(file.read_bytes(), file.name)
        except SourceError:
            continue
        if not is_flat(drawing) and not drawing.notes and drawing.segments <= MOST_SEGMENTS:
            found.append(drawing)
    return found


def is_flat(drawing: Drawing) -> bool:
    """Whether a drawing has no gradients."""
    return all(path.paint.gradient is None for path in drawing.paths)


def flags(count: int, seed: int) -> list[Drawing]:
    """Square flags."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return [read_svg(file) for file in corpora.flags(count, seed)]


def sets(quick: bool, seed: int) -> Iterator[ColourSet]:
    """All sets that are measured."""
    chosen = flags(3 if quick else FLAGS, seed)
    yield ColourSet("flags", [flag for flag in chosen if is_flat(flag)])
    if not quick:
        yield ColourSet(SHADED_FLAGS, [flag for flag in chosen if not is_flat(flag)])
    yield ColourSet("checkerboard", [checkerboard()])
    yield ColourSet("discs", [discs(40 if quick else 300, seed)])
    yield ColourSet(SPHERES, [spheres(4 if quick else 12, seed + k) for k in range(1 if quick else 8)])
    yield ColourSet(CLIP_ART, clip_art(5 if quick else CLIP_ARTS, seed), is_large=True)
    yield ColourSet("Voronoi 2,000", [choropleth(100 if quick else 2000, seed)])
    if not quick:
        yield ColourSet("Voronoi 20,000", [choropleth(20_000, seed)], is_large=True)


def turn(drawing: Drawing, split: str) -> tuple[float, Conversion[Any]]:
    """CPU seconds of a conversion, and the conversion."""
    start = time.process_time()
    made = run(drawing, Parameters(split=split))
    return time.process_time() - start, made


def errors(texture: Any, drawing: Drawing, case: ViewCase) -> tuple[float, float, bool]:
    """Mean and largest error of a picture, in 1/255, and whether it is wrong: too many pixels are far off."""
    view = case.view(case.size)
    error = 255.0 * abs(texture.render(case.size, view) - render_exact_colours(drawing, case.size, view))
    is_wrong = (error.max(axis=2) > FAR_OFF).mean() >= TOO_MANY
    return float(error.mean()), float(error.max()), bool(is_wrong)


def set_facts(one: ColourSet, turns: int) -> dict[str, Any]:
    """All figures of a set."""
    seconds: dict[str, list[float]] = {"faces": [], "paint": []}
    made: dict[str, list[Any]] = {}
    for _ in range(turns):
        for split, taken in seconds.items():
            done = [turn(drawing, split) for drawing in one.drawings]
            taken.append(sum(spent for spent, _ in done))
            made[split] = [conversion.texture for _, conversion in done]
    facts: dict[str, Any] = {
        "name": one.name,
        "paths": sum(len(drawing.paths) for drawing in one.drawings),
        "maps": sum(len(texture.roots) for texture in made["faces"]),
        "seconds": {split: statistics.median(taken) for split, taken in seconds.items()},
        "texels": {split: sum(texture.info()["texels"] for texture in textures) for split, textures in made.items()},
        "errors": {},
    }
    for case in CASES:
        if one.is_large and case.size > LARGE:
            continue
        facts["errors"][case.name] = {}
        for split in seconds if case.name in IN_STEP[:2] and not one.is_large else ("faces",):
            found = [errors(*pair, case) for pair in zip(made[split], one.drawings, strict=True)]
            means, most, wrong = zip(*found, strict=True)
            measured = {"mean": statistics.fmean(means), "most": max(most), "wrong": statistics.fmean(wrong)}
            facts["errors"][case.name][split] = measured
    return facts


def error_table(facts: Sequence[dict[str, Any]]) -> str:
    rows = []
    for one in facts:
        for case, found in one["errors"].items():
            layers = found.get("paint", {})
            row = [found["faces"]["mean"], found["faces"]["most"], layers.get("mean"), layers.get("most")]
            rows.append([one["name"], case, *(cell(value, 3 - k % 2) for k, value in enumerate(row))])
    return table(("set", "picture", "map", "largest", "layers", "largest"), rows)


def cost_table(facts: Sequence[dict[str, Any]]) -> str:
    rows = []
    for one in facts:
        texels, seconds = one["texels"], one["seconds"]
        rows.append(
            [
                *(one["name"], str(one["paths"]), str(one["maps"])),
                *(str(texels["faces"]), str(texels["paint"]), cell(texels["faces"] / texels["paint"])),
                *(cell(1000 * seconds["faces"], 1), cell(1000 * seconds["paint"], 1)),
                cell(seconds["faces"] / seconds["paint"]),
            ]
        )
    head = ("set", "paths", "maps", "texels", "of layers", "ratio", "ms", "of layers", "ratio")
    return table(head, rows)


def targets(facts: Sequence[dict[str, Any]]) -> list[Target]:
    """Targets for planar maps."""
    flat = [
        (case, found["faces"])
        for one in facts
        if one["name"] not in (SPHERES, SHADED_FLAGS, CLIP_ART)
        for case, found in one["errors"].items()
    ]
    in_step = [found for case, found in flat if case in IN_STEP]
    others = [found for case, found in flat if case not in IN_STEP]
    shaded = {case: found["faces"] for one in facts if one["name"] == CLIP_ART for case, found in one["errors"].items()}

    def ratio(name: str, figure: str) -> float | None:
        found = [one[figure] for one in facts if one["name"].startswith(name)]
        return sum(each["faces"] for each in found) / sum(each["paint"] for each in found) if found else None

    return [
        Target("MAE at 16, 64, 256 px, worst set", max(found["mean"] for found in in_step), 0.02, 0.005),
        Target("largest pixel there", max(found["most"] for found in in_step), 4.0, 1.0),
        Target("MAE at 20, 100 px, turned, sheared, worst set", max(found["mean"] for found in others), 0.3, 0.05),
        Target("largest pixel there", max(found["most"] for found in others), 20.0, 4.0),
        *(
            Target(f"MAE of gradients at {case}", shaded[case]["mean"], required, wished)
            for case, required, wished in (("64 px", 0.1, 0.02), ("16 px", 0.4, 0.1), ("4 px", 0.8, 0.3))
        ),
        Target("files that are wrong at 64 px, gradients", shaded["64 px"]["wrong"], 0.05, 0.01),
        Target("texels over layers, flags", ratio("flags", "texels"), 1.0, 0.6),
        Target("texels over layers, Voronoi 20,000", ratio("Voronoi 20,000", "texels"), 0.9, 0.6),
        Target("conversion over layers, flags", ratio("flags", "seconds"), 1.5, 1.0),
    ]


def main() -> None:
    """Measure everything and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="fewer drawings and turns")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    run(checkerboard(), Parameters("faces")).texture.render(4)  # compiles
    run(checkerboard(), Parameters("paint"))
    facts = [set_facts(one, 1 if arguments.quick else TURNS) for one in sets(arguments.quick, arguments.seed)]
    reached, machine = targets(facts), machine_facts()
    print("\n\n".join([error_table(facts), cost_table(facts), target_table(reached), machine_line(machine)]))
    print(
        write_json("colours", {"machine": machine, **vars(arguments), "sets": facts, "targets": target_facts(reached)})
    )


if __name__ == "__main__":
    main()
