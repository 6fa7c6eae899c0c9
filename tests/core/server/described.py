"""What servers say of themselves in OpenAPI, and what the package says of them all."""

import json
from dataclasses import asdict
from importlib.resources import files

import httpx

WHOLE = json.loads(files("vexture.server").joinpath("openapi.json").read_bytes())


def requests_of(told, command=None):
    """Each request of a description; of a command only those that its server answers."""
    return {
        (path, method)
        for path, item in told["paths"].items()
        for method in item.keys() - {"parameters"}
        if command in (None, *item[method]["tags"])
    }


def check_description(url, command, limits):
    """Whether a server describes just the requests that it answers, and its own limits."""
    told = httpx.get(f"{url}openapi.json").json()
    assert requests_of(told) == requests_of(WHOLE, command)
    assert told["info"]["x-limits"] == asdict(limits)
