"""The sweep finds what it is for: readings and textures that are wrong, children that die, lists that are stale."""

from contextlib import closing

import numpy as np
import pytest

from judge import Case, Child, stages
from sweep import OUTCOMES, faults, known_issues, outcome_of
from sweep_corpora import CORPORA, coast_case, ring_of

pytestmark = pytest.mark.filterwarnings("ignore::vexture.base.errors.SourceWarning")

ROOT = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{}</svg>'
SQUARE = ROOT.format('<path d="M2 2h6v6h-6z"/>').encode()
OTHER = ROOT.format('<path d="M2 2h6v7h-6z"/>').encode()
GROUPED = ROOT.format(
    '<path fill="red" d="M0 0h10v4h-10z"/><g opacity="0.5" style="mix-blend-mode: multiply">'
    '<path d="M2 2h6v6h-6z"/><path fill="#8f8" d="M1 1h4v8h-4z"/></g>'
).encode()
MASKED = ROOT.format('<path d="M2 2h6v6h-6z" mask="url(#a)"/>').encode()
LETTERED = ROOT.format('<path d="M2 2h6v6h-6z"/><text>a</text>').encode()


def judged(content: bytes, same: bytes | None = None) -> str:
    facts = {}
    for part in stages(Case("", "a.svg", content, same)):
        facts |= part
    return outcome_of(facts)


@pytest.mark.parametrize(
    ("content", "same", "outcome"),
    [
        (SQUARE, None, "right"),
        (GROUPED, None, "right"),
        (GROUPED, GROUPED.replace(b'opacity="0.5"', b'fill-opacity="0.5"'), "silent"),
        (GROUPED, GROUPED.replace(b"multiply", b"screen"), "silent"),
        (SQUARE, OTHER, "silent"),
        (MASKED, OTHER, "warned"),
        (LETTERED, OTHER, "silent"),
        (b"<svg", None, "refused"),
        (SQUARE, b"<svg", "unjudged"),
        (ROOT.format("").encode(), None, "right"),
        (b'<svg xmlns="http://www.w3.org/2000/svg"><circle cx="50" cy="70" r="30"/></svg>', None, "right"),
    ],
)
def test_each_outcome(content, same, outcome):
    assert judged(content, same) == outcome


def test_a_texture_that_differs_is_no_matter_of_notes():
    assert outcome_of({"seconds": 0.1, "notes": "a.svg: left out: mask", "texture": 0.5, "resvg": 0.0}) == "silent"


def test_an_exception_that_is_no_error_of_ours_is_a_finding():
    (facts,) = stages(Case("", "a.svg", None))
    assert outcome_of(facts) == "died"


def test_a_child_that_dies_is_a_finding():
    with closing(Child(stages)) as child:
        assert outcome_of(child.judge(Case("", "a.svg", SQUARE))) == "right"
        child.process.kill()
        assert outcome_of(child.judge(Case("", "a.svg", SQUARE))) == "died"


@pytest.mark.parametrize("outcome", OUTCOMES)
@pytest.mark.parametrize("known", [False, True])
def test_the_list_of_known_issues_is_complete_and_not_stale(outcome, known):
    lines = faults([("w3c", "a.svg", outcome)], [("w3c", "a.svg")] if known else [("w3c", "other.svg")])
    assert bool(lines) == (known != (outcome in ("silent", "died")))


def test_known_issues_name_a_corpus_and_a_reason():
    known = known_issues()
    assert {corpus for corpus, _ in known} <= set(CORPORA)
    assert all(known.values())


def test_segments_of_a_coast_become_a_ring():
    """Around a square across the edge of the map; a segment ends where the next one starts."""
    parts = [np.array([[90, 0], [100, 0]]), np.array([[10, 10], [0, 10], [90, 10], [90, 0]])]
    parts.insert(1, np.array([[0, 0], [10, 0], [10, 10]]))
    ring = ring_of(parts, 100)
    assert ring.tolist() == [[0, 0], [10, 0], [10, 10], [0, 10], [-10, 10], [-10, 0]]
    assert ring_of(parts[:2], 100) is None
    assert ring_of([np.array([[0, 5], [40, 5], [80, 5], [100, 5]])], 100) is None  # around a pole


def test_a_coast_is_read_as_it_is_shown():
    case = coast_case(1, np.array([[4.0, 52.0], [6.0, 52.5], [5.0, 53.0]]))
    assert judged(case.content, case.same) == "right"
