"""Shared by all tests; the folders from which they import are in pyproject.toml (`pythonpath`)."""

import fcntl
import os
import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

WEB = Path(__file__).parent / "web"

# compiling a kernel and drawing a whole tree take long; a temporary folder may be shared by examples
settings.register_profile(
    "vexture",
    deadline=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.function_scoped_fixture],
)
# a change is judged by the examples that the one before it was judged by; whoever sits at a machine looks for new ones
settings.register_profile("ci", settings.get_profile("vexture"), derandomize=True, database=None)
settings.load_profile("ci" if os.environ.get("CI", "").lower() in ("1", "true") else "vexture")


def pytest_collection_modifyitems(items):
    """Pages first, in one process with one browser while the others do the rest; of these the longest tests first.

    The last test is not to keep one processor waiting for the other.
    """
    items.sort(key=lambda item: (WEB not in item.path.parents, item.get_closest_marker("long") is None))


@pytest.fixture(scope="session")
def made_once(tmp_path_factory, request):
    """Folder of a name, filled by the first of all processes of tests that asks for it; the others wait for it."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if hasattr(request.config, "workerinput") else base

    def make_folder(name, fill):
        with (base / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            folder, unfinished = base / f"{name}-made", base / f"{name}-unfinished"
            if not folder.is_dir():
                shutil.rmtree(unfinished, ignore_errors=True)
                unfinished.mkdir()
                fill(unfinished)
                unfinished.rename(folder)
            return folder

    return make_folder


@pytest.fixture(scope="session", autouse=True)
def loaded_kernels(made_once):
    """Load the kernels once where many tests run: commands convert in forks of a process, which have what it has.

    One process compiles those that are not compiled yet, while the others wait.
    """
    if "PYTEST_XDIST_WORKER" in os.environ:
        from vexture.server.publish_file import load_kernels

        made_once("kernels", lambda _: load_kernels())
        load_kernels()


@pytest.fixture(scope="session")
def site(made_once):
    """The documentation, built."""
    from guides import ROOT, build_site

    def build(folder):
        outcome = build_site(ROOT, folder)
        assert outcome.returncode == 0, outcome.stderr + outcome.stdout

    return made_once("site", build)


@pytest.fixture(scope="session")
def page_is_built():
    """Skip where the page of floods is not built."""
    from vexture.base.errors import DeviceError
    from vexture.pages.page import built
    from vexture_geo.flood.bundle import FLOOD

    try:
        built(FLOOD.script, FLOOD.package)
    except DeviceError as error:
        pytest.skip(str(error))
