"""Style sheets beyond what pictures show: hostile ones, and what is named."""

from pathlib import Path

from styled_squares import SQUARE, colors, read_quietly


def test_nested_rules_that_multiply_are_named(tmp_path: Path) -> None:
    style = "<style>path" + " { &amp; + &amp;" * 40 + " { fill: red }" + " }" * 40 + "</style>"
    drawing = read_quietly(tmp_path, style + SQUARE)
    assert [str(note) for note in drawing.notes] == ["CSS selector '& + &', which cannot be read"]


def test_a_shorthand_that_is_not_valid_is_named(tmp_path: Path) -> None:
    drawing = read_quietly(tmp_path, SQUARE.replace("/>", ' style="font: red; fill: blue"/>'))
    assert [str(note) for note in drawing.notes] == ["font='red' of <path id=\"p\"> in line 1"]
    assert colors(drawing) == [(0, 0, 1)]


def test_long_lists_of_selectors_are_read(tmp_path: Path) -> None:
    style = f"<style>{','.join(f'.cls-{n}' for n in range(5_000))},path {{ fill: blue }}</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE)) == [(0, 0, 1)]
