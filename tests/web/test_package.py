"""The npm package as a stranger gets it: its tarball, its types, its size in a bundle."""

import gzip
import json
import shutil
import subprocess
import tarfile
from pathlib import Path
from typing import Any

import pytest

from chromium import ROOT, WEB
from dist import build

MODULES = WEB / "node_modules"

FIRST_LOAD_LIMIT = 23_800
"""Bytes, minified and deflated, of what a page with vector textures loads at first, without three.js."""

MAP_LOAD_LIMIT = 46_700
"""The same of all that it loads for a planar map."""

MAP_MARKS = ("vextureSheets(int", "convert the drawing with that colour", "plus-lighter")
"""Text of what only planar maps need: their shader, new colours for their elements, their gradients."""

TILE_LOAD_LIMITS = {"vexture/maplibre": 53_000, "vexture/globe": 53_000}
"""And what a page with a pyramid of tiles loads, all that it loads later included, without MapLibre and three.js."""

OTHERS = [f"--external:{name}" for name in ("three", "react", "@react-three/fiber", "maplibre-gl")]
"""What a page has anyhow."""

WEBGPU_LIMIT = 27_800
"""And what a page with nodes loads: both languages are in it, as the backend is known later."""

TEXT_LIMIT = 39_000
"""And what a page with texts loads at first, without its worker."""

REACT_LIMIT = 2_000
"""And of what the components of React Three Fiber add."""


def _run(*command: str | Path, cwd: Path) -> str:
    outcome = subprocess.run([*map(str, command)], cwd=cwd, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return outcome.stdout


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project in which the package's tarball and what it depends on are installed."""
    if not (MODULES / "three").is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    folder = tmp_path_factory.mktemp("project")
    name = _run("npm", "pack", "--silent", "--pack-destination", folder, cwd=WEB).split()[-1]
    (folder / "package.json").write_text('{"name": "project", "type": "module"}', encoding="utf-8")
    modules = folder / "node_modules"
    modules.mkdir()
    for one in MODULES.iterdir():
        if one.name not in ("vexture", ".bin"):
            (modules / one.name).symlink_to(one)
    with tarfile.open(folder / name) as tarball:
        tarball.extractall(folder, filter="data")
    (folder / "package").rename(modules / "vexture")
    return folder


@pytest.mark.slow
def test_the_tarball_has_what_it_needs_and_nothing_else(project: Path) -> None:
    package = project / "node_modules" / "vexture"
    assert (package / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    folders = {path.name for path in package.iterdir()}
    assert folders == {"LICENSE", "README.md", "bin", "fonts", "generated", "kernels", "package.json", "src", "types"}
    for module in (package / "src").rglob("*.js"):
        types = package / "types" / module.relative_to(package).with_suffix(".d.ts")
        assert types.is_file()


@pytest.mark.slow
def test_a_release_has_the_same_files(project: Path, tmp_path: Path) -> None:
    (released,) = build(WEB, tmp_path)
    (packed,) = project.glob("*.tgz")
    with tarfile.open(released) as one, tarfile.open(packed) as other:
        assert sorted(one.getnames()) == sorted(other.getnames())


@pytest.mark.slow
def test_its_types_serve_a_strict_project_of_react(project: Path) -> None:
    """All entries and types, in the settings of a newcomer, and the package's own declarations."""
    shutil.copytree(Path(__file__).parent / "react", project / "react")
    assert "declarations" in _run("node", Path(__file__).parent / "ours.mjs", "react", cwd=project)


@pytest.mark.slow
def test_its_types_serve_a_project_of_node(project: Path) -> None:
    """Modules are found as Node.js finds them: each import of a declaration names a file."""
    shutil.copytree(Path(__file__).parent / "react", project / "node16")
    settings = project / "node16" / "tsconfig.json"
    text = settings.read_text(encoding="utf-8")
    settings.write_text(text.replace("esnext", "node16").replace("bundler", "node16"), encoding="utf-8")
    assert "declarations" in _run("node", Path(__file__).parent / "ours.mjs", "node16", cwd=project)


@pytest.mark.slow
def test_a_strict_project_checks_all_libraries(project: Path) -> None:
    shutil.copytree(Path(__file__).parent / "react", project / "libraries")
    _run(MODULES / ".bin" / "tsc", "-p", "libraries", cwd=project)


def test_its_modules_import_nothing_until_they_are_asked(project: Path) -> None:
    (project / "nothing.js").write_text(
        "import 'vexture';\nimport { VectorTexture } from 'vexture';\n", encoding="utf-8"
    )
    bundle = _run(MODULES / ".bin" / "esbuild", "nothing.js", "--bundle", "--format=esm", "--minify", cwd=project)
    assert bundle.strip() == ""


def test_a_page_with_vector_textures_loads_little(project: Path) -> None:
    (project / "page.js").write_text(
        "export { VectorMaterial, VectorTextureLoader } from 'vexture';\n", encoding="utf-8"
    )
    outputs, sizes, first = _split("page.js", project)
    later = [name for name in outputs if name not in first]
    assert 10_000 < sum(sizes[name] for name in first) <= FIRST_LOAD_LIMIT
    assert sum(sizes.values()) <= MAP_LOAD_LIMIT
    for mark in MAP_MARKS:
        assert [name in later for name in outputs if mark in (project / name).read_text()] == [True]
    # a bundler that makes one file wraps what is loaded later with all that it imports: three.js had better not be that
    assert "three" not in [one["path"] for name in later for one in outputs[name]["imports"]]


def test_react_components_cost_little_more(project: Path) -> None:
    names = "FoldLoader, VectorMaterial, VectorTextureLoader, applyVectorMask"
    (project / "shared.js").write_text(f"export {{ {names} }} from 'vexture';\n", encoding="utf-8")
    used = "VectorMask, VectorMaterial, useFold, useVectorTexture"  # VectorText is a module of its own
    text = f"export {{ {used} }} from 'vexture/react';\nexport * as shared from './shared.js';\n"
    (project / "react.js").write_text(text, encoding="utf-8")
    loaded = []
    for name in ("shared.js", "react.js"):
        _, sizes, first = _split(name, project)
        loaded.append(sum(sizes[one] for one in first))
    assert 500 < loaded[1] - loaded[0] <= REACT_LIMIT


def test_a_page_with_texts_loads_little_besides_its_worker(project: Path) -> None:
    (project / "texts.js").write_text("export { Text } from 'vexture/text';\n", encoding="utf-8")
    _, sizes, first = _split("texts.js", project, "--external:module")  # HarfBuzz asks Node.js for it
    assert 20_000 < sum(sizes[name] for name in first) <= TEXT_LIMIT


def test_a_page_of_webgpu_loads_little(project: Path) -> None:
    (project / "nodes.js").write_text(
        "export { VectorNodeMaterial, VectorTextureLoader } from 'vexture/webgpu';\n", encoding="utf-8"
    )
    _, sizes, first = _split("nodes.js", project)
    assert 10_000 < sum(sizes[name] for name in first) <= WEBGPU_LIMIT


@pytest.mark.parametrize("entry", TILE_LOAD_LIMITS)
def test_a_page_with_tiles_loads_little(entry: str, project: Path) -> None:
    name = f"{entry.split('/')[1]}.js"
    (project / name).write_text(f"export * from '{entry}';\n", encoding="utf-8")
    outputs, sizes, _ = _split(name, project)
    assert 20_000 < sum(sizes.values()) <= TILE_LOAD_LIMITS[entry]
    imported = {one["path"] for some in outputs.values() for one in some["imports"] if one.get("external")}
    assert imported <= {"three"} if entry == "vexture/globe" else not imported


def test_only_its_own_entry_brings_the_encoding_of_the_thesis(project: Path) -> None:
    marks = (b"thesis_coverage", b"IHDR")
    for entry in ("vexture", "vexture/gltf", "vexture/water", "vexture/thesis"):
        (project / "all.js").write_text(f"export * from '{entry}';\n", encoding="utf-8")
        bundle = _bundled("all.js", project)
        assert [mark in bundle for mark in marks] == [entry == "vexture/thesis"] * 2


def _split(entry: str, project: Path, *more: str) -> tuple[dict[str, Any], dict[str, int], set[str]]:
    """What a bundler makes of a module, the sizes of the files in transit, and those that a page loads at first."""
    folder = entry.removesuffix(".js")
    options = ["--bundle", "--minify", "--format=esm", *OTHERS, *more, "--splitting", f"--outdir={folder}"]
    _run(MODULES / ".bin" / "esbuild", entry, *options, f"--metafile={folder}.json", cwd=project)
    outputs = json.loads((project / f"{folder}.json").read_text())["outputs"]
    sizes = {name: len(gzip.compress((project / name).read_bytes(), 9)) for name in outputs}
    first, waiting = set(), [f"{folder}/{entry}"]
    while waiting:
        name = waiting.pop()
        first.add(name)
        imports = [one["path"] for one in outputs[name]["imports"] if one["kind"] == "import-statement"]
        waiting += [path for path in imports if path in outputs and path not in first]
    return outputs, sizes, first


def _bundled(entry: str, project: Path) -> bytes:
    """One file with all that a module imports, what it would load later included; without three.js."""
    options = ["--bundle", "--minify", "--format=esm", *OTHERS, "--outfile=bundle.js"]
    _run(MODULES / ".bin" / "esbuild", entry, *options, cwd=project)
    return (project / "bundle.js").read_bytes()
