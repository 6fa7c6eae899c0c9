"""Build the playground: one HTML file that converts drawings, works from the disk, and fetches nothing.

`make gallery` runs it; by hand: python tools/make_playground.py FILE.html. Needs the packages of web/ and the kernels
of `make wasm`.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from string import Template
from typing import Final

from gallery_data import WORLD

WEB: Final = Path(__file__).resolve().parents[1] / "web"
PLAYGROUND: Final = WEB / "playground"
KERNELS: Final = WEB / "kernels"
MODULES: Final = ("silhouettes", "maps", "strokes")

ESBUILD: Final = [str(WEB / "node_modules" / ".bin" / "esbuild"), "--bundle", "--minify", "--legal-comments=none"]

PALETTE: Final = ("#5b9279", "#8fcb9b", "#e2b04a", "#c8553d", "#588b8b", "#f28f3b", "#7a6c9d", "#3d6a8a")
"""Colours of the countries of the example."""


def bundle(source: Path, target: Path, *options: str) -> None:
    """Bundle a module as a classic script."""
    call = [*ESBUILD, str(source), "--format=iife", f"--outfile={target}", "--log-level=error", *options]
    outcome = subprocess.run(call, cwd=WEB, capture_output=True, text=True, check=False)
    if outcome.returncode:
        sys.exit(f"{source.name} cannot be bundled: {outcome.stderr.strip().splitlines()[0]}")


def coloured_world() -> str:
    """Return the countries of the world as TopoJSON, each with a colour."""
    topology = json.loads((WORLD.installed_folder() / "countries-110m.json").read_text(encoding="utf-8"))
    countries = topology["objects"]["countries"]
    for number, country in enumerate(countries["geometries"]):
        country["properties"]["fill"] = PALETTE[number % len(PALETTE)]
    return json.dumps(topology | {"objects": {"countries": countries}}, separators=(",", ":"))


def build_page(target: Path, links: str = "") -> None:
    """Write the page, with `links` as HTML in its head."""
    modules = {f"playground-{name}": KERNELS / f"{name}.wasm" for name in MODULES}
    for module in modules.values():
        if not module.is_file():
            sys.exit(f"{module} is missing; type: make wasm")
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        worker, script, style, world = (folder / name for name in ("worker.txt", "main.js", "style.css", "world.json"))
        world.write_text(coloured_world(), encoding="utf-8")
        bundle(WEB / "src" / "convert" / "worker.js", worker)
        aliases = {"playground-map": world, "playground-worker": worker, **modules}
        loaders = {".svg": "text", ".json": "text", ".txt": "text", ".wasm": "binary", ".woff": "binary"}
        bundle(
            PLAYGROUND / "main.js",
            script,
            *(f"--alias:{name}={path}" for name, path in aliases.items()),
            *(f"--loader:{suffix}={loader}" for suffix, loader in loaders.items()),
        )
        call = [*ESBUILD, str(PLAYGROUND / "playground.css"), f"--outfile={style}", "--log-level=error"]
        subprocess.run(call, cwd=WEB, check=True)
        page = Template((PLAYGROUND / "index.html").read_text(encoding="utf-8")).substitute(
            style=style.read_text(encoding="utf-8"),
            links=links,
            script=script.read_text(encoding="utf-8").replace("</script", r"<\/script"),
        )
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    build_page(Path(sys.argv[1]))
