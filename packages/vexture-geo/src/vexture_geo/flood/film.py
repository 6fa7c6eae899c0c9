"""Frames of a flood's page, drawn by a browser that nobody sees."""

import base64
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from vexture.base.errors import DeviceError, ParameterError, reason_of
from vexture_geo.flood.video_options import VideoOptions

PROGRAMS: Final = (
    "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "microsoft-edge",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
)  # fmt: skip
"""Browsers by their usual names and places; else that of playwright is used, if it is installed."""

FLAGS: Final = ("--ignore-gpu-blocklist", "--hide-scrollbars")
SOFTWARE: Final = ("--enable-unsafe-swiftshader",)
"""Draws without a graphics card; the page is our own."""

BY_EGL: Final = ("--use-gl=angle", "--use-angle=gl-egl")
"""Without a display, browsers on Linux draw in software of their own unless they are told to use the driver."""

DRIVERS: Final = (BY_EGL, SOFTWARE) if sys.platform == "linux" else (SOFTWARE,)

READY_SECONDS: Final = 600.0
"""For the first picture: in software shaders take long to compile."""

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
        """PNG of a step at a time of its waves."""
        address: str = self.page.evaluate(DRAW, [step, seconds, self.plain])
        return base64.b64decode(address.partition(",")[2])


@contextmanager
def open_film(page: bytes, options: VideoOptions) -> Iterator[Film]:
    """Open a page of a flood, all of it in one file, in a browser.

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
    """Open the page; why it draws nothing, if so."""
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
