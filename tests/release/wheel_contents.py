"""Metadata of a wheel, and what its modules import."""

import ast
import sys
import zipfile
from importlib.metadata import packages_distributions
from pathlib import Path

from packaging.metadata import Metadata
from packaging.utils import canonicalize_name


def metadata_of(wheel: Path) -> Metadata:
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return Metadata.from_email(archive.read(name))


def imported_by(wheel: Path) -> set[str]:
    """Top-level modules that a wheel's modules import, without those of Python."""
    imported = set[str]()
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if name.endswith(".py"):
                tree = ast.parse(archive.read(name))
                for node in ast.walk(tree):
                    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                        node.body = []  # what only checkers of types import
                for node in ast.walk(tree):
                    imported |= modules_of(node)
    return imported - set(sys.stdlib_module_names)


def not_required(modules: set[str], *requiring: Metadata) -> set[str]:
    """Those of the modules that no required distribution has."""
    homes = packages_distributions()
    required = {canonicalize_name(needed.name) for one in requiring for needed in one.requires_dist or ()}
    return {name for name in modules if not required & {canonicalize_name(home) for home in homes.get(name, ())}}


def modules_of(node: ast.AST) -> set[str]:
    """Top-level modules that a statement imports."""
    if isinstance(node, ast.Import):
        return {alias.name.partition(".")[0] for alias in node.names}
    if isinstance(node, ast.ImportFrom) and node.module and not node.level:
        return {node.module.partition(".")[0]}
    return set()
