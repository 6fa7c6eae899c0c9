"""The command `view`: how it starts, what it reports, and how it ends."""

import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import httpx
import pytest

from viewing import PATIENCE, SHAPES, VEXTURE, until, viewing

DUCK = (SHAPES / "duck.svg").read_bytes()


@pytest.fixture(scope="module")
def view(tmp_path_factory):
    with viewing(tmp_path_factory.mktemp("view"), SHAPES / "duck.svg") as running:
        yield running


def test_port_that_is_taken_is_one_line(view):
    port = httpx.URL(view.url).port
    command = [*VEXTURE, "view", str(SHAPES / "duck.svg"), "--no-open", "--port", str(port)]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    assert outcome.returncode == 1
    assert outcome.stdout == ""
    assert len(outcome.stderr.splitlines()) == 1
    assert str(port) in outcome.stderr
    assert "--port" in outcome.stderr


def test_ctrl_c_ends_it_without_a_traceback_though_clients_listen(tmp_path):
    with viewing(tmp_path, SHAPES / "duck.svg") as running, running.events() as events:
        assert next(events)[0] == "hello"
        assert running.stop() == 0
        assert running.complaints.read_text() == ""


def children(process):
    """Processes that a process has started, and those that these have."""
    own = [int(word) for word in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    return [*own, *(child for one in own for child in children(one))]


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize("number", [signal.SIGTERM, pytest.param(signal.SIGINT, marks=pytest.mark.slow)])
def test_it_ends_while_a_dropped_file_is_converted(tmp_path, number):
    """The file was converted in the server itself, without limits, which then waited for it: for minutes."""
    lines = "".join(f"M{997 * line // 1500} 0L{7919 * line % 997} 999" for line in range(1500))
    slow = f'<svg viewBox="0 0 999 999"><path stroke="red" d="{lines}"/></svg>'
    with viewing(tmp_path, SHAPES / "duck.svg") as running:
        assert running.post("quick.svg", DUCK).status_code == 201  # so the process has started
        with ThreadPoolExecutor() as pool:
            dropped = pool.submit(running.post, "slow.svg", slow)
            begun = until(lambda: children(running.process.pid))
            running.process.send_signal(number)
            assert running.process.wait(PATIENCE) == 0
            with suppress(httpx.HTTPError):
                assert dropped.result().status_code == 503
        until(lambda: not any(Path(f"/proc/{process}").exists() for process in begun))
        assert running.complaints.read_text() == ""


def test_file_that_is_no_drawing_does_not_hide_the_others(tmp_path):
    broken = tmp_path / "broken.svg"
    broken.write_text("<svg")
    with viewing(tmp_path, broken, SHAPES / "duck.svg") as running:
        assert running.get("shapes").json()["shapes"] == ["duck"]
        assert str(broken) in running.complaints.read_text()


def test_warnings_are_facts(tmp_path):
    drawing = tmp_path / "label.svg"
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><g opacity="0.5"><path d="M1 1h5v5z"/>'
        '<path d="M1 1h5v5z"/></g><foreignObject/></svg>'
    )
    with viewing(tmp_path, drawing) as running:
        (warning,) = running.manifest("label")["facts"]["warnings"]
        assert warning.endswith("label.svg: left out: <foreignObject>")
        assert warning in running.complaints.read_text()
