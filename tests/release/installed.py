"""Wheels installed in an environment of their own, with nothing beside them but what they require."""

import subprocess
import sys
from importlib.metadata import Distribution, distribution, distributions
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name


class Installed:
    """The commands of wheels, run outside the checkout and without Node.js.

    Parameters
    ----------
    folder : path
        An empty folder: the environment is made in it, and the commands work in it.
    wheels : path
    whole : bool
        Install all requirements from the registry, and compile kernels as on a new machine; else the requirements are
        those of the environment that runs the tests, and kernels run as they are written.
    """

    def __init__(self, folder: Path, *wheels: Path, whole: bool) -> None:
        self.bin, self.work = folder / "venv" / "bin", folder / "work"
        self.work.mkdir()
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", self.bin.parent], check=True)
        self.environment = {"PATH": str(self.bin), "HOME": str(folder), "PYTHONWARNINGS": "error"}
        if whole:
            self.pip("install", "--quiet", *map(str, wheels))
        else:
            self.environment["NUMBA_DISABLE_JIT"] = "1"
            self.pip("install", "--quiet", "--no-index", "--no-deps", *map(str, wheels))
            self.add()

    def add(self, *requirements: str) -> None:
        """Add packages of the tests' environment with what they require; an extra may be one of the wheels'."""
        own = {canonicalize_name(one.name): one for one in distributions(path=[str(self.site)])}
        for needed in requirements_of(own, *requirements).values():
            self._link(needed)

    @property
    def site(self) -> Path:
        """Where its packages are."""
        (found,) = self.bin.parent.glob("lib/python3*/site-packages")
        return found

    def pip(self, *arguments: str) -> str:
        """What pip of the tests' environment says about this one."""
        command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", self.bin / "python"]
        outcome = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        return outcome.stdout

    def command(self, *arguments: str | Path) -> list[str]:
        """The words of a command of vexture."""
        return [str(self.bin / "vexture"), *map(str, arguments)]

    def run(self, *arguments: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run a command of vexture."""
        return self._ran(self.command(*arguments), **environment)

    def python(self, program: str) -> subprocess.CompletedProcess[str]:
        """Run Python text."""
        return self._ran([str(self.bin / "python"), "-c", program])

    def _link(self, package: Distribution) -> None:
        """Make a package of the tests' environment one of this environment."""
        for name in {path.parts[0] for path in package.files or ()} - {"..", "__pycache__"}:
            if not (self.site / name).is_symlink():
                (self.site / name).symlink_to(Path(str(package.locate_file(name))))

    def _ran(self, command: list[str], **environment: str) -> subprocess.CompletedProcess[str]:
        everything = {**self.environment, **environment}
        return subprocess.run(command, cwd=self.work, env=everything, capture_output=True, text=True, check=False)


def requirements_of(own: dict[str, Distribution], *further: str) -> dict[str, Distribution]:
    """Packages that some and further requirements need, without extras but those that they name."""
    found: dict[str, Distribution] = {}
    waiting = [(package, "") for package in own.values()]

    def need(requirement: Requirement) -> None:
        name = canonicalize_name(requirement.name)
        if name not in found and name not in own:
            found[name] = distribution(name)
            waiting.append((found[name], ""))
        waiting.extend((own.get(name) or found[name], extra) for extra in requirement.extras)

    for requirement in map(Requirement, further):
        need(requirement)
    while waiting:
        one, extra = waiting.pop()
        for requirement in map(Requirement, one.requires or ()):
            if not requirement.marker or requirement.marker.evaluate({"extra": extra}):
                need(requirement)
    return found
