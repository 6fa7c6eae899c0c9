"""Marks of tests that need more than the package that they test."""

from importlib.util import find_spec

import pytest

NEEDS_GEO = pytest.mark.skipif(find_spec("vexture_geo") is None, reason="it needs vexture-geo")
"""For a test of the core that reads geographic data, or names what vexture-geo adds."""
