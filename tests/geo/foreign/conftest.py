from itertools import count

import pytest
from outside import Outside

numbers = count()


@pytest.fixture(scope="module")
def outside(tmp_path_factory):
    found = Outside(tmp_path_factory.mktemp("foreign") / "outside")
    yield found
    found.close()


@pytest.fixture
def folder(outside):
    path = outside.folder.parent / f"given-{next(numbers)}"
    path.mkdir()
    return path
