"""Wheels as `make dist` builds them, installed outside the checkout, without Node.js, and used as a newcomer would.

The core is installed alone, with its 13 requirements, and with vexture-geo beside it.

`make dist-check` tries the artefacts in dist/ so, with all that pip installs for them: the wheel for any platform,
whose kernels are compiled anew, and the one for this platform, which brings them along.
"""

import ast
import json
import os
import re
import subprocess
import tarfile
import urllib.request
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from installed import Installed
from packaging.metadata import Metadata
from PIL import Image
from wheel_contents import imported_by, metadata_of, not_required

from compile_kernels import tag
from dist import COMPILED, build
from vexture.base.errors import DeviceError
from vexture.pages.page import VIEWER, built
from vexture_geo.flood.bundle import FLOOD

ROOT = Path(__file__).parents[2]
PACKAGES = ROOT / "packages"
SOURCES = PACKAGES / "vexture" / "src"
GEO_SOURCES = PACKAGES / "vexture-geo" / "src"
GIVEN = os.environ.get("VEXTURE_DIST")
WHEELS = ("any", "platform") if GIVEN else ("any",)
AHEAD = re.compile(r"^@kernel\(.*\bahead=True.*\)\ndef (\w+)", re.M)
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4"><path d="M0 0H4L2 4Z"/></svg>'
LAKE = '{"type": "Polygon", "coordinates": [[[4, 52], [4.1, 52], [4.1, 52.1], [4, 52]]]}'


@pytest.fixture(scope="module")
def artefacts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the wheels and sdists of the core and of vexture-geo."""
    if GIVEN:
        return Path(GIVEN).resolve()
    try:
        built(VIEWER.script)
    except DeviceError as error:
        pytest.skip(str(error))
    folder = tmp_path_factory.mktemp("dist")
    for name in ("vexture", "vexture-geo"):
        build(PACKAGES / name, folder)
    return folder


@pytest.fixture(scope="module", params=WHEELS)
def wheel(artefacts: Path, request: pytest.FixtureRequest) -> Path:
    for_any = request.param == "any"
    (found,) = (path for path in artefacts.glob("vexture-*.whl") if path.stem.endswith("-none-any") == for_any)
    return found


@pytest.fixture(scope="module")
def geo_wheel(artefacts: Path) -> Path:
    (found,) = artefacts.glob("vexture_geo-*.whl")
    return found


@pytest.fixture(scope="module")
def evidence(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Wheel of vexture-evidence."""
    folder = Path(GIVEN).resolve() if GIVEN else tmp_path_factory.mktemp("evidence")
    if not GIVEN:
        build(PACKAGES / "vexture-evidence", folder)
    (found,) = folder.glob("vexture_evidence-*.whl")
    return found


@pytest.fixture(scope="module")
def metadata(wheel: Path) -> Metadata:
    return metadata_of(wheel)


@pytest.fixture(scope="module")
def vexture(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    return installed_in(tmp_path_factory.mktemp("installed"), wheel)


@pytest.fixture(scope="module")
def with_geo(wheel: Path, geo_wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    return installed_in(tmp_path_factory.mktemp("with_geo"), wheel, geo_wheel)


def installed_in(folder: Path, *wheels: Path) -> Installed:
    """Wheels in an environment of their own, with two files to work on."""
    installed = Installed(folder, *wheels, whole=bool(GIVEN))
    (installed.work / "triangle.svg").write_text(DRAWING)
    (installed.work / "lake.geojson").write_text(LAKE)
    return installed


def belonging(package: Path = SOURCES / "vexture") -> set[str]:
    """Files of a package, as paths below src/; compiled kernels belong to a platform."""
    files = (path for path in package.rglob("*") if path.is_file() and path.suffix not in (".pyc", ".code"))
    return {path.relative_to(package.parent).as_posix() for path in files}


def compiled_ahead() -> set[str]:
    """Kernels that the wheel of a platform brings along, each with its module."""
    modules = {path: path.relative_to(SOURCES).with_suffix("") for path in (SOURCES / "vexture").rglob("*.py")}
    return {
        f"{'.'.join(name.parts)}.{kernel}"
        for path, name in modules.items()
        for kernel in AHEAD.findall(path.read_text())
    }


@pytest.mark.slow
def test_the_wheel_holds_the_package_with_its_pages_and_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        information = {name.partition("/")[2] for name in archive.namelist() if ".dist-info/" in name}
        notices = archive.read("vexture/pages/built/LICENSES.txt").decode()
    kernels = {name for name in names if name.startswith("vexture/compiled/")}
    assert names - kernels == belonging()
    for_any = wheel.stem.endswith("-none-any")
    assert {Path(name).name.partition("-")[0] for name in kernels} == (set() if for_any else compiled_ahead())
    assert {f"vexture/pages/built/{name}" for name in (VIEWER.script, VIEWER.style)} < names
    assert "three.js authors" in notices
    assert information == {
        "METADATA",
        "RECORD",
        "WHEEL",
        "entry_points.txt",
        "licenses/LICENSE",
        "top_level.txt",
    }


def test_the_wheel_of_geographic_data_holds_its_package_with_its_page(geo_wheel: Path) -> None:
    with zipfile.ZipFile(geo_wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        notices = archive.read("vexture_geo/flood/built/LICENSES.txt").decode()
    assert names == belonging(GEO_SOURCES / "vexture_geo")
    assert {f"vexture_geo/flood/built/{name}" for name in (FLOOD.script, FLOOD.style)} < names
    assert "three.js authors" in notices


def test_the_sdist_holds_what_the_wheel_is_built_from_and_nothing_else(artefacts: Path) -> None:
    (sdist,) = artefacts.glob("vexture-*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()}
    assert {name for name in names if not name.startswith("src/vexture.egg-info/")} == {
        *(f"src/{name}" for name in belonging()),
        *("LICENSE", "PKG-INFO", "README.md", "pyproject.toml", "setup.cfg"),
    }


@pytest.mark.slow
def test_the_same_files_become_the_same_bytes(tmp_path: Path) -> None:
    """Of another time and other permissions; compiled kernels are in the wheel of this platform, and in that alone."""
    folder = tmp_path / "project"
    (folder / COMPILED).mkdir(parents=True)
    (folder / COMPILED / "a.code").write_bytes(b"code")
    (folder / "src" / "vexture" / "__init__.py").write_text('"""A package."""\n')
    (folder / "README.md").write_text("[licence](LICENSE)\n")
    (folder / "pyproject.toml").write_text(
        '[project]\nname = "small"\nversion = "1"\n[tool.setuptools.packages.find]\nwhere = ["src"]\n'
        '[tool.setuptools.package-data]\nvexture = ["compiled/*.code"]\n'
    )
    first = {path.name: path.read_bytes() for path in build(folder, tmp_path / "first")}
    assert set(first) == {"small-1-py3-none-any.whl", f"small-1-py3-none-{tag()}.whl", "small-1.tar.gz"}
    for name, content in first.items():
        if name.endswith(".whl"):
            code = "vexture/compiled/a.code" in zipfile.ZipFile(BytesIO(content)).namelist()
            assert code == (not name.endswith("-any.whl"))
        else:
            with tarfile.open(fileobj=BytesIO(content)) as archive:
                assert not [name for name in archive.getnames() if "compiled" in name]
    for path in folder.rglob("*"):
        path.chmod(0o700)
        os.utime(path, (1e9, 1e9))
    assert {path.name: path.read_bytes() for path in build(folder, tmp_path / "second")} == first


def test_its_metadata_are_complete(metadata: Metadata) -> None:
    assert metadata.license_expression == "MIT"
    assert metadata.license_files == ["LICENSE"]
    assert metadata.description_content_type == "text/markdown"
    assert all((metadata.summary, metadata.keywords, metadata.classifiers, metadata.author))
    assert (metadata.description or "").startswith("# vexture")


@pytest.mark.slow
def test_all_that_it_imports_is_required(wheel: Path, metadata: Metadata) -> None:
    others = imported_by(wheel) - {"vexture"}
    assert {"numpy", "starlette"} < others
    assert not_required(others, metadata) == set()


def test_it_requires_few_packages(metadata: Metadata) -> None:
    hard = [str(one) for one in metadata.requires_dist or () if one.marker is None]
    assert len(hard) <= 13, hard


@pytest.mark.slow
def test_all_that_geographic_data_import_is_required(geo_wheel: Path, metadata: Metadata) -> None:
    own = metadata_of(geo_wheel)
    (core,) = (one for one in own.requires_dist or () if one.name == "vexture" and one.marker is None)
    assert (str(core.specifier), core.extras) == (f"=={metadata.version}", {"server"})
    others = imported_by(geo_wheel) - {"vexture", "vexture_geo"}
    assert {"shapely", "rasterio"} < others
    assert not_required(others, own, metadata) == set()


@pytest.mark.slow
def test_the_distribution_of_evidence_holds_its_package_and_adds_a_command(vexture: Installed, evidence: Path) -> None:
    """It is laid beside the installed wheel, where other tests do not see it, without what it only measures with."""
    with zipfile.ZipFile(evidence) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    assert names == belonging(PACKAGES / "vexture-evidence" / "src" / "vexture_evidence")
    assert "report" not in vexture.run("--help").stdout
    beside = vexture.work.parent / "evidence"
    vexture.pip("install", "--quiet", "--no-index", "--no-deps", "--target", str(beside), str(evidence))
    outcome = vexture.run("report", "--help", PYTHONPATH=str(beside))
    assert (outcome.returncode, outcome.stderr) == (0, "")
    assert outcome.stdout.startswith("Usage: vexture report ")


@pytest.mark.slow
def test_all_that_the_distribution_of_evidence_imports_is_required(
    metadata: Metadata, geo_wheel: Path, evidence: Path
) -> None:
    own = metadata_of(evidence)
    hard = [requirement for requirement in own.requires_dist or () if requirement.marker is None]
    (vexture,) = (requirement for requirement in hard if requirement.name == "vexture")
    assert str(vexture.specifier) == f"=={metadata.version}"
    others = imported_by(evidence) - {"vexture", "vexture_evidence", "vexture_geo"}
    assert {"matplotlib", "numpy"} < others
    assert not_required(others, own, metadata, metadata_of(geo_wheel)) == set()


@pytest.mark.slow
def test_requirements_agree(vexture: Installed, with_geo: Installed) -> None:
    for installed in (vexture, with_geo):
        assert installed.pip("check").strip() == "No broken requirements found."


IMPORTS = """
import importlib, pkgutil, {package}; print({package}.__file__)
missing = set()
for module in pkgutil.walk_packages({package}.__path__, "{package}."):
    try:
        importlib.import_module(module.name)
    except ModuleNotFoundError as error:
        missing.add((module.name.rpartition(".")[0], error.name.partition(".")[0]))
print(sorted(missing))
"""


def test_modules_of_the_core_import_without_extras(vexture: Installed) -> None:
    """Servers and widgets are built on an extra's classes; their modules are imported where they are used."""
    outcome = vexture.python(IMPORTS.format(package="vexture"))
    assert (outcome.returncode, outcome.stderr) == (0, "")
    place, missing = outcome.stdout.splitlines()
    assert Path(place).is_relative_to(vexture.site)
    homes = {home for home, _ in ast.literal_eval(missing)}
    assert homes == {"vexture.notebook", "vexture.pages", "vexture.server"}
    needed = {package for _, package in ast.literal_eval(missing)}
    assert needed <= {"anywidget", "h11", "ipywidgets", "starlette", "traitlets", "uvicorn"}


def test_modules_of_geographic_data_import_without_extras(with_geo: Installed) -> None:
    outcome = with_geo.python(IMPORTS.format(package="vexture_geo"))
    assert (outcome.returncode, outcome.stderr) == (0, "")
    place, missing = outcome.stdout.splitlines()
    assert Path(place).is_relative_to(with_geo.site)
    needed = {package for _, package in ast.literal_eval(missing)}
    assert needed <= {"anywidget", "ipywidgets", "traitlets"}


def test_it_converts_describes_and_renders(vexture: Installed, wheel: Path) -> None:
    for command in (
        ["convert", "triangle.svg"],
        ["info", "triangle.ktx2", "--json"],
        ["render", "triangle.ktx2", "-o", "triangle.png", "--size", "16", "--renderer", "cpu"],
        ["render", "triangle.svg", "-o", "exact.png", "--size", "16", "--renderer", "exact"],
    ):
        outcome = vexture.run(*command)
        assert outcome.returncode == 0, outcome.stderr
        if not wheel.stem.endswith("-none-any") and "exact" not in command:
            assert "compiling" not in outcome.stderr
        if command[0] == "info":
            assert json.loads(outcome.stdout)["name"] == "triangle"
    for name in ("triangle.png", "exact.png"):
        assert (vexture.work / name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_it_exports_a_page(vexture: Installed) -> None:
    outcome = vexture.run("export", "triangle.svg", "-o", "triangle.html")
    assert outcome.returncode == 0, outcome.stderr
    page = (vexture.work / "triangle.html").read_text(encoding="utf-8")
    assert built(VIEWER.script).decode()[:1000] in page


@pytest.mark.slow
def test_it_shows_a_drawing(with_geo: Installed) -> None:
    command = with_geo.command("view", "triangle.svg", "--no-open")
    with subprocess.Popen(
        command, cwd=with_geo.work, env=with_geo.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
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


@pytest.mark.slow
def test_it_shows_a_flood(with_geo: Installed) -> None:
    outcome = with_geo.run("flood", "--extent", "lake.geojson", "-o", "lake.html")
    assert outcome.returncode == 0, outcome.stderr
    page = (with_geo.work / "lake.html").read_text(encoding="utf-8")
    assert built(FLOOD.script, FLOOD.package).decode()[:1000] in page


def picture() -> bytes:
    """A gray disc on white with a soft edge, as PNG: squares alone need no tracing."""
    file = BytesIO()
    y, x = np.mgrid[-1:1:64j, -1:1:64j]
    image = Image.fromarray(np.uint8(np.clip(128 + 1000 * (np.hypot(x, y) - 0.7), 90, 255)))
    image.save(file, "PNG")
    return file.getvalue()


@pytest.mark.parametrize(
    ("file", "content", "command", "extra"),
    [
        ("depths.tif", b"II*\0", ["flood", "-o", "x.html", "--extent"], "gis"),
        ("wet.gpkg", b"SQLite format 3\0" + bytes(52) + b"GPKG", ["convert"], "gis"),
    ],
    ids=["depths", "areas"],
)
def test_geographic_data_that_need_an_extra_name_it_in_one_line(
    with_geo: Installed, file: str, content: bytes, command: list[str], extra: str
) -> None:
    (with_geo.work / file).write_bytes(content)
    outcome = with_geo.run(*command, file)
    assert outcome.returncode == 1
    assert len(outcome.stderr.splitlines()) == 1
    assert outcome.stderr.endswith(f"pip install 'vexture[{extra}]'\n")


@pytest.mark.parametrize(
    ("file", "content", "command", "remedy"),
    [
        ("lake.geojson", LAKE.encode(), ["convert"], "pip install 'vexture[geo]'"),
        ("wet.gpkg", b"SQLite format 3\0" + bytes(52) + b"GPKG", ["convert"], "pip install 'vexture[gis]'"),
        ("triangle.svg", DRAWING.encode(), ["view"], "'vexture[server]'"),
        ("disc.png", picture, ["convert", "--trace-images"], "'vexture[trace]'"),
    ],
    ids=["polygons", "areas", "view", "picture"],
)
def test_what_the_core_alone_lacks_is_named_in_one_line(
    vexture: Installed, file: str, content: bytes | Callable[[], bytes], command: list[str], remedy: str
) -> None:
    (vexture.work / file).write_bytes(content if isinstance(content, bytes) else content())
    outcome = vexture.run(*command, file)
    assert outcome.returncode == 1
    assert len(outcome.stderr.splitlines()) == 1
    assert outcome.stderr.endswith(f"{remedy}\n")


@pytest.mark.parametrize("name", ["map", "read_extent", "Extent", "flood_page"])
def test_a_public_name_of_geographic_data_says_what_to_install(vexture: Installed, name: str) -> None:
    outcome = vexture.python(f"import vexture\nvexture.{name}")
    assert outcome.returncode == 1
    extra = "notebook,map" if name == "map" else "geo"
    expected = f"MissingPackageError: vexture.{name} needs the package vexture-geo: pip install 'vexture[{extra}]'"
    assert outcome.stderr.splitlines()[-1].endswith(expected)


@pytest.mark.parametrize("command", ["flood", "map", "tiles"])
def test_a_command_of_geographic_data_says_what_to_install(vexture: Installed, command: str) -> None:
    outcome = vexture.run(command)
    assert outcome.returncode == 2
    assert outcome.stderr.endswith(f"adds it: pip install 'vexture[{'geo' if command == 'flood' else 'map'}]'\n")
    listed = vexture.run("--help").stdout.split("Commands:\n")[1].splitlines()
    assert command not in {line.split()[0] for line in listed}
