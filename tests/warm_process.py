"""`vexture` as a program that starts at once: a fork of a process that has imported it and loaded its kernels.

A new process of Python takes a second of a processor for these, which is more than most commands take. Run as a script,
this module is that process, until its standard input ends, or its client. Commands in a process of their own from the
start are covered by their tests of pipes, signals and servers.
"""

import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
from contextlib import suppress
from functools import cache
from importlib import import_module
from pathlib import Path

MOST_WORDS = 1 << 20
"""Bytes of a command with its environment."""

MOST_DESCRIPTORS = 8

PIPE = "/dev/fd/"
"""How shells name the pipe of `<(program)`."""

LIBRARIES = ("pyogrio", "pyproj", "rasterio", "scipy.ndimage", "shapely", "xarray")
"""Libraries that commands import for maps and floods, each in a second."""

DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><circle cx="4" cy="4" r="3" fill="red"/></svg>'


@cache
def command() -> tuple[str, ...]:
    """Words that run `vexture`, in shells too; a process of tests starts one warm process for all its commands."""
    folder = tempfile.mkdtemp(prefix="vexture-warm-")
    address = os.path.join(folder, "socket")
    process = subprocess.Popen(
        [sys.executable, __file__, "serve", address], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    _started.append(process)  # its standard input ends with this process
    return (sys.executable, "-I", "-S", __file__, "ask", address)


_started: list["subprocess.Popen[str]"] = []


def serve(address: str) -> None:
    """Import what commands need, and fork for each request."""
    from vexture.cli.main import main
    from vexture.server.publish_file import load_kernels

    load_kernels()  # here, since commands convert in processes of their own
    for library in LIBRARIES:
        with suppress(ImportError):  # tests that need it are skipped
            import_module(library)
    with tempfile.TemporaryDirectory() as folder:
        drawing, texture, picture = (str(Path(folder, name)) for name in ("a.svg", "a.ktx2", "a.png"))
        Path(drawing).write_text(DRAWING)
        for words in (["convert", drawing, "-q", "-o", texture], ["render", texture, "-o", picture, "--size", "9"]):
            main(words, standalone_mode=False)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(address)
        listening.listen()
        print("ready", flush=True)
        while listening in select.select([listening, sys.stdin], [], [])[0]:
            connection, _ = listening.accept()
            if os.fork() == 0:
                listening.close()
                answer(connection)
                os._exit(0)
            connection.close()
    os.unlink(address)
    os.rmdir(os.path.dirname(address))


def answer(connection: socket.socket) -> None:
    """Run a command in a process of its own, and send its exit status."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    message, descriptors, _, _ = socket.recv_fds(connection, MOST_WORDS, MOST_DESCRIPTORS)
    request = json.loads(message)
    process = os.fork()
    if process == 0:
        from vexture.cli.main import main

        connection.close()
        for place, descriptor in zip(request["descriptors"], descriptors, strict=True):
            os.dup2(descriptor, place)
            os.close(descriptor)
        os.chdir(request["folder"])
        os.environ.clear()
        os.environ.update(request["environment"])
        main(request["words"], prog_name="vexture")
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    connection.sendall(f"{status}".encode())


def ask(address: str, *words: str) -> None:
    """Run a command with the streams, the folder and the environment of this process, and end as it does."""
    descriptors = [0, 1, 2, *(int(word.removeprefix(PIPE)) for word in words if word.startswith(PIPE))]
    message = json.dumps(
        {"words": words, "folder": os.getcwd(), "environment": dict(os.environ), "descriptors": descriptors}
    )
    with socket.socket(socket.AF_UNIX) as connection:
        connection.connect(address)
        socket.send_fds(connection, [message.encode()], descriptors)
        status = int(connection.recv(16))
    sys.exit(status if status >= 0 else 128 - status)


if __name__ == "__main__":
    {"serve": serve, "ask": ask}[sys.argv[1]](*sys.argv[2:])
