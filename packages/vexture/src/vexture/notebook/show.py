"""`vexture.show`: make a widget of anything that vexture can draw."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, overload

from vexture.base.errors import DeviceError, ParameterError

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

    from vexture.drawing.drawing import Drawing
    from vexture.notebook.widget import VectorWidget
    from vexture.texture.restyle import Colour
    from vexture.texture.texture import Texture
    from vexture_geo.base.extent import Extent
    from vexture_geo.flood.page import FloodPage
    from vexture_geo.flood.widget import FloodWidget

READING: Final = ("select", "names", "snap", "fonts", "images", "page_colors")
"""Options of a conversion that belong to its reader."""

OPTIONAL: Final = ("root", "width", "colors", "view")
"""Traits that keep their default if the option is None."""

TRAITS: Final = (*OPTIONAL, "mode", "background")


@overload
def show(
    source: "str | os.PathLike[str] | Drawing | Texture",
    /,
    *,
    root: str | int | None = ...,
    width: int | None = ...,
    height: int | None = ...,
    mode: Literal["paint", "silhouette"] = ...,
    colors: "Mapping[str, Colour] | None" = ...,
    background: str = ...,
    view: tuple[float, float, float, float] | None = ...,
    **options: Any,
) -> "VectorWidget": ...


@overload
def show(
    source: "FloodPage | Dataset | DataArray | Extent", /, *, height: int | None = ..., **options: Any
) -> "FloodWidget": ...


def show(source: Any, /, *, height: int | None = None, **options: Any) -> Any:
    """Show a drawing, a texture or a flood in a notebook, as a widget whose traits hold its state.

    Needs ``vexture[notebook]``. Drag to move, turn the wheel or pinch to zoom, click to pick. The arrow keys, + and −
    do the same; a double click or Home shows the whole drawing again.

    Parameters
    ----------
    source : path, Drawing, Texture, FloodPage, Dataset, DataArray or Extent
        A drawing, a texture, or the path of a texture or of a file that `vexture.read` reads; or a flood: its page, or
        a source of `vexture.flood_page`.
    height : int, optional
        Height in CSS pixels; by default 400, or 600 for a flood.
    **options
        For a path or a drawing: parameters of `vexture.convert`. By default, the texture is precise enough for the
        deepest zoom, and a drawing of named elements and flat colours can be restyled (`restyle`). For a flood:
        parameters of `vexture.flood_page`.

    Other Parameters
    ----------------
    root : str or int, optional
        Drawing in the texture, as in `vexture.render`.
    width : int, optional
        Width in CSS pixels; by default the width of its cell.
    mode : str
        ``"paint"`` shows the drawing in its colours, ``"silhouette"`` the area that it covers, in black.
    colors : mapping of str to colour, optional
        Replacement colours for elements and shapes, as in `Texture.with_paints`.
    background : str
        A CSS colour, or ``"transparent"``; white even in dark notebooks, because most drawings are made for paper.
    view : (float, float, float, float), optional
        Left, bottom, width and height of the visible part of the unit square; by default the whole drawing.

    Returns
    -------
    VectorWidget or FloodWidget
        A notebook shows it as the value of a cell, or a picture where widgets are not supported. Its traits are the
        parameters, with `picked` and `hovered` for a drawing and `step` for a flood. `save` writes a page, or for a
        drawing also a picture.

    Raises
    ------
    DeviceError
        If the packages of ``vexture[notebook]`` are missing, or the pages are not built.
    ParameterError
        If an option is out of range, or options of a conversion are given for a texture. For other errors see
        `vexture.read`, `vexture.convert` and `vexture.flood_page`.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> kite = Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])
    >>> show(kite, colors={"drawing": "gold"}, height=300).colors
    {'drawing': 'gold'}
    """
    from vexture.conversion.extensions import find_geographic_reader

    try:
        from vexture.notebook.widget import HEIGHT, VectorWidget
    except ModuleNotFoundError as error:
        raise DeviceError(f"show needs the package {error.name}: pip install 'vexture[notebook]'") from None
    sizes: dict[str, Any] = {} if height is None else {"height": height}
    reader = find_geographic_reader()
    if reader is not None and (flood := reader.flood_widget(source, {**sizes, **options})) is not None:
        return flood
    extra = {name: options.pop(name) for name in TRAITS if name in options}
    traits: dict[str, Any] = {name: value for name, value in extra.items() if value is not None or name not in OPTIONAL}
    return VectorWidget(_texture_of(source, options), **{"height": HEIGHT, **sizes, **traits})


def _texture_of(source: Any, options: dict[str, Any]) -> "Texture":
    """Return the texture to show; convert a drawing with `options`."""
    from vexture.base.content import FileKind, kind_of, start_of
    from vexture.conversion.pipeline import convert
    from vexture.conversion.reading import read
    from vexture.drawing.drawing import Drawing
    from vexture.server.publish_file import VIEWER_PARAMETERS
    from vexture.texture.load import load
    from vexture.texture.texture import Texture

    if isinstance(source, str | os.PathLike) and kind_of(start_of(source), source) is FileKind.TEXTURE:
        source = load(source)
    if isinstance(source, Texture):
        _refuse(options, source.name)
        return source
    if not isinstance(source, str | os.PathLike | Drawing):
        kind = type(source).__name__
        raise TypeError(
            f"`source` is of the type {kind}; give a path, a Drawing, a Texture in the encoding packed, or a flood"
        )
    if not isinstance(source, Drawing):
        reading = {name: options.pop(name) for name in READING if name in options}
        source = read(Path(source), **reading)
    flat = not any(path.paint.is_varied for path in source.paths)
    named = any(path.element for path in source.paths)
    chosen = {"precision": VIEWER_PARAMETERS.precision, "restyle": flat and named, **options}
    return convert(source, **chosen)


def _refuse(options: dict[str, Any], name: str) -> None:
    for option, value in options.items():
        raise ParameterError(f"`{option}` is {value!r}, but {name} is converted already; leave it out")
