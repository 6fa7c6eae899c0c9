"""Every file of the corpora is read, or refused in one line; the names of those that once broke a reader say how."""

import pytest
from attempts import attempt
from javascript import NODE
from map_files import SEEDS
from readers import CORPUS, TARGETS

from vexture.base.errors import SourceError
from vexture.conversion.reading import read_drawing

FILES = [
    (name, file)
    for name in TARGETS
    if (CORPUS / name.removesuffix("-js")).is_dir() or name not in SEEDS
    for file in sorted((CORPUS / name.removesuffix("-js")).iterdir())
]


@pytest.mark.parametrize(("name", "file"), FILES, ids=lambda of: of if isinstance(of, str) else of.stem)
def test_a_file_is_read_or_refused_in_one_line(name, file):
    if name.endswith("-js") and not NODE:
        pytest.skip("node or the packages of web/ are missing")
    answer = attempt(TARGETS[name], file.read_bytes())
    assert answer.startswith("reads ") or file.stem.startswith("once-"), answer


@pytest.mark.parametrize("name", SEEDS)
def test_a_made_file_is_read(name):
    for content in SEEDS[name]():
        assert attempt(TARGETS[name], content).startswith("reads ")


def test_an_error_of_the_system_for_a_header_is_told_as_damage():
    """It said "Argument list too long: 'the file'"."""
    content = (CORPUS / "netcdf" / "once-a-system-error-for-a-header.nc").read_bytes()
    line = r"^tide\.nc: the NetCDF file is damaged \(its header says what cannot be\); write it again$"
    with pytest.raises(SourceError, match=line):
        read_drawing(content, name="tide.nc")
