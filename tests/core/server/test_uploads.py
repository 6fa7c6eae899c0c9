"""Uploads as a server takes and refuses them."""

from contextlib import ExitStack, closing

import pytest
from server import TOKEN, serving, square

from vexture.server.limits import Limits


def test_without_a_token_file_nothing_is_written(tmp_path):
    with serving(tmp_path / "shapes", token=False) as server:
        status, refused = server.put("square", square())
        assert (status, "--token-file" in refused["error"]) == (403, True)


@pytest.mark.slow
def test_haste_is_refused_until_later(tmp_path):
    with serving(tmp_path / "shapes", "--rate", 0.01) as server:
        answers = [server.ask("PUT", "/shapes/a", b"", {"Authorization": f"Bearer {TOKEN}"}) for _ in range(21)]
        assert [status for status, _, _ in answers] == [422] * 20 + [429]
        assert 0 < int(answers[-1][1]["Retry-After"]) <= 100


@pytest.mark.slow
def test_slow_uploads_keep_nobody_waiting(tmp_path):
    """More of them than may be converted at once; with the quick one they are as many as may come at once."""
    limits = Limits()
    slow_ones = limits.burst - 1
    assert slow_ones > limits.conversions
    with serving(tmp_path / "shapes", "--rate", 1000) as server, ExitStack() as opened:
        for number in range(slow_ones):
            connection = opened.enter_context(closing(server.connect()))
            connection.putrequest("PUT", f"/shapes/slow{number}")
            connection.putheader("Authorization", f"Bearer {TOKEN}")
            connection.putheader("Content-Length", "1000")
            connection.endheaders(b"<svg")
        assert server.put("quick", square())[0] == 201
