"""`vexture.show` without a browser: what it takes and refuses, what its widget holds, and what it sends."""

import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest

import vexture
from needed import NEEDS_GEO
from vexture.base.errors import DeviceError, ParameterError

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
pytest.importorskip("traitlets")
pytestmark = pytest.mark.usefixtures("page_is_built")

FLAG = b"""<svg viewBox="0 0 8 8"><rect id="low" width="8" height="8" fill="#123"/>
<rect id="up" width="8" height="4" fill="red"/></svg>"""
FADING = b"""<svg viewBox="0 0 8 8"><linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/>
</linearGradient><rect id="low" width="8" height="8" fill="url(#g)"/></svg>"""
TWO = [vexture.Drawing.polygon([(0, 0), (1, 0), (0, 1)]), vexture.Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])]


def test_all_sources_show_the_same(tmp_path, flag):
    (tmp_path / "flag.svg").write_bytes(FLAG)
    flag.texture.save(tmp_path / "flag.ktx2")
    sources = [str(tmp_path / "flag.svg"), tmp_path / "flag.ktx2", vexture.read(FLAG, name="flag"), flag.texture]
    pictures = [vexture.show(source).render(32) for source in sources]
    for picture in pictures[1:]:
        np.testing.assert_array_equal(picture, pictures[0])


def test_what_can_be_restyled_is_converted_so(flag):
    assert flag.texture.roots[0].style.names == ("low", "up")
    assert vexture.show(vexture.read(FADING)).texture.roots[0].style is None, "a gradient is worth more"
    assert vexture.show(vexture.read(FLAG), restyle=False).texture.roots[0].style is None


def test_what_is_not_chosen_is_as_it_is_by_default(flag):
    same = vexture.show(flag.texture, root=None, width=None, height=None, colors=None, view=None)
    assert (same.root, same.width, same.colors, same.view) == (None, None, {}, flag.view)
    with pytest.raises(ParameterError, match=r"`mode` is None; give .paint. or"):
        vexture.show(flag.texture, mode=None)
    with pytest.raises(AttributeError):
        flag.texture = same.texture


def test_sources_are_refused_in_a_line(pair):
    with pytest.raises(ParameterError, match=r"holds 2 drawings \(a, b\); choose one by `root`"):
        vexture.show(pair)
    with pytest.raises(ParameterError, match="`restyle` is True, but atlas is converted already; leave it out"):
        vexture.show(pair, root="a", restyle=True)
    with pytest.raises(TypeError, match="`source` is of the type int; give a path, a Drawing, a Texture"):
        vexture.show(3)


@NEEDS_GEO
def test_a_flood_is_its_page_in_a_frame(tmp_path):
    pond = b'{"type": "Polygon", "coordinates": [[[4, 52], [4.01, 52], [4.01, 52.01], [4, 52.01]]]}'
    extent = vexture.read_extent(pond, "pond.geojson")
    widget = vexture.show(extent, height=300, title="A pond")
    assert (widget.height, widget.step, widget._name) == (300, 0, "A pond")
    assert widget._page.startswith(b"<!doctype html>")
    widget.save(tmp_path / "pond.html")
    assert (tmp_path / "pond.html").read_bytes() == widget._page
    with pytest.raises(TypeError, match=r"`colors` is \{\}, but a flood has no such parameter; leave it out"):
        vexture.show(extent, colors={})
    again = vexture.show(widget.page)
    assert again.height == widget.page.height
    with pytest.raises(ParameterError, match="`amplitude` is 1, but A pond is converted already; leave it out"):
        vexture.show(widget.page, amplitude=1)


def test_without_the_extra_the_remedy_is_named(tmp_path):
    code = f"""import sys; sys.modules["anywidget"] = None
import vexture
try: vexture.show({str(tmp_path / "a.svg")!r})
except vexture.DeviceError as error: print(error)"""
    outcome = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert outcome.stdout.strip() == "show needs the package anywidget: pip install 'vexture[notebook]'"


def test_an_engine_that_is_not_built_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    import vexture.pages.page

    monkeypatch.setattr(vexture.pages.page, "files", lambda package: tmp_path)
    with pytest.raises(DeviceError, match="the pages are not built; run `make viewer`"):
        vexture.show(TWO[0])


HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\u202e\u2028--><!--" + 9999 * "x"


def test_names_of_strangers_are_no_markup_of_a_saved_page(tmp_path):
    content = f'<svg viewBox="0 0 8 8"><rect id={quoteattr(HOSTILE)} width="8" height="8" fill="red"/></svg>'
    widget = vexture.show(vexture.read(content.encode(), name=HOSTILE, names="id"))
    widget.save(tmp_path / "names.html")
    page = (tmp_path / "names.html").read_text()
    for part in ("<script>alert", "<img src=x", "--><!--"):
        assert part not in page
