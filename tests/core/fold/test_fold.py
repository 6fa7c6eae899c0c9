"""Folds as arrays, functions and files."""

import json
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vexture.base.errors import FormatError, ParameterError
from vexture.fold.fold import Fold, Kind, fold_from
from vexture.fold.layout import FOLD_FILE_LIMIT, FOLD_MOST_SIDE, TEXT_FOLD
from vexture.texture.ktx2 import read_ktx2, write_ktx2


@st.composite
def folds(draw: st.DrawFn) -> Fold:
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    shape = draw(st.integers(1, 9)), draw(st.integers(1, 9))
    cycle = draw(st.sampled_from([0.0, 0.25, 6.0, 8191.0]))
    most = cycle or 20.0
    begin, duration = rng.uniform(0.0, 0.99 * most, shape), rng.uniform(0.01 * most, most, shape)
    return Fold(rng.uniform(-0.2, 0.2, (*shape, 2)), rng.integers(0, 5, shape), begin, duration, cycle)


@given(folds())
def test_a_file_brings_back_what_was_written(fold: Fold) -> None:
    data = fold.to_ktx2()
    back = fold_from(data)
    for name in ("displacement", "kind", "begin", "duration"):
        assert np.array_equal(getattr(back, name), getattr(fold, name))
    assert back.cycle == fold.cycle
    assert back.to_ktx2() == data


@given(folds(), st.floats(-30.0, 30.0), st.sampled_from(["none", "repeat"]), st.integers(0, 2**32))
def test_the_jacobian_is_what_differences_say(fold: Fold, seconds: float, wrap: str, seed: int) -> None:
    points = np.random.default_rng(seed).uniform(-0.5, 1.5, (20, 2))
    step = 1e-6
    _, jacobians = fold.at(points, seconds, wrap=wrap)
    for axis in range(2):
        way = step * np.eye(2)[axis]
        beyond, before = (fold.at(points + sign * way, seconds, wrap=wrap)[0] for sign in (1, -1))
        assert np.allclose((beyond - before) / (2.0 * step), jacobians[:, :, axis], atol=2e-4)


@given(folds(), st.floats(-1e5, 1e5))
def test_progress_keeps_to_its_range(fold: Fold, seconds: float) -> None:
    progress = fold.progress(seconds)
    assert (np.abs(progress) <= 1.0).all()
    assert (progress[fold.kind != Kind.PERIODIC] >= 0.0).all()


def progress_of(kind: Kind, times: Any, begin: float = 0.0, duration: float = 2.0, cycle: float = 0.0) -> list[float]:
    fold = Fold(np.zeros((1, 1, 2)), kind, begin, duration, cycle)  # type: ignore[arg-type]
    return [float(fold.progress(time)[0, 0]) for time in times]


def test_kinds_are_what_their_names_say() -> None:
    times = [-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 9.0]
    assert progress_of(Kind.LINEAR, times) == [0, 0, 0.25, 0.5, 0.75, 1, 1]
    assert progress_of(Kind.SMOOTH_START, times) == [0, 0, 0.0625, 0.25, 0.5625, 1, 1]
    assert progress_of(Kind.SMOOTH_END, times) == [0, 0, 0.4375, 0.75, 0.9375, 1, 1]
    assert progress_of(Kind.SMOOTH_BOTH, times) == [0, 0, 0.15625, 0.5, 0.84375, 1, 1]
    assert np.allclose(progress_of(Kind.PERIODIC, times), [0, 0, 1, 0, -1, 0, 0])
    assert progress_of(Kind.PERIODIC, [2.0, 3.5], begin=3.0) == [0.0, 1.0]


def test_a_cycle_begins_anew() -> None:
    assert progress_of(Kind.LINEAR, [0.0, 1.0, 2.0, 3.5, 4.0, 5.0], cycle=4.0) == [0, 0.5, 1, 1, 0, 0.5]
    assert progress_of(Kind.LINEAR, [1.0, 3.0, 0.0], begin=3.0, cycle=4.0) == [1, 0, 0.5]
    times = np.linspace(0.0, 12.0, 1201)
    waves = progress_of(Kind.PERIODIC, times, begin=1.5, duration=2.0, cycle=4.0)
    assert np.abs(np.diff(waves)).max() < 0.04
    assert np.allclose(waves, np.sin(np.pi * (times - 1.5)))


def test_rows_are_from_the_top() -> None:
    top = Fold([[[0.0, 0.1]], [[0.0, 0.0]]], duration=1.0)  # type: ignore[arg-type]
    up, down = top.at([(0.5, 1.0), (0.5, 0.0)], 5.0)[0][:, 1]
    assert up == pytest.approx(1.1)
    assert down == pytest.approx(0.0)


def test_a_repeated_fold_has_no_seam() -> None:
    fold = Fold(np.random.default_rng(1).uniform(-0.1, 0.1, (4, 5, 2)))
    points = np.array([(0.0, 0.3), (0.7, 1.0), (0.2, 0.9)])
    here, around = fold.at(points, 2.0, wrap="repeat"), fold.at(points + np.array([-3, 4]), 2.0, wrap="repeat")
    assert np.allclose(here[0], around[0] - (-3, 4))
    assert np.allclose(here[1], around[1])
    left, right = fold.at([(-1e-9, 0.5), (1e-9, 0.5)], 2.0, wrap="repeat")[0]
    assert np.allclose(left, right, atol=1e-7)


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"displacement": np.zeros((2, 3))}, "(rows, columns, 2)"),
        ({"displacement": np.zeros((0, 3, 2))}, "1 to 256"),
        ({"displacement": np.zeros((1, FOLD_MOST_SIDE + 1, 2))}, "1 to 256"),
        ({"displacement": np.full((2, 2, 2), np.nan)}, "displacement"),
        ({"displacement": np.full((2, 2, 2), -1.5)}, "displacement"),
        ({"displacement": np.full((2, 2, 2), 1e300)}, "displacement"),
        ({"kind": 5}, "kind is 5"),
        ({"kind": 0.5}, "kind is 0.5"),
        ({"begin": -1.0}, "begin"),
        ({"begin": np.inf}, "begin"),
        ({"duration": 0.0}, "duration"),
        ({"duration": 1e4}, "duration"),
        ({"cycle": np.nan}, "cycle"),
        ({"cycle": 0.5}, "in a cycle of 0.5"),
        ({"cycle": 4.0, "begin": 4.0}, "begin must be less"),
        ({"begin": [1.0, 2.0, 3.0]}, "one number each"),
    ],
)
def test_what_no_fold_can_be_is_refused(changes: dict[str, Any], part: str) -> None:
    with pytest.raises(ParameterError) as error:
        Fold(**{"displacement": np.zeros((2, 2, 2)), **changes})
    assert part in str(error.value)
    assert "\n" not in str(error.value)


def changed(texel: int = 0, word: int = 0, value: int = 0, **texts: str) -> bytes:
    texels, own = read_ktx2(Fold(np.full((3, 3, 2), 0.1), Kind.PERIODIC, cycle=4.0).to_ktx2(), "fold")
    texels = texels.copy()
    if texel >= 0:
        texels.reshape(-1, 4)[texel, word] = value
    return write_ktx2(texels, own | {f"vexture.{key}": text for key, text in texts.items()})


FACTS = {"columns": 3, "rows": 3, "cycle": 4}


@pytest.mark.parametrize(
    ("data", "part"),
    [
        (changed(-1, encoding="packed"), "vexture.encoding"),
        (changed(-1, version="2"), "vexture.version"),
        (changed(-1, fold="{"), "JSON"),
        (changed(-1, fold="[3]"), "object"),
        (changed(-1, fold=json.dumps(FACTS | {"columns": 2.5})), "columns is 2.5"),
        (changed(-1, fold=json.dumps(FACTS | {"rows": 10**30})), "rows"),
        (changed(-1, fold=json.dumps(FACTS | {"rows": True})), "rows"),
        (changed(-1, fold=json.dumps(FACTS | {"cycle": float("nan")})), "cycle"),
        (changed(-1, fold=json.dumps(FACTS | {"rows": 99})), "texels for 3 x 99"),
        (changed(-1, fold=json.dumps(FACTS | {"cycle": 0.5})), "cycle of 0.5"),
        (changed(2, 1, 0x7FC00000), "displacement"),
        (changed(2, 0, 0x7F800000), "displacement"),
        (changed(2, 0, 0x3F800001), "displacement"),
        (changed(3, 2, 5 << 29), "kind"),
        (changed(3, 3, 0), "duration"),
        (changed(3, 3, 0xFFFFFFFF), "duration"),
        (changed(3, 2, 5 * 65536), "begin"),
        (changed(15, 0, 1), "texel 15 is beyond"),
        (bytes(FOLD_FILE_LIMIT + 1), "longer than"),
        (b"", "it is empty"),
    ],
)
def test_a_strangers_file_is_checked(data: bytes, part: str) -> None:
    with pytest.raises(FormatError) as error:
        fold_from(data, "theirs")
    assert part in str(error.value)
    assert str(error.value).startswith("theirs: ")
    assert "\n" not in str(error.value)
    assert fold_from(changed(-1)).cycle == 4.0


@given(st.binary(max_size=40), st.integers(0, 400))
def test_damage_is_an_error_of_ours_or_a_fold(noise: bytes, at: int) -> None:
    whole = changed(-1)
    at = min(at, len(whole))
    with suppress(FormatError):  # nothing else
        found = fold_from(whole[:at] + noise + whole[at + len(noise) :])
        content = found.to_ktx2()
        assert fold_from(content).to_ktx2() == content


def test_the_example_of_the_format() -> None:
    texels, texts = read_ktx2(Fold([[[0.25, -0.5]]], Kind.PERIODIC, 1.5, 4.0, 8.0).to_ktx2(), "fold")  # type: ignore[arg-type]
    assert [f"{word:08x}" for word in texels[0, 0]] == ["3e800000", "bf000000", "80018000", "00040000"]
    assert texts[TEXT_FOLD] == '{"columns":1,"rows":1,"cycle":8}'
