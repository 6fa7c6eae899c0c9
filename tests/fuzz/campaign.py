"""`make fuzz MINUTES=n SEED=s`: all targets in turn, each in a process of its own, with limits.

    python tests/fuzz/campaign.py MINUTES SEED [TARGET...]

Prints a line for each target, writes each finding to a file, and exits with 1 if there is one.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from hashlib import sha1
from pathlib import Path
from typing import Any

from javascript import NODE
from readers import TARGETS
from worker import LIVE, SECONDS, SHARED_BYTES

FINDINGS = Path("fuzz-findings")
"""Folder in the working directory."""

ENVIRONMENT = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
"""Of a worker: it imports what the campaign imports."""

STARTING = 300.0
"""Seconds that a worker may take beyond its time: imports, kernels to compile, the last input, a finding to shrink."""


@dataclass
class Result:
    """What came of a target."""

    runs: int = 0
    answers: int = 0
    slowest: float = 0.0
    slow_input: bytes = b""
    findings: list[tuple[str, bytes]] = field(default_factory=list)


def run_worker(names: Sequence[str], seed: str, until: float, runs: str) -> Iterator[tuple[str, Result]]:
    """Run a worker to its end, natural or not; yield the result of each target that it began."""
    with tempfile.NamedTemporaryFile() as shared:
        shared.truncate(SHARED_BYTES)
        worker = Path(__file__).with_name("worker.py")
        command = [sys.executable, str(worker), shared.name, seed, str(until), runs, *names]
        allowed = max(until - time.time(), 0.0) + STARTING
        with tempfile.TemporaryFile() as errors:
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, env=ENVIRONMENT) as process:
                try:
                    said = process.communicate(timeout=allowed)[0]
                except subprocess.TimeoutExpired:
                    process.kill()
                    said = process.communicate()[0]
            errors.seek(0)
            last_words = errors.read().decode(errors="replace")[-4000:]
        count, length = LIVE.unpack(shared.read(LIVE.size))
        last = shared.read(length)
    yield from results_of(
        [json.loads(line) for line in said.splitlines()], names, process.returncode, count, last, last_words
    )


def results_of(
    lines: list[dict[str, Any]], names: Sequence[str], code: int, count: int, last: bytes, last_words: str
) -> Iterator[tuple[str, Result]]:
    """Results from a worker's lines; the target that it died of gets a finding."""
    results = {name: Result() for name in names}
    done = set()
    for line in lines:
        result = results[line["target"]]
        if "finding" in line:
            result.findings.append((line["finding"], bytes.fromhex(line["input"])))
            continue
        done.add(line["target"])
        result.runs, result.answers, result.slowest = line["runs"], line["answers"], line["slowest"]
        result.slow_input = bytes.fromhex(line["input"])
    for name, result in results.items():
        if name not in done:
            why = {
                -27: f"more than {SECONDS * TARGETS[name].patience:g} s for one input",
                -9: "it hung and was ended",
            }.get(code, f"exit {code}")
            result.runs = count
            result.findings.append((f"the process died: {why}\n{last_words}", last))
            yield name, result
            return
        yield name, result


def run_target(name: str, seed: str, seconds: float) -> Result:
    """Fuzz one target for a time; a worker that dies is followed by another one."""
    total, until, part = Result(), time.time() + seconds, 0
    while time.time() < until:
        for _, result in run_worker([name], f"{seed} {part}", until, str(10**9)):
            total.runs += result.runs
            total.answers = max(total.answers, result.answers)
            known = {finding.partition("\n")[0] for finding, _ in total.findings}
            total.findings += [each for each in result.findings if each[0].partition("\n")[0] not in known]
            if result.slowest > total.slowest:
                total.slowest, total.slow_input = result.slowest, result.slow_input
        part += 1
    return total


def save_finding(name: str, text: str, data: bytes) -> Path:
    """Write an input and what it shows into the folder of findings."""
    FINDINGS.mkdir(exist_ok=True)
    path = FINDINGS / f"{name}-{sha1(data).hexdigest()[:10]}"
    path.write_bytes(data)
    path.with_suffix(".txt").write_text(text, encoding="utf-8")
    return path


def main() -> int:
    """Run the targets that are named, or all."""
    minutes, seed, *chosen = sys.argv[1:]
    names = chosen or [name for name in TARGETS if NODE or not name.endswith("-js")]
    found = 0
    for name in names:
        start = time.time()
        result = run_target(name, seed, 60.0 * float(minutes) / len(names))
        speed = result.runs / (time.time() - start)
        print(
            f"{name:<12}{result.runs:>9} runs, {speed:>7.0f} a second, {result.answers:>5} answers, "
            f"{len(result.findings)} findings, slowest {1000 * result.slowest:.0f} ms",
            flush=True,
        )
        if result.slowest > SECONDS * TARGETS[name].patience / 10:
            print(f"  slow: {save_finding(name, f'{result.slowest:.1f} s', result.slow_input)}")
        for text, data in result.findings:
            print(f"  {save_finding(name, text, data)}: {text.partition(chr(10))[0]}", flush=True)
        found += len(result.findings)
    return found > 0


if __name__ == "__main__":
    sys.exit(main())
