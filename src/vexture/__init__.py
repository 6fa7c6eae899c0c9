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
    "Extent",
    "FillRule",
    "Fold",
    "FormatError",
    "Frame",
    "LimitError",
    "Note",
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
    "fold_from",
    "fold_picture",
    "load",
    "read",
    "read_extent",
    "read_geojson",
    "read_image",
    "read_svg",
    "render",
    "render_layers",
    "shader_source",
    "shore_fold",
    "trace",
]

if TYPE_CHECKING:
    from vexture.drawing import Drawing, FillRule, Paint, Path
    from vexture.encoding import PackedTexture, Root, ThesisTexture, load
    from vexture.folding.fold import Fold, fold_from
    from vexture.folding.picture import fold_picture
    from vexture.folding.shore import shore_fold
    from vexture.notes import Note
    from vexture.shaders import shader_source
    from vexture.sources.extent import Extent
    from vexture.sources.frame import Frame
    from vexture.sources.geojson import read_geojson
    from vexture.sources.reading import read, read_extent
    from vexture.sources.svg import read_svg
    from vexture.sources.traced import read_image, trace

_HOMES = {
    "vexture.drawing": ("Drawing", "FillRule", "Paint", "Path"),
    "vexture.encoding": ("PackedTexture", "Root", "ThesisTexture", "load"),
    "vexture.folding.fold": ("Fold", "fold_from"),
    "vexture.folding.picture": ("fold_picture",),
    "vexture.folding.shore": ("shore_fold",),
    "vexture.notes": ("Note",),
    "vexture.shaders": ("shader_source",),
    "vexture.sources.extent": ("Extent",),
    "vexture.sources.frame": ("Frame",),
    "vexture.sources.geojson": ("read_geojson",),
    "vexture.sources.reading": ("read", "read_extent"),
    "vexture.sources.svg": ("read_svg",),
    "vexture.sources.traced": ("read_image", "trace"),
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line answers before NumPy is loaded (PEP 562)."""
    for home, names in _HOMES.items():
        if name in names:
            value = getattr(import_module(home), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'vexture' has no attribute {name!r}")
