"""Fonts as parameters give them."""

from pathlib import Path

import pytest

from vexture.base.errors import ParameterError, SourceError
from vexture.fonts.places import font_places


def test_one_path_or_several_become_paths_in_their_order(tmp_path):
    file = tmp_path / "a.ttf"
    file.touch()
    assert font_places(str(file), "font") == (file,)
    assert font_places(file, "font") == (file,)
    assert font_places([str(file), tmp_path], "fonts") == (file, tmp_path)
    assert font_places((), "fonts") == ()


@pytest.mark.parametrize("value", [3, None, b"a.ttf", [Path("a.ttf"), 3], {"a.ttf": 1}])
def test_what_is_no_path_is_named_with_its_parameter(value):
    with pytest.raises(ParameterError, match=r"^`fonts` is .*; it must be paths of font files or folders of fonts$"):
        font_places(value, "fonts")


def test_each_path_must_lead_somewhere(tmp_path):
    with pytest.raises(SourceError, match=r"b\.ttf: it is no file; give a font file or a folder of fonts"):
        font_places([tmp_path, tmp_path / "b.ttf"], "fonts")
