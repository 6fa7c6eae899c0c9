"""Videos of all steps of a flood, as a player shows them."""

import io
import os
import subprocess

import numpy as np
import pytest
from flood_seen import PATIENCE
from floods import flood, sea, series
from PIL import Image
from server import COMMAND

from vexture_geo.flood.depth_classes import colors_of

pytestmark = pytest.mark.usefixtures("page_is_built")

EDGES = [0.3, 0.45, 0.6]
SMALL = ("--size", "320x180", "--view", "plan")


def filmed(*arguments, **environment):
    """`vexture flood` in a process of its own: this one holds a browser already."""
    command = [*COMMAND, "flood", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})


def wet(picture):
    """Share of the middle row of a plan that is bluer than any ground."""
    red, _, blue = np.asarray(picture.convert("RGB")).astype(int)[picture.height // 2].T
    return (blue > red + 20).mean()


def check_water(pictures):
    """Whether water is where the data have it, from the west to a share of the box, which is most of a plan."""
    shares = [wet(picture) for picture in pictures]
    wide = shares[0] / EDGES[0]
    assert 0.7 < wide < 1.0
    assert shares == pytest.approx([wide * edge for edge in EDGES], abs=0.06)  # the last of it is shallow, and clear


@pytest.mark.slow
def test_gif_has_a_frame_for_each_step(chromium, screenshot, tmp_path):
    path = tmp_path / "run.gif"
    outcome = filmed("--extent", series(tmp_path / "run.nc", EDGES), "--video", path, *SMALL, "--step-seconds", 0.75)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.endswith(f" {path.stat().st_size} bytes\n")
    shown, milliseconds = [], []
    with Image.open(path) as film:
        assert (film.n_frames, film.size, film.info["loop"]) == (3, (320, 180), 0)
        for number in range(3):
            film.seek(number)
            milliseconds.append(film.info["duration"])
            shown.append(film.convert("RGB"))
    assert milliseconds == [750, 750, 750]
    check_water(shown)
    first, *_, last = (np.asarray(picture)[:40, :300].astype(int) for picture in shown)
    assert np.abs(first - last).max() > 100  # the time that is written there


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".webm", ".mp4"])
def test_video_has_its_frames_and_a_browser_plays_it(chromium, open_page, tmp_path, suffix):
    av = pytest.importorskip("av")
    path, page = tmp_path / f"run{suffix}", tmp_path / "page.html"
    given = series(tmp_path / "run.nc", EDGES)
    outcome = filmed("--extent", given, "--video", path, "-o", page, *SMALL, "--plain", "--step-seconds", 0.5)
    assert outcome.returncode == 0, outcome.stderr
    assert [line.partition(":")[0] for line in outcome.stdout.splitlines()] == [str(page), str(path)]
    with av.open(str(path)) as film:
        frames = [frame.to_image() for frame in film.decode(video=0)]
        assert (len(frames), film.duration) == (15, 1_500_000)
    assert {frame.size for frame in frames} == {(320, 180)}
    check_water([frames[0], frames[7], frames[14]])
    if suffix == ".webm":  # the other codec is not in every browser
        player = tmp_path / "player.html"
        player.write_text(f'<video src="{path.name}" muted></video>')
        opened = open_page(player.as_uri(), (400, 300))
        opened.wait_for_function("document.querySelector('video').readyState >= 2", timeout=PATIENCE)
        facts = opened.evaluate("(({ duration, videoWidth, videoHeight }) => [duration, videoWidth, videoHeight])"
                                "(document.querySelector('video'))")  # fmt: skip
        assert facts == [1.5, 320, 180]
        pictures = []
        for seconds in (0.05, 0.75, 1.45):
            opened.evaluate("(to) => new Promise((done) => { const film = document.querySelector('video'); "
                            "film.onseeked = done; film.currentTime = to; })", seconds)  # fmt: skip
            pictures.append(Image.open(io.BytesIO(opened.locator("video").screenshot())))
        check_water(pictures)


@pytest.mark.slow
def test_the_colours_of_a_video_are_chosen(chromium, tmp_path):
    path, given = tmp_path / "run.gif", series(tmp_path / "run.nc", EDGES)
    outcome = filmed("--extent", given, "--video", path, *SMALL, "--plain", "--colours", "depth", "--depths", "0,1")
    assert outcome.returncode == 0, outcome.stderr
    colors = [[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in colors_of(2)]
    with Image.open(path) as film:
        for number, edge in enumerate(EDGES):
            film.seek(number)
            row = np.asarray(film.convert("RGB"))[90].astype(int)
            found = [np.flatnonzero(np.abs(row - color).max(axis=-1) < 45) for color in colors]
            assert found[1].max() < found[0].min()  # deep in the west, shallow beside it
            assert len(found[1]) + len(found[0]) == pytest.approx(edge * 320, rel=0.2)
    outcome = filmed("--extent", given, "--video", path, *SMALL, "--colours", "hazard")
    said = "--colours hazard: the page has no such colours; choose water, depth, smooth, greatest, arrival"
    assert (outcome.returncode, outcome.stderr.splitlines()[-1]) == (1, f"vexture: {said}")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--video", "run.avi"], "--video run.avi: is no name of a video; end it in .webm, .mp4, .gif"),
        (["--video", "run.webm", "--size", "321x180"], "--size 321x180: both sides of a video are even"),
        (["--video", "run.gif", "--size", "32x18"], "--size 32x18: sides are 64 to 4096 pixels"),
        (["--video", "run.gif", "--size", "big"], "--size big: give pixels as WIDTHxHEIGHT"),
        (["--video", "run.gif", "--fps", "1"], "--fps 1: some steps of 0.5 s have no frame"),
        (["--video", "run.gif", "--step-seconds", "nan"], "--step-seconds nan: it is above 0"),
        (["--video", "run.gif", "--serve"], "give either files (-o, --video) or --serve"),
        (["-o", "run.html", "--colours", "depth"], "--colours is for a video; give --video FILE, too"),
        (["-o", "run.html", "--view", "Plan"], "--view is for a video; give --video FILE, too"),
        (["--video", "/dev/null/run.gif"], "/dev/null: cannot be written"),
    ],
)
def test_what_is_no_video_is_one_line(tmp_path, options, said):
    outcome = flood("--extent", sea(tmp_path / "sea.geojson"), *options)
    assert (outcome.returncode, len(outcome.stderr.splitlines())) == (1, 1), outcome.stderr
    assert said in outcome.stderr


@pytest.mark.slow
def test_without_a_browser_there_is_one_line_and_no_file(tmp_path):
    path = tmp_path / "run.gif"
    nothing = {"PATH": str(tmp_path), "PLAYWRIGHT_BROWSERS_PATH": str(tmp_path)}
    outcome = filmed("--extent", sea(tmp_path / "sea.geojson"), "--video", path, **nothing)
    assert outcome.returncode == 1
    assert outcome.stderr.splitlines()[-1] == (
        "vexture: videos need a browser (there is no Chromium, Chrome or Edge); install one of them, or run: "
        "playwright install chromium"
    )
    assert not path.exists()
