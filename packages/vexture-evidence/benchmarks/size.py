"""Sizes of packed textures, beside the SVG source, the thesis's textures and the band layout.

    python packages/vexture-evidence/benchmarks/size.py [--quick] [--seed 1]

Bytes of whole sets: packed, a set is one texture; of the others, the sum over its drawings. *packed* counts 16 bytes
for each quad and curve, *padded* is the texture in the device's memory, whose rows are full, *file* the KTX2 file;
*raw* are the thesis's lists, *files* its pairs of PNG files. "-2" means that 2 drawings do not fit in a form. *SVG*
is the file, or for glyphs and coastlines the shortest we could write: one path, font units or six digits. *bands* is
the published layout computed from its definition, equal lists written once; *unshared*, every list.

The second table shows the bytes that a browser receives for Lucide's icons, by the encoding of the server's answer.
"""

import argparse
import gzip
import shutil
import subprocess
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from fontTools.pens.svgPathPen import SVGPathPen
from fontTools.ttLib import TTFont

import corpora
from packed_conversion import join_trees
from report import cell, table, write_json
from targets import Target, target_facts, target_table
from vexture.base.errors import LimitError, SourceWarning
from vexture.base.tolerance import UNSEEN
from vexture.conversion.pipeline import run_encoding
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg
from vexture.texture.texture import Texture
from vexture.tree.build import build_tree
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, band_texture
from vexture_evidence.measures.machine import machine_facts, machine_line

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"
EDGES: Final = (768, 12_288, 98_304)
ICONS: Final = 150
TOLERANCE: Final = 1e-4
TEXEL_BYTES: Final = 16
LUCIDE: Final = "Lucide"
GLYPH_BYTES: Final = 400
MIB: Final = 2**20
MB: Final = 1e6
BROTLI: Final = """
const zlib = require('zlib'), parameters = { [zlib.constants.BROTLI_PARAM_QUALITY]: Number(process.argv[1]) };
parameters[zlib.constants.BROTLI_PARAM_LGWIN] = zlib.constants.BROTLI_MAX_WINDOW_BITS;
process.stdout.write(zlib.brotliCompressSync(require('fs').readFileSync(0), { params: parameters }));
"""
SVG: Final = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><path d="{path}"/></svg>'


class SizeSet(NamedTuple):
    """Drawings that share a row, and the bytes of their sources."""

    name: str
    drawings: Sequence[Drawing]
    svg: int
    bands: int = BANDS
    tolerance: float = UNSEEN
    received: bool = False  # whether to measure the bytes that a browser receives, and not the other forms


def glyph_svg(font: Path, text: str) -> int:
    """Bytes of SVG files of some glyphs, one path each in font units."""
    total = 0
    with TTFont(font) as opened:
        outlines, names = opened.getGlyphSet(), opened.getBestCmap()
        for character in text:
            pen = SVGPathPen(outlines)
            outlines[names[ord(character)]].draw(pen)
            total += len(SVG.format(box="0 0 1000 1000", path=pen.getCommands()))
    return total


def coastline_svg(drawing: Drawing) -> int:
    """Bytes of an SVG file of a polygon, six digits after the point.

    Examples
    --------
    >>> coastline_svg(Drawing.polygon([(0, 0), (1, 0), (0, 1)])) - len(SVG.format(box="0 0 1 1", path=""))
    55
    """
    points = np.concatenate([contour[:, 0] for path in drawing.paths for contour in path.contours])
    path = "M" + " ".join(f"{x:.6f},{1.0 - y:.6f}" for x, y in points) + "Z"
    return len(SVG.format(box="0 0 1 1", path=path))


def svg_set(name: str, paths: Sequence[Path], received: bool = False) -> SizeSet:
    """Set of SVG files."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return SizeSet(
            name, [read_svg(path) for path in paths], sum(path.stat().st_size for path in paths), received=received
        )


def sets(quick: bool, seed: int) -> Iterator[SizeSet]:
    """All sets that are measured."""
    for name, font in (("DejaVu Sans", corpora.dejavu_sans()), ("STIX", corpora.stix())):
        text = corpora.ALPHANUMERICS
        yield SizeSet(f"{name} a-zA-Z0-9", corpora.glyphs(font, text), glyph_svg(font, text))
    yield svg_set("example shapes", sorted(SHAPES.glob("*.svg")))
    count = 10 if quick else ICONS
    yield svg_set(f"mdi, {count}", corpora.mdi(count, seed))
    yield svg_set(LUCIDE, corpora.lucide()[:: ICONS if quick else 1], received=True)
    yield svg_set(f"simple-icons, {count}", corpora.simple_icons(count, seed))
    for island in (corpora.fractal_coastline(edges, seed) for edges in EDGES):
        yield SizeSet(island.name, [island], coastline_svg(island), COASTLINE_BANDS)
    yield SizeSet(f"{island.name}, lossless", [island], coastline_svg(island), COASTLINE_BANDS, 0.0)
    yield SizeSet(f"{island.name}, {TOLERANCE:g}", [island], coastline_svg(island), COASTLINE_BANDS, TOLERANCE)


def thesis_facts(drawings: Sequence[Drawing], bits: int) -> dict[str, int]:
    """Bytes of the thesis's textures, and how many drawings they cannot hold."""
    facts = {"raw": 0, "file": 0, "left_out": 0}
    for drawing in drawings:
        try:
            texture = run_encoding(drawing, "thesis", bits=bits).texture
        except LimitError:
            facts["left_out"] += 1
            continue
        facts["raw"] += texture.quads.nbytes + texture.curves.nbytes
        facts["file"] += sum(map(len, texture.to_png()))
    return facts


def band_facts(drawings: Sequence[Drawing], bands: int) -> dict[str, int]:
    """Bytes of the band layout, and how many drawings it cannot hold."""
    facts = {"shared": 0, "unshared": 0, "left_out": 0}
    for drawing in drawings:
        try:
            texture = band_texture(drawing, bands)
        except LimitError:
            facts["left_out"] += 1
            continue
        facts["shared"] += texture.published_bytes
        facts["unshared"] += texture.unshared_bytes
    return facts


def piped_bytes(data: bytes, *command: str) -> int:
    """Number of bytes that a command prints for its input."""
    return len(subprocess.run(command, input=data, stdout=subprocess.PIPE, check=True).stdout)


def received_bytes(texture: Texture) -> dict[str, dict[str, int]]:
    """Bytes of a texture's file, plain and deflated, in each content encoding; those without a tool are left out."""
    facts = {}
    for name, deflate in (("plain", False), ("deflated", True)):
        data = texture.to_ktx2(deflate=deflate)
        facts[name] = {"identity": len(data), "gzip 9": len(gzip.compress(data, 9))}
        if shutil.which("node"):
            facts[name] |= {f"brotli {level}": piped_bytes(data, "node", "-e", BROTLI, level) for level in ("5", "11")}
        if shutil.which("zstd"):
            facts[name] |= {f"zstd {level}": piped_bytes(data, "zstd", f"-{level}", "-c") for level in ("3", "19")}
    return facts


def set_facts(measured: SizeSet) -> dict[str, Any]:
    """Bytes of one set in every form."""
    trees = [build_tree(drawing, tolerance=measured.tolerance) for drawing in measured.drawings]
    texture = join_trees(trees, measured.drawings)
    texels = sum(len(tree.count) + len(tree.curves) for tree in trees)
    # the other forms define a tolerance differently
    compared = measured.tolerance == UNSEEN and not measured.received
    return {
        "set": measured.name,
        "drawings": len(measured.drawings),
        "edges": sum(drawing.segments for drawing in measured.drawings),
        "svg": measured.svg,
        "packed": {"raw": TEXEL_BYTES * texels, "padded": texture.nbytes, "file": len(texture.to_ktx2())},
        "thesis_8": thesis_facts(measured.drawings, 8) if compared else None,
        "thesis_16": thesis_facts(measured.drawings, 16) if compared else None,
        "received": received_bytes(texture) if measured.received else None,
        "bands": band_facts(measured.drawings, measured.bands) if compared else None,
    }


HEAD = ("bytes", "drawings", "edges", "SVG", "packed", "each", "per edge", "padded", "file", "8 bits raw", "files")
HEAD += ("16 bits raw", "files", "bands", "unshared", "packed/bands")


def line(facts: dict[str, Any]) -> list[str]:
    """Row of one set."""
    raw = facts["packed"]["raw"]

    def known_cell(form: str, form_figure: str) -> str:
        if facts[form] is None:
            return cell(None)
        left_out = facts[form].get("left_out", 0)
        return cell(facts[form][form_figure]) + (f" -{left_out}" if left_out else "")

    comparable = facts["bands"] and not facts["bands"]["left_out"]

    return [
        facts["set"],
        str(facts["drawings"]),
        str(facts["edges"]),
        str(facts["svg"]),
        str(raw),
        cell(raw / facts["drawings"], 0),
        cell(raw / facts["edges"], 1),
        known_cell("packed", "padded"),
        known_cell("packed", "file"),
        *(known_cell(form, what) for form in ("thesis_8", "thesis_16") for what in ("raw", "file")),
        known_cell("bands", "shared"),
        known_cell("bands", "unshared"),
        cell(raw / facts["bands"]["shared"] if comparable else None),
    ]


def targets(found: Sequence[dict[str, Any]]) -> list[Target]:
    """Targets for sizes."""
    by_name = {facts["set"]: facts for facts in found}
    made = []
    for name, least in (("DejaVu Sans a-zA-Z0-9", 0.65), ("STIX a-zA-Z0-9", 0.5)):
        raw, bands = by_name[name]["packed"]["raw"], by_name[name]["bands"]["shared"]
        count = by_name[name]["drawings"]
        made.append(Target(f"raw bytes against bands, {name}", raw / bands, least, least))
        made.append(Target(f"raw bytes of a glyph, {name}", raw / count, least * bands / count, GLYPH_BYTES))
    icons = by_name[LUCIDE]
    best = min(size for sizes in icons["received"].values() for size in sizes.values())
    made.append(Target("icons of Lucide on the GPU (MiB)", icons["packed"]["padded"] / MIB, 2.2, 1.4))
    made.append(Target("icons of Lucide as they are received (MB)", best / MB, 0.75, 0.4))
    lossless = by_name[f"coastline-{EDGES[-1]}, lossless"]["packed"]["raw"]
    within = by_name[f"coastline-{EDGES[-1]}, {TOLERANCE:g}"]["packed"]["raw"]
    made.append(Target(f"{EDGES[-1]:,} edges within {TOLERANCE:g} against lossless", within / lossless, 0.25, 0.125))
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description="Bytes of packed textures and of others.")
    parser.add_argument("--quick", action="store_true", help="fewer icons")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    found = [set_facts(measured) for measured in sets(arguments.quick, arguments.seed)]
    reached, machine = targets(found), machine_facts()
    print(table(HEAD, [line(facts) for facts in found]))
    for sizes in (facts["received"] for facts in found if facts["received"]):
        rows = [[name, *map(str, of_file.values())] for name, of_file in sizes.items()]
        print("\n" + table((LUCIDE, *next(iter(sizes.values()))), rows))
    print("\n".join(["", target_table(reached), "", machine_line(machine)]))
    facts = {"machine": machine, **vars(arguments), "sets": found, "targets": target_facts(reached)}
    print(write_json("size", facts))


if __name__ == "__main__":
    main()
