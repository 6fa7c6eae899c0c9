"""The entry point of all sources: paths, bytes and open files, whose content decides how they are read."""

import gzip
import io
from types import SimpleNamespace

import pytest
from PIL import Image

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture.conversion.reading import content_of, drawing_of, name_of

HALF = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 2"><path d="M0 0h1v2h-1z"/></svg>'


@pytest.mark.parametrize("form", [bytes, bytearray, memoryview, io.BytesIO])
@pytest.mark.parametrize("pack", [bytes, gzip.compress])
def test_content_is_read_in_each_form(form, pack):
    drawing = vexture.read(form(pack(HALF)), name="half.svg")
    assert drawing.name == "half"
    assert drawing.paths[0].box.tolist() == [[0.0, 0.0], [0.5, 1.0]]


def test_a_path_names_the_drawing_and_its_suffix_decides_nothing(tmp_path):
    file = tmp_path / "half.png"
    file.write_bytes(HALF)
    for source in (file, str(file)):
        assert vexture.read(source).name == "half"
    with file.open("rb") as stream:
        assert vexture.read(stream).name == "half"


def test_names_in_messages():
    assert name_of("a/b.svg") == "a/b.svg"
    assert name_of("a/b.svg", "c.svg") == "c.svg"
    assert name_of(b"") == "drawing"
    assert name_of(SimpleNamespace(name="a.svg", read=None)) == "a.svg"
    assert name_of(SimpleNamespace(name=3, read=None)) == "drawing", "a pipe has a number"


@pytest.mark.parametrize(
    ("source", "error", "message"),
    [
        (io.StringIO("<svg/>"), TypeError, r"`source` is open in text mode; open it in binary mode"),
        (3, TypeError, r"`source` is of the type int; give a path, bytes or a file"),
        ("<svg> </svg>", ParameterError, r"`source` is no path, but a text: <svg> </svg> \.\.\.; use vexture\.read"),
        (' {"type": "Point"}', ParameterError, r"`source` is no path, but a text"),
    ],
)
def test_what_is_no_source_is_named(source, error, message):
    with pytest.raises(error, match=message):
        vexture.read(source)


def test_a_texture_is_no_drawing():
    texture = vexture.convert(vexture.read(HALF)).to_ktx2()
    with pytest.raises(SourceError, match=r"^a\.svg: is a texture already; give the drawing that it was made from$"):
        vexture.read(texture, name="a.svg")


def test_pictures_are_drawn_or_traced_and_take_no_parameters_of_others():
    file = io.BytesIO()
    picture = Image.new("L", (32, 32), 255)
    picture.paste(0, (8, 8, 24, 16))
    picture.save(file, "PNG")
    traced = vexture.read(file.getvalue(), name="box.svg", images="trace")
    assert traced.paths[0].box.ravel() == pytest.approx([0.25, 0.5, 0.75, 0.75], abs=0.02)
    (whole,) = vexture.read(file.getvalue(), name="box.svg").paths
    assert (whole.box.ravel().tolist(), whole.paint.picture.color_at(0.5, 0.6)[0]) == ([0.0, 0.0, 1.0, 1.0], 0.0)
    with pytest.raises(ParameterError, match="`select`"):
        vexture.read(file.getvalue(), select="#a")


def test_parameters_of_a_reader_are_for_what_is_not_read_yet():
    drawing = vexture.read(HALF)
    assert drawing_of(drawing, {}) is drawing
    with pytest.raises(ParameterError, match=r"`select` is '#a', but drawing is a drawing, which is read already"):
        drawing_of(drawing, {"select": "#a"})
    with pytest.raises(TypeError, match="`source` is of the type bytes; give a path or a Drawing"):
        drawing_of(HALF, {})


def test_content_of_a_file_is_that_of_the_file(tmp_path):
    file = tmp_path / "half.svg"
    file.write_bytes(HALF)
    assert content_of(file) == HALF
    with pytest.raises(SourceError, match=r"missing\.svg: "):
        content_of(tmp_path / "missing.svg")
