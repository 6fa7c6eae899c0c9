"""Sources of `convert` that hold several drawings: folders, and sprites in an atlas."""

import gzip

import pytest
from click.testing import CliRunner

import vexture
from needed import NEEDS_GEO
from vexture.cli.main import main

SQUARE = '<path d="M0 0h{0}v{0}h-{0}z"/>'
SPRITE = "<svg xmlns='http://www.w3.org/2000/svg'><defs>{}</defs></svg>".format(
    "".join(f'<symbol id="icon-{k}" viewBox="0 0 8 8">{SQUARE.format(k)}</symbol>' for k in (4, 6))
)


def run(*arguments):
    return CliRunner().invoke(main, [*map(str, arguments)])


def names(file):
    return [root.name for root in vexture.load(file).roots]


@pytest.fixture
def folder(tmp_path):
    icons = tmp_path / "icons"
    icons.mkdir()
    drawing = f'<svg viewBox="0 0 8 8">{SQUARE.format(5)}</svg>'
    (icons / "b.svg").write_text(drawing)
    (icons / "a.svgz").write_bytes(gzip.compress(drawing.encode()))
    (icons / "._a.svg").write_bytes(b"\0\5\26\7")
    (icons / "README.md").write_text("icons")
    (icons / "more.svg").mkdir()
    return icons


def test_a_folder_stands_for_the_svgs_in_it(folder, tmp_path):
    result = run("convert", folder, "--atlas", tmp_path / "all.ktx2")
    assert result.exit_code == 0, result.stderr
    assert names(tmp_path / "all.ktx2") == ["a", "b"]
    assert run("convert", folder, "-o", tmp_path / "out").exit_code == 0
    assert sorted(file.name for file in (tmp_path / "out").iterdir()) == ["a.ktx2", "b.ktx2"]


def test_a_folder_without_svgs_is_refused(tmp_path):
    (tmp_path / "empty").mkdir()
    result = run("convert", tmp_path / "empty")
    assert result.exit_code == 1
    assert result.stderr == (
        f"vexture: {tmp_path / 'empty'}: the folder holds no SVG file; name a folder that does, or files\n"
    )


@pytest.mark.parametrize("command", ["render", pytest.param("map", marks=NEEDS_GEO)])
def test_other_commands_say_that_a_folder_is_one(folder, tmp_path, command):
    result = run(command, folder, "-o", tmp_path / {"render": "a.png", "map": "a.ktx2"}[command])
    assert result.exit_code == 1
    assert result.stderr.startswith(f"vexture: {folder}: is a folder")
    assert "name a file in it" in result.stderr
    with pytest.raises(vexture.SourceError, match="is a folder, and no FileGDB; name a file in it"):
        vexture.convert(folder)


def test_each_symbol_of_a_sprite_is_a_shape_of_an_atlas(folder, tmp_path):
    sprite, target = tmp_path / "sprite.svg", tmp_path / "all.ktx2"
    sprite.write_text(SPRITE)
    result = run("convert", sprite, folder, "--atlas", target)
    assert result.exit_code == 0, result.stderr
    assert names(target) == ["icon-4", "icon-6", "a", "b"]
    texture = vexture.load(target)
    assert texture.coverage(8, root="icon-4").mean() == pytest.approx(0.25, abs=1e-4)
    assert (texture.texels == vexture.atlas([sprite, folder / "a.svgz", folder / "b.svg"]).texels).all()


def test_a_sprite_goes_into_an_atlas_through_a_pipe():
    result = CliRunner().invoke(main, ["convert", "-", "--atlas", "-", "-q"], input=SPRITE.encode())
    assert result.exit_code == 0, result.stderr
    assert result.stdout_bytes.startswith(b"\xabKTX 20")


def test_symbols_of_one_name_in_two_files_are_refused(tmp_path):
    for name in ("one.svg", "two.svg"):
        (tmp_path / name).write_text(SPRITE)
    result = run("convert", tmp_path / "one.svg", tmp_path / "two.svg", "--atlas", tmp_path / "all.ktx2")
    assert result.exit_code == 1
    assert f"has a shape 'icon-4' already, from {tmp_path / 'one.svg'}#icon-4" in result.stderr


def test_a_chosen_symbol_is_one_shape(tmp_path):
    (tmp_path / "sprite.svg").write_text(SPRITE)
    assert (
        run("convert", tmp_path / "sprite.svg", "--select", "#icon-6", "--atlas", tmp_path / "one.ktx2").exit_code == 0
    )
    assert names(tmp_path / "one.ktx2") == ["sprite"]


@pytest.mark.parametrize("command", ["convert", "render"])
def test_a_sprite_is_refused_where_it_would_be_empty(tmp_path, command):
    source, target = tmp_path / "sprite.svg", tmp_path / {"convert": "a.ktx2", "render": "a.png"}[command]
    source.write_text(SPRITE)
    result = run(command, source, "-o", target)
    assert (result.exit_code, target.exists()) == (1, False)
    assert result.stderr == (
        f"vexture: {source}: left out: 2 symbols: '#icon-4', '#icon-6' (choose one by --select, or make an atlas "
        "of all, as `vexture convert --atlas` does); nothing else is in it\n"
    )
