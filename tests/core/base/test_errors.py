"""Errors are one line for the user, whatever the text they are made of."""

import pytest

from vexture.base.errors import EXPECTED, ParameterError, SourceError, VextureError, reason_of, shorten_text


@pytest.mark.parametrize("kind", [SourceError, ParameterError])
def test_no_message_ends_a_line_or_controls_a_terminal(kind):
    message = str(kind("a\nb\x1b[2J\u202ec"))
    assert message == "a\ufffdb\ufffd[2J\ufffdc"
    assert isinstance(kind(), EXPECTED)


def test_a_wrong_argument_is_a_value_error_and_no_fault_of_a_file():
    assert issubclass(ParameterError, ValueError)
    assert not issubclass(ParameterError, VextureError)


@pytest.mark.parametrize("length", range(12))
def test_a_shortened_text_has_its_length_at_most(length):
    text = "abcdefghijkl"[:length]
    short = shorten_text(text, 8)
    assert len(short) == min(length, 8)
    assert short == text if length <= 8 else short.endswith("...") and text.startswith(short[:-3])


def test_reason_is_one_line_without_the_name_of_a_temporary_file():
    assert reason_of(OSError("cannot  open\n/tmp/x1: gone"), hidden="/tmp/x1") == "cannot open the file: gone"
    assert reason_of(ZeroDivisionError()) == "ZeroDivisionError"
    assert len(reason_of(ValueError("x" * 1000))) == 120
