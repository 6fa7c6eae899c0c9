"""Judging of one file by the sweep, in a child process: resvg and Skia crash on hostile SVG, and memory has a limit.

The texture's silhouette is judged by exact coverage, and the reading by resvg's picture of the file, drawn larger and
reduced. Where resvg differs, Skia's own reader is asked: a file is right if one of the two agrees.
"""

import io
import multiprocessing
import os
import resource
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Final

import numpy as np
import resvg
import skia
from lxml import etree
from numpy.typing import NDArray
from PIL import Image

import vexture
from same_fonts import options_of_resvg
from vexture.base.content import decompress
from vexture.base.errors import SourceWarning, VextureError
from vexture.base.notes import line_of
from vexture.drawing.drawing import Drawing
from vexture.svg.document import parse_svg
from vexture.svg.read import framed_drawing
from vexture_evidence.measures.peers import paint_with_skia

SIZE: Final = 100
"""Pixels across a compared picture."""

FINER: Final = (4, 16)
"""Pixels of the references' pictures across one of ours; the second where the first differ by anti-aliasing or more."""

TEXTURE_LIMIT: Final = 0.125
"""Largest difference of a pixel's coverage between texture and exact: 0.12 where many outlines cross in a pixel."""

READING_LIMIT: Final = 0.2
"""Largest difference of a pixel's opacity or colour between drawing and reference."""

MEMORY: Final = 6 << 30
"""Bytes of address space for a child; compilers and libraries take one or two of these GiB."""

SECONDS: Final = 60.0
"""For one stage of one file."""

FIRST: Final = b'<svg viewBox="0 0 9 9"><style>path { stroke: red }</style><path d="M1 1h7v7z"/></svg>'
"""Drawn before any case, so that none pays for compilation and imports."""

Facts = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Case:
    """One file of a corpus, and an SVG with the same content if it is no SVG itself."""

    corpus: str
    name: str
    content: bytes
    same: bytes | None = None


class Child:
    """A process that judges cases, one at a time; `find` yields the facts of a case, a stage at a time."""

    def __init__(self, find: Callable[[Case], Iterator[Facts]]) -> None:
        context = multiprocessing.get_context("spawn")  # a fork would share the threads of the parent
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(theirs, find), daemon=True)
        self.process.start()
        theirs.close()

    def judge(self, case: Case) -> Facts:
        """Return the facts of a case; ``died`` is the reason if the child died, which is then of no more use."""
        facts: Facts = {}
        try:
            self.pipe.send(case)
            while self.pipe.poll(SECONDS):
                part = self.pipe.recv()
                if part is None:
                    return facts
                facts |= part
        except (EOFError, OSError):
            self.process.join()
            return {**facts, "died": f"exit code {self.process.exitcode}"}
        self.close()
        return {**facts, "died": f"no answer in {SECONDS:g} s"}

    def close(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.join()
        self.pipe.close()


def serve(pipe: Connection, find: Callable[[Case], Iterator[Facts]]) -> None:
    """Judge what comes through a pipe; send the facts of each stage as soon as they are known."""
    warnings.simplefilter("ignore", SourceWarning)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # of libraries that print their complaints about a file
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    list(find(Case("", "first.svg", FIRST)))
    while True:
        try:
            case = pipe.recv()
        except EOFError:
            return
        for facts in find(case):
            pipe.send(facts)
        pipe.send(None)


def stages(case: Case) -> Iterator[Facts]:
    """Facts of a case, a stage at a time."""
    try:
        drawing, texture, seconds = convert_case(case)
        excuses = [note for note in drawing.notes if note.kind != "remark"]
        yield {"seconds": seconds, "notes": line_of(case.name, excuses)}
        yield {"texture": texture_gap(drawing, texture)}
    except VextureError as error:
        yield {"refused": str(error)}
        return
    except Exception:
        yield {"broken": traceback.format_exc(limit=-3)}
        return
    try:
        reading = reading_gaps(case, drawing)
    except Exception as error:  # of the references, which refuse what we read
        reading = {"unjudged": str(error) or type(error).__name__}
    yield reading


def convert_case(case: Case) -> tuple[Drawing, Any, float]:
    """Convert a case; return its drawing, its texture, and the processor's seconds from file to file."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / Path(case.name).name
        source.write_bytes(case.content)
        start = time.process_time()
        drawing = vexture.read(source)
        texture = vexture.convert(drawing, split=None)
        texture.save(source.with_suffix(".ktx2"))
        return drawing, texture, time.process_time() - start


def texture_gap(drawing: Drawing, texture: Any) -> float:
    """Largest difference of coverage between a texture and exact."""
    exact = vexture.coverage(drawing, SIZE, renderer="exact")
    return float(np.abs(texture.coverage(SIZE, renderer="cpu") - exact).max())


@cache
def resvg_options() -> resvg.usvg.Options:
    """Options of resvg with the same fonts as ours: those of fontconfig's file (`same_fonts.py`), or all."""
    file = os.environ.get("FONTCONFIG_FILE")
    if file is not None:
        return options_of_resvg(Path(file).parent)
    options = resvg.usvg.Options.default()
    options.load_system_fonts()
    return options


def reading_gaps(case: Case, drawing: Drawing) -> Facts:
    """Largest differences between the pictures of a drawing and the references' of its file."""
    gaps: Facts = {}
    for finer in FINER:
        text, size = enlarge(case.same or case.content, drawing, SIZE * finer)
        tree = resvg.usvg.Tree.from_str(text.decode(), resvg_options())
        theirs = np.asarray(Image.open(io.BytesIO(bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0))))).convert("RGBA"))
        ours = draw_with_skia(drawing, theirs.shape[:2], size)
        gaps = {"resvg": difference(ours, theirs, finer)}
        if gaps["resvg"] <= READING_LIMIT:
            return gaps
    return gaps | {"skia": difference(ours, skia_reading(text, theirs.shape[:2], size), finer)}


def enlarge(content: bytes, drawing: Drawing, side: int) -> tuple[bytes, tuple[float, float]]:
    """Set the longer side of an SVG, in pixels; return the SVG and its size."""
    framed = framed_drawing(content, "")[1]
    root = parse_svg(decompress(content))
    if framed is not None:
        size, box = framed[0], (0.0, 0.0, *framed[0])
    else:  # as large as what it paints
        ends = np.concatenate([path.box for path in drawing.paths])
        low, high = ends.min(axis=0), ends.max(axis=0)
        (left, right), (bottom, top) = (drawing.to_source @ np.array([*np.stack([low, high]).T, [1.0, 1.0]])).tolist()
        size, box = (right - left, bottom - top), (left, top, right - left, bottom - top)
    scale = side / max(size)
    shown = size[0] * scale, size[1] * scale
    if root.get("viewBox") is None:
        root.set("viewBox", " ".join(f"{value:.9g}" for value in box))
    root.set("width", f"{shown[0]:.9g}")
    root.set("height", f"{shown[1]:.9g}")
    return etree.tostring(root), shown


def draw_with_skia(drawing: Drawing, shape: tuple[int, int], size: tuple[float, float]) -> NDArray[np.uint8]:
    """Draw a drawing with Skia, the top left corner of its box in the corner of the picture."""
    pixels = np.zeros((*shape, 4), np.uint8)
    side = max(size)
    matrix = np.array([[side, 0.0, (size[0] - side) / 2], [0.0, -side, (size[1] + side) / 2], [0.0, 0.0, 1.0]])
    with skia.Surface(pixels) as canvas:
        paint_with_skia(canvas, drawing, matrix)
    return pixels


def skia_reading(text: bytes, shape: tuple[int, int], size: tuple[float, float]) -> NDArray[np.uint8]:
    """Draw an SVG with Skia's own reader."""
    pixels = np.zeros((*shape, 4), np.uint8)
    with skia.Surface(pixels) as canvas:
        document = skia.SVGDOM.MakeFromStream(skia.MemoryStream(text))
        document.setContainerSize(skia.Size(*size))
        document.render(canvas)
    return pixels


def difference(ours: NDArray[np.uint8], reference: NDArray[np.uint8], finer: int) -> float:
    """Largest difference of opacity or of a premultiplied colour, of pixels `finer` times as large."""
    gap = premultiply(ours) - premultiply(reference)
    rows, columns = (-length % finer for length in gap.shape[:2])
    gap = np.pad(gap, ((0, rows), (0, columns), (0, 0)))
    coarse = gap.reshape(gap.shape[0] // finer, finer, -1, finer, 4).mean(axis=(1, 3))
    return float(np.abs(coarse).max())


def premultiply(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    scaled = (pixels / 255.0).astype(np.float32)
    scaled[..., :3] *= scaled[..., 3:]
    return scaled
