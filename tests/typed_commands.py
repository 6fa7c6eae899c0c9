"""Commands of `vexture` as people type them, run in this process: starting another takes longer than most commands."""

import os
import subprocess
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path

from vexture.cli.main import main


@contextmanager
def capture_descriptor(descriptor: int, path: Path) -> Iterator[None]:
    """Write to a file what is written to a descriptor, by C libraries too."""
    saved = os.dup(descriptor)
    with path.open("w") as file:
        os.dup2(file.fileno(), descriptor)
        try:
            yield
        finally:
            os.dup2(saved, descriptor)
            os.close(saved)


def run_command(*arguments: object) -> "subprocess.CompletedProcess[str]":
    """Run a command; return its exit code, standard output and standard error."""
    words = [str(argument) for argument in arguments]
    with tempfile.TemporaryDirectory() as folder:
        out, errors = Path(folder, "out"), Path(folder, "errors")
        with (
            warnings.catch_warnings(),
            capture_descriptor(1, out),
            capture_descriptor(2, errors),
            out.open("a") as stdout,
            errors.open("a") as stderr,
            redirect_stdout(stdout),
            redirect_stderr(stderr),
        ):
            warnings.resetwarnings()
            code = 0
            try:
                main(words, prog_name="vexture")
            except SystemExit as stopped:
                code = stopped.code if isinstance(stopped.code, int) else int(stopped.code is not None)
        return subprocess.CompletedProcess(words, code, out.read_text(), errors.read_text())
