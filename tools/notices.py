"""Write the licences of what is bundled into the built pages beside them: LICENSES.txt.

`notices.py FOLDER...` takes them from web/node_modules: of the packages that the pages hold, and of those that these
need.
"""

import json
import sys
from pathlib import Path
from typing import Final

WEB: Final = Path(__file__).resolve().parents[1] / "web"
OF_PAGES: Final = ("fast-png", "three")
"""Packages that modules of the pages import; those of `vexture/convert` are in no page."""

HEADING: Final = "The pages of vexture hold code of these packages, each under its own licence.\n"


def bundled_packages() -> list[str]:
    """Names of the packages that the pages hold."""
    locked = json.loads((WEB / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    found, waiting = set[str](), [*OF_PAGES]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += locked[f"node_modules/{name}"].get("dependencies", ())
    return sorted(found)


def notices() -> str:
    """Their licences, one after another."""
    parts = [HEADING]
    for name in bundled_packages():
        folder = WEB / "node_modules" / name
        version = json.loads((folder / "package.json").read_text(encoding="utf-8"))["version"]
        (licence,) = folder.glob("LICENSE*")
        parts.append(f"{name} {version}\n\n{licence.read_text(encoding='utf-8').strip()}\n")
    return f"\n{'-' * 80}\n\n".join(parts)


if __name__ == "__main__":
    for folder in sys.argv[1:]:
        (Path(folder) / "LICENSES.txt").write_text(notices(), encoding="utf-8")
