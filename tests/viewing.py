"""Real `vexture view` processes, and what they tell their clients."""

import json
import re
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

SHAPES = Path(__file__).parents[1] / "examples" / "shapes"
VEXTURE = [sys.executable, "-c", "from vexture.cli.main import main; main(prog_name='vexture')"]
PATIENCE = 60.0  # seconds, for a machine with much else to do


class Viewing:
    """A running viewer."""

    def __init__(self, process, url, complaints):
        self.process, self.url, self.complaints = process, url, complaints

    def get(self, path, **options):
        return httpx.get(self.url + path, timeout=PATIENCE, **options)

    def manifest(self, name):
        return self.get(f"shapes/{name}").json()

    def post(self, name, content, **headers):
        return httpx.post(
            f"{self.url}convert", params={"name": name}, content=content, headers=headers, timeout=PATIENCE
        )

    @contextmanager
    def events(self):
        """Iterator of what clients are told: kind and data."""
        with httpx.stream("GET", f"{self.url}events", timeout=PATIENCE) as answer:
            yield parse_events(answer.iter_lines())

    def stop(self):
        """End it as a person does; return its exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE)


def parse_events(lines):
    kind = None
    for line in lines:
        if line.startswith("event:"):
            kind = line.partition(":")[2].strip()
        elif line.startswith("data:"):
            yield kind, json.loads(line.partition(":")[2])


@contextmanager
def viewing(folder, *arguments):
    """Run `vexture view` until the end of the block; `folder` is for what it says."""
    from vexture.base.errors import DeviceError
    from vexture.pages.page import SCRIPT, built

    try:
        built(SCRIPT)
    except DeviceError as error:
        pytest.skip(str(error))
    said = Path(folder) / "said"
    with said.open("w") as errors:
        command = [*VEXTURE, "view", *map(str, arguments), "--no-open"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True)
    try:
        line = process.stdout.readline()
        found = re.search(r"http://\S+/", line)
        assert found, said.read_text()
        yield Viewing(process, found[0], said)
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def until(check):
    """Wait until something is so."""
    end = time.monotonic() + PATIENCE
    while not (value := check()):
        assert time.monotonic() < end, "it never came"
        time.sleep(0.02)
    return value
