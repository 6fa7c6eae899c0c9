"""Conversions of maps that wait."""

import threading

import pytest


@pytest.fixture
def held(monkeypatch):
    """Conversions that wait for an event."""
    import vexture_geo.maps.notebook.map_widget as module

    go, real = threading.Event(), module._encode
    monkeypatch.setattr(module, "_encode", lambda made: go.wait(30) and real(made))
    yield go
    go.set()
