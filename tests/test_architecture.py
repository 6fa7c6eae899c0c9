"""The rules of the house (CONTRIBUTING.md), checked on the text of the modules and on what an import brings in."""

import ast
import json
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from graphlib import TopologicalSorter
from itertools import combinations
from pathlib import Path

import pytest

import vexture
from vexture import layout
from vexture.cli.main import COMMANDS, SUMMARIES, main
from vexture.thesis import layout as thesis_layout

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "vexture"
MODULES = sorted(PACKAGE.rglob("*.py"))
SCRIPTS = sorted(path for folder in ("evidence", "tests", "tools") for path in (ROOT / folder).rglob("*.py"))
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
SHADERS = sorted(PACKAGE.rglob("*.glsl"))
FOLDERS = sorted(
    {path.parent for path in MODULES} | {ROOT / "web" / name for name in ("src", "viewer", "flood", "notebook")}
)

LONGEST_MODULE = 400
LONGEST_FUNCTION = 60  # without its docstring
LONGEST_EXAMPLE = 40
DUMPING_GROUNDS = {"common", "helper", "helpers", "misc", "tools", "util", "utils"}

BASE = {"deadline", "errors", "kernels", "machine_code", "tolerance"}
SOURCES = BASE | {"bezier", "content", "contours", "drawing", "group", "notes", "paint", "unit_square"}
MAY_IMPORT: dict[str, set[str]] = {
    "deadline": {"errors"},
    "errors": set(),
    "kernels": {"deadline", "machine_code"},
    "machine_code": set(),
    "layout": set(),
    "tolerance": set(),
    "content": {"errors"},
    "workers": {"errors"},
    "apart": {"deadline", "errors"},
    "notes": {"errors"},
    "group": {"errors"},
    "paint": {"errors"},
    "bezier": {"kernels", "tolerance"},
    "unit_square": {"bezier", "errors", "tolerance"},
    "contours": {"bezier", "errors"},
    "drawing": BASE | {"bezier", "contours", "group", "notes", "paint", "unit_square"},
    "fonts": {"bezier", "content", "deadline", "drawing", "errors", "group", "notes", "paint"},
    "svg": SOURCES | {"fonts"},
    "geo": SOURCES | {"workers"},
    "tracing": SOURCES | {"svg"},
    "reading": SOURCES | {"fonts", "geo", "parameters", "svg", "tracing", "workers"},
    "tree": BASE | {"bezier", "contours", "drawing", "group", "layout", "notes", "paint", "unit_square"},
    "wgsl": {"errors"},
    "renderers": BASE | {"drawing", "group", "layout", "paint", "wgsl"},
    "encodings": {"drawing", "errors", "renderers"},
    "texture": BASE | {"bezier", "drawing", "encodings", "group", "layout", "paint", "renderers", "svg", "tree"},
    "parameters": {"content", "deadline", "drawing", "errors"},
    "sprites": SOURCES | {"reading", "svg"},
    "pipeline": BASE | {"drawing", "encodings", "notes", "parameters", "reading", "sprites", "texture", "tree"},
    "glyph_atlas": {"deadline", "drawing", "errors", "fonts", "notes", "paint", "pipeline", "texture"},
    "close_up": {"drawing", "paint", "renderers", "tolerance"},
    "images": BASE | {"close_up", "drawing", "encodings", "group", "paint", "pipeline", "renderers"},
    "thesis": BASE | {"bezier", "drawing", "encodings", "group", "layout", "paint", "renderers", "texture", "tree"},
    "fold": BASE | {"drawing", "layout", "notes", "renderers", "texture"},
    "gltf": BASE | {"content", "drawing", "layout", "parameters", "pipeline", "svg", "texture"},
    "cartography": SOURCES | {"geo", "layout", "pipeline", "reading", "svg"},
    "flood": BASE | {"content", "drawing", "geo", "notes", "paint", "renderers", "workers"},
    "tiles": SOURCES | {"cartography", "geo", "layout", "texture", "tree", "workers"},
    "live": SOURCES
    | {"apart", "encodings", "flood", "fold", "geo", "layout", "parameters", "pipeline", "reading"}
    | {"svg", "texture", "tree", "workers"},
    "notebook": SOURCES | {"cartography", "geo", "live", "pipeline", "reading", "renderers", "svg", "texture", "tree"},
}
"""What each part may import besides itself, wherever in a module; `cli` and the public face stand above all."""

ABOVE_ALL = {"__init__", "__main__", "cli"}

TRUTH_MODULES = ("blend", "exact", "faces", "flatten", "ramps", "regions", "slabs", "varying", "view")
THE_TRUTH = {f"renderers/{name}.py" for name in TRUTH_MODULES}
TRUTH_MAY_IMPORT = (
    BASE | {"drawing", "group", "paint"} | {module.removesuffix(".py").replace("/", ".") for module in THE_TRUTH}
)
"""The exact renderer judges the tree, so it shares nothing with it."""

LAYOUT_NUMBERS = {thesis_layout.CONTROL_MIN, thesis_layout.CONTROL_MAX, thesis_layout.LIST_LIMIT[16], layout.LATTICE}
"""Numbers of the textures' layouts that mean nothing else anywhere."""

SHADER_WORDS = re.compile(r"\b(texelFetch|gl_\w+|(uniform|varying|highp|mediump) \w+|[ib]?vec[234]\()|^#version", re.M)
HEAVY = {
    "PIL",
    "anywidget",
    "bidi",
    "cmap",
    "coloraide",
    "cssselect2",
    "fontTools",
    "ipywidgets",
    "llvmlite",
    "lxml",
    "moderngl",
    "numba",
    "pathops",
    "png",
    "scipy",
    "tinycss2",
} | {
    "av",
    "contourpy",
    "duckdb",
    "matplotlib",
    "netCDF4",
    "pandas",
    "playwright",
    "pyarrow",
    "pyogrio",
    "pyproj",
    "rasterio",
    "resvg",
    "shapely",
    "skia",
    "starlette",
    "uharfbuzz",
    "uvicorn",
    "vtracer",
    "watchfiles",
    "xarray",
}


def name_of(path):
    return path.relative_to(PACKAGE).as_posix()


WITH_SHADER_TEXT = {"renderers/shader.py", "thesis/shader.py"} | {
    name_of(path) for path in (PACKAGE / "wgsl").glob("*.py")
}
"""Modules that put programs together, and those that know both languages."""


@cache
def tree_of(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def imported(path):
    """Modules of the package that a module imports, wherever in it, as ``render.view``."""
    found = set()
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)} imports by a relative name"
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {name if exists(name) else node.module for name in names}
    return {name.removeprefix("vexture.") for name in found if name.split(".")[0] == "vexture"}


def exists(module):
    path = PACKAGE.parent / module.replace(".", "/")
    return path.is_dir() or path.with_suffix(".py").is_file()


def module_name(path):
    """Name of a module within the package: ``renderers.view``; that of a folder is the folder's."""
    return name_of(path).removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def part_of(path):
    return name_of(path).removesuffix(".py").split("/")[0]


def public_names(path):
    for node in tree_of(path).body:
        if isinstance(node, ast.Assign) and [ast.unparse(target) for target in node.targets] == ["__all__"]:
            return ast.literal_eval(node.value)
    return None


def numbers(path):
    """All numbers that are typed in a module, with their signs."""
    found = set()
    for node in ast.walk(tree_of(path)):
        negative = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub)
        value = getattr(node.operand if negative else node, "value", None)
        if type(value) in (int, float):
            found.add(-value if negative else value)
    return found


def texts(path):
    """All string constants but docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    bodies = [node.body for node in ast.walk(tree_of(path)) if isinstance(node, documented) and ast.get_docstring(node)]
    docstrings = {id(body[0].value) for body in bodies}
    return [
        node.value
        for node in ast.walk(tree_of(path))
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings
    ]


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_point_one_way(path):
    part = part_of(path)
    reached = {name.split(".")[0] for name in imported(path)}
    if part not in ABOVE_ALL:
        assert reached <= MAY_IMPORT[part] | {part}
    assert "thesis" not in reached or part == "thesis", "the thesis's encoding is registered by name"
    assert "vexture_evidence" not in path.read_text(encoding="utf-8"), "evidence stands on the library"


def test_no_imports_run_in_a_circle():
    arrows = {module_name(path): {name for name in imported(path) if exists(f"vexture.{name}")} for path in MODULES}
    sorter = TopologicalSorter({name: reached - {name} for name, reached in arrows.items()})
    sorter.prepare()  # raises CycleError, which names the circle


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_names_of_a_folder_do_not_differ_by_an_ending(folder):
    names = sorted(path.stem for path in folder.iterdir() if path.suffix in (".py", ".js", ".glsl") or path.is_dir())
    stems = {name: re.sub(r"(ings?|ers?|ed|es|e|s)$", "", name) for name in names if not name.startswith("_")}
    twins = [(a, b) for a, b in combinations(stems, 2) if stems[a] == stems[b]]
    assert not twins


@pytest.mark.parametrize("path", [path for path in MODULES if name_of(path) in THE_TRUTH], ids=name_of)
def test_exact_renderer_shares_nothing_with_what_it_judges(path):
    assert imported(path) <= TRUTH_MAY_IMPORT


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_module_says_what_it_is_and_what_it_offers(path):
    assert ast.get_docstring(tree_of(path))
    without_names = all(isinstance(node, ast.Expr) for node in tree_of(path).body)
    if not without_names and path.stem != "__main__":
        names = public_names(path)
        assert names is not None, "no literal __all__"
        assert len(names) == len(set(names))


def test_no_module_is_a_dumping_ground():
    names = {part for path in MODULES for part in path.relative_to(PACKAGE).with_suffix("").parts}
    assert not names & DUMPING_GROUNDS


@pytest.mark.parametrize("path", MODULES + SCRIPTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_module_and_its_functions_are_of_a_readable_length(path):
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= LONGEST_MODULE
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body[1:] if ast.get_docstring(node) else node.body
            lines = node.end_lineno - body[0].lineno + 1 if body else 0
            assert lines <= LONGEST_FUNCTION, node.name


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_example_is_short(path):
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= LONGEST_EXAMPLE


@pytest.mark.parametrize("number", sorted(LAYOUT_NUMBERS))
def test_layout_number_is_typed_once(number):
    homes = [name_of(path) for path in MODULES if number in numbers(path)]
    assert homes in (["layout.py"], ["thesis/layout.py"])


@pytest.mark.parametrize("path", SHADERS, ids=lambda path: path.name)
def test_shader_file_lists_its_exports_and_leaves_the_rest_to_shaders_py(path):
    text = path.read_text(encoding="utf-8")
    head = text.partition("\n\n")[0]
    header = [line for line in text.splitlines()[:20] if line.startswith("//")]
    assert any(line.startswith("// Exports:") for line in header), head
    assert not re.search(r"#version|void main\b", text)
    assert not {float(number) for number in re.findall(r"(?<![\w.])-?\d+\.?\d*", text)} & LAYOUT_NUMBERS
    exports = re.search(r"^// Exports: (.*?)\.$", text, re.M)
    for name in exports.group(1).split(", "):
        assert re.search(rf"\b(struct {name} {{|\w+ {name}\()", text), f"{name} is not in the file"


@pytest.mark.parametrize("path", [path for path in MODULES if name_of(path) not in WITH_SHADER_TEXT], ids=name_of)
def test_no_shader_text_outside_glsl(path):
    assert not [text for text in texts(path) if SHADER_WORDS.search(text)]


@pytest.mark.parametrize("folder", sorted({path.parent for path in SHADERS}), ids=name_of)
def test_shader_names_are_each_defined_in_one_file(folder):
    definition = re.compile(r"^(?:struct|[a-z]\w*) (\w+)(?:\([^;]*\))? {$", re.M | re.I)
    defined = Counter(
        name for path in folder.glob("*.glsl") for name in set(definition.findall(path.read_text("utf-8")))
    )
    assert [name for name, count in defined.items() if count > 1] == []


def test_no_function_hides_a_package_of_its_name():
    packages = {path.name for path in PACKAGE.iterdir() if path.is_dir()} | {path.stem for path in PACKAGE.glob("*.py")}
    assert packages & set(vexture.__all__) == set()


OF_SERVERS = {"asyncio", "multiprocessing", "ssl"}
"""Modules of the standard library that take as long to import as all else of the command line."""

HELP = """
import contextlib, vexture.cli.main
for words in [[], *([name] for name in vexture.cli.main.COMMANDS)]:
    with contextlib.suppress(SystemExit):
        vexture.cli.main.main([*words, '--help'])
"""


@pytest.mark.parametrize(
    "statement", ["import vexture", "import vexture.cli.main", HELP], ids=["package", "cli", "help"]
)
def test_start_brings_in_nothing_heavy(statement):
    code = f"{statement}\nimport json, sys\nprint(json.dumps([*sys.modules]))"
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = json.loads(outcome.stdout.splitlines()[-1])
    assert "vexture" in modules
    assert {module.split(".")[0] for module in modules} & (HEAVY | OF_SERVERS) == set()


LIST = """
import contextlib, vexture.cli.main
with contextlib.suppress(SystemExit):
    vexture.cli.main.main(["--help"])
"""

OF_LIST = {"vexture", "vexture.errors"} | {f"vexture.cli{name}" for name in ("", ".interrupt", ".main", ".messages")}
"""What the list of the commands takes, beside click and what adds commands: it is asked for most often."""


def test_the_list_of_the_commands_brings_in_none_of_them():
    code = f"{LIST}\nimport json, sys\nprint(json.dumps([*sys.modules]))"
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = json.loads(outcome.stdout.splitlines()[-1])
    assert {module for module in modules if module.split(".")[0] == "vexture"} == OF_LIST


def test_the_list_of_the_commands_is_what_they_say_themselves():
    commands = {name: main.get_command(None, name) for name in COMMANDS}
    assert {name: command.get_short_help_str(1000) for name, command in commands.items()} == SUMMARIES
