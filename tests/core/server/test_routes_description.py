"""Servers answer as they say of themselves in OpenAPI, to every client that this description allows."""

import subprocess
import sys
from contextlib import contextmanager

import httpx
import pytest
from described import WHOLE
from floods import BOUNDS, flooding, sea
from server import TOKEN, serving, square

from vexture.pages.page_routes import MOST_NAME_LENGTH
from vexture.server.limits import Limits
from vexture.server.names import MOST_BYTES
from vexture.server.routes import description, fixed_route
from viewing import viewing

PROGRAM = [sys.executable, "-c", "from schemathesis.cli import schemathesis; schemathesis()", "--no-color"]
ASKING = [
    *("--exclude-path", "/events"),
    *("--exclude-checks", "positive_data_acceptance"),
    *("--request-timeout", "120"),
    "--generation-deterministic",
]
"""The stream of events never ends, and no schema says which contents can be converted."""

SLOW = [pytest.mark.slow, pytest.mark.timeout(3600)]
"""Of thousands of requests, some of them conversions: on two busy cores they take more than ten minutes."""

PINNED = """
[[operations]]
include-path = "/files/{{name}}"
parameters."path.name" = "{file}"
[[operations]]
include-path = "/views/{{version}}/{{name}}"
parameters."path.version" = "{version}"
"""
"""Digests, which a client cannot guess."""


@contextmanager
def served(command, folder):
    """URL of a server that shows a shape, and the shape's name."""
    folder.mkdir()
    if command == "flood":
        box = ",".join(map(str, BOUNDS))
        with flooding(folder, "--extent", sea(folder / "sea.geojson"), "--bounds", box) as server:
            yield server.url, "flood"
        return
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
            for command in ("serve", "view", "flood")
        ),
    ],
)
def test_each_answer_is_one_that_the_description_allows(tmp_path, command, phases, examples):
    with served(command, tmp_path / "shapes") as (url, name):
        manifest = httpx.get(f"{url}shapes/{name}").json()
        pinned = PINNED.format(file=manifest["texture"].rpartition("/")[2], version=manifest["version"])
        (tmp_path / "schemathesis.toml").write_text(pinned)
        asked = ["run", f"{url}openapi.json", *ASKING, "--phases", phases, "--max-examples", str(examples)]
        if command != "view":
            asked += ["--header", f"Authorization: Bearer {TOKEN}"]
        outcome = subprocess.run([*PROGRAM, *asked], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
