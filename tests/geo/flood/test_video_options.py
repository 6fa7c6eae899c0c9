"""Options of a video: which step each frame shows, and what is refused before any file is read."""

from collections import Counter
from pathlib import Path

import pytest

from vexture.base.errors import ParameterError
from vexture_geo.flood.video_options import MOST_FRAMES, VideoOptions, size_of


def test_a_gif_has_a_frame_for_each_step_and_a_video_at_least_ten_a_second():
    assert VideoOptions(Path("a.gif"), step_seconds=0.4).rate == 2.5
    assert VideoOptions(Path("a.webm"), step_seconds=0.5).frames(3) == [0] * 5 + [1] * 5 + [2] * 5
    assert VideoOptions(Path("a.MP4"), step_seconds=0.05).rate == 20


@pytest.mark.parametrize(("seconds", "fps"), [(0.3, 24.0), (1.0, 29.97), (0.1, 10.0)])
def test_steps_are_shown_in_order_for_as_long_as_is_asked_for(seconds, fps):
    frames = VideoOptions(Path("a.mp4"), step_seconds=seconds, fps=fps).frames(50)
    assert frames == sorted(frames)
    assert len(frames) == pytest.approx(50 * seconds * fps, abs=1)
    count = Counter(frames)
    assert sorted(count) == list(range(50))
    assert max(count.values()) - min(count.values()) <= 1


@pytest.mark.parametrize(
    ("path", "options", "words"),
    [
        ("a.avi", {}, "is no name of a video"),
        ("a.mp4", {"size": (1279, 720)}, "both sides of a video are even"),
        ("a.mp4", {"size": (62, 720)}, "sides are 64 to 4096 pixels"),
        ("a.mp4", {"step_seconds": 0.0}, "`step_seconds` 0: it is above 0"),
        ("a.mp4", {"fps": float("nan")}, "`fps`"),
        ("a.gif", {"fps": 51.0}, "and 50 at most"),
        ("a.mp4", {"fps": 1.0, "step_seconds": 0.5}, "some steps of 0.5 s have no frame"),
    ],
)
def test_values_out_of_range_are_named(path, options, words):
    with pytest.raises(ParameterError, match=words):
        VideoOptions(Path(path), **options)


def test_a_gif_may_have_odd_sides_and_a_video_not_any_number_of_frames():
    assert VideoOptions(Path("a.gif"), size=size_of("321X181")).size == (321, 181)
    with pytest.raises(ParameterError, match=f"has {MOST_FRAMES + 5} frames"):
        VideoOptions(Path("a.mp4")).frames(MOST_FRAMES // 5 + 1)
