"""What is fuzzed: each reader of untrusted bytes, with what it may promise about them.

A reader returns what it understood, as text that is alike for alike behaviour; it raises an error of `EXPECTED` or a
`FindingError`, and anything else that it raises is a finding, too.
"""

import tempfile
import unicodedata
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random

import numpy as np
from comparison import MOST, Case, SlowError, case_of
from javascript import loader
from lxml import etree
from map_files import SEEDS, read_floats, read_map
from mutate import png_repaired, zip_repaired
from pictures import describe_finding, finding_of, smallest

from degenerate import OUTLINES, heap
from vexture.base.errors import EXPECTED, SourceWarning
from vexture.conversion.pipeline import convert
from vexture.conversion.reading import read_drawing
from vexture.drawing.colors import parse_color, parse_paint
from vexture.drawing.drawing import Drawing, FillRule
from vexture.fold.fold import fold_from
from vexture.fonts.face import faces_in
from vexture.fonts.shaping import shape
from vexture.gltf.model import read_model
from vexture.renderers.exact import render_exact
from vexture.svg.clip_shapes import clip_element
from vexture.svg.path_data import path_outlines
from vexture.svg.select import chosen
from vexture.svg.transform import parse_origin, parse_transform
from vexture.svg.values import Viewport, fraction, number
from vexture.svg.viewport import parse_fit, view_box
from vexture.texture.load import texture_from
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.thesis.texture import load as load_thesis

CORPUS = Path(__file__).parent / "corpus"
ROOT = Path(__file__).parents[2]
LONGEST_MESSAGE = 500
LARGEST_ERROR = 1 / 255
"""Of the coverage of degenerate drawings, in pixels that are whole cells and in those that cut cells."""

PNG = b"\x89PNG\r\n\x1a\n"
PLACES = np.array([((i % 4) / 4 + 0.103, i // 4 / 4 + 0.157) for i in range(16)])
"""Where the loaders of web/src are asked what is inside, too (`reader.mjs`)."""

QUARTER = Texture(np.array([[[0, 0, 0, 0xFF]]], np.uint32), (Root("a quarter"),))

NO_XML = bytes(byte for byte in range(32) if byte not in b"\t\n\r")
"""Characters that XML cannot contain, so that no attribute has them."""

VIEWPORT = Viewport(200.0, 100.0)
ELEMENT = etree.fromstring('<svg><g id="a"><path class="b"/></g></svg>')
PARSERS = (
    parse_color,
    parse_paint,
    lambda text: parse_transform(text, lambda part, axis: VIEWPORT.length(part, 100.0, 16.0)),
    lambda text: parse_origin(text, lambda part, axis: VIEWPORT.length(part, 100.0, 16.0)),
    lambda text: clip_element(text, lambda name: (1.0, 2.0, 40.0, 30.0), 16.0, 16.0),
    view_box,
    parse_fit,
    lambda text: chosen(ELEMENT, text),
    number,
    lambda text: VIEWPORT.length(text, 100.0, 16.0),
)

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><style>%s</style><g id="a" class="b c" style="%s">'
BODY = b'<rect id="r" x="1" width="4" height="3"/><path class="c" d="M1 1h5v7z"/></g></svg>'


class FindingError(Exception):
    """A reader broke a promise."""


@dataclass(frozen=True, slots=True)
class Target:
    """A reader, and how its files are damaged."""

    read: Callable[[bytes], str]
    tokens: tuple[bytes, ...] = ()
    text: bool = False
    make: Callable[[Random], bytes] | None = None  # instead of damage to the files of the corpus
    repair: Callable[[bytes], bytes] | None = None  # checksums
    other_seeds: str = ""  # pattern of files elsewhere in the repository
    shrink: Callable[[bytes], bytes] | None = None  # instead of leaving out bytes
    patience: float = 1.0  # times the seconds that an input may take
    in_a_second: int = 200  # runs, about

    @property
    def of_a_test(self) -> int:
        """Runs in the ordinary tests: those of half a second."""
        return -(-self.in_a_second // 2)

    def seeds(self, name: str) -> list[bytes]:
        """Contents of its corpus, in the order of the files' names, and files that are made."""
        folder = CORPUS / name.removesuffix("-js")
        files = sorted(folder.iterdir()) if folder.is_dir() else []
        files += sorted(ROOT.glob(self.other_seeds) if self.other_seeds else ())
        return [file.read_bytes() for file in files if "bomb" not in file.name] + SEEDS.get(name, list)()


def drawing(suffix: str) -> Callable[[bytes], str]:
    """Reader of a drawing's file, through the one gate of all commands and servers."""

    def read(data: bytes) -> str:
        found = read_drawing(data, name=f"file{suffix}")
        check_drawing(found)
        return f"{len(found.paths)} {found.crs} {sorted({note.message for note in found.notes})}"

    return read


def check_drawing(found: Drawing) -> None:
    """A drawing is closed contours in the unit square."""
    for path in found.paths:
        for contour in path.contours:
            if not np.isfinite(contour).all():
                raise FindingError("a contour is not finite")
            if contour[:, [0, 3]].min() < 0.0 or contour[:, [0, 3]].max() > 1.0:
                raise FindingError(f"a contour leaves the unit square: {contour[:, 0].min()} to {contour[:, 0].max()}")
            if (contour[:, 3] != np.roll(contour[:, 0], -1, axis=0)).any():
                raise FindingError("a contour is open")


def read_css(data: bytes) -> str:
    """A style sheet and a style attribute, between <style> and in `style`."""
    sheet, _, attribute = data.translate(None, b"<>&").partition(b"\n---\n")
    style = attribute.replace(b'"', b"'")
    return drawing(".svg")(SVG % (sheet, style) + BODY)


def read_path(data: bytes) -> str:
    """Path data: all that is valid becomes finite outlines."""
    text = data.decode("latin-1")
    outlines, valid = path_outlines(text, 1e-3)
    if not 0 <= valid <= len(text):
        raise FindingError(f"{valid} of {len(text)} characters are valid")
    return f"{len(outlines)} {valid == len(text)} {[outline.closed for outline in outlines][:4]}"


def read_values(data: bytes) -> str:
    """One attribute's text, by every parser of values."""
    text = data.translate(None, NO_XML).decode("latin-1")
    part = fraction(text)
    if part is not None and not 0.0 <= part <= 1.0:
        raise FindingError(f"fraction {part}")
    return str([parse_text(parse, text) for parse in PARSERS])


def parse_text(parse: Callable[[str], object], text: str) -> str:
    try:
        return str(parse(text) is not None)
    except EXPECTED as error:
        check_line(str(error))
        return str(error)


def read_packed(data: bytes) -> str:
    """A packed texture: what is accepted is written as it was, and can be drawn and described."""
    texture = texture_from(data, "file.ktx2")
    again = texture_from(texture.to_ktx2(), "file.ktx2")
    if not np.array_equal(again.texels, texture.texels) or len(again.roots) != len(texture.roots):
        raise FindingError("a texture changes when it is written and read")
    drawn = texture.coverage(5, root=0)
    if not np.isfinite(drawn).all():
        raise FindingError("a coverage is not finite")
    if not texture.roots[0].is_map:
        texture.to_svg(0)
    return f"{texture.depth} {len(texture.roots)} {texture.info().keys()}"


def read_fold(data: bytes) -> str:
    """A fold: what is accepted is written as it was."""
    fold = fold_from(data, "file.fold.ktx2")
    if fold_from(fold.to_ktx2(), "file.fold.ktx2").to_ktx2() != fold.to_ktx2():
        raise FindingError("a fold changes when it is written and read")
    return f"{fold.size}"


def read_gltf(data: bytes) -> str:
    """A model: what is accepted gets a texture, and has all that it had."""
    model = read_model(data, name="model")
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        changed = model.with_drawing(0, QUARTER)
    (written,) = changed.files("model.glb").values()
    again = read_model(written)
    before, after = (dict(each.container.document) for each in (model, again))
    for name in ("buffers", "bufferViews", "images", "materials", "extensions", "extensionsUsed"):
        before.pop(name, None), after.pop(name, None)
    if before != after or model.materials != again.materials or again.container.others != model.container.others:
        raise FindingError("a model changes when it is written and read")
    return str(model.materials)


def read_thesis(data: bytes) -> str:
    """A pair of files, one after the other: what is accepted can be drawn."""
    second = max(data.rfind(PNG), 0)
    with tempfile.TemporaryDirectory() as folder:
        for part, name in ((data[:second], "file.quads.png"), (data[second:], "file.curves.png")):
            Path(folder, name).write_bytes(part)
        try:
            texture = load_thesis(Path(folder, "file"))
        except EXPECTED as error:
            raise type(error)(str(error).replace(folder, "")) from None
    if not np.isfinite(texture.coverage(5)).all():
        raise FindingError("a coverage is not finite")
    return f"{texture.bits} {texture.depth}"


def read_font(data: bytes) -> str:
    """A font: all that a text asks of its faces, outlines and colours."""
    faces = faces_in(data)
    for face in faces:
        shaped = [glyph.glyph for glyph in shape(face, "AVA\u0627\u0644 ")]
        for glyph in (*shaped, 0, 5, face.glyph_count - 1, face.glyph_count):
            layers = face.layers(glyph)
            contours = (
                [contour for path in layers.paths for contour in path.contours] if layers else face.outline(glyph)
            )
            if not all(np.isfinite(contour).all() for contour in contours):
                raise FindingError("a contour is not finite")
        metrics = (face.ascender, face.descender, face.x_height, face.cap_height, *face.underline, *face.vertical)
        if not np.isfinite(metrics).all() or face.units_per_em <= 0:
            raise FindingError("a metric is not finite")
        face.with_style(700.0, 80.0, "italic").outline(1)
    return f"{len(faces)} {[face.names for face in faces]}"


def read_geometry(data: bytes) -> str:
    """A recipe of `degenerate.heap` and a size: its texture is drawn as the exact renderer draws the drawing."""
    seed, counts, distance, rule, kind, size = data.decode().split()
    drawing = heap(int(seed), [*map(int, counts.split(","))], float(distance), FillRule(int(rule)), kind)
    width = int(size)
    texture = convert(drawing)
    error = np.abs(texture.coverage(width) - render_exact(drawing, width)).max()
    if not error <= LARGEST_ERROR:
        raise FindingError(f"{kind}: an error of {255 * error:.1f}/255 at {width} pixels")
    return f"{kind} {texture.depth} {texture.texels.shape[0]}"


def recipe(rng: Random) -> bytes:
    """A random input of `read_geometry`."""
    counts = ",".join(str(rng.choice((1, 1, 2, 3, 16, 40))) for _ in range(rng.randrange(1, 5)))
    counts = "200" if rng.random() < 0.05 else counts
    distance = rng.choice((0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6))
    size = rng.choice((1, 8, 16, 32, 64, 128, 24, 33, 50, 100))
    kind = rng.choice([*OUTLINES])
    return f"{rng.randrange(10**9)} {counts} {distance} {rng.randrange(2)} {kind} {size}".encode()


def read_picture(data: bytes) -> str:
    """Compare the picture of a drawing's texture, in a view, with the exact one; that this takes long is no fault."""
    case = Case.parsed(data)
    try:
        found = finding_of(case)
    except SlowError:
        return "slow"
    if not found["gap"] <= MOST:
        raise FindingError(describe_finding(found, case.sight.size))
    return case.sight.name


def make_picture(has_gradients: bool) -> Callable[[Random], bytes]:
    """Random drawings in random views, as `read_picture` takes them."""

    def make_input(rng: Random) -> bytes:
        while (case := case_of(str(rng.randrange(10**9)), has_gradients)) is None:
            pass
        return case.file()

    return make_input


def shrink_picture(data: bytes) -> bytes:
    case = Case.parsed(data)
    return smallest(case, finding_of(case)["gap"]).file()


def in_javascript(kind: str, read: Callable[[bytes], str]) -> Callable[[bytes], str]:
    """Reader by web/src, which accepts the files that Python accepts, and no others."""

    def both(data: bytes) -> str:
        answer = loader(kind).answer(data)
        if "fault" in answer:
            raise FindingError(answer["fault"])
        try:
            read(data)
        except EXPECTED as error:
            if "error" not in answer:
                raise FindingError(f"only Python refuses it: {error}") from None
            check_line(answer["error"])
            raise
        if "error" in answer:
            raise FindingError(f"only JavaScript refuses it: {answer['error']}")
        if kind == "packed":
            inside_alike(texture_from(data, "file"), answer["inside"])
        return str(answer)

    return both


def inside_alike(texture: Texture, inside: list[bool]) -> None:
    """Python finds the same points inside."""
    if not texture.roots[0].is_map and texture.contains(PLACES, 0).tolist() != inside:
        raise FindingError("Python and JavaScript find other points inside")


def check_line(message: str) -> None:
    """A message is one line that any terminal prints."""
    kinds = {unicodedata.category(character) for character in message}
    if not message or kinds & {"Cc", "Cs", "Zl", "Zp"}:
        raise FindingError(f"a message is not one line of text\n{message!r}")
    if len(message) > LONGEST_MESSAGE:
        raise FindingError(f"a message is too long\n{message!r}")


def words(text: str) -> tuple[bytes, ...]:
    return tuple(text.encode("latin-1").split())


VALUES = words(
    "0 -1 1e300 1e-300 nan 1e12 -1e12 1e9 00000 . - e % em rem q deg turn auto none inherit currentColor z A M0 # "
    "url(#a) ( ) , ; : / ! \" ' \\ rgb( hsl( lab(1 oklch( color(display-p3 color() hwb( var(--a) calc(1px) !important "
    "matrix(1 scale(0) rotate( skewX(90) translate( xMidYMid meet slice left center unset revert \xff \x00 \xa0"
)
MARKUP = words(
    "< > / & &amp; &#0; &#x10ffff; <!-- --> <![CDATA[ ]]> <!DOCTYPE <?xml = id=a href=#a xlink:href='#a' <g> </g> <use "
    "<svg <path <clipPath <linearGradient <pattern <symbol <switch <style> style=' transform=' viewBox=' d=' width=0"
)
CSS = words("{ } [ ] @media @import @ * > + ~ :not( :is( ::x :nth-child(2n+1) .b #a [id=a] g|a \\0 /* */")
PATH = words(
    "M m L l H h V v C c S s Q q T t A a Z z 0 1 -1 .5 1e1 1e-9 1e99 1e308 -.0 1.2.3 0,0 1-1 110 e , \x00 \xa0"
)
JSON = words(
    'null true false [] {} [ ] { } , : "" "type" "Polygon" "MultiPolygon" "coordinates" "features" "Feature" '
    '"geometry" "crs" "EPSG:4326" "GeometryCollection" NaN Infinity -0 1e999 9e9 \\u0000 \\ud800 \xff '
    "[[[0,0],[1,0],[1,1],[0,0]]]"
)
KTX = words('"name" "quad" "transform" "paint" "crs" [ ] { } , : null -1 1e999 1.0 0.5 \\ud800 \x80 \xff vexture.roots')
GLTF = JSON + words(
    '"uri" "buffer" "bufferView" "byteLength" "byteOffset" "extensions" "data:;base64," "../a" 4294967295'
)
FEATURES = MARKUP + words("nan 1e999 -0 4,52 180 -181 91 <Point> <coordinates> <gml:pos> srsName= <trkseg> <Data ]]>")
TABLE = words(
    'POLYGON EMPTY Z M ZM (( )) ( ) , ; " 1e999 nan CIRCULARSTRING COMPOUNDCURVE CURVEPOLYGON TIN POINT 0106 lon wkt'
)
BINARY = (b"\0\0\0\0", b"\xff\xff\xff\xff", b"\0\0\x80\x7f", b"\0\0\xc0\x7f", b"\x7f\xf0\0\0\0\0\0\0", b"\x80")

TARGETS = {
    "svg": Target(drawing(".svg"), VALUES + MARKUP + CSS, text=True, other_seeds="tests/core/svg/fixtures/*/*.svg"),
    "css": Target(read_css, VALUES + CSS, text=True),
    "path": Target(read_path, PATH, text=True, in_a_second=2000),
    "values": Target(read_values, VALUES, text=True, in_a_second=2000),
    "geojson": Target(drawing(".geojson"), JSON, text=True),
    "packed": Target(read_packed, KTX, in_a_second=2000),
    "fold": Target(read_fold, KTX, in_a_second=2000),
    "gltf": Target(read_gltf, GLTF, in_a_second=1000),
    "thesis": Target(read_thesis, BINARY, repair=png_repaired),
    "packed-js": Target(in_javascript("packed", read_packed), KTX),
    "fold-js": Target(in_javascript("fold", read_fold), KTX),
    "thesis-js": Target(in_javascript("thesis", read_thesis), BINARY, repair=png_repaired),
    "font": Target(read_font, BINARY, in_a_second=1000),
    "geometry": Target(read_geometry, make=recipe, in_a_second=2),
    "pictures": Target(read_picture, make=make_picture(False), shrink=shrink_picture, patience=6.0, in_a_second=2),
    "gradients": Target(
        read_picture, make=make_picture(True), shrink=shrink_picture, patience=6.0, in_a_second=0
    ),  # not exact yet
    "gzip": Target(drawing(".svgz")),
    "picture": Target(drawing(".png"), BINARY, repair=png_repaired, in_a_second=50),
    "geotiff": Target(drawing(".tif"), BINARY),
    "netcdf": Target(drawing(".nc"), BINARY, in_a_second=20),
    "geopackage": Target(drawing(".gpkg"), BINARY),
    "flatgeobuf": Target(drawing(".fgb"), BINARY),
    "shapefile": Target(drawing(".zip"), BINARY, repair=zip_repaired),
    "kml": Target(read_map, FEATURES, text=True, in_a_second=50),
    "kmz": Target(read_map, FEATURES, repair=zip_repaired, in_a_second=50),
    "gpx": Target(read_map, FEATURES, text=True, in_a_second=50),
    "gml": Target(read_map, FEATURES, text=True, in_a_second=50),
    "csv": Target(read_map, TABLE, text=True, in_a_second=50),
    "curves": Target(read_map, TABLE, text=True, in_a_second=100),
    "feather": Target(read_map, BINARY),
    "parquet": Target(read_map, BINARY),
    "asc": Target(drawing(".asc"), text=True, in_a_second=50),
    "flt": Target(read_floats, BINARY, in_a_second=50),
    "grib": Target(drawing(".grib2"), (*BINARY, b"GRIB", b"7777"), in_a_second=50),
}
"""By name, which is that of a folder of the corpus, or of `SEEDS`; those of JavaScript read their Python target's."""
