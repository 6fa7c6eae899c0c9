"""The tests of the core where only the core is installed: what compares it with another program is skipped."""

import pytest

COMPARED = {"httpx", "netCDF4", "resvg", "shapely", "skia"}
"""Packages of vexture-evidence that tests import to compare the core with."""


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Skip a module that imports a program that is not installed to compare with."""
    report = yield
    call = getattr(report, "call", None)
    cause = call.excinfo.value.__cause__ if call and call.excinfo else None
    if isinstance(cause, ModuleNotFoundError) and cause.name in COMPARED:
        report.outcome = "skipped"
        report.longrepr = (str(collector.path), 0, f"Skipped: it compares with {cause.name}, of vexture-evidence[test]")
    return report
