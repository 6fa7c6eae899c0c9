"""Reading SVG: the shapes of a drawing and their paints."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from vexture.base.content import about, decompress, read_bytes
from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Note, warn_of
from vexture.drawing.drawing import Drawing
from vexture.fonts.places import font_places
from vexture.svg.compositing import drop_empty_groups, has_colors
from vexture.svg.document import parse_svg
from vexture.svg.frames import EMPTY, Frame, frame, painted_frame
from vexture.svg.images import Images
from vexture.svg.note_elements import subject_of
from vexture.svg.page import CURRENT_IS_BLACK, Page, unused_colors
from vexture.svg.report import Report
from vexture.svg.scene import SvgScene
from vexture.svg.select import UNPAINTED, SelectedPart, chosen, nothing_painted, unpainted_note, with_symbols_used
from vexture.svg.transform import Transform
from vexture.svg.unsupported import ANIMATION
from vexture.svg.viewport import Rectangle

REVEALED: Final = "what only an animation shows is drawn as that shows it"
EMPTY_TOO: Final = "its animations show nothing more"


def read_svg(
    path: str | os.PathLike[str],
    select: str | None = None,
    names: str | None = None,
    fonts: Sequence[str | os.PathLike[str]] = (),
    page_colors: Mapping[str, str] | None = None,
) -> Drawing:
    """Read an SVG file, plain or gzipped.

    Shapes, paths, texts, groups, `use`, `symbol`, `switch`, nested `svg`, transforms, CSS and strokes are drawn as
    browsers draw them. Opacity, blend modes, clips and masks that need several paths together become
    `Drawing.groups`. Gradients are read in full (`Paint.gradient`), patterns as the paths of their tiles, markers as
    the paths of their content. Drawings that are images are read, too, embedded or as files beside the drawing and in
    folders below; `vexture.read` also traces pictures, if asked to. What is not supported is left out and named.
    Paths are named (`Path.element`) by the ``id`` of their element or of the nearest one around it, and all that a
    `use`, a marker or a pattern shows by that of the `use` or the shape; a stroke is ``id/stroke``.

    The box of the drawing is the outermost viewport: `width` and `height`, or the size in `viewBox` where one of them
    is missing or a percentage. A side that none of them says is 300 or 150 pixels long, as in browsers, with a note.

    Parameters
    ----------
    path : str or path-like
        The file.
    select : str, optional
        A CSS selector. Only elements that match are painted, with all their content, including what `use` shows. The
        box of the whole drawing stays, so that parts of one drawing lie on one another.
    names : str, optional
        What names elements instead of ``id``: an attribute, such as ``inkscape:label`` or ``data-name``, or ``title``,
        the element that holds an element's title. Paths without it have the name of what is around them.
    fonts : sequence of path
        Font files, and folders of them, for texts. They come before the fonts in the drawing and those of the system.
    page_colors : mapping of str to str, optional
        CSS colours that the page around the drawing would give it: of ``currentColor``, of ``context-fill`` and
        ``context-stroke``, and of custom properties, such as ``--primary``. What the drawing says itself wins.

    Returns
    -------
    Drawing
        In the unit square, y up; `to_source` maps it to the user units of the outermost `<svg>`, before its `transform`
        if it has one. It has no paths if nothing is painted. Its `notes` say this, and what was left out, simplified or
        invalid.

    Raises
    ------
    SourceError
        If the file cannot be read, is not SVG or exceeds a limit.
    ParameterError
        If `select` is no selector, `page_colors` holds another name or no colour, or a parameter is of the wrong type.
    LimitError
        If `select` matches nothing that is painted.

    Warns
    -----
    SourceWarning
        Once for a file, with all notes.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "half.svg"
    ...     _ = file.write_text('<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>')
    ...     drawing = read_svg(file)
    >>> drawing.name, drawing.segments
    ('half', 4)
    >>> drawing.paths[0].contours[0][:, 0]
    array([[0. , 1. ],
           [1. , 1. ],
           [1. , 0.5],
           [0. , 0.5]])
    """
    with about(os.fspath(path)):
        content = read_bytes(path)
    images = Images(folder=Path(path).parent)
    drawing = svg_drawing(content, os.fspath(path), select, names, fonts, images, page_colors)
    warn_of(os.fspath(path), drawing.notes)
    return drawing


def svg_drawing(
    content: bytes,
    source: str,
    select: str | None = None,
    names: str | None = None,
    fonts: Sequence[str | os.PathLike[str]] = (),
    images: Images | None = None,
    page_colors: Mapping[str, str] | None = None,
) -> Drawing:
    """Read the content of an SVG file, plain or gzipped, as `read_svg` does, but without a warning.

    `source` is the name of the file: it names the drawing and stands in messages, and is not opened. Of its images only
    embedded drawings are shown, unless `images` says more.

    Examples
    --------
    >>> svg_drawing(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', "half.svg").name
    'half'
    """
    return framed_drawing(content, source, select, names, fonts, images, page_colors)[0]


def framed_drawing(
    content: bytes,
    source: str,
    select: str | None = None,
    names: str | None = None,
    fonts: Sequence[str | os.PathLike[str]] = (),
    images: Images | None = None,
    page_colors: Mapping[str, str] | None = None,
) -> tuple[Drawing, Frame | None]:
    """Read as `svg_drawing` does, and return the frame of the whole drawing too."""
    named, page = "id" if names is None else names, Page.from_colors(page_colors)
    with about(source):
        for name, value in (("select", select), ("names", names)):
            if value is not None and not isinstance(value, str):
                raise ParameterError(f"`{name}` is {value!r:.80}; it must be text")
        root = parse_svg(decompress(content))
        unused = unused_colors(page, root) if page.colors else ()
        part = None if select is None else partial(select_part, select=select)
        found = read_document(Request(root, Path(source).stem, part, named, fonts, images or Images(), page))
        if select is not None and not found.drawing.paths and found.chosen:
            raise nothing_painted(select, found.chosen)
    return replace(found.drawing, notes=(*found.drawing.notes, *unused)), found.frame


@dataclass(frozen=True, slots=True)
class Request:
    """A document to read, and how to read it."""

    root: etree._Element  # which reading changes
    name: str
    part: Callable[[etree._Element], SelectedPart] | None  # finds what is chosen
    names: str
    fonts: Sequence[str | os.PathLike[str]]
    images: Images
    page: Page

    def __post_init__(self) -> None:
        font_places(self.fonts, "fonts")


@dataclass(frozen=True, slots=True)
class ReadResult:
    """The drawing read from a document."""

    drawing: Drawing
    frame: Frame | None
    chosen: int  # elements that were chosen


def select_part(root: etree._Element, select: str) -> SelectedPart:
    """Select the part of a document to paint."""
    return with_symbols_used(root, chosen(root, select))


def read_document(request: Request) -> ReadResult:
    """Read a document, or a part of it."""
    report, root = Report(), request.root
    try:
        part = None if request.part is None else request.part(root)
        elements = None if part is None else part.elements
        scene = SvgScene(root, report, request.images, elements, request.names, request.fonts, request.page)
        framed = painted_frame(scene) if part is not None and part.is_unframed else frame(scene)
        drawing, to_pixels = drawing_of(scene, framed, request.name)
    except RecursionError:  # tinycss2 and cssselect2 recurse into brackets
        raise SourceError("its style sheet nests brackets too deeply; simplify it") from None
    if scene.servers.cascade.reveals:
        report.remark(REVEALED)
    if scene.servers.lacks_color and has_colors(drawing):  # of one colour, it is a shape for any
        report.remark(CURRENT_IS_BLACK)
    notes = report.about(lambda element: subject_of(element, scene.names, scene.boxes, to_pixels))
    if not drawing.paths:
        notes = *without_animation(notes), unpainted_note(root) if part is None else Note("remark", UNPAINTED)
    return ReadResult(replace(drawing, notes=notes), None if framed is EMPTY else framed, len(elements or ()))


def without_animation(notes: tuple[Note, ...]) -> tuple[Note, ...]:
    """Notes of a drawing that is empty with its animations, too, and so loses nothing by them."""
    kept = tuple(note for note in notes if note.message != ANIMATION)
    return kept if len(kept) == len(notes) else (*kept, Note("remark", EMPTY_TOO))


def drawing_of(scene: SvgScene, framed: Frame, name: str) -> tuple[Drawing, NDArray[np.float64] | None]:
    """Paint a scene into the frame that its outermost element sets.

    Return the map from the unit square to pixels, too, if there is one.
    """
    if framed is EMPTY:
        return Drawing((), name=name), None
    size, viewport, matrix = framed
    box: Rectangle = (0.0, 0.0, *size)
    paths, groups = scene.paint(viewport, matrix, box, size)
    drawing = Drawing.from_source(paths, box, name, groups)
    shown, groups = drop_empty_groups(drawing.paths, groups)
    to_source = after(drawing.to_source, matrix.inverse())
    return replace(drawing, paths=shown, groups=groups, to_source=to_source), drawing.to_source


def after(first: NDArray[np.float64], second: Transform) -> NDArray[np.float64]:
    """Affine map (2, 3) that applies `first` and then `second`."""
    a, b, c, d, e, f = second
    linear = np.einsum("ij,jk->ik", [[a, c], [b, d]], first)
    product: NDArray[np.float64] = linear + np.array([[0.0, 0.0, e], [0.0, 0.0, f]])
    return product
