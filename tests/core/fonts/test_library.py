"""Which face a text gets: CSS Fonts 4, 5.2, and the order of the sources."""

import os
import sys

import pytest
from made import made_font

from vexture.base.errors import DeviceError, SourceError
from vexture.fonts import engine, library
from vexture.fonts.library import EmbeddedFont, Fonts


@pytest.fixture
def folder(tmp_path):
    for name, family, weight, chars in (
        ("a.ttf", "Harbour", 400, "AB"),
        ("b.ttf", "Harbour", 700, "AB"),
        ("c.ttf", "Quay", 400, "C"),
    ):
        (tmp_path / name).write_bytes(made_font(dict.fromkeys(chars, "square"), family=family, weight=weight))
    (tmp_path / "broken.ttf").write_bytes(b"\0\1\0\0")
    return tmp_path


def families(faces):
    return [(face.family, face.weight) for face in faces]


def test_faces_of_the_family_come_first_and_others_after_them(folder, monkeypatch):
    monkeypatch.setattr(library, "default_files", lambda: ())
    fonts = Fonts([folder], system=False)
    assert families(fonts.faces(["harbour"], 600)) == [("Harbour", 700), ("Quay", 400)]
    assert families(fonts.faces(["Nowhere", "Quay"], 400)) == [("Quay", 400), ("Harbour", 400)]


def test_default_font_comes_after_the_given_ones_and_stands_for_generic_families(folder, default_faces):
    found = families(Fonts([folder / "c.ttf"], system=False).faces(["Nowhere"], 700))
    assert found == [("Quay", 400), ("Noto Sans", 700)]
    (best, *_) = Fonts([folder / "c.ttf"], system=False).faces(["sans-serif"], 300, "italic", 75.0)
    assert (best.family, best.weight, best.style, best.stretch) == ("Noto Sans", 300, "italic", 75.0)


def test_font_of_a_drawing_has_the_name_and_style_of_its_rule(folder):
    content = (folder / "c.ttf").read_bytes()
    embedded = [EmbeddedFont("Own", content, weights=(600, 600)), EmbeddedFont("Own", content, style="italic")]
    fonts = Fonts(embedded=embedded, system=False)
    assert next(iter(fonts.faces(["own"], 700))).family == "Quay"
    bold, slanted = fonts._embedded
    assert (bold.traits.weights, slanted.traits.styles) == ((600, 600), ("italic",))
    assert "Quay" not in {face.family for face in fonts.faces(["Nowhere"])}  # it stands in for no other family


def test_a_given_file_that_is_no_font_is_named(folder):
    with pytest.raises(SourceError, match=r"broken.ttf: the font is damaged: it has no"):
        next(Fonts([folder / "broken.ttf"]).faces(["Harbour"]))
    os.mkfifo(folder / "pipe.ttf")
    for name in ("none.ttf", "pipe.ttf"):
        with pytest.raises(SourceError, match=rf"{name}: it is no file; give a font file or a folder"):
            next(Fonts([folder / name]).faces(["Harbour"]))


def test_a_font_that_is_there_as_woff2_is_not_read_as_woff_too(tmp_path):
    for name in ("a.woff", "a.woff2", "b.woff", "c.ttf"):
        (tmp_path / name).touch()
    assert [path.name for path in library.font_files(tmp_path)] == ["a.woff2", "b.woff", "c.ttf"]


def test_system_fonts_come_from_fontconfig_or_the_usual_folders(folder, monkeypatch):
    monkeypatch.setattr(
        library, "run_program", lambda *command: f"{folder / 'a.ttf'}\n{folder / 'a.ttf'}\n{folder / 'x.pcf'}\n"
    )
    assert library.system_files.__wrapped__() == (folder / "a.ttf",)
    monkeypatch.setattr(library, "run_program", lambda *command: "")
    monkeypatch.setattr(library, "LINUX", (str(folder), str(folder / "nowhere")))
    monkeypatch.setattr(library.sys, "platform", "linux")
    assert [path.name for path in library.system_files.__wrapped__()] == ["a.ttf", "b.ttf", "broken.ttf", "c.ttf"]


def test_without_uharfbuzz_the_remedy_is_named(folder, monkeypatch):
    monkeypatch.setitem(sys.modules, "uharfbuzz", None)
    engine.harfbuzz.cache_clear()
    try:
        with pytest.raises(DeviceError, match=r"pip install 'vexture\[text\]'"):
            next(Fonts([folder / "a.ttf"]).faces(["Harbour"]))
    finally:
        engine.harfbuzz.cache_clear()
