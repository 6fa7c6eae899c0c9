"""Memory that runs out within a library."""

import pytest
import shapely

from vexture.base.errors import LimitError
from vexture_geo.maps.prepare import in_memory
from vexture_geo.vector.vectors import check_memory


def test_memory_that_runs_out_within_a_library_is_told_apart_from_damage():
    with pytest.raises(LimitError, match="more memory than there is"), in_memory():
        raise shapely.errors.GEOSException("std::bad_alloc")
    with pytest.raises(shapely.errors.GEOSException), in_memory():
        raise shapely.errors.GEOSException("side location conflict")
    good = shapely.to_wkb(shapely.box(0, 0, 1, 1))
    with pytest.raises(MemoryError):
        check_memory(good)
    check_memory(good[:20])
