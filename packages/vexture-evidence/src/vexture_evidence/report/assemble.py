"""Making a report: runs every section in turn, then writes the page, its pictures and its JSON, all or none."""

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
"""The largest number of drawings that the title names."""

LEAD: Final = (
    "Every table and figure of the thesis that vexture began with, made again from the library's own data. Each "
    "drawing is converted in three ways: `sampled` is the thesis's conversion to the thesis's format; `direct` is our "
    "conversion to the thesis's format; `packed` is our conversion to our own format. Drawings are treated as "
    "silhouettes: everything painted counts as filled, whatever its colour.",
)
"""Paragraphs before all sections."""


def assemble(
    sources: Sequence[Path],
    folder: Path,
    *,
    only: Sequence[str] = SECTIONS,
    report: Callable[[str], None] = lambda line: None,
) -> Path:
    """Write a report.

    Parameters
    ----------
    sources : sequence of path
        Drawings; if empty, the example drawings are used.
    folder : path
        Where ``index.html``, ``report.json`` and ``figures/`` are written.
    only : sequence of str
        Sections to make.
    report : function
        Called with a line of progress before each section.

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
        shape.drawing  # noqa: B018  # reads the drawing, so that an unreadable one fails before anything is measured
    sections: list[Section] = []
    seconds = {}
    for name in only:
        report(f"{name} ...")
        start = time.perf_counter()
        sections.append(import_module(f"vexture_evidence.report.{name}").section(material))
        seconds[name] = time.perf_counter() - start
    start = time.perf_counter()
    files = {folder / "figures" / f"{picture.name}.png": png_of(picture) for picture in pictures_of(sections)}
    seconds["pictures"] = time.perf_counter() - start
    machine = machine_facts() | {"driver": material.device or "no OpenGL, so nothing is measured on a GPU"}
    names = [shape.name for shape in material.shapes]
    title = "What vexture measures" if not material.own else ", ".join(names[:NAMED]) + " ..." * (len(names) > NAMED)
    files[folder / "index.html"] = page(title, machine, LEAD, sections).encode()
    files[folder / "report.json"] = json_text(machine | {"seconds": seconds}, sections).encode()
    write_together(files)
    return folder / "index.html"
