"""The picture of the ground under the water: the user's picture, fitted to the frame, over the drawn one."""

import warnings
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import TIFF, about
from vexture.base.errors import LimitError, SourceError, reason_of
from vexture_geo.base.extent import Extent, Frame
from vexture_geo.base.gdal import open_raster
from vexture_geo.flood.grids import coverage_over, noise, pixels_to, shore_distance, size_for
from vexture_geo.flood.open_water import cells_of
from vexture_geo.flood.relief import Relief, beyond_of, first_wet, widest
from vexture_geo.flood.scene import PageNote

if TYPE_CHECKING:
    from PIL import Image

DRAWN: Final = 1024
"""Pixels on the longer side."""

FAR: Final = 192
"""Samples on the longer side of the grid of distances to the shore, which vary slowly."""

WET_SAND, SAND, GRASS, WOOD, ROCK = (
    np.array(colour, float)
    for colour in ((178, 156, 120), (226, 209, 170), (163, 172, 116), (110, 134, 86), (160, 150, 134))
)
SEA_SHALLOW, SEA_DEEP = np.array([141, 141, 116], float), np.array([48, 66, 76], float)

BEACH: Final = 0.008
"""Width of the sand, as a fraction of the frame's longer side."""

FLOOR: Final = 9.0
"""Beach widths over which the sea floor changes from its shallow colour to its deep one."""

LIGHT: Final = np.array([-0.5, 0.5, 0.7]) / np.sqrt(0.99)
"""Direction of the sun: east, north, up."""

STEEPEST: Final = 3.0
"""Largest exaggeration of slopes. Flat land is lit as if it rose to a twentieth of the longer side."""


def drawn_ground(extent: Extent, relief: Relief) -> "Image.Image":
    """Draw the frame, `DRAWN` pixels on the longer side."""
    from PIL import Image

    frame = extent.frame
    size, longest = size_for(frame, DRAWN), max(frame.metres)
    rough = noise(size, 8)
    height = _enlarge(relief.heights, size)
    top = max(float(relief.heights.max()), 1e-6)
    first, most = first_wet(extent), widest(extent)
    if first is None or most is None:
        distance, wet = np.full(size[::-1], 0.05 * longest), np.zeros(size[::-1])
    else:
        beyond = beyond_of(extent, relief)  # drawn like its bottom, without a beach
        wet = np.maximum(coverage_over(first.drawing, frame.box, size), cells_of(beyond, size))
        coarse = size_for(frame, FAR)
        cell = (frame.metres[0] / coarse[0], frame.metres[1] / coarse[1])
        shore = shore_distance(
            (coverage_over(first.drawing, frame.box, coarse) >= 0.5) | cells_of(beyond, coarse), cell
        )
        distance = _enlarge(shore, size)  # metres, positive on land
    away = np.maximum(distance, 0.0) / (BEACH * longest)
    land = _blend(WET_SAND, SAND, away, 0.02, 0.12)
    land = _blend(land, GRASS, away + 0.5 * rough, 0.8, 1.6)
    land = _blend(land, WOOD, height / top + 0.3 * rough, 0.3, 0.6)
    land = _blend(land, ROCK, height / top + 0.15 * rough, 0.9, 1.1)
    floor = _blend(SEA_SHALLOW, SEA_DEEP, -distance / (BEACH * longest) + 0.5 * rough, 0.0, FLOOR)
    shown = land + (floor - land) * wet[..., None]
    lit = _light(height, longest / max(size), 0.05 * longest / top)
    bright = 1.0 + (lit - 1.0) * (1.0 - 0.8 * wet) + 0.05 * rough
    return Image.fromarray(np.clip(np.rint(shown * bright[..., None]), 0, 255).astype(np.uint8))


def _enlarge(grid: NDArray[np.float64], size: tuple[int, int]) -> NDArray[np.float64]:
    from PIL import Image

    return np.asarray(Image.fromarray(grid.astype(np.float32)).resize(size, Image.Resampling.BICUBIC), np.float64)


def _blend(
    below: NDArray[np.float64], above: NDArray[np.float64], value: NDArray[np.float64], start: float, end: float
) -> NDArray[np.float64]:
    """Blend smoothly from one colour to another as a value goes from start to end."""
    share = np.clip((value - start) / (end - start), 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    return np.asarray(below + (above - below) * share[..., None])


def _light(height: NDArray[np.float64], pixel: float, exaggeration: float) -> NDArray[np.float64]:
    """Brightness of each pixel by its slope, 1 on level ground."""
    south, east = np.gradient(height * min(exaggeration, STEEPEST), pixel)
    length = np.sqrt(east**2 + south**2 + 1.0)
    cosine = (-east * LIGHT[0] + south * LIGHT[1] + LIGHT[2]) / length
    return np.asarray(np.clip(cosine / LIGHT[2], 0.6, 1.25))


GROUND_TYPE: Final = "image/webp"

LONGEST: Final = 2048
"""Most pixels on the longer side: every phone supports textures of that size."""

LARGEST_GROUND: Final = 1_000_000
"""Most bytes of the encoded picture."""

QUALITIES: Final = (82, 72, 60, 45)
"""Qualities of WebP, tried in turn until the file is small enough; after them the picture is scaled down."""

MOST_PIXELS: Final = 170_000_000
"""Most pixels of a PNG, JPEG or WebP: a file of a few kilobytes can declare a huge size."""

SHOWN_PERCENTILES: Final = (2.0, 98.0)
"""Percentiles of bands of more than 8 bits that are mapped to black and white."""


def ground_of(
    path: Path, frame: Frame, drawn: "Image.Image", *, bounds_given: bool
) -> tuple["Image.Image", list[PageNote]]:
    """Fit a user's picture of the ground to the frame; return it with notes.

    A GeoTIFF with a reference system is warped to the frame. A PNG, JPEG or WebP must show exactly the frame;
    `bounds_given` says whether the user has chosen its bounds. `drawn` is visible where the picture is transparent or
    does not reach.
    """
    try:
        with path.open("rb") as file:
            start = file.read(4)
    except OSError as error:
        raise SourceError(f"`ground` {path}: cannot be read ({error.strerror}); name another picture") from None
    if start in TIFF:
        return _warp_to_frame(path, frame, drawn)
    picture = _open_picture(path)
    notes, remedy = [], "`bounds` says which box it shows."
    if not bounds_given:
        notes.append(PageNote(f"{path.name} is assumed to show exactly the box of the extent.", remedy))
    width, height = frame.metres
    if not 0.9 < (picture.width / picture.height) / (width / height) < 1.1:
        pixels = f"{picture.width} x {picture.height} pixels"
        notes.append(PageNote(f"{path.name}, {pixels}, is stretched to {width:.0f} x {height:.0f} m.", remedy))
    return _over(drawn, _resize(picture, *_size(frame, max(picture.size)))), notes


def encode_webp(picture: "Image.Image") -> bytes:
    """Encode a picture as WebP within `LARGEST_GROUND` bytes."""
    while True:
        for quality in QUALITIES:
            out = BytesIO()
            picture.save(out, format="WEBP", quality=quality, method=4)
            if out.tell() <= LARGEST_GROUND:
                return out.getvalue()
        picture = _resize(picture, max(1, 3 * picture.width // 4), max(1, 3 * picture.height // 4))


def _open_picture(path: Path) -> "Image.Image":
    """Open a picture in RGBA; one that is too large is refused before it is decoded."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about sizes, which are checked here
            with Image.open(path, formats=("PNG", "JPEG", "WEBP")) as picture:
                if picture.width * picture.height > MOST_PIXELS:
                    raise LimitError(
                        f"`ground` {path}: {picture.width} x {picture.height} pixels; the limit is {MOST_PIXELS:,}; "
                        "scale it down"
                    )
                picture.draft("RGB", (LONGEST, LONGEST))
                return ImageOps.exif_transpose(picture).convert("RGBA")
    except Image.DecompressionBombError:
        raise LimitError(f"`ground` {path}: has more than {MOST_PIXELS:,} pixels; scale it down") from None
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError) as error:
        reason = "no picture" if isinstance(error, UnidentifiedImageError) else "a damaged picture"
        raise SourceError(f"`ground` {path}: is {reason}; give a PNG, JPEG, WebP or GeoTIFF") from None


def _warp_to_frame(path: Path, frame: Frame, drawn: "Image.Image") -> tuple["Image.Image", list[PageNote]]:
    """Warp a GeoTIFF to the frame, over the drawn ground."""
    from PIL import Image
    from rasterio.errors import CRSError, RasterioError, RasterioIOError

    try:
        with warnings.catch_warnings(action="ignore"), about(f"`ground` {path}"), open_raster(path) as raster:
            if raster.crs is None:
                raise SourceError(
                    "says no reference system; write it into the file (gdal_edit.py -a_srs EPSG:...), or save it as a "
                    "PNG of exactly `bounds`"
                )
            bands, alpha = _bands_over(raster, frame)
    except RasterioIOError:
        raise SourceError(f"`ground` {path}: is a damaged GeoTIFF; save it again") from None
    except (CRSError, RasterioError) as error:
        raise SourceError(f"`ground` {path}: {reason_of(error, 200)}; save it again") from None
    if not alpha.any():
        raise SourceError(f"`ground` {path}: shows nothing of the frame; give one that covers it, or other `bounds`")
    notes: list[PageNote] = []
    if (alpha == 0).mean() > 0.005:
        share = 100.0 * (alpha > 0).mean()
        notes.append(PageNote(f"{path.name} shows {share:.0f}% of the frame; the rest of the ground is drawn.", ""))
    if bands.dtype != np.uint8:
        bands = _stretch_brightness(bands, alpha > 0)
        notes.append(PageNote(f"{path.name} has more than 8 bits a channel; its brightness is stretched.", ""))
    colours = bands[:3] if len(bands) >= 3 else np.repeat(bands[:1], 3, axis=0)
    picture = np.concatenate([colours, alpha[None]]).transpose(1, 2, 0)
    return _over(drawn, Image.fromarray(np.ascontiguousarray(picture))), notes


def _bands_over(raster: Any, frame: Frame) -> tuple[Any, Any]:
    """Warp the bands of a raster to the frame; return them with their opacity, 0 to 255."""
    from rasterio.enums import ColorInterp, Resampling
    from rasterio.vrt import WarpedVRT
    from rasterio.warp import transform_bounds

    west, south, east, north = transform_bounds(raster.crs, frame.crs, *raster.bounds)
    finest = min(abs(east - west) / raster.width, abs(north - south) / raster.height)
    wanted = (frame.bounds[2] - frame.bounds[0]) / max(finest, 1e-300)
    size = _size(frame, int(min(wanted * max(frame.metres) / frame.metres[0], LONGEST)))
    colours = [n for n, what in enumerate(raster.colorinterp, 1) if what != ColorInterp.alpha][:3]
    options: dict[str, Any] = {
        "crs": frame.crs,
        "transform": pixels_to(frame.bounds, size),
        "width": size[0],
        "height": size[1],
        "resampling": Resampling.nearest if raster.colorinterp[0] == ColorInterp.palette else Resampling.bilinear,
    }
    has_alpha = ColorInterp.alpha in raster.colorinterp
    if np.issubdtype(np.dtype(raster.dtypes[0]), np.floating):  # an added alpha band would be floating-point too
        options["nodata"] = np.nan
    elif not has_alpha:
        options["add_alpha"] = True
    with WarpedVRT(raster, **options) as onto:
        bands = onto.read(colours)
        alpha = np.where(np.isfinite(bands).all(axis=0), onto.dataset_mask(), 0).astype(np.uint8)
    if raster.colorinterp[0] == ColorInterp.palette:
        table = np.zeros((256, 4), np.uint8)
        for value, colour in raster.colormap(1).items():
            table[value] = colour
        bands = table[bands[0]].transpose(2, 0, 1)[:3]
    return bands, alpha


def _stretch_brightness(bands: Any, known: Any) -> Any:
    values = bands[:, known].astype(np.float64)
    values = values[np.isfinite(values)]
    low, high = np.percentile(values, SHOWN_PERCENTILES) if len(values) else (0.0, 1.0)
    shares = (np.nan_to_num(bands.astype(np.float64)) - low) / max(high - low, 1e-300)
    return np.rint(255.0 * np.clip(shares, 0.0, 1.0)).astype(np.uint8)


def _over(drawn: "Image.Image", picture: "Image.Image") -> "Image.Image":
    """Paste a picture in RGBA over the drawn ground, in RGB."""
    from PIL import Image

    below = drawn.resize(picture.size, Image.Resampling.BICUBIC).convert("RGBA")
    return Image.alpha_composite(below, picture).convert("RGB")


def _size(frame: Frame, longest: int) -> tuple[int, int]:
    """Width and height in pixels of a picture of the frame."""
    return size_for(frame, max(16, min(longest, LONGEST)), least=1)


def _resize(picture: "Image.Image", width: int, height: int) -> "Image.Image":
    from PIL import Image

    return picture.resize((width, height), Image.Resampling.LANCZOS)
