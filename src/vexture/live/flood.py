"""`vexture flood`: the user's files as one page, or on a server that accepts newer ones."""

from collections.abc import Callable, Sequence
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.content import about
from vexture.drawing import Drawing
from vexture.errors import SourceError, counted
from vexture.flood.credits import Credits
from vexture.flood.options import FloodOptions
from vexture.flood.scene import PREFIX, Flood, PageNote, labels, scene, step_names
from vexture.geo.extent import Extent, Frame
from vexture.live.flood_conversion import FloodConversion
from vexture.live.limits import LimitedShelf, Limits
from vexture.live.page import FLOOD, built, check_output, data_address, served_page, whole_page
from vexture.live.shelf import TEXTURE_TYPE, File, Shape, manifest
from vexture.notes import line_of

__all__ = ["Made", "export", "make", "page_of", "serve"]

GROUND_NAME, FOLD_NAME = "ground.webp", "shore.fold.ktx2"

INVENTED: Final = PageNote("The relief is invented.", "--relief takes a file of heights.")
DRAWN: Final = PageNote("The ground is drawn, not photographed.", "--ground takes a picture.")
DRY: Final = PageNote("Nothing is under water.", "")
SHELTERED: Final = PageNote("No shore is open to waves, so none run up it.", "")

LESS: Final = 0.95
"""Share of the given amplitude: users are told if waves reach less."""

WHOLE: Final = 0.995
"""Share of the ground whose height is known: users are told if it is less."""

Say = Callable[[str], None]
"""Takes a line for the user."""


class Made(NamedTuple):
    """A flood that is ready to be shown."""

    flood: Flood
    conversion: FloodConversion
    shapes: Sequence[Shape]

    @property
    def texture_bytes(self) -> int:
        """Bytes of all textures: what goes over the wire."""
        return sum(len(shape.texture.data) for shape in self.shapes)

    @property
    def described(self) -> str:
        """One line about it."""
        count = len(self.shapes)
        dry = sum(bool(shape.facts["dry"]) for shape in self.shapes)
        told = f"{counted(count, 'step')}, {self.texture_bytes} bytes of textures"
        return told + (f", {'nothing' if dry == count else f'in {dry} nothing'} under water" if dry else "")


def make(asked: FloodOptions, say: Say, given: tuple[Extent, Credits] | None = None) -> Made:
    """Read all files of a flood and convert them; `say` gets warnings and notes for the user.

    What is `given`, an extent and its credits, is not read.
    """
    from vexture.flood.credits import credits_of
    from vexture.flood.drawn_ground import drawn_ground
    from vexture.flood.ground import encoded, ground_of
    from vexture.flood.open_water import open_water
    from vexture.flood.relief import first_wet, relief_of
    from vexture.flood.surface import highest_of, surface_of
    from vexture.flood.views import views_of

    extent, credits = given or (_read(asked), credits_of(asked.extent))
    if line := line_of(str(asked.extent), extent.notes):
        say(f"warning: {line}")
    frame = extent.frame
    amplitude = asked.amplitude_in(max(frame.metres))
    relief = relief_of(extent, asked.relief, asked.crs)
    conversion = FloodConversion(frame, asked.hmin, asked.reading, relief, extent.bed)
    drawn = drawn_ground(extent, relief)
    notes = [INVENTED] if relief.invented else []
    picture = drawn
    if asked.ground is None:
        notes.append(DRAWN)
    else:
        picture, told = ground_of(asked.ground, frame, drawn, bounds_given=asked.bounds is not None)
        notes += told
    first = first_wet(extent)
    steps = extent.steps
    surfaces = [surface_of(step, frame, relief, extent.bed, asked.hmin) for step in steps]
    named = zip(steps, surfaces, step_names(len(steps)), labels([step.time for step in steps]), strict=True)
    shapes = [conversion.step(step, surface, name, label) for step, surface, name, label in named]
    fold, openness = None, None
    if first is None:
        notes.append(DRY)
    else:
        openness = open_water(first.drawing, frame)
        if amplitude and openness.any():
            fold, reached = _fold(first.drawing, openness, amplitude, asked.period, frame)
            if asked.amplitude is not None and reached < LESS * amplitude:
                notes.append(
                    PageNote(f"Waves run up {reached:.3g} m: {amplitude:.3g} m would turn the shore over.", "")
                )
        elif asked.amplitude:
            notes.append(SHELTERED)
    if relief.known < WHOLE:
        notes.append(PageNote(f"{relief.known:.0%} of the ground has a height; the rest goes on as its border.", ""))
    credits = credits.with_given(title=asked.title, source=asked.source, licence=asked.licence)
    flood = Flood(
        title=credits.title or asked.extent.name.partition(".")[0] or PREFIX,
        credits=credits,
        depths=asked.depths,
        frame=frame,
        ground=encoded(picture),
        relief=relief,
        fold=fold,
        openness=openness,
        views=views_of(extent, openness, highest_of(surfaces)),
        notes=tuple(notes),
    )
    for note in notes:
        say(" ".join(("note:", *filter(None, note))))
    return Made(flood, conversion, shapes)


def _read(asked: FloodOptions) -> Extent:
    from vexture.reading import extent_of

    if asked.extent.is_dir():
        raise SourceError(f"`extent` {asked.extent}: is a folder; name a file in it that says where water is")
    if not asked.extent.is_file():
        raise SourceError(f"`extent` {asked.extent}: there is no such file; name one that says where water is")
    named = str(asked.extent)
    with about(named):
        return extent_of(asked.extent, named, bounds=asked.bounds, crs=asked.crs, hmin=asked.hmin, **asked.reading)


def _fold(
    drawing: Drawing, openness: NDArray[np.float64], amplitude: float, period: float, frame: Frame
) -> tuple[bytes, float]:
    """File that moves the shore of open water up and down the beach, and its largest shift in metres."""
    from vexture.flood.open_water import openness_at
    from vexture.fold.shore import fold_of_shore
    from vexture.geo.extent import MARGIN

    share = (1.0 - 2.0 * MARGIN) / max(frame.metres)
    fold = fold_of_shore(drawing, amplitude=amplitude * share, period=period)
    rows, columns, _ = fold.displacement.shape
    x, y = np.meshgrid((np.arange(columns) + 0.5) / columns, 1.0 - (np.arange(rows) + 0.5) / rows)
    moved = openness_at(openness, frame, np.stack([x, y], axis=-1))
    fold = replace(fold, displacement=(fold.displacement * moved[..., None]).astype(np.float32))
    return fold.to_ktx2(), float(np.hypot(fold.displacement[..., 0], fold.displacement[..., 1]).max()) / share


def export(asked: FloodOptions, output: Path, say: Say) -> tuple[Made, int]:
    """Write one page that needs nothing else; return what it shows, and its size."""
    from vexture.texture.files import write_together

    check_output(output, FLOOD)
    made = make(asked, say)
    page = page_of(made)
    write_together({output: page})
    return made, len(page)


def page_of(made: Made) -> bytes:
    """One page that needs nothing else."""
    from vexture.flood.ground import GROUND_TYPE

    flood = made.flood
    told = scene(
        flood,
        [manifest(shape, None, {}, address=data_address) for shape in made.shapes],
        data_address(File(flood.ground, GROUND_TYPE, "")),
        None if flood.fold is None else data_address(File(flood.fold, TEXTURE_TYPE, "")),
    )
    return whole_page(FLOOD, {"flood": told}, flood.title)


def serve(
    asked: FloodOptions, token_file: Path | None, host: str, port: int, *, say: Say, show: Callable[[str, Made], None]
) -> None:
    """Serve a flood until Ctrl-C or SIGTERM.

    Without a token nothing can be published, and only requests to the server's own address are answered. `say` takes
    warnings and notes for the user, `show` the address and what is shown there.
    """
    from vexture.flood.ground import GROUND_TYPE
    from vexture.live.converter import BusyError, Converter
    from vexture.live.listen import background, bind, listen, serve_until_stopped
    from vexture.live.page_routes import page_routes
    from vexture.live.publishing import publishing_routes
    from vexture.live.routes import NO_SNIFFING, application, fixed, routes
    from vexture.live.tokens import read_token

    built(FLOOD.script)
    token = None if token_file is None else read_token(token_file)
    with closing(bind(host, port)) as taken:
        made = make(asked, say)
        limits = Limits()
        shelf = LimitedShelf(limits)
        for shape in made.shapes:
            shelf.put(shape)
        flood, converter = made.flood, Converter(limits, made.conversion)
        told = scene(flood, shelf.names, GROUND_NAME, FOLD_NAME if flood.fold else None)
        fresh = {"Cache-Control": "no-cache", **NO_SNIFFING}

        async def warm() -> None:
            with suppress(BusyError):
                await converter.warm()

        def stop() -> None:
            shelf.close()
            converter.close()

        app = application(
            [
                *page_routes(FLOOD, served_page(FLOOD, {"server": "./", "flood": told}, flood.title)),
                fixed(f"/{GROUND_NAME}", flood.ground, GROUND_TYPE, fresh),
                *([fixed(f"/{FOLD_NAME}", flood.fold, TEXTURE_TYPE, fresh)] if flood.fold else []),
                *routes(shelf),
                *publishing_routes(shelf, converter, limits, token),
            ],
            limits,
            only_at=None if token else host,
            lifespan=background(warm) if token else None,
        )
        show(listen(taken), made)
        serve_until_stopped(app, taken, stop, limits)
