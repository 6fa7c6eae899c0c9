"""The drawings of a source for an atlas: one drawing, or one per symbol of a sprite."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vexture.base.content import FileKind, is_stream, known_kind, read_bytes, start_of, unpack_source
from vexture.conversion.reading import Place, images_of, name_of, read_drawing

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing


def read_drawings(source: Place | bytes, *, name: str | None = None, **reading: Any) -> "Iterator[tuple[str, Drawing]]":
    """Read the drawings of a source, each with its name for messages: one drawing, or one per symbol of a sprite.

    A sprite is an SVG that defines symbols and paints nothing else. With `select`, the matching elements are one
    drawing. `reading` holds parameters of `read_drawing`, and errors are the same.

    Examples
    --------
    >>> sprite = b'<svg><symbol id="up" viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></symbol></svg>'
    >>> [(shown, drawing.name) for shown, drawing in read_drawings(sprite, name="arrows.svg")]
    [('arrows.svg#up', 'up')]
    """
    label = name_of(source, name)
    content = read_bytes(source) if is_stream(source) else source
    drawing = read_drawing(content, name=label, **reading)
    plain = b"" if drawing.paths or reading.get("select") is not None else unpack_source(content)
    if not plain or known_kind(start_of(plain), label) is not FileKind.SVG:
        yield label, drawing
        return
    from vexture.svg.sprite import symbol_drawings

    folder = Path(source).parent if isinstance(source, str | os.PathLike) else None
    of_symbols: dict[str, Any] = {key: reading[key] for key in ("names", "fonts", "page_colors") if key in reading}
    of_symbols["images"] = images_of(folder, traced=reading.get("trace_images", False))
    is_sprite = False
    for symbol in symbol_drawings(read_bytes(plain), label, **of_symbols):
        is_sprite = True
        yield f"{label}#{symbol.name}", symbol
    if not is_sprite:
        yield label, drawing
