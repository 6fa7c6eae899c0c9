"""What a report consists of: sections of text, tables and pictures, with the figures behind them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vexture_evidence.measures.shape import Shape, example

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Material", "Picture", "Printed", "Section", "Table"]


@dataclass(frozen=True, slots=True)
class Printed:
    """A value that the thesis printed, which the page marks as such: all others are measured."""

    value: Any


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A figure with what it shows.

    Parameters
    ----------
    name : str
        Of its file, without suffix: lower case, digits, hyphens; once in a report.
    figure : matplotlib.figure.Figure
    caption : str
        What to see in it. Thesis figures are named: "Thesis 3.13. ..." What the thesis printed stands between ⟦ and ⟧,
        in the text of sections too.
    alt : str
        What it shows, for those who do not see it.
    """

    name: str
    figure: "Figure"
    caption: str
    alt: str


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Rows of values: the first column names the row.

    Parameters
    ----------
    name : str
        Its key in the JSON.
    caption : str
    head : sequence of str
        Units included. A head "group: column" makes columns with one group stand below it.
    rows : sequence of sequences
        Text, numbers, `Printed` values, or None where there is nothing (shown as a dash; say why in the caption).
        Floats are shown with three significant digits, and whole in the JSON.
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
        Its address within the page and its key in the JSON: lower case, digits, hyphens.
    title : str
    text : sequence of str
        Paragraphs, plain text; `code` between backquotes.
    items : sequence of Table, Picture or Section
        In order; sections within make a heading of the next level.
    facts : mapping
        Further measured figures for the JSON.
    """

    anchor: str
    title: str
    text: Sequence[str] = ()
    items: "Sequence[Table | Picture | Section]" = ()
    facts: Mapping[str, Any] = field(default_factory=dict)


class Material:
    """What all sections are about.

    Parameters
    ----------
    sources : sequence of path
        Drawings of the user's; empty: the example drawings of Table 5.1.

    Examples
    --------
    >>> Material([]).main.name, Material([]).example("holes").name
    ('duck', 'holes')
    """

    def __init__(self, sources: Sequence[Path]) -> None:
        from vexture_evidence.measures.printed import TABLE_5_1

        self._examples: dict[str, Shape] = {}
        self.own = bool(sources)
        stems = [path.stem for path in sources]
        names = [None if stems.count(path.stem) == 1 else str(path) for path in sources]
        self.shapes = tuple(map(Shape, sources, names)) or tuple(map(self.example, TABLE_5_1))

    @property
    def main(self) -> Shape:
        """The drawing of figures that show one: the duck, as in the thesis, or the user's first."""
        return self.shapes[0] if self.own else self.example("duck")

    def example(self, name: str) -> Shape:
        """An example drawing, whatever the report is about."""
        return self._examples.setdefault(name, Shape(example(name)))

    @cached_property
    def device(self) -> str | None:
        """Name of the OpenGL driver; None where there is no GPU, and figures that need one are left out."""
        from vexture.errors import DeviceError

        try:
            from vexture_evidence.measures.programs import driver

            return driver()
        except DeviceError:
            return None
