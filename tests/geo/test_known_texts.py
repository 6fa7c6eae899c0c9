"""What small inputs and messages become."""

import click
import numpy as np
import pytest

from vexture.base.content import about, known_kind
from vexture.base.errors import SourceError
from vexture.base.machine_code import argument_type
from vexture.base.notes import Note, Subject
from vexture.cli.convert import convert
from vexture.cli.messages import as_options
from vexture.conversion.reading import read_drawing
from vexture_geo.cli.flood import flood


def test_an_empty_file_is_refused() -> None:
    with pytest.raises(SourceError, match=r"^is empty; give an SVG, GeoJSON, "):
        known_kind(b"")


def test_errors_begin_with_the_name_of_their_source() -> None:
    with pytest.raises(SourceError, match=r"^duck\.svg: it is empty$"), about("duck.svg"):
        raise SourceError("it is empty")


def test_what_is_left_out_is_noted() -> None:
    drawing = read_drawing(b'<svg viewBox="0 0 9 9"><foreignObject/><path d="M0 0h9v9z"/></svg>')
    (note,) = drawing.notes
    assert note == Note("left out", "<foreignObject>", 1, (Subject("<foreignObject> in line 1", None),))


def test_types_of_arguments_are_described() -> None:
    assert argument_type((2, 0.5, np.zeros((3, 4), np.int64))) == ["tuple", "int", "float", ["<i8", 2, True]]


def test_parameters_in_messages_become_options() -> None:
    message = as_options("2 quads; the limit is 1; use a smaller `max_depth`")
    assert message == "2 quads; the limit is 1; use a smaller --max-depth"


@pytest.mark.parametrize(("command", "option"), [(convert, "--variable of vexture flood"), (flood, "--variable")])
def test_messages_name_the_command_that_has_the_option(command: click.Command, option: str) -> None:
    with click.Context(command):
        assert as_options("choose one by `variable`") == f"choose one by {option}"
