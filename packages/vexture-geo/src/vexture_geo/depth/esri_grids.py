"""Check that grids of Esri, of text (.asc) and of numbers (.flt), hold as many numbers as their headers state.

GDAL ignores surplus numbers, replaces missing ones by 0, and reads truncated numbers as shorter ones.
"""

import os
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from vexture.base.content import BYTE_ORDER_MARK, ESRI_GRID
from vexture.base.deadline import check_time
from vexture.base.errors import SourceError

if TYPE_CHECKING:
    from rasterio import DatasetReader

KEYS: Final = (*ESRI_GRID, b"dx", b"dy", b"nodata_value")
"""Words, in lower case, with which the lines of a header begin."""

BITS: Final = 32
"""Bits of a number in a .flt whose header does not state them."""

LONGEST_HEADER: Final = 2**16
"""Most bytes of a header that are read."""

BLOCK: Final = 2**20
"""Bytes of a text in memory at once."""

GRID_OF_TEXT: Final = "AAIGrid"


def is_esri_text(start: bytes) -> bool:
    """Return whether a file begins like Esri's text grid."""
    return start.lstrip().lower().startswith(ESRI_GRID)


def refuse_marked(start: bytes) -> None:
    """Raise an error for a text grid after a byte order mark, which GDAL does not recognise."""
    if start.startswith(BYTE_ORDER_MARK) and is_esri_text(start.removeprefix(BYTE_ORDER_MARK)):
        raise SourceError("it is a grid of Esri behind a byte order mark; save it as UTF-8 without one (no BOM)")


def refuse_other_count(source: bytes | str | os.PathLike[str], file: "DatasetReader") -> None:
    """Raise an error if an open text grid has another count of numbers than its header states; others pass."""
    if file.driver != GRID_OF_TEXT:
        return
    with BytesIO(source) if isinstance(source, bytes) else Path(source).open("rb") as text:
        count = _count(text)
    said = file.width * file.height
    if count != said:
        raise SourceError(
            f"it holds {count:,} numbers, and its header says {file.height:,} rows of {file.width:,} numbers "
            f"({said:,}); correct nrows and ncols, or copy it again"
        )


def refuse_other_size(path: Path) -> None:
    """Raise an error if a grid of floats has another size than the header beside it states."""
    about = _header(path)
    if not {"nrows", "ncols"} <= set(about):
        return  # GDAL reports the error
    rows, columns, bits = about["nrows"], about["ncols"], about.get("nbits", BITS)
    said = about.get("skipbytes", 0) + rows * columns * about.get("nbands", 1) * bits // 8
    size = path.stat().st_size
    if size < said or (size > said and "nbits" not in about):
        raise SourceError(
            f"it has {size:,} bytes, and its header says {rows:,} rows of {columns:,} numbers, which are {said:,} "
            f"bytes of {bits} bits each; correct the .hdr, or copy the .flt again"
        )


def _count(text: Any) -> int:
    """Count the words of a text after its header."""
    found, before = 0, b" "
    line = text.readline(LONGEST_HEADER)
    while line and (not line.strip() or line.strip().lower().startswith(KEYS)):
        line = text.readline(LONGEST_HEADER)
    block = line
    while block:
        check_time()
        found += len(block.split()) - (not before.isspace() and not block[:1].isspace())
        before = block[-1:]
        block = text.read(BLOCK)
    return found


def _header(path: Path) -> dict[str, int]:
    """Read whole numbers from the header beside a grid of floats, by name in lower case."""
    beside = next((path.with_suffix(end) for end in (".hdr", ".HDR") if path.with_suffix(end).is_file()), None)
    if beside is None:
        return {}
    with beside.open("rb") as header:
        lines = header.read(LONGEST_HEADER).decode(errors="replace").splitlines()
    words = [line.split() for line in lines]
    return {one[0].lower(): int(one[1]) for one in words if len(one) == 2 and one[1].isdecimal()}
