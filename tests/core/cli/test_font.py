"""The command `font`: which characters it is asked to convert."""

import pytest

from vexture.base.errors import ParameterError
from vexture.cli.font import codes_of, read_text


@pytest.mark.parametrize("text", ["U+5A-41", "U+110000", "U+10FFFF-110000", "zz", "", "U+-41", "-"])
def test_what_is_no_range_is_named(text):
    with pytest.raises(ParameterError, match="is no range of characters; write one as U"):
        codes_of(text)


def test_ranges_are_written_in_several_ways():
    for text in ("U+0041-005A", "u+41-u+5a", "41-5A"):
        assert "".join(map(chr, codes_of(text))) == "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    assert len(codes_of("U+10FFFF")) == 1


def test_ends_of_lines_are_no_characters_of_a_text(tmp_path):
    file = tmp_path / "chars.txt"
    file.write_bytes(b"\xef\xbb\xbfa\r\nb \xc3\xa9\t")
    assert read_text(file) == "ab é"
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(ParameterError, match=r"chars\.txt: is no text in UTF-8"):
        read_text(file)
