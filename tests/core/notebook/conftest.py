"""Widgets for the tests of notebooks, none of which is left open."""

from dataclasses import replace

import pytest

import vexture

FLAG = b"""<svg viewBox="0 0 8 8"><rect id="low" width="8" height="8" fill="#123"/>
<rect id="up" width="8" height="4" fill="red"/></svg>"""
TWO = [vexture.Drawing.polygon([(0, 0), (1, 0), (0, 1)]), vexture.Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])]


@pytest.fixture(autouse=True)
def none_is_left():
    """Close the widgets of a test: those of all tests share bytes."""
    ipywidgets = pytest.importorskip("ipywidgets")

    yield
    ipywidgets.Widget.close_all()


@pytest.fixture
def flag():
    return vexture.show(vexture.read(FLAG, name="flag"))


@pytest.fixture
def pair():
    return vexture.atlas([replace(drawing, name=name) for name, drawing in zip("ab", TWO, strict=True)])
