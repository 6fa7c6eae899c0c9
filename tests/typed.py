"""`vexture` as people type it, run in this process: starting another one takes longer than most commands do."""

import os
import subprocess
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path

from vexture.cli.main import main

__all__ = ["typed"]


@contextmanager
def written(descriptor: int, path: Path) -> Iterator[None]:
    """Whatever is written to a descriptor goes into a file, by C libraries too."""
    kept = os.dup(descriptor)
    with path.open("w") as file:
        os.dup2(file.fileno(), descriptor)
        try:
            yield
        finally:
            os.dup2(kept, descriptor)
            os.close(kept)


def typed(*arguments: object) -> "subprocess.CompletedProcess[str]":
    """Exit code, standard output and standard error of a command."""
    words = [str(argument) for argument in arguments]
    with tempfile.TemporaryDirectory() as folder:
        out, errors = Path(folder, "out"), Path(folder, "errors")
        with (
            warnings.catch_warnings(),
            written(1, out),
            written(2, errors),
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
