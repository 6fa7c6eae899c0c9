"""Parameters of a video of all steps of a flood, checked before any file is read."""

from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from pathlib import Path
from typing import Final

from vexture.base.errors import ParameterError

SIZE: Final = (1280, 720)
STEP_SECONDS: Final = 0.5
FPS: Final = 10.0
"""Default size in pixels, seconds for each step, and frames a second."""

GIF: Final = ".gif"
SUFFIXES: Final = (".webm", ".mp4", GIF)

LEAST_SIDE, MOST_SIDE = 64, 4096
MOST_SECONDS: Final = 60.0
MOST_FPS: Final = 60.0
MOST_GIF_FPS: Final = 50.0
"""Most frames a second of a GIF, which counts hundredths of a second; browsers slow down frames of one hundredth."""

MOST_FRAMES: Final = 20_000


@dataclass(frozen=True, slots=True)
class VideoOptions:
    """Options of a video; see `vexture flood --help`. Values out of range raise `ParameterError`.

    `view` is the name of a view of the page, and `colours` are what the water is coloured by; `plain` omits all text on
    the picture.
    """

    path: Path
    size: tuple[int, int] = SIZE
    view: str | None = None
    colours: str | None = None
    plain: bool = False
    step_seconds: float = STEP_SECONDS
    fps: float | None = None

    def __post_init__(self) -> None:
        if self.path.suffix.lower() not in SUFFIXES:
            raise ParameterError(f"`video` {self.path}: is no name of a video; end it in {', '.join(SUFFIXES)}")
        width, height = self.size
        if min(self.size) < LEAST_SIDE or max(self.size) > MOST_SIDE:
            raise ParameterError(f"`size` {width}x{height}: sides are {LEAST_SIDE} to {MOST_SIDE} pixels")
        if not self.is_gif and (width % 2 or height % 2):
            raise ParameterError(f"`size` {width}x{height}: both sides of a video are even; choose others")
        if not (isfinite(self.step_seconds) and 0.0 < self.step_seconds <= MOST_SECONDS):
            raise ParameterError(f"`step_seconds` {self.step_seconds:g}: it is above 0, and {MOST_SECONDS:g} at most")
        most = MOST_GIF_FPS if self.is_gif else MOST_FPS
        if not (isfinite(float(self.rate)) and 0.0 < self.rate <= most):
            raise ParameterError(f"`fps` {float(self.rate):g}: it is above 0, and {most:g} at most; change it")
        if self.frames_per_step < 1:
            raise ParameterError(
                f"`fps` {float(self.rate):g}: some steps of {self.step_seconds:g} s have no frame; raise one of both"
            )

    @property
    def is_gif(self) -> bool:
        """True if the video is a GIF."""
        return self.path.suffix.lower() == GIF

    @property
    def rate(self) -> Fraction:
        """Frames a second; by default a GIF has one for each step."""
        given = self.fps
        if given is None:
            given = 1.0 / self.step_seconds if self.is_gif else max(FPS, 1.0 / self.step_seconds)
        return Fraction(given).limit_denominator(1000) if isfinite(given) else Fraction(0)

    @property
    def frames_per_step(self) -> Fraction:
        """Average number of frames per step."""
        return self.rate * Fraction(self.step_seconds).limit_denominator(1000)

    def frames(self, steps: int) -> list[int]:
        """Return the number of the step that each frame shows.

        Examples
        --------
        >>> VideoOptions(Path("run.webm"), step_seconds=0.25, fps=10).frames(4)
        [0, 0, 0, 1, 1, 2, 2, 2, 3, 3]
        >>> VideoOptions(Path("run.gif")).frames(3)
        [0, 1, 2]
        """
        count = round(steps * self.frames_per_step)
        if count > MOST_FRAMES:
            raise ParameterError(f"`video` {self.path}: has {count} frames; the limit is {MOST_FRAMES}; lower `fps`")
        return [int(number / self.frames_per_step) for number in range(count)]


def size_of(text: str) -> tuple[int, int]:
    """Parse a size that a user has written as WxH.

    Examples
    --------
    >>> size_of("1920x1080")
    (1920, 1080)
    >>> size_of("large")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `size` large: give pixels as WIDTHxHEIGHT, such as 1280x720
    """
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        raise ParameterError(f"`size` {text}: give pixels as WIDTHxHEIGHT, such as {SIZE[0]}x{SIZE[1]}") from None
    return width, height
