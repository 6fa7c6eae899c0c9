"""Steps that a model appends to its file."""

import model
import pytest
from floods import series

from vexture.base.errors import SourceError
from vexture_geo.depth.appended_steps import open_growing, whole_run

pytestmark = pytest.mark.usefixtures("page_is_built")


def test_known_steps_are_not_made_again(tmp_path):
    path = series(tmp_path / "run.nc", [0.3, 0.4, 0.5])
    extent, known = whole_run(path, bounds=None, hmin=0.05)
    assert [one.time.hour for one in known] == [6, 7, 8]
    with open_growing(path, frame=extent.frame, known=known[:2], hmin=0.05) as run:
        assert [change.number for change in run.changes()] == [2]
    with open_growing(path, frame=extent.frame, known=known, rewritten=True, hmin=0.05) as run:
        assert list(run.changes()) == []
    series(path, [0.3, 0.6, 0.5])
    with open_growing(path, frame=extent.frame, known=known, hmin=0.05) as run:
        assert [change.number for change in run.changes()] == [1]
    series(path, [0.3, 0.6, 0.5, 0.7])
    with open_growing(path, frame=extent.frame, known=known, rewritten=True, hmin=0.05) as run:
        assert [change.number for change in run.changes()] == [1, 3]
    with open_growing(path, frame=extent.frame, known=known[1:], hmin=0.05) as run:
        assert (run.started_over, [change.number for change in run.changes()]) == (True, [0, 1, 2, 3])


def test_half_of_a_step_is_none_and_a_dry_step_is_one(tmp_path):
    path = tmp_path / "run.nc"
    model.run(path, ["open 6", "step 0.3", "time", "close"])  # as it is while the model writes the second
    extent, known = whole_run(path, bounds=None, hmin=0.05)
    assert len(extent.steps) == len(known) == 1
    model.run(path, ["open 6", "step 0.3", "time", "step 0.4", "close"])  # NaN where it is dry, as some models write
    with open_growing(path, frame=extent.frame, known=known, hmin=0.05) as run:
        assert [(change.number, bool(change.step.drawing.paths)) for change in run.changes()] == [(1, False), (2, True)]
    model.run(path, ["open 6", "time", "close"])
    with pytest.raises(SourceError, match="no number"):
        whole_run(path, bounds=None, hmin=0.05)
    with (
        open_growing(path, frame=extent.frame, known=known, hmin=0.05) as run,
        pytest.raises(SourceError, match="step 1 holds no number any more"),
    ):
        list(run.changes())
