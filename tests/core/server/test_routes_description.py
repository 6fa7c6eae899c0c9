"""Servers answer as they say of themselves in OpenAPI, to every client that this description allows."""

from contextlib import contextmanager

import pytest
from described import SLOW, WHOLE, check_answers
from server import TOKEN, serving, square

from vexture.pages.page_routes import MOST_NAME_LENGTH
from vexture.server.limits import Limits
from vexture.server.names import MOST_BYTES
from vexture.server.routes import description, fixed_route
from viewing import viewing


@contextmanager
def served(command, folder):
    """URL of a server that shows a shape, and the shape's name."""
    folder.mkdir()
    (folder / "logo.svg").write_bytes(square())
    if command == "view":
        with viewing(folder, folder / "logo.svg") as server:
            yield server.url, "logo"
        return
    with serving(folder, "--rate", 10_000) as server:
        server.wait_for("logo")
        yield server.url, "logo"


def test_a_route_without_a_description_is_not_served():
    with pytest.raises(KeyError, match="/more"):
        description([fixed_route("/more", b"", "text/plain", {})], Limits())


def test_the_description_has_the_limits_of_names():
    (shape,) = WHOLE["paths"]["/shapes/{name}"]["parameters"]
    (dropped,) = WHOLE["paths"]["/convert"]["post"]["parameters"]
    assert [one["schema"]["maxLength"] for one in (shape, dropped)] == [MOST_BYTES, MOST_NAME_LENGTH]


@pytest.mark.slow
@pytest.mark.usefixtures("page_is_built")
@pytest.mark.parametrize(
    ("command", "phases", "examples"),
    [
        ("serve", "examples,coverage", 10),
        *(
            pytest.param(command, "examples,coverage,fuzzing,stateful", 300, marks=SLOW)
            for command in ("serve", "view")
        ),
    ],
)
def test_each_answer_is_one_that_the_description_allows(tmp_path, command, phases, examples):
    with served(command, tmp_path / "shapes") as (url, name):
        check_answers(url, name, tmp_path, phases, examples, token="" if command == "view" else TOKEN)
