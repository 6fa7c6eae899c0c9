"""No conversion runs without end: what takes too long ends in an error that names the limit."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import vexture
from vexture import Drawing, LimitError, ParameterError
from vexture.base.deadline import within
from vexture.cli.main import main
from vexture.conversion.images import _conversion

SQUARE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h7v7h-7z"/></svg>'
TOO_LONG = "takes longer than 1e-09 s; simplify the drawing or raise "


def scribble(sides: int) -> Drawing:
    """A polygon whose sides cross one another all over the unit square."""
    return Drawing.polygon(map(tuple, np.random.default_rng(1).random((sides, 2)).tolist()))


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "square.svg"
    path.write_text(SQUARE)
    return path


def test_every_entry_has_the_limit(file: Path) -> None:
    with pytest.raises(LimitError, match=f"^{file}: converting {TOO_LONG}`max_seconds`$"):
        vexture.convert(file, max_seconds=1e-9)
    with pytest.raises(LimitError, match=f"^{file}: converting {TOO_LONG}`max_seconds`$"):
        vexture.convert(file, max_seconds=1e-9, encoding="thesis")
    with pytest.raises(LimitError, match=TOO_LONG):
        vexture.atlas([scribble(5)], max_seconds=1e-9)
    outcome = CliRunner().invoke(main, ["convert", str(file), "-o", str(file.parent), "--max-seconds", "1e-9"])
    assert outcome.exit_code == 1
    assert outcome.stderr == f"vexture: {file}: converting {TOO_LONG}--max-seconds\n"
    assert list(file.parent.iterdir()) == [file]


@pytest.mark.parametrize("render", [vexture.render, vexture.coverage])
def test_the_exact_renderer_looks_at_the_clock(render: Callable[..., object]) -> None:
    drawing = replace(scribble(5), name="scribble")
    said = (
        r"^scribble: the exact renderer takes longer than 1e-09 s; use another `renderer`, .* or raise `max_seconds`$"
    )
    with within(1e-9), pytest.raises(LimitError, match=said):
        render(drawing, 8, renderer="exact")


def test_a_picture_has_the_time_of_the_work_around() -> None:
    with within(900.0):
        assert _conversion(None)["max_seconds"] == 900.0
    with within(1e-9), pytest.raises(LimitError, match=TOO_LONG):
        vexture.render(scribble(5), 8)


@pytest.mark.parametrize("renderer", ["cpu", "exact"])
def test_render_has_the_limit(file: Path, renderer: str) -> None:
    given = ["render", str(file), "-o", str(file.with_suffix(".png")), "--renderer", renderer, "--size", "8"]
    outcome = CliRunner().invoke(main, [*given, "--max-seconds", "1e-9"])
    assert (outcome.exit_code, outcome.stderr.endswith(" raise --max-seconds\n")) == (1, True)
    assert list(file.parent.iterdir()) == [file]
    assert CliRunner().invoke(main, [*given, "--max-seconds", "inf"]).exit_code == 0


def test_the_limit_holds_for_its_own_conversion_only(file: Path) -> None:
    with pytest.raises(LimitError):
        vexture.convert(file, max_seconds=1e-9)
    assert len(vexture.convert(file, max_seconds=math.inf).roots) == 1


@pytest.mark.parametrize("seconds", [0, -1.0, math.nan, True, "5"])
def test_a_limit_is_a_number_of_seconds(file: Path, seconds: object) -> None:
    with pytest.raises(ParameterError, match=r"`max_seconds` .* is no number above 0; the default is 300"):
        vexture.convert(file, max_seconds=seconds)  # type: ignore[arg-type]
