"""Build the gallery: `python tools/make_gallery.py [FOLDER]` writes a static site, by default into gallery/built/.

Needs the packages of web/ (npm ci --prefix web), and npm for the icons and maps. The pictures of the index are
screenshots where there is Chromium with Playwright, and else textures drawn on the processor. `--quick` takes few icons
and one state of the map, `--only NAME` some of the examples.
"""

import argparse
import base64
import contextlib
import functools
import hashlib
import io
import json
import os
import shutil
import subprocess
import sys
from importlib.metadata import distributions
from pathlib import Path
from typing import Any, Final

import click
import numpy as np
from PIL import Image

import vexture
from gallery_data import COUNTIES, ICONS, SOURCES, WORLD
from gallery_pages import GALLERY, ROOT, Example, Weight, command_line, examples, spoken, write_index, write_page
from vexture.cli.main import main as command

WEB: Final = ROOT / "web"
ENTRIES: Final = ("globe", "gltf", "maplibre", "react", "water", "webgpu")
"""Entries of the npm package beside the main one that the gallery shows."""

LICENSED: Final = (
    "three",
    "fflate",
    "fast-png",
    "react",
    "react-dom",
    "scheduler",
    "zustand",
    "suspend-react",
    "its-fine",
    "maplibre-gl",
    "pmtiles",
)
"""Packages in the bundles."""

HOLDS_OTHERS: Final = ("maplibre-gl",)
"""Those that hold what they depend on."""

MADE: Final = "made.txt"
"""In an example's folder: the digest of what its files were made of."""

PICTURED: Final = "pictured.txt"
"""In an example's folder: the digest of the page that its picture shows."""

MADE_OF: Final = (
    "packages/vexture/src",
    "packages/vexture-geo/src",
    "gallery/drawings",
    "examples",
    "tools",
    "packages/vexture-evidence/benchmarks",
)
"""Folders of the converter and of the sources, any change in which makes all files again."""

THUMBNAIL: Final = (640, 400)
LUCIDE_OF_GLYPH: Final = (1_594, 3 * 2**20, 998_000)
"""What pmndrs/glyph says of its baked Lucide icons: number, bytes, bytes compressed."""

CREDITS: Final = (
    'Icons: <a href="https://lucide.dev">Lucide</a> (ISC). Counties: '
    '<a href="https://github.com/topojson/us-atlas">us-atlas</a>, of the Census Bureau; land and countries: '
    '<a href="https://github.com/topojson/world-atlas">world-atlas</a>, of Natural Earth (both ISC). Coastline: GSHHG '
    '(LGPL). <a href="lib/LICENSES.txt">Licences</a> of these and of the libraries.'
)


def report(step: str) -> None:
    """Print what is done now, at once: the whole takes minutes."""
    print(f"{step} ...", flush=True)


def bundle(folder: Path, name: str) -> None:
    """Bundle a library of gallery/libraries as a classic script, minified; and its text for pages from the disk."""
    modules = WEB / "node_modules"
    three = modules / "three"
    options = ["--bundle", "--minify", "--format=iife", "--legal-comments=none", "--log-level=error"]
    options += [f"--outfile={folder / f'{name}.js'}", '--define:process.env.NODE_ENV="production"']
    options += [f"--alias:vexture={WEB / 'src' / 'index.js'}"]
    options += [f"--alias:vexture/{entry}={WEB / 'src' / entry / 'index.js'}" for entry in ENTRIES]
    options += [f"--alias:three/{entry}={three / 'build' / f'three.{entry}.js'}" for entry in ("webgpu", "tsl")]
    # WebGPURenderer has a three.js of its own, which is that of the whole page
    webgpu = three / "build" / "three.webgpu.js"
    main = {"three": three, "webgpu": webgpu}.get(name, GALLERY / "libraries" / "loaded-three.cjs")
    options += [f"--alias:three/addons={three / 'examples' / 'jsm'}", f"--alias:three={main}"]
    source = GALLERY / "libraries" / f"{name}.js"
    call = [str(modules / ".bin" / "esbuild"), str(source), *options]
    environment = os.environ | {"NODE_PATH": str(modules)}
    outcome = subprocess.run(call, cwd=WEB, env=environment, capture_output=True, text=True, check=False)
    if outcome.returncode:
        sys.exit(f"{source.name} cannot be bundled: {outcome.stderr.strip().splitlines()[0]}")
    text = json.dumps((folder / f"{name}.js").read_text(encoding="utf-8"), ensure_ascii=False)
    given = f"(globalThis.galleryTexts ??= {{}})[{json.dumps(name)}] = {text};\n"
    (folder / f"{name}.text.js").write_text(given, encoding="utf-8")


def run(line: str, folder: Path) -> None:
    """Run a command of an example in its folder; `vexture` in this process."""
    words = command_line(line, folder)
    with contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()):
        try:
            command(words[1:], standalone_mode=False)
        except (vexture.VextureError, click.ClickException) as error:
            sys.exit(f"{line}: {error}")


def digest_of(example: Example, *, quick: bool) -> str:
    """Digest of all that the files of an example are made of: its entry, the converter and the sources."""
    entry = (example.sources, example.commands, example.files, quick, digest_of_tools())
    return hashlib.sha256(repr(entry).encode()).hexdigest()


@functools.cache
def digest_of_tools() -> str:
    """Digest of what makes the files of all examples."""
    installed = sorted(f"{one.name} {one.version}" for one in distributions())
    digest = hashlib.sha256(repr((sys.version, installed)).encode())
    for file in sorted(file for place in MADE_OF for file in (ROOT / place).rglob("*")):
        if file.is_file() and not {"__pycache__", "node_modules"} & set(file.parts):
            digest.update(repr((str(file.relative_to(ROOT)), file.stat().st_size)).encode() + file.read_bytes())
    return digest.hexdigest()


def drop_old(folder: Path, examples: list[Example], *, quick: bool) -> None:
    """Empty the site's folder, but for the files of examples that would be made again as they are."""
    for path in folder.iterdir() if folder.is_dir() else ():
        example = next((one for one in examples if one.name == path.name), None)
        if example and is_made(path, digest_of(example, quick=quick)):
            continue
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def is_made(folder: Path, digest: str) -> bool:
    """Whether an example's folder holds all files that were made of what has a digest."""
    return (folder / MADE).is_file() and (folder / MADE).read_text() == digest


def make_files(folder: Path, example: Example, *, quick: bool) -> None:
    """Make what an example loads, and the script that gives it to pages from the disk, unless they are there."""
    own = folder / example.name
    digest = digest_of(example, quick=quick)
    if is_made(own, digest):
        report(f"{example.name}: its files are as they were")
    else:
        own.mkdir()
        _make_files(own, example, quick=quick)
        (own / MADE).write_text(digest)
    shutil.copyfile(example.path, own / f"example{example.path.suffix}")


def _make_files(folder: Path, example: Example, *, quick: bool) -> None:
    made = set(folder.iterdir())
    for name in example.sources:
        report(f"{example.name}: making {name}")
        SOURCES[name](folder, quick=quick)
    unwanted = set(folder.iterdir()) - made
    for line in example.commands:
        report(f"{example.name}: {line}")
        run(line, folder)
    for path in unwanted - {folder / name for name in example.files}:
        shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    if example.files:
        contents = [(name, base64.b64encode((folder / name).read_bytes()).decode()) for name in example.files]
        lines = [f'"{name}": "data:application/octet-stream;base64,{text}"' for name, text in contents]
        (folder / "files.js").write_text(f"globalThis.galleryFiles = {{{', '.join(lines)}}};\n", encoding="utf-8")


def icon_facts(folder: Path, example: Example) -> str:
    """Sentence of the icons' page about its texture, compared with another project's icons."""
    if example.name != "icons":
        return ""
    texture = folder / "icons" / "lucide.ktx2"
    count, weight = len(vexture.load(texture).roots), Weight.of(texture)
    theirs, size, sent = LUCIDE_OF_GLYPH
    return (
        f"{count:,} icons of Lucide in one texture of {spoken(weight.plain)}, {spoken(weight.sent)} by gzip: "
        f"{weight.plain / count:.0f} and {weight.sent / count:.0f} bytes an icon. pmndrs/glyph says of its baked "
        f"Lucide icons: {theirs:,} in 3 MiB, {sent // 1000} kB compressed, which is {size / theirs:,.0f} and "
        f"{sent / theirs:.0f} bytes an icon (their figures; other versions of Lucide)."
    )


def drawn_thumbnail(folder: Path, example: Example) -> None:
    """Draw a thumbnail on the processor: of the example's first texture, or the ground of a flood's page."""
    picture = Image.new("RGB", THUMBNAIL, "#dfe8ec")
    for file in (name for name in example.files if name.endswith(".ktx2")):
        texture = vexture.load(folder / example.name / file)
        with contextlib.suppress(vexture.VextureError):
            shape = np.uint8(255 * np.clip(texture.render(size=THUMBNAIL[1], root=texture.roots[0].name), 0, 1))
            own = Image.fromarray(shape) if shape.ndim == 3 else Image.new("RGBA", shape.shape[::-1], "#123a5c")
            mask = own.getchannel("A") if shape.ndim == 3 else Image.fromarray(shape)
            picture.paste(own.convert("RGB"), ((THUMBNAIL[0] - THUMBNAIL[1]) // 2, 0), mask)
            break
    picture.save(folder / example.name / "thumbnail.jpg", quality=82)


def digest_of_page(folder: Path, example: Example) -> str:
    """Digest of the page of an example, with all that it loads and its picture."""
    files = [path for path in (folder / example.name).rglob("*") if path.is_file() and path.name != PICTURED]
    files += [folder / "lib" / f"{name}.js" for name in example.libraries]
    files += [path for path in folder.iterdir() if path.suffix in (".css", ".js")]
    digest = hashlib.sha256()
    for path in sorted(files):
        digest.update(repr((str(path.relative_to(folder)), path.stat().st_size)).encode() + path.read_bytes())
    return digest.hexdigest()


def is_pictured(folder: Path, example: Example) -> bool:
    """Whether the picture of an example is a screenshot of its page as it is now."""
    said = folder / example.name / PICTURED
    return said.is_file() and said.read_text() == digest_of_page(folder, example)


def save_picture(folder: Path, example: Example, picture: Image.Image) -> None:
    """Save a screenshot of the page of an example as its picture, and write down of which page it is."""
    picture.save(folder / example.name / "thumbnail.jpg", quality=82)
    (folder / example.name / PICTURED).write_text(digest_of_page(folder, example))


def take_thumbnails(folder: Path, examples: list[Example]) -> bool:
    """Take the thumbnails of pages that have changed by Chromium; returns whether there is one."""
    try:
        from chromium import CHROMIUM, chromium
    except ImportError:
        return False
    if not Path(CHROMIUM).is_file():
        return False
    try:
        with chromium("--enable-unsafe-webgpu") as browser:
            for example in (one for one in examples if not is_pictured(folder, one)):
                report(f"{example.name}: taking its picture in Chromium")
                page = browser.new_page(viewport={"width": 1280, "height": 800}, device_scale_factor=1)
                page.goto((folder / example.name / "index.html").as_uri())
                page.add_style_tag(content="#stage { position: fixed !important; inset: 0; z-index: 9 }")
                if example.libraries:
                    page.evaluate("document.getElementById('run').click()")  # again, in the size of the picture
                    page.wait_for_function("document.documentElement.dataset.state === 'ran'", timeout=60_000)
                page.wait_for_timeout(6_000 if example.page else 2_500)
                content = page.locator("#stage").screenshot(timeout=120_000)
                picture = Image.open(io.BytesIO(content)).convert("RGB").resize(THUMBNAIL, Image.Resampling.LANCZOS)
                save_picture(folder, example, picture)
                page.close()
    except ImportError:
        return False
    return True


def read_package(name: str) -> Any:
    """Read the package.json of a package."""
    return json.loads((WEB / "node_modules" / name / "package.json").read_text(encoding="utf-8"))


def held_packages() -> list[str]:
    """Packages in those that hold others; types are not in them."""
    names = {one for holder in HOLDS_OTHERS for one in read_package(holder)["dependencies"]}
    return sorted(name for name in names if not name.startswith("@types/"))


def licence_of(name: str) -> str:
    """The licence of a package of web/; or else the one kept here, or what it is called."""
    found = [*(WEB / "node_modules" / name).glob("LICENSE*"), *(GALLERY / "libraries").glob(f"{name}.LICENSE")]
    if not found:
        return f"{read_package(name)['license']}, by {read_package(name)['author']}"
    return found[0].read_text(encoding="utf-8").strip()


def write_licences(folder: Path, examples: list[Example]) -> None:
    """Write the licences of what is bundled and converted."""
    parts = [f"{name}\n\n{licence_of(name)}\n" for name in [*LICENSED, *held_packages()]]
    sources = {source for one in examples for source in one.sources}
    data = {
        ICONS: {"lucide"},
        COUNTIES: {"counties.geojson", "counties.topojson"},
        WORLD: {"land.svg", "countries.json"},
    }
    for package, made in data.items():
        if made & sources:
            parts.append(
                f"{package.name}\n\n{(package.installed_folder() / 'LICENSE').read_text(encoding='utf-8').strip()}\n"
            )
    (folder / "lib" / "LICENSES.txt").write_text("\n".join(parts), encoding="utf-8")


def build(folder: Path, *, quick: bool = False, only: tuple[str, ...] = (), pictures: bool = True) -> None:
    """Write the site into a folder, which is emptied first; files that nothing has changed for stay."""
    if not (WEB / "node_modules" / "three").is_dir():
        sys.exit("the packages of web/ are not installed; type: npm ci --prefix web")
    shown = [one for one in examples() if not only or one.name in only]
    drop_old(folder, shown, quick=quick)
    (folder / "lib").mkdir(parents=True)
    for name in sorted({name for one in shown for name in one.libraries}):
        report(f"bundling lib/{name}.js")
        bundle(folder / "lib", name)
    for name in ("gallery.css", "page.js", "frame.js", "jsx.js"):
        shutil.copyfile(GALLERY / "pages" / name, folder / name)
    write_licences(folder, shown)
    for example in shown:
        make_files(folder, example, quick=quick)
    for place, example in enumerate(shown):
        around = shown[place - 1], shown[(place + 1) % len(shown)]
        write_page(folder, example, around, icon_facts(folder, example))
    if not (pictures and take_thumbnails(folder, shown)):
        for example in shown:
            report(f"{example.name}: drawing its picture")
            drawn_thumbnail(folder, example)
    write_index(folder, shown, {one.name: "thumbnail.jpg" for one in shown}, CREDITS)


def main() -> None:
    """Build into the folder that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=GALLERY / "built")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", action="append", default=[])
    options = parser.parse_args()
    folder = options.folder.resolve()
    build(folder, quick=options.quick, only=tuple(options.only))
    print(f"Open {folder / 'index.html'} in a browser, or copy the folder to any static host.")


if __name__ == "__main__":
    main()
