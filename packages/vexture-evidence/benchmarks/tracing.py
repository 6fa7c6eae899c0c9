"""Traced raster images: the drawing's error and cost.

    python packages/vexture-evidence/benchmarks/tracing.py [--only TEXT] [--pictures FOLDER]

Each picture is made here, from a drawing or a formula, and traced with its background. The drawing is drawn exactly, in
pixels of the picture, and compared with it: the error is the mean difference of premultiplied red, green, blue and
opacity, in 1/255. Texels are those of its planar map; seconds are the processor's, of the tracing alone.
"""

import argparse
import io
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

import vexture
from report import cell, table, write_json
from vexture.base.errors import SourceWarning, VextureError
from vexture.drawing.drawing import Drawing
from vexture.svg.read import svg_drawing
from vexture.tracing.trace import embedded_image
from vexture_evidence.measures.machine import machine_facts, machine_line

Pixels = NDArray[np.uint8]

LOGO: Final = """<rect x="10" y="10" width="100" height="60" rx="10" fill="#0a4d8c"/>
<circle cx="40" cy="40" r="22" fill="#f2b632"/><path fill="#c8321e" d="M60 20h20v40H60z"/>
<path fill="#2e8b57" d="M80 20h20v40H80z"/><circle cx="90" cy="40" r="6" fill="#0a4d8c"/>"""

SHADED: Final = """<linearGradient id="a" x2="1" y2="1"><stop stop-color="#ffd633"/><stop offset="1"
stop-color="#d1203a"/></linearGradient><radialGradient id="b"><stop stop-color="#fff"/><stop offset="1"
stop-color="#1060c0"/></radialGradient><rect x="10" y="10" width="100" height="60" rx="10" fill="url(#a)"/>
<circle cx="40" cy="40" r="22" fill="url(#b)"/><path fill="#2e8b57" d="M80 20h20v40H80z"/>"""

ICON: Final = """<g fill="none" stroke="#333"><path d="M3.5 20.500h17v-11l-8.500 -7l-8.500 7z"/>
<path d="M9.500 20.500v-7h5v7"/></g>"""

INKS: Final = ((0, 0, 0, 0), (20, 12, 28, 255), (208, 70, 72, 255), (210, 170, 153, 255), (48, 52, 109, 255))
INKS_SHARE: Final = (0.4, 0.2, 0.15, 0.15, 0.1)
"""Of the figures of pixel art, the first of them transparent."""


def of_svg(body: str, box: tuple[int, int], width: int) -> Pixels:
    """Pixels of a drawing, exact in each."""
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {box[0]} {box[1]}">{body}</svg>'
    return unpremultiply(draw_exactly(svg_drawing(text.encode(), "picture.svg"), (width, width * box[1] // box[0])))


def draw_exactly(drawing: Drawing, size: tuple[int, int]) -> NDArray[np.float64]:
    """Premultiplied pixels of a drawing whose own coordinates are spread over a picture, 0..255."""
    width, height = size
    side = max(size)
    place = [[1 / side, 0.0, 0.5 - 0.5 * width / side], [0.0, -1 / side, 0.5 + 0.5 * height / side]]
    return 255.0 * np.asarray(vexture.render(drawing, size, place, "exact"), float)


def unpremultiply(premultiplied: NDArray[np.float64]) -> Pixels:
    """Divide colours by opacity; return 8-bit pixels."""
    opacity = np.maximum(premultiplied[..., 3:], 1e-6) / 255.0
    plain = np.concatenate([premultiplied[..., :3] / opacity, premultiplied[..., 3:]], axis=2)
    return np.rint(np.clip(plain, 0.0, 255.0)).astype(np.uint8)


def premultiply(pixels: Pixels) -> NDArray[np.float64]:
    values = pixels.astype(float)
    values[..., :3] *= values[..., 3:] / 255.0
    return values


def on_white(pixels: Pixels) -> Pixels:
    paper = Image.new("RGBA", pixels.shape[1::-1], "white")
    return np.asarray(Image.alpha_composite(paper, Image.fromarray(pixels)))


def jpeg(pixels: Pixels, quality: int) -> Pixels:
    file = io.BytesIO()
    Image.fromarray(on_white(pixels)).convert("RGB").save(file, "JPEG", quality=quality)
    return np.asarray(Image.open(file).convert("RGBA"))


def ramp(first: tuple[int, ...], last: tuple[int, ...], size: tuple[int, int] = (300, 100)) -> Pixels:
    """A gradient over the width of a picture."""
    share = ((np.arange(size[0]) + 0.5) / size[0])[None, :, None]
    line = (1.0 - share) * np.array(first) + share * np.array(last)
    return np.rint(np.repeat(line, size[1], axis=0)).astype(np.uint8)


def hues() -> Pixels:
    """All hues around a centre, paler towards it."""
    y, x = np.mgrid[:160, :160] / 79.5 - 1.0
    turn, far = np.arctan2(y, x) / (2.0 * np.pi), np.minimum(np.hypot(x, y), 1.0)
    hsv = np.dstack([255.0 * (turn % 1.0), 255.0 * far, np.full_like(far, 255.0)])
    bands = [Image.fromarray(np.rint(channel).astype(np.uint8)) for channel in hsv.transpose(2, 0, 1)]
    return np.asarray(Image.merge("HSV", bands).convert("RGBA"))


def disc_of_light() -> Pixels:
    return of_svg(
        '<radialGradient id="a"><stop stop-color="#fff4c0"/><stop offset="1" stop-color="#803090"/></radialGradient>'
        '<rect width="200" height="200" fill="url(#a)"/>',
        (200, 200),
        200,
    )


def shadow(colour: tuple[int, int, int] = (0, 0, 0), blur: float = 8.0) -> Pixels:
    """A soft shadow of a box, with the box above it."""
    alpha = Image.new("L", (160, 120), 0)
    alpha.paste(140, (34, 34, 134, 94))
    pixels = np.zeros((120, 160, 4), np.uint8)
    pixels[..., :3] = colour
    pixels[..., 3] = np.asarray(alpha.filter(ImageFilter.GaussianBlur(blur)))
    above = of_svg('<rect x="30" y="24" width="100" height="60" rx="8" fill="#3a7bd5"/>', (160, 120), 160)
    return np.asarray(Image.alpha_composite(Image.fromarray(pixels), Image.fromarray(above)))


def glow() -> Pixels:
    """A disc that fades out."""
    y, x = np.mgrid[:128, :128] - 63.5
    pixels = np.zeros((128, 128, 4), np.uint8)
    pixels[..., :3] = (240, 120, 20)
    pixels[..., 3] = np.rint(255.0 * np.clip(1.25 - np.hypot(x, y) / 48.0, 0.0, 1.0) ** 1.5)
    return pixels


def art(seed: int = 1) -> Pixels:
    """Pixel art of 16 x 16: a figure that is alike on both sides, with a transparent border."""
    ink = np.zeros((16, 16), int)
    ink[1:-1, 1:8] = np.random.default_rng(seed).choice(len(INKS), (14, 7), p=INKS_SHARE)
    ink[:, 8:] = ink[:, 7::-1]
    return np.array(INKS, np.uint8)[ink]


def larger_art(times: int) -> Pixels:
    """Pixel art of 32 x 32: four figures on grass with single flowers; each pixel enlarged."""
    ground = np.zeros((32, 32, 4), np.uint8)
    ground[:] = (52, 101, 36, 255)
    for x, y in np.random.default_rng(4).integers(0, 32, (40, 2)):
        ground[y, x] = (109, 170, 44, 255) if (x + y) % 3 else (222, 238, 214, 255)
    for number in range(4):
        one = art(number + 1)
        left, top = 16 * (number % 2), 16 * (number // 2)
        part = ground[top : top + 16, left : left + 16]
        part[one[..., 3] > 0] = one[one[..., 3] > 0]
    return ground.repeat(times, axis=0).repeat(times, axis=1)


def photo() -> Pixels:
    """Slow waves of three colours and the noise of a camera."""
    y, x = np.mgrid[:240, :320]
    waves = np.stack([np.sin(x / 40), np.cos(y / 33), np.sin((x + y) / 50)], axis=2)
    noise = np.random.default_rng(0).normal(0, 12, waves.shape)
    opaque = np.full((240, 320, 1), 255.0)
    return np.concatenate([np.clip(128 + 90 * waves + noise, 0, 255), opaque], axis=2).astype(np.uint8)


PICTURES: Final[dict[str, Callable[[], Pixels]]] = {
    "gradient, black to white": lambda: ramp((0, 0, 0, 255), (255, 255, 255, 255)),
    "gradient, red to blue": lambda: ramp((230, 30, 40, 255), (30, 60, 220, 255)),
    "gradient, to nothing": lambda: ramp((230, 30, 40, 255), (230, 30, 40, 0)),
    "gradient, radial": disc_of_light,
    "wheel of hues": hues,
    "logo": lambda: of_svg(LOGO, (120, 80), 240),
    "logo on white": lambda: on_white(of_svg(LOGO, (120, 80), 240)),
    "logo, small": lambda: of_svg(LOGO, (120, 80), 48),
    "logo, JPEG 60": lambda: jpeg(of_svg(LOGO, (120, 80), 240), 60),
    "logo, translucent": lambda: of_svg(f'<g opacity="0.5">{LOGO}</g>', (120, 80), 240),
    "logo with gradients": lambda: of_svg(SHADED, (120, 80), 240),
    "the same, JPEG 80": lambda: jpeg(of_svg(SHADED, (120, 80), 240), 80),
    "soft shadow": shadow,
    "soft glow": glow,
    "icon, lines of 1 px": lambda: of_svg(ICON, (24, 24), 24),
    "pixel art, 16 px": art,
    "pixel art, 32 px": lambda: larger_art(1),
    "pixel art, 32 px, x 6": lambda: larger_art(6),
    "like a photo": photo,
}


def measure_tracing(pixels: Pixels) -> tuple[dict[str, Any], NDArray[np.float64] | None]:
    """Trace a picture; return the figures, and the traced drawing's pixels."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    begun = time.process_time()
    try:
        drawing = embedded_image(file.getvalue())
    except VextureError as error:
        return {"error": str(error)}, None
    seconds = time.process_time() - begun
    back = draw_exactly(drawing, pixels.shape[1::-1])
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        texels = vexture.convert(drawing).info()["texels"]
    off = np.abs(back - premultiply(pixels))
    return {
        "error": float(off.mean()),
        "far off": float(100.0 * (off.max(axis=2) > 16.0).mean()),
        "paths": len(drawing.paths),
        "curves": drawing.segments,
        "texels": texels,
        "seconds": seconds,
    }, back


def main() -> None:
    """Trace the pictures and print what was measured."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="only pictures whose name holds this text")
    parser.add_argument("--pictures", type=Path, help="folder for each picture beside its drawing")
    options = parser.parse_args()
    figures, rows = {}, []
    for name, make in PICTURES.items():
        if options.only in name:
            pixels = make()
            one, back = measure_tracing(pixels)
            figures[name] = one
            rows.append((name, *(cell(one.get(key)) for key in ("error", "far off", *COUNTS))))
            if options.pictures is not None and back is not None:
                options.pictures.mkdir(parents=True, exist_ok=True)
                sides = np.concatenate([on_white(pixels), on_white(unpremultiply(back))], axis=1)
                times = max(1, 500 // sides.shape[1])
                shown = sides.repeat(times, axis=0).repeat(times, axis=1)
                Image.fromarray(shown).save(options.pictures / f"{name.replace(' ', '-')}.png")
    facts = machine_facts()
    print(table(("picture", "error", "off, %", *COUNTS), rows))
    print(machine_line(facts))
    print(write_json("tracing", {"machine": facts, **figures}))


COUNTS: Final = ("paths", "curves", "texels", "seconds")

if __name__ == "__main__":
    main()
