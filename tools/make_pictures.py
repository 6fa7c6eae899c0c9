"""Draw the README's pictures by the program itself: `python tools/make_pictures.py` writes docs/pictures/*.png.

A logo close to and far away, beside a PNG of as many bytes; a drawing, the tree of cells that it becomes, the pair of
textures that holds the tree, and what the shader's mirror draws from those textures: magnified, each time around the
same point, and at small sizes. `python tools/make_pictures.py logo` makes one of the pictures. Logos and icons come
from npm.
"""

import io
import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageColor, ImageDraw, ImageFont

import vexture
from vexture.renderers.view import window
from vexture.thesis.decode import decode
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree
from vexture_evidence.figures.textures import texture_images
from vexture_evidence.measures.leaves import leaves
from vexture_evidence.measures.raster import footprint, mip_sides, trilinear

ROOT = Path(__file__).resolve().parents[1]
SHAPE = ROOT / "examples" / "shapes" / "duck.svg"
TARGET = ROOT / "docs" / "pictures" / "first.png"
PACKED_TARGET = TARGET.with_name("packed.png")
ICONS_TARGET = TARGET.with_name("icons.png")
EQUAL_TARGET = TARGET.with_name("equal-bytes.png")
LOGO_TARGET = TARGET.with_name("logo.png")
LETTERING = SHAPE.with_name("font.svg")
LOGO = "python/python-original.svg"  # of devicon
LOGO_POINT, LOGO_ZOOMS = (0.49951, 0.72263), (1, 10, 300)  # a corner of it

PANEL, GAP, CAPTION = 360, 28, 44  # pixels
FINER = 4  # times the pixels that lines are drawn in
PAPER, INK, SHADE = "#ffffff", "#e09600", "#f7dfb0"  # SHADE: of a cell that is full
TITLE, TEXT, FRAME, GRID, CURVE = "#14213d", "#6b7688", "#d5dae2", "#a9b2c0", "#1d3557"
SIZES = (128, 64, 32, 16)  # pixels, of the small pictures
ZOOMS = (1, 4, 32, 256)
ICON, ICON_GRID = 72, (14, 4)  # pixels; columns and rows
LEANING = np.array([[0.9, 0.0, -0.45], [0.0, -0.26, 0.26], [0.0, 0.75, 0.25]]) @ np.diag([1 / PANEL, 1 / PANEL, 1.0])
LEANING[0] += 0.5 * LEANING[2]  # a plane that leans back, its far end at the top; the third row is its nearness
COAST_EDGES, COAST_POINT, COAST_ZOOMS = 98_304, 40_000, (1, 100, 10_000)

CENTER = (206 / 240, 1 - 79 / 240)  # unit-square units: where the duck opens its bill

Panel = tuple[str, str, Image.Image]


def draw_ink(coverage: NDArray[np.float32]) -> Image.Image:
    """Coverage as ink on paper."""
    mask = Image.fromarray(np.rint(255.0 * coverage).astype(np.uint8))
    return Image.composite(Image.new("RGB", mask.size, INK), Image.new("RGB", mask.size, PAPER), mask)


def cells_panel(tree: CellTree) -> Image.Image:
    """Every leaf, shaded by how much of it is filled, with its curve."""
    size = PANEL * FINER
    image = Image.new("RGB", (size, size), PAPER)
    draw = ImageDraw.Draw(image)
    paper, full = np.array(ImageColor.getrgb(PAPER)), np.array(ImageColor.getrgb(SHADE))
    found = leaves(tree)
    for x, y, side, coverage in zip(found.x, found.y, found.side, found.coverage, strict=True):
        box = [x * size, (1 - y - side) * size, (x + side) * size, (1 - y) * size]
        shade = np.rint(paper + coverage * (full - paper)).astype(int)
        draw.rectangle(box, fill=tuple(shade.tolist()), outline=GRID, width=FINER // 2)
    for line in found.lines(32):
        draw.line([(x * size, (1 - y) * size) for x, y in line], fill=CURVE, width=2 * FINER, joint="curve")
    return image.resize((PANEL, PANEL), Image.Resampling.BOX)


def texture_panel(texture: ThesisTexture) -> Image.Image:
    """The two images, side by side, each texel a rectangle."""
    image = Image.new("RGB", (PANEL, PANEL), PAPER)
    wide = (PANEL - GAP) // (texture.quads.shape[1] + texture.curves.shape[1])
    left = 0
    for strip in texture_images(texture):
        rows = np.rot90(strip.pixels, -1)
        pixels = Image.fromarray(np.floor(255.0 * rows).astype(np.uint8))
        pixels = pixels.resize((wide * rows.shape[1], PANEL), Image.Resampling.NEAREST)
        image.paste(pixels, (left, 0))
        left += pixels.width + GAP
    return image


def sizes_panel(texture: ThesisTexture) -> Image.Image:
    """Small pictures, pixel by pixel, and the smallest ones enlarged."""
    image = Image.new("RGB", (PANEL, PANEL), PAPER)
    smalls = [draw_ink(vexture.coverage(texture, (size, size), renderer="cpu")) for size in SIZES]
    space = (PANEL - sum(SIZES)) // (len(SIZES) + 1)
    left = space
    for small in smalls:
        image.paste(small, (left, space + SIZES[0] - small.height))
        left += small.width + space
    side = SIZES[0] + SIZES[2]
    space = (PANEL - 2 * side) // 3
    for place, small in enumerate(smalls[-2:]):
        large = small.resize((side, side), Image.Resampling.NEAREST)
        image.paste(large, (space + place * (side + space), PANEL - space - side))
    return image


def view(zoom: int) -> NDArray[np.float64]:
    """View of a panel: everything, or magnified around `CENTER`."""
    side = 1.0 / zoom
    x, y = (min(max(middle - side / 2, 0.0), 1.0 - side) for middle in CENTER)
    return window(x, y, side, side).matrix((PANEL, PANEL))


def zoom_panel(texture: ThesisTexture, zoom: int) -> Image.Image:
    """A magnified picture, and a frame around what the next one shows of it."""
    image = draw_ink(vexture.coverage(texture, (PANEL, PANEL), view(zoom), "cpu"))
    for following in ZOOMS[ZOOMS.index(zoom) + 1 :][:1]:
        corners = view(following) @ np.array([(0, 0, 1), (PANEL, PANEL, 1)]).T
        (left, right), (top, bottom), _ = np.linalg.inv(view(zoom)) @ corners
        ImageDraw.Draw(image).rectangle([left, top, right, bottom], outline=CURVE, width=2)
    return image


def sheet(rows: list[list[Panel]]) -> Image.Image:
    """Panels in rows, each with a title and a text below it."""
    width = max(map(len, rows)) * (PANEL + GAP) + GAP
    image = Image.new("RGB", (width, GAP + len(rows) * (PANEL + CAPTION + GAP)), PAPER)
    draw = ImageDraw.Draw(image)
    large, small = ImageFont.load_default(21), ImageFont.load_default(17)
    for row, panels in enumerate(rows):
        for column, (title, text, panel) in enumerate(panels):
            left, top = GAP + column * (PANEL + GAP), GAP + row * (PANEL + CAPTION + GAP)
            draw.rectangle([left - 1, top - 1, left + PANEL, top + PANEL], outline=FRAME)
            image.paste(panel, (left, top))
            line = top + PANEL + CAPTION // 2 + 8
            draw.text((left, line), title, TITLE, large, anchor="ls")
            draw.text((left + draw.textlength(title, large) + 10, line), text, TEXT, small, anchor="ls")
    return image


def panels() -> list[list[Panel]]:
    """From a drawing to pixels."""
    drawing = vexture.read_svg(SHAPE)
    texture = vexture.convert(drawing, encoding="thesis")
    assert isinstance(texture, ThesisTexture)
    tree = decode(texture)
    quads, curves, size = len(texture.quads), len(texture.curves), sum(map(len, texture.to_png()))
    source = draw_ink(vexture.coverage(drawing, (PANEL, PANEL), renderer="exact"))
    return [
        [
            ("A drawing", f"{drawing.segments} curves and lines", source),
            ("a tree", f"{len(tree.curves)} cells hold a curve", cells_panel(tree)),
            ("two textures", f"4 by {quads}, 2 by {curves}: {size:,} bytes", texture_panel(texture)),
            ("pixels", "each finds its own cell", zoom_panel(texture, 1)),
        ],
        [
            *((f"{zoom} times", "", zoom_panel(texture, zoom)) for zoom in ZOOMS[1:]),
            ("small", f"{', '.join(map(str, SIZES))} pixels", sizes_panel(texture)),
        ],
    ]


def paint(colors: NDArray[np.float64] | NDArray[np.float32]) -> Image.Image:
    """Premultiplied colours on paper."""
    return Image.fromarray(np.uint8(np.rint(255.0 * np.clip(colors[..., :3] + 1.0 - colors[..., 3:], 0.0, 1.0))))


def png_bytes(colors: NDArray[np.float32]) -> bytes:
    """The PNG of a picture, as small as Pillow makes it."""
    opacity = colors[..., 3:]
    straight = np.divide(colors[..., :3], opacity, out=np.zeros_like(colors[..., :3]), where=opacity > 0.0)
    pixels = np.uint8(np.rint(255.0 * np.clip(np.concatenate([straight, opacity], 2), 0.0, 1.0)))
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, "PNG", optimize=True)
    return out.getvalue()


def largest_png(texture: vexture.Texture, limit: int) -> tuple[int, int]:
    """Side in pixels and size in bytes of the largest PNG of at most `limit` bytes."""
    side, size = 8, 0
    while (following := len(png_bytes(texture.render(side + 1)))) <= limit:
        side, size = side + 1, following
    return side, size


def logo_panels() -> list[list[Panel]]:
    """A logo drawn from its texture, and from a PNG of as many bytes as a graphics processor filters it."""
    sys.path.insert(0, str(ROOT / "packages" / "vexture-evidence" / "benchmarks"))
    import corpora

    texture = vexture.convert(corpora.DEVICON.installed_folder() / corpora.DEVICON.folder / LOGO)
    assert isinstance(texture, vexture.Texture)
    with tempfile.TemporaryDirectory() as folder:
        texture.save(file := Path(folder) / "logo.ktx2")
        size = file.stat().st_size
    side, smaller = largest_png(texture, size)
    levels = [np.uint8(np.rint(255.0 * texture.render(n))) for n in (side, *mip_sides(side))]
    ours: list[Panel] = []
    theirs: list[Panel] = []
    views = [("on a plane", LEANING)]
    for zoom in LOGO_ZOOMS:
        x, y = (min(max(middle - 0.5 / zoom, 0.0), 1.0 - 1.0 / zoom) for middle in LOGO_POINT)
        matrix = window(x, y, 1.0 / zoom, 1.0 / zoom).matrix((PANEL, PANEL))
        views.append((f"{zoom} times" if zoom > 1 else "the whole logo", matrix))
    for title, matrix in views:
        place = footprint((PANEL, PANEL), matrix)
        channels = [trilinear([level[..., channel] for level in levels], place) for channel in range(4)]
        filtered = np.where(place.visible[..., None], np.stack(channels, 2) / 255.0, 0.0)
        ours.append((title, "" if ours else f"vexture: {size:,} bytes", paint(texture.render(PANEL, matrix))))
        name, text = ("", "") if theirs else ("PNG", f"{side} by {side} pixels: {smaller:,} bytes")
        theirs.append((name, text, paint(filtered)))
    return [ours, theirs]


def packed_panels() -> list[list[Panel]]:
    """Pictures of the packed encoding: planes seen from the side, maps, deep zoom."""
    sys.path.insert(0, str(ROOT / "packages" / "vexture-evidence" / "benchmarks"))
    import corpora

    lettering = vexture.convert(LETTERING)
    coast = corpora.fractal_coastline(COAST_EDGES, seed=1)
    x, y = coast.paths[0].contours[0][COAST_POINT, 0]
    texture = vexture.convert(coast, precision=1e-7)
    row = [
        (
            "on a plane",
            f"{lettering.nbytes:,} bytes",
            draw_ink(vexture.coverage(lettering, (PANEL, PANEL), LEANING, "cpu")),
        )
    ]
    for zoom in COAST_ZOOMS:
        side = 1.0 / zoom
        whole = window(0.0, 0.0, 1.0, 1.0).matrix((PANEL, PANEL))
        near = window(x - side / 2, y - side / 2, side, side).matrix((PANEL, PANEL))
        image = draw_ink(vexture.coverage(texture, (PANEL, PANEL), whole if zoom == 1 else near, "cpu"))
        title = f"{COAST_EDGES:,} edges" if zoom == 1 else f"{zoom:,} times"
        row.append((title, "", image))
    return [row]


def icons() -> Image.Image:
    """Icons of those that benchmarks/icons.py measures, each drawn from its texture."""
    sys.path.insert(0, str(ROOT / "packages" / "vexture-evidence" / "benchmarks"))
    import corpora

    columns, rows = ICON_GRID
    out = Image.new("RGB", (columns * (ICON + GAP) + GAP, rows * (ICON + GAP) + GAP), PAPER)
    for place, file in enumerate(corpora.mdi(columns * rows, 1)):
        row, column = divmod(place, columns)
        image = draw_ink(vexture.coverage(vexture.convert(file), (ICON, ICON), renderer="cpu"))
        out.paste(image, (GAP + column * (ICON + GAP), GAP + row * (ICON + GAP)))
    return out


def equal_bytes() -> Image.Image:
    """The report's picture of other textures of as many bytes."""
    from vexture_evidence.report.assemble import assemble

    with tempfile.TemporaryDirectory() as folder:
        made = assemble([SHAPE], Path(folder), only=("comparison",))
        with Image.open(made.with_name("figures") / EQUAL_TARGET.name) as picture:
            return picture.convert("RGB")


if __name__ == "__main__":
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    pictures = {
        LOGO_TARGET: lambda: sheet(logo_panels()),
        TARGET: lambda: sheet(panels()),
        PACKED_TARGET: lambda: sheet(packed_panels()),
        ICONS_TARGET: icons,
        EQUAL_TARGET: equal_bytes,
    }
    for target, draw_picture in pictures.items():
        if target.stem in (sys.argv[1:] or [target.stem]):
            draw_picture().save(target, optimize=True)
            print(target)
