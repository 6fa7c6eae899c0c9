"""Comparison with renderers that draw the vectors themselves: resvg and Skia on the CPU, bands on the GPU."""

from collections.abc import Callable, Iterable, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.conversion.images import coverage
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS
from vexture_evidence.measures.metrics import errors
from vexture_evidence.measures.rivals import MANY, bands_of
from vexture_evidence.measures.timing import frames_per_second, median_seconds
from vexture_evidence.report.section import Section, Table

if TYPE_CHECKING:
    from vexture_evidence.measures.programs import Program
    from vexture_evidence.measures.shape import ConvertedDrawing

SIZE: Final = (256, 256)
"""Width and height of all pictures in this module, in pixels."""

REPEAT: Final = 5
"""How often each time is measured; the median is reported."""

Draw = Callable[[], NDArray[np.float32]]


def renderers_part(shapes: Sequence["ConvertedDrawing"]) -> Section:
    """Time and error of renderers on the CPU."""
    from vexture.drawing.drawing import Drawing
    from vexture_evidence.measures.peers import resvg_renderer

    names = ("resvg", "skia", "packed", "exact")
    head = ("drawing", "segments", *(f"milliseconds: {name}" for name in names))
    head += tuple(f"mean error: {name}" for name in names[:-1])
    rows, missing = [], []
    for shape in shapes:
        row: list[Any] = [shape.name, shape.drawing.segments]
        truth = coverage(shape.drawing, SIZE, renderer="exact")
        found: dict[str, Draw] = {}
        try:
            found = cpu_renderers(shape)
        except LimitError as error:
            missing.append(str(error))
        ms = {name: 1e3 * median_seconds(draw, REPEAT) for name, draw in found.items()}
        off = {name: errors(draw(), truth).mae for name, draw in found.items() if name != "exact"}
        rows.append([*row, *map(ms.get, names), *map(off.get, names[:-1])])
    empty = 1e3 * median_seconds(resvg_renderer(Drawing(()), SIZE), REPEAT)
    caption = (
        f"Pictures of {SIZE[0]}×{SIZE[1]} pixels on the CPU, median of {REPEAT} runs. Preparation is not timed: "
        "parsing the SVG document, making the path, converting the texture. `packed` is the mirror of our shader, "
        "written to match it and not to be fast. `exact` computes the truth that errors are measured against, so its "
        "own error is not shown. resvg and Skia estimate coverage at the edges. They fill whole rows of pixels at "
        "once, whereas a shader computes each pixel on its own. resvg's Python package returns PNG files only; an "
        f"empty picture alone takes it {empty:.2g} ms. Packages: resvg {version('resvg')}, "
        f"skia-python {version('skia-python')}."
    )
    table = Table("cpu-times", caption + dashes(missing), head, rows)
    return Section("cpu-renderers", "Renderers of vector graphics on the CPU", (), [table])


def cpu_renderers(shape: "ConvertedDrawing") -> dict[str, Draw]:
    """Functions that draw the whole drawing, by renderer, with everything prepared."""
    from vexture_evidence.measures.peers import resvg_renderer, skia_renderer

    texture = shape.way("packed").texture
    return {
        "resvg": resvg_renderer(shape.drawing, SIZE),
        "skia": skia_renderer(shape.drawing, SIZE),
        "packed": lambda: coverage(texture, SIZE, renderer="cpu"),
        "exact": lambda: coverage(shape.drawing, SIZE, renderer="exact"),
    }


def bands_part(shapes: Sequence["ConvertedDrawing"], device: str) -> Section:
    """Memory, error and time of the bands and of our textures on the GPU."""
    from vexture.renderers.view import fit
    from vexture_evidence.measures.programs import fetch_program

    kinds = ("bytes on the GPU", "mean error", "milliseconds a frame")
    head = ("drawing", *(f"{kind}: {way}" for kind in kinds for way in WAYS))
    rows, missing = [], []
    for shape in shapes:
        programs: dict[str, Program] = {}
        sizes: dict[str, int] = {}
        for way, made in WAYS.items():
            try:
                programs[way], sizes[way] = made(shape)
            except LimitError as error:
                missing.append(str(error))
        truth = coverage(shape.drawing, SIZE, renderer="exact")
        off = {name: errors(program.image(SIZE, fit(SIZE)), truth).mae for name, program in programs.items()}
        ms = {name: 1e3 / frames_per_second(program, SIZE, REPEAT) for name, program in programs.items()}
        rows.append([shape.name, *map(sizes.get, WAYS), *map(off.get, WAYS), *map(ms.get, WAYS)])
    fetch = 1e3 / frames_per_second(fetch_program(shapes[0].drawing), SIZE, REPEAT)
    caption = (
        f"Pictures of {SIZE[0]}×{SIZE[1]} pixels on {device}, median of {REPEAT} runs: the bands (E. Lengyel 2017) "
        f"beside our textures. There are {BANDS} bands in each direction, as published for glyphs, and "
        f"{COASTLINE_BANDS} for more than {MANY} curves; their bytes are those of the published layout. The bands "
        "blend two rays for each pixel instead of integrating over it. As implemented here they draw one path by the "
        "non-zero rule; this is a limit of our implementation, not of the method. One trilinear fetch from a raster "
        f"texture, the least work that any method could do, takes {fetch:.2g} ms a frame."
    )
    table = Table("band-times", caption + dashes(missing), head, rows)
    return Section("bands-on-the-gpu", "Bands, on the GPU", (), [table])


def dashes(reasons: Iterable[str]) -> str:
    """Sentence that explains the dashes in a table, with each reason once; empty if there are none."""
    why = dict.fromkeys(reasons)
    return f" Dashes: {'; '.join(why)}." if why else ""


def with_bands(shape: "ConvertedDrawing") -> "tuple[Program, int]":
    """Program that draws the bands, and the bytes that they take."""
    from vexture_evidence.measures.programs import band_program

    texture = bands_of(shape.drawing)
    return band_program(texture), texture.published_bytes


def with_packed(shape: "ConvertedDrawing") -> "tuple[Program, int]":
    """Program that draws the packed texture, and the bytes that it takes."""
    from vexture.texture.texture import Texture
    from vexture_evidence.measures.programs import packed_program

    texture = shape.way("packed").texture
    assert isinstance(texture, Texture)
    return packed_program(texture, is_flat=True), texture.nbytes


def with_direct(shape: "ConvertedDrawing") -> "tuple[Program, int]":
    """Program that draws the thesis's pair of textures from our conversion, and the bytes that they take."""
    from vexture.thesis.texture import ThesisTexture
    from vexture_evidence.measures.programs import thesis_program

    texture = shape.way("direct").texture
    assert isinstance(texture, ThesisTexture)
    return thesis_program(texture), texture.quads.nbytes + texture.curves.nbytes


WAYS: Final = {"bands": with_bands, "packed": with_packed, "direct": with_direct}
