"""Making a report: every section in turn, then the page, its pictures and its JSON, all together or none."""

import time
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Final

from vexture.texture.files import writable, write_together
from vexture_evidence.figures.style import plotting
from vexture_evidence.measures.machine import machine_facts
from vexture_evidence.measures.peers import check_peers
from vexture_evidence.report.page import json_text, page, pictures_of, png_of
from vexture_evidence.report.section import Material

if TYPE_CHECKING:
    from vexture_evidence.report.section import Section

__all__ = ["SECTIONS", "assemble"]

SECTIONS: Final = (
    "conversion",
    "shapes",
    "structure",
    "rendering",
    "discussion",
    "comparison",
    "tracing",
)
"""Modules of `vexture_evidence.report`, each with a function ``section(material)``, in the order of the page.

Those that measure times come first, while the process is small."""

NAMED: Final = 4
"""Drawings in the title, at most."""

LEAD: Final = (
    "Every table and figure of the thesis that vexture began with, made again from the library's own data: a drawing "
    "goes through the thesis's way to a texture, which is kept under the name `sampled`; through ours to the thesis's "
    "own format, `direct`; and through ours to ours, `packed`. Drawings are taken as silhouettes: what is painted "
    "counts, whatever its colour.",
)
"""What stands before everything."""


def assemble(
    sources: Sequence[Path],
    folder: Path,
    *,
    only: Sequence[str] = SECTIONS,
    say: Callable[[str], None] = lambda line: None,
) -> Path:
    """Write a report.

    Parameters
    ----------
    sources : sequence of path
        Drawings; empty: the examples.
    folder : path
        Gets ``index.html``, ``report.json`` and ``figures/``.
    only : sequence of str
        Sections to make.
    say : function
        Told what is being made.

    Returns
    -------
    path
        The page.

    Raises
    ------
    VextureError
        If a drawing cannot be read, a package is missing, or the folder cannot be written.
    """
    plotting()
    check_peers()
    writable(writable(folder) / "figures")
    material = Material(sources)
    for shape in material.shapes:
        shape.drawing  # noqa: B018  # what cannot be read is found before anything is measured
    sections: list[Section] = []
    seconds = {}
    for name in only:
        say(f"{name} ...")
        start = time.perf_counter()
        sections.append(import_module(f"vexture_evidence.report.{name}").section(material))
        seconds[name] = time.perf_counter() - start
    start = time.perf_counter()
    files = {folder / "figures" / f"{picture.name}.png": png_of(picture) for picture in pictures_of(sections)}
    seconds["pictures"] = time.perf_counter() - start
    machine = machine_facts() | {"driver": material.device or "no OpenGL, so nothing of a GPU is measured"}
    names = [shape.name for shape in material.shapes]
    title = "What vexture measures" if not material.own else ", ".join(names[:NAMED]) + " ..." * (len(names) > NAMED)
    files[folder / "index.html"] = page(title, machine, LEAD, sections).encode()
    files[folder / "report.json"] = json_text(machine | {"seconds": seconds}, sections).encode()
    write_together(files)
    return folder / "index.html"
