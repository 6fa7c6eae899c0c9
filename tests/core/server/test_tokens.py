"""Wrong tokens, one by one and many: they are slowed down, and who has the right one is not."""

import re
from pathlib import Path

import pytest
from server import TOKEN, serving, square

import vexture
from vexture.server.limits import MOST_KNOWN
from vexture.server.tokens import WrongTokens


@pytest.mark.slow
def test_wrong_tokens_are_slowed_down_and_the_right_one_is_not(tmp_path):
    with serving(tmp_path / "shapes") as server:
        answers = [server.put("a", square(), token=f"{TOKEN}{number}") for number in range(8)]
        assert [status for status, _ in answers] == [401] * 5 + [429] * 3
        assert "the token is wrong, as others were before it; wait " in answers[-1][1]["error"]
        assert server.put("a", square())[0] == 201
        status, headers, _ = server.ask("PUT", "/shapes/a", square(), {"Authorization": "Bearer no"})
        assert (status, int(headers["Retry-After"]) > 0) == (429, True)
        assert server.ask("PUT", "/shapes/a", square())[0] == 401, "it tries none"


def test_wrong_tokens_are_counted_by_address_and_together():
    now = [1000.0]
    wrong = WrongTokens(clock=lambda: now[0])
    assert [bool(wrong.wait("a")) for _ in range(7)] == [False] * 5 + [True] * 2
    assert not wrong.wait("b"), "another address"
    many = [bool(wrong.wait(f"{number}")) for number in range(100)]
    assert many == [False] * 92 + [True] * 8, "from many addresses together"
    now[0] += 60.0
    assert not wrong.wait("a"), "and later again"


def test_few_addresses_are_remembered():
    wrong = WrongTokens(clock=lambda: 0.0)
    for number in range(2 * MOST_KNOWN):
        wrong.wait(f"{number}")
    assert len(wrong._each._buckets) == MOST_KNOWN


def test_a_clock_that_jumps_back_or_ahead_gives_no_attempts(monkeypatch):
    """The time of day is not looked at."""
    wrong = WrongTokens()
    answers = []
    for jump in (0.0, 1e9, -1e9, 1e12, 0.0, 1e9, -1e9):
        monkeypatch.setattr("time.time", lambda jump=jump: 1.7e9 + jump)
        answers.append(bool(wrong.wait("a")))
    assert answers == [False] * 5 + [True] * 2


def test_only_the_age_of_a_file_that_was_left_is_told_by_the_time_of_day():
    """All durations are of a clock that nobody sets."""
    source = Path(vexture.__file__).parent
    telling = [
        path.name for path in source.rglob("*.py") if re.search(r"\btime\.time\(|\.now\(|utcnow", path.read_text())
    ]
    assert telling == ["files.py"]
