"""Ctrl-C ends a command in one line, whatever it is doing, and leaves nothing half-written."""

import os
import signal
import subprocess
import sys
import time
import tomllib
import types
from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
import pytest
from click.testing import CliRunner

from vexture.cli.main import COMMANDS, main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="sends signals as POSIX has them")

LINE = "vexture: interrupted\n"

LLVM_AT_WORK = """
import signal
import click
def call():
    signal.raise_signal(signal.SIGINT)
    click.echo("done")
"""
"""A command that Ctrl-C reaches in a module of LLVM's."""


def work(call: Callable[[], None]) -> None:
    """Call LLVM, and go on elsewhere."""
    call()
    for _ in range(1000):
        time.sleep(0.01)


@pytest.fixture
def scribble(tmp_path: Path) -> Path:
    """A drawing that takes much longer than these tests wait."""
    corners = " ".join(map(str, np.random.default_rng(1).integers(0, 1000, 8000)))
    file = tmp_path / "scribble.svg"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 999 999"><polygon points="{corners}"/></svg>'
    )
    return file


PRESSED = """
import multiprocessing, os, signal, sys, threading, time
from vexture.cli.main import main

def press():
    while "vexture.tree.build" not in sys.modules and not multiprocessing.active_children():
        time.sleep(0.02)
    time.sleep(0.3)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press).start()
main(sys.argv[1:])
"""
"""Ctrl-C soon after a tree, or another process, has begun."""


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_conversion_ends_in_a_line(scribble: Path, tmp_path: Path, jobs: int) -> None:
    other = scribble.with_name("other.svg")
    other.write_bytes(scribble.read_bytes())
    arguments = ["convert", scribble, other, "-q", "-j", str(jobs), "-o", tmp_path / "out"]
    ended = subprocess.run([sys.executable, "-c", PRESSED, *arguments], capture_output=True, text=True, timeout=60)
    assert (ended.returncode, ended.stderr) == (130, LINE)
    assert not (tmp_path / "out").exists()


EARLY = """
import runpy, signal, sys

class Presser:
    def find_spec(self, name, path=None, target=None):
        if name == pressed:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Presser())
pressed, sys.argv[1:] = sys.argv[1], [sys.argv[2], "--help"]
"""
"""Ctrl-C while the modules of the command line are imported."""


@pytest.mark.parametrize("module", ["vexture.cli.main", "click", "vexture.cli.convert"])
def test_it_ends_while_its_modules_are_imported(module: str) -> None:
    check_early_end(module, "convert")


def check_early_end(module: str, command: str) -> None:
    """Press Ctrl-C while a module of a command is imported."""
    file = Path(__file__).parents[3] / "packages" / "vexture" / "pyproject.toml"
    program = tomllib.loads(file.read_text())["project"]["scripts"]["vexture"]
    home, function = program.split(":")
    for start in (f"from {home} import {function}; {function}()", "runpy.run_module('vexture', run_name='__main__')"):
        ended = subprocess.run(
            [sys.executable, "-c", EARLY + start, module, command], capture_output=True, text=True, timeout=60
        )
        assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", LINE)


def test_it_ends_while_kernels_are_compiled(scribble: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-c", "from vexture.cli.main import main; main()", "convert", str(scribble)]
    environment = os.environ | {"VEXTURE_CACHE": str(tmp_path / "cache")}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment, cwd=tmp_path) as process:
        assert process.stderr is not None
        assert "compiling kernels" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        assert process.stderr.read() == LINE
    assert process.returncode == 130
    assert not list(tmp_path.glob("*.ktx2"))


def test_it_waits_while_llvm_works(monkeypatch: pytest.MonkeyPatch) -> None:
    module = types.ModuleType("llvmlite.loser")
    exec(LLVM_AT_WORK, module.__dict__)
    module.__dict__["loser"] = click.command("loser")(lambda: work(module.__dict__["call"]))
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(COMMANDS, "loser", module.__name__)
    result = CliRunner().invoke(main, ["loser"])
    assert (result.exit_code, result.stdout, result.stderr) == (130, "done\n", LINE)
