"""Videos and animated pictures of all steps of a flood."""

from collections.abc import Callable, Iterator, Sequence
from io import BytesIO
from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np

from vexture.base.errors import DeviceError
from vexture_geo.flood.film import Film, open_film, video_packages
from vexture_geo.flood.video_options import VideoOptions

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

Track = Callable[[Sequence[int]], Iterator[int]]
"""Goes through numbers and shows how far it is."""

CODECS: Final = {
    ".webm": ("webm", "libvpx-vp9", {"crf": "22", "b": "0", "deadline": "good", "cpu-used": "4", "row-mt": "1"}),
    ".mp4": ("mp4", "libx264", {"crf": "18"}),
}
"""Container, encoder and its options by suffix: an error of a few steps of 255, which nobody sees."""

REC_709: Final = 1
"""Number of the colours of high definition (ITU-T H.273), as which players show frames."""

SAMPLES: Final = 5
"""Frames from which the colours of a GIF are chosen, for all of it."""

COLOURS: Final = 256


def make_video(page: bytes, options: VideoOptions, title: str, track: Track) -> bytes:
    """Return a video of all steps of a page that is whole in one file.

    Raises
    ------
    DeviceError
        If a package or a browser is missing.
    ParameterError
        If the page has no such view, or the video has too many frames.
    """
    with video_packages():
        if not options.is_gif:
            import av  # noqa: F401  # before a browser is started
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
