"""Conversion and errors of many icons: 500 of Material Design, 200 of Simple Icons.

    python packages/vexture-evidence/benchmarks/icons.py [--mdi 500] [--simple 200] [--sizes 61 250] [--shifts 2]
        [--seed 1] [--quick]

The icons are drawn at random from a seed; what is measured, and the limits, are those of `fidelity.py`.
"""

import argparse
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

import corpora
from fidelity import AREA_LIMIT, BORDER_LIMIT, MEAN_LIMIT, area_error, has_gpu, parse_options, shifted_views, size_facts
from report import cell, table, write_json
from vexture.base.errors import SourceWarning, VextureError
from vexture.conversion.pipeline import run_encoding

SIZES = (61, 250)
WORST = 10
SHIFTS = 2
"""Few, for there are many icons; the tables of the README take eight."""


def icon_facts(path: Path, arguments: argparse.Namespace, renderers: Sequence[str]) -> dict[str, Any]:
    """All measurements of one icon, or the reason of its failure."""
    facts: dict[str, Any] = {"icon": path.stem}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SourceWarning)
            conversion = run_encoding(path, "thesis")
        drawing, tree, texture = conversion.drawing, conversion.tree, conversion.texture
        sizes = [
            size_facts(drawing, tree, texture, shifted_views(path.stem, size, arguments), renderers)
            for size in arguments.sizes
        ]
    except VextureError as error:
        return {**facts, "failed": str(error), "met": False}
    area = area_error(drawing, tree)
    return {
        **facts,
        "segments": drawing.segments,
        "quads": len(tree.kind),
        "curves": len(tree.curves),
        "unresolved": tree.unresolved,
        "deviation": tree.deviation,
        "ms": 1000.0 * conversion.seconds,
        "area": area,
        "sizes": sizes,
        "met": area <= AREA_LIMIT and all(of_size["met"] for of_size in sizes),
    }


def worst_of(of_size: dict[str, Any], renderers: Sequence[str], figure: str) -> float:
    return float(np.nanmax([of_size[renderer][figure] for renderer in renderers] + [0.0]))


def summary(name: str, icons: Sequence[dict[str, Any]], renderers: Sequence[str]) -> list[list[str]]:
    """Rows of the table, one for each size: medians and worst values over a set of icons."""
    drawn = [icon for icon in icons if "failed" not in icon]
    rows = []
    for index in range(len(drawn[0]["sizes"]) if drawn else 0):
        shown = [icon["sizes"][index] for icon in drawn]
        means = [worst_of(of_size, renderers, "mae") for of_size in shown]
        borders = [worst_of(of_size, renderers, "border") for of_size in shown]
        rows.append(
            [
                name,
                str(shown[0]["size"]),
                str(len(icons)),
                str(len(icons) - len(drawn)),
                cell(float(np.median(means))),
                cell(max(means)),
                cell(float(np.median(borders))),
                cell(max(borders)),
                cell(max(icon["area"] for icon in drawn), 3),
                cell(max(of_size["apart"]["mean"] for of_size in shown), 3),
                cell(max(of_size["apart"]["max"] for of_size in shown), 0),
                str(sum(icon["unresolved"] for icon in drawn)),
                cell(float(np.median([icon["ms"] for icon in drawn])), 1),
                str(sum(not of_size["met"] for of_size in shown)),
            ]
        )
    return rows


HEAD = ("icons", "px", "number", "failed", "mean", "worst", "border", "worst", "area", "gpu-cpu", "max")
HEAD += ("unresolved", "ms", "missed")


def worst_icons(icons: Sequence[dict[str, Any]], renderers: Sequence[str]) -> str:
    """Table of the icons that come closest to a limit, or exceed it."""

    def share(icon: dict[str, Any]) -> tuple[float, dict[str, Any], str]:
        of_limit = [(icon["area"] / AREA_LIMIT, icon["sizes"][-1], "area")]
        for of_size in icon["sizes"]:
            of_limit.append((worst_of(of_size, renderers, "mae") / MEAN_LIMIT, of_size, "mean"))
            of_limit.append((worst_of(of_size, renderers, "border") / BORDER_LIMIT, of_size, "border"))
        return max(of_limit, key=lambda entry: entry[0])

    ranked = sorted(((share(icon), icon) for icon in icons if "failed" not in icon), key=lambda entry: -entry[0][0])
    rows = []
    for (part, of_size, limit), icon in ranked[:WORST]:
        rows.append(
            [
                icon["icon"],
                limit,
                cell(part),
                str(of_size["size"]),
                cell(worst_of(of_size, renderers, "mae")),
                cell(worst_of(of_size, renderers, "cut")),
                cell(worst_of(of_size, renderers, "border")),
                cell(icon["area"], 3),
                str(icon["segments"]),
                str(icon["curves"]),
                str(icon["unresolved"]),
            ]
        )
    head = ("worst", "nearest to", "share", "px", "mean", "cut", "border", "area")
    return table((*head, "segments", "curves", "unresolved"), rows)


def measure_icons(
    name: str,
    choose: Callable[[int, int], list[Path]],
    count: int,
    arguments: argparse.Namespace,
    renderers: Sequence[str],
) -> list[dict[str, Any]]:
    paths = choose(count, arguments.seed)
    shown = track(paths, name, console=Console(stderr=True), transient=True)
    return [icon_facts(path, arguments, renderers) for path in shown]


def main() -> None:
    parser = argparse.ArgumentParser(description="Errors of many icons' pictures.")
    parser.add_argument("--mdi", type=int, default=500)
    parser.add_argument("--simple", type=int, default=200)
    arguments = parse_options(parser, SIZES, SHIFTS)
    if arguments.quick:
        arguments.mdi, arguments.simple = min(arguments.mdi, 20), min(arguments.simple, 10)
    renderers = ("cpu", "gpu") if has_gpu() else ("cpu",)
    start = time.perf_counter()
    sets = {
        "mdi": measure_icons("mdi", corpora.mdi, arguments.mdi, arguments, renderers),
        "simple-icons": measure_icons("simple-icons", corpora.simple_icons, arguments.simple, arguments, renderers),
    }
    icons = [icon for found in sets.values() for icon in found]
    print(table(HEAD, [row for name, found in sets.items() for row in summary(name, found, renderers)]))
    print()
    print(worst_icons(icons, renderers))
    for icon in icons:
        if "failed" in icon:
            print(f"{icon['icon']}: {icon['failed']}")
    missed = [icon["icon"] for icon in icons if not icon["met"]]
    print(
        f"limits: mean {MEAN_LIMIT:g}/255, border {BORDER_LIMIT:g}, area {AREA_LIMIT:g}/255; met by "
        f"{len(icons) - len(missed)} of {len(icons)} in {time.perf_counter() - start:.0f} s"
        + (f"; missed: {', '.join(missed)}" if missed else "")
    )
    print(write_json("icons", {**vars(arguments), "renderers": renderers, "sets": sets}))


if __name__ == "__main__":
    main()
