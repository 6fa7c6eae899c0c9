"""Select the shape or the layers of a texture from a parameter `root`, which may be None.

Where a result can be of the whole texture, None means all of it: all outlines, or all layers of the only drawing.
Where one shape is needed, None means the only shape; if there are several, an error lists them.
"""

import difflib
import re
from collections.abc import Sequence
from typing import Final

import numpy as np

from vexture.base.errors import ParameterError
from vexture.texture.root import Root

MOST_NAMED: Final = 6
"""Most shapes that a message names."""

LAYER: Final = re.compile(r"(?<=.)/\d+(-[^/]*)?\Z")
"""End of a layer's name, from `Drawing.layers` or `sheets_of`."""


def place_of(roots: Sequence[Root], root: str | int | None, texture: str = "texture") -> int:
    """Find the number of the shape that `root` names: a name, a number from 0, or None for the only shape.

    `texture` is the texture's name in messages. Raises a `ParameterError` if there is no such shape, or if `root` is
    None and there are several; a `TypeError` if `root` has another type.
    """
    if root is None:
        if len(roots) > 1:
            choices = _format_names([one.name for one in roots])
            raise ParameterError(f"{texture} holds {len(roots)} shapes ({choices}); choose one by `root`")
        return 0
    names = [one.name for one in roots]
    if isinstance(root, str):
        if root in names:
            return names.index(root)
        near = difflib.get_close_matches(root, names, n=5)
        listed = ", ".join(map(repr, near or names[:5]))
        if near:
            raise ParameterError(f"{texture}: no shape {root!r}; near names are {listed}; there are {len(names)}")
        there = f"the first of {len(names)} are" if len(names) > 5 else "there are" if len(names) > 1 else "there is"
        raise ParameterError(f"{texture}: no shape {root!r}; {there} {listed}")
    if isinstance(root, bool) or not isinstance(root, int | np.integer):
        raise TypeError(f"{texture}: `root` is {root!r}; it must be a name or a whole number")
    if not 0 <= root < len(roots):
        raise ParameterError(f"{texture}: no shape {root}; they are numbered 0 to {len(roots) - 1}")
    return int(root)


def drawing_of(root: Root) -> str:
    """Name of a shape's drawing: a layer's name without its ending ``/NUMBER-COLOUR`` or ``/NUMBER-faces``.

    Examples
    --------
    >>> drawing_of(Root("logo/2-faces", is_map=True)), drawing_of(Root("icons/logo", is_map=True))
    ('logo', 'icons/logo')
    """
    return LAYER.sub("", root.name) if root.is_map or root.paint is not None else root.name


def layers_of(roots: Sequence[Root], root: str | int | None, texture: str = "texture") -> list[int]:
    """Numbers of the shapes that a picture shows, in painting order.

    `root` is the name of a drawing (see `drawing_of`), the name or number of one shape, or None for the only drawing.
    Raises a `ParameterError` if there is no such drawing or shape, or if `root` is None and there are several drawings.
    """
    owners = [drawing_of(one) for one in roots]
    if root is None:
        different = list(dict.fromkeys(owners))
        if len(different) > 1:
            raise ParameterError(
                f"{texture} holds {len(different)} drawings ({_format_names(different)}); choose one by `root`"
            )
        return list(range(len(owners)))
    layers = [place for place, owner in enumerate(owners) if owner == root]
    return layers or [place_of(roots, root, texture)]


def _format_names(names: list[str]) -> str:
    listed = ", ".join(name[:60] for name in names[:MOST_NAMED])
    return listed + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")
