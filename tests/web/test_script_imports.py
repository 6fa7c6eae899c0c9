"""The modules of web/ import one way, by a table, and in no circle."""

import re
from graphlib import TopologicalSorter
from pathlib import Path

ROOT = Path(__file__).parents[2]

SCRIPTS_MAY_IMPORT = {
    "src": {"generated"},
    "src/convert": {"generated", "src"},
    "src/globe": {"src", "src/tiles"},
    "src/gltf": {"generated", "src"},
    "src/maplibre": {"src", "src/tiles"},
    "src/react": {"src", "src/text"},
    "src/text": {"generated", "src", "src/convert", "src/typeset"},
    "src/thesis": {"generated", "src"},
    "src/tiles": {"generated", "src"},
    "src/typeset": {"generated", "src", "src/convert"},
    "src/vite": {"src", "src/convert"},
    "src/water": {"generated", "src"},
    "src/webgpu": {"generated", "src", "src/text"},
    "viewer": {"generated", "src", "src/thesis"},
    "flood": {"src", "src/water", "viewer"},
    "notebook": {"src", "viewer"},
}
"""What the modules of each folder of web/ may import besides those of their own."""

IMPORTED_SCRIPT = re.compile(
    r"(?:^|\n)(?:import|export)\b[^;'\"]*?from\s+'(\.{1,2}/[^']+)'|(?:^|\n)import\s+'(\.{1,2}/[^']+)'"
    r"|\bimport\('(\.{1,2}/[^']+)'\)"
)
COMMENT_OF_SCRIPT = re.compile(r"/\*.*?\*/|(?<!:)//[^\n]*", re.S)


def scripts_imported():
    """Modules of web/ that each imports, when it is loaded or later, without types in comments."""
    web = ROOT / "web"
    arrows = {}
    for path in sorted(
        path for folder in ("src", "viewer", "flood", "notebook") for path in (web / folder).rglob("*.js")
    ):
        text = COMMENT_OF_SCRIPT.sub("", path.read_text(encoding="utf-8"))
        reached = ("".join(found) for found in IMPORTED_SCRIPT.findall(text))
        arrows[path.relative_to(web).as_posix()] = {
            (path.parent / name).resolve().relative_to(web).as_posix() for name in reached
        }
    return arrows


def folder_of_script(name):
    parts = name.split("/")
    return "/".join(parts[:2]) if parts[0] == "src" and len(parts) > 2 else parts[0]


def test_scripts_import_one_way_and_in_no_circle():
    arrows = scripts_imported()
    assert len(arrows["viewer/main.js"]) > 3  # imports are found
    for name, reached in arrows.items():
        folder = folder_of_script(name)
        beyond = {folder_of_script(one) for one in reached} - {folder}
        assert beyond <= SCRIPTS_MAY_IMPORT[folder], name
    TopologicalSorter(arrows).prepare()  # raises CycleError, which names the circle
