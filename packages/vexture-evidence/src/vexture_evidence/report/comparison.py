"""Comparison with raster textures, distance fields, CPU renderers and bands, all measured in the same run."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from vexture.base.errors import LimitError
from vexture_evidence.figures.comparisons import CORNER, equal_bytes, error_over_bytes
from vexture_evidence.measures.distance import SPREAD, distance_from
from vexture_evidence.measures.raster import raster_from
from vexture_evidence.measures.rivals import (
    MAGNIFICATION,
    MOST_TEXELS,
    NARROW,
    SHIFTS,
    SMALL,
    WHOLE,
    MeasuredRival,
    Rival,
    distance_rival,
    measure_rival,
    raster_rival,
    scene_of,
    side_in_file,
    side_in_memory,
    texture_rival,
)
from vexture_evidence.report.renderers import bands_part, dashes, renderers_part
from vexture_evidence.report.section import Material, PrintedPicture, Section, Table

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing
    from vexture_evidence.measures.rivals import RivalScene
    from vexture_evidence.measures.shape import ConvertedDrawing

RASTER_SIDES: Final = (16, 32, 64, 128, 256, 512, 1024)
DISTANCE_SIDES: Final = (16, 32, 64, 128, 256)
"""Sides of the textures that are measured, in texels."""

HEAD: Final = (
    "texture",
    "texels along a side",
    "bytes: file",
    "bytes: on the GPU",
    f"mean error: {WHOLE} px",
    f"mean error: outline {MAGNIFICATION}×",
    f"mean error: {SMALL} px",
    f"largest error: outline {MAGNIFICATION}×",
)

EQUAL_HEAD: Final = ("texels", "memory ×", f"error {MAGNIFICATION}×")


class Equal(NamedTuple):
    """Raster textures and distance fields that take as many bytes as a packed texture."""

    raster_in_memory: Rival
    raster_in_file: Rival
    distance_in_memory: Rival
    distance_in_file: Rival
    narrow_in_file: Rival


class Compared(NamedTuple):
    """A drawing's packed texture and rivals of equal bytes, or the reason why there is no packed texture."""

    shape: "ConvertedDrawing"
    scene: "RivalScene"
    packed: MeasuredRival | None
    equal: Sequence[MeasuredRival]
    why: str


def section(material: Material) -> Section:
    """Compare our textures with the usual alternatives, which the thesis did not measure."""
    compared = [compare(shape) for shape in material.shapes]
    main = next(one for one in compared if one.shape is material.main)
    parts = [pictures_part(main), shapes_part(compared), renderers_part(material.shapes)]
    text = [
        "The thesis compares its textures with no alternatives. This section compares them with the obvious ones, each "
        "made as well as it can be: raster textures from exact coverage and distance fields from true distances, both "
        "filtered as OpenGL defines it, in float64; two renderers of vector graphics; and the bands that fast glyph "
        "renderers use. Distance fields have one channel here. Multi-channel distance fields, which keep corners, are "
        "not measured, and neither is anisotropic filtering.",
        "Errors are mean absolute differences from exact coverage, in steps of 1/255, over the pixels that the shape "
        "touches in the picture or in the truth (the exact coverage). Pictures of the whole drawing are shifted by a "
        f"fraction of a pixel (by {SHIFTS[0][0]:g} and {SHIFTS[0][1]:g} at {WHOLE} pixels; by {len(SHIFTS)} different "
        f"shifts at {SMALL} pixels), because the texels of a texture on a surface never line up with the screen's "
        "pixels.",
    ]
    if material.device is None:
        text.append("This machine has no GPU, so the bands, which need one, are left out.")
    else:
        parts.append(bands_part(material.shapes, material.device))
    return Section("comparison", "Comparison with alternatives", text, parts)


def compare(shape: "ConvertedDrawing") -> Compared:
    """Measure a drawing's packed texture, and the rivals of equal bytes."""
    drawing, scene = shape.drawing, scene_of(shape.drawing)
    try:
        packed = measure_rival(texture_rival(shape.way("packed").texture, "packed"), scene)
    except LimitError as error:
        return Compared(shape, scene, None, (), str(error))
    return Compared(shape, scene, packed, [measure_rival(rival, scene) for rival in equals(drawing, packed.rival)], "")


def equals(drawing: "Drawing", packed: Rival) -> Equal:
    """Rivals that take as many bytes as a packed texture, in its file or on the GPU."""
    in_memory, file = side_in_memory(packed.gpu_bytes), packed.file_bytes or 0

    def field_in_file(spread: float) -> Rival:
        side = side_in_file(lambda side: distance_from(drawing, side, spread, mips=False), file)
        return distance_rival(drawing, side, spread)

    return Equal(
        raster_rival(drawing, in_memory),
        raster_rival(drawing, side_in_file(lambda side: raster_from(drawing, side, mips=False), file)),
        distance_rival(drawing, in_memory),
        field_in_file(SPREAD),
        field_in_file(NARROW),
    )


def pictures_part(main: Compared) -> Section:
    """Raster textures and distance fields of one drawing, at many sizes and at equal bytes."""
    drawing, scene = main.shape.drawing, main.scene
    rasters = [measure_rival(raster_rival(drawing, side), scene) for side in RASTER_SIDES]
    fields = [
        measure_rival(distance_rival(drawing, side, spread), scene)
        for spread in (SPREAD, NARROW)
        for side in DISTANCE_SIDES
    ]
    ours, missing = others_of_ours(main)
    whats = ("equal memory", "equal file", "equal memory", "equal file", "equal file")
    rows = [
        *(row_of(found.rival.label, found) for found in rasters),
        *(row_of(f"{found.rival.label}, {what}", found) for what, found in zip(whats, main.equal, strict=False)),
        *(row_of(found.rival.label, found) for found in ours),
        *((way, *(None for _ in HEAD[1:])) for way in missing),
    ]
    series = [*rasters, *fields, *ours]
    items: list[Table | PrintedPicture] = [
        Table("rival-textures", textures_caption(main, missing), HEAD, rows),
        PrintedPicture("error-over-bytes", error_over_bytes(series), bytes_caption(main, rasters), BYTES_ALT),
    ]
    if main.packed and drawing.segments:
        equal = Equal(*(found.rival for found in main.equal))
        shown = (equal.raster_in_memory, equal.raster_in_file, equal.distance_in_file, equal.narrow_in_file)
        figure = equal_bytes(drawing, [*shown, main.packed.rival])
        items.append(PrintedPicture("equal-bytes", figure, strip_caption(main), STRIP_ALT))
    facts = {"fields": [row_of(found.rival.label, found) for found in fields]}
    return Section("raster-textures", "Raster textures and distance fields", (), items, facts)


def others_of_ours(main: Compared) -> tuple[list[MeasuredRival], dict[str, str]]:
    """The drawing measured in each of our encodings, and the reasons why some cannot hold it."""
    found, missing = [], {}
    if main.packed:
        found.append(main.packed)
    else:
        missing["packed"] = main.why
    for way in ("direct", "sampled"):
        try:
            found.append(measure_rival(texture_rival(main.shape.way(way).texture, way), main.scene))
        except LimitError as error:
            missing[way] = str(error)
    return found, missing


def row_of(label: str, found: MeasuredRival) -> Sequence[Any]:
    """One row of the table of textures."""
    rival = found.rival
    errors = (found.whole.mae, found.outline.mae, found.small.mae, found.outline.max)
    return (label, rival.side, rival.file_bytes, rival.gpu_bytes, *errors)


def shapes_part(compared: Sequence[Compared]) -> Section:
    """All drawings, each with rivals whose files have as many bytes."""
    kinds = ("raster", f"distance, spread {SPREAD:g}", f"distance, spread {NARROW:g}")
    first = ("drawing", "packed: file bytes", "packed: GPU bytes", f"packed: {EQUAL_HEAD[-1]}")
    head = (*first, *(f"{kind}: {column}" for kind in kinds for column in EQUAL_HEAD))
    rows = []
    for one in compared:
        row: list[Any] = [one.shape.name]
        if one.packed:
            row += [one.packed.rival.file_bytes, one.packed.rival.gpu_bytes, one.packed.outline.mae]
            equal = Equal(*(found.rival for found in one.equal))
            in_file = (equal.raster_in_file, equal.distance_in_file, equal.narrow_in_file)
            for found in (found for found in one.equal if found.rival in in_file):
                ratio = found.rival.gpu_bytes / max(1, one.packed.rival.gpu_bytes)
                row += [found.rival.side, ratio, found.outline.mae]
        rows.append(row + [None] * (len(head) - len(row)))
    table = Table("equal-files", shapes_caption(compared), head, rows)
    return Section("equal-files-of-all", "Every drawing at equal bytes", (), [table])


def textures_caption(main: Compared, missing: dict[str, str]) -> str:
    """Caption of the table of textures."""
    caption = (
        f"`{main.shape.name}` as a raster texture (8-bit alpha, mip-mapped), as a distance field (8 bits, distances up "
        f"to {SPREAD:g} texels, as usual, or {NARROW:g}, which suits magnification) and in our encodings. A file is a "
        "grey PNG, a KTX2 file, or the thesis's pair of PNG files. “Equal memory” and “equal file” are the largest "
        f"textures that take no more bytes than `packed`, up to {MOST_TEXELS:,} texels along a side, found by "
        "bisection (a few files are smaller than files of fewer texels). Errors are those of the whole drawing at "
        f"{WHOLE} pixels, of the outline at evenly spaced places enlarged {MAGNIFICATION} times, and of the whole "
        f"drawing at {SMALL} pixels."
    )
    return caption + dashes(missing.values())


def bytes_caption(main: Compared, rasters: Sequence[MeasuredRival]) -> str:
    """Caption of the figure of errors over bytes."""
    caption = (
        "Mean error over bytes, both on logarithmic scales, for the same textures and for distance fields of "
        f"{DISTANCE_SIDES[0]} to {DISTANCE_SIDES[-1]} texels along a side. Errors below 0.001/255 are drawn at "
        "0.001/255."
    )
    if main.packed is None:
        return caption
    largest = rasters[-1]
    return (
        f"{caption} At {MAGNIFICATION} times, the raster texture of {largest.rival.side:,} texels a side takes "
        f"{times(largest.rival.gpu_bytes, main.packed.rival.gpu_bytes)} the memory of `packed` and has an error of "
        f"{largest.outline.mae:.3g}; `packed` has {main.packed.outline.mae:.2g}. A distance field reproduces straight "
        f"edges but loses corners. At {SMALL} pixels a mip-map blends neighbouring texels that are as large as a "
        "pixel, and an average of distances does not give the coverage."
    )


def strip_caption(main: Compared) -> str:
    """Caption of the strip of pictures at equal bytes."""
    if main.packed is None:
        return ""
    equal = Equal(*(found.rival for found in main.equal))
    return (
        f"`{main.shape.name}` at equal bytes: the whole drawing and, {CORNER} times larger, the framed corner, where "
        "the outline turns most. Mean errors are in 1/255. The memory that `packed` takes, "
        f"{main.packed.rival.gpu_bytes:,} bytes, holds a raster texture of {at_least(equal.raster_in_memory)}² texels. "
        f"A PNG file as large as the file of `packed` holds one of {at_least(equal.raster_in_file)}² texels, which "
        f"takes {times(equal.raster_in_file.gpu_bytes, main.packed.rival.gpu_bytes)} the memory on the GPU. Magnified, "
        "raster textures blur and distance fields round the corner off; `packed` holds the drawing's own curves."
    )


def shapes_caption(compared: Sequence[Compared]) -> str:
    """Caption of the table of all drawings."""
    caption = (
        "The largest textures whose files are no larger than the file of `packed`: their texels along a side, their "
        "memory on the GPU as a multiple of that of `packed`, and the mean error of the outline enlarged "
        f"{MAGNIFICATION} times. The first columns give the bytes and the error of `packed`."
    )
    held = [one for one in compared if one.packed]
    # only drawings whose rivals take (nearly) as many bytes: a rival at the largest size that is tried takes fewer
    whole = [one for one in held if all(found.rival.side != MOST_TEXELS for found in one.equal)]
    best = [min(found.outline.mae for found in one.equal) for one in whole]
    ours = [one.packed.outline.mae for one in whole if one.packed]
    better = sum(mine <= other for mine, other in zip(ours, best, strict=True))
    if whole:
        caption += (
            f" At {MAGNIFICATION} times, the error of `packed` is at most that of the best of the others "
            f"on {better} of {len(whole)} drawings."
        )
    if len(held) > len(whole):
        caption += (
            f" {len(held) - len(whole)} of the drawings cannot be compared in this way: some of the others take fewer "
            f"bytes than `packed` even at {MOST_TEXELS:,} texels along a side, the largest size that is tried."
        )
    return caption + dashes(one.why for one in compared if one.why)


def at_least(rival: Rival) -> str:
    """Texels along a side, as text; "at least" if it is the largest size that is tried."""
    return f"{'at least ' if rival.side == MOST_TEXELS else ''}{rival.side}"


def times(many: int, few: int) -> str:
    """The ratio of two numbers of bytes, as text."""
    ratio = many / max(1, few)
    return f"{ratio:,.0f} times" if ratio >= 100.0 else f"{ratio:.3g} times"


BYTES_ALT: Final = (
    "Six plots of mean error against bytes, in the file and on the GPU, one mark or line for each kind of texture."
)

STRIP_ALT: Final = "The drawing and its corner, by raster textures, distance fields and packed, and the exact coverage."
