"""Runs that models write while `vexture flood --follow` shows them."""

import json
import re
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

from floods import FloodServer
from server import COMMAND, serving


class Model:
    """A running `model.py`."""

    def __init__(self, path):
        program = [sys.executable, str(Path(__file__).with_name("model.py")), str(path)]
        self.process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def does(self, *lines):
        for line in lines:
            print(line, file=self.process.stdin, flush=True)
            assert self.process.stdout.readline().strip() == line


@contextmanager
def writing(path):
    one = Model(path)
    try:
        yield one
    finally:
        with one.process:
            one.process.kill()


class Follower(FloodServer):
    """A running `vexture flood --follow FILE --serve`, which may have nothing to show yet."""

    def __init__(self, path, *options, token=False):
        given = ["--token-file", str(path.parent / "token")] if token else []
        program = [*COMMAND, "flood", "--follow", str(path), "--serve", "--port", "0", *map(str, options), *given]
        self.process = subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def shows(self):
        """Wait for the first step."""
        self.said = self.process.stdout.readline()
        self.url = re.search(r"http://\S+/", self.said)[0]
        self.port = int(self.url.rpartition(":")[2].strip("/"))
        return self.said

    @property
    def steps(self):
        return json.loads(self.ask("GET", "/shapes")[2])["shapes"]

    def labels(self):
        return [self.manifest(name)["facts"]["label"] for name in self.steps]


def following(path, *options, token=False):
    return serving(path, *options, token=token, kind=Follower)
