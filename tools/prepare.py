"""Prepare this machine: `prepare.py venv` makes .venv, `prepare.py system` installs what the tests need beyond it.

`prepare.py web` installs what building web/ needs, and fails where that is not to be had.

System packages are installed only by root, and only where there is apt-get; elsewhere they are named, together with
the tests that are skipped without them. Whether something is there is found out by using it.
"""

import fcntl
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PIP = (str(ROOT / ".venv" / "bin" / "python"), "-m", "pip", "--version")


@dataclass(frozen=True, slots=True)
class Need:
    """Something that this program uses but cannot bring along.

    Parameters
    ----------
    what : str
        Its name for people.
    use : str
        Python text that fails, in a process of its own, where it is missing.
    packages : tuple of str
        Debian packages that bring it; none where it comes from elsewhere.
    skipped : str
        What is not done without it.
    """

    what: str
    use: str
    packages: tuple[str, ...]
    skipped: str

    def complaint(self) -> str | None:
        """Return why it cannot be used, in one line; None if it can."""
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "packages" / "vexture-evidence" / "benchmarks")}
        command = [sys.executable, "-c", self.use]
        outcome = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        if outcome.returncode == 0:
            return None
        *_, last = outcome.stderr.strip().splitlines() or [f"exit code {outcome.returncode}"]
        return last.rpartition("Error: ")[2]


VENV = Need(
    "Python's venv",
    "import ensurepip, venv",
    (f"python{sys.version_info.major}.{sys.version_info.minor}-venv",),
    "everything: no .venv can be made",
)
OLDEST_NODE = 20
NODE = f"""
import subprocess
version = subprocess.run(["node", "--version"], capture_output=True, text=True, check=True).stdout.strip()
assert int(version[1:].split(".")[0]) >= {OLDEST_NODE}, f"node {{version}} is too old; install {OLDEST_NODE} or newer"
"""
WEB = (
    Need("Node.js", NODE, ("nodejs",), "the viewer's page, the JavaScript package and their tests"),
    Need(
        "npm",
        "import subprocess; subprocess.run(['npm', '--version'], capture_output=True, check=True)",
        ("npm",),
        "the viewer's page, the JavaScript package and their tests",
    ),
)
CHROMIUM = """
import subprocess
from playwright.sync_api import sync_playwright
subprocess.run(["chromium", "--version"], capture_output=True, check=True)
with sync_playwright() as started:
    started.chromium.launch(executable_path="/usr/bin/chromium", args=["--headless=new", "--no-sandbox"]).close()
"""
SYSTEM = (
    Need(
        "OpenGL without a window",
        "from vexture.thesis.texture import context; context()",
        ("libegl1", "libgl1", "libgl1-mesa-dri", "libgles2", "libgbm1"),
        "the tests of the gpu renderer",
    ),
    Need(
        "the libraries of Skia",
        "import skia",
        ("libegl1", "libgl1", "libexpat1"),
        "the comparisons with Skia",
    ),
    Need(
        "the font DejaVu Sans",
        "import corpora; corpora.dejavu_sans()",
        ("fonts-dejavu-core",),
        "the tests on glyphs",
    ),
    Need(
        "the font STIXGeneral",
        "import corpora; corpora.stix()",
        ("fonts-stix",),
        "the benchmarks on a font of cubics",
    ),
    Need(
        "a compiler for GPUs that need not be there",
        "from vexture_evidence.measures.gpu_compiler import toolchain\nwith toolchain(): pass",
        ("gcc", "glslang-tools", "libc6-dev", "libvulkan-dev", "mesa-vulkan-drivers"),
        "the modelled costs of the shaders",
    ),
    Need(
        "a Vulkan driver",
        "import wgpu; assert wgpu.gpu.request_adapter_sync(), 'there is none'",
        ("mesa-vulkan-drivers",),
        "the tests of the shader in WGSL",
    ),
    Need(
        "the icon sets of npm",
        "import corpora; corpora.mdi(1, 0); corpora.simple_icons(1, 0)",
        (),
        "the tests on real icons",
    ),
    Need(
        "the KTX2 reader of npm",
        "import corpora, subprocess; corpora.ktx_parse(); subprocess.run(['node', '--version'], check=True)",
        (),
        "the tests that another program reads packed textures",
    ),
    Need("Chromium", CHROMIUM, ("chromium",), "the tests in a browser"),
)


def install(packages: list[str]) -> None:
    """Let apt-get install packages, or print why it did not; asks nothing."""
    print(f"installing {' '.join(packages)} ...", flush=True)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    with Path(__file__).open() as own:
        fcntl.flock(own, fcntl.LOCK_EX)  # two may be at it; apt-get waits for no other apt-get
        for arguments in (["update"], ["install", "--yes", "--no-install-recommends", *packages]):
            command = ["apt-get", "--quiet", "--option", "DPkg::Lock::Timeout=120", *arguments]
            outcome = subprocess.run(
                command, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
            )
            if outcome.returncode:
                *_, reason = outcome.stderr.strip().splitlines() or ["it says nothing"]
                print(f"apt-get {arguments[0]} failed: {reason}", flush=True)


def provide(needs: tuple[Need, ...]) -> bool:
    """Install what is missing where that is allowed, name what is still missing; whether nothing is."""
    missing = [need for need in needs if need.complaint()]
    packages = sorted({package for need in missing for package in need.packages})
    if packages and os.geteuid() == 0 and shutil.which("apt-get"):
        install(packages)
    complete = True
    for need in missing:
        reason = need.complaint()
        if reason:
            complete = False
            remedy = f" (on Debian: apt-get install {' '.join(need.packages)})" if need.packages else ""
            print(f"missing: {need.what}{remedy}\n  because: {reason}\n  skipped: {need.skipped}", flush=True)
    return complete


def make_venv() -> int:
    """Make .venv with pip, unless it is there; the exit code."""
    try:
        if subprocess.run(PIP, capture_output=True, check=False).returncode == 0:
            return 0
    except OSError:
        pass
    if not provide((VENV,)):
        return 1
    print("making .venv ...", flush=True)
    return subprocess.run([sys.executable, "-m", "venv", str(ROOT / ".venv")], check=False).returncode


def main() -> int:
    """Do what the one argument says; the exit code."""
    if sys.argv[1:] == ["venv"]:
        return make_venv()
    if sys.argv[1:] == ["system"]:
        provide(SYSTEM)
        return 0
    if sys.argv[1:] == ["web"]:
        return 0 if provide(WEB) else 1
    print("usage: prepare.py venv | system | web", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
