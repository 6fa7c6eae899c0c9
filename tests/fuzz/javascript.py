"""The loaders of web/src, in a process of Node.js that answers file by file."""

import atexit
import json
import select
import shutil
import struct
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

NODE = shutil.which("node") if (Path(__file__).parents[2] / "web" / "node_modules" / "three").exists() else None
"""None where Node.js or the packages of web/ are missing."""

LONGEST = 20.0
"""Seconds without an answer after which the loader is said to hang."""

MEMORY = "--max-old-space-size=512"


class Loader:
    """A process that reads files of one kind: packed, fold or thesis."""

    def __init__(self, kind: str) -> None:
        script = Path(__file__).with_name("reader.mjs")
        command = [str(NODE), MEMORY, str(script), kind]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        atexit.register(self.end)

    def answer(self, data: bytes) -> dict[str, Any]:
        """What the loader says about a file; a dead or silent process is its fault, and is ended."""
        stdin, stdout = self.process.stdin, self.process.stdout
        try:
            stdin.write(struct.pack("<I", len(data)) + data)
            stdin.flush()
            ready, _, _ = select.select([stdout], [], [], LONGEST)
            line = stdout.readline() if ready else b""
        except BrokenPipeError:
            ready, line = [stdout], b""
        if line:
            return json.loads(line)
        loader.cache_clear()
        if ready:  # its output is closed, so it ends by itself
            self.process.wait()
        self.end()
        return {
            "fault": f"Node.js ended with the code {self.process.returncode}"
            if ready
            else f"no answer in {LONGEST:g} s"
        }

    def end(self) -> None:
        """End the process, if it has not ended."""
        with self.process:
            self.process.kill()


@cache
def loader(kind: str) -> Loader:
    """The process for a kind, started when it is first needed."""
    return Loader(kind)
