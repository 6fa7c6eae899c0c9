"""Numbers of CSV with a comma before their decimals, as most of Europe writes them."""

from typing import TYPE_CHECKING, Any, Final

from vexture.base.content import Header

if TYPE_CHECKING:
    import pyarrow

SEPARATORS: Final = ";\t"
"""Separators of columns beside which a comma may be that of decimals."""

NUMBER: Final = r"^-?\d+(,\d+)?$"
GROUPED: Final = r"^-?(\d+|[1-9]\d{0,2}(\.\d{3})+)(,\d+)?$"
BOTH: Final = r"\.\d{3},\d"
"""A number that may have points between its thousands, and what only one with both has."""

CODE: Final = r"^-?0\d"
"""A number with a zero before other digits, which a code has."""

THOUSANDS: Final = r"^-?([1-9]\d{0,2},\d{3}|\d{1,3})$"
"""A number of which the comma may be that of thousands."""


def with_decimal_commas(table: "pyarrow.Table", header: Header) -> "pyarrow.Table":
    """A table with numbers in place of texts that are numbers with decimal commas, in every row of a column.

    Beside columns with decimal points, a column of which all commas may be those of thousands stays text.
    """
    import pyarrow as pa
    from pyarrow import compute

    if header.delimiter not in SEPARATORS:
        return table
    has_points = any(pa.types.is_floating(field.type) for field in table.schema)
    for at, field in enumerate(table.schema):
        if not pa.types.is_string(field.type) or field.name == header.text:
            continue
        texts = compute.utf8_trim_whitespace(table.column(at))
        texts = compute.if_else(compute.equal(texts, ""), None, texts)
        is_doubtful = _any(texts, CODE) or (has_points and _all(texts, THOUSANDS))
        if is_doubtful and field.name not in (header.across, header.up):
            continue
        if _any(texts, BOTH) and _all(texts, GROUPED):
            texts = compute.replace_substring(texts, ".", "")
        if _all(texts, NUMBER) and compute.any(compute.match_substring(texts, ",")).as_py():
            numbers = compute.cast(compute.replace_substring(texts, ",", "."), pa.float64())
            table = table.set_column(at, field.name, numbers)
    return table


def _any(texts: Any, pattern: str) -> bool:
    from pyarrow import compute

    return bool(compute.any(compute.match_substring_regex(texts, pattern)).as_py())


def _all(texts: Any, pattern: str) -> bool:
    from pyarrow import compute

    return bool(compute.all(compute.match_substring_regex(texts, pattern)).as_py())
