"""OpenAPI descriptions: those that servers give of themselves, and the package's of them all."""

import json
import subprocess
import sys
from dataclasses import asdict
from importlib.resources import files

import httpx
import pytest
from server import TOKEN

WHOLE = json.loads(files("vexture.server").joinpath("openapi.json").read_bytes())


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


def requests_of(description, command=None):
    """Each request of a description; of a command only those that its server answers."""
    return {
        (path, method)
        for path, item in description["paths"].items()
        for method in item.keys() - {"parameters"}
        if command in (None, *item[method]["tags"])
    }


def check_description(url, command, limits):
    """Whether a server describes just the requests that it answers, and its own limits."""
    description = httpx.get(f"{url}openapi.json").json()
    assert requests_of(description) == requests_of(WHOLE, command)
    assert description["info"]["x-limits"] == asdict(limits)


def check_answers(url, name, folder, phases, examples, token=TOKEN):
    """Send the requests that a description allows, and compare the answers with it; `name` is that of a shape."""
    manifest = httpx.get(f"{url}shapes/{name}").json()
    pinned = PINNED.format(file=manifest["texture"].rpartition("/")[2], version=manifest["version"])
    (folder / "schemathesis.toml").write_text(pinned)
    command = [*PROGRAM, "run", f"{url}openapi.json", *ASKING, "--phases", phases, "--max-examples", str(examples)]
    if token:
        command += ["--header", f"Authorization: Bearer {token}"]
    outcome = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
