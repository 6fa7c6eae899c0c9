"""Glyphs in colour: painted paths and groups."""

from dataclasses import dataclass

from vexture.drawing import Path
from vexture.group import Group
from vexture.notes import Note

__all__ = ["Layers"]


@dataclass(frozen=True, slots=True, eq=False)
class Layers:
    """What a glyph in colour paints.

    Parameters
    ----------
    paths : tuple of Path
        In painting order, in font units, y up; so are their gradients. `Path.group` is a place in `groups`, or -1.
    groups : tuple of Group
        Each after the group around it, as in `Drawing.groups`.
    notes : tuple of Note
        What of it was left out.
    """

    paths: tuple[Path, ...]
    groups: tuple[Group, ...] = ()
    notes: tuple[Note, ...] = ()
