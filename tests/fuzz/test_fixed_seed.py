"""Some seconds of fuzzing, the same on every machine, in processes that a crash of native code does not take along."""

import time

import pytest
from campaign import run_worker
from javascript import NODE
from readers import TARGETS

SEED = "ordinary"
LIMIT = 300.0
"""Seconds, on a machine with much else to do."""


@pytest.mark.long
@pytest.mark.parametrize("language", ["python", "javascript"])
def test_damaged_files_are_read_or_refused_in_one_line(language):
    if language == "javascript" and not NODE:
        pytest.skip("node or the packages of web/ are missing")
    names = [name for name in TARGETS if name.endswith("-js") == (language == "javascript")]
    results = dict(run_worker(names, SEED, time.time() + LIMIT, "test"))
    assert [finding for result in results.values() for finding in result.findings] == []
    assert {name: result.runs for name, result in results.items()} == {name: TARGETS[name].of_a_test for name in names}
