"""Bytes that widgets share."""

import pytest

import vexture

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("traitlets")
pytestmark = pytest.mark.usefixtures("page_is_built")


def test_widgets_of_one_texture_share_its_bytes_until_the_last_is_closed(flag):
    other = vexture.show(flag.texture)
    assert other._source is flag._source
    assert other._engine is flag._engine
    flag.close()
    assert other._source.comm is not None
    other.close()
    assert other._source.comm is None
    again = vexture.show(flag.texture)
    assert again._source is not other._source
    assert again._source.content == flag.texture.to_ktx2()
