"""Names that strangers send."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vexture.base.errors import LimitError
from vexture.server.names import checked_name, manifest_name

HOSTILE = ["", ".", "..", "../x", "a//b", "/a", "a/", "a/../b", "a/.b", "a/ b", "a\\b", ".hidden", "a\0", "a\n", " a",
           "a ", "a" * 101, "é" * 51, "a\u202eb", "a\u2044b", "\uff0e\uff0e\uff0fx", "a\ud800", "a:b", "a%2fb", "a*",
           "ａ／ｂ"]  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_are_refused_in_one_line(name):
    with pytest.raises(LimitError) as refused:
        checked_name(name)
    assert str(refused.value).isprintable()


@given(st.text(max_size=120))
def test_every_allowed_name_is_one_file_in_its_folder(name):
    try:
        allowed = checked_name(name)
    except LimitError:
        return
    assert checked_name(allowed) == allowed
    assert len(allowed.encode()) <= 100
    assert not {"\\", "\0", ":"} & set(allowed)
    assert all(part and not part.startswith(".") for part in allowed.split("/"))
    assert os.path.basename(manifest_name(allowed)) == manifest_name(allowed)


def test_two_spellings_are_one_name():
    assert checked_name("Ko\u0308ln") == checked_name("K\u00f6ln") == "Köln"
