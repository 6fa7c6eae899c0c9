"""Encodings that are registered by name."""

from pathlib import Path

import pytest

from vexture.base.errors import ParameterError
from vexture.texture.registry import REGISTERED, find_encoding, owner_of


@pytest.mark.parametrize("name", REGISTERED)
def test_an_encoding_owns_the_files_that_it_writes(name: str) -> None:
    encoding = find_encoding(name)
    assert encoding.SUFFIXES
    for suffix in encoding.SUFFIXES:
        assert owner_of(Path(f"maps/delft{suffix}")) == name


def test_other_files_and_names_belong_to_none() -> None:
    for file in ("delft.png", "delft.svg", "delft.ktx2"):
        assert owner_of(Path(file)) is None
    with pytest.raises(ParameterError, match="`encoding` is 'gif'; it must be 'packed' or 'thesis'"):
        find_encoding("gif")
