"""Scripts of the gallery: the libraries that its examples load, bundled by esbuild."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from gallery_pages import GALLERY, ROOT

WEB: Final = ROOT / "web"
KERNELS: Final = ("silhouettes", "maps", "strokes")

ENTRIES: Final = ("globe", "gltf", "maplibre", "react", "text", "water", "webgpu")
"""Entries of the npm package beside the main one that the gallery shows."""

WITH_TEXTS: Final = "vexture-text"
"""The library that holds the worker of texts, HarfBuzz, the kernels and a font."""

MINIFIED: Final = ("--bundle", "--minify", "--legal-comments=none", "--log-level=error")


def bundle(folder: Path, name: str) -> None:
    """Bundle a library of gallery/libraries as a classic script, minified; and its text for pages from the disk."""
    three = WEB / "node_modules" / "three"
    options = [*MINIFIED, "--format=iife", f"--outfile={folder / f'{name}.js'}"]
    options += ['--define:process.env.NODE_ENV="production"']
    options += [f"--alias:vexture={WEB / 'src' / 'index.js'}"]
    options += [f"--alias:vexture/{entry}={WEB / 'src' / entry / 'index.js'}" for entry in ENTRIES]
    options += [f"--alias:three/{entry}={three / 'build' / f'three.{entry}.js'}" for entry in ("webgpu", "tsl")]
    # WebGPURenderer has a three.js of its own, which is that of the whole page
    webgpu = three / "build" / "three.webgpu.js"
    main = {"three": three, "webgpu": webgpu}.get(name, GALLERY / "libraries" / "loaded-three.cjs")
    options += [f"--alias:three/addons={three / 'examples' / 'jsm'}", f"--alias:three={main}"]
    options += ["--external:*/typeset/typesetter.js"]  # only the worker of texts needs it
    with tempfile.TemporaryDirectory() as temporary:
        if name == WITH_TEXTS:
            options += options_of_texts(Path(temporary))
        run_esbuild(GALLERY / "libraries" / f"{name}.js", options)
    text = json.dumps((folder / f"{name}.js").read_text(encoding="utf-8"), ensure_ascii=False)
    given = f"(globalThis.galleryTexts ??= {{}})[{json.dumps(name)}] = {text};\n"
    (folder / f"{name}.text.js").write_text(given, encoding="utf-8")


def options_of_texts(folder: Path) -> list[str]:
    """Options that put the worker of texts, bundled into a folder, and what it loads into a library."""
    for module in (WEB / "kernels" / f"{name}.wasm" for name in KERNELS):
        if not module.is_file():
            sys.exit(f"{module} is missing; type: make wasm")
    worker = folder / "worker.txt"
    source = WEB / "src" / "typeset" / "worker.js"
    options = [*MINIFIED, "--format=esm", "--external:module", '--define:import.meta.url="worker:"']
    run_esbuild(source, [*options, f"--outfile={worker}"])
    aliases = {"vexture-text-worker": worker, "vexture-kernels": WEB / "kernels", "vexture-fonts": WEB / "fonts"}
    loaders = {".txt": "text", ".wasm": "dataurl", ".woff": "binary"}
    options = [f"--alias:{name}={path}" for name, path in aliases.items()]
    return options + [f"--loader:{suffix}={loader}" for suffix, loader in loaders.items()]


def run_esbuild(source: Path, options: list[str]) -> None:
    """Bundle a module by esbuild, which finds what web/ has installed."""
    call = [str(WEB / "node_modules" / ".bin" / "esbuild"), str(source), *options]
    environment = os.environ | {"NODE_PATH": str(WEB / "node_modules")}
    outcome = subprocess.run(call, cwd=WEB, env=environment, capture_output=True, text=True, check=False)
    if outcome.returncode:
        sys.exit(f"{source.name} cannot be bundled: {outcome.stderr.strip().splitlines()[0]}")
