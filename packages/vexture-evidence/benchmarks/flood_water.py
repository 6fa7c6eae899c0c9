"""Gaps in the water of a flood's page: pixels of bed, sky or shards where water is visible according to the data.

    python packages/vexture-evidence/benchmarks/flood_water.py [SCENE ...] [--quick]

The four scenes of the examples, from every view of their pages, as the water is at first, at its highest and on the way
down. What must be water is found without the page: rays of its camera meet the bed and the levels of the data, cell by
cell; left out are places nearer to a shore than the page's samples of heights, and what is next to them in the picture.
There, two pictures must show water. In the flat one, of white water and black ground, all that is not white is bed,
sky or a hole. In the other, the ground well under water is magenta and the water lets nothing through: all that is
magenta is bed that is seen or mirrored.
"""

import argparse
import base64
import io
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from chromium import ROOT, chromium
from report import RESULTS, table, write_json
from santa_cruz_page import PATIENCE, content, scene_of
from targets import Target, target_facts, target_table
from vexture_evidence.measures.machine import machine_facts, machine_line

Grid = NDArray[np.float64]
Mask = NDArray[np.bool_]

SIZE: Final = (960, 540)
EACH: Final = 2
"""One pixel in so many, each way, has a ray."""

WET: Final = 0.05
"""Metres of water that count, as in the page."""

SAMPLES: Final = 256
"""Of the page's heights on its longer side."""

AWAY: Final = 1.0
"""Samples from the shore."""

BESIDE: Final = 1
"""Rays around each place that must be water, too."""

STEPS: Final = 600
HALVINGS: Final = 12
"""How a ray is followed through the box."""

MAGENTA: Final = 60
"""Of 255, by which the lesser of red and blue is above green."""

WHITE: Final = 128

DRY: Final = (86, 104, 72)
"""Colour of the ground that is not under water."""

SCENES: Final = ("coast", "river", "polder", "streets")

PAINT: Final = """async ([ground, columns, rows]) => {
    const { stage, water } = window.vexture.flood;
    const texels = Uint8ClampedArray.from(atob(ground), (letter) => letter.charCodeAt(0));
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: columns, height: rows });
    canvas.getContext('2d').putImageData(new ImageData(texels, columns, rows), 0, 0);
    const { map } = stage.land.mesh.material;
    map.image = canvas;
    map.dispose();
    map.needsUpdate = true;
    water.calm = { ...water.calm, clear: 1e-3 };
}"""

LOOK: Final = """([view, flat]) => {
    const flood = window.vexture.flood;
    const { stage } = flood;
    flood.freeze(0);
    flood.view(view, { fly: false });
    flood.flat(flat);
    stage.render();
    const picture = stage.canvas.toDataURL('image/png');  // in the task of the render: later it is gone
    const { camera } = flood;
    camera.updateMatrixWorld();
    const { places, rise, relief } = stage.surface;
    flood.flat(false);
    return {
        picture, projection: [...camera.projectionMatrix.elements], seen: [...camera.matrixWorldInverse.elements],
        width: places.width, depth: places.depth, rise, still: relief.still,
    };
}"""


class ViewCount(NamedTuple):
    """Pixels of a view at a step: those that must be water, and how many of them are not."""

    scene: str
    view: str
    step: int
    water: int
    holes: int
    bed: int

    @property
    def share(self) -> float:
        """Part of the pixels that must be water and are not."""
        return (self.holes + self.bed) / self.water if self.water else 0.0


def scene_named(name: str) -> Any:
    """A scene of the examples at three steps: the first, the highest water, and one on the way down."""
    sys.path.insert(0, str(ROOT / "examples"))
    from four_floods.make_floods import SCENES as ALL

    scene = next(make for make in ALL if make.__name__ == name)()
    wet = [float((level > scene.bed + WET).mean()) for level in scene.levels]
    highest = int(np.argmax(wet))
    return replace(scene, levels=[scene.levels[at] for at in (0, highest, (highest + len(wet) - 1) // 2)])


def page_of(scene: Any, folder: Path) -> tuple[Path, dict[str, Any]]:
    """Export the page of a scene over a plain ground; return it and its data."""
    from four_floods.make_floods import write

    from vexture_geo.flood.options import FloodOptions
    from vexture_geo.flood.server import export

    page, ground = folder / f"{scene.name}.html", folder / f"{scene.name}.png"
    Image.new("RGB", scene.bed.shape[::-1], DRY).save(ground)
    extent = write(scene, folder)
    export(FloodOptions(extent, time_dim="time", ground=ground), page, None, lambda line: None, iter)
    return page, scene_of(page)


@contextmanager
def open_page(browser: Any, page: Path) -> Iterator[Any]:
    """Open a flood's page, bare and without waves."""
    shown = browser.new_page(viewport=dict(zip(("width", "height"), SIZE, strict=True)), color_scheme="light")
    shown.set_default_timeout(PATIENCE)
    shown.goto(f"{page.as_uri()}?bare")
    shown.evaluate("vexture.flood.ready")
    shown.evaluate("vexture.flood.freeze(0)")
    try:
        yield shown
    finally:
        shown.close()


def rays(camera: dict[str, Any]) -> tuple[Grid, Grid]:
    """Starts and ends of the rays of a camera, (rows, columns, 3), from its nearest to its farthest plane."""
    projection, seen = (np.array(camera[name]).reshape(4, 4).T for name in ("projection", "seen"))
    back = np.linalg.inv(projection @ seen)
    x = (np.arange(0, SIZE[0], EACH) + 0.5) / SIZE[0] * 2.0 - 1.0
    y = 1.0 - (np.arange(0, SIZE[1], EACH) + 0.5) / SIZE[1] * 2.0
    ends = []
    for depth in (-1.0, 1.0):
        corners = np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), depth), np.ones((len(y), len(x)))], axis=-1)
        placed = corners @ back.T
        ends.append(placed[..., :3] / placed[..., 3:])
    return ends[0], ends[1]


def at(grid: NDArray[Any], s: Grid, t: Grid) -> Grid:
    """Values of a grid, bilinear, at places of the box; its southernmost row is the first."""
    rows, columns = grid.shape
    x, y = np.clip(s * columns - 0.5, 0.0, columns - 1.001), np.clip(t * rows - 0.5, 0.0, rows - 1.001)
    column, row = x.astype(int), y.astype(int)
    right, up = x - column, y - row
    low = grid[row, column] * (1.0 - right) + grid[row, column + 1] * right
    high = grid[row + 1, column] * (1.0 - right) + grid[row + 1, column + 1] * right
    return np.asarray(low * (1.0 - up) + high * up)


def must_be_water(scene: Any, step: int, camera: dict[str, Any]) -> Mask:
    """Mask of the rays that meet the water's surface, well away from any shore."""
    level, bed = scene.levels[step], scene.bed
    wet = level - bed > WET
    tops = (np.where(wet, level, bed) - camera["still"]) * camera["rise"]
    begin, end = rays(camera)
    along = end - begin
    half = np.array([camera["width"] / 2, 1e9, camera["depth"] / 2])
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = np.stack([(-half - begin) / along, (half - begin) / along])
    is_along = np.abs(along) > 0.0
    near = np.where(is_along, crossings.min(axis=0), -np.inf).max(axis=-1).clip(0.0, 1.0)
    far = np.where(is_along, crossings.max(axis=0), np.inf).min(axis=-1).clip(0.0, 1.0)
    is_over = (is_along | (np.abs(begin) < half)).all(axis=-1)

    def above(share: Grid) -> Grid:
        place = begin + along * share[..., None]
        s, t = place[..., 0] / camera["width"] + 0.5, 0.5 - place[..., 2] / camera["depth"]
        return np.asarray(place[..., 1] - at(tops, s, t))

    before, after = near.copy(), np.full(near.shape, np.nan)
    is_open = is_over & (near < far) & (above(near) > 0.0)  # else it enters through a side, or not at all
    for number in range(1, STEPS + 1):
        share = near + (far - near) * number / STEPS
        under = is_open & np.isnan(after) & (above(share) <= 0.0)
        after = np.where(under, share, after)
        before = np.where(np.isnan(after), share, before)
    met = ~np.isnan(after)
    low, high = before, np.where(met, after, before)
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        over = above(middle) > 0.0
        low, high = np.where(over, middle, low), np.where(over, high, middle)
    place = begin + along * high[..., None]
    s, t = place[..., 0] / camera["width"] + 0.5, 0.5 - place[..., 2] / camera["depth"]
    return erode(met & (at(erode(wet, reach_of(scene)).astype(float), s, t) > 0.999), BESIDE)


def reach_of(scene: Any) -> int:
    """Number of cells around each place that must also be wet."""
    return max(1, round(AWAY * max(scene.bed.shape) / SAMPLES))


def erode(mask: Mask, reach: int) -> Mask:
    """Keep what is set within a reach along both axes; values at the border continue beyond it."""
    for axis in (0, 1):
        padded = np.pad(mask, [(reach, reach) if one == axis else (0, 0) for one in (0, 1)], mode="edge")
        windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1, axis)
        mask = windows.all(axis=-1)
    return mask


def count_views(browser: Any, name: str, folder: Path, keep: Path | None = None) -> Iterator[ViewCount]:
    """Count the wrong pixels in all views of a scene at each step; `keep` is a folder for pictures of them."""
    scene = scene_named(name)
    page, data = page_of(scene, folder)
    views = ["Plan", "Overview", *(view["name"] for view in data["views"])]
    with open_page(browser, page) as shown:
        for step, level in enumerate(scene.levels):
            under = erode(level - scene.bed > WET, 2 * reach_of(scene))
            ground = np.where(under[::-1, :, None], (255, 0, 255, 255), (*DRY, 255)).astype(np.uint8)
            rows, columns = ground.shape[:2]
            shown.evaluate("(step) => vexture.flood.step(step)", step)
            shown.evaluate(PAINT, [base64.b64encode(ground.tobytes()).decode(), columns, rows])
            for view in views:
                pictures = []
                for flat in (True, False):
                    camera = shown.evaluate(LOOK, [view, flat])
                    picture = Image.open(io.BytesIO(content(camera.pop("picture")))).convert("RGB")
                    pictures.append(np.asarray(picture).astype(int)[::EACH, ::EACH])
                flat_one, real = pictures
                water = must_be_water(scene, step, camera)
                holes = water & (flat_one.min(axis=-1) < WHITE)
                bed = water & ~holes & (np.minimum(real[..., 0], real[..., 2]) - real[..., 1] > MAGENTA)
                if keep is not None:
                    marked = np.where(water[..., None], real // 2 + (0, 64, 0), real)
                    marked[holes], marked[bed] = (255, 0, 0), (255, 255, 0)
                    both = np.hstack([flat_one, real, marked]).astype(np.uint8)
                    Image.fromarray(both).save(keep / f"{name}-{view.lower().replace(' ', '-')}-{step}.png")
                yield ViewCount(name, view, step, int(water.sum()), int(holes.sum()), int(bed.sum()))


def main() -> None:
    """Measure, print a table and write the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--quick", action="store_true", help="one scene")
    arguments = parser.parse_args()
    keep = RESULTS / "flood-water"
    keep.mkdir(parents=True, exist_ok=True)
    with chromium() as browser, tempfile.TemporaryDirectory() as folder:
        names = arguments.scenes[:1] if arguments.quick else arguments.scenes
        found = [one for name in names for one in count_views(browser, name, Path(folder), keep)]
    rows = [
        [f"{one.scene}, {one.view}", str(one.step), str(one.water), str(one.holes), str(one.bed), f"{one.share:.3%}"]
        for one in found
    ]
    print(table(("view", "step", "water", "holes", "bed", "wrong"), rows), end="\n\n")
    total = sum(one.holes + one.bed for one in found) / sum(one.water for one in found)
    targets = [
        Target("pixels of bed, sky or shard where water must be, all views, %", 100.0 * total, 0.5, 0.05),
        Target("the same in the worst view, %", 100.0 * max(one.share for one in found), 0.5, 0.05),
    ]
    print(target_table(targets))
    facts = machine_facts()
    print(machine_line(facts))
    print(write_json("flood_water", {"machine": facts, "views": [one._asdict() for one in found],
                                     "targets": target_facts(targets)}))  # fmt: skip


if __name__ == "__main__":
    main()
