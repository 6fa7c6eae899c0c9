"""Drawings of a source for an atlas: one of most, and one of each symbol of a sprite."""

import os
from threading import Thread

import pytest

from vexture.conversion.sprites import read_drawings

SYMBOL = '<symbol id="{}" viewBox="0 0 4 4"><path fill="{}" d="M0 0h{}v4h-{}z"/></symbol>'
SPRITE = f'<svg xmlns="http://www.w3.org/2000/svg">{SYMBOL.format("a", "red", 1, 1)}{SYMBOL.format("b", "blue", 3, 3)}'


def widths(drawings):
    return [(shown, drawing.name, float(drawing.paths[0].box[1, 0])) for shown, drawing in drawings]


@pytest.mark.parametrize("kind", ["bytes", "file", "pipe"])
def test_each_symbol_of_a_sprite_is_a_drawing(tmp_path, kind):
    content = f"{SPRITE}</svg>".encode()
    file = tmp_path / "icons.svg"
    if kind == "pipe":
        os.mkfifo(file)
        Thread(target=file.write_bytes, args=(content,), daemon=True).start()
    else:
        file.write_bytes(content)
    found = widths(read_drawings(content if kind == "bytes" else file, name="icons.svg"))
    assert found == [("icons.svg#a", "a", 0.25), ("icons.svg#b", "b", 0.75)]


@pytest.mark.filterwarnings("ignore::vexture.SourceWarning")
def test_a_drawing_that_paints_something_is_one_drawing_in_spite_of_its_symbols():
    shown = f'{SPRITE}<use href="#b" width="4" height="4"/></svg>'.encode()
    assert [name for name, _ in read_drawings(shown, name="shown.svg")] == ["shown.svg"]
    nothing = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"/>'
    ((name, drawing),) = read_drawings(nothing, name="nothing.svg")
    assert (name, drawing.paths) == ("nothing.svg", ())


def test_a_selected_symbol_is_one_drawing():
    assert widths(read_drawings(f"{SPRITE}</svg>".encode(), name="icons.svg", select="#b")) == [
        ("icons.svg", "icons", 0.75)
    ]
