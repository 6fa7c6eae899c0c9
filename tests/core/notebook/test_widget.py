"""The widget of a drawing without a browser: what it holds, sends and refuses."""

import pytest
from PIL import Image

import vexture
from vexture.base.errors import ParameterError

pytest.importorskip("anywidget", reason="anywidget is not installed (pip install 'vexture[notebook]')")
traitlets = pytest.importorskip("traitlets")
pytestmark = pytest.mark.usefixtures("page_is_built")


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
