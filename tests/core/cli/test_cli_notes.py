"""The command line: notes of a drawing as lines, data and errors."""

import json
import re

import pytest
from test_cli import SQUARE, SVG, run


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


ZERO = SQUARE.replace("0 0 10 10", "0 0 0 10")
EMPTY = "; nothing else is in it; correct it, or draw it as paths"
NOTHING = {
    "only HTML": (SVG.format("<foreignObject/>"), "left out: <foreignObject>" + EMPTY),
    "only wrong": (
        SVG.format('<rect width="x" height="3"/>'),
        r"invalid and ignored: width='x' of <rect> in line 1; n.*",
    ),
}


@pytest.mark.parametrize("command", [("convert",), ("render",), ("export",), ("convert", "--encoding", "thesis")])
@pytest.mark.parametrize("case", NOTHING)
def test_a_drawing_of_which_nothing_can_be_drawn_fails(case, command, tmp_path):
    file, out = tmp_path / "a.svg", tmp_path / "out"
    text, said = NOTHING[case]
    file.write_text(text)
    places = {"convert": out, "render": tmp_path / "out.png", "export": tmp_path / "out.html"}
    result = run(*command, file, "-o", places[command[0]])
    assert result.exit_code == 1
    assert re.fullmatch(rf"vexture: {re.escape(str(file))}: {said}\n", result.output)
    assert [*tmp_path.iterdir()] == [file]


def test_a_size_of_zero_is_an_empty_drawing(tmp_path):
    file = tmp_path / "a.svg"
    file.write_text(ZERO)
    result = run("convert", file, "-o", tmp_path, "--strict")
    assert result.exit_code == 0
    assert "a.svg: its width or height is zero, at which nothing is shown; nothing in it is painted" in result.stderr


STRICT = SVG.format(
    '<g id="card" filter="url(#f)"><path d="M2 2h6v5h-6z"/></g><foreignObject/><foreignObject id="t"/>\n'
    f'<filter id="f">{"<feOffset/>" * 501}</filter>'
)


@pytest.mark.parametrize("command", ["convert", "render", "export"])
def test_strict_accepts_no_loss(square, tmp_path, command):
    file = tmp_path / "a.svg"
    file.write_text(STRICT)
    out = tmp_path / {"convert": "out", "render": "out.png", "export": "out.html"}[command]
    result = run(command, file, "-o", out, "--strict")
    assert result.exit_code == 1
    assert result.output == (
        f"vexture: {file}: left out: filter of offset (it has 501 steps; the limit is 500), <foreignObject> (2); "
        "--strict accepts no such note; correct the source, or leave it out\n"
    )
    assert not out.exists()
    assert run(command, square, "-o", out, "--strict").exit_code == 0


def test_strict_accepts_remarks(tmp_path):
    file = tmp_path / "a.svg"
    file.write_text(SVG.format('<view/><path d="M2 2h6v5h-6z"/>'))
    result = run("convert", file, "-o", tmp_path, "--strict")
    assert result.exit_code == 0
    assert "warning" in result.stderr


def test_json_has_the_notes(tmp_path):
    file = tmp_path / "a.svg"
    file.write_text(STRICT)
    (facts,) = json.loads(run("convert", file, "-o", tmp_path, "--json").stdout)
    blur, text = facts["notes"]
    assert blur["elements"] == [{"name": "card", "box": pytest.approx([0.2, 0.3, 0.8, 0.8])}]
    elements = [{"name": "the 1st <foreignObject> in line 1", "box": None}, {"name": "t", "box": None}]
    assert text == {"kind": "left out", "message": "<foreignObject>", "count": 2, "elements": elements}
