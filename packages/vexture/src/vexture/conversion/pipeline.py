"""The conversion pipeline: source, drawing, trees, texture."""

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
from vexture.conversion.parameters import DEFAULTS, Fonts, ImageTreatment, Parameters, Split, refuse_unknown
from vexture.texture.registry import DEFAULT, EncodedTexture, find_encoding

if TYPE_CHECKING:  # imported at run time when needed: compiler and parser take long
    from vexture.drawing.drawing import Drawing
    from vexture.texture.root import Root
    from vexture.texture.texture import Texture

Source: TypeAlias = "Drawing | str | os.PathLike[str]"
"""A drawing, or the path of a file that `vexture.read` can read."""

AnyTexture = TypeVar("AnyTexture", bound=EncodedTexture, covariant=True)


@dataclass(frozen=True, slots=True, eq=False)
class Conversion(Generic[AnyTexture]):
    """The conversion of one source, with all intermediate results."""

    drawing: "Drawing"  # its layers() became the trees if it was split
    trees: tuple[Any, ...]  # of type `Tree`, or one tree of another encoding
    texture: AnyTexture  # None until `combine` encodes the trees
    seconds: float  # time from the source to the trees or the texture
    rounding: float  # largest shift of an outline by rounding to the texture's bits, in unit-square units
    roots: "tuple[Root, ...]" = ()  # one for each tree of a packed texture
    source: str = ""  # name of the source in messages
    notes: tuple[Note, ...] = ()  # of the drawing, or of its layers if it was split

    @property
    def tree(self) -> Any:
        """First tree; it is the only one unless the drawing was split."""
        return self.trees[0]


def run(source: Source, parameters: Parameters = DEFAULTS) -> "Conversion[Texture]":
    """Convert as `convert` does, but without a warning, and keep the intermediate results."""
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
    """Convert to a registered encoding as `run` does; `parameters` are those of the encoding's `convert`."""
    from vexture.conversion.reading import drawing_of

    start, other = CLOCK.seconds(), find_encoding(encoding)
    refuse_unknown(parameters, inspect.signature(other.convert).parameters, encoding)
    with within(max_seconds):
        reading = {} if select is None else {"select": select}
        drawing = drawing_of(source, reading, for_outlines=True).without_masks()
        tree, texture, rounding = other.convert(drawing, **parameters)
    return Conversion(drawing, (tree,), texture, CLOCK.seconds() - start, rounding, notes=drawing.notes)


def parts_of(source: "Source | bytes", parameters: Parameters, name: str | None = None) -> Iterator[Conversion[Any]]:
    """Read the drawings of one source for an atlas, and build their trees as `trees_of` does.

    `name` is the name of a source that is given as its content.
    """
    if not isinstance(source, str | bytes | os.PathLike):
        yield trees_of(source, parameters)
        return
    from vexture.conversion.sprites import read_drawings

    plain = replace(parameters, select=None, names=None, snap=None, fonts=None, images="draw", page_colors=None)
    with within(parameters.max_seconds):
        start = CLOCK.seconds()
        outlines = parameters.split is None
        for label, drawing in read_drawings(source, name=name, for_outlines=outlines, **parameters.reading):
            yield replace(trees_of(drawing, plain), source=label, seconds=CLOCK.seconds() - start)
            start = CLOCK.seconds()


def trees_of(source: Source, parameters: Parameters) -> Conversion[Any]:
    """Read one source, split it according to the parameters, and build its trees."""
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
        drawing = drawing_of(source, parameters.reading, for_outlines=parameters.split is None)
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
    """Encode the trees of several sources as one texture; raise a `ParameterError` as `atlas` does."""
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
    images: ImageTreatment = ...,
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
    images: ImageTreatment = "draw",
    page_colors: Mapping[str, str] | None = None,
    **others: Any,
) -> EncodedTexture:
    """Convert a drawing into a texture.

    Parameters
    ----------
    source : Drawing or path
        A drawing, or a file that `vexture.read` reads.
    encoding : str
        ``"packed"``, the encoding of `Texture`, or a registered encoding, such as ``"thesis"``
        (`vexture.thesis.convert`). Its package documents its parameters.
    split : str or None
        ``"faces"`` converts the whole drawing, with its colours, into one planar map. ``"paint"`` converts each layer
        of the drawing (`Drawing.layers`) into a shape with its own colour. None converts the silhouette, without a
        colour. ``"auto"`` means ``"faces"`` for a drawing of several colours (`Drawing.is_coloured`). It makes a
        drawing of one colour a silhouette in that colour, because no map is needed.
    select : str, optional
        Convert only the elements of an SVG that a CSS selector matches; see `vexture.read_svg`.
    tolerance : float or "auto"
        Largest distance between the drawing's outline and the texture's before rounding, in unit-square units. Pieces
        that one cubic fits within the tolerance are merged. With 0, only rounding changes the outline, for deep zoom.
        "auto" is 2e-5, which cannot be seen at sizes up to 2,000 pixels, or 0 if there is a `precision`.
    max_depth : int, optional
        Cells at this depth are not subdivided; 16 by default.
    capacity : int, optional
        Most pieces in a leaf, 1 to 15; by default 8, or 12 for a planar map. Fewer draw faster in a larger texture.
    precision : float, optional
        Largest shift of the outline by rounding, in unit-square units; leaves are subdivided until it holds. By default
        no leaf is subdivided because of rounding.
    max_seconds : float, optional
        Time limit in seconds for reading the source and building its trees; 300 by default.
    names : str, optional
        Source of the elements' names: a property of GeoJSON, or an attribute or ``title`` of SVG; see `vexture.read`.
    snap : float, optional
        Largest gap between borders of a map's polygons that are merged; see `vexture.read_geojson`.
    restyle : bool
        With ``split="faces"``: keep the elements apart, so that the texture can change their colours
        (`Texture.with_paints`) and find the element at a point (`Texture.element_at`). Neighbouring elements of one
        colour then keep the border between them.
    fonts : sequence of path, optional
        Font files, and folders of font files, for the texts of an SVG; see `vexture.read_svg`.
    images : str
        Treatment of a picture, and of the pictures in an SVG; see `vexture.read`. A silhouette of a picture, or its
        conversion to another encoding, traces it, because the picture itself has no outlines.
    page_colors : mapping of str to str, optional
        Colours that a page would pass to the SVG; see `vexture.read_svg`.
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
        Once for each source: with the reader's notes (`Drawing.notes`), and with the losses of a drawing's layers.

    Examples
    --------
    >>> from vexture.drawing.drawing import Drawing
    >>> triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    >>> [root.name for root in convert(triangle).roots]
    ['drawing']
    """
    named = Parameters(
        split, select, tolerance, max_depth, capacity, precision, max_seconds, names, snap, restyle, fonts,
        images, page_colors,
    )  # fmt: skip
    if encoding == DEFAULT:
        refuse_unknown(others, (), encoding)
        conversion: Conversion[Any] = run(source, named)
    else:
        overrides = named.overrides
        if split is None:
            del overrides["split"]  # other encodings convert only silhouettes
        conversion = run_encoding(source, encoding, **overrides, **others)
    if isinstance(source, str | os.PathLike):
        warn_of(os.fspath(source), conversion.notes)
    else:
        warn_of_loss(conversion.drawing, conversion.notes)
    texture: EncodedTexture = conversion.texture
    return texture


def warn_of_loss(drawing: "Drawing", notes: Iterable[Note], *, stacklevel: int = 2) -> None:
    """Warn of the notes that a drawing does not have: `vexture.read` has already warned of those that it has."""
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
    images: ImageTreatment = "draw",
    page_colors: Mapping[str, str] | None = None,
) -> "Texture":
    """Convert many drawings into one texture, with one shape per drawing, or per layer if `split` is ``"paint"``.

    Parameters
    ----------
    sources : iterable of Drawing or path
        A shape is named after its drawing, or after its file without the last suffix. A layer is named
        ``name/layer``. An SVG that defines symbols and paints nothing becomes one shape per symbol, named after its id.
    name : str
        Name of the texture.
    split, select, tolerance, max_depth, capacity, precision, max_seconds, names, snap, restyle, fonts, images, \
page_colors
        As in `vexture.convert`, for each source.

    Returns
    -------
    Texture

    Raises
    ------
    ParameterError
        If two shapes have the same name, or there is no source. For other errors and warnings see `vexture.convert`.

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
        images, page_colors,
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
