"""How large packed textures are, beside the SVG source, the thesis's textures and the band layout.

    python evidence/benchmarks/size.py [--quick] [--seed 1]

Bytes of whole sets: packed, a set is one texture; of the others, the sum over its drawings. *packed* counts 16 bytes
for each quad and curve, *padded* is the texture in the device's memory, whose rows are full, *file* the KTX2 file;
*raw* are the thesis's lists, *files* its pairs of PNG files. "-2" says that a form cannot hold 2 of the drawings. *SVG*
is the file, or for glyphs and coastlines the shortest we could write: one path, font units or six digits. *bands* is
the published layout computed from its definition, equal lists written once; *unshared*, every list.
"""

import argparse
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from fontTools.pens.svgPathPen import SVGPathPen
from fontTools.ttLib import TTFont

import corpora
from packed_conversion import joined
from report import cell, table, write_json
from targets import Target, judged, judgement
from vexture.drawing import Drawing
from vexture.errors import LimitError, SourceWarning
from vexture.pipeline import run
from vexture.svg.read import read_svg
from vexture.tree.build import build_tree
from vexture_evidence.measures.bands import BANDS, COASTLINE_BANDS, band_texture
from vexture_evidence.measures.machine import machine_facts, machine_line

__all__ = ["Set", "coastline_svg", "set_facts"]

SHAPES = Path(__file__).parents[2] / "examples" / "shapes"
EDGES: Final = (768, 12_288, 98_304)
ICONS: Final = 150
TOLERANCE: Final = 1e-4
TEXEL_BYTES: Final = 16
SVG: Final = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><path d="{path}"/></svg>'


class Set(NamedTuple):
    """Drawings that share a row, and the bytes of their sources."""

    name: str
    drawings: Sequence[Drawing]
    svg: int
    bands: int = BANDS
    tolerance: float = 0.0


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


def drawn(name: str, paths: Sequence[Path]) -> Set:
    """Set of SVG files."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return Set(name, [read_svg(path) for path in paths], sum(path.stat().st_size for path in paths))


def sets(quick: bool, seed: int) -> Iterator[Set]:
    """Everything that is measured."""
    for name, font in (("DejaVu Sans", corpora.dejavu_sans()), ("STIX", corpora.stix())):
        text = corpora.ALPHANUMERICS
        yield Set(f"{name} a-zA-Z0-9", corpora.glyphs(font, text), glyph_svg(font, text))
    yield drawn("example shapes", sorted(SHAPES.glob("*.svg")))
    count = 10 if quick else ICONS
    yield drawn(f"mdi, {count}", corpora.mdi(count, seed))
    yield drawn(f"simple-icons, {count}", corpora.simple_icons(count, seed))
    for island in (corpora.fractal_coastline(edges, seed) for edges in EDGES):
        yield Set(island.name, [island], coastline_svg(island), COASTLINE_BANDS)
    yield Set(f"{island.name}, {TOLERANCE:g}", [island], coastline_svg(island), COASTLINE_BANDS, TOLERANCE)


def thesis_facts(drawings: Sequence[Drawing], bits: int) -> dict[str, int]:
    """Bytes of the thesis's textures, and how many drawings are too much for them."""
    facts = {"raw": 0, "file": 0, "left_out": 0}
    for drawing in drawings:
        try:
            texture = run(drawing, bits=bits, encoding="thesis").texture
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


def set_facts(measured: Set) -> dict[str, Any]:
    """Bytes of one set in every form."""
    trees = [build_tree(drawing, tolerance=measured.tolerance) for drawing in measured.drawings]
    texture = joined(trees, measured.drawings)
    texels = sum(len(tree.count) + len(tree.curves) for tree in trees)
    lossless = not measured.tolerance  # the others have their own idea of a tolerance
    return {
        "set": measured.name,
        "drawings": len(measured.drawings),
        "edges": sum(drawing.segments for drawing in measured.drawings),
        "svg": measured.svg,
        "packed": {"raw": TEXEL_BYTES * texels, "padded": texture.nbytes, "file": len(texture.to_ktx2())},
        "thesis_8": thesis_facts(measured.drawings, 8) if lossless else None,
        "thesis_16": thesis_facts(measured.drawings, 16) if lossless else None,
        "bands": band_facts(measured.drawings, measured.bands) if lossless else None,
    }


HEAD = ("bytes", "drawings", "edges", "SVG", "packed", "each", "per edge", "padded", "file", "8 bits raw", "files")
HEAD += ("16 bits raw", "files", "bands", "unshared", "packed/bands")


def line(facts: dict[str, Any]) -> list[str]:
    """Row of one set."""
    raw = facts["packed"]["raw"]

    def known(form: str, what: str) -> str:
        if facts[form] is None:
            return cell(None)
        left_out = facts[form].get("left_out", 0)
        return cell(facts[form][what]) + (f" -{left_out}" if left_out else "")

    comparable = facts["bands"] and not facts["bands"]["left_out"]

    return [
        facts["set"],
        str(facts["drawings"]),
        str(facts["edges"]),
        str(facts["svg"]),
        str(raw),
        cell(raw / facts["drawings"], 0),
        cell(raw / facts["edges"], 1),
        known("packed", "padded"),
        known("packed", "file"),
        *(known(form, what) for form in ("thesis_8", "thesis_16") for what in ("raw", "file")),
        known("bands", "shared"),
        known("bands", "unshared"),
        cell(raw / facts["bands"]["shared"] if comparable else None),
    ]


def targets(found: Sequence[dict[str, Any]]) -> list[Target]:
    """What the issue asks."""
    by_name = {facts["set"]: facts for facts in found}
    made = []
    for name in ("DejaVu Sans a-zA-Z0-9", "STIX a-zA-Z0-9"):
        share = by_name[name]["packed"]["raw"] / by_name[name]["bands"]["shared"]
        made.append(Target(f"raw bytes against bands, {name}", share, 1.0, 0.6))
    lossless = by_name[f"coastline-{EDGES[-1]}"]["packed"]["raw"]
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
    print("\n".join(["", judgement(reached), "", machine_line(machine)]))
    facts = {"machine": machine, **vars(arguments), "sets": found, "targets": judged(reached)}
    print(write_json("size", facts))


if __name__ == "__main__":
    main()
