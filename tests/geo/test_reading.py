"""One gate: the content of a file says what it is, whatever way it comes and whatever it is called."""

import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from kinds import SVG, one_of_each

import vexture
from vexture.base.content import SHAPEFILE
from vexture.base.errors import ParameterError, SourceError, SourceWarning
from vexture.base.notes import Note, Subject, line_of
from vexture.cli.convert import convert
from vexture.cli.main import main
from vexture.cli.messages import as_options
from vexture.conversion.reading import content_of, read_drawing
from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Picture

NOTED = {
    "packed.svgz": (Note("left out", "<foreignObject>", 1, (Subject("<foreignObject> in line 1", None),)),),
    "plain.svg": (Note("left out", "<foreignObject>", 1, (Subject("<foreignObject> in line 1", None),)),),
    "raster.tif": (
        Note(
            "remark",
            "it has 2 bands, of which the first is read; `variable` chooses another, `time_dim` makes them times",
        ),
    ),
    "rings.geojson": (Note("left out", "Point"),),
    "series.nc": (Note("remark", "it has 2 times, of which the first is read; vexture flood shows all"),),
}
"""What is noted of them; nothing of the others."""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[Path]]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what writes them
        yield one_of_each(tmp_path_factory.mktemp("kinds"))


def assert_same(one: Drawing, other: Drawing) -> None:
    assert one.name == other.name
    assert one.crs == other.crs
    assert one.notes == other.notes
    np.testing.assert_array_equal(one.to_source, other.to_source)
    assert len(one.paths) == len(other.paths)
    for path, twin in zip(one.paths, other.paths, strict=True):
        assert path.fill_rule == twin.fill_rule
        assert replace(path.paint, picture=None) == replace(twin.paint, picture=None)
        assert_same_pixels(path.paint.picture, twin.paint.picture)
        assert len(path.contours) == len(twin.contours)
        for contour, again in zip(path.contours, twin.contours, strict=True):
            np.testing.assert_array_equal(contour, again)


def assert_same_pixels(one: Picture | None, other: Picture | None) -> None:
    assert (one is None) == (other is None)
    if one is not None and other is not None:
        assert (one.to_pixels, one.sampling, one.opacity) == (other.to_pixels, other.sampling, other.opacity)
        np.testing.assert_array_equal(one.pixels, other.pixels)


def test_path_bytes_and_open_file_give_one_drawing(files: list[Path]) -> None:
    assert len(files) == 14
    for path in files:
        drawing = read_drawing(path)
        assert drawing.paths, path
        assert drawing.name == path.stem
        assert drawing.notes == NOTED.get(path.name, ()), path
        assert_same(drawing, read_drawing(content_of(path), name=str(path)))
        assert_same(drawing, read_drawing(BytesIO(content_of(path)), name=path.name))
        if path.suffix != ".shp":  # which needs the files beside it
            with path.open("rb") as file:
                assert_same(drawing, read_drawing(file))


def test_a_misleading_name_misleads_nobody(files: list[Path], tmp_path: Path) -> None:
    for path in files:
        for suffix in (".svg", ".geojson", ".nc", ".gpkg", ".png", ".ktx2", ""):
            renamed = tmp_path / f"{path.stem}{suffix}"
            renamed.write_bytes(content_of(path))
            assert_same(read_drawing(path), read_drawing(renamed))


def test_python_is_warned_once_of_all_notes(files: list[Path]) -> None:
    for path in files:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            drawing = vexture.read(path)
            vexture.convert(path)
        line = line_of(str(path), drawing.notes)
        assert [(warning.category, str(warning.message)) for warning in caught] == 2 * [(SourceWarning, line)] * bool(
            line
        )
        assert {warning.filename for warning in caught} <= {__file__}


def test_commands_take_every_file_and_say_what_was_noted(files: list[Path], tmp_path: Path) -> None:
    result = CliRunner().invoke(main, ["convert", *map(str, files), "--output", str(tmp_path)])
    assert result.exit_code == 0, result.output
    said = [line for line in result.output.splitlines() if "warning" in line]
    lines = [line_of(str(path), read_drawing(path).notes) for path in files if path.name in NOTED]
    with click.Context(convert):
        assert said == [f"vexture: warning: {as_options(line)}" for line in lines]
    for path in files:
        (root,) = vexture.load(tmp_path / f"{path.stem}.ktx2").roots
        np.testing.assert_array_equal(root.to_source, read_drawing(path).to_source)


def test_notes_stay_with_layers_and_what_is_made_of_a_drawing(files: list[Path]) -> None:
    drawing = read_drawing(SVG)
    assert [layer.notes for layer in drawing.layers()] == [drawing.notes]


@pytest.mark.parametrize("entry", ["path", "bytes"])
def test_a_texture_is_no_drawing(entry: str, tmp_path: Path) -> None:
    texture = vexture.convert(Drawing.polygon([(0, 0), (1, 0), (0, 1)])).save(tmp_path / "a.ktx2")
    renamed = tmp_path / "a.svg"
    renamed.write_bytes(texture.read_bytes())
    source = renamed if entry == "path" else renamed.read_bytes()
    with pytest.raises(SourceError, match="is a texture already; give the drawing that it was made from"):
        vexture.read(source)
    result = CliRunner().invoke(main, ["fold", str(renamed), "-o", str(tmp_path / "b.fold.ktx2")])
    assert result.exit_code == 1
    assert result.output == f"vexture: {renamed}: is a texture already; give the drawing that it was made from\n"


def test_a_selector_is_for_svg(files: list[Path]) -> None:
    for path in files:
        if path.suffix not in (".svg", ".svgz"):
            with pytest.raises(ParameterError, match="`select` 'path' chooses elements of an SVG; leave it out"):
                vexture.read(path, select="path")


def test_a_lonely_shapefile_says_what_it_needs(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"a shapefile is several files; give them together as a \.zip"):
        vexture.read(SHAPEFILE + bytes(96), name="lake.shp")


def test_what_is_nothing_is_named_by_its_source(tmp_path: Path) -> None:
    for name, why in (
        ("a.nc", "none of GeoTIFF, NetCDF, GRIB and grids of Esri"),
        ("a.geojson", "not JSON"),
        ("a.txt", "holds nothing that can be read"),
    ):
        path = tmp_path / name
        path.write_bytes(b"hello")
        for source in (path, path.read_bytes()):
            with pytest.raises(SourceError, match=why) as caught:
                vexture.read(source, name=str(path))
            assert str(caught.value).startswith(f"{path}: ")


TEXT = SVG.decode()


@pytest.mark.parametrize("buffer", [bytearray, memoryview])
def test_buffers_are_read_as_bytes(buffer: type) -> None:
    assert_same(read_drawing(buffer(TEXT.encode())), read_drawing(TEXT.encode()))


KITE = Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])


@pytest.mark.parametrize(
    ("function", "source", "says"),
    [
        (vexture.read, None, "NoneType; give a path, bytes or a file that is open in binary mode"),
        (vexture.read, 5, "`source` is of the type int; give a path"),
        (vexture.read, np.zeros(3), "`source` is of the type ndarray; give a path"),
        (vexture.read, KITE, "`source` is of the type Drawing; give a path"),
        (vexture.read, StringIO(TEXT), "`source` is open in text mode; open it in binary mode"),
        (vexture.convert, b"<svg/>", "bytes; give a path or a Drawing, which vexture.read makes of bytes and files"),
        (vexture.convert, ["a.svg"], "`source` is of the type list; give a path or a Drawing"),
        (vexture.convert, BytesIO(b"<svg/>"), "`source` is of the type BytesIO; give a path or a Drawing"),
        (vexture.atlas, [1], "`source` is of the type int; give a path or a Drawing"),
        (vexture.atlas, 1, "`source` is of the type int; give a path or a Drawing"),
        (vexture.atlas, b"<svg/>", "`source` is of the type bytes; give a path or a Drawing"),
        (vexture.load, None, "`path` is of the type NoneType; give the path of a texture's file"),
        (vexture.load, b"\xabKTX", "`path` is of the type bytes; give the path of a texture's file"),
    ],
)
def test_a_source_of_another_type_is_refused(function: Callable[[Any], Any], source: object, says: str) -> None:
    with pytest.raises(TypeError, match=says) as caught:
        function(source)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("function", [vexture.read, vexture.convert])
@pytest.mark.parametrize(
    "text", ['<svg width="9">\n<path d="M0 0h2v1h-2z"/>\n</svg>' + 200 * " ", '\n{"type":\n"Polygon"}']
)
def test_a_text_in_place_of_a_path_is_refused(function: Callable[[Any], Any], text: str) -> None:
    with pytest.raises(
        ParameterError, match=r"`source` is no path, but a text.*; use vexture\.read\(text\.encode\(\)\)"
    ) as caught:
        function(text)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"fonts": None}, "`fonts` is None; it must be paths of font files or folders of fonts"),
        ({"fonts": [3]}, "`fonts` is [3]; it must be paths of font files or folders of fonts"),
        ({"fonts": [b"abc"]}, "`fonts` is [b'abc']; it must be paths of font files or folders of fonts"),
        ({"fonts": "no.ttf"}, "no.ttf: it is no file; give a font file or a folder of fonts"),
        ({"images": "yes"}, "`images` is 'yes'; it must be 'draw', 'trace', 'none'"),
        ({"select": 5}, "`select` is 5; it must be text"),
        ({"names": 5}, "`names` is 5; it must be text"),
    ],
    ids=str,
)
def test_parameters_of_a_wrong_type_are_named_though_nothing_needs_them(parameters: dict[str, Any], said: str) -> None:
    with pytest.raises((ParameterError, SourceError)) as caught:
        vexture.read(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', name="a.svg", **parameters)
    assert str(caught.value).removeprefix("a.svg: ") == said
