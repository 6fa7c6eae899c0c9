"""The server of a flood answers as it says of itself in OpenAPI, to every client that this description allows."""

import pytest
from described import SLOW, check_answers
from floods import BOUNDS, flooding, sea

pytestmark = [*SLOW, pytest.mark.usefixtures("page_is_built")]


def test_each_answer_of_a_flood_is_one_that_the_description_allows(tmp_path):
    folder = tmp_path / "shapes"
    folder.mkdir()
    box = ",".join(map(str, BOUNDS))
    with flooding(folder, "--extent", sea(folder / "sea.geojson"), "--bounds", box) as server:
        check_answers(server.url, "flood", tmp_path, "examples,coverage,fuzzing,stateful", 300)
