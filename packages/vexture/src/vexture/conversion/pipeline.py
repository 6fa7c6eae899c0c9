"""Conversion: from a source to its drawing, its trees and a texture."""

import inspect
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Literal, TypeAlias, TypeVar, overload

from vexture.base.deadline import CLOCK, DEFAULT_SECONDS, within
from vexture.base.errors import ParameterError
from vexture.base.notes import Note, warn_of
from vexture.base.tolerance import UNSEEN
from vexture.conversion.parameters import DEFAULTS, Fonts, Parameters, Split, refuse_unknown
from vexture.texture.registry import DEFAULT, EncodedTexture, find_encoding

if TYPE_CHECKING:  # imported at run time when needed: compiler and parser take long
    from vexture.drawing.drawing import Drawing
    from vexture.texture.root import Root
    from vexture.texture.texture import Texture

Source: TypeAlias = "Drawing | str | os.PathLike[str]"
"""A drawing, or the path of a file that `vexture.read` reads."""

AnyTexture = TypeVar("AnyTexture", bound=EncodedTexture, covariant=True)


@dataclass(frozen=True, slots=True, eq=False)
class Conversion(Generic[AnyTexture]):
    """A conversion of one source, with all steps between the source and the texture."""

    drawing: "Drawing"  # if it was split, its layers() became the trees
    trees: tuple[Any, ...]  # of `Tree`, or the one tree of another encoding
    texture: AnyTexture  # None of trees that are not combined yet
    seconds: float  # from the source to the texture or the trees
    rounding: float  # largest shift of an outline by rounding to the texture's bits, in unit-square units
    roots: "tuple[Root, ...]" = ()  # of the trees in a packed texture
    source: str = ""  # its name in messages
    notes: tuple[Note, ...] = ()  # of the drawing, or if it was split, of its layers

    @property
    def tree(self) -> Any:
        """The first tree: the only one, unless the drawing was split."""
        return self.trees[0]


def run(source: Source, parameters: Parameters = DEFAULTS) -> "Conversion[Texture]":
    """Convert as `convert` does, but without a warning, and keep the steps."""
    start = CLOCK.seconds()
    part = trees_of(source, parameters)
    texture = combine([part], part.drawing.name, None if _is_drawing(source) else Path(part.source).name)
    return replace(part, texture=texture, seconds=CLOCK.seconds() - start)


def run_encoding(
    source: Source,
    encoding: str,
    *,
    select: str | None = None,
    max_seconds: float = DEFAULT_SECONDS,
    **parameters: Any,
) -> Conversion[EncodedTexture]:
    """Convert as `run` does, to a registered encoding; `parameters` are those of its `convert`."""
    from vexture.conversion.reading import drawing_of

    start, other = CLOCK.seconds(), find_encoding(encoding)
    refuse_unknown(parameters, inspect.signature(other.convert).parameters, encoding)
    with within(max_seconds):
        drawing = drawing_of(source, {} if select is None else {"select": select}).without_masks()
        tree, texture, rounding = other.convert(drawing, **parameters)
    return Conversion(drawing, (tree,), texture, CLOCK.seconds() - start, rounding, notes=drawing.notes)


def parts_of(source: "Source | bytes", parameters: Parameters, name: str | None = None) -> Iterator[Conversion[Any]]:
    """Read the drawings of one source for an atlas, and build the trees of each, as `trees_of` does.

    `name` is that of a source that is the content of a file.
    """
    if not isinstance(source, str | bytes | os.PathLike):
        yield trees_of(source, parameters)
        return
    from vexture.conversion.sprites import read_drawings

    given = replace(parameters, select=None, names=None, snap=None, fonts=None, trace_images=False, page_colors=None)
    with within(parameters.max_seconds):
        start = CLOCK.seconds()
        for shown, drawing in read_drawings(source, name=name, **parameters.reading):
            yield replace(trees_of(drawing, given), source=shown, seconds=CLOCK.seconds() - start)
            start = CLOCK.seconds()


def trees_of(source: Source, parameters: Parameters) -> Conversion[Any]:
    """Read one source, split it if the parameters say so, and build its trees."""
    from vexture.conversion.reading import drawing_of
    from vexture.texture.root import Root
    from vexture.tree.bounds import TreeParameters, largest_shift
    from vexture.tree.build import build_tree
    from vexture.tree.planar.sheets import Sheet, notes_of_sheets, sheets_of
    from vexture.tree.planar.style import restylable, style_of

    start = CLOCK.seconds()
    tolerance = parameters.tolerance
    if tolerance == "auto":
        tolerance = UNSEEN if parameters.precision is None else 0.0
    with within(parameters.max_seconds):
        drawing = drawing_of(source, parameters.reading)
        split = parameters.split_of(drawing)
        shown = restylable(drawing) if parameters.restyle else drawing if split else drawing.without_masks()
        bounds = parameters.bounds | TreeParameters(tolerance=tolerance)
        layers = drawing.layers() if split == "paint" else ()
        if split == "faces" and drawing.paths:
            sheets = sheets_of(shown, parameters.restyle, **bounds)
        else:
            sheets = [Sheet(layer, build_tree(layer, **bounds)) for layer in layers or (shown,)]
    roots = tuple(
        Root(
            part.name,
            0,
            part.to_source,
            tolerance,
            part.crs,
            sheet.paint if parameters.split and part.paths else None,
            style=style_of(part, sheet.tree) if parameters.restyle and part.paths else None,
        )
        for sheet in sheets
        for part in (sheet.drawing,)
    )
    named = drawing.name if _is_drawing(source) else os.fspath(source)  # type: ignore[arg-type]
    seconds, rounding = CLOCK.seconds() - start, largest_shift(parameters.precision)
    notes = layers[0].notes if layers else (*shown.notes, *notes_of_sheets(sheets))
    if parameters.restyle and not any(path.element for path in drawing.paths):
        notes = (*notes, Note("remark", "no element has a name, so none can get another colour"))
    return Conversion(drawing, tuple(each.tree for each in sheets), None, seconds, rounding, roots, named, notes)


def combine(parts: Sequence[Conversion[Any]], name: str, source: str | None = None) -> "Texture":
    """One texture of the trees of some sources; raises a `ParameterError` as `atlas` does."""
    from vexture.texture.encode import encode

    owner: dict[str, str] = {}
    for part in parts:
        for root in part.roots:
            if root.name in owner:
                raise ParameterError(
                    f"{part.source}: the texture has a shape {root.name!r} already, from {owner[root.name]}; "
                    "rename one of the two"
                )
            owner[root.name] = part.source
    if not owner:
        raise ParameterError("an atlas of no drawings; give at least one")
    trees = [tree for part in parts for tree in part.trees]
    return encode(trees, [root for part in parts for root in part.roots], name=name, source=source)


@overload
def convert(
    source: Source,
    *,
    encoding: Literal["packed"] = ...,
    split: Split = ...,
    select: str | None = ...,
    tolerance: float | Literal["auto"] = ...,
    max_depth: int | None = ...,
    capacity: int | None = ...,
    precision: float | None = ...,
    max_seconds: float = ...,
    names: str | None = ...,
    snap: float | None = ...,
    restyle: bool = ...,
    fonts: Fonts = ...,
    trace_images: bool = ...,
    page_colors: Mapping[str, str] | None = ...,
) -> "Texture": ...


@overload
def convert(source: Source, *, encoding: str, select: str | None = ..., **parameters: Any) -> EncodedTexture: ...


def convert(
    source: Source,
    *,
    encoding: str = DEFAULT,
    split: Split = "auto",
    select: str | None = None,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
    capacity: int | None = None,
    precision: float | None = None,
    max_seconds: float = DEFAULT_SECONDS,
    names: str | None = None,
    snap: float | None = None,
    restyle: bool = False,
    fonts: Fonts = None,
    trace_images: bool = False,
    page_colors: Mapping[str, str] | None = None,
    **others: Any,
) -> EncodedTexture:
    """Convert a drawing into a texture.

    Parameters
    ----------
    source : Drawing or path
        A drawing, or a file that `vexture.read` reads.
    encoding : str
        ``"packed"``, the encoding of `Texture`, or a registered one, whose parameters its package documents:
        ``"thesis"`` (`vexture.thesis.convert`).
    split : str or None
        ``"faces"`` makes the whole drawing, in its colours, one planar map. ``"paint"`` makes each layer of the
        drawing (`Drawing.layers`) a shape of its own, with its colour. None converts the silhouette, of no colour.
        ``"auto"`` is ``"faces"`` of a drawing of more than one colour (`Drawing.is_coloured`). One of a single colour
        becomes a silhouette with that colour: it needs no map.
    select : str, optional
        Convert only what a CSS selector chooses of an SVG; see `vexture.read_svg`.
    tolerance : float or "auto"
        Largest distance between the drawing's outline and the texture's before rounding, in unit-square units. Pieces
        that one cubic fits within it become one. 0 loses nothing but by rounding, for deep zoom; "auto" is 2e-5, which
        shows at no size up to 2,000 pixels, and 0 if there is a `precision`.
    max_depth : int, optional
        Cells of this depth are not divided further; 16 by default.
    capacity : int, optional
        Pieces in a leaf, 1 to 15; 8 by default, 12 of a planar map. Fewer draw faster and make the texture larger.
    precision : float, optional
        Largest shift of the outline by rounding, in unit-square units; leaves are divided until it holds. By default
        rounding alone divides no leaf.
    max_seconds : float, optional
        Most seconds that reading the source and building its trees may take; 300 by default.
    names : str, optional
        What names elements: a property of GeoJSON, an attribute or ``title`` of SVG; see `vexture.read`.
    snap : float, optional
        How far borders of a map's polygons that become one may differ; see `vexture.read_geojson`.
    restyle : bool
        With ``split="faces"``: the colours of elements can be changed in the texture (`Texture.with_paints`), and it
        tells which element is at a point (`Texture.element_at`). Elements of one colour keep their borders.
    fonts : sequence of path, optional
        Font files, and folders of them, for the texts of an SVG; see `vexture.read_svg`.
    trace_images : bool
        Trace the pictures in an SVG; see `vexture.read`.
    page_colors : mapping of str to str, optional
        Colours that its page would give an SVG; see `vexture.read_svg`.
    **others
        Parameters of another encoding.

    Returns
    -------
    Texture
        Or the texture of another encoding.

    Raises
    ------
    SourceError
        If the drawing cannot be read.
    LimitError
        If a selector chooses nothing, the tree is too large, or the conversion takes longer than `max_seconds`.
    ParameterError
        If a parameter is out of range.
    TypeError
        If `source` is neither a drawing nor a path, or a parameter is unknown.

    Warns
    -----
    SourceWarning
        Once for a source: of all notes of a file's reader (`Drawing.notes`), and of what the layers of a drawing lose.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    >>> [root.name for root in convert(triangle).roots]
    ['drawing']
    """
    named = Parameters(
        split, select, tolerance, max_depth, capacity, precision, max_seconds, names, snap, restyle, fonts,
        trace_images, page_colors,
    )  # fmt: skip
    if encoding == DEFAULT:
        refuse_unknown(others, (), encoding)
        conversion: Conversion[Any] = run(source, named)
    else:
        given = named.overrides
        if split is None:
            del given["split"]  # other encodings have silhouettes only
        conversion = run_encoding(source, encoding, **given, **others)
    if isinstance(source, str | os.PathLike):
        warn_of(os.fspath(source), conversion.notes)
    else:
        warn_of_loss(conversion.drawing, conversion.notes)
    texture: EncodedTexture = conversion.texture
    return texture


def warn_of_loss(drawing: "Drawing", notes: Iterable[Note], *, stacklevel: int = 2) -> None:
    """Warn of notes that a drawing does not have itself: `vexture.read` has warned of those."""
    lost = [note for note in notes if note not in drawing.notes]
    warn_of(drawing.name, lost, stacklevel=stacklevel + 1)


def atlas(
    sources: Iterable[Source],
    *,
    name: str = "atlas",
    split: Split = "auto",
    select: str | None = None,
    tolerance: float | Literal["auto"] = "auto",
    max_depth: int | None = None,
    capacity: int | None = None,
    precision: float | None = None,
    max_seconds: float = DEFAULT_SECONDS,
    names: str | None = None,
    snap: float | None = None,
    restyle: bool = False,
    fonts: Fonts = None,
    trace_images: bool = False,
    page_colors: Mapping[str, str] | None = None,
) -> "Texture":
    """Convert many drawings into one texture: a shape for each, or if `split` is ``"paint"`` for each layer of each.

    Parameters
    ----------
    sources : iterable of Drawing or path
        A shape is named after its drawing; that of a file after the file, without its last suffix. Layers are
        ``name/layer``. An SVG that holds symbols and paints nothing is a shape for each symbol, named after its id.
    name : str
        Names the texture.
    split, select, tolerance, max_depth, capacity, precision, max_seconds, names, snap, restyle, fonts, trace_images, \
page_colors
        As in `vexture.convert`, for each source.

    Returns
    -------
    Texture

    Raises
    ------
    ParameterError
        If two shapes have one name, or there is no source. For other errors and warnings see `vexture.convert`.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from vexture.drawing.drawing import Drawing
    >>> half = Drawing.polygon([(0, 0), (1, 0), (0, 1)])
    >>> both = atlas([replace(half, name="a"), replace(half, name="b")])
    >>> [root.name for root in both.roots]
    ['a', 'b']
    """
    parameters = Parameters(
        split, select, tolerance, max_depth, capacity, precision, max_seconds, names, snap, restyle, fonts,
        trace_images, page_colors,
    )  # fmt: skip
    if isinstance(sources, str | bytes | os.PathLike) or not isinstance(sources, Iterable):
        sources = [sources]
    parts = []
    for source in sources:
        if isinstance(source, bytes):
            raise TypeError("`source` is of the type bytes; give a path or a Drawing, as vexture.read makes of bytes")
        for part in parts_of(source, parameters):
            parts.append(part)
            if _is_drawing(source):
                warn_of_loss(part.drawing, part.notes)
            else:
                warn_of(part.source, part.notes)
    return combine(parts, name)


def _is_drawing(source: Any) -> bool:
    from vexture.drawing.drawing import Drawing

    return isinstance(source, Drawing)
