"""From a source to a texture: the arrows of the architecture, one after the other."""

import os
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

from vexture.errors import LimitError
from vexture.notes import warn_of
from vexture.settings import Settings

if TYPE_CHECKING:  # at run time they come when they are needed: compiler, parser and driver take their time
    from vexture.drawing import Drawing
    from vexture.encoding import PackedTexture, Root, ThesisTexture
    from vexture.quadtree.tree import CellTree, PackedTree

    Source = Drawing | str | os.PathLike[str]

__all__ = ["Conversion", "Shapes", "atlas", "convert", "join", "run", "shapes_of"]


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """What one source became, not yet in a packed texture.

    Parameters
    ----------
    drawing : Drawing
        What was read.
    trees : tuple of PackedTree
        What it became: one tree, or one for each of its layers.
    roots : tuple of Root
        What a texture says of each.
    seconds : float
        Time from the source to the trees.
    source : str
        Names the source in messages.
    """

    drawing: "Drawing"
    trees: "tuple[PackedTree, ...]"
    roots: "tuple[Root, ...]"
    seconds: float
    source: str


@dataclass(frozen=True, slots=True, eq=False)
class Conversion:
    """What a conversion went through.

    Parameters
    ----------
    drawing : Drawing
        What was read; if it was split, `drawing.layers()` are what became trees.
    trees : tuple of PackedTree or of CellTree
        What it became: one tree, or one for each of its layers.
    texture : PackedTexture or ThesisTexture
        What is saved.
    seconds : float
        Time from the source to the texture.
    """

    drawing: "Drawing"
    trees: "tuple[PackedTree, ...] | tuple[CellTree, ...]"
    texture: "PackedTexture | ThesisTexture"
    seconds: float

    @property
    def tree(self) -> "PackedTree | CellTree":
        """The first tree: the only one, unless the drawing was split."""
        return self.trees[0]


def run(source: "Source", **parameters: Any) -> Conversion:
    """Convert and keep what lies between; see `convert`."""
    settings = Settings(**parameters)
    start = time.perf_counter()
    if settings.encoding == "packed":
        shapes = shapes_of(source, settings)
        origin = None if _is_drawing(source) else Path(shapes.source).name
        packed = join([shapes], shapes.drawing.name, origin)
        return Conversion(shapes.drawing, shapes.trees, packed, time.perf_counter() - start)
    from vexture.encoding import encode, quantisation_step
    from vexture.encoding.layout import LIST_LIMIT
    from vexture.quadtree.build import DEFAULT_DEPTH, build

    drawing = _drawing_of(source, settings)
    bits = 16 if settings.bits is None else settings.bits
    if bits not in LIST_LIMIT:
        raise LimitError(f"{bits!r} bits; a texture has 8 or 16")
    depth = DEFAULT_DEPTH if settings.max_depth is None else settings.max_depth
    strategy = settings.strategy or "direct"
    tree = build(drawing, settings.tolerance, depth, strategy, quantisation_step(bits), LIST_LIMIT[bits])
    texture = encode(tree, bits, to_source=drawing.to_source, name=drawing.name, crs=drawing.crs)
    return Conversion(drawing, (tree,), texture, time.perf_counter() - start)


def shapes_of(source: "Source", settings: Settings) -> Shapes:
    """Read one source, take it apart if the settings say so, and grow its packed trees."""
    from vexture.encoding import Root
    from vexture.quadtree.build_packed import DEFAULT_CAPACITY, DEFAULT_DEPTH, build_packed

    start = time.perf_counter()
    drawing = _drawing_of(source, settings)
    tolerance = settings.packed_tolerance
    layers = drawing.layers() if settings.split else ()
    trees = tuple(
        build_packed(
            layer,
            tolerance=tolerance,
            max_depth=DEFAULT_DEPTH if settings.max_depth is None else settings.max_depth,
            capacity=DEFAULT_CAPACITY if settings.capacity is None else settings.capacity,
            precision=settings.precision,
        )
        for layer in layers or (drawing,)
    )
    if layers:
        roots = tuple(
            Root(layer.name, 0, layer.to_source, tolerance, layer.crs, layer.paths[0].paint) for layer in layers
        )
    else:
        roots = (Root(drawing.name, 0, drawing.to_source, tolerance, drawing.crs),)
    named = drawing.name if _is_drawing(source) else os.fspath(cast("str | os.PathLike[str]", source))
    return Shapes(drawing, trees, roots, time.perf_counter() - start, named)


def join(parts: Sequence[Shapes], name: str, source: str | None = None) -> "PackedTexture":
    """One texture of the shapes of some sources.

    Raises
    ------
    LimitError
        If there are none, or two of one name.
    """
    from vexture.encoding import encode_packed

    owner: dict[str, str] = {}
    for part in parts:
        for root in part.roots:
            if root.name in owner:
                raise LimitError(
                    f"{part.source}: the texture has a shape {root.name!r} already, from {owner[root.name]}; "
                    "rename one of the two"
                )
            owner[root.name] = part.source
    if not owner:
        raise LimitError("an atlas of no drawings; give at least one")
    trees = [tree for part in parts for tree in part.trees]
    return encode_packed(trees, [root for part in parts for root in part.roots], name=name, source=source)


def convert(
    source: "Source",
    *,
    encoding: str = "packed",
    split: Literal["paint"] | None = None,
    select: str | None = None,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
    capacity: int | None = None,
    precision: float | None = None,
    bits: int | None = None,
    strategy: Literal["direct", "sampled"] | None = None,
) -> "PackedTexture | ThesisTexture":
    """Turn a drawing into a texture.

    Parameters
    ----------
    source : Drawing or path
        A drawing, or a file that `vexture.read` reads.
    encoding : str
        ``"packed"``: several exact pieces in each leaf, one KTX2 file. ``"thesis"``: one curve in each leaf, a pair
        of PNG files.
    split : str, optional
        ``"paint"`` makes each layer of the drawing (`Drawing.layers`) a shape of its own, with its colour. None
        converts the silhouette. Packed only.
    select : str, optional
        Convert only what a CSS selector chooses of the file; see `vexture.read_svg`.
    tolerance : float or "auto"
        Largest distance between the drawing's outline and the texture's before quantisation, in unit-square units.
        Packed: pieces that one cubic describes within it become one; "auto" is 0, which loses nothing but by
        quantisation. Thesis: "auto" follows the smallest detail of the drawing and the size of each cell.
    max_depth : int, optional
        Cells of this depth are not divided further; 16 by default, in the encoding thesis 10.
    capacity : int, optional
        Pieces in a leaf, 1 to 15; 4 by default. Packed only.
    precision : float, optional
        Largest displacement by quantisation, in unit-square units; by default no leaf is made smaller for it. Packed
        only.
    bits : int, optional
        Bits per channel, 8 or 16; 16 by default. Thesis only.
    strategy : str, optional
        ``"direct"``, the default, takes leaves from the drawing's own cubics; ``"sampled"`` samples and fits as the
        thesis does. Thesis only.

    Returns
    -------
    PackedTexture or ThesisTexture

    Raises
    ------
    SourceError
        If the drawing cannot be read.
    LimitError
        If a parameter is out of range or belongs to the other encoding, a selector chooses nothing, or the tree is
        too large.

    Warns
    -----
    SourceWarning
        Once for a file, of all that was noticed while it was read (`Drawing.notes`).

    Examples
    --------
    >>> from vexture.drawing import Drawing
    >>> triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    >>> [root.name for root in convert(triangle).roots]
    ['drawing']
    >>> convert(triangle, encoding="thesis", bits=8).quads.shape[0]
    1
    """
    conversion = run(
        source,
        encoding=encoding,
        split=split,
        select=select,
        tolerance=tolerance,
        max_depth=max_depth,
        capacity=capacity,
        precision=precision,
        bits=bits,
        strategy=strategy,
    )
    if not _is_drawing(source):  # who read the drawing was told
        warn_of(os.fspath(cast("str | os.PathLike[str]", source)), conversion.drawing.notes)
    return conversion.texture


def atlas(
    sources: "Iterable[Source]",
    *,
    name: str = "atlas",
    split: Literal["paint"] | None = None,
    select: str | None = None,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
    capacity: int | None = None,
    precision: float | None = None,
) -> "PackedTexture":
    """Turn many drawings into one packed texture: a root for each, or with `split` for each layer of each.

    Parameters
    ----------
    sources : iterable of Drawing or path
        Each is found by its name in the texture: that of the drawing, for a file that before its first dot. Layers
        are ``name/layer``.
    name : str
        Names the texture.
    split, select, tolerance, max_depth, capacity, precision
        As in `vexture.convert`, for each source.

    Returns
    -------
    PackedTexture

    Raises
    ------
    SourceError
        If a drawing cannot be read.
    LimitError
        If two shapes have one name, there is no source, or as `vexture.convert` says.

    Warns
    -----
    SourceWarning
        As `vexture.convert` does.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from vexture.drawing import Drawing
    >>> half = Drawing.polygon([(0, 0), (1, 0), (0, 1)])
    >>> both = atlas([replace(half, name="a"), replace(half, name="b")])
    >>> [root.name for root in both.roots]
    ['a', 'b']
    """
    settings = Settings(
        split=split, select=select, tolerance=tolerance, max_depth=max_depth, capacity=capacity, precision=precision
    )
    listed = [sources] if isinstance(sources, str | os.PathLike) or _is_drawing(sources) else sources
    parts = []
    for source in listed:
        parts.append(shapes_of(cast("Source", source), settings))
        if not _is_drawing(source):
            warn_of(parts[-1].source, parts[-1].drawing.notes)
    return join(parts, name)


def _is_drawing(source: Any) -> bool:
    from vexture.drawing import Drawing

    return isinstance(source, Drawing)


def _drawing_of(source: "Source", settings: Settings) -> "Drawing":
    """Drawing that a source is or holds."""
    from vexture.drawing import Drawing

    if not isinstance(source, Drawing):
        from vexture.sources.reading import read_drawing

        return read_drawing(source, select=settings.select)
    if settings.select is not None:
        raise LimitError(
            f"{source.name}: select={settings.select!r} chooses elements of a file, which a drawing has no longer; "
            "read the file with read_svg(path, select=...)"
        )
    return source
