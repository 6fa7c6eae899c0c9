"""Widget of a flood: its page in a frame, with the step as a trait."""

import os
from typing import Any, Final

import anywidget
import traitlets

from vexture.pages.page import built
from vexture_geo.flood.bundle import FLOOD
from vexture_geo.flood.page import FloodPage

SCRIPT: Final = "notebook-flood.js"


class FloodWidget(anywidget.AnyWidget):
    """The page of a flood, with all its controls; `vexture.show` makes it.

    Attributes
    ----------
    step : int
        Number of the shown step, from 0; larger numbers become the last step. The page's time bar and Python both may
        change it.
    height : int
        Height in CSS pixels.
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _page = traitlets.Bytes().tag(sync=True)
    _name = traitlets.Unicode().tag(sync=True)
    step = traitlets.Int(0, min=0).tag(sync=True)
    height = traitlets.Int(min=1).tag(sync=True)

    def __init__(self, page: FloodPage, **traits: Any) -> None:
        self._flood = page
        traits.setdefault("height", page.height)
        super().__init__(_page=page.html.encode(), _name=page.title, **traits)

    def __repr__(self) -> str:
        """Show title and step."""
        return f"<FloodWidget {self.page.title!r}: step {self.step}>"

    @property
    def page(self) -> FloodPage:
        """Page in the frame."""
        return self._flood

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page as one HTML file, as `FloodPage.save` does."""
        self.page.save(path)

    @traitlets.default("_esm")
    def _script(self) -> str:
        return built(SCRIPT, FLOOD.package).decode()
