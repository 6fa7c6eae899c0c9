"""The command line: what it prints and writes, and one line for everything that can go wrong."""

import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import vexture
from vexture.cli import main
from vexture.errors import DeviceError

SQUARE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M2 2h6v5h-6z"/></svg>'
SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 10 10">{}</svg>'

LOGO = SVG.format(
    '<rect width="10" height="10" fill="#00f"/><path id="word" d="M2 2h6v4h-6z" fill="white"/>'
    '<path d="M2 5h6v4h-6z" fill="red" fill-opacity="0.5"/>'
)
STAR = SVG.format('<path d="M5 0 2 9 9 3 1 3 8 9z"/><circle cx="5" cy="5" r="3"/>')


def run(*arguments):
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        return CliRunner().invoke(main, [str(argument) for argument in arguments])


def need_gpu():
    """Skip the test, saying why, where there is no OpenGL."""
    from vexture.render.gpu import context

    try:
        context()
    except DeviceError as error:
        pytest.skip(str(error))


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


@pytest.mark.parametrize(
    ("encoding", "files", "bits"),
    [("packed", ["square.ktx2"], 15), ("thesis", ["square.curves.png", "square.quads.png"], 14)],
)
def test_convert_prints_a_line_and_writes_its_files(square, tmp_path, encoding, files, bits):
    result = run("convert", square, "-o", tmp_path / "out", "--encoding", encoding)
    assert result.exit_code == 0
    assert sorted(file.name for file in (tmp_path / "out").iterdir()) == files
    size = sum(file.stat().st_size for file in (tmp_path / "out").iterdir())
    line = rf"square: 4 segments, \d+ quads, \d curves, {size} bytes, [\d.]+ ms, distance [\d.e+-]+ \+ ([\d.e-]+)\n"
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
    texture = vexture.load(tmp_path / "square")
    expected = vexture.convert(square, encoding="thesis", bits=bits, strategy=strategy, tolerance=0.01, max_depth=5)
    assert texture.bits == bits
    assert (texture.quads == expected.quads).all()
    assert (texture.curves == expected.curves).all()


def test_parameters_of_packed_reach_the_conversion(tmp_path):
    star = tmp_path / "star.svg"
    star.write_text(STAR)
    arguments = ("--capacity", 2, "--precision", 1e-6, "--max-depth", 12, "--tolerance", 1e-3)
    assert run("convert", star, "-o", tmp_path, *arguments).exit_code == 0
    texture = vexture.load(tmp_path / "star.ktx2")
    expected = vexture.convert(star, capacity=2, precision=1e-6, max_depth=12, tolerance=1e-3)
    np.testing.assert_array_equal(texture.texels, expected.texels)
    assert texture.roots[0].tolerance == 1e-3


def test_colours_and_parts(tmp_path):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    result = run("convert", logo, "-o", tmp_path, "--split", "paint")
    assert result.exit_code == 0
    assert "12 segments, 3 layers, " in result.stdout
    roots = vexture.load(tmp_path / "logo.ktx2").roots
    assert [root.name for root in roots] == ["logo/1-#0000ff", "logo/2-#ffffff", "logo/3-#ff000080"]
    assert roots[2].paint == vexture.Paint((1.0, 0.0, 0.0), 0.5)
    result = run("convert", logo, "-o", tmp_path, "--select", "#word", "--encoding", "thesis")
    assert (result.exit_code, result.stdout[:19]) == (0, "logo: 4 segments, 1")
    result = run("convert", logo, "-o", tmp_path, "--select", "#wrod")
    assert (result.exit_code, result.output.count("\n")) == (1, 1)
    assert "'#wrod' matches no element" in result.output
    assert [root.name for root in vexture.load(tmp_path / "logo.ktx2").roots] == [root.name for root in roots]


def test_atlas(square, tmp_path):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    target = tmp_path / "new" / "all.ktx2"
    result = run("convert", square, logo, "--atlas", target)
    assert result.exit_code == 0
    first, second, last = result.stdout.splitlines()
    assert first.startswith("square: 4 segments, ")
    assert second.startswith("logo: 12 segments, ")
    assert last == f"{target}: 2 shapes, {target.stat().st_size} bytes"
    assert [file.name for file in target.parent.iterdir()] == ["all.ktx2"]
    texture = vexture.load(target)
    assert texture.name == "all"
    np.testing.assert_array_equal(texture.texels, vexture.atlas([square, logo]).texels)
    sizes = [int(re.search(r"(\d+) bytes", line)[1]) for line in (first, second)]
    assert texture.roots[1].quad * 16 == sizes[0]
    assert sum(sizes) <= texture.nbytes
    assert run("convert", square, logo, "--atlas", target, "--split", "paint").exit_code == 0
    names = [root.name for root in vexture.load(target).roots]
    assert names == ["square/1-#000000", "logo/1-#0000ff", "logo/2-#ffffff", "logo/3-#ff000080"]


def test_an_atlas_is_whole_or_not_written(square, tmp_path):
    bad = tmp_path / "bad.svg"
    bad.write_text("not xml")
    target = tmp_path / "all.ktx2"
    result = run("convert", bad, square, tmp_path / "gone.svg", "--atlas", target)
    assert result.exit_code == 1
    assert f"{bad}: not well-formed" in result.output
    assert "gone.svg: cannot be read" in result.output
    assert f"2 of 3 files failed; {target} is not written" in result.output
    run("convert", square, "--atlas", target)
    old = target.read_bytes()
    assert run("convert", square, square, "--atlas", target).exit_code == 1
    assert run("convert", square, bad, "--atlas", target).exit_code == 1
    assert target.read_bytes() == old
    assert sorted(file.name for file in tmp_path.iterdir()) == ["all.ktx2", "bad.svg", "square.svg"]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("--bits", "8"), "use the encoding thesis"),
        (("--strategy", "sampled"), "use the encoding thesis"),
        (("--encoding", "thesis", "--split", "paint"), "use the encoding packed"),
        (("--encoding", "thesis", "--capacity", "4"), "use the encoding packed"),
        (("--encoding", "thesis", "--precision", "1e-3"), "use the encoding packed"),
        (("--encoding", "thesis", "--atlas", "all.ktx2"), "use the encoding packed"),
        (("--atlas", "all.png"), "ends in .ktx2"),
        (("--atlas", "out"), "ends in .ktx2"),
        (("--atlas", "folder.ktx2"), "name one"),
        (("--atlas", "all.ktx2", "-o", "out"), "leave --output out"),
        (("--atlas", "square.svg/all.ktx2"), "choose another place"),
        (("--capacity", "0"), "1..15"),
        (("--capacity", "16"), "1..15"),
        (("--precision", "nan"), "precision nan"),
        (("--max-depth", "21"), "1..20"),
        (("--tolerance", "-1"), "at least 0"),
        (("--select", "g >"), "no CSS selector"),
    ],
)
def test_options_that_do_not_fit_get_one_line(square, tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.ktx2").mkdir()
    result = run("convert", square, *arguments)
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert says in result.stderr
    assert sorted(file.name for file in tmp_path.rglob("*")) == ["folder.ktx2", "square.svg"]


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


@pytest.mark.parametrize("stem", ["square", "square.quads.png", "square.curves.png"])
def test_render_takes_either_file_or_the_stem(square, tmp_path, stem):
    run("convert", square, "-o", tmp_path, "--encoding", "thesis")
    picture = tmp_path / "picture.png"
    result = run("render", tmp_path / stem, "-o", picture, "--size", 20, "--renderer", "cpu")
    assert (result.exit_code, result.output) == (0, "")
    image = np.asarray(Image.open(picture))
    assert image.shape == (20, 20)
    assert (image[8:10, 8:10] == 0).all()  # black inside
    assert (image[0] == 255).all()  # white outside


def drawn(folder, *arguments):
    """Picture that the GPU or the exact renderer draws."""
    picture = folder / "picture.png"
    result = run("render", *arguments, "-o", picture, "--size", 20)
    assert (result.exit_code, result.output) == (0, "")
    with Image.open(picture) as image:
        return np.asarray(image).astype(int)


def test_render_of_colours_and_parts_of_a_drawing(tmp_path):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    colours = drawn(tmp_path, logo, "--split", "paint", "--renderer", "exact")
    assert colours.shape == (20, 20, 3)
    assert colours[10, 1].tolist() == [0, 0, 255]
    assert colours[8, 6].tolist() == [255, 255, 255]
    assert colours[12, 14].tolist() == [128, 0, 128]
    assert colours[10, 6].tolist() == colours[1, 10].tolist() == [255, 255, 255]
    part = drawn(tmp_path, logo, "--select", "#word", "--renderer", "exact")
    assert part.shape == (20, 20)
    assert part.min() == part[8, 6] == 0
    assert part[10, 1] == 255


def test_render_of_an_atlas(square, tmp_path):
    need_gpu()
    logo, atlas = tmp_path / "logo.svg", tmp_path / "all.ktx2"
    logo.write_text(LOGO)
    run("convert", square, logo, "--atlas", atlas, "--split", "paint")
    colours = drawn(tmp_path, logo, "--split", "paint", "--renderer", "exact")
    for quality in ("fast", "exact"):
        assert np.abs(drawn(tmp_path, atlas, "--root", "logo", "--quality", quality) - colours).max() <= 3
    word = drawn(tmp_path, logo, "--select", "#word", "--renderer", "exact")
    for root in ("logo/2-#ffffff", "2"):
        assert np.abs(drawn(tmp_path, atlas, "--root", root) - word).max() <= 3
    run("convert", logo, "-o", tmp_path, "--split", "paint")
    assert np.abs(drawn(tmp_path, tmp_path / "logo.ktx2") - colours).max() <= 3
    run("convert", square, "-o", tmp_path)
    assert np.abs(drawn(tmp_path, tmp_path / "square") - drawn(tmp_path, square, "--renderer", "exact")).max() <= 3


@pytest.mark.parametrize(
    ("shown", "arguments", "says"),
    [
        ("all.ktx2", (), "2 drawings (square, logo); choose one by root"),
        ("all.ktx2", ("--root", "lgo"), "lgo"),
        ("all.ktx2", ("--root", "7"), "7"),
        ("all.ktx2", ("--root", "logo", "--split", "paint"), "needs the drawing"),
        ("all.ktx2", ("--select", "#word"), "needs the drawing"),
        ("all.ktx2", ("--root", "logo", "--renderer", "exact"), "draws drawings"),
        ("logo.svg", ("--root", "logo"), "leave it out"),
        ("logo.svg", ("--select", "#wrod"), "matches no element"),
        ("logo.svg", ("--quality", "fast", "--renderer", "exact"), "knows no quality"),
    ],
)
def test_what_cannot_be_drawn_gets_one_line(square, tmp_path, shown, arguments, says):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    run("convert", square, logo, "--atlas", tmp_path / "all.ktx2", "--split", "paint")
    result = run("render", tmp_path / shown, *arguments, "-o", tmp_path / "x.png")
    assert (result.exit_code, result.output.count("\n")) == (1, 1)
    assert says in result.output
    assert not (tmp_path / "x.png").exists()


def test_view_and_rotation(square, tmp_path):
    picture = tmp_path / "picture.png"
    # the square spans x 0.2..0.8 and, y up, 0.3..0.8; this view shows its lower left corner in its middle
    arguments = ("--size", 40, "--renderer", "exact", "--view", "0.1,0.2,0.2,0.2")
    assert run("render", square, "-o", picture, *arguments).exit_code == 0
    image = np.asarray(Image.open(picture))
    assert image[10, 30] == 0
    assert image[10, 10] == image[30, 10] == image[30, 30] == 255
    run("render", square, "-o", picture, *arguments, "--rotate", 90)
    turned = np.asarray(Image.open(picture))
    assert (turned == np.rot90(image)).all()  # counter-clockwise, as NumPy turns
    run("render", square, "-o", picture, "--size", 40, "--renderer", "exact", "--view", "0,0,1,0.5")
    assert np.asarray(Image.open(picture)).shape == (20, 40)


def test_info(square, tmp_path):
    run("convert", square, "-o", tmp_path, "--encoding", "thesis")
    facts = json.loads(run("info", tmp_path / "square", "--json").output)
    assert facts["encoding"] == "thesis"
    assert facts["bits"] == 16
    assert abs(facts["coverage"] - 0.3) < 1e-3
    assert np.allclose(facts["transform"], [[10, 0, 0], [0, -10, 10]])
    assert "quads" in run("info", tmp_path / "square").output


def test_warnings_are_one_line(tmp_path):
    file = tmp_path / "text.svg"
    file.write_text(SVG.format('<text x="1" y="5">hello</text><text>again</text><path d="M2 2h6v5z"/>'))
    result = run("convert", file, "-o", tmp_path)
    assert result.exit_code == 0
    lines = [line for line in result.output.splitlines() if "warning" in line]
    assert len(lines) == 1
    assert "text" in lines[0]


def test_empty_drawing_is_an_empty_texture(tmp_path):
    file = tmp_path / "empty.svg"
    file.write_text(SVG.format(""))
    assert run("convert", file, "-o", tmp_path, "--encoding", "thesis").exit_code == 0
    assert json.loads(run("info", tmp_path / "empty", "--json").output)["coverage"] == 0
    for split in ((), ("--split", "paint")):
        assert run("convert", file, "-o", tmp_path, *split).exit_code == 0
        assert not vexture.load(tmp_path / "empty.ktx2").texels[0, 0, 2:].any()


BOMB = "".join(f'<g id="g{k}">' + f'<use href="#g{k + 1}"/>' * 10 + "</g>" for k in range(12))
BAD = {
    "not xml": "this is not xml",
    "truncated": SQUARE[:60],
    "entity bomb": '<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefghi", "bcdefghij", strict=True))
    + f"]>{SVG.format('<desc>&j;</desc>')}",
    "nested groups": SVG.format("<g>" * 50_000 + "</g>" * 50_000),
    "use cycle": SVG.format('<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g><use href="#a"/>'),
    "use bomb": SVG.format(BOMB + '<path id="g12" d="M1 1h1v1z"/>'),
    "huge": SVG.format('<path d="M1e300 0L1 1L0 1z"/>'),
    "not finite": SVG.format('<path d="M1e999 0L1 1L0 1z"/>'),
    "nan": SVG.format(
        '<g transform="scale(NaN)"><path d="M1 0L1 1L0 1z"/></g><rect x="nan" width="1e400" height="3"/>'
    ),
    "zero viewBox": SQUARE.replace("0 0 10 10", "0 0 0 10"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_drawings_get_one_line(case, tmp_path):
    file = tmp_path / "bad.svg"
    file.write_text(BAD[case])
    result = run("convert", file, "-o", tmp_path / "out")
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    assert result.output.count("\n") == 1
    if result.exit_code == 0:  # what a reader must leave out it names
        assert case in ("nan", "use cycle", "not finite", "huge")
    else:
        assert result.exit_code == 1
        assert not any((tmp_path / "out").iterdir())


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


def test_lists_too_long_name_the_remedy(tmp_path):
    hairline = Path(__file__).parents[1] / "examples" / "shapes" / "hairline.svg"
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
    assert "choose another folder" in result.output


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
    result = run(command, square, "-o", tmp_path / "out", *extra, *arguments)
    assert result.exit_code == 1
    assert result.output.count("\n") == 1


def test_exact_renderer_needs_the_drawing(square, tmp_path):
    run("convert", square, "-o", tmp_path)
    result = run("render", tmp_path / "square.ktx2", "-o", tmp_path / "x.png", "--renderer", "exact")
    assert result.exit_code == 1
    assert "drawing" in result.output


def test_module_and_function_of_one_name():
    code = "import vexture; vexture.convert; import vexture.render.view; assert callable(vexture.render)"
    subprocess.run([sys.executable, "-c", code], check=True, env=os.environ)


def test_public_names_are_there():
    for name in vexture.__all__:
        assert getattr(vexture, name).__name__ == name
    with pytest.raises(AttributeError, match="nothing"):
        _ = vexture.nothing
