"""The time until a saved drawing is on the screen, and until an exported page shows its picture.

    python packages/vexture-evidence/benchmarks/editing.py [--quick] [--repeat 100] [--pages 10]

Real parts on one machine: `vexture view --watch`, Chromium with WebGL 2, a file that is saved as editors do, written
beside its place and renamed. The clock runs from just before the rename to the first frame of the page after the one
whose pixels have the new colour. The exported page is opened from disk in a fresh browser profile each time; its clock
runs from the start of the navigation to the frame after the first picture. Both take the GPU's work along: the pixels
are read back.
"""

import argparse
import math
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any, Final

from chromium import CHROMIUM, FLAGS, ROOT
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture.base.errors import DeviceError, VextureError
from vexture.pages.page import SCRIPT, built
from vexture_evidence.measures.machine import machine_facts, machine_line

SHAPES: Final = ROOT / "examples" / "shapes"
COLOR: Final = "#e8b100"
"""Of the duck, in its file."""

SIZE: Final = {"width": 900, "height": 600}
VEXTURE: Final = [sys.executable, "-c", "from vexture.cli.main import main; main(prog_name='vexture')"]
PATIENCE: Final = 20_000  # ms

WATCHED: Final = """
() => {
  const { engine } = window.vexture.viewer;
  const gl = engine.renderer.getContext();
  const plain = engine.render.bind(engine);
  const pixel = new Uint8Array(4);
  window.seen = {};
  engine.render = () => {
    plain();
    gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    const color = pixel.slice(0, 3).join();
    requestAnimationFrame(() => { window.seen[color] ??= performance.timeOrigin + performance.now(); });
  };
}
"""
"""Notes, for each colour of the middle pixel, when it was first on the screen."""

OPENED: Final = """
const look = () => {
  const viewer = window.vexture?.viewer;
  if (!viewer?.ready) return void requestAnimationFrame(look);
  viewer.ready.then(() => {
    const gl = viewer.engine.renderer.getContext();
    viewer.engine.render();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    requestAnimationFrame(() => { window.pictured = performance.now(); });
  });
};
look();
"""


def percentile(values: list[float], share: float) -> float:
    """Value that a share of them do not exceed.

    Examples
    --------
    >>> percentile([3.0, 1.0, 2.0, 4.0], 0.5), percentile([1.0, 2.0], 0.95)
    (2.0, 2.0)
    """
    ordered = sorted(values)
    return ordered[max(0, math.ceil(share * len(ordered)) - 1)]


@contextmanager
def chromium() -> Iterator[Any]:
    """The browser of the tests."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()


@contextmanager
def viewer(drawing: Path) -> Iterator[str]:
    """Address of a viewer that watches a drawing."""
    command = [*VEXTURE, "view", str(drawing), "--watch", "--no-open"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        found = re.search(r"http://\S+/", process.stdout.readline())
        if found is None:
            raise DeviceError("`vexture view` does not start; the line above says why")
        yield found[0]
    finally:
        process.kill()
        process.wait()


def time_saves(browser: Any, folder: Path, repeat: int) -> list[float]:
    """Measure the milliseconds from saves to their pixels on the screen."""
    text = (SHAPES / "duck.svg").read_text()
    drawing, beside = folder / "duck.svg", folder / "duck.svg.new"
    drawing.write_text(text)
    taken = []
    with viewer(drawing) as url:
        page = browser.new_page(viewport=SIZE, device_scale_factor=1)
        page.goto(url)
        page.wait_for_function("window.vexture?.viewer?.ready")
        page.evaluate("window.vexture.viewer.ready")
        page.evaluate(WATCHED)
        for number in range(repeat + 1):
            red, green, blue = 40 + number % 200, 80, 200 - number // 200
            beside.write_text(text.replace(COLOR, f"#{red:02x}{green:02x}{blue:02x}"))
            start = time.time()
            beside.replace(drawing)
            seen = page.wait_for_function("color => window.seen[color]", arg=f"{red},{green},{blue}", timeout=PATIENCE)
            taken.append(seen.json_value() - 1000.0 * start)
            time.sleep(0.15)  # nobody saves faster; what is left of one save is not counted with the next
        page.close()
    return taken[1:]  # the first loads what the others find


def time_exports(browser: Any, folder: Path, pages: int) -> tuple[int, list[float]]:
    """Export the duck; return its size, and the milliseconds from navigations to its picture."""
    target = folder / "duck.html"
    subprocess.run([*VEXTURE, "export", str(SHAPES / "duck.svg"), "-o", str(target)], check=True, capture_output=True)
    taken = []
    for _ in range(pages + 1):
        context = browser.new_context(viewport=SIZE, device_scale_factor=1)
        page = context.new_page()
        page.add_init_script(OPENED)
        page.goto(target.as_uri())
        taken.append(page.wait_for_function("window.pictured", timeout=PATIENCE).json_value())
        context.close()
    return target.stat().st_size, taken[1:]  # the first starts the browser's GPU process


def main() -> None:
    parser = argparse.ArgumentParser(description="Times from a save, and from opening a page, to a picture.")
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    parser.add_argument("--repeat", type=int, default=100, help="saves")
    parser.add_argument("--pages", type=int, default=10, help="times that the exported page is opened")
    arguments = parser.parse_args()
    repeat, pages = (15, 3) if arguments.quick else (arguments.repeat, arguments.pages)
    try:
        built(SCRIPT)
    except VextureError as error:
        print(f"not measured: {error}")
        return
    with tempfile.TemporaryDirectory() as scratch, chromium() as browser:
        saves = time_saves(browser, Path(scratch), repeat)
        size, opened = time_exports(browser, Path(scratch), pages)
    rows = [
        [what, cell(median(times), 0), cell(percentile(times, 0.95), 0), cell(max(times), 0), str(len(times))]
        for what, times in (("save to pixels", saves), ("exported page to picture", opened))
    ]
    reached = [
        Target("save to pixels, 95% of them (ms)", percentile(saves, 0.95), 250, 100),
        Target("exported duck (kB)", size / 1000, 900, 600),
        Target("exported duck to its picture, median (ms)", median(opened), 1000, 500),
    ]
    machine = machine_facts()
    print(table(("milliseconds", "median", "95%", "most", "of"), rows))
    print("\n".join(["", target_table(reached), "", machine_line(machine)]))
    facts = {"machine": machine, **vars(arguments), "saves": saves, "opened": opened, "bytes": size}
    print(write_json("editing", {**facts, "targets": target_facts(reached)}))


if __name__ == "__main__":
    main()
