"""Folded masks in a real browser, against brute force."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mask_page import NEWEST, decode, drawing

import vexture
from chromium import serve_folder
from fold_reference import Numbers, errors
from vexture.fold.fold import Fold, Kind
from vexture.fold.shore import shore_fold
from vexture.texture.texture import Texture

SIZE = 128
TIMES = [0.0, 1.7, 8604.1]
FIT = np.array([[1 / SIZE, 0, 0], [0, -1 / SIZE, 1], [0, 0, 1.0]])
BLACK = {"color": 0}


def folds() -> dict[str, Fold]:
    rng = np.random.default_rng(5)
    shape = (10, 12)
    begin, duration = rng.uniform(0, 4, shape), rng.uniform(2, 5, shape)
    return {
        "shore": shore_fold(drawing("duck"), amplitude=0.02, period=5.0, size=32),
        "wild": Fold(rng.uniform(-0.012, 0.012, (*shape, 2)), rng.integers(0, 5, shape), begin, duration, 5.0),
        "swing": Fold(np.full((1, 1, 2), (0.25, 0.0)), Kind.PERIODIC, duration=4.0, cycle=4.0),  # type: ignore[arg-type]
    }


@pytest.fixture(scope="module")
def address(chromium: Any, mask_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("fold")
    for file in mask_folder.iterdir():
        (folder / file.name).symlink_to(file)
    for name, fold in folds().items():
        (folder / f"{name}.fold.ktx2").write_bytes(fold.to_ktx2())
    with serve_folder(folder) as url:
        yield url


@pytest.fixture(params=NEWEST)
def page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    return open_page(f"{address}/{request.param}.html", (SIZE, SIZE), keep=True)


@pytest.fixture(params=NEWEST)
def fresh_page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    """For tests that change the page's textures or count its programs."""
    return open_page(f"{address}/{request.param}.html", (SIZE, SIZE))


def frames(page: Any, times: list[float] = TIMES, places: Any = (), **config: Any) -> Any:
    """Black on white, as coverage; and all that the page found."""
    options = {"size": SIZE, "parameters": BLACK, **config}
    found = page.evaluate(
        "([config, times, places]) => page.frames(config, times, places)", [options, times, [*places]]
    )
    return [1.0 - decode(frame["picture"])[..., 0] for frame in found["frames"]], found


def uv_view(matrix: Numbers) -> list[float]:
    """A mask's transform from (2, 3), as the page takes it."""
    return [*np.ravel(matrix).tolist(), 0, 0, 1]


def check(pictures: list[Numbers], fold: Fold, to_unit: Numbers, texture: Texture, wrap: str = "none") -> None:
    found = [
        errors(picture, texture, fold, to_unit, seconds, wrap=wrap)
        for picture, seconds in zip(pictures, TIMES, strict=True)
    ]
    assert min(map(len, found)) > 20
    assert np.percentile(np.concatenate(found), 99) <= 8.0


@pytest.mark.slow
def test_a_mask_follows_its_fold(fresh_page: Any, screenshot: Callable[..., Path]) -> None:
    duck = vexture.convert(drawing("duck"))
    for name, flat in (("shore", False), ("wild", True)):
        pictures, found = frames(fresh_page, mask={"fold": name, "flat": flat})
        screenshot(fresh_page.locator("canvas"), name)
        check(pictures, folds()[name], FIT, duck)
        assert max(np.abs(pictures[0] - one).max() for one in pictures) > 0.5
        assert found["programs"] <= 3


@pytest.mark.slow
def test_near_and_tilted_it_does_not_sparkle(page: Any, screenshot: Callable[..., Path]) -> None:
    duck, fold = vexture.convert(drawing("duck")), folds()["shore"]
    contours = [contour for path in drawing("duck").paths for contour in path.contours]
    point = np.concatenate(contours)[3, 0]
    for zoom in (4.0, 16.0):
        matrix = np.array([[1 / zoom, 0, point[0] - 0.5 / zoom], [0, 1 / zoom, point[1] - 0.5 / zoom]])
        pictures, _ = frames(page, mask={"fold": "shore", "transform": uv_view(matrix)})
        check(pictures, fold, np.vstack([matrix, [0, 0, 1]]) @ FIT, duck)
    mask = {"fold": "shore", "transform": [2, 0, -0.5, 0, 2, -0.5, 0, 0, 1]}
    pictures, found = frames(page, camera="tilted", plane=[4, 4], mask=mask, size=4 * SIZE)
    screenshot(page.locator("canvas"))
    clip = np.reshape(found["matrix"], (4, 4)).T[[0, 1, 3]][:, [0, 1, 3]]
    to_plane = np.array([[2.0, 0, -1], [0, 2, -1], [0, 0, 1]])
    to_pixels = 2 * SIZE * np.array([[1, 0, 1], [0, -1, 1], [0, 0, 0.5 / SIZE]])
    check(pictures, fold, np.linalg.inv(to_pixels @ clip @ to_plane), duck)


@pytest.mark.slow
def test_it_repeats_with_the_shape(page: Any, screenshot: Callable[..., Path]) -> None:
    matrix = np.array([[1.7, 0, -0.4], [0, 1.7, 0.3]])
    pictures, _ = frames(page, texture="border", mask={"fold": "wild", "wrap": "repeat", "transform": uv_view(matrix)})
    screenshot(page.locator("canvas"))
    view = np.vstack([matrix, [0, 0, 1]]) @ FIT
    check(pictures, folds()["wild"], view, vexture.convert(drawing("border")), "repeat")


def test_rays_meet_what_is_seen(page: Any) -> None:
    rng = np.random.default_rng(2)
    cells = rng.integers(0, SIZE, (400, 2))
    places = (cells + 0.5) / SIZE
    pictures, found = frames(page, places=places.tolist(), mask={"fold": "shore", "mode": "cut"})
    for picture, frame in zip(pictures, found["frames"], strict=True):
        seen = picture[SIZE - 1 - cells[:, 1], cells[:, 0]] > 0.5
        assert (np.array(frame["hits"]) == seen).mean() > 0.98  # not at a pixel's middle, but by its coverage
    assert len({tuple(frame["hits"]) for frame in found["frames"]}) > 1


@pytest.mark.parametrize(
    ("mode", "texture"),
    [("alpha", "duck"), ("cut", "duck"), ("mix", "duck"), ("paint", "paint"), ("paint", "map"), ("cut", "map")],
)
def test_every_mode_moves(page: Any, mode: str, texture: str) -> None:
    """A shift by a quarter of the square is a shift of the picture."""
    mask = {"fold": "swing", "mode": mode} | ({"color": 0xFFFFFF} if mode == "mix" else {})
    config = {"size": SIZE, "parameters": BLACK, "texture": texture, "mask": mask}
    still, moved = page.evaluate("config => page.frames(config, [0, 1])", config)["frames"]
    still, moved = decode(still["picture"]), decode(moved["picture"])
    assert np.abs(still[:, SIZE // 4 :] - moved[:, : -SIZE // 4]).max() <= 2 / 255
    assert np.ptp(still) > 0.5


def test_each_instance_moves(page: Any) -> None:
    config = {"texture": "atlas", "plane": [1, 1], "instances": ["holes", "flame", "cake", "thumb"]}
    (still, moved), _ = frames(page, [0.0, 1.0], mask={"fold": "swing", "instanced": True}, **config)
    half, shift = SIZE // 2, SIZE // 8
    for row in (slice(0, half), slice(half, SIZE)):
        for left in (0, half):
            before, after = still[row, left + shift : left + half], moved[row, left : left + half - shift]
            assert np.abs(before - after).max() <= 2 / 255


def test_at_a_thousandfold_the_edge_does_not_tremble(page: Any) -> None:
    """What the mesh's float32 uv lose is all that is lost: a few hundredths of a pixel."""
    duck, fold = vexture.convert(drawing("duck")), folds()["shore"]
    contours = [contour for path in drawing("duck").paths for contour in path.contours]
    shore = np.concatenate(contours)[3, 0]
    zoom, worst = 1000.0, []
    for seconds in (0.6, 1.9):
        point = shore.copy()
        for _ in range(60):
            point -= fold.at([point], seconds)[0][0] - shore
        matrix = np.array([[1 / zoom, 0, point[0] - 0.5 / zoom], [0, 1 / zoom, point[1] - 0.5 / zoom]])
        pictures, _ = frames(page, [seconds], mask={"fold": "shore", "transform": uv_view(matrix)})
        to_unit = np.vstack([matrix, [0, 0, 1]]) @ FIT
        found = errors(pictures[0], duck, fold, to_unit, seconds)
        assert len(found) > 20
        worst.append(np.percentile(found, 99))
    assert max(worst) <= 8.0  # 255 is a pixel
