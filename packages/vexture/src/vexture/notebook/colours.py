"""Colours that a widget sets by name: of elements of planar maps, and of shapes that are no maps."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from vexture.base.errors import ParameterError
from vexture.drawing.paint import Paint
from vexture.texture.restyle import Colour, checked_colours, components
from vexture.texture.select_root import layers_of
from vexture.texture.texture import Texture
from vexture.tree.planar.style import round_colours


def components_of(texture: Texture, colours: Mapping[str, Colour], root: str | int | None) -> dict[str, list[float]]:
    """Red, green, blue and opacity of each colour, in 0..1, for JSON; refuses what `recolour_texture` cannot show."""
    shapes, elements = _split_colours(texture, colours, root)
    if elements:
        checked_colours(texture.roots, layers_of(texture.roots, root, texture.name), elements, texture.name)
    given: Any = {**shapes, **elements}
    parts = round_colours([components(name, colour) for name, colour in given.items()]).tolist()
    return dict(zip(given, parts, strict=True))


def recolour_texture(texture: Texture, colours: Mapping[str, Colour], root: str | int | None) -> Texture:
    """The texture with other colours of some elements and shapes of a drawing.

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
    """Split colours into those of shapes that are no maps, and those of elements."""
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
