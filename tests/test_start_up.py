"""What starting the command line and importing the package bring in: little, so that they answer at once."""

import json
import subprocess
import sys

import pytest
from click import Context

from vexture.cli.main import ADDED_SUMMARIES, COMMANDS, SUMMARIES, main

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

OF_LIST = {"vexture", "vexture.base", "vexture.base.errors"} | {
    f"vexture.cli{name}" for name in ("", ".interrupt", ".main", ".messages")
}
"""What the list of the commands takes, beside click and what adds commands: it is asked for most often."""


def test_the_list_of_the_commands_brings_in_none_of_them():
    code = f"{LIST}\nimport json, sys\nprint(json.dumps([*sys.modules]))"
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = json.loads(outcome.stdout.splitlines()[-1])
    assert {module for module in modules if module.split(".")[0] == "vexture"} == OF_LIST


def test_the_list_of_the_commands_is_what_they_say_themselves():
    context = Context(main)
    commands = {name: main.get_command(context, name) for name in (*COMMANDS, *ADDED_SUMMARIES)}
    said = {name: command.get_short_help_str(1000) for name, command in commands.items()}
    assert said == SUMMARIES | ADDED_SUMMARIES
