"""The command line: what it prints and writes, and one line for everything that can go wrong."""

import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from click.testing import CliRunner

import vexture
from needed import NEEDS_GEO
from vexture.cli.main import main

OF_GEO = {name for home, names in vexture._HOMES.items() if home.startswith("vexture_geo") for name in names}
"""Public names that vexture-geo has."""

SQUARE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M2 2h6v5h-6z"/></svg>'
SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 10 10">{}</svg>'


def run(*arguments):
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        return CliRunner().invoke(main, [str(argument) for argument in arguments])


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


@pytest.mark.parametrize(
    ("encoding", "files", "bits"),
    [("packed", ["square.ktx2"], 14.9), ("thesis", ["square.curves.png", "square.quads.png"], 14)],
)
def test_convert_prints_a_line_and_writes_its_files(square, tmp_path, encoding, files, bits):
    result = run("convert", square, "-o", tmp_path / "out", "--encoding", encoding)
    assert result.exit_code == 0
    assert sorted(file.name for file in (tmp_path / "out").iterdir()) == files
    size = sum(file.stat().st_size for file in (tmp_path / "out").iterdir())
    line = rf"square: 4 segments, \d+ quads?, \d curves, {size} bytes, [\d.]+ ms, distance [\d.e+-]+ \+ ([\d.e-]+)\n"
    match = re.fullmatch(line, result.stdout)
    assert 0.25 <= float(match[1]) * 2**bits <= 1.0


def test_packed_is_the_default(square, tmp_path):
    assert run("convert", square, "-o", tmp_path).exit_code == 0
    np.testing.assert_array_equal(vexture.load(tmp_path / "square.ktx2").texels, vexture.convert(square).texels)


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("strategy", ["direct", "sampled"])
def test_parameters_reach_the_conversion(square, tmp_path, bits, strategy):
    arguments = ("--encoding", "thesis", "--bits", bits, "--strategy", strategy)
    assert run("convert", square, "-o", tmp_path, *arguments, "--tolerance", "0.01", "--max-depth", 5).exit_code == 0
    texture = vexture.load(tmp_path / "square", encoding="thesis")
    expected = vexture.convert(square, encoding="thesis", bits=bits, strategy=strategy, tolerance=0.01, max_depth=5)
    assert texture.bits == bits
    assert (texture.quads == expected.quads).all()
    assert (texture.curves == expected.curves).all()


def test_one_bad_file_among_many(square, tmp_path):
    bad = tmp_path / "bad.svg"
    bad.write_text("not xml")
    other = tmp_path / "other.svg"
    other.write_text(SQUARE)
    result = run("convert", square, bad, other, "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "1 of 3 files failed" in result.output
    assert sorted(file.name for file in (tmp_path / "out").iterdir()) == ["other.ktx2", "square.ktx2"]


def test_two_files_of_one_name_are_not_mixed_up(square, tmp_path):
    (tmp_path / "b").mkdir()
    twin = tmp_path / "b" / "square.svg"
    twin.write_text(SQUARE.replace("h6", "h3"))
    result = run("convert", square, twin, "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "is already what" in result.output
    written = vexture.load(tmp_path / "out" / "square.ktx2")
    np.testing.assert_array_equal(written.texels, vexture.convert(square).texels)
    result = run("convert", square, twin, "-o", tmp_path / "out", "--encoding", "thesis")
    assert result.exit_code == 1
    assert "is already what" in result.output


def test_warnings_are_one_line(tmp_path):
    file = tmp_path / "text.svg"
    file.write_text(SVG.format('<foreignObject/><foreignObject/><path d="M2 2h6v5z"/>'))
    result = run("convert", file, "-o", tmp_path)
    assert result.exit_code == 0
    lines = [line for line in result.output.splitlines() if "warning" in line]
    assert len(lines) == 1
    assert "foreignObject" in lines[0]


@pytest.mark.parametrize("content", ["", '<path d="M0 0h5v5z" display="none"/>'])
def test_empty_drawing_is_an_empty_texture_and_is_noted(tmp_path, content):
    file = tmp_path / "empty.svg"
    file.write_text(SVG.format(content))
    result = run("convert", file, "-o", tmp_path, "--encoding", "thesis")
    assert result.exit_code == 0
    assert "nothing in it is painted" in result.stderr
    assert json.loads(run("info", tmp_path / "empty", "--json").output)["coverage"] == 0
    for split in ((), ("--split", "paint")):
        assert run("convert", file, "-o", tmp_path, *split).exit_code == 0
        assert not vexture.load(tmp_path / "empty.ktx2").texels[0, 0, 2:].any()


BAD = {
    "not xml": "this is not xml",
    "truncated": SQUARE[:60],
    "entity bomb": '<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefghi", "bcdefghij", strict=True))
    + f"]>{SVG.format('<desc>&j;</desc>')}",
    "nested groups": SVG.format("<g>" * 50_000 + "</g>" * 50_000),
    "use cycle": SVG.format('<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g><use href="#a"/>'),
    "huge": SVG.format('<path d="M1e300 0L1 1L0 1z"/>'),
    "not finite": SVG.format('<path d="M1e999 0L1 1L0 1z"/>'),
    "nan": SVG.format(
        '<g transform="scale(NaN)"><path d="M1 0L1 1L0 1z"/></g><rect x="nan" width="1e400" height="3"/>'
    ),
}


LOST = ("nan", "use cycle", "not finite", "huge")
"""Drawings of which only an element is wrong."""

REST = '<path d="M2 2h6v5h-6z"/></svg>'


@pytest.mark.parametrize("case", BAD)
def test_bad_drawings_get_one_line(case, tmp_path):
    file = tmp_path / "bad.svg"
    file.write_text(BAD[case].replace("</svg>", REST) if case in LOST else BAD[case])
    result = run("convert", file, "-o", tmp_path / "out")
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    if case in LOST:  # what a reader must leave out it names, and converts the rest
        assert result.exit_code == 0
        assert re.fullmatch(r"vexture: warning: .*bad.svg: left out: (the \w+ )?<\w+> in line 1.*\n", result.stderr)
    else:
        assert result.output.count("\n") == 1
        assert result.exit_code == 1
        assert not (tmp_path / "out").exists(), "no empty folder is left behind"


def test_external_entity_is_never_read(tmp_path):
    secret = tmp_path / "secret.txt"
    secret.write_text("M2 2h6v6z")
    file = tmp_path / "external.svg"
    file.write_text(f'<!DOCTYPE svg [<!ENTITY x SYSTEM "{secret.as_uri()}">]>' + SVG.format('<path d="&x;"/>'))
    result = run("convert", file, "-o", tmp_path / "out")
    assert result.exit_code in (0, 1)
    if result.exit_code == 0:
        assert not vexture.load(tmp_path / "out" / "external.ktx2").texels[0, 0, 2:].any()


@pytest.mark.parametrize("command", ["convert", "render", "info"])
def test_missing_file(command, tmp_path):
    target = () if command == "info" else ("-o", tmp_path / "out" / "x.png")
    result = run(command, tmp_path / "missing.svg", *target)
    assert result.exit_code == 1
    assert "missing" in result.output
    assert result.output.count("\n") == 1


@pytest.mark.parametrize("command", ["render", "info"])
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("missing.svg", "missing.svg: not found; check the file's name"),
        ("missing.png", "missing.png: not found; check the file's name"),
        ("missing", "missing: not found; a texture is NAME.ktx2, or"),
        ("folder", "folder: is a folder; name a file in it"),
    ],
)
def test_missing_files_and_folders_are_called_what_they_are(command, tmp_path, name, says):
    (tmp_path / "folder").mkdir()
    result = run(command, tmp_path / name, *(("-o", tmp_path / "x.png") if command == "render" else ()))
    assert (result.exit_code, result.output.count("\n")) == (1, 1)
    assert says in result.output


@pytest.mark.parametrize(
    ("name", "content", "converted", "described"),
    [
        ("a.ktx2", b"", "is empty; give an SVG,", "it is empty; convert the drawing again"),
        ("a.svg", b"", "is empty; give an SVG,", "it is empty; give a texture"),
        ("a.ktx2", b"\x81\xff<", "holds nothing that can be read; give an SVG,", "begins with"),
        ("a.bin", b"\x81\xff<", "holds nothing that can be read; give an SVG,", "it is not a texture; give a texture"),
        pytest.param(
            *("a.json", b'{"a":1}', "is not GeoJSON; give an SVG,", "it is not a texture; give a texture"),
            marks=NEEDS_GEO,
        ),
        ("a.html", b"<html></html>", "not <svg>", "it is not a texture; give a texture"),
    ],
)
def test_content_decides_what_a_file_is_called(tmp_path, name, content, converted, described):
    (tmp_path / name).write_bytes(content)
    for command, says in (("convert", converted), ("info", described)):
        result = run(command, tmp_path / name, *(("-o", tmp_path) if command == "convert" else ()))
        assert (result.exit_code, result.output.count("\n")) == (1, 1)
        assert says in result.output


def test_a_fold_is_called_a_fold(square, tmp_path):
    fold = tmp_path / "square.fold.ktx2"
    assert run("fold", square, "-o", fold).exit_code == 0
    for command in (("info",), ("render", "-o", tmp_path / "x.png")):
        result = run(*command, fold)
        assert (result.exit_code, result.output.count("\n")) == (1, 1)
        assert "it is a fold, which three.js applies to the texture of a shape" in result.output


@pytest.mark.parametrize("name", ["", "a\nb\x1b.svg"])
def test_odd_names_make_one_line(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    result = run("convert", name)
    assert (result.exit_code, result.output.count("\n")) == (1, 1)
    assert ("a\ufffdb\ufffd.svg: cannot be read" if name else "the name of a file is empty") in result.output


def test_lists_too_long_name_the_remedy(tmp_path):
    hairline = Path(__file__).parents[3] / "examples" / "shapes" / "hairline.svg"
    result = run("convert", hairline, "-o", tmp_path, "--encoding", "thesis", "--bits", 8)
    assert result.exit_code == 1
    assert "256" in result.output
    assert "--bits 16" in result.output
    assert not list(tmp_path.iterdir())


def test_folder_that_cannot_be_written(square, tmp_path):
    (tmp_path / "file").write_text("")
    result = run("convert", square, "-o", tmp_path / "file" / "out")
    assert result.exit_code == 1
    assert result.output.count("\n") == 1
    assert "choose another place" in result.output


def test_picture_that_cannot_be_written(square, tmp_path):
    result = run("render", square, "-o", tmp_path / "none" / "x.png", "--renderer", "exact", "--size", 8)
    assert result.exit_code == 1
    assert "choose another file" in result.output


@pytest.mark.parametrize("name", ["", ".", "square.svg/x.png", "x" * 300 + ".png"])
def test_picture_that_cannot_have_its_name(square, tmp_path, name, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("render", square, "-o", name, "--renderer", "exact", "--size", 8)
    assert result.exit_code == 1
    assert result.output.count("\n") == 1
    assert [file.name for file in tmp_path.iterdir()] == ["square.svg"]


def test_a_failed_pair_leaves_the_old_one(square, tmp_path):
    run("convert", square, "-o", tmp_path, "--encoding", "thesis")
    (tmp_path / "square.curves.png").unlink()
    (tmp_path / "square.curves.png").mkdir()
    old = (tmp_path / "square.quads.png").read_bytes()
    assert run("convert", square, "-o", tmp_path, "--encoding", "thesis", "--max-depth", 3).exit_code == 1
    assert (tmp_path / "square.quads.png").read_bytes() == old


@pytest.mark.parametrize(
    ("command", "arguments"),
    [
        ("render", ("--size", "0")),
        ("render", ("--size", "100000")),
        ("render", ("--width", "0")),
        ("render", ("--height", "-1")),
        ("render", ("--view", "0,0,1e308,1e308")),
        ("render", ("--view", "0,0,1e-300,1e-300")),
        ("render", ("--view", "0,0,0,1")),
        ("render", ("--view", "0,0,nan,1")),
        ("render", ("--rotate", "inf")),
        ("convert", ("--encoding", "thesis", "--tolerance", "0")),
        ("convert", ("--tolerance", "nan")),
        ("convert", ("--max-depth", "99")),
    ],
)
def test_numbers_out_of_range(square, tmp_path, command, arguments):
    extra = ("--renderer", "exact") if command == "render" else ()
    result = run(command, square, "-o", tmp_path / ("x.png" if extra else "out"), *extra, *arguments)
    assert result.exit_code == 1
    assert result.output.count("\n") == 1
    assert f"{arguments[-2]} ".replace("rotate", "view") in result.output
    assert "matrix" not in result.output, "the command line has none"


def test_module_and_function_of_one_name():
    code = "import vexture; vexture.convert; import vexture.renderers.view; print(callable(vexture.render))"
    outcome = subprocess.run([sys.executable, "-c", code], check=True, env=os.environ, capture_output=True, text=True)
    assert outcome.stdout == "True\n"


@pytest.mark.parametrize("name", [pytest.param(name, marks=[NEEDS_GEO] * (name in OF_GEO)) for name in vexture.__all__])
def test_public_names_are_there(name):
    assert getattr(vexture, name).__name__ == name


def test_no_other_name_is_there():
    with pytest.raises(AttributeError, match="nothing"):
        _ = vexture.nothing


def test_fonts_of_texts(tmp_path):
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    file = tmp_path / "text.svg"
    file.write_text(SVG.format('<text y="8" font-size="8" font-family="cmr10">h</text>'))
    for font in (folder, folder / "cmr10.ttf"):
        result = run("convert", file, "-o", tmp_path, "--font", font, "--font", folder / "cmtt10.ttf")
        assert (result.exit_code, result.stderr) == (0, "")
        assert vexture.load(tmp_path / "text.ktx2").coverage(16).any()
    shown = [run("render", file, "-o", tmp_path / "a.png", "--font", folder / name) for name in ("cmr10.ttf", "no.ttf")]
    assert shown[0].stderr == ""
    assert (shown[1].exit_code, shown[1].stderr.count("\n")) == (1, 1)
    assert "no.ttf" in shown[1].stderr


@NEEDS_GEO
def test_fonts_are_refused_for_areas(tmp_path):
    folder, areas = Path(matplotlib.get_data_path()) / "fonts" / "ttf", tmp_path / "areas.geojson"
    areas.write_text('{"type": "Polygon", "coordinates": [[[4, 52], [6, 52], [6, 53], [4, 53]]]}')
    refused = run("convert", areas, "-o", tmp_path, "--font", folder)
    assert refused.exit_code == 1
    assert f"--font '{folder}' is for the texts of an SVG; leave it out" in refused.stderr
