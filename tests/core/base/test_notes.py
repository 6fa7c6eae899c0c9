"""Notes of a reader: counted, in one line, as data, as warnings and as errors."""

import pytest

from vexture.base.errors import SourceError, SourceWarning
from vexture.base.notes import Note, Notes, check_losses, line_of, warn_of


def test_notes_are_counted_and_come_by_kind():
    notes = Notes()
    notes.remark("it has 3 bands")
    notes.count("invalid", "width='x'")
    for message in ("<a>", "<b>", "<a>"):
        notes.left_out(message)
    notes.simplification("pattern")
    notes.missing_character("é")
    notes.missing_character("é")
    kinds = [(note.kind, note.message, note.count) for note in notes.in_order]
    boxes = "character 'é' (U+00E9), which no font has, drawn as a box"
    assert kinds == [
        ("left out", "<a>", 2),
        ("left out", "<b>", 1),
        ("simplified", "pattern", 1),
        ("simplified", boxes, 2),
        ("invalid", "width='x'", 1),
        ("remark", "it has 3 bands", 1),
    ]
    assert line_of("a.svg", notes.in_order) == (
        f"a.svg: left out: <a> (2), <b>; simplified: pattern, {boxes} (2); invalid and ignored: width='x'; "
        "it has 3 bands"
    )


def test_features_are_counted_once_and_the_first_are_named():
    notes = Notes()
    notes.features("left out", "feature", [7, "7", "a\nb"])
    notes.features("left out", "feature", "cdefg")
    assert str(notes.in_order[0]) == "feature (7: 7, a\ufffdb, c, d, e, ...)"


def test_a_line_names_eight_notes_of_a_kind():
    notes = [Note("left out", f"<{letter}>") for letter in "abcdefghij"]
    assert line_of("x", notes) == f"x: left out: {', '.join(f'<{letter}>' for letter in 'abcdefgh')}, and 2 more"
    assert line_of("x", []) == ""


def test_losses_are_errors_of_an_empty_drawing_and_of_strict():
    loss, remark = Note("left out", "<text>"), Note("remark", "it has 3 bands")
    check_losses("x", [loss], is_empty=False)
    check_losses("x", [remark], is_empty=True, strict=True)
    with pytest.raises(SourceError, match=r"^x: left out: <text>; nothing else is in it; correct it"):
        check_losses("x", [loss, remark], is_empty=True)
    with pytest.raises(SourceError, match=r"^x: left out: <text>; `strict` accepts no such note"):
        check_losses("x", [loss, remark], is_empty=False, strict=True)


def test_a_warning_is_that_of_the_caller():
    def public() -> None:
        warn_of("x", [Note("left out", "<text>")])

    with pytest.warns(SourceWarning, match="x: left out: <text>") as caught:
        public()
    assert caught[0].filename == __file__
