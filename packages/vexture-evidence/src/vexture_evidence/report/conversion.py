"""Table 5.1 of the thesis: how long conversions take, and how large their results are."""

from collections.abc import Mapping
from functools import partial
from statistics import median
from typing import Any, Final

from vexture.base.errors import LimitError
from vexture.conversion.reading import read_drawing
from vexture.thesis.layout import LIST_LIMIT
from vexture_evidence.figures.conversions import conversions
from vexture_evidence.measures.conversions import MeasuredConversion, frame_side, measure_conversion
from vexture_evidence.measures.shape import WAYS, ConvertedDrawing, convert_by
from vexture_evidence.measures.thesis_numbers import TABLE_5_1, Row
from vexture_evidence.measures.timing import median_seconds
from vexture_evidence.report.section import Material, Printed, PrintedPicture, Section, Table

READ_REPEAT: Final = 3
"""How often a file is read; the median time is reported."""

Found = Mapping[str, MeasuredConversion]
"""Measurements of a drawing by way of conversion; ways that cannot hold the drawing are absent."""


def section(material: Material) -> Section:
    """Measure all conversions of all drawings.

    Examples
    --------
    >>> from vexture_evidence.measures.shape import example
    >>> [item.name for item in section(Material([example("simple-small")])).items]
    ['conversion', 'size-and-speed', 'conversions']
    """
    shapes = material.shapes
    example = material.example("simple-small")
    for given in WAYS.values():
        convert_by(example.drawing, given)  # loads and compiles everything, so that no measured time includes it
    side = None if material.device is None else frame_side(example)
    found: list[dict[str, MeasuredConversion]] = []
    refused: list[str] = []
    for shape in shapes:
        found.append({})
        for way in WAYS:
            try:
                found[-1][way] = measure_conversion(shape, way, side)
            except LimitError as error:
                refused.append(f"{way}: {error}")
    printed = [None if material.own else TABLE_5_1.get(shape.name) for shape in shapes]
    speed = _speed(side)
    missing = f" A dash: {'; '.join(refused)}." if refused else ""
    items = (
        _conversion_table(shapes, printed, found, missing),
        _size_table(shapes, printed, found, f"{speed}{missing}{_without_8_bits(found)}"),
        _picture(shapes, printed, found, side),
    )
    facts = {"frame_side": side, "refused": refused, **_medians(found)}
    return Section("conversion", "Conversion", _text(material, found), items, facts)


def _text(material: Material, found: list[dict[str, MeasuredConversion]]) -> list[str]:
    first = (
        "A drawing is read, divided into a quad-tree, and written as a texture. `sampled` samples the outline and fits "
        "curves to the samples, as the thesis does. `direct` makes leaves of the same kind from the drawing's own "
        "curves. Both make a pair of images with one curve in each leaf. `packed` keeps several exact pieces of the "
        "outline in each leaf, in one file."
    )
    if not material.own:
        first += (
            " The thesis's own drawings are lost. Those used here show the same subjects with the same numbers of "
            "segments, but they are not the same drawings: compare orders of magnitude, not digits."
        )
    ratios = _medians(found)
    if not ratios:
        return [first]
    many = f"In the median of {len(found)} drawings" if len(found) > 1 else "For this drawing"
    return [
        first,
        f"{many}, `direct` has {ratios['curves_direct']:.0%} of the curves of `sampled`, and its conversion is "
        f"about {_about(ratios['times_direct'])} times as fast as that of `sampled`. The conversion to `packed` is "
        f"about {_about(ratios['times_packed'])} times as fast, "
        f"and its file has {ratios['bytes_packed']:.0%} of the bytes of the 16-bit pair of `sampled`.",
    ]


def _about(ratio: float) -> str:
    """A ratio of times, rounded to one digit, as more digits differ between runs."""
    return f"{float(f'{ratio:.1g}'):,.0f}"


def _medians(found: list[dict[str, MeasuredConversion]]) -> dict[str, float]:
    """Median ratios of our ways to the thesis's, over the drawings that all ways can hold."""
    whole = [each for each in found if len(each) == len(WAYS) and each["sampled"].curves]
    if not whole:
        return {}
    return {
        "curves_direct": median(each["direct"].curves / each["sampled"].curves for each in whole),
        "times_direct": median(each["sampled"].ms / each["direct"].ms for each in whole),
        "times_packed": median(each["sampled"].ms / each["packed"].ms for each in whole),
        "bytes_packed": median(_bytes(each, "packed") / _bytes(each, "sampled") for each in whole),
    }


def _bytes(found: Found, way: str) -> float:
    each = found[way]
    return float(each.bytes_packed or each.bytes_16 or 0)


def _speed(side: int | None) -> str:
    if side is None:
        return "This machine has no GPU, so no frame rates were measured."
    return (
        f"Frames show the whole drawing at {side} x {side} pixels, on the driver that the page names, and are not "
        "limited by the rate of a display. The thesis's rates are limited to ⟦120⟧ by its display, and it does not "
        "state their size in pixels."
    )


def _without_8_bits(found: list[dict[str, MeasuredConversion]]) -> str:
    """Reason why some columns of 8 bits contain dashes; empty if none does."""
    pairs = [one for each in found for way, one in each.items() if way != "packed"]
    if all(one.bytes_8 is not None for one in pairs):
        return ""
    return f" No bytes at 8 bits: a list would be longer than {LIST_LIMIT[8]} entries, the most that 8 bits can index."


def _conversion_table(
    shapes: tuple[ConvertedDrawing, ...],
    printed: list[Row | None],
    found: list[dict[str, MeasuredConversion]],
    missing: str,
) -> Table:
    compared = any(printed)
    head = ["drawing"]
    head += ["segments: thesis", "segments: ours", "reading: ms"] if compared else ["segments", "reading, ms"]
    for method in [*["thesis, printed"] * compared, *WAYS]:
        head += [f"{method}: {what}" for what in ("ms", "curves", "quads")]
    rows = []
    for shape, row, each in zip(shapes, printed, found, strict=True):
        cells: list[Any] = [shape.name, *[_as_printed(row and row.segments)] * compared, shape.drawing.segments]
        cells.append(1e3 * _reading_seconds(shape))
        if compared:
            cells += [_as_printed(row and row.ms), _as_printed(row and row.curves), _as_printed(row and row.quads)]
        for way in WAYS:
            one = each.get(way)
            cells += [None] * 3 if one is None else [one.ms, one.curves, one.quads]
        rows.append(cells)
    caption = (
        "Thesis Table 5.1, first part: the segments of each drawing, the time of its conversion, and the lengths of "
        "the two lists. Conversions are timed from the drawing in memory to the texture in memory. Times are medians, "
        f"except those above 50 ms, which were measured once.{missing}"
    )
    return Table("conversion", caption, head, rows)


def _size_table(
    shapes: tuple[ConvertedDrawing, ...],
    printed: list[Row | None],
    found: list[dict[str, MeasuredConversion]],
    notes: str,
) -> Table:
    compared = any(printed)
    head = ["drawing", "source: thesis", "source: ours"] if compared else ["drawing", "source"]
    if compared:
        head += [f"thesis, printed: {what}" for what in ("8 bits", "16 bits", "fps")]
    for way in WAYS:
        columns = ("bytes", "fps") if way == "packed" else ("8 bits", "16 bits", "fps")
        head += [f"{way}: {what}" for what in columns]
    rows = []
    for shape, row, each in zip(shapes, printed, found, strict=True):
        cells: list[Any] = [shape.name, *[_as_printed(row and row.svg)] * compared, shape.path.stat().st_size]
        if compared:
            cells += [_as_printed(row and row.bytes_8), _as_printed(row and row.bytes_16), _as_printed(row and row.fps)]
        for way in WAYS:
            one = each.get(way)
            if way == "packed":
                cells += [None, None] if one is None else [one.bytes_packed, one.fps]
            else:
                cells += [None] * 3 if one is None else [one.bytes_8, one.bytes_16, one.fps]
        rows.append(cells)
    caption = (
        "Thesis Table 5.1, second part: bytes of the source file and of the texture's files (a pair of PNG images with "
        f"8 or 16 bits for each number, or one KTX2 file), and frames per second (fps). {notes}"
    )
    return Table("size-and-speed", caption, head, rows)


def _reading_seconds(shape: ConvertedDrawing) -> float:
    return median_seconds(partial(read_drawing, shape.path), READ_REPEAT)


def _as_printed(value: int | float | None) -> Printed | None:
    return None if value is None else Printed(value)


def _picture(
    shapes: tuple[ConvertedDrawing, ...],
    printed: list[Row | None],
    found: list[dict[str, MeasuredConversion]],
    side: int | None,
) -> PrintedPicture:
    quantities: dict[str, dict[str, Any]] = {
        "milliseconds": {"printed": [row and row.ms for row in printed]},
        "curves": {"printed": [row and row.curves for row in printed]},
        "bytes, 16 bits or packed": {"printed": [row and row.bytes_16 for row in printed]},
        "frames per second": {},
    }
    for way in WAYS:
        each = [one.get(way) for one in found]
        quantities["milliseconds"][way] = [one and one.ms for one in each]
        quantities["curves"][way] = [one and one.curves for one in each]
        quantities["bytes, 16 bits or packed"][way] = [one and (one.bytes_packed or one.bytes_16) for one in each]
        quantities["frames per second"][way] = [one and one.fps for one in each]
    if not any(printed):
        for methods in quantities.values():
            methods.pop("printed", None)
    if side is None:
        del quantities["frames per second"]
    caption = (
        "Thesis Table 5.1 as a picture: each mark is one drawing converted by one method, on logarithmic scales. Less "
        "is better, except for frames per second" + (". The thesis's frame rates are left out, because its display "
        "limited them to 120." if any(printed) else ".")
    )  # fmt: skip
    figure = conversions([shape.name for shape in shapes], quantities)
    return PrintedPicture(
        "conversions", figure, caption, "Marks for each drawing and method: time, curves, bytes, frames per second"
    )
