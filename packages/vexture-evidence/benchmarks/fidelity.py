"""Errors of the example drawings' textures: every renderer against the exact coverage.

    python packages/vexture-evidence/benchmarks/fidelity.py [--sizes 61 250 1000] [--shifts 8] [--seed 1] [--quick]

Each drawing is rendered at each size with random sub-pixel shifts of its own. Errors are in 1/255, over the pixels of
all these pictures that the shape touches in truth or in the picture. *cut* is the mean error where quads are smaller
than a pixel, which the shader does not look into. *border* is, elsewhere, the mean error of the edge pixels on cell
borders over that of the other edge pixels. *area* is how far the root's coverage is from the area of the shape.
"""

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import vexture
from report import cell, table, write_json
from vexture.base.errors import DeviceError, LimitError
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing
from vexture.renderers.view import fit
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.metrics import LEVELS, border_ratio, cell_border_pixels, errors

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
SIZES = (61, 250, 1000)
SHIFTS = 8
"""Pictures of each size: all pixels along an upright or level edge have one error, which in one picture says little."""

AREA_SIZE = 500
"""Pixels of the picture whose mean is the area of the shape: exact whatever the size."""

MEAN_LIMIT = 6.0
BORDER_LIMIT = 1.5
AREA_LIMIT = 1.0
"""Mean error and area in 1/255."""

NOT_GATED = ("hairline",)
"""Reported only: the cut at quads smaller than a pixel alone costs so thin a stroke 20 to 50."""


class SquareView(NamedTuple):
    """A square picture of the unit square, shifted by a part of a pixel."""

    size: int
    to_unit: NDArray[np.float64]


def shifted_views(name: str, size: int, arguments: argparse.Namespace) -> list[SquareView]:
    """The whole unit square, moved by up to a pixel to the left and up, by a seed and a drawing's name."""
    rng = np.random.default_rng([arguments.seed, *name.encode()])
    shift = np.eye(3)
    views = []
    for shift[:2, 2] in rng.random((arguments.shifts, 2)):
        views.append(SquareView(size, fit((size, size)) @ shift))
    return views


def has_gpu() -> bool:
    """Whether there is an OpenGL context; prints the reason if not."""
    from vexture.renderers.device import context

    try:
        context()
    except DeviceError as error:
        print(f"no GPU: {error}")
        return False
    return True


def render(shape: Drawing | ThesisTexture, views: Sequence[SquareView], renderer: str) -> NDArray[np.float32]:
    """Pictures of a shape, (views, size, size)."""
    return np.stack([vexture.coverage(shape, (view.size, view.size), view.to_unit, renderer) for view in views])


def area_error(drawing: Drawing, tree: CellTree) -> float:
    """Difference of the root's coverage from the drawing's area, in 1/255."""
    area = vexture.coverage(drawing, (AREA_SIZE, AREA_SIZE), renderer="exact").mean(dtype=np.float64)
    return LEVELS * abs(float(tree.quad_coverage[0]) - float(area))


def cut_pixels(cells: tuple[NDArray[np.float64], ...], view: SquareView) -> NDArray[np.bool_]:
    """Pixels in which a quad is smaller than a pixel."""
    x, y, side = (values[2.0 * cells[2] * view.size < 1.0] for values in cells)
    mask = np.zeros((view.size, view.size), np.bool_)
    to_pixels = np.linalg.inv(view.to_unit)
    for right in (0.0, 1.0):
        for up in (0.0, 1.0):
            column, row, _ = to_pixels @ np.stack([x + right * side, y + up * side, np.ones(len(x))])
            mask[tuple(np.clip(np.floor([row, column]), 0, view.size - 1).astype(int))] = True
    return mask


def size_facts(
    drawing: Drawing, tree: CellTree, texture: ThesisTexture, views: Sequence[SquareView], renderers: Sequence[str]
) -> dict[str, Any]:
    """Errors of a texture's pictures of one size by some renderers, and how far these differ from one another."""
    truth = render(drawing, views, "exact")
    found = leaves(tree)
    cells = found.x, found.y, found.side
    cut = np.stack([cut_pixels(cells, view) for view in views])
    border = np.stack([cell_border_pixels(*cells, view.to_unit, (view.size, view.size)) for view in views])
    facts: dict[str, Any] = {"size": views[0].size}
    images = {renderer: render(texture, views, renderer) for renderer in renderers}
    for renderer, image in images.items():
        facts[renderer] = {
            **errors(image, truth)._asdict(),
            "cut": errors(image[cut], truth[cut]).mae,
            "border": border_ratio(image[~cut], truth[~cut], border[~cut]),
        }
    apart = LEVELS * np.ptp(list(images.values()), axis=0)
    facts["apart"] = {"mean": float(apart.mean()), "max": float(apart.max())}
    facts["met"] = meets_limits(facts, renderers)
    return facts


def meets_limits(facts: dict[str, Any], renderers: Sequence[str]) -> bool:
    """Whether the pictures of one size are within the limits; an unknown ratio counts as within."""
    return all(
        facts[renderer]["mae"] <= MEAN_LIMIT and not facts[renderer]["border"] > BORDER_LIMIT for renderer in renderers
    )


def mean_error(drawing: Drawing, views: Sequence[SquareView], **parameters: Any) -> float | None:
    """Mean error, on the CPU, of another conversion; None if the drawing is too much for it."""
    try:
        texture = run_encoding(drawing, "thesis", **parameters).texture
    except LimitError:
        return None
    return errors(render(texture, views, "cpu"), render(drawing, views, "exact")).mae


def shape_facts(path: Path, arguments: argparse.Namespace, renderers: Sequence[str]) -> dict[str, Any]:
    """All measurements of one drawing."""
    conversion = run_encoding(path, "thesis")
    drawing, tree, texture = conversion.drawing, conversion.tree, conversion.texture
    sizes = []
    for size in arguments.sizes:
        views = shifted_views(path.stem, size, arguments)
        facts = size_facts(drawing, tree, texture, views, renderers)
        facts["mae_8_bits"] = mean_error(drawing, views, bits=8)
        facts["mae_sampled"] = mean_error(drawing, views, strategy="sampled")
        sizes.append(facts)
    area = area_error(drawing, tree)
    return {
        "shape": path.stem,
        "gated": path.stem not in NOT_GATED,
        "unresolved": tree.unresolved,
        "area": area,
        "area_met": area <= AREA_LIMIT,
        "sizes": sizes,
    }


HEAD = ("shape", "px", "gpu", "cpu", "rmse", "max", "cut", "border", "gpu-cpu")
HEAD += ("8 bits", "sampled", "area", "limits")


def lines(facts: dict[str, Any]) -> Iterator[list[str]]:
    """The table's rows of one drawing; all but the second mean are the GPU's if there is one."""
    for of_size in facts["sizes"]:
        shown = of_size.get("gpu", of_size["cpu"])
        verdict = "met" if of_size["met"] and facts["area_met"] else "missed"
        yield [
            facts["shape"],
            str(of_size["size"]),
            cell(of_size["gpu"]["mae"] if "gpu" in of_size else None),
            cell(of_size["cpu"]["mae"]),
            cell(shown["rmse"]),
            cell(shown["max"], 0),
            cell(shown["cut"]),
            cell(shown["border"]),
            cell(of_size["apart"]["max"], 0),
            cell(of_size["mae_8_bits"]),
            cell(of_size["mae_sampled"]),
            cell(facts["area"], 3),
            verdict if facts["gated"] else "reported",
        ]


def parse_options(parser: argparse.ArgumentParser, sizes: Sequence[int], shifts: int = SHIFTS) -> argparse.Namespace:
    """Parse the command line, with the options that the benchmarks of pictures share."""
    parser.add_argument("--sizes", type=int, nargs="+", default=sizes, help="sides of the pictures, in pixels")
    parser.add_argument("--shifts", type=int, default=shifts, help="pictures of each size")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="less of everything: whether it works, not how well")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.sizes, arguments.shifts = arguments.sizes[:1], min(arguments.shifts, 2)
    return arguments


def main() -> None:
    parser = argparse.ArgumentParser(description="Errors of the example drawings' pictures.")
    arguments = parse_options(parser, SIZES)
    renderers = ("cpu", "gpu") if has_gpu() else ("cpu",)
    shapes = [shape_facts(path, arguments, renderers) for path in sorted(SHAPES.glob("*.svg"))]
    print(table(HEAD, [line for facts in shapes for line in lines(facts)]))
    gated = [facts for facts in shapes if facts["gated"]]
    missed = [
        facts["shape"]
        for facts in gated
        if not (facts["area_met"] and all(of_size["met"] for of_size in facts["sizes"]))
    ]
    print(
        f"limits: mean {MEAN_LIMIT:g}/255, border {BORDER_LIMIT:g}, area {AREA_LIMIT:g}/255; "
        f"met by {len(gated) - len(missed)} of {len(gated)}" + (f"; missed: {', '.join(missed)}" if missed else "")
    )
    print(write_json("fidelity", {**vars(arguments), "renderers": renderers, "shapes": shapes}))


if __name__ == "__main__":
    main()
