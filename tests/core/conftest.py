"""The tests of the core where only the core is installed: modules that need another package are skipped."""

import pytest

BESIDE = {"httpx", "resvg", "shapely", "skia"}
"""Packages with which tests compare, and that of a client."""


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Skip a module that imports a package that is not installed."""
    report = yield
    call = getattr(report, "call", None)
    cause = call.excinfo.value.__cause__ if call and call.excinfo else None
    if isinstance(cause, ModuleNotFoundError) and (name := (cause.name or "").partition(".")[0]) in BESIDE:
        report.outcome = "skipped"
        report.longrepr = (str(collector.path), 0, f"Skipped: it needs {name}, which vexture-evidence[test] installs")
    return report


@pytest.fixture(scope="session")
def page_is_built():
    """Skip where the page of the viewer is not built."""
    from vexture.base.errors import DeviceError
    from vexture.pages.page import VIEWER, built

    try:
        built(VIEWER.script)
    except DeviceError as error:
        pytest.skip(str(error))
