"""A drawing for each figure: three examples, and one in which nothing is painted."""

import pytest

from vexture_evidence.measures.shape import ConvertedDrawing, example

NOTHING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 2"/>'


@pytest.fixture(scope="module", params=["duck", "crossings", "hairline", "nothing"])
def shape(request, tmp_path_factory):
    if request.param != "nothing":
        return ConvertedDrawing(example(request.param))
    path = tmp_path_factory.mktemp("drawings") / "nothing.svg"
    path.write_text(NOTHING)
    return ConvertedDrawing(path)
