"""The guides in docs/ as blocks of text, which tests write, run and compare; and the site around them."""

import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import venv
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from warm_process import command

ROOT = Path(__file__).parents[1]
GUIDES = ROOT / "docs" / "guides"

FENCE = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.M | re.S)
HEADING = re.compile(r"^## (.+)$", re.M)

STAYS = "# until Ctrl-C"
"""Ends a command that goes on in the background."""

STAYING = "vexture-that-stays"
"""Program that is `vexture` in a process of its own, which can be told to end."""

MEASURED = re.compile(r"[\d.,]+ (ms|bytes)\b|version \w+")
"""What differs from machine to machine."""

OFFLINE = re.compile(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT|Temporary failure in name resolution")


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block: its language, the file that it is, its text, the section and the place it stands in."""

    language: str
    title: str | None
    text: str
    section: str
    place: str


def blocks_of(guide: str) -> list[Block]:
    """Blocks of a guide by its name, in order."""
    path = GUIDES / f"{guide}.md"
    text = path.read_text(encoding="utf-8")
    found = []
    for match in FENCE.finditer(text):
        sections = [heading[1] for heading in HEADING.finditer(text, 0, match.start())]
        line = text.count("\n", 0, match.start()) + 1
        found.append(Block(match[1], match[2], match[3], sections[-1] if sections else "", f"{path.name}:{line}"))
    assert text.count("\n```") == 2 * len(found), f"{path.name} has a fence that is none of the known kinds"
    return found


def build_site(folder: Path, target: Path) -> subprocess.CompletedProcess[str]:
    """Build the documentation of a working tree."""
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(target)]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}  # an advertisement
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def alike(output: str) -> str:
    """Remove from an output what differs between machines."""
    return MEASURED.sub("-", output).strip()


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
        return port


@dataclass
class Reader:
    """Someone who does what a guide says, in a folder: shell, files and Python; the rest is up to the test.

    Ports that the guide names become free ones, so that several may read at once. What the guide installs with pip goes
    into an environment that is thrown away, without what it needs; `vexture` is that of this working tree.
    """

    folder: Path
    ports: dict[str, int] = field(default_factory=dict)
    said: str = ""
    names: dict[str, Any] = field(default_factory=dict)
    started: list[subprocess.Popen[str]] = field(default_factory=list)

    def __enter__(self) -> Self:
        programs = self.folder.parent / "programs"
        programs.mkdir()
        venv.create(self.folder.parent / "throwaway")
        python = shlex.quote(sys.executable)
        pip = f"{python} -m pip --python {shlex.quote(str(self.folder.parent / 'throwaway' / 'bin' / 'python'))}"
        for name, text in (
            ("vexture", f'exec {shlex.join(command())} "$@"'),
            (STAYING, f"exec {python} -c 'from vexture.cli.main import main; main()' \"$@\""),
            ("python3", f'if [ "${{2-}}" = pip ]; then shift 2; exec {pip} "$@"; fi\nexec {python} "$@"'),
        ):
            (programs / name).write_text(f"#!/bin/sh\n{text}\n")
            (programs / name).chmod(0o755)
        self.environment = {
            **os.environ,
            "PATH": f"{programs}:{os.environ['PATH']}",
            "PYTHONPATH": os.pathsep.join(str(ROOT / "packages" / name / "src") for name in ("vexture", "vexture-geo")),
            "PIP_DISABLE_PIP_VERSION_CHECK": "1",
            "PIP_NO_DEPS": "1",
            "npm_config_audit": "false",
            "npm_config_fund": "false",
            "npm_config_prefer_offline": "true",
            "npm_config_update_notifier": "false",
        }
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for process in self.started:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGTERM)
            process.communicate(timeout=60)

    def replace_ports(self, text: str) -> str:
        """Replace ports in a text by free ones."""
        for port, free in self.ports.items():
            text = re.sub(rf"(?<=[: ]){port}\b", str(free), text)
        return text

    def take(self, block: Block) -> None:
        """Do what a block says, if it is one that needs no more than a folder."""
        if block.title:
            path = self.folder / block.title
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.replace_ports(block.text), encoding="utf-8")
        elif block.language == "sh":
            self._shell(block)
        elif block.language == "python":
            with self._capture_output() as said:
                exec(compile(block.text, block.place, "exec"), self.names)  # the guide's own words are what is tested
            self.said = "".join(said)
        elif block.language == "text":
            assert alike(self.said) == alike(block.text), f"{block.place}: {self.said}"
        else:
            raise AssertionError(f"{block.place}: nothing is done with {block.language}")

    def _shell(self, block: Block) -> None:
        *before, last = block.text.replace("\\\n", " ").rstrip().splitlines()
        stays = last.endswith(STAYS)
        self._run(block, "\n".join(before if stays else [*before, last]))
        if stays:
            process = subprocess.Popen(
                ["bash", "-c", f"exec {re.sub('^vexture(?= )', STAYING, self.replace_ports(last))}"],
                cwd=self.folder,
                env=self.environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                stdin=subprocess.PIPE,
                text=True,
                start_new_session=True,
            )
            self.started.append(process)
            assert process.stdout is not None
            self.said = process.stdout.readline().strip() or process.stdout.readline()
            assert self.said, f"{block.place}: it ended"

    def _run(self, block: Block, commands: str) -> None:
        where = self.folder.parent / "where"
        outcome = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", f"{self.replace_ports(commands)}\npwd > {shlex.quote(str(where))}"],
            cwd=self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
        )
        if outcome.returncode and OFFLINE.search(outcome.stderr):
            import pytest

            pytest.skip(f"{block.place}: a registry cannot be reached")
        assert outcome.returncode == 0, f"{block.place}: {outcome.stdout}{outcome.stderr}"
        self.said, self.folder = outcome.stdout, Path(where.read_text().strip())

    @contextmanager
    def _capture_output(self) -> Iterator[list[str]]:
        """Work in the folder, and capture what is printed there."""
        import contextlib
        import io

        said: list[str] = []
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()) as out:
            yield said
        said.append(out.getvalue())
