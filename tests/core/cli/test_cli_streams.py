"""Pipes, JSON, processes and how much is said: what the command line shares with its neighbours."""

import io
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import vexture
from vexture.base.kernels import kernel_cache
from vexture.cli.main import main
from vexture.conversion.reading import read_drawing
from vexture.texture.load import texture_from
from warm_process import command

LOGO = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><rect width="10" height="10" fill="#f00"/>
<rect x="10" width="10" height="5" fill="#00f" fill-opacity=".5"/>{}</svg>"""


def run(*arguments, given=None):
    return CliRunner().invoke(main, [str(argument) for argument in arguments], input=given)


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.svg"
    file.write_text(LOGO.format("<foreignObject/>"))
    return file


def test_a_drawing_goes_through_a_pipe(logo):
    result = run("convert", "-", "-o", "-", given=logo.read_bytes())
    assert result.exit_code == 0
    made = texture_from(result.stdout_bytes, "piped")
    np.testing.assert_array_equal(made.texels, vexture.convert(read_drawing(logo)).texels)
    assert "segments" in result.stderr, "what is said of it does not stand in the file"
    told = json.loads(run("info", "-", "--json", given=result.stdout_bytes).stdout)
    assert told["texels"] == made.info()["texels"]


def test_an_atlas_goes_through_a_pipe(logo):
    result = run("convert", logo, "--atlas", "-", "--split", "paint", "-q")
    assert (result.exit_code, result.stderr) == (0, "")
    roots = texture_from(result.stdout_bytes, "piped").roots
    assert [root.name for root in roots] == ["logo/1-#ff0000", "logo/2-#0000ff80"]


def test_a_picture_goes_through_a_pipe(logo):
    result = run("render", "-", "-o", "-", "--width", 40, given=logo.read_bytes())
    assert result.exit_code == 0
    with Image.open(io.BytesIO(result.stdout_bytes)) as image:
        assert (image.mode, image.size) == ("RGB", (40, 20))


def test_a_texture_goes_through_a_pipe_into_a_picture(logo):
    data = run("convert", "-", "-o", "-", given=logo.read_bytes()).stdout_bytes
    result = run("render", "-", "-o", "-", "--size", 8, given=data)
    assert result.exit_code == 0
    with Image.open(io.BytesIO(result.stdout_bytes)) as image:
        assert image.size == (8, 8)
    assert (
        "standard input: --select g is for a drawing"
        in run("render", "-", "-o", "x.png", "--select", "g", given=data).stderr
    )


@pytest.mark.slow
@pytest.mark.parametrize(("how", "said"), [((), "compiling kernels"), (("-q",), "")])
def test_quiet_is_quiet_while_kernels_are_compiled(logo, tmp_path, how, said):
    whole = kernel_cache()  # without one kernel, since all of them take a minute
    shutil.copytree(whole, tmp_path / whole.name, ignore=shutil.ignore_patterns("build.grow-*", "*.tmp.*"))
    command = [sys.executable, "-c", "from vexture.cli.main import main; main()"]
    command += ["convert", str(logo), "--silhouette", "-o", str(tmp_path), *how]
    environment = os.environ | {"VEXTURE_CACHE": str(tmp_path)}
    result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=500)
    assert result.returncode == 0
    assert said in result.stderr if said else (result.stdout, result.stderr) == ("", "")
    assert list((tmp_path / whole.name).rglob("build.grow-*"))


def test_a_reader_that_has_enough_ends_a_command_in_silence(logo, tmp_path):
    texture = vexture.convert(read_drawing(logo)).save(tmp_path / "logo.ktx2")
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-c", "from vexture.cli.main import main; main()", "info", str(texture)]
    with open(writing, "wb") as closed:
        assert subprocess.run(command, stdout=closed, stderr=subprocess.PIPE, timeout=300).stderr == b""


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("-o", "-", "--encoding", "thesis"), "the encoding thesis writes several files; name a folder"),
        (("other.svg", "-o", "-"), "use --atlas -"),
    ],
)
def test_what_does_not_fit_into_a_pipe_is_refused(logo, arguments, says):
    result = run("convert", logo, *arguments)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (1, "", 1)
    assert says in result.stderr


SHARED = '<g opacity="0.5"><path d="M1 1h5v5z"/><path d="M1 1h5v5z"/></g>'
LOST = "simplified: opacity of a group, which each of its shapes has by itself"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("convert", "-o", "."), []),
        (("convert", "-o", ".", "--split", "paint"), ["{file}: " + LOST]),
        (("convert", "--atlas", "a.ktx2", "--split", "paint"), ["{file}: " + LOST]),
        (("convert", "-o", ".", "--split", "faces"), []),
        (("convert", "-o", ".", "--silhouette"), []),
        (("render", "-o", "a.png", "--size", "8"), []),
        (("render", "-o", "a.png", "--size", "8", "--renderer", "exact"), []),
        (("render", "-o", "a.png", "--size", "8", "--silhouette"), []),
    ],
)
def test_what_layers_lose_is_said_where_they_are_made(tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "a.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{SHARED}</svg>')
    result = run(arguments[0], file, *arguments[1:])
    assert result.exit_code == 0
    assert result.stderr.splitlines() == [f"vexture: warning: {line.format(file=file)}" for line in said]


def test_processes_make_the_same_files(logo, tmp_path):
    sources = []
    for number in range(3):
        sources.append(tmp_path / f"logo{number}.svg")
        sources[-1].write_text(LOGO.format(f'<circle cx="5" cy="5" r="{number + 1}"/>'))
    bad = tmp_path / "bad.svg"
    bad.write_text("no svg")
    one = run("convert", *sources, bad, "-o", tmp_path / "one")
    two = run("convert", *sources, bad, "-o", tmp_path / "two", "-j", 2)
    assert (one.exit_code, two.exit_code) == (1, 1)
    assert [line.split(":")[0] for line in two.stdout.splitlines()] == ["logo0", "logo1", "logo2"]
    assert one.stderr == two.stderr
    files = {file.name: file.read_bytes() for file in (tmp_path / "one").iterdir()}
    assert len(files) == 3
    assert files == {file.name: file.read_bytes() for file in (tmp_path / "two").iterdir()}


@pytest.mark.parametrize(
    ("options", "size"),
    [
        (("--width", 40), (40, 20)),
        (("--width", 40, "--view", "0,0,1,1"), (40, 40)),
        (("--height", 30, "--view", "0,0,1,0.5"), (60, 30)),
        (("--width", 40, "--height", 10), (40, 10)),
        (("--size", 24, "--view", "0,0,0.5,1"), (12, 24)),
    ],
)
def test_width_and_height(logo, tmp_path, options, size):
    assert run("render", logo, "-o", tmp_path / "x.png", *options).exit_code == 0
    with Image.open(tmp_path / "x.png") as image:
        assert image.size == size


def test_size_does_not_stand_beside_width(logo, tmp_path):
    result = run("render", logo, "-o", tmp_path / "x.png", "--size", 8, "--width", 8)
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert "--size 8 sets the longer side; leave it out beside --width or --height" in result.stderr


SQUARE = ("--size", 20, "--view", "0,0,1,1")


def test_background(logo, tmp_path):
    def drawn(background):
        result = run("render", logo, "-o", tmp_path / "x.png", *SQUARE, "--background", background)
        assert result.exit_code == 0
        with Image.open(tmp_path / "x.png") as image:
            return np.asarray(image).astype(int)

    none = drawn("none")  # the drawing is the middle half of the square
    assert none.shape == (20, 20, 4)
    assert none[8, 5].tolist() == [255, 0, 0, 255]
    assert np.abs(none[7, 15] - [0, 0, 255, 127.5]).max() <= 0.5
    assert none[0, 0].tolist() == [0, 0, 0, 0]
    assert np.abs(drawn("white")[7, 15] - [127.5, 127.5, 255]).max() <= 0.5
    assert drawn("#ff0")[0, 0].tolist() == [255, 255, 0]
    assert np.abs(drawn("rgb(0 0 0 / 50%)")[0, 0] - [0, 0, 0, 127.5]).max() <= 0.5
    result = run("render", logo, "-o", tmp_path / "y.png", "--background", "reddish")
    assert result.exit_code == 2
    assert "neither a CSS colour" in result.stderr


def shell(line, *arguments, program=None):
    """Run a line of a shell, in which "$@" is the program with arguments."""
    words = ["bash", "-c", line, "bash", *(program or command()), *map(str, arguments)]
    return subprocess.run(words, capture_output=True, timeout=300)


RARER = ["verbose", "usage", "atlas"]

CONTROLS = "\x1b[2J\x9b2J\u202e\u2066\x07\x7f\udc9b"
"""What moves a cursor, in both sets; turns the direction of writing; rings; is no character."""


@pytest.mark.parametrize(
    "kind", ["line", "error", "warning", "info", *(pytest.param(kind, marks=pytest.mark.slow) for kind in RARER)]
)
def test_names_control_no_terminal(tmp_path, kind):
    """The name of a drawing, of a file, of an element, in whatever is printed."""
    name = f"a{CONTROLS}b"
    body = "<svg" if kind == "error" else LOGO.format("<foreignObject/>" if kind == "warning" else "")
    source = tmp_path / f"{name}.svg"
    source.write_text(body)
    arguments = ["convert", source, "-o", tmp_path / "out", *(["-v"] if kind == "verbose" else [])]
    if kind == "info":
        arguments = ["info", vexture.convert(read_drawing(body.encode(), name=name)).save(tmp_path / "a.ktx2")]
    if kind == "usage":
        arguments = ["convert", f"--{name}"]
    if kind == "atlas":
        arguments = ["convert", source, "--atlas", tmp_path / f"{name}.ktx2"]
    result = shell('"$@"', *arguments)
    said = (result.stdout + result.stderr).decode("utf-8")
    assert said.strip("\n")
    assert all(letter.isprintable() or letter == "\n" for letter in said), ascii(said)


def test_json_of_odd_names_is_json(tmp_path):
    source = tmp_path / f"a{CONTROLS}b.svg"
    source.write_text(LOGO.format(""))
    result = shell('"$@"', "convert", source, "-o", tmp_path / "out", "--json")
    (facts,) = json.loads(result.stdout)
    assert facts["source"] == str(source)
    assert result.stdout.isascii()
