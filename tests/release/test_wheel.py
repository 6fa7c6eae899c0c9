"""A wheel as `make dist` builds it, installed outside the checkout, without Node.js, and used as a newcomer would.

`make dist-check` tries the artefacts in dist/ so, with all that pip installs for them, and kernels compiled anew.
"""

import ast
import json
import os
import re
import subprocess
import sys
import tarfile
import urllib.request
import zipfile
from collections.abc import Callable
from importlib.metadata import packages_distributions
from io import BytesIO
from pathlib import Path

import pytest
from installed import Installed
from packaging.metadata import Metadata
from packaging.utils import canonicalize_name
from PIL import Image

from dist import build
from vexture.errors import DeviceError
from vexture.live.page import FLOOD, VIEWER, built

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src"
GIVEN = os.environ.get("VEXTURE_DIST")
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4"><path d="M0 0H4L2 4Z"/></svg>'
LAKE = '{"type": "Polygon", "coordinates": [[[4, 52], [4.1, 52], [4.1, 52.1], [4, 52]]]}'


@pytest.fixture(scope="module")
def artefacts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a wheel and an sdist."""
    if GIVEN:
        return Path(GIVEN).resolve()
    try:
        built(VIEWER.script)
    except DeviceError as error:
        pytest.skip(str(error))
    folder = tmp_path_factory.mktemp("dist")
    build(ROOT, folder)
    return folder


@pytest.fixture(scope="module")
def wheel(artefacts: Path) -> Path:
    (found,) = artefacts.glob("vexture-*.whl")
    return found


@pytest.fixture(scope="module")
def metadata(wheel: Path) -> Metadata:
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return Metadata.from_email(archive.read(name))


@pytest.fixture(scope="module")
def vexture(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    installed = Installed(tmp_path_factory.mktemp("installed"), wheel, whole=bool(GIVEN))
    (installed.work / "triangle.svg").write_text(DRAWING)
    (installed.work / "lake.geojson").write_text(LAKE)
    return installed


def belonging() -> set[str]:
    """Files of the package, as paths below src/."""
    files = (path for path in (SOURCES / "vexture").rglob("*") if path.is_file() and path.suffix != ".pyc")
    return {path.relative_to(SOURCES).as_posix() for path in files}


def test_the_wheel_holds_the_package_with_its_pages_and_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        information = {name.partition("/")[2] for name in archive.namelist() if ".dist-info/" in name}
        notices = archive.read("vexture/live/built/LICENSES.txt").decode()
    assert names == belonging()
    assert {f"vexture/live/built/{name}" for name in (*VIEWER, *FLOOD)} < names
    assert "three.js authors" in notices
    assert information == {
        "METADATA",
        "RECORD",
        "WHEEL",
        "entry_points.txt",
        "licenses/LICENSE",
        "top_level.txt",
    }


def test_the_sdist_holds_what_the_wheel_is_built_from_and_nothing_else(artefacts: Path) -> None:
    (sdist,) = artefacts.glob("vexture-*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()}
    assert {name for name in names if not name.startswith("src/vexture.egg-info/")} == {
        *(f"src/{name}" for name in belonging()),
        *("LICENSE", "PKG-INFO", "README.md", "pyproject.toml", "setup.cfg"),
    }


def test_the_same_files_become_the_same_bytes(tmp_path: Path) -> None:
    """Of another time and other permissions."""
    folder = tmp_path / "project"
    (folder / "src" / "small").mkdir(parents=True)
    (folder / "src" / "small" / "__init__.py").write_text('"""A package."""\n')
    (folder / "README.md").write_text("[licence](LICENSE)\n")
    project = '[project]\nname = "small"\nversion = "1"\n[tool.setuptools.packages.find]\nwhere = ["src"]\n'
    (folder / "pyproject.toml").write_text(project)
    first = [path.read_bytes() for path in build(folder, tmp_path / "first")]
    for path in folder.rglob("*"):
        path.chmod(0o700)
        os.utime(path, (1e9, 1e9))
    assert [path.read_bytes() for path in build(folder, tmp_path / "second")] == first


def test_its_metadata_are_complete(metadata: Metadata) -> None:
    assert metadata.license_expression == "MIT"
    assert metadata.license_files == ["LICENSE"]
    assert metadata.description_content_type == "text/markdown"
    assert all((metadata.summary, metadata.keywords, metadata.classifiers, metadata.author))
    assert (metadata.description or "").startswith("# vexture")


def test_all_that_it_imports_is_required(wheel: Path, metadata: Metadata) -> None:
    homes = packages_distributions()
    required = {canonicalize_name(requirement.name) for requirement in metadata.requires_dist or ()}
    imported = set[str]()
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if name.endswith(".py"):
                for node in ast.walk(ast.parse(archive.read(name))):
                    imported |= modules_of(node)
    others = imported - set(sys.stdlib_module_names) - {"vexture"}
    assert {"numpy", "starlette", "rasterio"} < others
    assert {
        name for name in others if not required & {canonicalize_name(home) for home in homes.get(name, ())}
    } == set()


def modules_of(node: ast.AST) -> set[str]:
    """Top-level modules that a statement imports."""
    if isinstance(node, ast.Import):
        return {alias.name.partition(".")[0] for alias in node.names}
    if isinstance(node, ast.ImportFrom) and node.module and not node.level:
        return {node.module.partition(".")[0]}
    return set()


def test_requirements_agree(vexture: Installed) -> None:
    assert vexture.pip("check").strip() == "No broken requirements found."


def test_all_modules_import_without_extras(vexture: Installed) -> None:
    """What an extra installs is imported where it is used; the wheel is the one that is imported."""
    outcome = vexture.python(
        "import importlib, pkgutil, vexture; print(vexture.__file__)\n"
        "for module in pkgutil.walk_packages(vexture.__path__, 'vexture.'): importlib.import_module(module.name)\n"
    )
    assert (outcome.returncode, outcome.stderr) == (0, "")
    assert Path(outcome.stdout.strip()).is_relative_to(vexture.site)


def test_it_converts_describes_and_renders(vexture: Installed) -> None:
    for command in (
        ["convert", "triangle.svg"],
        ["info", "triangle.ktx2", "--json"],
        ["render", "triangle.ktx2", "-o", "triangle.png", "--size", "16", "--renderer", "cpu"],
        ["render", "triangle.svg", "-o", "exact.png", "--size", "16", "--renderer", "exact"],
    ):
        outcome = vexture.run(*command)
        assert outcome.returncode == 0, outcome.stderr
        if command[0] == "info":
            assert json.loads(outcome.stdout)["name"] == "triangle"
    for name in ("triangle.png", "exact.png"):
        assert (vexture.work / name).read_bytes().startswith(b"\x89PNG")


def test_it_exports_a_page(vexture: Installed) -> None:
    outcome = vexture.run("export", "triangle.svg", "-o", "triangle.html")
    assert outcome.returncode == 0, outcome.stderr
    page = (vexture.work / "triangle.html").read_text(encoding="utf-8")
    assert built(VIEWER.script).decode()[:1000] in page


def test_it_shows_a_drawing(vexture: Installed) -> None:
    command = vexture.command("view", "triangle.svg", "--no-open")
    with subprocess.Popen(
        command, cwd=vexture.work, env=vexture.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as server:
        try:
            said = server.stdout.readline() if server.stdout else ""
            address = re.search(r"http://\S+/", said)
            assert address, server.communicate()[1]
            with urllib.request.urlopen(address[0], timeout=60) as answer:
                page = answer.read().decode()
            assert VIEWER.script in page
            with urllib.request.urlopen(address[0] + VIEWER.script, timeout=60) as answer:
                assert answer.read() == built(VIEWER.script)
        finally:
            server.terminate()


def test_it_shows_a_flood(vexture: Installed) -> None:
    outcome = vexture.run("flood", "--extent", "lake.geojson", "-o", "lake.html")
    assert outcome.returncode == 0, outcome.stderr
    assert built(FLOOD.script).decode()[:1000] in (vexture.work / "lake.html").read_text(encoding="utf-8")


def picture() -> bytes:
    """A black square on white, as PNG."""
    image, file = Image.new("L", (8, 8), 255), BytesIO()
    image.paste(0, (2, 2, 6, 6))
    image.save(file, "PNG")
    return file.getvalue()


@pytest.mark.parametrize(
    ("file", "content", "command", "extra"),
    [
        ("depths.tif", b"II*\0", ["flood", "-o", "x.html", "--extent"], "gis"),
        ("wet.gpkg", b"SQLite format 3\0" + bytes(52) + b"GPKG", ["convert"], "gis"),
        ("square.png", picture, ["convert"], "trace"),
    ],
    ids=["depths", "areas", "picture"],
)
def test_what_needs_an_extra_names_it_in_one_line(
    vexture: Installed, file: str, content: bytes | Callable[[], bytes], command: list[str], extra: str
) -> None:
    (vexture.work / file).write_bytes(content if isinstance(content, bytes) else content())
    outcome = vexture.run(*command, file)
    assert outcome.returncode == 1
    assert len(outcome.stderr.splitlines()) == 1
    assert outcome.stderr.endswith(f"pip install 'vexture[{extra}]'\n")
