"""Parts of a report: sections of text, tables and pictures, with the numbers behind them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vexture_evidence.measures.shape import ConvertedDrawing, example

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, slots=True)
class Printed:
    """A value that the thesis printed, which the page marks as such; all other values are measured."""

    value: Any


@dataclass(frozen=True, slots=True, eq=False)
class PrintedPicture:
    """A figure with its caption.

    Parameters
    ----------
    name : str
        Name of its file, without suffix: lower case, digits, hyphens; unique in a report.
    figure : matplotlib.figure.Figure
    caption : str
        What the figure shows. A caption begins with the number of the thesis's figure, if it has one: "Thesis 3.13."
        Values that the thesis printed are written between ⟦ and ⟧, in the text of sections too.
    alt : str
        Alternative text, for readers who cannot see the figure.
    """

    name: str
    figure: "Figure"
    caption: str
    alt: str


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Rows of values; the first column names the row.

    Parameters
    ----------
    name : str
        Its key in the JSON.
    caption : str
    head : sequence of str
        Headings of the columns, with units. Adjacent headings "group: column" of one group share a heading above them.
    rows : sequence of sequences
        Text, numbers, `Printed` values, or None if there is no value (shown as a dash; say why in the caption).
        Floats are shown with three significant digits on the page, and with all digits in the JSON.
    """

    name: str
    caption: str
    head: Sequence[str]
    rows: Sequence[Sequence[Any]]


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """A part of the page.

    Parameters
    ----------
    anchor : str
        Its id in the page and its key in the JSON: lower case, digits, hyphens.
    title : str
    text : sequence of str
        Paragraphs of plain text, with `code` between backquotes.
    items : sequence of Table, PrintedPicture or Section
        In order; nested sections get headings of the next level.
    facts : mapping
        Further measurements for the JSON.
    """

    anchor: str
    title: str
    text: Sequence[str] = ()
    items: "Sequence[Table | PrintedPicture | Section]" = ()
    facts: Mapping[str, Any] = field(default_factory=dict)


class Material:
    """The drawings that all sections are about, and the device that they are measured on.

    Parameters
    ----------
    sources : sequence of path
        The user's drawings; if empty, the example drawings of Table 5.1 are used.

    Examples
    --------
    >>> Material([]).main.name, Material([]).example("holes").name
    ('duck', 'holes')
    """

    def __init__(self, sources: Sequence[Path]) -> None:
        from vexture_evidence.measures.thesis_numbers import TABLE_5_1

        self._examples: dict[str, ConvertedDrawing] = {}
        self.own = bool(sources)
        stems = [path.stem for path in sources]
        names = [None if stems.count(path.stem) == 1 else str(path) for path in sources]
        self.shapes = tuple(map(ConvertedDrawing, sources, names)) or tuple(map(self.example, TABLE_5_1))

    @property
    def main(self) -> ConvertedDrawing:
        """The drawing for figures that show only one: the user's first drawing, or the duck, as in the thesis."""
        return self.shapes[0] if self.own else self.example("duck")

    def example(self, name: str) -> ConvertedDrawing:
        """An example drawing, whatever the report is about."""
        return self._examples.setdefault(name, ConvertedDrawing(example(name)))

    @cached_property
    def device(self) -> str | None:
        """Name of the OpenGL driver; None if there is no GPU, in which case figures that need one are left out."""
        from vexture.base.errors import DeviceError

        try:
            from vexture_evidence.measures.programs import driver

            return driver()
        except DeviceError:
            return None
