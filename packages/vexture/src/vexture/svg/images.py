"""Images in an SVG (SVG 2, 12.3): drawings and pictures are drawn; pictures are traced, or left out, if requested.

Only data: URLs are read. If a folder is given, files in it and below are read, too, but not through symbolic links that
lead out.
"""

import binascii
import re
from base64 import b64decode
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final, Protocol, TypeAlias
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
from lxml import etree

from vexture.base.content import BEFORE_MARKUP, FileKind, kind_of, picture_size, read_bytes, start_of, unpack_source
from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, SourceError, shorten_text
from vexture.bezier.convert import line_cubics
from vexture.drawing.drawing import Drawing, FillRule
from vexture.svg.document import parse_svg
from vexture.svg.gradients import rows
from vexture.svg.links import reference
from vexture.svg.painter import Painter
from vexture.svg.pictures import EmbeddedPicture
from vexture.svg.report import Report
from vexture.svg.space import ContentWindow, ElementPlace
from vexture.svg.transform import Identity, Transform, map_points
from vexture.svg.viewport import THINNEST, Rectangle, own_size

DEEPEST: Final = 4
"""Deepest nesting of drawings in images."""

MOST_IMAGES: Final = 256
"""Most different images of a drawing, including those in its images."""

OUTSIDE: Final = "only files beside the drawing and in folders below are read"

BESIDE: Final = re.compile(r"(?![a-z][a-z0-9+.-]*:|[/\\])[^\0]+", re.IGNORECASE)
"""Link that can lead to a file in the folder: without a scheme, a host, or an absolute path."""

ADDRESS: Final = re.compile(r"(?!file:)[a-z][a-z0-9+.-]+:|//", re.IGNORECASE)
"""Link that leads to a server; a single letter before a colon is a drive."""

SHOWN: Final = 40
"""Longest file name in a message, in characters."""


ImageContent: TypeAlias = etree._Element | Drawing | EmbeddedPicture
"""Root of a drawing, or a picture, which is traced if it is a `Drawing`."""

MOST_PIXELS: Final = 100_000_000
"""Most pixels of all pictures of a drawing, as their files declare; each file has a limit of its own."""


@dataclass(frozen=True, slots=True)
class Images:
    """The images that a drawing may contain."""

    trace: Callable[[bytes], Drawing] | None = None  # traces a picture's content; None draws its pixels
    folder: Path | None = None  # folder with files that may be read
    depth: int = 0
    has_pictures: bool = True  # False leaves them out
    shown: dict[int, EmbeddedPicture] = field(default_factory=dict)  # pictures that are drawn, by the ids of pixels
    known: dict[tuple[int, str], ImageContent | SourceError | LimitError] = field(
        default_factory=dict
    )  # by depth and link

    @property
    def inside(self) -> "Images":
        """Images for a drawing in an image, which may contain images, but no links to files."""
        return replace(self, folder=None, depth=self.depth + 1)

    def read(self, link: str) -> ImageContent:
        """Return the root of a linked drawing, or a picture; raise a `SourceError` or `LimitError` otherwise.

        The error is the text of a note: it names the image, and the reason why it is left out.
        """
        key = self.depth, link
        if key not in self.known:
            if len(self.known) >= MOST_IMAGES:
                raise LimitError(f"{image_label(link)} (the drawing has more than {MOST_IMAGES} images)")
            try:
                self.known[key] = self.open_link(link)
            except (SourceError, LimitError) as error:
                self.known[key] = type(error)(f"{image_label(link)} ({error})")
        found = self.known[key]
        if isinstance(found, SourceError | LimitError):
            raise found
        return found

    def open_link(self, link: str) -> ImageContent:
        """Read an image as `read` does, but without the cache, and with errors that do not name the image."""
        content = unpack_source(decode_data_url(link) if is_embedded(link) else self.beside(link))
        start = start_of(content) or read_bytes(content)
        kind = kind_of(start)
        if kind is FileKind.PICTURE:
            return self.open_picture(read_bytes(content), link)
        if kind is not FileKind.SVG or not start.lstrip(BEFORE_MARKUP).startswith(b"<"):
            raise SourceError("it is empty" if not start else "it is no SVG, PNG, JPEG, WebP, GIF or BMP")
        if self.depth >= DEEPEST:
            raise LimitError(f"drawings in it are nested more than {DEEPEST} deep")
        return parse_svg(read_bytes(content))

    def open_picture(self, content: bytes, link: str) -> ImageContent:
        """Decode or trace a picture."""
        if not self.has_pictures:
            raise SourceError("pictures are left out")
        check_time()
        size = picture_size(content)
        pixels = 0 if size is None else size[1] * size[2]
        drawn = [*self.known.values()]
        if pixels + sum(int(each.size[0] * each.size[1]) for each in drawn if isinstance(each, EmbeddedPicture)) > (
            MOST_PIXELS
        ):
            raise LimitError(f"the pictures of the drawing have more than {MOST_PIXELS:,} pixels")
        if self.trace is not None:
            return self.trace(content)
        return EmbeddedPicture.from_content(content, image_label(link))

    def beside(self, link: str) -> Path:
        """Return the path of a file in the folder or below it."""
        path = unquote(link.partition("#")[0])
        if ADDRESS.match(path):
            raise SourceError("nothing is fetched from an address")
        if self.folder is None:
            owner = "an image of another drawing" if self.depth else "a drawing that is no file itself"
            raise SourceError(f"{owner} shows no files")
        if not BESIDE.fullmatch(path) or ".." in Path(path).parts:
            raise SourceError(OUTSIDE)
        folder = self.folder.resolve()
        try:
            file = (folder / path).resolve()
            is_there = file.is_file()
        except OSError:
            raise SourceError("its name is too long for a file") from None
        if not file.is_relative_to(folder):
            raise SourceError(OUTSIDE)
        if not is_there:
            raise SourceError("there is no such file beside the drawing")
        return file


def is_embedded(link: str) -> bool:
    """Return whether a link is a data: URL."""
    return link[:5].lower() == "data:"


def image_label(link: str) -> str:
    """Describe an image for a message: by its file name, or as embedded.

    Examples
    --------
    >>> image_label("pictures/a%20b.png#top"), image_label("https://example.org/a.png?x=/1"), image_label("data:,x")
    ("image 'a b.png'", "image 'a.png'", 'an embedded image')
    """
    if not is_embedded(link):
        place = re.split("[?#]", link, maxsplit=1)[0]
        name = re.split(r"[/\\:]", unquote(place).rstrip("/\\"))[-1] or place
        return f"image '{shorten_text(name, SHOWN)}'"
    try:
        content = decode_data_url(link)
    except SourceError:
        return "an embedded image"
    size = picture_size(content)
    if size is not None:
        kind, width, height = size
        return f"an embedded {kind} of {width} x {height}"
    return "an embedded image"


class ImageScene(Protocol):
    """The part of a scene that images need."""

    report: Report
    images: Images

    def fit(self, element: etree._Element, box: Rectangle, width: float, height: float) -> Transform:
        """Return the map from a view box to a viewport, according to the element's `preserveAspectRatio`."""

    def paint_embedded(self, root: etree._Element, place: ElementPlace, painter: Painter) -> None:
        """Paint another document at a place inside its viewport."""


def decode_data_url(link: str) -> bytes:
    """Decode the content of a data: URL (RFC 2397).

    Examples
    --------
    >>> decode_data_url("data:image/svg+xml,%3Csvg/%3E"), decode_data_url("data:;base64,PHN2 Zy8+")
    (b'<svg/>', b'<svg/>')
    >>> decode_data_url("data:image/svg+xml ; base64 ,PHN2Zy8+")  # spaces as in the Fetch standard, 6
    b'<svg/>'
    """
    head, comma, body = link.partition("#")[0].partition(",")
    if not comma:
        raise SourceError("its data: URL has no data")
    content = unquote_to_bytes(body)
    if not re.search("; *base64$", head.rstrip(" "), re.IGNORECASE):
        return content
    try:
        return b64decode(b"".join(content.split()))
    except binascii.Error:
        raise SourceError("its data is no base64") from None


def paint_image(scene: ImageScene, element: etree._Element, place: ElementPlace, painter: Painter) -> None:
    """Paint an image at a place with its own style, or note why not."""
    link = (reference(element) or "").strip()
    if not link or place.style["visibility"].lower() != "visible" or place.space.flat:
        return
    try:
        found = scene.images.read(link)
    except (SourceError, LimitError) as error:
        scene.report.left_out(str(error), element)
        return
    width, height = size_of(found)
    sides = image_sides(place, (width, height))
    if min(*sides[2:], width, height) < THINNEST:
        return
    content = Identity.translate(*sides[:2]).transform(scene.fit(element, (0.0, 0.0, width, height), *sides[2:]))
    is_cut = place.style["overflow"].lower() not in ("visible", "auto") or not isinstance(found, etree._Element)
    visible = sides if is_cut else None  # browsers show nothing of a picture beyond its sides
    inner = ContentWindow(visible, content, (width, height)).within(place)
    if isinstance(found, Drawing):
        paint_traced(scene, element, found, inner, painter)
    elif isinstance(found, EmbeddedPicture):
        paint_picture(scene, element, found, inner, painter)
    else:
        scene.paint_embedded(found, inner, painter)


def paint_picture(
    scene: ImageScene, element: etree._Element, found: EmbeddedPicture, place: ElementPlace, painter: Painter
) -> None:
    """Paint a picture as a rectangle; one unit of the place is a pixel of its file."""
    width, height = found.size
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    paint = found.paint_with(place.style["image-rendering"]).after(rows(place.space.whole.inverse()))
    painter.add([line_cubics(corners, np.roll(corners, -1, axis=0))], place, FillRule.NONZERO, paint, place.name)
    for remark in found.remarks:
        scene.report.simplification(f"{found.label} ({remark})", element)
    if found.is_turned and place.style["image-orientation"].lower() == "none":
        scene.report.simplification(
            f"{found.label} (it is turned upright, although image-orientation is none)", element
        )
    assert found.paint.picture is not None
    scene.images.shown[id(found.paint.picture.pixels)] = found


def paint_traced(
    scene: ImageScene, element: etree._Element, found: Drawing, place: ElementPlace, painter: Painter
) -> None:
    """Paint a traced picture; one unit of the place is a pixel of its file."""
    scene.report.simplification("<image> traced", element)
    (a, b, c), (d, e, f) = found.to_source.tolist()
    to_pixels = Transform(a, d, b, e, c, f)
    to_unit = rows(place.space.whole.transform(to_pixels).inverse())
    for path in found.paths:
        contours = [map_points(contour, to_pixels) for contour in path.contours]
        painter.add(contours, place, path.fill_rule, path.paint.after(to_unit), place.name)


def size_of(found: ImageContent) -> tuple[float, float]:
    """Return the width and height of a picture, or of a drawing in its own pixels."""
    if isinstance(found, Drawing):  # its pixels start at 0, 0 and are centred in the unit square
        (side, _, left), (_, _, bottom) = found.to_source.tolist()
        return side + 2.0 * left, 2.0 * bottom - side
    if isinstance(found, EmbeddedPicture):
        return found.size
    return own_size(found)


def image_sides(place: ElementPlace, size: tuple[float, float]) -> Rectangle:
    """Return position and size of an image; missing sides follow from the size of its content."""
    style, view = place.style, place.viewport
    wholes = {"x": view.width, "y": view.height, "width": view.width, "height": view.height}
    x, y, width, height = (view.length(style[name], whole, style.font_size) for name, whole in wholes.items())
    ratio = size[0] / size[1] if min(size) >= THINNEST else 1.0
    if width is None:
        width = size[0] if height is None else height * ratio
    return x or 0.0, y or 0.0, width, width / ratio if height is None else height
