"""What a C library prints is hidden within the context, and only there."""

import os

import pytest

from vexture_geo.base.quiet_output import OUT, quiet_output


def test_the_standard_output_is_hidden_within_and_back_afterwards(capfd):
    os.write(OUT, b"before ")
    with quiet_output():
        os.write(OUT, b"hidden ")
    os.write(OUT, b"after")
    assert capfd.readouterr().out == "before after"


def test_it_is_back_after_an_error_too(capfd):
    with pytest.raises(ZeroDivisionError), quiet_output():
        os.write(OUT, b"%d" % (1 // int("0")))
    os.write(OUT, b"after")
    with quiet_output():  # nobody holds it any more
        os.write(OUT, b"hidden")
    assert capfd.readouterr().out == "after"
