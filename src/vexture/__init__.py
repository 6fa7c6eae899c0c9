"""Vector textures: drawings in textures with random access, sharp at every zoom."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from vexture.errors import (
    DeviceError,
    FormatError,
    LimitError,
    ParameterError,
    SourceError,
    SourceWarning,
    VextureError,
)

if TYPE_CHECKING:
    __version__: str

    from vexture.drawing import Drawing, FillRule, Path
    from vexture.fold.fold import Fold, fold_from
    from vexture.fold.picture import fold_picture
    from vexture.fold.shore import shore_fold
    from vexture.fonts.text import text
    from vexture.geo.extent import Extent, Frame
    from vexture.geo.geojson import read_geojson
    from vexture.gltf.model import Model, read_model
    from vexture.glyph_atlas import FontAtlas, font_atlas
    from vexture.images import coverage, render
    from vexture.live.flood_page import FloodPage, flood_page
    from vexture.notebook.map import map
    from vexture.notebook.show import show
    from vexture.notes import Note
    from vexture.paint import Paint
    from vexture.pipeline import atlas, convert
    from vexture.reading import read, read_extent
    from vexture.renderers.shader import shader_source
    from vexture.renderers.view import View, window
    from vexture.svg.read import read_svg
    from vexture.texture.load import load
    from vexture.texture.texture import Root, Texture
    from vexture.tracing.trace import read_image, trace

__all__ = [
    "DeviceError",
    "Drawing",
    "Extent",
    "FillRule",
    "FloodPage",
    "Fold",
    "FontAtlas",
    "FormatError",
    "Frame",
    "LimitError",
    "Model",
    "Note",
    "Paint",
    "ParameterError",
    "Path",
    "Root",
    "SourceError",
    "SourceWarning",
    "Texture",
    "VextureError",
    "View",
    "atlas",
    "convert",
    "coverage",
    "flood_page",
    "fold_from",
    "fold_picture",
    "font_atlas",
    "load",
    "map",
    "read",
    "read_extent",
    "read_geojson",
    "read_image",
    "read_model",
    "read_svg",
    "render",
    "shader_source",
    "shore_fold",
    "show",
    "text",
    "trace",
    "window",
]

_HOMES = {
    "vexture.drawing": ("Drawing", "FillRule", "Path"),
    "vexture.paint": ("Paint",),
    "vexture.fold.fold": ("Fold", "fold_from"),
    "vexture.fold.picture": ("fold_picture",),
    "vexture.fold.shore": ("shore_fold",),
    "vexture.fonts.text": ("text",),
    "vexture.geo.extent": ("Extent", "Frame"),
    "vexture.geo.geojson": ("read_geojson",),
    "vexture.glyph_atlas": ("FontAtlas", "font_atlas"),
    "vexture.gltf.model": ("Model", "read_model"),
    "vexture.images": ("coverage", "render"),
    "vexture.live.flood_page": ("FloodPage", "flood_page"),
    "vexture.notebook.map": ("map",),
    "vexture.notebook.show": ("show",),
    "vexture.notes": ("Note",),
    "vexture.pipeline": ("atlas", "convert"),
    "vexture.reading": ("read", "read_extent"),
    "vexture.renderers.shader": ("shader_source",),
    "vexture.renderers.view": ("View", "window"),
    "vexture.svg.read": ("read_svg",),
    "vexture.texture.load": ("load",),
    "vexture.texture.texture": ("Root", "Texture"),
    "vexture.tracing.trace": ("read_image", "trace"),
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: the command line answers before NumPy is loaded (PEP 562)."""
    if name == "__version__":
        return import_module("importlib.metadata").version("vexture")
    for home, names in _HOMES.items():
        if name in names:
            value = getattr(import_module(home), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'vexture' has no attribute {name!r}")
