"""OpenAPI descriptions: those that servers give of themselves, and the package's of them all."""

import json
from dataclasses import asdict
from importlib.resources import files

import httpx

WHOLE = json.loads(files("vexture.server").joinpath("openapi.json").read_bytes())


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
