"""`vexture.show` without a browser: what it takes and refuses, what its widget holds, and what it sends."""

import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
from PIL import Image

import vexture
from vexture.base.errors import DeviceError, ParameterError

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
traitlets = pytest.importorskip("traitlets")
pytestmark = pytest.mark.usefixtures("page_is_built")

FLAG = b"""<svg viewBox="0 0 8 8"><rect id="low" width="8" height="8" fill="#123"/>
<rect id="up" width="8" height="4" fill="red"/></svg>"""
FADING = b"""<svg viewBox="0 0 8 8"><linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/>
</linearGradient><rect id="low" width="8" height="8" fill="url(#g)"/></svg>"""
TWO = [vexture.Drawing.polygon([(0, 0), (1, 0), (0, 1)]), vexture.Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)])]


@pytest.fixture(autouse=True)
def none_is_left():
    """Close the widgets of a test: those of all tests share bytes."""
    import ipywidgets

    yield
    ipywidgets.Widget.close_all()


@pytest.fixture
def flag():
    return vexture.show(vexture.read(FLAG, name="flag"))


@pytest.fixture
def pair():
    from dataclasses import replace

    return vexture.atlas([replace(drawing, name=name) for name, drawing in zip("ab", TWO, strict=True)])


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


def test_a_picture_is_of_the_view_the_mode_and_the_colours(flag):
    flag.view = (0, 0.5, 0.5, 0.5)
    assert flag.render(1)[0, 0].tolist() == [1, 0, 0, 1]
    flag.colors = {"up": "lime"}
    assert flag.render(1)[0, 0].tolist() == [0, 1, 0, 1]
    flag.mode = "silhouette"
    assert flag.render(1)[0, 0].tolist() == [0, 0, 0, 1]
    flag.width, flag.height = 30, 20
    assert flag.render().shape == (20, 30, 4)


def test_colours_go_to_the_page_as_numbers(flag):
    flag.colors = {"low": "#0f08", "up": (0.25, 0.5, 1)}
    sent = flag.get_state("colors")["colors"]
    assert sent == {"low": [0, 1, 0, pytest.approx(0.533333)], "up": [0.25, 0.5, 1, 1]}
    flag.colors = {"low": None}
    assert flag.get_state("colors")["colors"] == {"low": [0, 0, 0, 0]}


def test_a_silhouette_is_coloured_by_its_own_name(pair):
    widget = vexture.show(pair, root="a", colors={"a": "gold"})
    assert widget.render(9)[4, 3].tolist() == pytest.approx([1, 215 / 255, 0, 1])
    with pytest.raises(ParameterError, match="no shape 'b', and it has no elements; its shapes are 'a'"):
        widget.colors = {"b": "gold"}


def test_another_drawing_is_shown_whole_unless_the_view_was_chosen(pair):
    widget = vexture.show(pair, root="a")
    whole = widget.view
    widget.root = "b"
    assert widget.view != whole
    assert widget.view == widget._home
    widget.view = chosen = (0.25, 0.25, 0.5, 0.5)
    widget.root = "a"
    assert widget.view == chosen


@pytest.mark.parametrize(
    ("trait", "value", "said"),
    [
        ("colors", {"middle": "red"}, r"flag: no element 'middle'; near names are 'low', 'up'; there are 2"),
        ("colors", {"up": "reddish"}, r"the colour of 'up' is 'reddish'; give a CSS colour"),
        ("colors", {"up": "#f008"}, r"'up' gets the opacity 0.533333, but the texture does not have what it hides"),
        ("background", "reddish", r"`background` is 'reddish'; give a CSS colour"),
        ("root", "x", r"flag: no shape 'x'; there is 'flag'"),
        ("view", (0, 0, 0, 1), r"`view` is 0,0,0,1 turned by 0 degrees; all must be finite, w and h above 0"),
    ],
)
def test_what_cannot_be_shown_is_refused_and_nothing_changes(flag, trait, value, said):
    before = getattr(flag, trait)
    with pytest.raises(ParameterError, match=said):
        setattr(flag, trait, value)
    assert getattr(flag, trait) == before


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


def test_linked_widgets_have_one_view(flag):
    other = vexture.show(flag.texture)
    link = traitlets.link((flag, "view"), (other, "view"))
    flag.view = (0, 0, 0.5, 0.5)
    assert other.view == flag.view
    other.view = (0.5, 0, 0.5, 0.5)
    assert flag.view == other.view
    link.unlink()


def test_a_picture_stands_in_where_there_are_no_widgets(tmp_path, flag):
    import base64

    flag.width, flag.height, flag.background = 8, 8, "blue"
    flag.view = (-0.5, -0.5, 1, 1)
    data, _ = flag._repr_mimebundle_()
    assert {"text/plain", "image/png", "application/vnd.jupyter.widget-view+json"} <= set(data)
    assert data["text/plain"] == "<VectorWidget 'flag': view -0.5, -0.5, 1, 1>"
    (tmp_path / "mime.png").write_bytes(base64.b64decode(data["image/png"]))
    flag.save(tmp_path / "saved.png")
    for name in ("mime.png", "saved.png"):
        with Image.open(tmp_path / name) as picture:
            assert (picture.mode, picture.size) == ("RGB", (8, 8))
            assert [picture.getpixel(place) for place in ((1, 1), (6, 1))] == [(0, 0, 255), (17, 34, 51)]
    flag.background = "transparent"
    flag.save(tmp_path / "clear.png")
    with Image.open(tmp_path / "clear.png") as picture:
        assert picture.getpixel((1, 1)) == (0, 0, 0, 0)
    with pytest.raises(ParameterError, match=r"name one that ends in \.html"):
        flag.save(tmp_path / "flag.txt")


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
