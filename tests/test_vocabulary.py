"""The rules for names and first lines that a machine can check (CONTRIBUTING.md); those of prose are for readers."""

import ast
import re
from collections import defaultdict
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "packages").rglob("src/**/*.py"))

QUESTIONS = {"how", "what", "when", "where", "which", "who", "whose", "why"}
VAGUE = QUESTIONS | {
    *("again", "asked", "begun", "given", "gone", "held", "here", "kept", "made", "meant", "of", "own", "put", "said"),
    *("say", "seen", "shown", "so", "such", "taken", "tell", "theirs", "there", "told", "wanted"),
}
COPIES = {"reversed", "sorted"}
"""Participles for a copy of the first argument with that done to it, as in Python."""

ADJECTIVES = {"closed", "speed"}

OF_SHADER = {"averaged", "blended", "counted", "ended", "greyed", "held", "numbered", "settled", "unpacked"}
"""Functions of the mirror, which have the names of the shader's functions."""

FUNCTIONS = OF_SHADER | {
    *("_embedded", "_named", "_unchecked", "coloured", "inherited", "named", "of", "said", "unchecked", "unresolved"),
    *("_asked", "told"),
}
"""Names that stay: constructors (`of`), and methods of several classes that are to be renamed together."""

PARAMETERS = {"how", "kept", "own", "wanted", "what", "where"}
"""Parameters that stay: those of the shader's functions, and two public ones."""

MODULES = {"embedded", "published", "unsupported"}
CLASSES = set[str]()


def is_vague(name):
    """Whether a name is a bare participle, or a word that only a conversation explains."""
    word = name.strip("_")
    if word in VAGUE:
        return True
    is_participle = re.fullmatch(r"[a-z]{3,}ed", word) is not None and not word.endswith(("eed", "need"))
    return is_participle and word not in COPIES | ADJECTIVES


@cache
def nodes_of(path):
    return [*ast.walk(ast.parse(path.read_text(encoding="utf-8")))]


def nodes(path, *kinds):
    return [node for node in nodes_of(path) if isinstance(node, kinds)]


def test_there_is_something_to_check():
    assert len(SOURCES) > 400
    assert {path.relative_to(ROOT).parts[1] for path in SOURCES} == {"vexture", "vexture-evidence", "vexture-geo"}


def test_no_module_has_a_vague_name():
    assert {path.stem for path in SOURCES if is_vague(path.stem)} <= MODULES


def test_no_function_has_a_vague_name():
    found = {
        f"{path.name}: {node.name}"
        for path in SOURCES
        for node in nodes(path, ast.FunctionDef, ast.AsyncFunctionDef)
        if is_vague(node.name) and node.name not in FUNCTIONS
    }
    assert found == set()


def test_no_parameter_has_a_vague_name():
    found = set()
    for path in SOURCES:
        for node in nodes(path, ast.FunctionDef, ast.AsyncFunctionDef):
            names = {one.arg for one in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)}
            found |= {f"{path.name}: {node.name}({name})" for name in names & VAGUE - PARAMETERS}
    assert found == set()


def test_a_class_has_a_name_of_its_own():
    homes = defaultdict(set)
    for path in SOURCES:
        for node in nodes(path, ast.ClassDef):
            if not node.name.startswith("_"):
                homes[node.name].add(path.relative_to(ROOT).as_posix())
    assert {name: places for name, places in homes.items() if len(places) > 1 and name not in CLASSES} == {}


def test_no_docstring_begins_with_a_question_word():
    for path in SOURCES:
        for node in nodes(path, ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef):
            first = re.match(r"[A-Za-z]*", ast.get_docstring(node) or "")[0].lower()
            assert first not in QUESTIONS, f"{path}, line {getattr(node, 'lineno', 1)}"
