"""The commands `text` and `font`."""

import json
import os

import pytest
from click.testing import CliRunner
from made import BLUE, RED, fill_shape, made_font, solid, stack_paints

import vexture
from vexture.cli.main import main


@pytest.fixture(scope="module")
def font(tmp_path_factory):
    file = tmp_path_factory.mktemp("cli") / "made.ttf"
    paint = stack_paints(fill_shape("square", solid(RED)), fill_shape("tall", solid(BLUE)))
    file.write_bytes(made_font({"A": "left", "V": "disc", "é": "left", "C": "square"}, {"C": paint}))
    return file


def run(*arguments, **options):
    return CliRunner().invoke(main, [str(argument) for argument in arguments], **options)


def test_a_word_becomes_a_texture(font, tmp_path):
    result = run("text", "AV", "--font", font, "-o", tmp_path)
    assert result.exit_code == 0, result.output
    assert result.stdout.startswith("AV: ")
    (root,) = vexture.load(tmp_path / "AV.ktx2").roots
    assert (root.name, root.is_map, root.paint) == ("AV", False, None)


def test_options_of_convert_and_of_the_text_are_heard(font, tmp_path):
    target = tmp_path / "word.ktx2"
    arguments = ("--font", font, "--name", "word", "--color", "#ff000080", "--tolerance", 0, "--json", "-o", target)
    result = run("text", r"A\nV", *arguments)
    assert result.exit_code == 0, result.output
    (facts,) = json.loads(result.stdout)
    assert (facts["source"], facts["files"]) == ("word", [str(target)])
    (root,) = vexture.load(target).roots
    assert root.paint.hex == "#ff000080"
    assert root.to_source[0, 0] == pytest.approx(2.0)  # ems of two lines


def test_text_of_a_pipe_in_colours_to_a_pipe(font):
    result = run("text", "-", "--font", font, "-o", "-", input="AC\n")
    assert result.exit_code == 0
    (root,) = vexture.texture.load.texture_from(result.stdout_bytes, "pipe").roots
    assert root.is_map


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("text", " "), "nothing of the text is painted"),
        (("text", "A", "--weight", 0), "--weight is 0; it must be 1 to 1000"),
        (("text", "A", "--features", "x"), "--features 'x' is no OpenType feature"),
        (("text", "A", "-o", "a.svg"), "name FILE.ktx2 or a folder"),
        (("font", "FONT", "--range", "U+5-4", "-o", "a.ktx2"), "--range 'U+5-4' is no range of characters"),
        (
            ("font", "FONT", "--chars", "xyz", "-o", "a.ktx2"),
            "Made has none of what is asked for (3 characters); give others as --chars",
        ),
        (("font", "FONT", "--chars", "", "-o", "a.ktx2"), "--chars is empty; give some"),
        (("font", "FONT", "--chars-file", os.devnull, "-o", "a.ktx2"), "--chars is empty; give some"),
        (
            ("font", "FONT", "--range", "U+400-40F", "-o", "a.ktx2"),
            "Made has none of what is asked for (16 characters); give",
        ),
        (("font", __file__, "-o", "a.ktx2"), "holds no font; give a TrueType"),
        (("font", "EMPTY", "-o", "a.ktx2"), "empty: the folder holds no font that can be read; give one with .ttf,"),
        (("text", "A", "--font", "EMPTY"), "empty: the folder holds no font that can be read; give one with .ttf,"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(font, arguments, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "empty" / "damaged.ttf").write_bytes(b"no font")
    given = [{"FONT": font, "EMPTY": tmp_path / "empty"}.get(part, part) for part in arguments]
    result = run(*given, *(("--font", font) if given[0] == "text" else ()))
    assert result.exit_code == 1
    assert message in result.output
    assert result.output.count("\n") == 1
    assert [*tmp_path.iterdir()] == [tmp_path / "empty"]


def test_a_name_without_the_ending_of_a_texture_is_a_folder(font, tmp_path):
    for command in (("font", font, "--chars", "A"), ("text", "A", "--font", font, "--name", "Made")):
        assert run(*command, "-o", tmp_path / "new").exit_code == 0
        assert (tmp_path / "new" / "Made.ktx2").is_file()
    assert (tmp_path / "new" / "Made.json").is_file()


def test_a_long_text_is_named_by_its_start(font, tmp_path):
    result = run("text", "AV" * 500, "--font", font, "-o", tmp_path)
    name = ("AV" * 30)[:57] + "..."
    assert result.stdout.startswith(f"{name}: ")
    (file,) = tmp_path.iterdir()
    assert (file.stem, vexture.load(file).name) == (name.rstrip("."), name)


def test_characters_of_a_font_become_an_atlas(font, tmp_path):
    wanted = tmp_path / "chars.txt"
    wanted.write_text("V\nV", encoding="utf-8")
    target = tmp_path / "atlas.ktx2"
    result = run("font", font, "--chars", "A", "--chars-file", wanted, "--range", "U+E0-FF", "-o", target)
    assert result.exit_code == 0, result.output
    assert result.stdout == (
        f"{target}: 3 characters, 4 shapes, {target.stat().st_size} bytes; {target.with_suffix('.json')}\n"
    )
    assert [*json.loads(target.with_suffix(".json").read_text(encoding="utf-8"))["glyphs"]] == ["A", "V", "é"]


def test_the_file_that_stands_in_for_the_regular_weight_is_named(tmp_path):
    for weight, style in ((300, "Light"), (700, "Bold")):
        content = made_font({"A": "left"}, weight=weight, style=style)
        (tmp_path / f"{style}.ttf").write_bytes(content)
    result = run("font", tmp_path, "--chars", "A", "-o", tmp_path / "a.ktx2", "--strict")
    assert result.exit_code == 0, result.output
    assert result.stderr == (
        f"vexture: warning: {tmp_path}: no face has weight 400, normal, so that Light.ttf is used "
        "(Made, weight 300, normal); choose another by --weight and --style, or give its file\n"
    )
    assert not run("font", tmp_path / "Bold.ttf", "--chars", "A", "-o", tmp_path / "a.ktx2").stderr


@pytest.mark.parametrize(
    ("arguments", "lost"),
    [
        (("text", "A", "--family", "No Such Font"), "simplified: font 'No Such Font' drawn in "),
        (("font", "FONT", "--chars", "Ax"), "left out: character 'x' (U+0078), which Made lacks"),
    ],
)
def test_strict_accepts_no_loss(font, tmp_path, arguments, lost):
    given = [font if argument == "FONT" else argument for argument in arguments]
    result = run(*given, "-o", tmp_path / "new.ktx2", "--strict")
    assert result.exit_code == 1
    assert lost in result.stderr
    assert "; --strict accepts no such note; correct the source, or leave it out" in result.stderr
    assert not [*tmp_path.iterdir()]
    assert run(*given, "-o", tmp_path / "new.ktx2").exit_code == 0
