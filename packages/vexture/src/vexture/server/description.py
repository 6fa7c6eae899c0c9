"""Description of a server in OpenAPI: of all that servers answer, what this one does, and its limits."""

import json
from collections.abc import Iterable
from dataclasses import asdict
from importlib.resources import files
from typing import Any, Final

from starlette.routing import Route

from vexture.server.limits import Limits

DESCRIPTION: Final = "/openapi.json"
"""Address of the description."""


def description(routes: Iterable[Route], limits: Limits) -> bytes:
    """Describe a server to authors of clients; raises a `KeyError` if ``openapi.json`` has not all its routes."""
    told = json.loads(files("vexture.server").joinpath("openapi.json").read_bytes())
    paths: dict[str, dict[str, Any]] = {DESCRIPTION: told["paths"][DESCRIPTION]}
    for route in routes:
        item = told["paths"][route.path_format]
        methods = [method.lower() for method in route.methods or () if method != "HEAD"]
        path = paths.setdefault(route.path_format, {"parameters": item.get("parameters", [])})
        path.update({method: item[method] for method in methods})
    told["paths"] = paths
    told["info"]["x-limits"] = asdict(limits)
    return json.dumps(told, indent=1).encode()
