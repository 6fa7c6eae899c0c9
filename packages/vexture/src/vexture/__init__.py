"""Vector textures: drawings in textures with random access, sharp at every zoom."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from vexture.base.errors import (
    DeviceError,
    FormatError,
    LimitError,
    MissingPackageError,
    ParameterError,
    SourceError,
    SourceWarning,
    VextureError,
)

if TYPE_CHECKING:
    __version__: str

    from vexture.base.notes import Note
    from vexture.conversion.glyph_atlas import FontAtlas, font_atlas
    from vexture.conversion.images import coverage, render
    from vexture.conversion.pipeline import atlas, convert
    from vexture.conversion.reading import read
    from vexture.drawing.drawing import Drawing, FillRule, Path
    from vexture.drawing.paint import Paint
    from vexture.fold.fold import Fold, fold_from
    from vexture.fold.picture import fold_picture
    from vexture.fold.shore import shore_fold
    from vexture.fonts.text import text
    from vexture.gltf.model import Model, read_model
    from vexture.notebook.show import show
    from vexture.renderers.shader import shader_source
    from vexture.renderers.view import View, window
    from vexture.svg.read import read_svg
    from vexture.texture.load import load
    from vexture.texture.root import Root
    from vexture.texture.texture import Texture
    from vexture.tracing.trace import read_image, trace
    from vexture_geo.base.extent import Extent, Frame
    from vexture_geo.flood.page import FloodPage, flood_page
    from vexture_geo.maps.notebook.map import map
    from vexture_geo.readers import read_extent
    from vexture_geo.vector.geojson import read_geojson

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
    "vexture.drawing.drawing": ("Drawing", "FillRule", "Path"),
    "vexture.drawing.paint": ("Paint",),
    "vexture.fold.fold": ("Fold", "fold_from"),
    "vexture.fold.picture": ("fold_picture",),
    "vexture.fold.shore": ("shore_fold",),
    "vexture.fonts.text": ("text",),
    "vexture_geo.base.extent": ("Extent", "Frame"),
    "vexture_geo.vector.geojson": ("read_geojson",),
    "vexture.conversion.glyph_atlas": ("FontAtlas", "font_atlas"),
    "vexture.gltf.model": ("Model", "read_model"),
    "vexture.conversion.images": ("coverage", "render"),
    "vexture_geo.flood.page": ("FloodPage", "flood_page"),
    "vexture_geo.maps.notebook.map": ("map",),
    "vexture.notebook.show": ("show",),
    "vexture.base.notes": ("Note",),
    "vexture.conversion.pipeline": ("atlas", "convert"),
    "vexture.conversion.reading": ("read",),
    "vexture_geo.readers": ("read_extent",),
    "vexture.renderers.shader": ("shader_source",),
    "vexture.renderers.view": ("View", "window"),
    "vexture.svg.read": ("read_svg",),
    "vexture.texture.load": ("load",),
    "vexture.texture.root": ("Root",),
    "vexture.texture.texture": ("Texture",),
    "vexture.tracing.trace": ("read_image", "trace"),
}


def __getattr__(name: str) -> Any:
    """Import a public name on first use (PEP 562), so that the command line can answer without loading NumPy."""
    if name == "__version__":
        return import_module("importlib.metadata").version("vexture")
    for home, names in _HOMES.items():
        if name in names:
            value = getattr(_home_of(home, name), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'vexture' has no attribute {name!r}")


def _home_of(home: str, name: str) -> Any:
    """Import the module of a public name; if it is in vexture-geo, and that is missing, say what to install."""
    try:
        return import_module(home)
    except ModuleNotFoundError as error:
        if error.name != "vexture_geo":
            raise
        extra = "notebook,map" if name == "map" else "geo"
        raise MissingPackageError(
            f"vexture.{name} needs the package vexture-geo: pip install 'vexture[{extra}]'"
        ) from None
