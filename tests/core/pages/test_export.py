"""One page that holds everything."""

import base64
import hashlib
import html
import json
import re

import pytest

from typed_commands import run_command
from vexture.base.errors import DeviceError
from vexture.pages.page import SCRIPT, STYLE, built, served_page
from vexture.texture.load import texture_from
from vexture.thesis.png import read_png
from viewing import SHAPES

pytestmark = pytest.mark.usefixtures("page_is_built")

LARGEST_DUCK = 936_000


def export(*arguments):
    return run_command("export", *arguments)


def scene(text):
    return json.loads(re.search(r'<script type="application/json" id="vexture-scene">(.*?)</script>', text, re.S)[1])


def content(address):
    head, _, data = address.partition(";base64,")
    return head, base64.b64decode(data, validate=True)


@pytest.mark.parametrize(
    ("options", "names"),
    [((), ["a"]), (("--split", "paint"), ["a/1-#ff0000", "a/2-#0000ff"]), (("--silhouette",), ["a"])],
)
def test_colours_are_one_picture_or_layers_or_none(tmp_path, options, names):
    file, page = tmp_path / "a.svg", tmp_path / "page.html"
    file.write_text('<svg viewBox="0 0 9 9"><path fill="red" d="M0 0h9v9z"/><path fill="blue" d="M0 0v9h9z"/></svg>')
    outcome = export(file, "-o", page, *options)
    assert outcome.returncode == 0, outcome.stderr
    (shape,) = scene(page.read_text(encoding="utf-8"))["shapes"]
    roots = texture_from(content(shape["texture"])[1], "page").roots
    assert [root.name for root in roots] == names
    assert [root.is_map for root in roots] == [not options] * len(names)


def test_page_holds_textures_sources_and_comparisons(tmp_path):
    page = tmp_path / "page.html"
    outcome = export(SHAPES / "duck.svg", SHAPES / "hairline.svg", "-o", page, "--title", "Birds & <lines>")
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout == f"{page}: 2 files, {page.stat().st_size} bytes\n"
    text = page.read_text(encoding="utf-8")
    assert "<title>Birds &amp; &lt;lines&gt;</title>" in text
    duck, hairline = scene(text)["shapes"]
    head, texture = content(duck["texture"])
    assert head == "data:image/ktx2"
    assert texture_from(texture, "page").roots[0].name == "duck/1-#e8b100"
    assert content(duck["views"]["svg"]) == ("data:image/svg+xml", (SHAPES / "duck.svg").read_bytes())
    for bits in (8, 16):
        for address, width in zip(duck["views"][f"thesis{bits}"], (4, 2), strict=True):
            assert read_png(content(address)[1], width, "page")[0].dtype.itemsize * 8 == bits
    assert duck["facts"]["segments"] == 21
    assert duck["events"] is None
    assert "the limit is 256" in hairline["views"]["thesis8"]["error"]


@pytest.mark.parametrize("options", [(), ("--silhouette", "--select", "circle")])
def test_page_holds_what_convert_writes(tmp_path, options):
    """Byte for byte, by default; at the deep zoom of the page, the texture is larger."""
    drawing = tmp_path / "two.svg"
    drawing.write_text('<svg viewBox="0 0 9 9"><path fill="red" d="M0 0h9v9z"/><circle cx="4" cy="5" r="3"/></svg>')
    assert export(drawing, "-o", tmp_path / "page.html", "--tolerance", "1e-3", *options).returncode == 0
    assert run_command("convert", drawing, "-o", tmp_path / "two.ktx2", *options).returncode == 0
    (shape,) = scene((tmp_path / "page.html").read_text(encoding="utf-8"))["shapes"]
    ours, theirs = content(shape["views"]["converted"])[1], (tmp_path / "two.ktx2").read_bytes()
    assert [hashlib.sha256(one).hexdigest() for one in (ours, theirs)] == [hashlib.sha256(theirs).hexdigest()] * 2
    assert len(ours) < shape["bytes"]
    assert shape["facts"]["select"] == ("circle" if options else None)


@pytest.mark.parametrize("command", ["view", "export"])
def test_help_needs_no_history(command):
    assert "thesis" not in run_command(command, "--help").stdout.lower()


def test_page_fetches_nothing(tmp_path):
    page = tmp_path / "duck.html"
    assert export(SHAPES / "duck.svg", "-o", page).returncode == 0
    assert page.stat().st_size <= LARGEST_DUCK
    text = page.read_text(encoding="utf-8")
    policy = html.unescape(re.search(r'<meta http-equiv="Content-Security-Policy" content="(.*?)">', text)[1])
    assert policy.startswith("default-src 'none'; ")
    assert not re.search(r"https?:|'self'|\*", policy)
    (script,) = re.findall(r'<script type="module">(.*?)</script>', text, re.S)
    assert f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'" in policy
    assert not re.search(r"<(?:script|link|img)[^>]*(?:src|href)=\"(?!data:)", text)


def test_page_holds_the_licences_of_what_is_in_it(tmp_path):
    assert export(SHAPES / "duck.svg", "-o", tmp_path / "duck.html").returncode == 0
    text = (tmp_path / "duck.html").read_text(encoding="utf-8")
    (licences,) = re.findall(r'<script type="text/plain" id="licences">(.*?)</script>', text, re.S)
    assert "three.js authors" in licences
    assert "Permission is hereby granted" in licences


def test_names_and_texts_of_strangers_end_no_element(tmp_path):
    drawing = tmp_path / "a<!--<script>.svg"
    drawing.write_text('<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z" id="&lt;/script>" fill="&lt;/script>"/></svg>')
    page = tmp_path / "page.html"
    assert export(drawing, "-o", page).returncode == 0
    text = page.read_text(encoding="utf-8")
    assert text.lower().count("<script") == text.lower().count("</script") == 3
    assert "<!--" not in text
    assert scene(text)["shapes"][0]["name"] == "a<!--<script>"


@pytest.mark.parametrize("output", ["page.svg", "page"])
def test_output_must_be_html_and_other_files_stay(tmp_path, output):
    target = tmp_path / output
    target.write_text("mine")
    outcome = export(SHAPES / "duck.svg", "-o", target)
    assert outcome.returncode == 1
    assert ".html" in outcome.stderr
    assert target.read_text() == "mine"


def test_file_that_is_no_drawing_leaves_the_page_as_it_was(tmp_path):
    page, drawing = tmp_path / "page.html", tmp_path / "broken.svg"
    page.write_text("before")
    drawing.write_text("<svg")
    outcome = export(SHAPES / "duck.svg", drawing, "-o", page)
    assert outcome.returncode == 1
    assert outcome.stderr.startswith(f"vexture: {drawing}: not well-formed XML")
    assert len(outcome.stderr.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".svg"] == ["page.html"]
    assert page.read_text() == "before"


def test_page_that_is_not_built_names_the_remedy():
    remedy = r"run `make viewer` in the repository \(needs node and npm\), or install a wheel, which holds them"
    with pytest.raises(DeviceError, match=f"not built; {remedy}$"):
        built("nothing.js")


def test_served_page_names_its_files():
    text = served_page().decode()
    assert f'src="{SCRIPT}"' in text
    assert f'href="{STYLE}"' in text
