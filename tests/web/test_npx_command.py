"""`npx vexture convert`: it writes the bytes that `convertData` gives, or one line for each failure."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

import vexture
from build_wasm import OUTPUT
from chromium import ROOT, WEB

COMMAND = WEB / "bin" / "vexture.js"
BADGE = WEB / "test" / "fixtures" / "badge.svg"
DUCK = ROOT / "examples" / "shapes" / "duck.svg"
BLURRED = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="4" height="4" filter="blur(1px)"/>'
    '<path d="M5 5h2v2z" fill="red"/></svg>'
)

CONVERTED = """
import {{ readFile, writeFile }} from 'node:fs/promises';
import {{ convertData, writePacked }} from '{convert}';
const [source, place, options] = process.argv.slice(1);
await writeFile(place, await writePacked(await convertData(await readFile(source), JSON.parse(options))));
"""
"""Writes what `convertData` gives."""


def node(*arguments: object, content: bytes | None = None, folder: Path | None = None) -> tuple[int, bytes, str]:
    """Run Node.js; return its exit code, standard output, and standard error."""
    found = shutil.which("node")
    if found is None:
        pytest.skip("no node (on Debian: apt-get install nodejs)")
    if not all((OUTPUT / f"{name}.wasm").is_file() for name in ("silhouettes", "maps", "strokes")):
        pytest.skip("no kernels (make wasm)")
    command = [found, *map(str, arguments)]
    outcome = subprocess.run(command, input=content or b"", capture_output=True, check=False, cwd=folder)
    return outcome.returncode, outcome.stdout, outcome.stderr.decode()


@pytest.mark.parametrize(
    ("source", "arguments", "options"),
    [
        (BADGE, (), {}),
        (DUCK, ("--tolerance", "1e-3", "--max-depth", "8"), {"tolerance": 1e-3, "maxDepth": 8}),
        (BADGE, ("--silhouette",), {"split": None}),
        (BADGE, ("--restyle",), {"restyle": True}),
    ],
)
def test_files_hold_the_bytes_of_convert(
    source: Path, arguments: tuple[str, ...], options: dict[str, object], tmp_path: Path
) -> None:
    assert node(COMMAND, "convert", source, *arguments, "-o", tmp_path / "made")[0] == 0
    made = tmp_path / "made" / f"{source.stem}.ktx2"
    convert = (WEB / "src" / "convert" / "index.js").as_uri()
    expected = tmp_path / "expected.ktx2"
    given = json.dumps({"name": source.stem, **options})
    code, _, errors = node("--input-type=module", "-e", CONVERTED.format(convert=convert), source, expected, given)
    assert code == 0, errors
    assert made.read_bytes() == expected.read_bytes()
    vexture.load(made).check()


def test_sources_and_places(tmp_path: Path) -> None:
    shutil.copy(BADGE, tmp_path / "my.logo.svg")
    assert node(COMMAND, "convert", "my.logo.svg", DUCK, folder=tmp_path)[:2] == (0, b"")
    assert vexture.load(tmp_path / "my.logo.ktx2").roots[0].name == "my.logo"
    assert node(COMMAND, "convert", "my.logo.svg", "-o", "own.ktx2", "-q", folder=tmp_path) == (0, b"", "")
    assert {path.name for path in tmp_path.iterdir()} == {"my.logo.svg", "my.logo.ktx2", "duck.ktx2", "own.ktx2"}
    code, output, _ = node(COMMAND, "convert", "-", "-o", "-", content=BADGE.read_bytes())
    assert (code, output[1:7]) == (0, b"KTX 20")


def test_each_failure_is_one_line_and_leaves_no_file(tmp_path: Path) -> None:
    (tmp_path / "blurred.svg").write_text(BLURRED, encoding="utf-8")
    (tmp_path / "note.txt").write_text("Dear all", encoding="utf-8")
    sources = ("blurred.svg", "none.svg", "note.txt")
    code, output, errors = node(COMMAND, "convert", *sources, "-o", "made", folder=tmp_path)
    first, size, missing, wrong, sum_line, *rest = errors.splitlines()
    assert (code, output, rest) == (1, b"", [])
    assert first == "vexture: warning: blurred.svg: left out: filter of blur"
    assert size.startswith("vexture: made/blurred.ktx2: ")
    assert missing.startswith("vexture: none.svg: cannot be read (ENOENT: ")
    assert wrong == 'vexture: note.txt: the source is a text that begins with "Dear all"; give SVG, GeoJSON or TopoJSON'
    assert sum_line == "vexture: 2 of 3 files failed"
    assert [path.name for path in (tmp_path / "made").iterdir()] == ["blurred.ktx2"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("convert", "blurred.svg", "--strict"), "left out: filter of blur; change the drawing, or convert it without"),
        (("convert", "blurred.svg", "--tolerance", "much"), '`tolerance` "much" is no number from 0 to below 1'),
        (("convert", "blurred.svg", "--split", "colour"), "must be 'auto', 'faces', 'paint' or null"),
        (("convert", "blurred.svg", "--split", "faces", "--silhouette"), "exclude each other; leave one out"),
        (("convert", "blurred.svg", "--colour"), "Unknown option '--colour'"),
        (("convert", "blurred.svg", "./blurred.svg"), "would both be blurred.ktx2; rename one"),
        (("convert", "blurred.svg", "b.svg", "-o", "a.ktx2"), "a.ktx2 is one file for 2 sources; give a folder"),
        (("convert",), "no sources; give SVG or GeoJSON files"),
        (("view", "blurred.svg"), "'view' is no command; there is convert"),
    ],
)
def test_what_is_wrong_is_one_line(tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    (tmp_path / "blurred.svg").write_text(BLURRED, encoding="utf-8")
    code, output, errors = node(COMMAND, *arguments, folder=tmp_path)
    assert (code, output) == (1, b"")
    assert errors.startswith("vexture: ")
    assert errors.count("\n") == 1
    assert message in errors
    assert [path.name for path in tmp_path.iterdir()] == ["blurred.svg"]


def test_help_and_version() -> None:
    version = json.loads((WEB / "package.json").read_text(encoding="utf-8"))["version"]
    assert node(COMMAND, "--version") == (0, f"{version}\n".encode(), "")
    code, output, errors = node(COMMAND, "convert", "--help")
    assert (code, errors) == (0, "")
    assert output.startswith(b"Usage: npx vexture convert")
