"""A process that runs one reader on damaged files: the campaign starts it, watches it, and outlives it.

It writes each input into memory that the campaign shares, before the reader sees it. The processor's time for one
input and the memory are limited by the system, so that native code is limited, too.
"""

import json
import mmap
import os
import resource
import signal
import struct
import sys
import time
from pathlib import Path
from random import Random

from attempts import attempt, kind_of_finding, shrunk
from mutate import MOST_BYTES, mutate_seed
from readers import TARGETS, FindingError

SECONDS = 10.0
"""Of the processor, for one input; a target may have more."""

MEMORY = 2 << 30
"""Bytes of address space beyond those of the imported libraries."""

LIVE = struct.Struct("<QI")
"""Number of inputs, and length of the last one, which follows."""

SHARED_BYTES = LIVE.size + MOST_BYTES * 2
KEPT = 2000
"""Inputs that are kept because their answer was new."""


def limit_memory() -> None:
    (pages, *_) = Path("/proc/self/statm").read_text().split()
    resource.setrlimit(resource.RLIMIT_AS, (int(pages) * resource.getpagesize() + MEMORY,) * 2)


def announce(shared: mmap.mmap, count: int, data: bytes) -> None:
    """Tell the campaign what is read now."""
    shared[: LIVE.size + len(data)] = LIVE.pack(count, len(data)) + data


def run(name: str, seed: str, until: float, most: int, shared: mmap.mmap) -> dict[str, object]:
    """Fuzz one target until a time or for a number of runs."""
    target, rng = TARGETS[name], Random(f"{name} {seed}")
    seeds, met, found = target.seeds(name), set[str](), dict[str, str]()
    slowest, slow_input, count, began = 0.0, b"", 0, time.process_time()
    for data in seeds:  # what is new is judged by what whole files say
        announce(shared, 0, data)
        met.add(attempt(target, data))
    while count < most and time.time() < until:
        data = target.make(rng) if target.make else mutate_seed(rng, seeds, target.tokens, target.text)
        if target.repair and rng.random() < 0.7:
            data = target.repair(data)
        data, count = data[:MOST_BYTES], count + 1
        announce(shared, count, data)
        signal.setitimer(
            signal.ITIMER_PROF, target.patience * SECONDS
        )  # after the seeds, for which kernels may be compiled
        start = time.process_time()
        try:
            answer = attempt(target, data)
        except FindingError as finding:
            answer = kind_of_finding(finding)
            if answer not in found:
                signal.setitimer(signal.ITIMER_PROF, 0.0)
                smaller = target.shrink(data) if target.shrink else shrunk(target, data)
                found[answer] = report(name, smaller, str(finding))
        if (took := time.process_time() - start) > slowest:
            slowest, slow_input = took, data
        if answer not in met and len(seeds) < KEPT:
            met.add(answer)
            seeds.append(data)
    signal.setitimer(signal.ITIMER_PROF, 0.0)
    return {
        "runs": count,
        "slowest": slowest,
        "input": slow_input.hex(),
        "answers": len(met),
        "seconds": time.process_time() - began,
    }


def report(name: str, data: bytes, text: str) -> str:
    print(json.dumps({"target": name, "finding": text, "input": data.hex()}), file=OUT, flush=True)
    return text


if __name__ == "__main__":
    place, seed, until, runs, *names = sys.argv[1:]
    OUT = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what libraries print is not for the campaign
    with open(place, "r+b") as file:
        memory = mmap.mmap(file.fileno(), SHARED_BYTES)
    limit_memory()
    for each in names:
        most = TARGETS[each].of_a_test if runs == "test" else int(runs)
        print(json.dumps({"target": each, **run(each, seed, float(until), most, memory)}), file=OUT, flush=True)
