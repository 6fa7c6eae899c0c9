"""Versions agree, and the workflows ask for what there is."""

import json
import re
import shutil
from pathlib import Path

import pytest
import yaml

from dist import absolute_links
from release import disagreements, notes, versions

ROOT = Path(__file__).parents[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
OWNER = "packages/vexture/pyproject.toml"
NAMING = [OWNER, "web/package.json", "web/package-lock.json", "CHANGELOG.md"]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Copy of the files that name the version, with a second distribution and a section of the changelog."""
    for name in NAMING:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    version = versions(ROOT)[OWNER]
    second = tmp_path / "packages" / "second" / "pyproject.toml"
    second.parent.mkdir()
    second.write_text(
        f'[project]\nname = "second"\nversion = "{version}"\ndependencies = ["vexture[gis]=={version}"]\n'
    )
    (tmp_path / "CHANGELOG.md").write_text(f"# Changelog\n\n## [{version}] - today\n\n- New.\n\n## [0.0.1]\n\n- Old.\n")
    return tmp_path


def test_all_places_name_the_same_version() -> None:
    assert disagreements(ROOT) == []
    assert {"packages/vexture-geo/pyproject.toml", "packages/vexture-evidence/pyproject.toml", *NAMING[:3]} <= set(
        versions(ROOT)
    )


def test_a_release_of_one_version_is_right(project: Path) -> None:
    assert len(versions(project)) == 10
    assert disagreements(project, f"v{versions(project)[OWNER]}") == []
    assert notes(project) == "- New."


@pytest.mark.parametrize("name", ["web/package.json", "web/package-lock.json", "packages/second/pyproject.toml"])
def test_a_place_that_differs_is_named(project: Path, name: str) -> None:
    version = versions(project)[OWNER]
    path = project / name
    path.write_text(
        path.read_text().replace(f'version": "{version}', 'version": "9.9.9').replace(f"=={version}", "==9.9.9")
    )
    wrong = disagreements(project)
    assert wrong
    assert all(line.startswith(name) and f"says 9.9.9; {OWNER} says" in line for line in wrong)


def test_a_tag_of_another_version_is_refused(project: Path) -> None:
    (wrong,) = disagreements(project, "v9.9.9")
    assert wrong.startswith(f"the tag is v9.9.9; {OWNER} says ")


def test_a_release_without_its_changes_is_refused(project: Path) -> None:
    (project / "CHANGELOG.md").write_text("# Changelog\n\n## [Unreleased]\n")
    (wrong,) = disagreements(project, f"v{versions(project)[OWNER]}")
    assert wrong.startswith("CHANGELOG.md has no section")


def test_links_lead_to_the_files_of_the_version() -> None:
    text = "[![logo](a.png)](b.md) [c](../c.md#d) [e](https://e.org/f) [g](#g)\n```\n[h](i)\n```\n"
    assert absolute_links(text, "web", "https://forge/us/it", "1.0") == (
        "[![logo](https://forge/us/it/raw/v1.0/web/a.png)](https://forge/us/it/blob/v1.0/web/b.md) "
        "[c](https://forge/us/it/blob/v1.0/c.md#d) [e](https://e.org/f) [g](#g)\n```\n[h](i)\n```\n"
    )


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_asks_for_targets_scripts_and_jobs_that_exist(path: Path) -> None:
    jobs = yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"]
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M))
    asked = set[str]()
    for job in jobs.values():
        needs = job.get("needs", [])
        assert {needs} <= jobs.keys() if isinstance(needs, str) else set(needs) <= jobs.keys()
        assert job["timeout-minutes"] <= 60
        for step in job["steps"]:
            command = step.get("run", "")
            asked |= set(re.findall(r"\bmake ([\w-]+)", command))
            assert all((ROOT / script).is_file() for script in re.findall(r"tools/\w+\.py", command))
            assert re.fullmatch(r"[\w-]+/[\w-]+@(v\d+|release/v\d+)", step.get("uses", "a/b@v1"))
    assert asked
    assert asked <= targets


def test_the_workflows_are_there_and_try_what_they_build() -> None:
    continuous, release, sweep = (yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"] for path in WORKFLOWS)
    assert {"run": "make test"} in continuous["test"]["steps"]
    assert {"run": "make sweep QUICK=--quick"} in sweep["sweep"]["steps"]
    oldest = re.search(r'requires-python = ">=([\d.]+)"', (ROOT / OWNER).read_text())
    assert oldest
    assert continuous["test"]["strategy"]["matrix"]["python"][0] == oldest[1]
    commands = [step["run"] for step in release["build"]["steps"] if "run" in step]
    assert any(command.startswith("python tools/release.py --tag") for command in commands)
    assert any(command.startswith("make dist-check") for command in commands)
    for name in ("pypi", "npm"):
        assert release[name]["permissions"] == {"id-token": "write"}
        assert release[name]["needs"] == "build"


def test_the_newest_python_of_the_matrix_is_the_newest_that_is_said_to_work() -> None:
    matrix = yaml.safe_load(WORKFLOWS[0].read_text(encoding="utf-8"))["jobs"]["test"]["strategy"]["matrix"]["python"]
    said = re.findall(r'"Programming Language :: Python :: (3\.\d+)"', (ROOT / OWNER).read_text())
    assert matrix == [said[0], said[-1]]


def test_the_npm_package_locks_what_it_asks_for() -> None:
    package, lock = (json.loads((ROOT / "web" / f"package{kind}.json").read_text()) for kind in ("", "-lock"))
    for kind in ("dependencies", "devDependencies", "peerDependencies"):
        assert lock["packages"][""][kind] == package[kind]
