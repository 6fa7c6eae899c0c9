"""Vector textures: drawings that a GPU reads at random, sharp at every zoom."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

# the package of this name would replace the function of this name if it were imported later
import vexture.render  # noqa: F401
from vexture.errors import DeviceError, FormatError, LimitError, SourceError, SourceWarning, VextureError
from vexture.pictures import render, render_layers
from vexture.pipeline import atlas, convert

__all__ = [
    "DeviceError",
    "Drawing",
    "FillRule",
    "FormatError",
    "LimitError",
    "PackedTexture",
    "Paint",
    "Path",
    "Root",
    "SourceError",
    "SourceWarning",
    "ThesisTexture",
    "VextureError",
    "atlas",
    "convert",
    "load",
    "read_geojson",
    "read_svg",
    "render",
    "render_layers",
    "shader_source",
]

if TYPE_CHECKING:
    from vexture.drawing import Drawing, FillRule, Paint, Path
    from vexture.encoding import PackedTexture, Root, ThesisTexture, load
    from vexture.shaders import shader_source
    from vexture.sources.geojson import read_geojson
    from vexture.sources.svg import read_svg

_HOMES = {
    "vexture.drawing": ("Drawing", "FillRule", "Paint", "Path"),
    "vexture.encoding": ("PackedTexture", "Root", "ThesisTexture", "load"),
    "vexture.shaders": ("shader_source",),
    "vexture.sources.geojson": ("read_geojson",),
    "vexture.sources.svg": ("read_svg",),
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line answers before NumPy is loaded (PEP 562)."""
    for home, names in _HOMES.items():
        if name in names:
            value = getattr(import_module(home), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'vexture' has no attribute {name!r}")
