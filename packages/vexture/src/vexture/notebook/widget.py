"""The widget of a drawing: its state is in traits, which both Python and the page can change."""

import base64
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import anywidget
import numpy as np
import traitlets
from ipywidgets import widget_serialization
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.drawing.colors import Color, parse_color
from vexture.drawing.paint import Paint
from vexture.notebook.picture import MODES, Mode, home_of, png_of, render_view
from vexture.notebook.shared_content import SharedContent, share_content
from vexture.notebook.traits import BackgroundTrait, ChoiceTrait, ColoursTrait, PixelsTrait, RectangleTrait
from vexture.pages.page import Bundle, built, check_output, data_address, whole_page
from vexture.renderers.view import Size, window
from vexture.server.published import TEXTURE_TYPE, PublishedFile
from vexture.texture.files import write_together
from vexture.texture.restyle import Colour, checked_colours, components
from vexture.texture.select_root import layers_of
from vexture.texture.texture import Texture
from vexture.tree.planar.style import round_colours

PAGE: Final = Bundle("notebook.js", "notebook.css")
"""Bundle of the engine of all widgets, which is also the script of the pages that `save` writes."""

LOADER: Final = "notebook-widget.js"
HEIGHT: Final = 400
"""Default height in pixels."""

PICTURE_WIDTH: Final = 640
"""Width in pixels of a picture of a widget that has the width of its cell."""

PNG: Final = ".png"
SAVED: Final = ("view", "root", "mode", "background", "colors", "_home", "_name")
"""Traits that a saved page contains; the page itself fills its window."""


def _colours_to_json(colours: Mapping[str, Any], widget: "VectorWidget") -> dict[str, list[float]]:
    return widget.components(colours)


def _written(value: Any) -> Any:
    """Convert a trait to JSON values; bytes become base64."""
    if isinstance(value, dict):
        return {name: _written(part) for name, part in value.items()}
    return {"base64": base64.b64encode(value).decode()} if isinstance(value, bytes | memoryview) else value


class VectorWidget(anywidget.AnyWidget):
    """A drawing that can be moved and pointed at; `vexture.show` makes it.

    Attributes
    ----------
    view : (float, float, float, float)
        Visible rectangle of the unit square (y up): left, bottom, width and height, centred at the largest size that
        fits, as in `vexture.window`. Dragging, the wheel and keys change it, and Python may change it, too.
    root : str, int or None
        Drawing in the texture; a new one is shown as a whole, unless the view was changed before.
    mode : str
        ``"paint"`` shows the drawing in its colours, ``"silhouette"`` the area that it covers, in black.
    colors : dict
        Replacement colours, by the names of elements (if the drawing was converted with `restyle`) or of shapes, as in
        `Texture.with_paints`. Everything else keeps its own colour.
    background : str
        A CSS colour, or ``"transparent"``.
    width, height : int
        CSS pixels; without a width, the widget has the width of its cell.
    picked : dict or None
        Result of the last click: ``root`` and ``element``, names or None; ``position`` in the unit square, and
        ``source``, the same position in the units of the drawing's file.
    hovered : dict or None
        Names of ``root`` and ``element`` under the pointer.
    """

    saved_traits: tuple[str, ...] = ()
    """Further traits, of a subclass, that a saved page contains."""

    _esm = traitlets.Unicode().tag(sync=True)
    _engine = traitlets.Instance(SharedContent).tag(sync=True, **widget_serialization)
    _source = traitlets.Instance(SharedContent, allow_none=True).tag(sync=True, **widget_serialization)
    _home = RectangleTrait().tag(sync=True)
    _name = traitlets.Unicode().tag(sync=True)
    view = RectangleTrait().tag(sync=True)
    root = traitlets.Union([traitlets.Int(), traitlets.Unicode()], allow_none=True, default_value=None).tag(sync=True)
    mode = ChoiceTrait(MODES, MODES[0]).tag(sync=True)
    colors = ColoursTrait().tag(sync=True, to_json=_colours_to_json)
    background = BackgroundTrait("white").tag(sync=True)
    width = PixelsTrait(None, allow_none=True).tag(sync=True)
    height = PixelsTrait(HEIGHT).tag(sync=True)
    picked = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    hovered = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)

    def __init__(self, texture: Texture | None, **traits: Any) -> None:
        self._texture = texture
        if texture is not None:  # otherwise it comes later
            traits |= {"_home": home_of(texture, traits.get("root")), "_name": texture.name}
            traits["_source"] = share_content(texture.to_ktx2())
        traits.setdefault("view", traits["_home"])
        super().__init__(_engine=share_content(built(PAGE.script)), **traits)

    def __repr__(self) -> str:
        """Name and view."""
        return f"<{type(self).__name__} {self._name!r}: view {', '.join(f'{number:g}' for number in self.view)}>"

    @property
    def texture(self) -> Texture:
        """Texture that the widget shows; it cannot be replaced."""
        assert self._texture is not None
        return self._texture

    def close(self) -> None:
        """End the widget; the last widget of a texture frees its bytes."""
        if self.comm is not None:
            for each in (self._engine, self._source):
                if each is not None:
                    each.release()
        super().close()

    def render(self, size: Size | None = None) -> NDArray[np.float32]:
        """Render the widget's view with the CPU renderer, without its background.

        Parameters
        ----------
        size : int or (int, int), optional
            Width and height in pixels; by default those of the widget, with 640 for the width of a cell.

        Returns
        -------
        (height, width, 4) float32 array
            As from `vexture.render`.
        """
        texture = self.coloured()
        mode: Mode = self.mode
        return render_view(texture, size or (self.width or PICTURE_WIDTH, self.height), self.view, mode, self.root)

    def components(self, colours: Mapping[str, Any]) -> dict[str, list[float]]:
        """Return red, green, blue and opacity of colours by name; raise an error if one is not valid."""
        return components_of(self.texture, colours, self.root)

    def coloured(self) -> Texture:
        """Return the texture in the colours that the widget shows."""
        return recolour_texture(self.texture, self.colors, self.root)

    def only_saved(self) -> dict[str, Any]:
        """Return the additional state of a saved page, which has no kernel."""
        return {}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Save the view: ``NAME.png`` is a picture, ``NAME.html`` a page that works without a kernel and a network.

        Raises
        ------
        ParameterError
            If the name has another suffix.
        DeviceError
            If the file cannot be written.
        """
        target = Path(path)
        if target.suffix.lower() == PNG:
            return write_together({target: png_of(self.render(), self.background)})
        check_output(target, PAGE)
        state = {
            **{name: _written(self.get_state(name)[name]) for name in (*SAVED, *self.saved_traits)},
            **self.only_saved(),
            "width": None,
            "height": None,
        }
        assert self._source is not None
        texture = data_address(PublishedFile(self._source.content, TEXTURE_TYPE, ".ktx2"))
        return write_together({target: whole_page(PAGE, {"state": state, "texture": texture}, self.texture.name)})

    @traitlets.default("_esm")
    def _loader(self) -> str:
        return built(LOADER).decode()

    @traitlets.validate("root")
    def _checked_root(self, proposal: Any) -> Any:
        layers_of(self.texture.roots, proposal["value"], self.texture.name)
        return proposal["value"]

    @traitlets.validate("colors")
    def _checked_colours(self, proposal: Any) -> Any:
        self.components(proposal["value"])
        return proposal["value"]

    @traitlets.validate("background")
    def _checked_background(self, proposal: Any) -> Any:
        if not isinstance(parse_color(proposal["value"]), Color):
            raise ParameterError(
                f"`background` is {proposal['value'][:60]!r}; give a CSS colour, such as 'white' or 'transparent'"
            )
        return proposal["value"]

    @traitlets.validate("view")
    def _checked_view(self, proposal: Any) -> Any:
        window(*proposal["value"])  # raises the error
        return proposal["value"]

    @traitlets.observe("root")
    def _go_home(self, change: Any) -> None:
        was_home = self.view == self._home
        self._home = home_of(self.texture, change["new"])
        if was_home:
            self.view = self._home

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the widget, and a picture for frontends without widgets; IPython calls it by this name."""
        data, metadata = super()._repr_mimebundle_(**kwargs) or ({}, {})
        picture = base64.b64encode(png_of(self.render(), self.background)).decode()
        return {**data, "image/png": picture}, metadata


def components_of(texture: Texture, colours: Mapping[str, Colour], root: str | int | None) -> dict[str, list[float]]:
    """Return red, green, blue and opacity of each colour, 0..1, for JSON; raise an error as `recolour_texture` does."""
    shapes, elements = _split_colours(texture, colours, root)
    if elements:
        checked_colours(texture.roots, layers_of(texture.roots, root, texture.name), elements, texture.name)
    chosen: Any = {**shapes, **elements}
    parts = round_colours([components(name, colour) for name, colour in chosen.items()]).tolist()
    return dict(zip(chosen, parts, strict=True))


def recolour_texture(texture: Texture, colours: Mapping[str, Colour], root: str | int | None) -> Texture:
    """Return the texture with other colours for some elements and shapes of a drawing.

    Examples
    --------
    >>> import vexture
    >>> kite = vexture.convert(vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)]))
    >>> recolour_texture(kite, {"drawing": "gold"}, None).roots[0].paint.hex
    '#ffd700'
    """
    shapes, elements = _split_colours(texture, colours, root)
    if shapes:
        paints = {name: components(name, colour) for name, colour in shapes.items()}
        drawn = layers_of(texture.roots, root, texture.name)
        roots = list(texture.roots)
        for place in drawn:
            if (parts := paints.get(roots[place].name)) is not None and not roots[place].is_map:
                roots[place] = replace(roots[place], paint=Paint((parts[0], parts[1], parts[2]), parts[3]))
        texture = Texture(texture.texels, tuple(roots), texture.name, texture.source)
    return texture.with_paints(elements, root=root) if elements else texture


def _split_colours(
    texture: Texture, colours: Mapping[str, Colour], root: str | int | None
) -> tuple[dict[str, Colour], dict[str, Colour]]:
    """Split colours into those of shapes that are not planar maps, and those of elements."""
    if not isinstance(colours, Mapping) or not all(isinstance(name, str) for name in colours):
        raise ParameterError("the colours are no mapping of names, such as {'sun': 'red'}")
    drawn = [texture.roots[place] for place in layers_of(texture.roots, root, texture.name)]
    plain = [shape.name for shape in drawn if not shape.is_map]
    shapes = {name: colour for name, colour in colours.items() if name in plain}
    elements = {name: colour for name, colour in colours.items() if name not in plain}
    if elements and len(plain) == len(drawn):
        raise ParameterError(
            f"{texture.name}: no shape {next(iter(elements))!r}, and it has no elements; its shapes are "
            f"{', '.join(map(repr, plain[:5]))}; convert the drawing with `restyle` for elements"
        )
    return shapes, elements
