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
from vexture.svg.blur_budget import fit_blurs
from vexture.svg.compositing import drop_empty_groups, has_colors
from vexture.svg.document import parse_svg
from vexture.svg.frames import EMPTY, Frame, frame, painted_frame
from vexture.svg.images import Images
from vexture.svg.note_elements import subject_of
from vexture.svg.page import CURRENT_IS_BLACK, Page, unused_colors
from vexture.svg.pictures import fit_into_budget
from vexture.svg.report import Report
from vexture.svg.scene import SvgScene
from vexture.svg.select import UNPAINTED, SelectedPart, chosen, nothing_painted, unpainted_note, with_symbols_used
from vexture.svg.transform import Transform
from vexture.svg.unsupported import ANIMATION
from vexture.svg.viewport import Rectangle

REVEALED: Final = "parts that only an animation makes visible are drawn as it shows them"
EMPTY_TOO: Final = "its animations show nothing more"


def read_svg(
    path: str | os.PathLike[str],
    select: str | None = None,
    names: str | None = None,
    fonts: Sequence[str | os.PathLike[str]] = (),
    page_colors: Mapping[str, str] | None = None,
) -> Drawing:
    """Read an SVG file, plain or gzipped.

    Shapes, paths, texts, groups, `use`, `symbol`, `switch`, nested `svg`, transforms, CSS and strokes are drawn as in
    browsers. Opacity, blend modes, clips and masks that affect several paths together become `Drawing.groups`.
    Gradients are read in full (`Paint.gradient`), patterns as the paths of their tiles, markers as the paths of their
    content. Images are read, too, whether embedded or in files in the folder of the drawing and below: drawings, and
    pictures as the paints of rectangles (`Paint.picture`), which `vexture.read` can also trace or leave out. Notes list
    everything unsupported, which is left out. A path is named (`Path.element`) by the ``id`` of its element or of the
    nearest element around it; the content of a `use`, a marker or a pattern by that of the `use` or the shape; a stroke
    is ``id/stroke``.

    The box of the drawing is the outermost viewport: `width` and `height`, or the size in `viewBox` if one of them is
    missing or a percentage. A side that neither gives is 300 or 150 pixels long, as in browsers, with a note.

    Parameters
    ----------
    path : str or path-like
        The file.
    select : str, optional
        A CSS selector. Only matching elements are painted, with all their content, including that of `use`. The box
        stays that of the whole drawing, so that separately read parts of a drawing fit together.
    names : str, optional
        Source of names instead of ``id``: an attribute, such as ``inkscape:label`` or ``data-name``, or ``title``, the
        element with an element's title. Paths without such a name get that of the elements around them.
    fonts : sequence of path
        Font files, and folders of font files, for texts. They precede the fonts in the drawing and those of the system.
    page_colors : mapping of str to str, optional
        CSS colours that a page would pass to the drawing: for ``currentColor``, for ``context-fill`` and
        ``context-stroke``, and for custom properties such as ``--primary``. The drawing's own values take precedence.

    Returns
    -------
    Drawing
        In the unit square, y up. `to_source` maps it to the user units of the outermost `<svg>`, before its
        `transform`, if any. Without painted content it has no paths. Its `notes` list this, and everything that was
        left out, simplified or invalid.

    Raises
    ------
    SourceError
        If the file cannot be read, is not SVG or exceeds a limit.
    ParameterError
        If `select` is not a selector, `page_colors` has an invalid name or colour, or a parameter has the wrong type.
    LimitError
        If `select` matches nothing that is painted.

    Warns
    -----
    SourceWarning
        Once for each file, with all notes.

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

    `source` is the name of the file, for the drawing and for messages; it is not opened. Without `images`, only
    embedded drawings are shown.

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
    """Read as `svg_drawing` does, and also return the frame of the whole drawing."""
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
    """A document to read, with parameters."""

    root: etree._Element  # reading changes it
    name: str
    part: Callable[[etree._Element], SelectedPart] | None  # finds the selected part
    names: str
    fonts: Sequence[str | os.PathLike[str]]
    images: Images
    page: Page

    def __post_init__(self) -> None:
        font_places(self.fonts, "fonts")


@dataclass(frozen=True, slots=True)
class ReadResult:
    """The result of reading a document."""

    drawing: Drawing
    frame: Frame | None
    chosen: int  # number of selected elements


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
        paths, groups = drop_empty_groups(fit_blurs(drawing.paths, report), drawing.groups)
        paths = fit_into_budget(paths, [*request.images.shown.values()], report)
        drawing = replace(drawing, paths=paths, groups=groups)
    except RecursionError:  # tinycss2 and cssselect2 recurse into brackets
        raise SourceError("its style sheet nests brackets too deeply; simplify it") from None
    if scene.servers.cascade.reveals:
        report.remark(REVEALED)
    if scene.servers.lacks_color and has_colors(drawing):  # a drawing of one colour can be used in any colour
        report.remark(CURRENT_IS_BLACK)
    notes = report.about(lambda element: subject_of(element, scene.names, scene.boxes, to_pixels))
    if not drawing.paths:
        notes = *without_animation(notes), unpainted_note(root) if part is None else Note("remark", UNPAINTED)
    return ReadResult(replace(drawing, notes=notes), None if framed is EMPTY else framed, len(elements or ()))


def without_animation(notes: tuple[Note, ...]) -> tuple[Note, ...]:
    """Return the notes of a drawing that is empty even with its animations, and so loses nothing without them."""
    others = tuple(note for note in notes if note.message != ANIMATION)
    return others if len(others) == len(notes) else (*others, Note("remark", EMPTY_TOO))


def drawing_of(scene: SvgScene, framed: Frame, name: str) -> tuple[Drawing, NDArray[np.float64] | None]:
    """Paint a scene into the frame that its outermost element sets.

    Also return the map from the unit square to pixels, if there is one.
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
    """Return the affine map (2, 3) that applies `first` and then `second`."""
    a, b, c, d, e, f = second
    linear = np.einsum("ij,jk->ik", [[a, c], [b, d]], first)
    product: NDArray[np.float64] = linear + np.array([[0.0, 0.0, e], [0.0, 0.0, f]])
    return product
