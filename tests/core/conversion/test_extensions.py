"""Readers of geographic data: found by their entry point, and named where none is installed."""

from importlib.metadata import EntryPoint

import pytest

from vexture.base.content import FileKind
from vexture.base.errors import DeviceError
from vexture.conversion import extensions


@pytest.fixture
def install(monkeypatch):
    """Pretend that distributions are installed that give certain modules by the entry point."""

    def install_modules(*modules):
        points = [EntryPoint("geographic", module, extensions.READERS) for module in modules]

        def entry_points(*, group, name):
            return [point for point in points if (point.group, point.name) == (group, name)]

        monkeypatch.setattr(extensions, "entry_points", entry_points)

    extensions.find_geographic_reader.cache_clear()
    yield install_modules
    extensions.find_geographic_reader.cache_clear()


def test_the_module_of_the_entry_point_is_the_reader(install):
    install("colorsys")
    assert extensions.geographic_reader(FileKind.DEPTHS).__name__ == "colorsys"


def test_the_reader_is_looked_for_once(install):
    install("colorsys")
    first = extensions.find_geographic_reader()
    install()
    assert extensions.find_geographic_reader() is first


def test_without_a_reader_the_remedy_is_named(install):
    install()
    assert extensions.find_geographic_reader() is None
    with pytest.raises(
        DeviceError, match=r"^reading geographic data needs .* vexture-geo: pip install 'vexture\[geo\]'"
    ):
        extensions.geographic_reader(FileKind.GEOJSON)
    with pytest.raises(DeviceError, match=r"pip install 'vexture\[gis\]'"):
        extensions.geographic_reader(FileKind.DEPTHS)
