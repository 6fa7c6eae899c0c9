"""Check that a release is of one version: `release.py` compares all places that name it.

`release.py --tag v0.2.0` compares the tag too, and wants the version in CHANGELOG.md; `release.py --notes` prints what
stands there. It needs nothing but Python.
"""

import argparse
import json
import re
import tomllib
from itertools import chain
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
PROJECT: Final = "pyproject.toml"
OWNER: Final = f"packages/vexture/{PROJECT}"
"""Where the version is said; other places say it again."""


def versions(root: Path) -> dict[str, str]:
    """Versions by the places that name them, the owner first."""
    found = {}
    for path in (root / OWNER, *sorted({*root.glob(f"packages/*/{PROJECT}")} - {root / OWNER})):
        project = tomllib.loads(path.read_text(encoding="utf-8"))["project"]
        place = path.relative_to(root).as_posix()
        found[place] = project["version"]
        extras = project.get("optional-dependencies", {})
        for requirement in chain(project["dependencies"], *extras.values()):
            if pinned := re.fullmatch(r"vexture[\w-]*(?:\[.*\])? *== *(\S+)", requirement):
                found[f"{place}: {requirement}"] = pinned[1]
    found["web/package.json"] = json.loads((root / "web" / "package.json").read_text(encoding="utf-8"))["version"]
    locked = json.loads((root / "web" / "package-lock.json").read_text(encoding="utf-8"))
    found["web/package-lock.json"] = locked["version"]
    found['web/package-lock.json: packages[""]'] = locked["packages"][""]["version"]
    return found


def disagreements(root: Path, tag: str | None = None) -> list[str]:
    """Lines that say what must be mended before a release; none if all is well."""
    found = versions(root)
    version = found[OWNER]
    wrong = [f"{place} says {other}; {OWNER} says {version}" for place, other in found.items() if other != version]
    if tag is not None:
        if tag != f"v{version}":
            wrong.append(f"the tag is {tag}; {OWNER} says {version}, whose tag is v{version}")
        if notes(root) is None:
            wrong.append(f"CHANGELOG.md has no section ## [{version}]")
    return wrong


def notes(root: Path) -> str | None:
    """Entry of CHANGELOG.md about the version, if there is one."""
    version = re.escape(versions(root)[OWNER])
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    section = re.search(rf"^## \[{version}\].*?\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    return None if section is None else section[1].strip()


def main() -> None:
    """Print what is wrong, or the notes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tag", help="tag of the release")
    parser.add_argument("--notes", action="store_true", help="print the version's section of CHANGELOG.md")
    arguments = parser.parse_args()
    if wrong := disagreements(ROOT, arguments.tag):
        raise SystemExit("\n".join(wrong))
    print(notes(ROOT) or "" if arguments.notes else f"all say {versions(ROOT)[OWNER]}")


if __name__ == "__main__":
    main()
