"""Widget of a map, with its column, its selection, and the tip of a feature as traits.

The map is converted in a thread while the notebook's cells run, and is shown between two messages.
"""

import asyncio
import os
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Final, Generic, TypeVar

import numpy as np
import traitlets
from numpy.typing import NDArray

from vexture.base.errors import EXPECTED, ParameterError, reason_of
from vexture.base.notes import Notes, warn_at
from vexture.notebook.picture import MARGIN, Rect, png_of
from vexture.notebook.shared_content import share_content
from vexture.notebook.traits import LabelTrait, NumberTrait
from vexture.notebook.widget import HEIGHT, PICTURE_WIDTH, PNG, VectorWidget
from vexture.renderers.view import Size, window
from vexture.texture.restyle import components
from vexture.texture.texture import Texture
from vexture.tree.planar.style import round_colours
from vexture_geo.maps import Map, Scale
from vexture_geo.maps.colours import colours_of
from vexture_geo.maps.notebook.map_picture import map_picture, plain
from vexture_geo.maps.notebook.map_steps import encode_colours, steps_of
from vexture_geo.maps.notebook.tip import Tips
from vexture_geo.maps.prepare import Prepared

MOST_PIXELS: Final = 4096
"""Most pixels along a side of a picture."""

SELECTED: Final = (0.0, 0.9, 1.0, 1.0)
"""Colour of the selected feature, which no default palette contains."""

Result = TypeVar("Result")


class MapWidget(VectorWidget):
    """A map that can be moved, pointed at and coloured by another column; `vexture.map` makes it.

    Attributes
    ----------
    column : str or None
        Attribute that colours show; without one all features look alike, or show the steps of time.
    time : float
        Time in steps, from 0; between two steps colours are mixed. The slider and Python may change it.
    times : list of str
        Names of the steps; empty while another column is shown.
    selected : str or None
        Name of the highlighted feature; a click selects one.
    legend : dict or None
        Meaning of the colours: ``title``, ``kind``, and ``entries`` of a ``label`` and a ``color``.
    tip : list
        Names and values of attributes of the feature under the pointer.
    table : pyarrow.Table
        All attributes; the first column, ``id``, holds the names of features.
    view, colors, picked, hovered, background, width, height
        See `VectorWidget`.
    """

    column = LabelTrait(None, allow_none=True)
    selected = LabelTrait(None, allow_none=True).tag(sync=True)
    time = NumberTrait(0.0).tag(sync=True)
    times: Any = traitlets.List(trait=traitlets.Unicode()).tag(sync=True)
    _steps: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    legend: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    tip: Any = traitlets.List().tag(sync=True)
    _marked = traitlets.Dict().tag(sync=True)
    _coloring: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    _picture: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    _wanted: Any = traitlets.Dict(default_value=None, allow_none=True).tag(sync=True)
    _failure = traitlets.Unicode().tag(sync=True)
    saved_traits = ("legend", "selected", "time", "times", "_marked", "_coloring", "_steps")

    def __init__(
        self,
        ready: Prepared,
        scale: Scale,
        conversion: Callable[[], Map],
        *,
        asked_at: tuple[str, int],
        tooltip: Any = True,
        has_legend: bool = True,
        **traits: Any,
    ) -> None:
        self.table, self._notes = ready.table, ready.notes.in_order
        borders = [one.outline.name for one in ready.layers if len(one.outline.rings.ends)]
        self._ids = [*(str(name) for name in ready.table.column("id").to_pylist()), *borders]
        self._row = {name: row for row, name in enumerate(self._ids)}
        self._scale, self._has_legend, self._is_recolored, self._asked_at = scale, has_legend, False, asked_at
        self._drawn = map_picture(ready)
        self._rgba = self._own = self._drawn.colours(len(self._ids))
        self._plain = plain(ready, self._own) if scale.column else self._own
        self._changing = steps_of(ready, self._rgba)
        self._tips = Tips(ready.table, tooltip, self._changing)
        self._style_rows: NDArray[np.intp] | None = None
        self._last: tuple[Size, tuple[float, ...], NDArray[np.float32]] | None = None
        legend = _legend(ready.legends[0]) if ready.legends and has_legend else None
        own: dict[str, Any] = {"times": list(self._changing.labels) if self._changing else []}
        own |= {"_home": _home(ready.fit.sides), "_name": ready.name, "height": HEIGHT}
        column = None if self._changing else scale.column or None
        super().__init__(None, **{**own, **traits}, column=column, legend=legend)
        self._send_picture({"view": self.view, "size": [self.width or PICTURE_WIDTH, self.height]})
        self.observe(self._recolour, "column")
        self.observe(self._go, "time")
        self.observe(self._mark, "selected")
        self.observe(self._update_tip, "hovered")
        self.observe(self._select, "picked")
        self.observe(lambda change: self._send_picture(change["new"]), "_wanted")
        self._lock = threading.RLock()
        with self._lock:  # a small map may arrive before its name is there
            self._pending = Pending(lambda: _encode(conversion()), self._show_texture)

    @property
    def texture(self) -> Texture:
        """Texture of the converted map; reading it waits for the conversion."""
        try:
            self._pending.result()
        finally:
            self._show_texture()
        return super().texture

    def _show_texture(self) -> None:
        """Replace pictures by the texture."""
        with self._lock:
            if self._texture is not None or self.comm is None:
                return
            if self._pending.error is not None:
                self._failure = _error_message(self._pending.error)
                return
            made, content = self._pending.result()
            texture = made.conversion.texture
            style = texture.roots[0].style
            assert style is not None
            self._style_rows = np.array([self._row[name] for name in style.names], np.intp)
            self._texture = texture
            with self.hold_sync():
                self._source = share_content(content)
                self._send_colours()
                self._mark({"new": self.selected})
                self.send_state("colors")  # without the colours of hidden features
                self._picture = None
        # last, because a filter may turn a warning into an error
        warn_at(self._asked_at, self._name, [note for note in made.conversion.notes if note not in self._notes])

    def _feature(self, name: str | None) -> int | None:
        """Row of a feature in the table; None if there is none."""
        row = self._row.get(name or "")
        return row if row is not None and row < len(self.table) else None

    def _is_seen(self, name: str) -> bool:
        """Return whether a feature is in the texture, or unknown: some lie wholly below others."""
        return self._style_rows is None or name in self._in_texture

    @cached_property
    def _in_texture(self) -> frozenset[str]:
        assert self._style_rows is not None
        return frozenset(self._ids[row] for row in self._style_rows.tolist())

    def _send_colours(self) -> None:
        """Send colours of the style's elements that differ from the texture's: of all steps, or of a column."""
        if self._style_rows is None:
            return
        timed = self._changing is not None and bool(self.times)
        if timed and self._steps is None:
            assert self._changing is not None
            self._steps = self._changing.encode_steps(self._style_rows)
        elif not timed:
            self._steps = None
        self._coloring = encode_colours(self._rgba[self._style_rows]) if self._is_recolored and not timed else None

    def _send_picture(self, request: Any) -> None:
        """Send a picture of a view, (x, y, width, height), in the requested size."""
        if self._texture is not None or not request:
            return
        size = tuple(max(1, min(MOST_PIXELS, int(side))) for side in request["size"])
        picture = self._draw_picture((size[0], size[1]), request["view"])
        self._picture = {**request, "content": png_of(picture, "transparent", fast=True)}

    def _draw_picture(self, size: Size, view: Any) -> NDArray[np.float32]:
        """Draw a picture of the map as it was read."""
        changed = {**self.components(self.colors), **self._marked}
        rgba = self._rgba.copy() if changed or self._is_recolored else None
        if rgba is None and self._last is not None and self._last[:2] == (size, tuple(view)):
            return self._last[2]
        for name, colour in changed.items():
            assert rgba is not None
            rgba[self._row[name]] = colour
        picture = self._drawn.draw(rgba, size, window(*view))
        self._last = (size, tuple(view), picture) if rgba is None else None
        return picture

    def render(self, size: Size | None = None) -> NDArray[np.float32]:
        """Draw the widget; see `VectorWidget.render`. Before the map is converted, its source is drawn."""
        if self._texture is not None:
            return super().render(size)
        return self._draw_picture(size or (self.width or PICTURE_WIDTH, self.height), self.view)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write what the widget shows; see `VectorWidget.save`."""
        if Path(path).suffix.lower() != PNG:
            assert self.texture is not None  # waits for the conversion
        super().save(path)

    def only_saved(self) -> dict[str, Any]:
        """Tips of features, for a saved page."""
        return {"_tips": self._tips.as_json(self.column, bool(self.times))}

    def components(self, colours: Mapping[str, Any]) -> dict[str, list[float]]:
        """Return red, green, blue and opacity of colours by the names of features."""
        if not isinstance(colours, Mapping):
            raise ParameterError("the colours are no mapping of names, such as {'4': 'red'}")
        for name in colours:
            if name not in self._row:
                raise ParameterError(f"there is no feature {name!r}; names are in the column `id` of `table`")
        parts = round_colours([components(name, colour) for name, colour in colours.items()]).tolist()
        pairs = zip(colours, parts, strict=True)
        return {name: part for name, part in pairs if self._is_seen(name)}

    def coloured(self) -> Texture:
        """The texture in the colours that the widget shows."""
        every: dict[str, Any] = {}
        if self._is_recolored:
            every = dict(zip(self._ids, self._rgba.tolist(), strict=True))
        every |= self.components(self.colors) | self._marked
        return self.texture.with_paints({name: colour for name, colour in every.items() if self._is_seen(name)})

    @traitlets.validate("column")
    def _checked_column(self, proposal: Any) -> Any:
        name = proposal["value"]
        if name is not None and name not in self.table.column_names:
            raise ParameterError(
                f"there is no column {name!r}; the columns are {', '.join(self.table.column_names[:8])}"
            )
        return name

    @traitlets.validate("time")
    def _checked_time(self, proposal: Any) -> float:
        time = float(proposal["value"])
        last = len(self._changing.labels) - 1 if self._changing else 0
        if not 0.0 <= time <= last:
            raise ParameterError(f"`time` is {time:g}; it must be in 0..{last}, in steps")
        return time

    @traitlets.validate("selected")
    def _checked_selected(self, proposal: Any) -> Any:
        if proposal["value"] is not None and self._feature(proposal["value"]) is None:
            raise ParameterError(f"there is no feature {proposal['value']!r}; names are in the column `id` of `table`")
        return proposal["value"]

    def _recolour(self, change: Any) -> None:
        """Show another column, or return to the steps of time."""
        legend: dict[str, Any] | None
        if change["new"] is not None:
            rgba, legend = self._colours_of(change["new"])
        elif self._changing is not None:
            rgba, legend = self._changing.at(self.time), self._changing.legend
        else:
            rgba, legend = self._plain, None
        self._rgba, self._is_recolored = rgba, rgba is not self._own
        with self.hold_sync():
            self.times = list(self._changing.labels) if self._changing and change["new"] is None else []
            self._send_colours()
            self._mark({"new": self.selected})
            self.legend = _legend(legend) if legend and self._has_legend else None
            self._draw_again()
        self._update_tip({"new": self.hovered})

    def _colours_of(self, column: str) -> tuple[NDArray[np.float64], dict[str, Any]]:
        scale = replace(self._scale, column=column)
        try:
            rgba, legend = colours_of(self.table, scale, Notes())
        except ParameterError:  # a column of texts, but the scale was chosen for another one
            rgba, legend = colours_of(self.table, replace(scale, kind="categories", palette=None), Notes())
        borders = self._rgba[len(rgba) :]  # colours of outlines, which no column changes
        return np.concatenate([round_colours(rgba), borders]), legend

    def _go(self, change: Any) -> None:
        """Show another time: the page has its colours, and only a picture in place of the texture is drawn again."""
        if self._changing is None or not self.times:
            return
        self._rgba, self._is_recolored = self._changing.at(change["new"]), True
        self._draw_again()
        self._update_tip({"new": self.hovered})

    def _draw_again(self) -> None:
        """Redraw the picture in place of the texture."""
        if self._picture is not None:
            self._send_picture({name: self._picture[name] for name in ("view", "size")})

    def _mark(self, change: Any) -> None:
        """Highlight the selected feature."""
        name = change["new"]
        self._marked = {name: SELECTED} if name is not None and self._is_seen(name) else {}
        if "name" in change:
            self._draw_again()

    def _update_tip(self, change: Any) -> None:
        row = self._feature((change["new"] or {}).get("element"))
        self.tip = [] if row is None else self._tips.tip_of(row, self.column, self.time if self.times else None)

    def _select(self, change: Any) -> None:
        found = (change["new"] or {}).get("element")
        self.selected = found if self._feature(found) is not None else None


def _legend(found: dict[str, Any]) -> dict[str, Any]:
    """Convert a legend to the form that pages draw."""
    entries = [{"label": each["label"], "color": each["color"]} for each in found["entries"]]
    if "no_data" in found:
        entries.append({"label": "no data", "color": found["no_data"]["color"]})
    return {"title": found["column"], "kind": found["scale"], "entries": entries}


def _error_message(error: BaseException) -> str:
    """Format an error in one line, with the name of its class unless it is vexture's."""
    if isinstance(error, EXPECTED) or not isinstance(error, Exception):
        return str(error)
    return f"{type(error).__name__}: {reason_of(error)}"


def _home(sides: tuple[float, float]) -> Rect:
    """Box of a map in the unit square, with a margin."""
    width, height = sides
    return (0.5 - width / 2 - MARGIN, 0.5 - height / 2 - MARGIN, width + 2 * MARGIN, height + 2 * MARGIN)


def _encode(ready: Map) -> tuple[Map, bytes]:
    """Return a map, and its bytes for the page."""
    return ready, ready.conversion.texture.to_ktx2()


class Pending(Generic[Result]):
    """Result of a function that runs in its own thread.

    Parameters
    ----------
    work : callable
    then : callable
        Called once when the result is ready, by the kernel's event loop, so that it never runs while a cell does;
        without a loop, by the thread.
    """

    def __init__(self, work: Callable[[], Result], then: Callable[[], None]) -> None:
        self._work, self._then = work, then
        self._result: Result | None = None
        self._error: BaseException | None = None
        try:
            self._loop: asyncio.AbstractEventLoop | None = asyncio.get_running_loop()
        except RuntimeError:
            self._loop = None
        self._thread = threading.Thread(target=self._run, name="vexture map", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._result = self._work()
        except BaseException as error:  # raised again where the result is requested
            self._error = error
        loop = self._loop
        if loop is None:
            self._then()
        elif not loop.is_closed():
            loop.call_soon_threadsafe(self._then)

    @property
    def is_done(self) -> bool:
        """True if there is a result, or an error."""
        return not self._thread.is_alive() or self._result is not None or self._error is not None

    @property
    def error(self) -> BaseException | None:
        """Error of the work, if it failed."""
        return self._error

    def result(self) -> Result:
        """Wait for the result; an error of the work is raised again."""
        while self._result is None and self._error is None:
            self._thread.join(0.05)  # short, so that it can be interrupted
        if self._error is not None:
            raise self._error
        assert self._result is not None
        return self._result
