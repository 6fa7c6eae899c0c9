"""`vexture flood`: show the user's files as one page, or on a server that accepts newer ones."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import about
from vexture.base.errors import ParameterError, SourceError, format_count
from vexture.base.notes import HEADINGS, Note, line_of
from vexture.base.workers import Workers
from vexture.drawing.drawing import Drawing
from vexture.pages.page import built, check_output, data_address, served_page, whole_page
from vexture.server.limited_shapes import LimitedShapes
from vexture.server.limits import Limits
from vexture.server.published import TEXTURE_TYPE, PublishedFile, PublishedShape, manifest
from vexture_geo.base.extent import Extent, Frame
from vexture_geo.flood.bundle import FLOOD
from vexture_geo.flood.conversion import FloodConversion
from vexture_geo.flood.credits import Credits
from vexture_geo.flood.options import FloodOptions
from vexture_geo.flood.scene import PREFIX, Flood, PageNote, labels, scene, step_names

if TYPE_CHECKING:  # at run time, only what a flood needs is imported
    from socket import socket

    from vexture_geo.flood.follow import Start
    from vexture_geo.flood.relief import Relief
    from vexture_geo.flood.store import FloodStore
    from vexture_geo.flood.surface import WaterSurface
    from vexture_geo.flood.video import Track
    from vexture_geo.flood.video_options import VideoOptions

GROUND_NAME, FOLD_NAME = "ground.webp", "shore.fold.ktx2"

INVENTED: Final = PageNote("The relief is invented.", "--relief takes a file of heights.")
DRAWN: Final = PageNote("The ground is drawn, not photographed.", "--ground takes a picture.")
DRY: Final = PageNote("Nothing is under water.", "")
SHELTERED: Final = PageNote("No shore is open to waves, so none run up it.", "")

LESS: Final = 0.95
"""Fraction of the requested amplitude below which a note says that waves reach less far."""

WHOLE: Final = 0.995
"""Fraction of the ground with known heights below which a note says so."""

Say = Callable[[str], None]
"""Reports a line to the user."""


class ReadyFlood(NamedTuple):
    """A flood that is ready to be shown."""

    flood: Flood
    conversion: FloodConversion
    shapes: Sequence[PublishedShape]

    @property
    def texture_bytes(self) -> int:
        """Size of all textures as they are sent, in bytes."""
        return sum(len(shape.texture.data) for shape in self.shapes)

    @property
    def summary(self) -> str:
        """Summary of the flood in one line."""
        count = len(self.shapes)
        dry = sum(bool(shape.facts["dry"]) for shape in self.shapes)
        text = f"{format_count(count, 'step')}, {self.texture_bytes} bytes of textures"
        return text + (f", {'nothing' if dry == count else f'in {dry} nothing'} under water" if dry else "")


class WrittenFlood(NamedTuple):
    """A flood that was written into files, and their sizes in bytes."""

    made: ReadyFlood
    sizes: dict[Path, int]


def make_flood(
    options: FloodOptions,
    report: Say,
    start: "Start | None" = None,
    store: "FloodStore | None" = None,
    source: tuple[Extent, Credits] | None = None,
) -> ReadyFlood:
    """Read all files of a flood and convert them; `report` receives warnings and notes for the user.

    `start` holds the first steps of a followed run; steps that are already in the `store` are not converted again. With
    `source`, an extent and its credits, no file of an extent is read.
    """
    from vexture_geo.flood.credits import credits_of
    from vexture_geo.flood.depth_classes import classes_shown
    from vexture_geo.flood.ground import drawn_ground, encode_webp, ground_of
    from vexture_geo.flood.open_water import calm_waves
    from vexture_geo.flood.relief import beyond_of, relief_of
    from vexture_geo.flood.surface import highest_of, surface_of
    from vexture_geo.flood.views import views_of

    if start is not None:
        source = start.extent, start.credits
    extent, credits = source or (_read(options), credits_of(options.extent))
    if line := line_of(str(options.extent), extent.notes):
        report(f"warning: {line}")
    frame = extent.frame
    amplitude = options.amplitude_in(max(frame.metres))

    def heights() -> "Relief":
        return relief_of(extent, options.relief, options.crs)

    relief = heights() if store is None else store.relief(options, extent, heights)
    first = extent.steps[0]
    depths = classes_shown(first, options.depths)
    conversion = FloodConversion(frame, options.hmin, options.reading, relief, depths, extent.bed)
    picture, ground_notes = drawn_ground(extent, relief), [DRAWN]
    if options.ground is not None:
        picture, ground_notes = ground_of(options.ground, frame, picture, bounds_given=options.bounds is not None)
    notes = [*([INVENTED] if relief.invented else []), *ground_notes]
    surfaces = [surface_of(step, frame, relief, extent.bed, options.hmin) for step in extent.steps]
    shapes = _shapes(conversion, extent, surfaces, start, store, options.executor())
    beyond = beyond_of(extent, relief)
    fold, openness, shore_notes = _shore(options, extent, amplitude, beyond)
    notes += shore_notes if start is None else [note for note in shore_notes if note is not DRY]  # water may come
    if relief.known < WHOLE:
        notes.append(PageNote(f"{relief.known:.0%} of the ground has a height; the rest goes on as its border.", ""))
    credits = credits.with_given(title=options.title, source=options.source, licence=options.licence)
    flood = Flood(
        title=credits.title or options.extent.name.partition(".")[0] or PREFIX,
        credits=credits,
        depths=depths,
        end=first.classes.ranges[-1].high if first.classes else inf,
        frame=frame,
        ground=encode_webp(picture),
        relief=relief,
        fold=fold,
        openness=None if openness is None else calm_waves(openness, frame, beyond),
        views=views_of(extent, openness, highest_of(surfaces), beyond),
        notes=(*_on_page(options.extent.name, extent.notes), *notes),
    )
    for note in notes:
        report(" ".join(("note:", *filter(None, note))))
    return ReadyFlood(flood, conversion, shapes)


def _on_page(name: str, notes: Sequence[Note]) -> Iterator[PageNote]:
    """Rewrite the notes of a file for readers of its page, without remedies for its author."""
    for note in notes:
        text, _, remedy = str(note).partition("; ")
        heading = HEADINGS[note.kind]
        yield PageNote(f"{name}: {heading}{text}.", remedy)


def _shapes(
    conversion: FloodConversion,
    extent: Extent,
    surfaces: "Sequence[WaterSurface]",
    start: "Start | None",
    store: "FloodStore | None",
    workers: Workers,
) -> list[PublishedShape]:
    """Convert the steps; of a followed run, only those that are new or have changed."""
    from vexture_geo.flood.follow import NAMES, is_made_of, with_digest

    steps, told = extent.steps, labels([step.time for step in extent.steps])
    if start is None:
        named = zip(steps, surfaces, step_names(len(steps)), told, strict=True)
        return list(workers.map(FloodConversion.convert_one, conversion, named, len(steps)))
    shapes = []
    for step, surface, name, label, known in zip(steps, surfaces, NAMES, told, start.known, strict=False):
        before = None if store is None else store.shape(name)
        if before is None or not is_made_of(before, known):
            before = with_digest(conversion.step(step, surface, name, label), known)
        shapes.append(before)
    return shapes


def _shore(
    options: FloodOptions, extent: Extent, amplitude: float, beyond: NDArray[np.bool_] | None
) -> tuple[bytes | None, NDArray[np.float64] | None, list[PageNote]]:
    """Make the file that moves the shore, the openness of the water, and remarks about both."""
    from vexture_geo.flood.open_water import calm_waves, open_water
    from vexture_geo.flood.relief import first_wet, widest

    first, most = first_wet(extent), widest(extent)
    if first is None or most is None:
        return None, None, [DRY]
    openness = open_water(first.drawing, extent.frame, most.drawing, beyond)
    if amplitude and openness.any():
        fold, reached = _fold(
            first.drawing, calm_waves(openness, extent.frame, beyond), amplitude, options.period, extent.frame
        )
        if options.amplitude is None or reached >= LESS * amplitude:
            return fold, openness, []
        told = f"Waves run up {reached:.3g} m: {amplitude:.3g} m would turn the shore over."
        return fold, openness, [PageNote(told, "")]
    return None, openness, [SHELTERED] if options.amplitude else []


def _read(options: FloodOptions) -> Extent:
    from vexture_geo.readers import extent_of

    if options.extent.is_dir():
        raise SourceError(f"`extent` {options.extent}: is a folder; name a file in it that says where water is")
    if not options.extent.is_file():
        raise SourceError(f"`extent` {options.extent}: there is no such file; name one that says where water is")
    named = str(options.extent)
    with about(named):
        return extent_of(
            options.extent,
            named,
            bounds=options.bounds,
            crs=options.crs,
            hmin=options.hmin,
            workers=options.executor(),
            **options.reading,
        )


def _fold(
    drawing: Drawing, openness: NDArray[np.float64], amplitude: float, period: float, frame: Frame
) -> tuple[bytes, float]:
    """Make the file that moves the shore of open water along the beach; return it and its largest shift in metres."""
    from vexture.fold.shore import fold_of_shore
    from vexture_geo.base.extent import MARGIN
    from vexture_geo.flood.open_water import openness_at

    share = (1.0 - 2.0 * MARGIN) / max(frame.metres)
    fold = fold_of_shore(drawing, amplitude=amplitude * share, period=period)
    rows, columns, _ = fold.displacement.shape
    x, y = np.meshgrid((np.arange(columns) + 0.5) / columns, 1.0 - (np.arange(rows) + 0.5) / rows)
    moved = openness_at(openness, frame, np.stack([x, y], axis=-1))
    fold = replace(fold, displacement=(fold.displacement * moved[..., None]).astype(np.float32))
    return fold.to_ktx2(), float(np.hypot(fold.displacement[..., 0], fold.displacement[..., 1]).max()) / share


def export(
    options: FloodOptions, output: Path | None, video: "VideoOptions | None", report: Say, track: "Track"
) -> WrittenFlood:
    """Write one self-contained page, a video of it, or both.

    `track` iterates over the frames of the video, and may show progress.
    """
    from vexture.texture.files import writable, write_together

    built(FLOOD.script, FLOOD.package)
    if output is not None:
        check_output(output, FLOOD)
    if video is not None:
        from vexture_geo.flood.video import make_video

        writable(video.path.parent)
    made = make_flood(options, report)
    page = page_of(made)
    files = {} if output is None else {output: page}
    if video is not None:
        files[video.path] = make_video(page, video, made.flood.title, track)
    write_together(files)
    return WrittenFlood(made, {path: len(data) for path, data in files.items()})


def page_of(ready: ReadyFlood) -> bytes:
    """Make one self-contained page."""
    from vexture_geo.flood.ground import GROUND_TYPE

    flood = ready.flood
    data = scene(
        flood,
        [manifest(shape, None, {}, address=data_address) for shape in ready.shapes],
        data_address(PublishedFile(flood.ground, GROUND_TYPE, "")),
        None if flood.fold is None else data_address(PublishedFile(flood.fold, TEXTURE_TYPE, "")),
    )
    return whole_page(FLOOD, {"flood": data}, flood.title)


@dataclass(frozen=True, slots=True)
class ServerOptions:
    """Options of a flood's server.

    Without a token nothing can be pushed, and only requests to the server's own address are answered. With `follows`,
    the extent is a file that a model writes. The folder `keep` stores pushed and followed steps for the next start.
    """

    host: str
    port: int
    token_file: Path | None = None
    follows: bool = False
    keep: Path | None = None

    def __post_init__(self) -> None:
        if self.keep is not None and self.token_file is None and not self.follows:
            raise ParameterError(
                f"`keep` {self.keep}: no water comes that could be kept; give `token_file` or `follow`"
            )


def serve(
    options: FloodOptions, server_options: ServerOptions, *, report: Say, show: Callable[[str, ReadyFlood], None]
) -> None:
    """Serve a flood until Ctrl-C or SIGTERM.

    `report` receives warnings and notes for the user; `show` receives the address and the flood.
    """
    from vexture.server.listen import bind
    from vexture.server.tokens import read_token
    from vexture_geo.flood.store import FloodStore

    built(FLOOD.script, FLOOD.package)
    token = None if server_options.token_file is None else read_token(server_options.token_file)
    limits = Limits()
    with closing(bind(server_options.host, server_options.port)) as socket, ExitStack() as stack:
        store = None
        if server_options.keep is not None:
            store = FloodStore(server_options.keep, limits, report)
            stack.callback(store.release)
        shelf = LimitedShapes(limits) if store is None else store
        _serve(options, server_options, token, socket, shelf, store, report, show)


def _publish_shapes(shapes: Sequence[PublishedShape], shelf: LimitedShapes, *, over: bool) -> list[PublishedShape]:
    """Publish new shapes, replacing older ones only if `over` (a pushed shape is newer), and return the new ones."""
    fresh = [shape for shape in shapes if shelf.shape(shape.name) is not shape]
    for shape in fresh:
        if over or shelf.shape(shape.name) is None:
            shelf.add(shape)
    return fresh


def _serve(
    options: FloodOptions,
    server_options: ServerOptions,
    token: str | None,
    socket: "socket",
    shelf: LimitedShapes,
    store: "FloodStore | None",
    report: Say,
    show: Callable[[str, ReadyFlood], None],
) -> None:
    from vexture.pages.page_routes import page_routes
    from vexture.server.converter import BusyError, Converter
    from vexture.server.listen import background, listen, serve_until_stopped
    from vexture.server.routes import NO_SNIFFING, application, fixed_route, routes
    from vexture.server.uploads import publishing_routes
    from vexture_geo.flood.follow import FollowedRun, first_steps, follow
    from vexture_geo.flood.ground import GROUND_TYPE

    run = FollowedRun(options.extent, options.of_depths)
    start = first_steps(run, options.bounds, report) if server_options.follows else None
    made = make_flood(options, report, start, store)
    if shelf.names:
        report(f"{server_options.keep}: {format_count(len(shelf.names), 'step')} from before")
    fresh = _publish_shapes(made.shapes, shelf, over=start is not None)
    flood, limits = made.flood, Limits()
    converter = Converter(limits, made.conversion)

    async def work() -> None:
        if token:
            with suppress(BusyError):
                await converter.warm()
        if start is not None:
            await follow(run, start, fresh, made.conversion, shelf, report)

    def stop() -> None:
        shelf.close()
        converter.close()

    @lru_cache(1)
    def page(names: tuple[str, ...]) -> bytes:
        data = scene(flood, names, GROUND_NAME, FOLD_NAME if flood.fold else None)
        return served_page(FLOOD, {"server": "./", "flood": data}, flood.title)

    plain = {"Cache-Control": "no-cache", **NO_SNIFFING}
    app = application(
        [
            *page_routes(FLOOD, lambda: page(tuple(shelf.names))),
            fixed_route(f"/{GROUND_NAME}", flood.ground, GROUND_TYPE, plain),
            *([fixed_route(f"/{FOLD_NAME}", flood.fold, TEXTURE_TYPE, plain)] if flood.fold else []),
            *routes(shelf),
            *publishing_routes(shelf, converter, limits, token),
        ],
        limits,
        only_at=None if token else server_options.host,
        lifespan=background(work) if token or start else None,
    )
    show(listen(socket), made)
    serve_until_stopped(app, socket, stop, limits)
