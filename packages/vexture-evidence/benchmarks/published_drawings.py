"""Published drawings against resvg's pictures: how many are right, by the rule of `conformance.py`.

    python packages/vexture-evidence/benchmarks/published_drawings.py [--count 60] [--seed 3] [--only TEXT]

From each collection, `--count` drawings are taken at random. A drawing is drawn from its texture, 200 pixels wide, on
white; resvg draws it four times as large. It is right if fewer than 0.5 % of the pixels are off by more than 40 of 255,
else *named* if a note says what differs, or *silent*.
"""

import argparse
import io
import time
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import resvg
from numpy.typing import NDArray
from PIL import Image

import corpora
import vexture
from conformance import FINER, MOST_OFF, SIDE, on_white, share_off
from judge import enlarge, resvg_options
from report import cell, table
from vexture.base.errors import SourceWarning
from vexture.conversion.reading import read_drawing
from vexture.drawing.drawing import Drawing
from vexture_evidence.measures.machine import machine_facts, machine_line

MOST_SEGMENTS: Final = 20_000
"""Of a drawing; larger ones are counted as left aside."""

COLLECTIONS: Final = {
    "emoji: Twemoji": corpora.TWEMOJI,
    "emoji: OpenMoji": corpora.OPENMOJI,
    "emoji: Fluent, flat": corpora.FLUENT_FLAT,
    "emoji: Fluent, modern": corpora.FLUENT_MODERN,
    "logos: Simple Icons": corpora.SIMPLE_ICONS,
    "logos: Devicon": corpora.DEVICON,
    "flags: flag-icons": corpora.FLAG_ICONS,
    "clip art: Tango": corpora.TANGO,
    "clip art: openclipart": corpora.OPENCLIPART,
    "icons: Lucide": corpora.LUCIDE,
    "icons: Material Design": corpora.MDI,
    "icons: Font Awesome": corpora.FONT_AWESOME,
}


class Judgement(NamedTuple):
    """Outcome of a drawing, "right", "named" or "silent", and the processor's seconds to convert and draw it."""

    outcome: str
    seconds: float


def files_of(collection: corpora.Package | corpora.DebianPackage) -> list[Path]:
    """All drawings of a collection, in any of its folders."""
    if isinstance(collection, corpora.DebianPackage):
        return collection.files("*.svg")
    return collection.all()


def draw_on_white(drawing: Drawing, sides: tuple[int, int], size: tuple[float, float]) -> NDArray[np.int16]:
    """Our picture on white, of whole pixels only; `size` is that of the drawing in pixels."""
    side = max(size)
    to_unit = [[1 / side, 0.0, 0.5 - 0.5 * size[0] / side], [0.0, -1 / side, 0.5 + 0.5 * size[1] / side]]
    image = vexture.render(drawing, sides, to_unit)
    return np.rint(255.0 * (image[..., :3] + 1.0 - image[..., 3:])).astype(np.int16)


def judge_drawing(file: Path) -> Judgement | None:
    """Judge a drawing; None if it is too large."""
    start = time.process_time()
    drawing = read_drawing(file.read_bytes(), name=file.name)
    if drawing.segments > MOST_SEGMENTS:
        return None
    text, (width, height) = enlarge(file.read_bytes(), drawing, SIDE * FINER)
    sides = max(1, int(width / FINER)), max(1, int(height / FINER))
    ours = draw_on_white(drawing, sides, (width / FINER, height / FINER))
    seconds = time.process_time() - start
    tree = resvg.usvg.Tree.from_str(text.decode(), resvg_options())
    theirs = on_white(Image.open(io.BytesIO(bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0))))))
    theirs = theirs.crop((0, 0, FINER * sides[0], FINER * sides[1])).resize(sides, Image.Resampling.BOX)
    if share_off(ours, np.asarray(theirs, np.int16)) < MOST_OFF:
        return Judgement("right", seconds)
    return Judgement("named" if any(note.is_loss for note in drawing.notes) else "silent", seconds)


def rows(names: Sequence[str], count: int, seed: int) -> Iterator[list[str]]:
    """A row for each collection."""
    for name in names:
        files = files_of(COLLECTIONS[name])
        chosen = np.random.default_rng(seed).permutation(len(files))[:count].tolist()
        found = [one for one in map(judge_drawing, [files[at] for at in chosen]) if one is not None]
        outcomes = [one.outcome for one in found]
        counts = [str(outcomes.count(outcome)) for outcome in ("right", "named", "silent")]
        seconds = np.percentile([one.seconds for one in found], (50, 99)).tolist()
        yield [name, str(len(found)), *counts, *(cell(value, 2) for value in seconds)]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--only", default="", help="collections of which the name has this text")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", SourceWarning)
    names = [name for name in COLLECTIONS if arguments.only in name]
    head = ("collection", "drawings", "right", "named", "silent", "s, median", "s, 99 %")
    print(table(head, list(rows(names, arguments.count, arguments.seed))))
    print(f"\n{machine_line(machine_facts())}")


if __name__ == "__main__":
    main()
