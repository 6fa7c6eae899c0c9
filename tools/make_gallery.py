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
import importlib
import io
import json
import shutil
import sys
from collections.abc import Sequence
from importlib.metadata import distributions
from pathlib import Path
from typing import Any, Final

import click
import numpy as np
from PIL import Image

import vexture
from gallery_bundles import WEB, bundle
from gallery_data import PACKAGES, SOURCES
from gallery_pages import (
    GALLERY,
    ROOT,
    Entry,
    Example,
    OwnPage,
    Weight,
    command_line,
    examples,
    own_pages,
    spoken,
    write_index,
    write_page,
)
from vexture.cli.main import main as command

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
    "@fontsource/pacifico",
    "opentype.js",
    "topojson-client",
    "harfbuzzjs",
    "bidi-js",
    "linebreak",
    "unicode-trie",
    "tiny-inflate",
    "base64-js",
    "brotli",
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

SET_CONTROLS: Final = """(values) => {
  document.head.append(Object.assign(document.createElement('style'), { textContent: '.controls { display: none }' }));
  const isMissing = (label) => !document.querySelector(`[aria-label="${label}"]`);
  for (const label of Object.keys(values).filter((one) => !isMissing(one))) {
    const input = document.querySelector(`[aria-label="${label}"]`);
    input[input.type === 'checkbox' ? 'checked' : 'value'] = values[label];
    input.dispatchEvent(new Event('input'));
  }
  dispatchEvent(new Event('resize')); // so that the picture fills the place of the panel
  return Object.keys(values).filter(isMissing);
}"""
"""Hides the panel of an example and sets its controls; returns the labels of those that it does not have."""

HALT: Final = "globalThis.requestAnimationFrame = () => 0"
"""Lets the last frame of an example stay: without a graphics card, a screenshot waits long between frames."""

LUCIDE_OF_GLYPH: Final = (1_594, 3 * 2**20, 998_000)
"""What pmndrs/glyph says of its baked Lucide icons: number, bytes, bytes compressed."""

CREDITS: Final = (
    'Icons: <a href="https://lucide.dev">Lucide</a> (ISC) and <a href="https://pictogrammers.com">Material Design '
    'Icons</a> (Apache 2.0); flags: <a href="https://flagicons.lipis.dev">flag-icons</a> (MIT). Counties: '
    '<a href="https://github.com/topojson/us-atlas">us-atlas</a>, of the Census Bureau; land and countries: '
    '<a href="https://github.com/topojson/world-atlas">world-atlas</a>, of Natural Earth (both ISC). Figures of '
    "counties: Bureau of Labor Statistics and U.S. Geological Survey (public domain), from "
    '<a href="https://github.com/vega/vega-datasets">vega-datasets</a> (BSD). Coastlines: GSHHG (LGPL). '
    'Fonts: <a href="https://notofonts.github.io">Noto Sans</a>, Sawarabi Gothic and Gowun Dodum, from '
    '<a href="https://fontsource.org">Fontsource</a> (OFL); emoji: '
    '<a href="https://github.com/mozilla/twemoji-colr">Twemoji</a> (CC BY 4.0). '
    '<a href="lib/LICENSES.txt">Licences</a> of these and of the libraries.'
)


def report(step: str) -> None:
    """Print what is done now, at once: the whole takes minutes."""
    print(f"{step} ...", flush=True)


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


def drop_old(folder: Path, examples: Sequence[Example], *, quick: bool) -> None:
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


def drawn_thumbnail(folder: Path, entry: Entry) -> None:
    """Draw a thumbnail on the processor: of the first texture, or a plain ground."""
    picture = Image.new("RGB", THUMBNAIL, "#dfe8ec")
    files = entry.files if isinstance(entry, Example) else ()
    for file in (name for name in files if name.endswith(".ktx2")):
        texture = vexture.load(folder / entry.name / file)
        with contextlib.suppress(vexture.VextureError):
            shape = np.uint8(255 * np.clip(texture.render(size=THUMBNAIL[1], root=texture.roots[0].name), 0, 1))
            own = Image.fromarray(shape) if shape.ndim == 3 else Image.new("RGBA", shape.shape[::-1], "#123a5c")
            mask = own.getchannel("A") if shape.ndim == 3 else Image.fromarray(shape)
            picture.paste(own.convert("RGB"), ((THUMBNAIL[0] - THUMBNAIL[1]) // 2, 0), mask)
            break
    picture.save(folder / entry.name / "thumbnail.jpg", quality=82)


def digest_of_page(folder: Path, entry: Entry) -> str:
    """Digest of a page, with all that it loads, its picture and what is set in the picture."""
    files = [path for path in (folder / entry.name).rglob("*") if path.is_file() and path.name != PICTURED]
    files += [folder / "lib" / f"{name}.js" for name in entry.libraries]
    files += [path for path in folder.iterdir() if path.suffix in (".css", ".js")]
    digest = hashlib.sha256(repr(dict(entry.picture) if isinstance(entry, Example) else {}).encode())
    for path in sorted(files):
        digest.update(repr((str(path.relative_to(folder)), path.stat().st_size)).encode() + path.read_bytes())
    return digest.hexdigest()


def is_pictured(folder: Path, entry: Entry) -> bool:
    """Whether the picture of an entry is a screenshot of its page as it is now."""
    said = folder / entry.name / PICTURED
    return said.is_file() and said.read_text() == digest_of_page(folder, entry)


def save_picture(folder: Path, entry: Entry, picture: Image.Image) -> None:
    """Save a screenshot of the page of an entry as its picture, and write down of which page it is."""
    picture.save(folder / entry.name / "thumbnail.jpg", quality=82)
    (folder / entry.name / PICTURED).write_text(digest_of_page(folder, entry))


def take_thumbnails(folder: Path, entries: Sequence[Entry]) -> bool:
    """Take the thumbnails of pages that have changed by Chromium; returns whether there is one."""
    try:
        from chromium import CHROMIUM, chromium
    except ImportError:
        return False
    if not Path(CHROMIUM).is_file():
        return False
    try:
        with chromium("--enable-unsafe-webgpu") as browser:
            for entry in (one for one in entries if not is_pictured(folder, one)):
                report(f"{entry.name}: taking its picture in Chromium")
                page = browser.new_page(viewport={"width": 1280, "height": 800}, device_scale_factor=1)
                page.goto((folder / entry.name / "index.html").as_uri())
                content = take_picture(page, entry)
                picture = Image.open(io.BytesIO(content)).convert("RGB").resize(THUMBNAIL, Image.Resampling.LANCZOS)
                save_picture(folder, entry, picture)
                page.close()
    except ImportError:
        return False
    return True


def take_picture(page: Any, entry: Entry) -> bytes:
    """A screenshot of an open page: of an example what it draws, without the panel of its controls."""
    if not isinstance(entry, Example):
        page.wait_for_timeout(6_000)
        return bytes(page.screenshot(timeout=120_000))
    page.add_style_tag(content="#stage { position: fixed !important; inset: 0; z-index: 9 }")
    if entry.libraries:
        page.evaluate("document.getElementById('run').click()")  # again, in the size of the picture
        page.wait_for_function("document.documentElement.dataset.state === 'ran'", timeout=60_000)
        missing = page.frames[-1].evaluate(SET_CONTROLS, dict(entry.picture))
        if missing:
            sys.exit(f"{entry.name} has no control {missing[0]!r}, which its picture sets; see gallery.toml")
    page.wait_for_timeout(6_000 if entry.page else 2_500)
    page.frames[-1].evaluate(HALT)
    return bytes(page.locator("#stage").screenshot(timeout=120_000))


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


def write_licences(folder: Path, examples: Sequence[Example]) -> None:
    """Write the licences of what is bundled and converted."""
    parts = [f"{name}\n\n{licence_of(name)}\n" for name in [*LICENSED, *held_packages()]]
    parts.append(f"Noto Sans\n\n{(WEB / 'fonts' / 'LICENSE').read_text(encoding='utf-8').strip()}\n")
    found = {PACKAGES[source] for one in examples for source in one.sources if source in PACKAGES}
    for package in sorted(found, key=lambda one: one.name):
        root = package.installed_folder()
        files = [file.read_text(encoding="utf-8").strip() for file in sorted(root.glob("LICENSE*"))]
        facts = json.loads((root / "package.json").read_text(encoding="utf-8"))
        parts.append(
            "\n\n".join([package.name, *(files or [f"{facts['license']}, by {facts['author']['name']}"])]) + "\n"
        )
    (folder / "lib" / "LICENSES.txt").write_text("\n".join(parts), encoding="utf-8")


def build_own_pages(folder: Path, pages: Sequence[OwnPage]) -> None:
    """Build the pages of their own, each with a link to the index."""
    for page in pages:
        report(f"{page.name}: building its page")
        target = folder / page.name / "index.html"
        importlib.import_module(f"make_{page.name}").build_page(target, '<a href="../index.html">Gallery</a>')


def build(folder: Path, *, quick: bool = False, only: tuple[str, ...] = (), pictures: bool = True) -> None:
    """Write the site into a folder, which is emptied first; files that nothing has changed for stay."""
    if not (WEB / "node_modules" / "three").is_dir():
        sys.exit("the packages of web/ are not installed; type: npm ci --prefix web")
    shown = [one for one in examples() if not only or one.name in only]
    own = [one for one in own_pages() if not only or one.name in only]
    entries: list[Entry] = [*own, *shown]
    drop_old(folder, shown, quick=quick)
    (folder / "lib").mkdir(parents=True)
    for name in sorted({name for one in entries for name in one.libraries}):
        report(f"bundling lib/{name}.js")
        bundle(folder / "lib", name)
    for name in ("gallery.css", "page.js", "frame.js", "jsx.js", "helpers.js"):
        shutil.copyfile(GALLERY / "pages" / name, folder / name)
    build_own_pages(folder, own)
    for example in shown:
        make_files(folder, example, quick=quick)
    write_licences(folder, shown)
    for place, example in enumerate(shown, len(own)):
        around = entries[place - 1], entries[(place + 1) % len(entries)]
        write_page(folder, example, around, icon_facts(folder, example))
    if not (pictures and take_thumbnails(folder, entries)):
        report("drawing the pictures of the index" + (", as there is no Chromium with Playwright" if pictures else ""))
        for entry in entries:
            drawn_thumbnail(folder, entry)
    write_index(folder, entries, CREDITS)


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
