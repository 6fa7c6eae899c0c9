"""The packages of the extra ``vexture[server]``, which only servers need."""

from importlib.util import find_spec
from typing import Final

from vexture.base.errors import DeviceError

NEEDED: Final = ("h11", "starlette", "uvicorn", "watchfiles")


def check_packages() -> None:
    """Raise a `DeviceError` if a package that servers need is missing."""
    for name in NEEDED:
        if find_spec(name) is None:
            raise DeviceError(f"a server needs the package {name}: pip install 'vexture[server]'")
