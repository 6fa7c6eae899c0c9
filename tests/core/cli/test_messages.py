"""Messages of the command line: options in place of parameters, and one line for each error."""

import errno
import warnings

import click
import pytest

from needed import NEEDS_GEO
from vexture.base.errors import SourceError
from vexture.cli.messages import as_options, one_line


def test_parameters_become_options():
    assert as_options("`max_depth` is 3; use `fonts`, not `Fonts`") == "--max-depth is 3; use --font, not `Fonts`"


@NEEDS_GEO
def test_the_command_that_runs_names_its_own_options():
    options = [click.Option(["--color", "--page-color", "page_colors"]), click.Option(["--layer"])]
    with click.Context(click.Command("one", params=options)):
        assert as_options("`page_colors`, `layer`, `variable`") == "--color, --layer, --variable of vexture flood"
    assert as_options("`layer`") == "--layer"


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (SourceError("a.svg: `names` is x\nand y"), "a.svg: --names is x\ufffdand y"),
        (
            OSError(errno.ENOSPC, "No space left", "out.png"),
            "out.png: No space left; make room, or choose another place",
        ),
        (OSError(errno.EACCES, "Denied"), "the output: Denied; choose another file"),
        (MemoryError(), "out of memory; use a smaller drawing or a smaller --size"),
    ],
)
def test_an_error_is_one_line_and_ends_the_command(capsys, error, line):
    with pytest.raises(SystemExit) as ended, one_line():
        raise error
    assert ended.value.code == 1
    assert capsys.readouterr().err == f"vexture: {line}\n"


def test_warnings_of_libraries_are_lines_and_bugs_are_not_hidden(capsys):
    with one_line():
        warnings.warn("old `tolerance`", DeprecationWarning, stacklevel=1)
    assert capsys.readouterr().err == "vexture: warning: old --tolerance\n"
    for bug in (ZeroDivisionError, BrokenPipeError):
        with pytest.raises(bug), one_line():
            raise bug
