"""The command line on shapes: colours, parts of drawings, atlases."""

import json
import os
import re

import numpy as np
import pytest
from PIL import Image
from test_cli import SQUARE, SVG, run

import vexture
from needed import NEEDS_GEO
from vexture.base.layout import MAP_HEAD

LOGO = SVG.format(
    '<rect width="10" height="10" fill="#00f"/><path id="word" d="M2 2h6v4h-6z" fill="white"/>'
    '<path d="M2 5h6v4h-6z" fill="red" fill-opacity="0.5"/>'
)
STAR = SVG.format('<path d="M5 0 2 9 9 3 1 3 8 9z"/><circle cx="5" cy="5" r="3"/>')

CPU = ("--renderer", "cpu")


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


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


@NEEDS_GEO
def test_polygons_are_named_by_a_property_and_snapped(tmp_path):
    rings = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[1.000001, 0], [2, 0], [2, 1], [1.000001, 1]]]
    features = [
        {"type": "Feature", "properties": {"code": f"c{k}"}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
        for k, ring in enumerate(rings)
    ]
    source, target = tmp_path / "two.geojson", tmp_path / "two.ktx2"
    source.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    arguments = ("convert", source, "-o", target, "--split", "faces", "--restyle", "--names", "code")
    result = run(*arguments)
    assert "2 corners snapped to borders beside them" in result.stderr
    assert vexture.load(target).element_at([(0.2, 0.5), (0.8, 0.5), (0.5, 0.1)]).name.tolist() == ["c0", "c1", ""]
    assert "snapped" not in run(*arguments, "--snap", 0).stderr


def test_output_may_name_the_file_of_one_drawing(square, tmp_path):
    target = tmp_path / "new" / "box.ktx2"
    assert run("convert", square, "-o", target).exit_code == 0
    assert [file.name for file in target.parent.iterdir()] == ["box.ktx2"]
    result = run("convert", square, square, "-o", target)
    assert result.exit_code == 1
    assert "one file for 2 drawings; use --atlas" in result.stderr


def test_files_for_servers_that_compress(square, tmp_path):
    for place in (("-o", tmp_path / "square.ktx2"), ("--atlas", tmp_path / "all.ktx2")):
        assert run("convert", square, *place).exit_code == 0
        deflated = place[1].read_bytes()
        assert run("convert", square, *place, "--no-deflate").exit_code == 0
        texture = vexture.load(place[1])
        assert texture.texels.tobytes() == place[1].read_bytes()[-texture.nbytes :]
        assert texture.to_ktx2() == deflated
        assert texture.to_ktx2(deflate=False) == place[1].read_bytes()
    result = run("convert", square, "-o", tmp_path, "--encoding", "thesis", "--no-deflate")
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert "--no-deflate means nothing" in result.stderr


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
    assert texture.roots[1].is_map
    assert (texture.roots[1].quad - MAP_HEAD) * 16 == sizes[0]  # its head comes before it
    assert sum(sizes) <= texture.nbytes
    assert run("convert", square, logo, "--atlas", target, "--split", "paint").exit_code == 0
    names = [root.name for root in vexture.load(target).roots]
    assert names == ["square/1-#000000", "logo/1-#0000ff", "logo/2-#ffffff", "logo/3-#ff000080"]


def test_a_silhouette_has_no_colours(tmp_path):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    assert run("convert", logo, "-o", tmp_path).exit_code == 0
    assert vexture.load(tmp_path / "logo.ktx2").roots[0].is_map
    assert run("convert", logo, "-o", tmp_path, "--silhouette").exit_code == 0
    plain = vexture.load(tmp_path / "logo.ktx2")
    np.testing.assert_array_equal(plain.texels, vexture.convert(logo, split=None).texels)


def test_an_atlas_is_whole_or_not_written(square, tmp_path):
    bad = tmp_path / "bad.svg"
    bad.write_text("not xml")
    target = tmp_path / "all.ktx2"
    result = run("convert", bad, square, tmp_path / "gone.svg", "--atlas", target)
    assert result.exit_code == 1
    assert f"{bad}: holds nothing that can be read" in result.output
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
        (("--bits", "8"), "--bits 8 means nothing to the encoding packed; leave it out or use --encoding thesis"),
        (("--strategy", "sampled"), "use --encoding thesis"),
        (("--encoding", "thesis", "--split", "paint"), "use --encoding packed"),
        (("--silhouette", "--split", "faces"), "--split faces and --silhouette exclude each other; leave one out"),
        (("--encoding", "thesis", "--capacity", "4"), "use --encoding packed"),
        (("--encoding", "thesis", "--precision", "1e-3"), "use --encoding packed"),
        (("--encoding", "thesis", "--atlas", "all.ktx2"), "use the encoding packed"),
        (("-o", "out.png"), "--output out.png: the encoding packed writes no such file; name FILE.ktx2 or a folder"),
        (("--encoding", "thesis", "-o", "t.ktx2"), "writes no such file; name a folder"),
        (("-", "-", "-o", "out"), "give - once"),
        (("--atlas", "all.png"), "ends in .ktx2"),
        (("--atlas", "out"), "ends in .ktx2"),
        (("--atlas", "folder.ktx2"), "name one"),
        (("--atlas", "all.ktx2", "-o", "out"), "leave --output out"),
        (("--atlas", "square.svg/all.ktx2"), "choose another place"),
        (("--capacity", "0"), "1..15"),
        (("--capacity", "16"), "1..15"),
        (("--precision", "nan"), "--precision nan"),
        (("--max-depth", "21"), "1..20"),
        (("--tolerance", "-1"), "--tolerance -1.0 is no number from 0 to below 1"),
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


def drawn(folder, *arguments):
    """Picture that a renderer other than the GPU draws."""
    picture = folder / "picture.png"
    result = run("render", *arguments, "-o", picture, "--size", 20)
    assert (result.exit_code, result.output) == (0, "")
    with Image.open(picture) as image:
        return np.asarray(image).astype(int)


def test_render_of_colours_and_parts_of_a_drawing(tmp_path):
    logo = tmp_path / "logo.svg"
    logo.write_text(LOGO)
    colours = drawn(tmp_path, logo, "--renderer", "exact")
    assert colours.shape == (20, 20, 3)
    assert colours[10, 1].tolist() == [0, 0, 255]
    assert colours[8, 6].tolist() == [255, 255, 255]
    assert colours[12, 14].tolist() == [128, 0, 128]
    assert colours[10, 6].tolist() == [255, 128, 128]
    part = drawn(tmp_path, logo, "--select", "#word", "--renderer", "exact", "--silhouette")
    assert part.shape == (20, 20, 3)
    assert part.min() == part[8, 6].max() == 0
    assert part[10, 1].tolist() == [255, 255, 255]


def test_render_of_an_atlas(square, tmp_path):
    logo, atlas = tmp_path / "logo.svg", tmp_path / "all.ktx2"
    logo.write_text(LOGO)
    run("convert", square, logo, "--atlas", atlas, "--split", "paint")
    colours = drawn(tmp_path, logo, "--renderer", "exact")
    assert np.abs(drawn(tmp_path, atlas, *CPU, "--root", "logo") - colours).max() <= 3
    word = drawn(tmp_path, logo, "--select", "#word", "--renderer", "exact", "--silhouette")
    for root in ("logo/2-#ffffff", "2"):
        assert np.abs(drawn(tmp_path, atlas, *CPU, "--root", root, "--silhouette") - word).max() <= 3
        white = drawn(tmp_path, atlas, *CPU, "--root", root, "--background", "black")
        assert np.abs(white - (255 - word)).max() <= 3
    run("convert", logo, "-o", tmp_path, "--split", "paint")
    assert np.abs(drawn(tmp_path, tmp_path / "logo.ktx2", *CPU) - colours).max() <= 3
    run("convert", square, "-o", tmp_path)
    assert (
        np.abs(drawn(tmp_path, tmp_path / "square", *CPU) - drawn(tmp_path, square, "--renderer", "exact")).max() <= 3
    )


@pytest.mark.parametrize(
    ("shown", "arguments", "says"),
    [
        ("all.ktx2", (), "2 drawings (square, logo); choose one by --root"),
        ("all.ktx2", ("--root", "square/1-#00000"), "near names are 'square/1-#000000'"),
        ("all.ktx2", ("--root", "nope"), "no shape 'nope'; there are 'square/1-#000000'"),
        ("all.ktx2", ("--root", "7"), "7"),
        ("all.ktx2", ("--select", "#word"), "--select #word is for a drawing; give it to vexture convert"),
        ("all.ktx2", ("--root", "logo", "--renderer", "exact"), "renders drawings"),
        ("logo.svg", ("--root", "logo"), "leave it out"),
        ("logo.svg", ("--select", "#wrod"), "matches no element"),
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


def test_pictures_replace_nothing_but_pictures(square, tmp_path):
    for target, words in ((square, "pictures are PNG files"), (tmp_path / "x.jpg", "pictures are PNG files")):
        result = run("render", square, "-o", target, "--renderer", "exact", "--size", 8)
        assert result.exit_code == 1
        assert words in result.stderr
    assert square.read_text().lstrip().startswith("<svg")
    pipe = tmp_path / "pipe.png"
    os.mkfifo(pipe)
    for command in (
        ("render", square, "--renderer", "exact", "-o", pipe),
        ("convert", square, "-o", tmp_path / "p.ktx2"),
    ):
        if command[0] == "convert":
            pipe.rename(tmp_path / "p.ktx2")
        result = run(*command)
        assert result.exit_code == 1
        assert "not a regular file" in result.stderr
    assert (tmp_path / "p.ktx2").is_fifo()


def test_a_link_stays_one(square, tmp_path):
    file, link = tmp_path / "file.png", tmp_path / "link.png"
    file.write_bytes(b"old")
    link.symlink_to(file)
    assert run("render", square, "-o", link, "--renderer", "exact", "--size", 8).exit_code == 0
    assert link.is_symlink()
    assert file.read_bytes().startswith(b"\x89PNG")


def test_names_keep_their_dots(square, tmp_path):
    for version in "ab":
        (tmp_path / f"logo.{version}.svg").write_text(square.read_text())
    assert run("convert", tmp_path / "logo.a.svg", tmp_path / "logo.b.svg", "-o", tmp_path).exit_code == 0
    assert {file.name for file in tmp_path.glob("*.ktx2")} == {"logo.a.ktx2", "logo.b.ktx2"}
