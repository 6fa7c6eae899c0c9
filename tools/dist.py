"""Build a release: `dist.py --output dist packages/vexture web` writes wheels, sdists and npm tarball of these folders.

A folder with a pyproject.toml becomes a wheel and an sdist, one with a package.json a tarball. Where kernels were
compiled (`compile_kernels.py`), a second wheel holds them, for this platform. All are built in a copy of what belongs
to them, so that nothing stale gets in, and from the same files come the same bytes: times are SOURCE_DATE_EPOCH, else
that of the last commit. Built pages must be there (`make viewer`), and node_modules of web/.

With `--repository URL`, which a registry's page needs, the artefacts name it, and relative links of their README lead
to the version's files there.
"""

import argparse
import gzip
import io
import json
import os
import posixpath
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[1]
LINK: Final = re.compile(r"(?<=\]\()(?!\w+:|#)[^)\s]+")
PICTURES: Final = (".gif", ".jpg", ".png", ".svg", ".webp")
FENCED: Final = re.compile(r"^(```.*?^```)$", re.M | re.S)
COMPILED: Final = "src/vexture/compiled"
"""Where `compile_kernels.py` leaves the machine code of kernels, which only the wheel of this platform holds."""

STALE: Final = shutil.ignore_patterns(".*", "__pycache__", "*.egg-info", "build", "compiled", "dist", "node_modules")
EARLIEST: Final = 315532800
"""Seconds from 1970 to 1980, where the times of zip files begin."""


def build(folder: Path, output: Path, repository: str | None = None) -> list[Path]:
    """Write the artefacts of a project folder to `output`; return them."""
    output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        copy, made = Path(scratch) / "copy", Path(scratch) / "made"
        copy.mkdir()
        made.mkdir()
        kind = _build_wheel if (folder / "pyproject.toml").is_file() else _build_tarball
        kind(folder, copy, made, repository)
        return [Path(shutil.copy(path, output)) for path in sorted(made.iterdir())]


def epoch() -> int:
    """Return the time that all files of a release bear, in seconds since 1970."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given is None:
        command = ["git", "log", "-1", "--format=%ct"]
        given = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    return max(int(given.strip() or EARLIEST), EARLIEST)


def absolute_links(text: str, home: str, repository: str, version: str) -> str:
    """Markdown whose relative links lead to a repository's files of a version; blocks of code stay as they are.

    Parameters
    ----------
    text : str
    home : str
        Folder of the text, from the root of the repository.
    repository : str
        Its address.
    version : str

    Examples
    --------
    >>> absolute_links("[how](FORMAT.md#b) ![](docs/a.png) [top](#top)", ".", "https://forge/us/it", "1.0")
    '[how](https://forge/us/it/blob/v1.0/FORMAT.md#b) ![](https://forge/us/it/raw/v1.0/docs/a.png) [top](#top)'
    """

    def absolute(match: re.Match[str]) -> str:
        path = posixpath.normpath(posixpath.join(home, match[0]))
        kind = "raw" if path.endswith(PICTURES) else "blob"
        return f"{repository}/{kind}/v{version}/{path}"

    parts = FENCED.split(text)
    return "".join(part if part.startswith("```") else LINK.sub(absolute, part) for part in parts)


def _build_wheel(folder: Path, copy: Path, output: Path, repository: str | None) -> None:
    """Build sdist and wheel, the wheel from the sdist."""
    project = tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))
    _copy(folder, copy, ["pyproject.toml", *project["tool"]["setuptools"]["packages"]["find"]["where"]])
    _complete(folder, copy, project["project"]["version"], repository)
    if repository:
        with (copy / "pyproject.toml").open("a", encoding="utf-8") as file:
            file.write(f"\n[project.urls]\n{_toml_urls(repository)}")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(output), str(copy)]
    _run(command, copy, SOURCE_DATE_EPOCH=str(epoch()))
    if (folder / COMPILED).is_dir():
        from compile_kernels import tag

        shutil.copytree(folder / COMPILED, copy / COMPILED)
        _set_modes(copy)
        command = [*command[:3], "--no-isolation", "--wheel", f"-C--build-option=--plat-name={tag()}"]
        _run([*command, "--outdir", str(output), str(copy)], copy, SOURCE_DATE_EPOCH=str(epoch()))
    for sdist in output.glob("*.tar.gz"):
        _settle(sdist)


def _toml_urls(repository: str) -> str:
    pages = {
        "Homepage": repository,
        "Documentation": f"{repository}/tree/HEAD/docs",
        "Changelog": f"{repository}/blob/HEAD/CHANGELOG.md",
        "Issues": f"{repository}/issues",
    }
    return "".join(f'{name} = "{address}"\n' for name, address in pages.items())


def _build_tarball(folder: Path, copy: Path, output: Path, repository: str | None) -> None:
    """Pack what package.json names, with its types built first."""
    package: dict[str, Any] = json.loads((folder / "package.json").read_text(encoding="utf-8"))
    _run(["npm", "run", "--silent", "prepack"], folder)
    _copy(folder, copy, [name for name in package["files"] if not name.startswith("!")])  # npm leaves these out
    _complete(folder, copy, package["version"], repository)
    if repository:
        home = folder.relative_to(ROOT).as_posix()
        package["repository"] = {"type": "git", "url": f"git+{repository}.git", "directory": home}
    (copy / "package.json").write_text(json.dumps(package, indent=2) + "\n", encoding="utf-8")
    _run(["npm", "pack", "--silent", "--ignore-scripts", "--pack-destination", str(output)], copy)


def _copy(folder: Path, copy: Path, names: list[str]) -> None:
    """Copy files and folders, but what is left of other builds."""
    for name in names:
        source, target = folder / name, copy / name
        if source.is_dir():
            shutil.copytree(source, target, ignore=STALE, dirs_exist_ok=True)
        else:
            shutil.copy(source, target)


def _complete(folder: Path, copy: Path, version: str, repository: str | None) -> None:
    """Add README and licence, which a folder without one has from the root; give all files the same modes."""
    licence = folder / "LICENSE"
    shutil.copy(licence if licence.is_file() else ROOT / "LICENSE", copy / "LICENSE")
    text = (folder / "README.md").read_text(encoding="utf-8")
    if repository:
        text = absolute_links(text, folder.relative_to(ROOT).as_posix(), repository.rstrip("/"), version)
    (copy / "README.md").write_text(text, encoding="utf-8")
    _set_modes(copy)


def _set_modes(folder: Path) -> None:
    """Give all in a folder the same modes, whatever those of the checkout are."""
    for path in folder.rglob("*"):
        path.chmod(0o755 if path.is_dir() else 0o644)


def _settle(sdist: Path) -> None:
    """Write a .tar.gz anew, without what differs from one build to the next."""
    packed = io.BytesIO()
    with tarfile.open(sdist) as old, tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as new:
        for member in sorted(old.getmembers(), key=lambda member: member.name):
            content = old.extractfile(member)
            member.mtime, member.uid, member.gid, member.uname, member.gname = epoch(), 0, 0, "", ""
            member.pax_headers = {}
            new.addfile(member, content)
    sdist.write_bytes(gzip.compress(packed.getvalue(), mtime=epoch()))


def _run(command: list[str], folder: Path, **environment: str) -> None:
    """Run a program that says nothing unless it fails."""
    everything = {**os.environ, **environment}
    outcome = subprocess.run(
        command, cwd=folder, env=everything, umask=0o022, capture_output=True, text=True, check=False
    )
    if outcome.returncode:
        raise SystemExit(f"{' '.join(command)} failed:\n{outcome.stdout}{outcome.stderr}")


def main() -> None:
    """Build what the arguments name, and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "folders", nargs="+", type=Path, metavar="FOLDER", help="project folder, such as packages/vexture or web"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="DIR", help="folder for the artefacts")
    parser.add_argument("--repository", metavar="URL", help="where the sources are, for links and metadata")
    arguments = parser.parse_args()
    for folder in arguments.folders:
        for path in build(folder.resolve(), arguments.output, arguments.repository or None):
            print(f"{path}: {path.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
