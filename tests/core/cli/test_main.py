"""The commands: their list and their help."""

import click
import pytest
from test_cli import run

from vexture.cli.main import main


def test_a_command_of_another_distribution_names_it(monkeypatch):
    monkeypatch.setattr("vexture.cli.main.PLUGINS", "vexture.none")
    result = run("report")
    assert result.exit_code == 2
    assert "No such command 'report'; the package vexture-evidence adds it" in result.output
    assert "vexture-evidence" not in run("reprot").output


@pytest.mark.parametrize("command", main.list_commands(click.Context(main)))
def test_every_command_has_help_with_an_example(command):
    result = run(command, "--help")
    assert result.exit_code == 0
    assert f"vexture {command} " in result.stdout.partition("Example")[2]
