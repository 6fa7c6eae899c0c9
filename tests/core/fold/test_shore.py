"""Shores that slide: which way, how far, and that nothing turns over."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import vexture
from vexture.base.errors import ParameterError, SourceWarning
from vexture.cli.main import main
from vexture.drawing.drawing import Drawing
from vexture.fold.fold import Fold, Kind, fold_from
from vexture.fold.shore import STEEPEST, shore_fold

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"


def polygon(*corners: tuple[float, float]) -> Drawing:
    return Drawing.polygon(corners)


SLOPE = polygon((0, 0), (1, 0), (1, 0.3), (0, 0.7))
ISLAND = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)], [(0.4, 0.4), (0.4, 0.6), (0.6, 0.6), (0.6, 0.4)])
CHANNEL = polygon((0.49, 0), (0.51, 0), (0.51, 1), (0.49, 1))
DRY, SEA = Drawing(()), polygon((0, 0), (1, 0), (1, 1), (0, 1))


def quiet(drawing: Drawing, amplitude: float, size: int = 48) -> Fold:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return shore_fold(drawing, amplitude=amplitude, period=6.0, size=size)


def lengths(fold: Fold) -> np.ndarray:
    return np.hypot(fold.displacement[..., 0], fold.displacement[..., 1])


@pytest.mark.parametrize("drawing", [DRY, SEA])
def test_without_a_shore_nothing_moves(drawing: Drawing) -> None:
    assert lengths(quiet(drawing, 0.02)).max() < 1e-6


def test_a_shore_moves_along_its_normal_and_most_at_the_shore() -> None:
    fold = quiet(SLOPE, 0.01)
    shore = [(0.3, 0.58), (0.5, 0.5), (0.7, 0.42)]
    now = np.array([fold.at([point], second)[0][0] - point for point in shore for second in np.arange(0, 6, 0.25)])
    swing = np.hypot(*now.reshape(3, -1, 2).transpose(2, 0, 1)).max(axis=1)
    assert (swing > 0.009).all()
    assert (swing < 0.0101).all()
    normal = np.array([0.4, 1.0]) / np.hypot(0.4, 1.0)
    assert np.abs(now @ (-normal[1], normal[0])).max() < 0.03 * swing.max()
    assert lengths(fold)[24, 24] > 5 * lengths(fold)[4, 24]


def test_the_direction_is_towards_the_water() -> None:
    assert quiet(SLOPE, 0.01).displacement[24, 24, 1] < 0.0


def test_waves_do_not_move_in_lockstep() -> None:
    fold = quiet(SLOPE, 0.005)
    begins = fold.begin[lengths(fold) > 0.004] / 6.0 * 2.0 * np.pi
    assert abs(np.exp(1j * begins).mean()) < 0.98
    assert (fold.kind == Kind.PERIODIC).all()
    assert fold.cycle == 6.0


def test_an_island_moves_all_around_and_a_channel_less() -> None:
    island = quiet(ISLAND, 0.01)
    for side in ((0.4, 0.5), (0.6, 0.5), (0.5, 0.4), (0.5, 0.6)):
        places = [island.at([side], second)[0][0] - side for second in np.arange(0, 6, 0.25)]
        assert np.hypot(*np.transpose(places)).max() > 0.007
    assert lengths(quiet(CHANNEL, 0.01)).max() < 0.011


@pytest.mark.parametrize("amplitude", [0.003, 0.02, 0.25])
@pytest.mark.parametrize("drawing", [SLOPE, ISLAND, CHANNEL, DRY])
def test_the_square_is_mapped_to_itself(drawing: Drawing, amplitude: float) -> None:
    fold = quiet(drawing, amplitude)
    line = np.linspace(0.0, 1.0, 101)
    border = np.concatenate([np.stack([line, edge + 0 * line], axis=1)[:, ::way] for edge in (0, 1) for way in (1, -1)])
    assert np.abs(fold.at(border, 1.7)[0] - border).max() < 1e-7
    inner = fold.at(np.random.default_rng(1).uniform(0.0, 1.0, (4000, 2)), 1.7)[0]
    assert inner.min() >= 0.0
    assert inner.max() <= 1.0


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**32), st.floats(0.001, 0.25), st.integers(8, 64))
def test_no_two_places_become_one(seed: int, amplitude: float, size: int) -> None:
    rng = np.random.default_rng(seed)
    fold = quiet(Drawing.polygon(*(rng.uniform(0.0, 1.0, (4, 2)).tolist() for _ in range(3))), amplitude, size)
    points = rng.uniform(0.0, 1.0, (3000, 2))
    near = points + rng.normal(0.0, 0.02, points.shape)
    for seconds in rng.uniform(0.0, 6.0, 4):
        places, jacobians = fold.at(points, seconds)
        slopes = np.linalg.norm(jacobians - np.eye(2), ord=2, axis=(1, 2))
        assert slopes.max() <= STEEPEST * 1.001
        apart, before = fold.at(near, seconds)[0] - places, near - points
        assert (np.hypot(*apart.T) >= 0.499 * np.hypot(*before.T)).all()


def test_what_would_turn_over_moves_less_and_says_so() -> None:
    with pytest.warns(SourceWarning, match=r"amplitude 0\.2 would turn the shore over; it is 0\.0"):
        shore_fold(SLOPE, amplitude=0.2, period=6.0, reach=0.05)


@pytest.mark.parametrize(
    "wrong", [{"amplitude": 0.0}, {"amplitude": np.nan}, {"period": 0.0}, {"period": 1e5}, {"size": 7}, {"reach": 2.0}]
)
def test_parameters_out_of_range_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=next(iter(wrong))):
        shore_fold(SLOPE, **{"amplitude": 0.01, "period": 6.0, **wrong})  # type: ignore[arg-type]


def test_the_command_writes_a_fold_and_its_picture(tmp_path: Path) -> None:
    output, picture = tmp_path / "o.fold.ktx2", tmp_path / "o.png"
    source = str(SHAPES / "ocean.svg")
    done = CliRunner().invoke(
        main, ["fold", source, "-o", str(output), "--amplitude", "0.01", "--period", "5", "--picture", str(picture)]
    )
    assert done.exit_code == 0, done.output
    assert "64 x 64 texels" in done.output
    expected = shore_fold(vexture.read_svg(source), amplitude=0.01, period=5.0)
    assert fold_from(output.read_bytes()).to_ktx2() == expected.to_ktx2()
    with Image.open(picture) as image:
        assert image.size == (1152, 768)
    into = CliRunner().invoke(main, ["fold", source, "-o", str(tmp_path)])
    assert (tmp_path / "ocean.fold.ktx2").is_file(), into.output
    for wrong in (["--size", "3"], ["--picture", "o.jpg"], ["--amplitude", "nan"]):
        failed = CliRunner().invoke(main, ["fold", source, "-o", str(output), *wrong])
        assert failed.exit_code == 1
        assert failed.output.count("\n") == 1
