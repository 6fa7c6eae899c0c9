"""Text in a page, beside troika-three-text: times of frames and words, labels in thousands, sizes.

    python packages/vexture-evidence/benchmarks/text_page.py [--quick] [--repeat 40] [--hanzi FONT]

Both draw in one page of 1,000 x 1,000 pixels, in turns, in DejaVu Sans. A frame is timed until the driver has drawn it.
*First* is from a call in a page that a browser with empty caches has just opened, with all files from a server on this
machine, to a frame with three sizes. *Hanzi* are the first 200 of a font with Chinese characters, such as a WOFF2.
"""

import argparse
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any, Final

from chromium import WEB, bundle, chromium, serve_folder
from page_conversion import first_load, packed_size
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture_evidence.measures.machine import machine_facts, machine_line

PAGE: Final = Path(__file__).parent / "pages" / "text.js"
WORKER: Final = WEB / "src" / "typeset" / "worker.js"
KERNELS: Final = WEB / "kernels"
HARFBUZZ: Final = WEB / "node_modules" / "harfbuzzjs" / "dist" / "harfbuzz.wasm"
SETTER: Final = WEB / "src" / "typeset" / "typesetter.js"
FONT: Final = Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")
KINDS: Final = ("vexture", "troika")
LABELS: Final = 10_000
HANZI: Final = "".join(map(chr, range(0x4E00, 0x4E00 + 200)))
ASCII: Final = "".join(map(chr, range(0x21, 0x7F)))
SIDE: Final = 1020


@contextmanager
def serve_page(hanzi: Path | None) -> Iterator[str]:
    """Serve the page, its worker, HarfBuzz, kernels and fonts; yield its address."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        bundle(PAGE, folder / "page.js")
        bundle(WORKER, folder / "worker.js")
        shutil.copytree(KERNELS, folder / "kernels")
        shutil.copy(HARFBUZZ, folder)
        shutil.copy(FONT, folder / "font.ttf")
        if hanzi:
            shutil.copy(hanzi, folder / "hanzi")
        head = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
        (folder / "index.html").write_text(f'{head}<script type="module" src="page.js"></script>', encoding="utf-8")
        with serve_folder(folder) as address:
            yield address


@contextmanager
def open_page(browser: Any, address: str) -> Iterator[Any]:
    """Open the page with empty caches."""
    context = browser.new_context(viewport={"width": SIDE, "height": SIDE}, device_scale_factor=1)
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("window.isReady")
    yield page
    context.close()


def first_times(browser: Any, address: str, repeat: int) -> dict[str, list[float]]:
    """Milliseconds of the first frame in pages opened in turns."""
    times: dict[str, list[float]] = {name: [] for name in KINDS}
    for _ in range(repeat):
        for name in KINDS:
            with open_page(browser, address) as page:
                times[name].append(page.evaluate("name => first(name)", name))
    return times


def measure(browser: Any, address: str, repeat: int, hanzi: Path | None) -> dict[str, Any]:
    """Measure all but sizes."""
    facts: dict[str, Any] = {"first": first_times(browser, address, max(repeat // 7, 2))}
    with open_page(browser, address) as page:
        facts["lines"] = page.evaluate("repeat => lines(repeat)", repeat)
        facts["words"] = page.evaluate("repeat => words(repeat)", 5 * repeat)
        facts["ascii"] = page.evaluate("text => characters('font.ttf', text)", ASCII)
    with open_page(browser, address) as page:
        facts["labels"] = page.evaluate("([count, repeat]) => labels(count, repeat)", [LABELS, max(repeat // 4, 2)])
    if hanzi:
        with open_page(browser, address) as page:
            facts["hanzi"] = page.evaluate("text => characters('hanzi', text)", HANZI)
    return facts


def rows_of(facts: dict[str, Any]) -> list[list[str]]:
    """A row of medians for each measure: ours, troika's, and ours over troika's."""
    words = facts["words"]
    pairs = {
        "first frame of three sizes": [median(facts["first"][name]) for name in KINDS],
        "frame, 40 lines of 20 px": [median(facts["lines"][name]) for name in KINDS],
        "another word: set": [median(words["times"][name]) for name in KINDS],
        "another word: its frame": [median(words["frames"][name]) for name in KINDS],
        "another word: worst, set and frame": [
            max(a + b for a, b in zip(words["times"][name], words["frames"][name], strict=True)) for name in KINDS
        ],
        f"{LABELS:,} labels: ready": [facts["labels"][name]["ready"] for name in KINDS],
        f"{LABELS:,} labels: frame in which all move": [median(facts["labels"][name]["frames"]) for name in KINDS],
    }
    return [[name, cell(ours, 1), cell(theirs, 1), cell(ours / theirs, 2)] for name, (ours, theirs) in pairs.items()]


def targets(facts: dict[str, Any]) -> list[Target]:
    """Targets of times, sizes and bytes."""
    words, labels = facts["words"], facts["labels"]
    lines = median(facts["lines"]["vexture"]) / median(facts["lines"]["troika"])
    worst = max(a + b for a, b in zip(words["times"]["vexture"], words["frames"]["vexture"], strict=True))
    frames = [median(labels[name]["frames"]) for name in KINDS]
    return [
        Target("ms of the first frame", median(facts["first"]["vexture"]), 260, 150),
        Target("ms of another word", median(words["times"]["vexture"]), 0.4, 0.3),
        Target("ms of its frame", median(words["frames"]["vexture"]), 1.5, 1.0),
        Target("ms of both, the worst", worst, 13, 8),
        Target("40 lines of 20 px over troika", lines, 2.0, 1.2),
        Target("10,000 labels, ready, over troika", labels["vexture"]["ready"] / labels["troika"]["ready"], 1.0, 0.5),
        Target("10,000 labels, frame, over troika", frames[0] / frames[1], 2.0, 1.2),
        Target("kB to load", facts["sizes"]["all that a text loads"] / 1e3, 220, 120),
        Target("bytes of a glyph, DejaVu", facts["ascii"]["bytes"], 450, 300),
        Target("bytes of a glyph, CJK", facts.get("hanzi", {}).get("bytes"), 1200, 800),
        Target("ms of 200 hanzi", facts.get("hanzi", {}).get("taken"), 400, 200),
    ]


def main() -> None:
    """Measure, and print and write the figures."""
    parser = argparse.ArgumentParser(description="Text in a page, beside troika-three-text.")
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    parser.add_argument("--repeat", type=int, default=40, help="frames that a median is taken of")
    parser.add_argument("--hanzi", type=Path, help="font with Chinese characters")
    arguments = parser.parse_args()
    repeat = 8 if arguments.quick else arguments.repeat
    with serve_page(arguments.hanzi) as address, chromium() as browser:
        facts = measure(browser, address, repeat, arguments.hanzi)
        version = browser.version
    sizes = {
        "page": first_load("export { Text } from 'vexture/text';"),
        "worker": first_load(f"export * from '{SETTER}';"),
    }
    sizes |= {file.name: packed_size(file.read_bytes()) for file in (HARFBUZZ, KERNELS / "silhouettes.wasm")}
    facts["sizes"] = sizes | {"all that a text loads": sum(sizes.values())}
    machine, reached = machine_facts(), targets(facts)
    print(table(("ms, medians", "vexture", "troika", "ratio"), rows_of(facts)))
    print("\n" + table(("loaded", "bytes, gzip"), [[name, f"{size:,}"] for name, size in facts["sizes"].items()]))
    print("\n".join(["", target_table(reached), "", f"Chromium {version}", machine_line(machine)]))
    print(write_json("text_page", {"machine": machine, "browser": version, **facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
