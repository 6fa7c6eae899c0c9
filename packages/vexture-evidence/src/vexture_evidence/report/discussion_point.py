"""One point of the thesis's chapter 6, with the report's answer, and the textures that the points compare."""

from dataclasses import dataclass
from typing import Any, Final

from vexture.texture.texture import Texture
from vexture.thesis.texture import ThesisTexture
from vexture.thesis.tree import CellTree
from vexture_evidence.measures.shape import ConvertedDrawing
from vexture_evidence.report.section import Section

LEFT_OUT: Final = (
    "Dotted lines show the drawing's own outline where no curve covers it: packed leaves leave out horizontal parts, "
    "which change no winding number."
)
"""Sentence for the captions of figures that draw cells over the drawing's outline."""


@dataclass(frozen=True, slots=True, eq=False)
class DiscussionPoint:
    """One point of the chapter.

    Parameters
    ----------
    section : Section
        The thesis's statement, the state before and after, and a picture.
    quantity : str
        What is measured, with its unit.
    before, after : float or int
        Its values by the thesis's way and by ours.
    """

    section: Section
    quantity: str
    before: Any
    after: Any


def tree_of(shape: ConvertedDrawing, way: str) -> CellTree:
    """Tree of a drawing by `way`, one of the two that make the thesis's leaves."""
    tree = shape.way(way).tree
    assert isinstance(tree, CellTree)
    return tree


def pair_of(shape: ConvertedDrawing, way: str) -> ThesisTexture:
    """Pair of textures of a drawing by `way`, one of the two that make the thesis's leaves."""
    texture = shape.way(way).texture
    assert isinstance(texture, ThesisTexture)
    return texture


def packed_of(shape: ConvertedDrawing) -> Texture:
    """Packed texture of a drawing."""
    texture = shape.way("packed").texture
    assert isinstance(texture, Texture)
    return texture
