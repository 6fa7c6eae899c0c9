"""The rules of the house (CONTRIBUTING.md), checked on the text of the modules and on what an import brings in."""

import ast
import re
from collections import Counter
from functools import cache
from graphlib import TopologicalSorter
from itertools import combinations
from pathlib import Path

import pytest

import vexture
from vexture.base import layout
from vexture.thesis import layout as thesis_layout

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "packages" / "vexture" / "src" / "vexture"
GEO_PACKAGE = ROOT / "packages" / "vexture-geo" / "src" / "vexture_geo"
MODULES = sorted([*PACKAGE.rglob("*.py"), *GEO_PACKAGE.rglob("*.py")])
SCRIPTS = sorted(
    path for folder in ("packages/vexture-evidence", "tests", "tools") for path in (ROOT / folder).rglob("*.py")
)
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
SHADERS = sorted(PACKAGE.rglob("*.glsl"))
FOLDERS = sorted(
    {path.parent for path in MODULES} | {ROOT / "web" / name for name in ("src", "viewer", "flood", "notebook")}
)

LONGEST_MODULE = 400
LONGEST_FUNCTION = 60  # without its docstring
MOST_PARAMETERS = 8  # positional ones; what travels together is a named tuple
LONGEST_EXAMPLE = 40
DUMPING_GROUNDS = {"common", "helper", "helpers", "misc", "tools", "util", "utils"}

CORE_READING = {"base", "bezier", "drawing"}
"""What readers of drawings stand on."""

CORE: dict[str, set[str]] = {
    "base": set(),
    "bezier": {"base"},
    "drawing": {"base", "bezier"},
    "fonts": CORE_READING,
    "svg": CORE_READING | {"fonts"},
    "tracing": CORE_READING | {"svg"},
    "tree": CORE_READING,
    "renderers": {"base", "drawing"},
    "texture": CORE_READING | {"renderers", "tree"},
    "conversion": CORE_READING | {"fonts", "renderers", "svg", "texture", "tracing", "tree"},
    "thesis": CORE_READING | {"renderers", "texture", "tree"},
    "fold": {"base", "drawing", "renderers", "texture"},
    "gltf": {"base", "conversion", "drawing", "texture"},
    "server": {"base", "conversion", "drawing", "svg", "texture"},
    "pages": {"base", "conversion", "server", "texture"},
    "notebook": {"base", "conversion", "drawing", "pages", "renderers", "server", "texture", "tree"},
}
"""What each folder of vexture may import besides itself, wherever in a module; `cli` stands above all."""

GEO_READING = {"vexture_geo.base", "base", "bezier", "drawing"}

GEO: dict[str, set[str]] = {
    "base": {"base", "drawing"},
    "vector": GEO_READING,
    "depth": GEO_READING,
    "readers": GEO_READING | {"vexture_geo.depth", "vexture_geo.vector"},
    "maps": GEO_READING | {"vexture_geo.vector", "conversion", "notebook", "renderers", "texture", "tree"},
    "tiles": GEO_READING | {"vexture_geo.maps", "vexture_geo.vector", "texture", "tree"},
    "flood": GEO_READING
    | {"vexture_geo.depth", "vexture_geo.readers"}
    | {"conversion", "fold", "pages", "renderers", "server", "texture"},
}
"""The same of vexture-geo; its `cli` and `extension`, which vexture calls, stand above all."""

MAY_IMPORT = CORE | {f"vexture_geo.{part}": reached for part, reached in GEO.items()}

ABOVE_ALL = {"__init__", "__main__", "cli", "vexture_geo", "vexture_geo.cli", "vexture_geo.extension"}

GEO_TYPES = {"__init__", "notebook/show.py"}
"""Modules of vexture that name types of vexture-geo, for checkers only or by the name of a module."""

TRUTH_MODULES = (*("blend", "exact", "faces", "flatten", "gaussians", "ramps", "regions", "samples", "smooth", "view"),)
THE_TRUTH = {f"renderers/{name}.py" for name in TRUTH_MODULES}
TRUTH_MAY_IMPORT = (
    {f"base.{name}" for name in ("deadline", "errors", "kernels", "machine_code", "tolerance")}
    | {f"drawing.{name}" for name in ("affine", "blur", "drawing", "group", "paint", "picture")}
    | {module.removesuffix(".py").replace("/", ".") for module in THE_TRUTH}
)
"""The exact renderer judges the tree, so it shares nothing with it."""

LAYOUT_NUMBERS = {thesis_layout.CONTROL_MIN, thesis_layout.CONTROL_MAX, thesis_layout.LIST_LIMIT[16], layout.LATTICE}
"""Numbers of the textures' layouts that mean nothing else anywhere."""

SHADER_WORDS = re.compile(r"\b(texelFetch|gl_\w+|(uniform|varying|highp|mediump) \w+|[ib]?vec[234]\()|^#version", re.M)


def name_of(path):
    """Place of a module in vexture, or with the name of its package before it."""
    home = PACKAGE if path.is_relative_to(PACKAGE) else GEO_PACKAGE.parent
    return path.relative_to(home).as_posix()


WITH_SHADER_TEXT = {"renderers/shader.py", "thesis/shader_text.py"}
"""Modules that put programs together."""


@cache
def tree_of(path):
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def nodes_of(path):
    return [*ast.walk(tree_of(path))]


@cache
def imported(path):
    """Modules of the package that a module imports, wherever in it, as ``render.view``."""
    found = set()
    for node in nodes_of(path):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)} imports by a relative name"
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {name if exists(name) else node.module for name in names}
    return {name.removeprefix("vexture.") for name in found if name.split(".")[0] in ("vexture", "vexture_geo")}


def exists(module):
    home = GEO_PACKAGE if module.split(".")[0] == "vexture_geo" else PACKAGE
    path = home.parent / module.replace(".", "/")
    return path.is_dir() or path.with_suffix(".py").is_file()


def module_name(path):
    """Name of a module within the package: ``renderers.view``; that of a folder is the folder's."""
    return name_of(path).removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def part_of(path):
    """Folder of a module, or the module where it is in none: ``svg``, ``vexture_geo.maps``."""
    return part_of_name(module_name(path) if path.stem != "__init__" or path.parent != PACKAGE else "__init__")


def part_of_name(name):
    """Folder of a module by the module's name: ``svg`` of ``svg.read``."""
    return ".".join(name.split(".")[: 2 if name.startswith("vexture_geo") else 1])


def defined_names(path):
    """Names that a module defines at its top, and does not import."""
    for node in tree_of(path).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield node.name
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name))


def public_names(path):
    return [name for name in defined_names(path) if not name.startswith("_")]


def numbers(path):
    """All numbers that are typed in a module, with their signs."""
    found = set()
    for node in nodes_of(path):
        negative = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub)
        value = getattr(node.operand if negative else node, "value", None)
        if type(value) in (int, float):
            found.add(-value if negative else value)
    return found


def texts(path):
    """All string constants but docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    bodies = [node.body for node in nodes_of(path) if isinstance(node, documented) and ast.get_docstring(node)]
    docstrings = {id(body[0].value) for body in bodies}
    return [
        node.value
        for node in nodes_of(path)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings
    ]


def test_imports_point_one_way():
    wrong = {name_of(path): forbidden for path in MODULES if (forbidden := forbidden_imports(path))}
    assert not wrong


def forbidden_imports(path):
    """Parts that a module imports and must not."""
    part = part_of(path)
    reached = {part_of_name(name) for name in imported(path)}
    if {name_of(path), name_of(path).removesuffix(".py")} & GEO_TYPES:
        return set()
    found = set() if part in ABOVE_ALL else reached - MAY_IMPORT[part] - {part}
    if path.is_relative_to(PACKAGE):  # vexture stands without vexture-geo
        found |= {name for name in reached if name.startswith("vexture_geo")}
    if part != "thesis":  # its encoding is registered by name
        found |= reached & {"thesis"}
    return found


def test_the_library_stands_without_the_evidence():
    assert [name_of(path) for path in MODULES if "vexture_evidence" in path.read_text(encoding="utf-8")] == []


def documented_folders():
    """Folders that ARCHITECTURE.md lists, by package, in its order."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    listed = re.search(r"<!-- folders: .*?```\n(.*?)```", text, re.S)[1]
    found, package = {}, ""
    for line in listed.splitlines():
        name = line.split()[0]
        if line.startswith(" "):
            found[package].append(name.rstrip("/"))
        else:
            package = name.rstrip("/")
            found[package] = []
    return found


def test_architecture_lists_the_folders_that_there_are():
    packages = sorted(path for path in (ROOT / "packages").glob("*/src/vexture*") if path.suffix != ".egg-info")
    kept_out = {"__pycache__", "compiled"}
    there = {
        package.relative_to(ROOT).as_posix(): {path.name for path in package.iterdir() if path.is_dir()} - kept_out
        for package in packages
    }
    documented = documented_folders()
    documented["packages/vexture-evidence/src/vexture_evidence"].append("shaders")  # of two rivals
    assert {package: set(folders) for package, folders in documented.items()} == there


def test_architecture_lists_folders_in_the_order_of_their_imports():
    for package, folders in documented_folders().items():
        prefix = "vexture_geo." if package.endswith("vexture_geo") else ""
        for number, folder in enumerate(folders):
            reached = {
                name.removeprefix(prefix) for name in MAY_IMPORT.get(prefix + folder, ()) if name.startswith(prefix)
            }
            assert not reached & set(folders[number + 1 :]), folder


def full_name(name):
    return name if name.startswith("vexture_geo") else f"vexture.{name}"


def test_no_imports_run_in_a_circle():
    arrows = {module_name(path): {name for name in imported(path) if exists(full_name(name))} for path in MODULES}
    sorter = TopologicalSorter({name: reached - {name} for name, reached in arrows.items()})
    sorter.prepare()  # raises CycleError, which names the circle


def test_names_of_a_folder_do_not_differ_by_an_ending():
    for folder in FOLDERS:
        paths = [path for path in folder.iterdir() if path.suffix in (".py", ".js", ".glsl") or path.is_dir()]
        names = sorted(path.stem for path in paths if not path.stem.startswith("_"))
        stems = {name: re.sub(r"(ings?|ers?|ed|es|e|s)$", "", name) for name in names}
        assert [(a, b) for a, b in combinations(stems, 2) if stems[a] == stems[b]] == [], folder


@pytest.mark.parametrize("path", [path for path in MODULES if name_of(path) in THE_TRUTH], ids=name_of)
def test_exact_renderer_shares_nothing_with_what_it_judges(path):
    assert imported(path) <= TRUTH_MAY_IMPORT


def test_every_module_has_a_docstring_and_a_public_name():
    for path in MODULES:
        assert ast.get_docstring(tree_of(path)), path
        is_empty = all(isinstance(node, ast.Expr) for node in tree_of(path).body)
        assert is_empty or path.stem in ("__init__", "__main__") or public_names(path), path


def test_no_module_imports_a_private_name():
    for path in MODULES:
        imports = [node for node in nodes_of(path) if isinstance(node, ast.ImportFrom)]
        names = [alias.name for node in imports if (node.module or "").startswith("vexture") for alias in node.names]
        assert not [name for name in names if re.match(r"_[a-z]", name)], path


def test_no_module_is_a_dumping_ground():
    names = {part for path in MODULES for part in Path(name_of(path)).with_suffix("").parts}
    assert not names & DUMPING_GROUNDS


def test_modules_and_functions_are_of_a_readable_length():
    for path in MODULES + SCRIPTS:
        assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST_MODULE, path
        for node in nodes_of(path):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                body = node.body[1:] if ast.get_docstring(node) else node.body
                lines = node.end_lineno - body[0].lineno + 1 if body else 0
                assert lines <= LONGEST_FUNCTION, (path, node.name)


def test_functions_have_few_positional_parameters():
    for path in sorted((ROOT / "packages").rglob("*.py")):
        for node in nodes_of(path):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and not is_command(node):
                count = len(node.args.posonlyargs) + len(node.args.args)
                assert count <= MOST_PARAMETERS, (path, node.name)


def is_command(node):
    """Whether a function is a command of click, which passes each option as an argument of its own."""
    return any(ast.unparse(decorator).startswith("click.") for decorator in node.decorator_list)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_example_is_short(path):
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= LONGEST_EXAMPLE


def test_layout_numbers_are_typed_once():
    typed = {name_of(path): numbers(path) for path in MODULES}
    for number in LAYOUT_NUMBERS:
        homes = [name for name, values in typed.items() if number in values]
        assert homes in (["base/layout.py"], ["thesis/layout.py"]), number


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


def test_no_shader_text_outside_shaders():
    for path in MODULES:
        if name_of(path) not in WITH_SHADER_TEXT:
            assert not [text for text in texts(path) if SHADER_WORDS.search(text)], path


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
