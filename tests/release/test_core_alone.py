"""The tests of the core, run where nothing but the wheel of the core is installed, and tools of tests."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
from installed import Installed

from dist import build

ROOT = Path(__file__).parents[2]
TOOLS = (
    *("httpx", "hypothesis", "pytest", "pytest-timeout", "pytest-xdist"),
    *("resvg", "shapely", "skia-python", "tblib", "wgpu"),
)
"""Packages that tests use: a client, and programs to compare with."""

EXTRAS = "vexture[gpu,notebook,plot,server,text,trace]"
"""Extras of the core: it is tested whole."""

COPIES = ("FORMAT.md", "examples/shapes", "packages/vexture/pyproject.toml", "pyproject.toml", "tests", "tools")
"""What the tests read of a checkout; packages are installed only."""

MAY_LACK = re.compile(
    r"vexture-evidence|vexture-geo|more than the 256 rows|zlib|chromium|[Nn]ode|npm|Vulkan|OpenGL|not built"
)
"""In the reasons of tests that are skipped: other packages of tests, and what is no Python."""

BENCHMARKS = "packages/vexture-evidence/benchmarks"
"""Folder whose `corpora.py` lists drawings for tests."""


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """An environment with the wheel of the core, and a copy of the tests in it."""
    wheels = tmp_path_factory.mktemp("core")
    build(ROOT / "packages" / "vexture", wheels)
    (wheel,) = wheels.glob("*.whl")
    installed = Installed(tmp_path_factory.mktemp("alone"), wheel, whole=False)
    del installed.environment["NUMBA_DISABLE_JIT"]
    corpora = Path(os.environ.get("VEXTURE_CORPORA", "~/.cache/vexture/corpora")).expanduser()
    path = os.pathsep.join((str(installed.bin), os.environ["PATH"]))
    installed.environment |= {"PATH": path, "VEXTURE_CORPORA": str(corpora)}
    installed.add(EXTRAS, *TOOLS)
    for name in (*COPIES, BENCHMARKS):
        target = installed.work / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, target)
    return installed


@pytest.mark.slow
@pytest.mark.skipif("VEXTURE_DIST" in os.environ, reason="`make dist-check` tries wheels; `make sweep` runs this test")
@pytest.mark.timeout(7200)  # it compiles all kernels, on a machine with much else to do
def test_the_tests_of_the_core_pass_without_other_packages(alone: Installed) -> None:
    for name in ("vexture_geo", "vexture_evidence"):
        assert alone.python(f"import {name}").stderr.endswith(f"No module named '{name}'\n")
    results = alone.work / "results.xml"
    processes = str(min(4, 1 + (os.cpu_count() or 1)))
    command = [str(alone.bin / "python"), "-m", "pytest", "--quiet", "--numprocesses", processes, "-m", "not slow"]
    command += ["--dist", "worksteal", "-p", "no:cacheprovider", f"--junitxml={results}", "tests/core"]
    outcome = subprocess.run(
        command, cwd=alone.work, env=alone.environment, capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stdout[-20_000:] + outcome.stderr[-2000:]
    passed, skipped = 0, []
    for case in ElementTree.parse(results).iter("testcase"):
        found = case.find("skipped")
        passed += found is None
        skipped += [] if found is None else [(case.get("classname"), found.get("message", ""))]
    assert passed > 3500
    assert [one for one in skipped if not one[0]] == []  # whole modules
    assert {message for _, message in skipped if not MAY_LACK.search(message)} == set()
