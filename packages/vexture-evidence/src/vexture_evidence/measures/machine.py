"""The machine and the versions that a benchmark ran on."""

import os
import platform
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

LIBRARIES = ("vexture", "numpy", "numba")
CPUINFO = Path("/proc/cpuinfo")


def processor() -> str:
    """Model of the processor, or its architecture if the system does not name the model."""
    if CPUINFO.exists():
        for line in CPUINFO.read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def machine_facts() -> dict[str, Any]:
    """Date, processor, system and versions, for a benchmark's JSON."""
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "processor": processor(),
        "cores": os.cpu_count(),
        "system": platform.platform(terse=True),
        "python": platform.python_version(),
        **{library: version(library) for library in LIBRARIES},
    }


def machine_line(facts: dict[str, Any]) -> str:
    """The facts of `machine_facts` in one line, for the foot of a table."""
    versions = ", ".join(f"{name} {facts[name]}" for name in ("python", *LIBRARIES))
    return f"{facts['date'][:10]}, {facts['processor']}, {facts['cores']} cores, {facts['system']}; {versions}"
