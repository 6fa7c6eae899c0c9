"""Every file of the corpora is read, or refused in one line; the names of those that once broke a reader say how."""

import pytest
from attempts import attempt
from javascript import NODE
from readers import CORPUS, TARGETS

FILES = [(name, file) for name in TARGETS for file in sorted((CORPUS / name.removesuffix("-js")).iterdir())]


@pytest.mark.parametrize(("name", "file"), FILES, ids=lambda of: of if isinstance(of, str) else of.stem)
def test_a_file_is_read_or_refused_in_one_line(name, file):
    if name.endswith("-js") and not NODE:
        pytest.skip("node or the packages of web/ are missing")
    answer = attempt(TARGETS[name], file.read_bytes())
    assert answer.startswith("reads ") or file.stem.startswith("once-"), answer
