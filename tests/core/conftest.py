"""The tests of the core where only the core is installed: modules that need another package are skipped."""

import pytest

BESIDE = {"httpx", "netCDF4", "resvg", "shapely", "skia", "vexture_geo"}
"""Packages that tests use beside the core: to compare with, or to try its server with a flood."""


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
