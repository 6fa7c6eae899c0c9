"""The drawings of a source for an atlas: one, or of a sprite one for each symbol."""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vexture.content import FileKind, is_stream, known_kind, read_bytes, start_of, unpacked
from vexture.reading import Place, images_of, name_of, read_drawing

if TYPE_CHECKING:
    from vexture.drawing import Drawing

__all__ = ["read_drawings"]


def read_drawings(
    source: Place | bytes,
    *,
    name: str | None = None,
    select: str | None = None,
    names: str | None = None,
    snap: float | None = None,
    fonts: Sequence[Place] = (),
    trace_images: bool = False,
    page_colors: Mapping[str, str] | None = None,
) -> "Iterator[tuple[str, Drawing]]":
    """Read the drawings of a source, each with its name in messages: one, or of a sprite one for each symbol.

    A sprite is an SVG of symbols that paints nothing else. With `select` it is one drawing, of what is chosen.
    Parameters and errors are those of `read_drawing`.

    Examples
    --------
    >>> sprite = b'<svg><symbol id="up" viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></symbol></svg>'
    >>> [(shown, drawing.name) for shown, drawing in read_drawings(sprite, name="arrows.svg")]
    [('arrows.svg#up', 'up')]
    """
    shown = name_of(source, name)
    given = read_bytes(source) if is_stream(source) else source
    drawing = read_drawing(
        given, name=shown, select=select, names=names, snap=snap, fonts=fonts, trace_images=trace_images,
        page_colors=page_colors,
    )  # fmt: skip
    plain = b"" if drawing.paths or select is not None else unpacked(given)
    if not plain or known_kind(start_of(plain), shown) is not FileKind.SVG:
        yield shown, drawing
        return
    from vexture.svg.sprite import symbol_drawings

    folder = Path(source).parent if isinstance(source, str | os.PathLike) else None
    images = images_of(folder, traced=trace_images)
    is_sprite = False
    for symbol in symbol_drawings(read_bytes(plain), shown, names, fonts, images, page_colors):
        is_sprite = True
        yield f"{shown}#{symbol.name}", symbol
    if not is_sprite:
        yield shown, drawing
