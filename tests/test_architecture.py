"""The rules of the house (CONTRIBUTING.md), checked on the text of the modules and on what an import brings in."""

import ast
import json
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from vexture.encoding import layout

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "vexture"
MODULES = sorted(PACKAGE.rglob("*.py"))
SCRIPTS = sorted(path for folder in ("benchmarks", "tests", "tools") for path in (ROOT / folder).rglob("*.py"))
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
SHADERS = sorted((PACKAGE / "glsl").glob("*.glsl"))

LONGEST_MODULE = 400
LONGEST_FUNCTION = 60  # without its docstring
LONGEST_EXAMPLE = 40
DUMPING_GROUNDS = {"common", "helper", "helpers", "misc", "tools", "util", "utils"}

BASE = {"errors", "kernels", "machine_code", "tolerance"}
METHODS = BASE | {"bezier", "drawing", "encoding", "pictures", "pipeline", "quadtree", "render", "shaders", "shading"}
METHODS |= {"sources"}
MAY_IMPORT = {
    "errors": set(),
    "kernels": {"machine_code"},
    "machine_code": set(),
    "tolerance": set(),
    "shading": set(),
    "bezier": {"kernels", "tolerance"},
    "drawing": BASE | {"bezier"},
    "sources": BASE | {"bezier", "drawing"},
    "quadtree": BASE | {"bezier", "drawing"},
    "encoding": BASE | {"bezier", "drawing", "quadtree"},
    "shaders": {"encoding", "errors", "shading"},
    "render": BASE | {"drawing", "encoding", "shaders", "shading"},
    "folding": BASE | {"drawing", "encoding", "render"},
    "evaluation": METHODS,
    "figures": METHODS | {"evaluation"},
}
"""What each part may import besides itself; the parts that are not named here stand above all of these."""

FOR_CONVENIENCE = {"encoding/texture.py": {"figures"}, "encoding/packed_texture.py": {"figures"}}
"""`texture.plot()` is where people look for a picture; it imports the figures when it is called, and only there."""

COMMANDS = ("cli", "cli_flood", "cli_fold", "cli_live", "cli_report", "cli_view")

THE_TRUTH = {"render/exact.py", "render/chords.py", "render/view.py"}
TRUTH_MAY_IMPORT = BASE | {"drawing", "render.chords", "render.view"}
"""The exact renderer judges the tree, so it shares nothing with it."""

LAYOUT_NUMBERS = {layout.CONTROL_MIN, layout.CONTROL_MAX, layout.LIST_LIMIT[16], 65535}
"""Numbers of the texture layout that mean nothing else anywhere."""

WITH_SHADER_TEXT = {"shaders", "evaluation"}
"""Parts that put programs together: the one that everybody draws with, and those that are measured beside it."""

SHADER_WORDS = re.compile(r"\b(texelFetch|gl_\w+|(uniform|varying|highp|mediump) \w+|[ib]?vec[234]\()|^#version", re.M)
HEAVY = {
    "PIL",
    "cssselect2",
    "fontTools",
    "llvmlite",
    "lxml",
    "moderngl",
    "numba",
    "pathops",
    "png",
    "scipy",
    "tinycss2",
} | {
    "contourpy",
    "matplotlib",
    "netCDF4",
    "pandas",
    "pyogrio",
    "pyproj",
    "rasterio",
    "resvg",
    "shapely",
    "skia",
    "sse_starlette",
    "starlette",
    "uvicorn",
    "vtracer",
    "watchfiles",
    "xarray",
    "xugrid",
}


def name_of(path):
    return path.relative_to(PACKAGE).as_posix()


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
    if part in MAY_IMPORT:
        reached = {name.split(".")[0] for name in imported(path)}
        assert reached <= MAY_IMPORT[part] | {part} | FOR_CONVENIENCE.get(name_of(path), set())
    elif part not in COMMANDS:
        assert not imported(path) & {*COMMANDS, "messages"}


@pytest.mark.parametrize("path", sorted(FOR_CONVENIENCE))
def test_what_is_imported_for_convenience_is_imported_by_plot_alone(path):
    def asks(node):
        return isinstance(node, ast.ImportFrom) and {*node.module.split(".")} & FOR_CONVENIENCE[path] != set()

    tree = tree_of(PACKAGE / path)
    plots = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name == "plot"]
    assert len(plots) == 1
    assert sum(map(asks, ast.walk(plots[0]))) == sum(map(asks, ast.walk(tree))) == 1


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
    assert homes in ([], ["encoding/layout.py"], ["quadtree/tree.py"])  # the tree states what range its curves keep to


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


@pytest.mark.parametrize("path", [path for path in MODULES if part_of(path) not in WITH_SHADER_TEXT], ids=name_of)
def test_no_shader_text_outside_glsl(path):
    assert not [text for text in texts(path) if SHADER_WORDS.search(text)]


def test_shader_names_are_each_defined_in_one_file():
    definition = re.compile(r"^(?:struct|[a-z]\w*) (\w+)(?:\([^;]*\))? {$", re.M | re.I)
    defined = Counter(name for path in SHADERS for name in set(definition.findall(path.read_text(encoding="utf-8"))))
    assert [name for name, count in defined.items() if count > 1] == []


@pytest.mark.parametrize("first", ["vexture.convert", "vexture.render", "import vexture.render.view"])
def test_function_render_is_not_hidden_by_the_package_of_its_name(first):
    code = f"import vexture\n{first}\nimport vexture.render.view\nassert not hasattr(vexture.render, '__path__')"
    assert subprocess.run([sys.executable, "-c", code], stderr=subprocess.DEVNULL, check=False).returncode == 0


@pytest.mark.parametrize("statement", ["import vexture", "import vexture.cli", "vexture --help"])
def test_start_brings_in_nothing_heavy(statement):
    run = "import contextlib, vexture.cli\nwith contextlib.suppress(SystemExit): vexture.cli.main(['--help'])"
    code = f"{run if statement == 'vexture --help' else statement}\nimport json, sys\nprint(json.dumps([*sys.modules]))"
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = json.loads(outcome.stdout.splitlines()[-1])
    assert "vexture" in modules
    assert {module.split(".")[0] for module in modules} & HEAVY == set()


def test_architecture_names_every_module_and_no_other():
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([\w/]+\.(?:py|glsl))` \|", text, re.M)
    modules = {name_of(path) for path in MODULES if path.name != "__init__.py"} | {"__init__.py"}
    assert sorted(rows) == sorted(modules | {f"glsl/{path.name}" for path in SHADERS})
