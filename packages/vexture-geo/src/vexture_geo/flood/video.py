"""Make videos and animated pictures of all steps of a flood: a headless browser draws the frames."""

import base64
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from vexture.base.errors import DeviceError, ParameterError, reason_of
from vexture_geo.flood.video_options import VideoOptions

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

Track = Callable[[Sequence[int]], Iterator[int]]
"""Iterates over numbers and shows progress."""

CODECS: Final = {
    ".webm": ("webm", "libvpx-vp9", {"crf": "22", "b": "0", "deadline": "good", "cpu-used": "4", "row-mt": "1"}),
    ".mp4": ("mp4", "libx264", {"crf": "18"}),
}
"""Container, encoder and encoder options by suffix; errors of a few steps of 255 are invisible."""

REC_709: Final = 1
"""Code of the colours of high definition (ITU-T H.273), with which players show frames."""

SAMPLES: Final = 5
"""Frames from which the palette of a GIF is chosen."""

COLOURS: Final = 256

PROGRAMS: Final = (
    "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "microsoft-edge",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
)  # fmt: skip
"""Browsers by their usual names and places; else that of playwright is used, if it is installed."""

FLAGS: Final = ("--ignore-gpu-blocklist", "--hide-scrollbars")
SOFTWARE: Final = ("--enable-unsafe-swiftshader",)
"""Flag to draw without a graphics card, which is safe for our own page."""

BY_EGL: Final = ("--use-gl=angle", "--use-angle=gl-egl")
"""Flags to use the graphics driver: without a display, browsers on Linux otherwise draw in software."""

DRIVERS: Final = (BY_EGL, SOFTWARE) if sys.platform == "linux" else (SOFTWARE,)

READY_SECONDS: Final = 600.0
"""Limit for the first picture, because software takes long to compile shaders."""

DRAW: Final = "([step, seconds, plain]) => vexture.flood.frame(step, seconds, plain)"


@contextmanager
def video_packages() -> Iterator[None]:
    """Turn a `ModuleNotFoundError` into a `DeviceError` that says how to install the package.

    Examples
    --------
    >>> with video_packages():
    ...     raise ModuleNotFoundError(name="av")
    Traceback (most recent call last):
        ...
    vexture.base.errors.DeviceError: videos need the package av: pip install 'vexture[video]'
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "vexture").split(".")[0] == "vexture":
            raise
        raise DeviceError(f"videos need the package {error.name}: pip install 'vexture[video]'") from None


@dataclass(frozen=True, slots=True)
class Film:
    """A page that draws frames."""

    page: Any
    steps: int
    plain: bool

    def frame(self, step: int, seconds: float) -> bytes:
        """Draw a step at a time of its waves as a PNG."""
        address: str = self.page.evaluate(DRAW, [step, seconds, self.plain])
        return base64.b64decode(address.partition(",")[2])


@contextmanager
def open_film(page: bytes, options: VideoOptions) -> Iterator[Film]:
    """Open the self-contained page of a flood in a browser.

    Raises
    ------
    DeviceError
        If a package or a browser is missing, or the browser cannot draw the page.
    ParameterError
        If the page has no view or no colours of that name.
    """
    from playwright.sync_api import Error, sync_playwright

    with tempfile.TemporaryDirectory(prefix="vexture-") as folder, sync_playwright() as started:
        file = Path(folder, "flood.html")
        file.write_bytes(page)
        try:
            for flags in DRIVERS:
                browser = _browser(started.chromium, (*FLAGS, *flags))
                opened, trouble = _open_page(browser, f"{file.as_uri()}?bare", options.size)
                if not trouble:
                    break
                browser.close()
            else:
                raise DeviceError(f"the browser cannot draw the page: {trouble}")
            yield _prepare_film(opened, options)
            browser.close()
        except Error as error:
            raise DeviceError(f"the browser cannot draw the page ({reason_of(error)}); use another one") from None


def _browser(kind: Any, flags: Sequence[str]) -> Any:
    """Start a browser."""
    from playwright.sync_api import Error

    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    try:
        return kind.launch(executable_path=program, args=list(flags))
    except Error as error:
        why = f"{program}: {reason_of(error)}" if program else "there is no Chromium, Chrome or Edge"
        raise DeviceError(
            f"videos need a browser ({why}); install one of them, or run: playwright install chromium"
        ) from None


def _open_page(browser: Any, address: str, size: tuple[int, int]) -> tuple[Any, str]:
    """Open the page; return it and the reason why it draws nothing, if any."""
    width, height = size
    page = browser.new_page(viewport={"width": width, "height": height})
    page.goto(address, timeout=1000 * READY_SECONDS)
    page.evaluate("vexture.flood.ready")
    trouble = page.locator(".fatal")
    return page, trouble.first.inner_text() if trouble.count() else ""


def _prepare_film(page: Any, options: VideoOptions) -> Film:
    """Choose the view and the colours of a page."""
    if options.view is not None:
        views = page.evaluate("vexture.flood.views")
        named = {view.casefold(): view for view in views}
        if options.view.casefold() not in named:
            raise ParameterError(f"`view` {options.view}: the page has no such view; choose {', '.join(views)}")
        page.evaluate("(name) => vexture.flood.view(name, { fly: false })", named[options.view.casefold()])
    if options.colours is not None:
        offered = page.evaluate("vexture.flood.offered")
        if options.colours.lower() not in offered:
            raise ParameterError(
                f"`colours` {options.colours}: the page has no such colours; choose {', '.join(offered)}"
            )
        page.evaluate("(name) => vexture.flood.colours(name)", options.colours.lower())
    return Film(page, page.evaluate("vexture.flood.player.count"), options.plain)


def make_video(page: bytes, options: VideoOptions, title: str, track: Track) -> bytes:
    """Make a video of all steps of a self-contained page.

    Raises
    ------
    DeviceError
        If a package or a browser is missing.
    ParameterError
        If the page has no such view, or the video has too many frames.
    """
    with video_packages():
        if not options.is_gif:
            import av  # noqa: F401  # fails before a browser is started
        with open_film(page, options) as shown:
            return _gif(shown, options, track) if options.is_gif else _video(shown, options, title, track)


def _picture(film: Film, options: VideoOptions, steps: Sequence[int], number: int) -> "Picture":
    from PIL import Image

    return Image.open(BytesIO(film.frame(steps[number], float(number / options.rate)))).convert("RGB")


def _video(film: Film, options: VideoOptions, title: str, track: Track) -> bytes:
    import av

    container, codec, tuning = CODECS[options.path.suffix.lower()]
    steps = options.frames(film.steps)
    out = BytesIO()
    with av.open(out, "w", format=container) as file:
        file.metadata["title"] = title
        try:
            stream = file.add_stream(codec, rate=options.rate, options=tuning)
        except av.codec.codec.UnknownCodecError:
            raise DeviceError(f"`video` {options.path}: PyAV has no {codec} here; write a .gif") from None
        stream.width, stream.height = options.size
        stream.pix_fmt = "yuv420p"
        context = stream.codec_context
        context.colorspace = context.color_primaries = context.color_trc = context.color_range = REC_709
        for number in track(range(len(steps))):
            pixels = np.asarray(_picture(film, options, steps, number))
            frame = av.VideoFrame.from_ndarray(pixels, format="rgb24")
            frame = frame.reformat(format="yuv420p", dst_colorspace=REC_709, dst_color_range=REC_709)
            frame.pts, frame.time_base = number, 1 / options.rate
            file.mux(stream.encode(frame))
        file.mux(stream.encode(None))
    return out.getvalue()


def _gif(film: Film, options: VideoOptions, track: Track) -> bytes:
    from PIL import Image

    steps = options.frames(film.steps)
    chosen = np.unique(np.linspace(0, len(steps) - 1, SAMPLES).astype(int)).tolist()
    sampled = [np.asarray(_picture(film, options, steps, number)) for number in chosen]
    palette = Image.fromarray(np.concatenate(sampled)).quantize(COLOURS, Image.Quantize.FASTOCTREE)  # keeps rare ones

    def frames() -> "Iterator[Picture]":
        for number in track(range(len(steps))):
            yield _picture(film, options, steps, number).quantize(palette=palette)

    ends = [round(100 * number / options.rate) for number in range(len(steps) + 1)]  # hundredths of a second
    rest = frames()
    out = BytesIO()
    next(rest).save(
        out,
        format="GIF",
        save_all=True,
        append_images=rest,
        duration=[10 * (end - start) for start, end in pairwise(ends)],
        loop=0,
    )
    return out.getvalue()
