"""Options that several commands have, and the pipes that they read."""

import os
import sys

import numpy as np
import pytest
from test_cli_streams import LOGO, run, shell

import vexture
from needed import NEEDS_GEO
from vexture.conversion.reading import read_drawing
from vexture.texture.load import texture_from


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(LOGO.format("<foreignObject/>"))
    return file


def test_options_for_research_have_a_section_of_their_own():
    usual, research = run("convert", "--help").stdout.split("Options for research")
    for option in ("--encoding", "--bits", "--strategy"):
        assert option in research
        assert option not in usual


STARTED = [sys.executable, "-c", "from vexture.cli.start import main; main()"]
"""The program from its start on, which is where it looks for streams that are closed."""


@pytest.mark.parametrize("place", ["/dev/stdin", "<(cat logo.svg)", pytest.param("pipe.svg", marks=pytest.mark.slow)])
def test_a_pipe_of_a_name_is_read(logo, tmp_path, place):
    """Its start was taken to see what it holds, and the rest was no drawing."""
    line = f'cd {tmp_path}; "$@" {place} -o - -q < logo.svg'
    if place == "pipe.svg":
        os.mkfifo(tmp_path / place)
        line = f'cat {logo} > {tmp_path / place} & "$@" {tmp_path / place} -o - -q'
    result = shell(line, "convert")
    assert (result.returncode, result.stderr) == (0, b"")
    np.testing.assert_array_equal(
        texture_from(result.stdout, "piped").texels, vexture.convert(read_drawing(logo)).texels
    )


@pytest.mark.slow
def test_commands_read_pipes_of_names(logo, tmp_path):
    texture = vexture.convert(read_drawing(logo)).save(tmp_path / "logo.ktx2")
    assert b"texels" in shell(f'"$@" <(cat {texture})', "info").stdout
    for name, content in (("render", logo), ("render", texture), ("fold", logo), ("export", logo)):
        output = tmp_path / {"render": "logo.png", "fold": "logo.fold.ktx2", "export": "logo.html"}[name]
        result = shell(f'"$@" <(cat {content}) -o {output}', name)
        assert (result.returncode, output.exists()) == (0, True), result.stderr
        output.unlink()


@NEEDS_GEO
def test_what_is_read_several_times_is_no_pipe(tmp_path):
    for arguments in (("tiles", "-o", tmp_path / "a.pmtiles"), ("flood", "-o", tmp_path / "a.html", "--extent")):
        result = shell('"$@" <(echo "{}")', *arguments)
        assert result.returncode == 1
        assert b"is read several times, and a pipe only once; save it as a file\n" in result.stderr


@pytest.mark.parametrize("name", ["convert", pytest.param("render", marks=pytest.mark.slow)])
def test_standard_output_that_is_closed_is_one_line(logo, name):
    result = shell('"$@" >&-', name, logo, "-o", "-", program=STARTED)
    assert (result.returncode, result.stderr) == (1, b"vexture: standard output is closed; name a file with -o\n")


def test_standard_input_that_is_closed_is_one_line():
    result = shell('"$@" <&-', "convert", "-", "-o", "-", program=STARTED)
    assert (result.returncode, result.stderr) == (1, b"vexture: standard input: it is closed; give a file\n")
