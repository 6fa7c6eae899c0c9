"""Disks that are full or cannot be written: real ones, in a name space of mounts that needs no permissions."""

import os
import shutil
import subprocess
from functools import cache

import pytest

MOUNT = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
COPY = 'mkdir -p "$KEPT" && cp -a "$DISK/." "$KEPT"'


@cache
def _refusal():
    """Why no disk can be mounted here; empty if one can."""
    if shutil.which("unshare") is None:
        return "unshare is missing (Debian: util-linux), so there is no disk to fill"
    tried = subprocess.run([*MOUNT, "mount -t tmpfs none /mnt"], capture_output=True, text=True)
    return f"no disk can be mounted here: {tried.stderr.strip()}" if tried.returncode else ""


class Disk:
    """A disk of a few bytes that only the processes see which are started on it."""

    def __init__(self, folder, size="16k", read_only=False):
        if _refusal():
            pytest.skip(_refusal())
        self.path, self.kept = folder / "disk", folder / "kept"
        self.path.mkdir()
        self.environment = os.environ | {"DISK": str(self.path), "KEPT": str(self.kept)}
        self.ready = f'mount -t tmpfs -o size={size} none "$DISK"'
        if read_only:
            self.ready += ' && mount -o remount,ro "$DISK"'

    def starting(self, command):
        """The command that runs another one where the disk is."""
        return ["env", f"DISK={self.path}", *MOUNT, f'{self.ready} && exec "$@"', "disk", *command]

    def run(self, *command):
        """Run a command; what it leaves on the disk is copied to `kept`."""
        shell = f'{self.ready} && {{ "$@"; code=$?; {COPY}; exit $code; }}'
        return subprocess.run(
            [*MOUNT, shell, "disk", *map(str, command)], env=self.environment, capture_output=True, text=True
        )

    def left(self):
        """What `run` has left, by its name."""
        return {path.name: path for path in self.kept.rglob("*") if path.is_file()}
