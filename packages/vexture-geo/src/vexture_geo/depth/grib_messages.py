"""Messages of GRIB: how many fields of which grids they hold, which is known before GDAL decodes one of them.

GDAL takes the grid of the first field for that of all, and allocates what a header says.
References: WMO Manual on Codes, I.2, FM 92 GRIB editions 1 and 2.
"""

from collections.abc import Iterator
from typing import Final

from vexture.base.content import GRIB
from vexture.base.deadline import check_time
from vexture.base.errors import LimitError, SourceError

MOST_FIELDS: Final = 10_000
"""Fields of a file. A year of hours has fewer; GDAL lists all of them before one can be chosen."""

MOST_POINTS: Final = 2**25
"""Points of a grid, of which GDAL has some copies as doubles; those of weather radars have 25 million."""

END: Final = b"7777"
REDUCED: Final = 0xFFFFFFFF, 0xFFFF
"""What stands for the points of a row whose number is not that of all, in 4 and in 2 bytes."""

GRID, DATA = 3, 7
"""Sections of edition 2: the definition of a grid, and the numbers of a field."""

HAS_GRID: Final = 0x80
"""Bit of the flags of edition 1: the message defines its grid, and names none that its centre knows."""

PLANAR: Final = 100
"""Templates of grids below this number have rows and columns."""

ALONE: Final = "write the depths alone into a file: cdo selname,NAME IN OUT"


def count_fields(content: bytes) -> int:
    """Fields of all messages; an error if these break off, are too many or too large, or on different grids."""
    fields, first = 0, b""
    for message in _messages(content):
        check_time()
        edition = message[7]
        try:
            for grid, points in _grids(message) if edition == 2 else _grid_of_first(message):
                fields += 1
                first = first or grid
                _check(fields, points, grid == first)
        except IndexError:
            raise _damage_error(message) from None
    return fields


def _messages(content: bytes) -> Iterator[bytes]:
    """Each message, from its GRIB to its 7777."""
    at = content.find(GRIB)
    while at >= 0:
        edition = content[at + 7 : at + 8]
        if edition not in (b"\1", b"\2"):
            raise SourceError(
                f"it is of edition {edition[0] if edition else '?'} of GRIB, and editions 1 and 2 are read; "
                "write it as edition 2: grib_set -s edition=2 IN OUT"
            )
        size = content[at + 8 : at + 16] if edition == b"\2" else content[at + 4 : at + 7]
        end = at + int.from_bytes(size)
        if end > len(content) or content[max(at, end - len(END)) : end] != END:
            raise SourceError(
                f"its message at byte {at:,} says {end - at:,} bytes, and does not end there; copy the file again"
            )
        yield content[at:end]
        at = content.find(GRIB, end)


def _grids(message: bytes) -> Iterator[tuple[bytes, int]]:
    """Definition of the grid of each field of edition 2, and its points."""
    at, grid, points = 16, b"", 0
    while message[at : at + len(END)] != END:
        size, number = int.from_bytes(message[at : at + 4]), message[at + 4]
        if size < 5 or at + size > len(message):
            raise _damage_error(message)
        if number == GRID:
            grid = message[at + 5 : at + size]
            points = int.from_bytes(grid[1:5])
            if int.from_bytes(grid[7:9]) < PLANAR:
                points = max(points, _points(grid[25:29], grid[29:33]))
        elif number == DATA:
            yield grid, points
        at += size


def _grid_of_first(message: bytes) -> Iterator[tuple[bytes, int]]:
    """Definition of the grid of the field of edition 1, and its points."""
    if not message[15] & HAS_GRID:
        raise SourceError(
            "it names a grid by a number of its centre; write it as edition 2: grib_set -s edition=2 IN OUT"
        )
    at = 8 + int.from_bytes(message[8:11])
    grid = message[at : at + int.from_bytes(message[at : at + 3])]
    yield grid, _points(grid[6:8], grid[8:10])


def _points(columns: bytes, rows: bytes) -> int:
    """Points of a grid of so many columns and rows."""
    across, up = int.from_bytes(columns), int.from_bytes(rows)
    if across in REDUCED[len(columns) == 2 :] or up in REDUCED[len(rows) == 2 :]:
        raise SourceError("its rows have different numbers of points; write it on rows and columns: cdo -R copy IN OUT")
    return across * up


def _check(fields: int, points: int, same: bool) -> None:
    if fields > MOST_FIELDS:
        raise LimitError(f"it has more than {MOST_FIELDS:,} fields, which is the limit; {ALONE}")
    if points > MOST_POINTS:
        raise LimitError(
            f"its grid has {points:,} points; the limit is {MOST_POINTS:,}; cut out a part: "
            "cdo sellonlatbox,WEST,EAST,SOUTH,NORTH IN OUT"
        )
    if not same:
        raise SourceError(f"its fields are on several grids; {ALONE}")


def _damage_error(message: bytes) -> SourceError:
    return SourceError(f"a message of {len(message):,} bytes is damaged (its sections do not fill it); copy it again")
