"""Numbers from the tables and the text of the thesis, for comparison with what is measured.

"Texture-based Rendering of Vector-based Shapes using Graphics Hardware and the Web", Delft University of Technology,
2018. None of these numbers was measured here.
"""

from typing import Final, NamedTuple


class Row(NamedTuple):
    """A row of Table 5.1: bytes of files, milliseconds, and frames per second on a display limited to 120."""

    title: str
    segments: int
    svg: int
    ms: float
    curves: int
    quads: int
    bytes_8: int
    bytes_16: int
    fps: int


TABLE_5_1: Final = {
    "simple-small": Row("Simple small", 5, 699, 53.1, 18, 13, 414, 601, 113),
    "simple-big": Row("Simple big", 5, 696, 70.7, 21, 14, 445, 639, 115),
    "simple-offset": Row("Simple offset", 5, 691, 98.0, 19, 12, 416, 625, 115),
    "simple-duo": Row("Simple duo", 10, 883, 187.5, 36, 23, 617, 964, 114),
    "simple-quartet": Row("Simple quartet", 20, 1269, 382.9, 71, 47, 1006, 1727, 113),
    "duck": Row("Duck", 21, 1277, 300.0, 61, 34, 866, 1462, 113),
    "thumb": Row("Thumb", 22, 908, 236.8, 45, 26, 703, 1142, 114),
    "flame": Row("Flame", 23, 1418, 523.1, 109, 56, 1306, 2334, 112),
    "cake": Row("Cake", 31, 1283, 536.1, 115, 70, 1422, 2496, 111),
    "font": Row("Font", 42, 1426, 645.4, 121, 64, 1447, 2495, 113),
    "ocean": Row("Ocean", 31, 1817, 3632.2, 90, 59, 1205, 2115, 114),
}
"""Rows by the example drawing of the same subject, in the table's order; the drawings are not the thesis's."""


class Structure(NamedTuple):
    """Counts of section 3.4 for the duck of Figure 3.10; `grid` is the cells of a uniform grid."""

    quads: int
    curves: int
    cells: int
    grid: int


STRUCTURE: Final = Structure(29, 56, 172, 256 * 256)
"""The duck has 172 cells, 0.26% of the grid's 65,536."""
