"""Water of the four example scenes is water, from every view of their pages and at every time."""

from pathlib import Path
from typing import Any

import pytest

import flood_water


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("scene", flood_water.SCENES)
def test_no_bed_sky_or_shard_is_seen_where_water_must_be(chromium: Any, scene: str, tmp_path: Path) -> None:
    found = list(flood_water.count_views(chromium, scene, tmp_path))
    assert sum(one.water for one in found) > 10_000
    assert {(one.view, one.step): one.share for one in found if one.share > 0.005} == {}
    assert sum(one.holes + one.bed for one in found) < 0.0005 * sum(one.water for one in found)
