"""Colours that its page would give an SVG: of `currentColor`, custom properties, and context paints."""

import json
import warnings
from base64 import b64encode
from pathlib import Path

import click
import pytest
from click.testing import CliRunner
from PIL import ImageColor

import vexture
from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import check_losses
from vexture.cli.export import export
from vexture.cli.main import main
from vexture.cli.messages import as_options
from vexture.cli.options import viewer_parameters
from vexture.cli.view import view
from vexture.conversion.parameters import Parameters
from vexture.conversion.sprites import symbol_drawings
from vexture.server.publish_file import shape_of

SQUARE = "M0 0h4v4h-4z"
USED = (("a", "var(--first)"), ("b", "var(--second)"))
WRITTEN = {"convert": ".ktx2", "render": ".png", "gltf": "-new.gltf"}
MODEL = b'{"asset": {"version": "2.0"}, "materials": [{"name": "Door"}]}'


def svg(content: str, attributes: str = "") -> bytes:
    """A drawing of 9 by 9."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" {attributes}>{content}</svg>'.encode()


def squares(*fills: str) -> str:
    """A square of each fill."""
    return "".join(f'<path d="{SQUARE}" fill="{fill}"/>' for fill in fills)


def read(content: bytes, page_colors: dict[str, str] | None = None) -> vexture.Drawing:
    """Read a drawing without warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return vexture.read(content, name="a.svg", page_colors=page_colors)


def colors(drawing: vexture.Drawing) -> list[str]:
    """Colours of the paths, in painting order."""
    return ["#" + "".join(f"{round(255 * part):02x}" for part in path.paint.color) for path in drawing.paths]


def notes(drawing: vexture.Drawing) -> list[tuple[str, str]]:
    """Kinds of the notes, and their texts."""
    return [(note.kind, str(note)) for note in drawing.notes]


def hexadecimal(name: str) -> str:
    """A named colour as `colors` writes it."""
    return "#{:02x}{:02x}{:02x}".format(*ImageColor.getrgb(name)[:3])


@pytest.mark.parametrize(
    ("fill", "name"),
    [
        ("currentColor", "currentColor"),
        ("currentColor", "CURRENTCOLOR"),
        ("var(--primary)", "--primary"),
        ("context-fill", "context-fill"),
        ("context-stroke", "context-stroke"),
        ("color-mix(in srgb, var(--primary), var(--primary))", "--primary"),
    ],
)
def test_page_gives_a_colour(fill: str, name: str) -> None:
    drawing = read(svg(squares(fill, "red")), {name: "teal"})
    assert (colors(drawing), notes(drawing)) == ([hexadecimal("teal"), "#ff0000"], [])


def test_page_gives_a_stop_its_colour() -> None:
    stops = '<stop stop-color="var(--primary)"/><stop offset="1" stop-color="currentColor"/>'
    drawing = read(
        svg(f'<linearGradient id="a">{stops}</linearGradient>{squares("url(#a)")}'),
        {"--primary": "#00f", "currentColor": "#0f0"},
    )
    gradient = drawing.paths[0].paint.gradient
    assert gradient is not None
    assert [stop.color for stop in gradient.stops] == [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)]


@pytest.mark.parametrize(
    "attributes",
    ['color="red" style="--primary: red"', 'style="color: red; --primary: red"'],
    ids=["attribute", "style"],
)
def test_what_a_drawing_says_itself_wins(attributes: str) -> None:
    drawing = read(
        svg(squares("currentColor", "var(--primary)"), attributes), {"currentColor": "teal", "--primary": "teal"}
    )
    assert colors(drawing) == ["#ff0000", "#ff0000"]


def test_drawing_inherits_the_colour_where_it_says_so() -> None:
    assert colors(read(svg(squares("currentColor"), 'style="color: inherit"'), {"currentColor": "#f00"})) == ["#ff0000"]


def test_each_name_without_a_value_is_noted_once() -> None:
    twice = ("var(--first)", "var(--second, var(--third))", "context-fill")
    drawing = read(svg(squares(*twice, *twice, "var(--known, red)")))
    said = "which has no value (`page_colors` gives it one) (2)"
    assert notes(drawing) == [
        ("left out", f"context-fill, {said}"),
        ("invalid", f"var(--first), {said}"),
        ("invalid", f"var(--third), {said}"),
    ]
    assert [len(note.elements) for note in drawing.notes] == [2, 2, 2]


def test_element_that_is_shown_often_lacks_a_colour_once() -> None:
    content = f'<g id="a">{squares("var(--primary)")}</g><use href="#a"/><use href="#a"/>'
    assert notes(read(svg(content))) == [("invalid", "var(--primary), which has no value (`page_colors` gives it one)")]


def test_note_names_the_property_that_another_one_lacks() -> None:
    sheet = "<style>svg { --shade: var(--primary); --loop: var(--loop) }</style>"
    drawing = read(svg(sheet + squares("var(--shade)", "var(--loop)")))
    assert notes(drawing) == [
        ("invalid", "var(--primary), which has no value (`page_colors` gives it one)"),
        ("invalid", "fill='var(--loop)' of the 2nd <path> in line 1"),
    ]
    assert colors(read(svg(sheet + squares("var(--shade)")), {"--primary": "#f00"})) == ["#ff0000"]


@pytest.mark.parametrize("said", ["stroke-width: var(--width)", "font-family: var(--face)", "fill: rgb(var(--rgb))"])
def test_note_promises_no_colour_where_none_is_valid(said: str) -> None:
    (note,) = read(svg(f'<path d="{SQUARE}" style="{said}"/>')).notes
    assert note.message.endswith("), which has no value")


@pytest.mark.parametrize("only", ["", '<mask id="m"><path d="M0 0h9v9z" fill="#fff"/></mask>'])
def test_icon_in_its_own_colour_needs_no_note(only: str) -> None:
    marked = f'<g mask="url(#m)">{squares("currentColor")}</g>' if only else squares("currentColor", "currentColor")
    assert notes(read(svg(only + marked + f'<path d="{SQUARE}" opacity=".4" fill="currentColor"/>'))) == []


def test_own_colour_beside_others_is_noted() -> None:
    said = "currentColor has no value in it, and is black as in browsers (`page_colors` gives it one)"
    content = squares("currentColor", "currentColor", "red")
    assert notes(read(svg(content))) == [("remark", said)]
    assert notes(read(svg(content, 'color="black"'))) == []


def test_page_gives_no_colour_to_a_drawing_in_an_image() -> None:
    inside = b64encode(svg(squares("currentColor", "var(--primary)"))).decode()
    drawing = read(
        svg(f'<image width="9" height="9" href="data:image/svg+xml;base64,{inside}"/>' + squares("red")),
        {"currentColor": "teal", "--primary": "teal"},
    )
    assert colors(drawing) == ["#000000", "#000000", "#ff0000"]
    unused = "currentColor, --primary, which the drawing does not have; it leaves no colour to the page"
    said = [("invalid", "var(--primary), which has no value"), ("remark", f"`page_colors` names {unused}")]
    assert notes(drawing) == said


def test_strict_accepts_a_page_that_gives_what_is_missing() -> None:
    content = svg(squares("var(--primary)"))
    with pytest.raises(SourceError, match="page_colors"):
        check_losses("a.svg", read(content).notes, is_empty=False, strict=True)
    check_losses("a.svg", read(content, {"--primary": "teal"}).notes, is_empty=False, strict=True)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["teal"], r"`page_colors` is \['teal'\]; it must be a mapping of names to CSS colours"),
        (
            {"primary": "teal"},
            "`page_colors` names 'primary'; give currentColor, context-fill, context-stroke or a",
        ),
        ({"--": "teal"}, "`page_colors` names '--'; give"),
        ({1: "teal"}, "`page_colors` names 1; give"),
        ({"--primary": "tael"}, "`page_colors` gives --primary 'tael'; give a CSS colour, such as teal or #c00"),
        ({"currentColor": "currentColor"}, "`page_colors` gives currentColor 'currentColor'; give a CSS colour"),
        ({"--primary": 3}, "`page_colors` gives --primary 3; give a CSS colour"),
    ],
)
def test_other_names_and_values_are_refused(given: object, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        vexture.read(svg(squares("red")), page_colors=given)  # type: ignore[arg-type]


def test_page_colours_are_for_an_svg() -> None:
    with pytest.raises(ParameterError, match="`page_colors` --a=red is for the colours of an SVG"):
        vexture.read(b'{"type": "Point", "coordinates": [0, 0]}', page_colors={"--a": "red"})


def test_path_of_a_drawing_takes_page_colours(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_bytes(svg(squares("var(--primary)", "red")))
    drawing = vexture.read_svg(tmp_path / "a.svg", page_colors={"--primary": "#00f"})
    assert colors(drawing) == ["#0000ff", "#ff0000"]


def test_viewer_takes_page_colours() -> None:
    options = {"tolerance": "auto", "precision": None, "select": None, "split": None, "silhouette": False}
    given = viewer_parameters(**options, fonts=None, images=None, page_colors={"--primary": "#00f"})  # type: ignore[arg-type]
    facts = shape_of(svg(squares("var(--primary)")), "a.svg", "a", given).facts
    assert facts["notes"] == []
    assert shape_of(svg(squares("var(--primary)")), "a.svg", "a", Parameters()).facts["notes"] != []


def test_commands_take_page_colours(tmp_path: Path) -> None:
    file, out = tmp_path / "a.svg", tmp_path / "a.ktx2"
    file.write_bytes(svg(squares("var(--primary)", "currentColor")))
    given = ["--color", "--primary=#0000ff", "--page-color=currentColor=#f00"]
    result = CliRunner().invoke(main, ["convert", str(file), "--strict", "-o", str(out), "--split", "paint", *given])
    assert (result.exit_code, "warning" in result.output) == (0, False)
    assert [root.paint.color for root in vexture.load(out).roots if root.paint] == [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)]
    result = CliRunner().invoke(main, ["convert", str(file), "--strict", "-o", str(out)])
    assert "var(--primary), which has no value (--color gives it one)" in result.output


@pytest.mark.parametrize("command", ["convert", "render", "export", "view", "gltf"])
def test_commands_name_a_colour_without_a_name(command: str) -> None:
    result = CliRunner().invoke(main, [command, "a.svg", "--page-color", "teal"])
    assert (result.exit_code, "'teal' names no colour; give NAME=COLOR" in result.output) == (2, True)


def test_texture_has_its_colours_already(tmp_path: Path) -> None:
    vexture.convert(vexture.Drawing.polygon([(0, 0), (1, 0), (0, 1)])).save(tmp_path / "a.ktx2")
    given = ["--page-color", "--primary=teal"]
    result = CliRunner().invoke(main, ["render", str(tmp_path / "a.ktx2"), "-o", str(tmp_path / "a.png"), *given])
    said = "a.ktx2: --color --primary=teal is for a drawing; give it to vexture convert\n"
    assert (result.exit_code, result.output.endswith(said)) == (1, True)


def test_other_encodings_have_no_colours(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_bytes(svg(squares("red")))
    given = ["--encoding", "thesis", "--color", "--primary=teal"]
    result = CliRunner().invoke(main, ["convert", str(tmp_path / "a.svg"), *given])
    assert "--color --primary=teal means nothing to the encoding thesis" in result.output


@pytest.mark.parametrize(
    ("command", "option"),
    [("convert", "--color"), ("render", "--color"), ("gltf", "--page-color")],
)
def test_messages_name_the_option_of_the_command(tmp_path: Path, command: str, option: str) -> None:
    file, out = str(tmp_path / "a.svg"), str(tmp_path / ("a" + WRITTEN[command]))
    Path(file).write_bytes(svg(squares("var(--primary)", "red")))
    given = [file, "-o", out]
    if command == "gltf":
        (tmp_path / "model.gltf").write_bytes(MODEL)
        given = [str(tmp_path / "model.gltf"), "--material", "0", "--drawing", *given]
    result = CliRunner().invoke(main, [command, *given])
    assert (result.exit_code, f"which has no value ({option} gives it one)" in result.output) == (0, True)


def test_facts_name_the_option(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_bytes(svg(squares("var(--primary)", "red")))
    given = ["--json", "-o", str(tmp_path / "a.ktx2")]
    result = CliRunner().invoke(main, ["convert", str(tmp_path / "a.svg"), *given])
    (facts,) = json.loads(result.stdout)
    said = "var(--primary), which has no value (--color gives it one)"
    assert (said in facts["warning"], facts["notes"][0]["message"]) == (True, said)


@pytest.mark.parametrize(
    ("content", "given", "said"),
    [
        (
            squares("var(--primary)", "currentColor"),
            {"--primry": "teal", "currentColor": "teal"},
            "--primry, which the drawing does not have; it has --primary, currentColor",
        ),
        (
            squares(*(f"var(--a{k}, red)" for k in range(6)), "context-fill"),
            {"CURRENTCOLOR": "teal", "context-stroke": "teal"},
            "currentColor, context-stroke, which the drawing does not have; it has --a0, --a1, --a2, --a3, --a4, ...",
        ),
        (
            "<style>svg { --own: red } path { fill: var(--own) }</style>" + squares("blue"),
            {"--Own": "teal"},
            "--Own, which the drawing does not have; it leaves no colour to the page",
        ),
    ],
)
def test_names_that_a_drawing_does_not_have_are_noted(content: str, given: dict[str, str], said: str) -> None:
    found = notes(read(svg(content), given))
    assert [text for kind, text in found if kind == "remark"] == [f"`page_colors` names {said}"]


@pytest.mark.parametrize(
    "content",
    [
        f"<style>path {{ --deep: var( --primary, blue) }}</style><path d='{SQUARE}' style='fill: var(--deep)'/>",
        f'<path d="{SQUARE}"><animate attributeName="fill" from="red" to="var(--primary)" dur="1s"/></path>',
        squares("color-mix(in srgb, var(--primary), red)"),
    ],
)
def test_names_in_style_sheets_and_animations_are_not_noted(content: str) -> None:
    assert not any("which the drawing" in text for _, text in notes(read(svg(content), {"--primary": "teal"})))


def test_sprite_has_one_note_of_a_name_that_it_does_not_have() -> None:
    symbols = [f'<symbol id="{name}" viewBox="0 0 9 9">{squares(fill)}</symbol>' for name, fill in USED]
    parts = [*symbol_drawings(svg("".join(symbols)), "a.svg", page_colors={"--primry": "teal", "--second": "teal"})]
    said = "`page_colors` names --primry, which the drawing does not have; it has --first, --second"
    assert [[text for _, text in notes(part) if "does not have" in text] for part in parts] == [[said], []]


@pytest.mark.parametrize("command", [view, export], ids=lambda command: command.name)
def test_commands_of_pages_name_their_option(command: click.Command) -> None:
    with click.Context(command):
        assert as_options("`page_colors` gives it one") == "--color gives it one"
