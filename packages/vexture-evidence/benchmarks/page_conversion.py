"""Conversion in a page: pictures of 500 published files, times of three logos, and sizes of what pages load.

    python packages/vexture-evidence/benchmarks/page_conversion.py [--quick] [--repeat 20] [--seed 2]

Chromium converts icons, logos and flags from their files to the files of textures, and Python does so, too. Both
textures are drawn 128 pixels wide. A picture is right if fewer than 0.5 % of its pixels are off by more than 16 of 255.
Times are from the text of a logo of 20 paths to a texture, by a worker. *Cold* is the first conversion of a page that
has just been opened by a browser with empty caches, with the worker and the kernels from a server on this machine;
*warm* follows five others. Those of Python are of the processor. Sizes are those of minified modules after gzip.
"""

import argparse
import base64
import gzip
import json
import shutil
import subprocess
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any, Final, NamedTuple

import numpy as np

import corpora
import vexture
from chromium import WEB, bundle, chromium, serve_folder
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture.base.errors import SourceWarning, VextureError
from vexture.texture.load import texture_from
from vexture_evidence.measures.machine import machine_facts, machine_line

PAGE: Final = Path(__file__).parent / "pages" / "convert.js"
WORKER: Final = WEB / "src" / "convert" / "worker.js"
KERNELS: Final = WEB / "kernels"
ESBUILD: Final = WEB / "node_modules" / ".bin" / "esbuild"

SIDE: Final = 128
VISIBLE: Final = 16 / 255
MOST_OFF: Final = 0.005
"""Share of the pixels off below which a picture is right, as in `conformance.py`."""

LOGOS: Final = ("apache/apache-original.svg", "pixijs/pixijs-original.svg", "pixijs/pixijs-original-wordmark.svg")
"""All logos of Devicon with 20 paths: gradients that touch, and shapes with many outlines beside one another."""

WARM_UP: Final = 5
ICONS: Final = 150

ENTRIES: Final = {
    "vexture, no conversion": "export { VectorMaterial, VectorTextureLoader } from 'vexture';",
    "vexture/convert": "export { convert } from 'vexture/convert';",
}
"""Modules whose first load is measured, by what a page uses."""


class Outcome(NamedTuple):
    """Outcome of a file, "right", "named" by notes that Python does not have, "refused" or "silent", and its causes."""

    file: str
    kind: str
    causes: tuple[str, ...]


@contextmanager
def serve_page() -> Iterator[str]:
    """Serve a page that converts, with its worker and kernels where the bundle looks for them; yield its address."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        bundle(PAGE, folder / "page.js")
        bundle(WORKER, folder / "worker.js")
        shutil.copytree(KERNELS, folder / "kernels")
        head = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
        (folder / "index.html").write_text(f'{head}<script type="module" src="page.js"></script>', encoding="utf-8")
        with serve_folder(folder) as address:
            yield address


@contextmanager
def open_page(browser: Any, address: str) -> Iterator[Any]:
    """Open the page with empty caches."""
    context = browser.new_context()
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("window.textureOf !== undefined")
    yield page
    context.close()


def judge(file: Path, page: Any) -> Outcome:
    """Compare the pictures of a file by the page and by Python."""
    name = f"{file.parent.name}/{file.name}"
    content = file.read_bytes()
    found = page.evaluate("([content, name]) => textureOf(content, name)", [base64.b64encode(content).decode(), "a"])
    try:
        drawing = vexture.read(content)
        ours = vexture.convert(drawing)
    except VextureError as error:
        return Outcome(name, "right" if "error" in found else "silent", (f"Python: {error}",))
    if "error" in found:
        return Outcome(name, "refused", (found["error"],))
    theirs = texture_from(base64.b64decode(found["file"]), name)
    first, second = (vexture.render(texture, SIDE) for texture in (ours, theirs))
    off = np.abs(first - second).max(axis=-1) > VISIBLE
    if off.mean() < MOST_OFF:
        return Outcome(name, "right", ())
    own = {note.message for note in drawing.notes}
    causes = tuple(note["message"] for note in found["notes"] if note["message"] not in own)
    return Outcome(name, "named" if causes else "silent", causes or (f"{100 * off.mean():.1f} % of the pixels",))


def conversion_times(browser: Any, address: str, text: str, repeat: int) -> dict[str, list[float]]:
    """Milliseconds of the first conversion in each of several new pages, and of later ones in one page."""
    cold = []
    for _ in range(repeat):
        with open_page(browser, address) as page:
            cold += page.evaluate("text => timesOf(text, 1)", text)
    with open_page(browser, address) as page:
        warm = page.evaluate("([text, repeat]) => timesOf(text, repeat)", [text, WARM_UP + repeat])
    return {"cold": cold, "warm": warm[WARM_UP:]}


def packed_size(content: bytes) -> int:
    """Bytes after gzip."""
    return len(gzip.compress(content, 9))


def first_load(code: str) -> int:
    """Bytes after gzip of what a page loads at first for a module; three.js and what is imported later are left out."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "page.js").write_text(code, encoding="utf-8")
        command = [ESBUILD, folder / "page.js", "--bundle", "--minify", "--format=esm", "--splitting"]
        command += [f"--outdir={folder / 'built'}", f"--metafile={folder / 'built.json'}", "--external:three"]
        command += [f"--alias:vexture/{name}={WEB / 'src' / name / 'index.js'}" for name in ("convert", "text")]
        command += ["--external:module"]
        command += [f"--alias:vexture={WEB / 'src' / 'index.js'}", "--log-level=error"]
        subprocess.run([*map(str, command)], cwd=folder, check=True)
        outputs = json.loads((folder / "built.json").read_text())["outputs"]
        first, waiting = set[str](), [next(name for name, one in outputs.items() if one.get("entryPoint") == "page.js")]
        while waiting:
            name = waiting.pop()
            first.add(name)
            imports = [one["path"] for one in outputs[name]["imports"] if one["kind"] == "import-statement"]
            waiting += [path for path in imports if path in outputs and path not in first]
        return sum(packed_size((folder / name).read_bytes()) for name in first)


def worker_size() -> int:
    """Bytes of the worker after gzip."""
    command = [str(ESBUILD), str(WORKER), "--bundle", "--minify", "--format=esm"]
    return packed_size(subprocess.run(command, cwd=WEB, check=True, capture_output=True).stdout)


def icon_times(count: int, repeat: int, seed: int) -> dict[str, float]:
    """Milliseconds of the processor that `vexture.convert` takes for an icon: of its drawing, and of its file."""
    files = corpora.mdi(count, seed)
    taken: dict[str, list[float]] = {"drawing": [], "file": []}
    for turn in range(1 + repeat):
        for name, sources in (("drawing", [*map(vexture.read, files)]), ("file", files)):
            start = time.process_time()
            for source in sources:
                vexture.convert(source)
            taken[name] += [1e3 * (time.process_time() - start) / count] * (turn > 0)
    return {name: median(values) for name, values in taken.items()}


def stroke_cubics(step: int) -> dict[str, int]:
    """Number of Lucide's icons, every `step`-th, and of the cubics of their outlined strokes."""
    drawings = [vexture.read(file) for file in corpora.lucide()[::step]]
    return {"icons": len(drawings), "cubics": sum(drawing.segments for drawing in drawings)}


def outcome_rows(outcomes: Sequence[Outcome]) -> list[list[str]]:
    """Rows of the outcomes, and of the causes of all but the right ones."""
    kinds = Counter(outcome.kind for outcome in outcomes)
    rows = [[kind, "", str(kinds[kind])] for kind in ("right", "named", "refused", "silent")]
    causes = Counter(
        (outcome.kind, cause) for outcome in outcomes if outcome.kind != "right" for cause in outcome.causes
    )
    return rows + [[kind, cause[:80], str(count)] for (kind, cause), count in causes.most_common()]


def targets(facts: dict[str, Any]) -> list[Target]:
    """Targets for pictures, times and sizes."""
    right = sum(one["kind"] == "right" for one in facts["outcomes"])
    usual = {kind: median(median(times[kind]) for times in facts["times"].values()) for kind in ("warm", "cold")}
    sizes = facts["sizes"]
    maps = sizes["maps.wasm"] + sizes["silhouettes.wasm"]
    return [
        Target("files right in a page, %", 100 * right / len(facts["outcomes"]), 95, 99, larger=True),
        Target("ms of a logo, warm, the median one", usual["warm"], 30, 10),
        Target("ms of a logo, cold, the median one", usual["cold"], 300, 150),
        Target("kB of kernels of silhouettes", sizes["silhouettes.wasm"] / 1e3, 50, 40),
        Target("kB of kernels, with planar maps", maps / 1e3, 130, 100),
        Target("kB of the first load without conversion", sizes["vexture, no conversion"] / 1e3, 19.2, 15),
    ]


def print_facts(facts: dict[str, Any], outcomes: Sequence[Outcome]) -> None:
    """Print all tables."""
    print(table(("outcome", "cause", "files"), outcome_rows(outcomes)))
    rows = [
        [name, kind, *(cell(value, 1) for value in (median(times), min(times), max(times)))]
        for name, found in facts["times"].items()
        for kind, times in found.items()
    ]
    print("\n" + table(("logo", "", "ms, median", "least", "most"), rows))
    print("\n" + table(("loaded", "bytes, gzip"), [[name, f"{size:,}"] for name, size in facts["sizes"].items()]))
    print("\n" + table(("vexture.convert in Python, of an icon", "ms"), [[*one] for one in facts["icon_rows"]]))
    print(f"\ncubics of the strokes of {facts['strokes']['icons']:,} icons of Lucide: {facts['strokes']['cubics']:,}")


def main() -> None:
    """Measure, and print and write the figures."""
    parser = argparse.ArgumentParser(description="Conversion in a page: pictures, times and sizes.")
    parser.add_argument("--quick", action="store_true", help="every tenth file, fewer repetitions")
    parser.add_argument("--repeat", type=int, default=20, help="conversions that a median is taken of")
    parser.add_argument("--seed", type=int, default=2)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", SourceWarning)
    repeat, step = (3, 10) if arguments.quick else (arguments.repeat, 1)
    logos = {name: corpora.DEVICON.installed_folder() / corpora.DEVICON.folder / name for name in LOGOS}
    with serve_page() as address, chromium() as browser:
        times = {
            name: conversion_times(browser, address, file.read_text(encoding="utf-8"), repeat)
            for name, file in logos.items()
        }
        with open_page(browser, address) as page:
            outcomes = [judge(file, page) for file in corpora.icons_logos_and_flags(arguments.seed)[::step]]
        version = browser.version
    sizes = {name: first_load(code) for name, code in ENTRIES.items()} | {"worker of conversions": worker_size()}
    sizes |= {f"{file.name}": packed_size(file.read_bytes()) for file in sorted(KERNELS.glob("*.wasm"))}
    icons = icon_times(ICONS // step, min(repeat, 5), arguments.seed)
    facts: dict[str, Any] = {"times": times, "sizes": sizes, "strokes": stroke_cubics(step), "browser": version}
    facts |= {"outcomes": [one._asdict() for one in outcomes], "icons": icons}
    facts |= {"icon_rows": [(name, cell(ms, 3)) for name, ms in icons.items()]}
    machine, reached = machine_facts(), targets(facts)
    print_facts(facts, outcomes)
    print("\n".join(["", target_table(reached), "", f"Chromium {version}", machine_line(machine)]))
    print(write_json("page_conversion", {"machine": machine, **facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
