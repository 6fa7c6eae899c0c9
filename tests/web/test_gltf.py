"""Models that the command wrote, in a browser: three.js with the plugin shows what Python renders."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from mask_page import NEWEST, THREES, decode, distance

import vexture
from chromium import bundle, serve_folder
from room_model import glb_content, make_room
from vexture.cli.main import main

HALF_STEP = 0.6  # of 255: an 8-bit framebuffer rounds

PAGE = Path(__file__).parent / "pages" / "gltf.js"
LOGO = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
  <circle cx="50" cy="50" r="48" fill="#0066cc"/>
  <path d="M20 70 L50 15 L80 70 Z" fill="white"/>
  <circle id="sun" cx="30" cy="32" r="12" fill="#ffcc00" fill-opacity="0.8"/>
</svg>"""
RED = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path fill="red" d="M1 1h8v3h-5v6h-3z"/></svg>'
"""Of one colour: its texture is no map, if nobody asks for one."""

ANGLE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M1 1h8v3h-5v6h-3z"/></svg>'
"""Neither turned nor mirrored are they like themselves."""

TURNED = {"offset": (0.05, -0.2), "rotation": 30.0, "scale": (1.5, 0.75)}
INK = 0xC03020


def unlit(**attributes: int) -> bytes:
    """The model with materials that no light falls on; `attributes` are those of its floor."""
    document, binary = make_room(extensionsUsed=["KHR_materials_unlit"])
    for material in document["materials"]:
        material["extensions"] = {"KHR_materials_unlit": {}}
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = [*linear(), 1]
    if attributes:
        document["meshes"][0]["primitives"][0]["attributes"] = attributes
    return glb_content(document, binary)


def linear() -> list[float]:
    """Components of the ink as glTF has them."""
    parts = [(INK >> shift & 255) / 255 for shift in (16, 8, 0)]
    return [((part + 0.055) / 1.055) ** 2.4 for part in parts]


def prepare(folder: Path) -> None:
    """Write a drawing, models that the command and Python make, and the pages."""
    (folder / "logo.svg").write_text(LOGO, encoding="utf-8")
    (folder / "angle.svg").write_text(ANGLE, encoding="utf-8")
    (folder / "room.glb").write_bytes(unlit())
    painted = ("--material", "Sign", "--drawing", folder / "logo.svg", "--background", "none")
    for target in ("painted.glb", "painted.gltf"):
        arguments = ["gltf", folder / "room.glb", *painted, "-o", folder / target]
        outcome = CliRunner().invoke(main, list(map(str, arguments)))
        assert outcome.exit_code == 0, outcome.output
    (folder / "red.svg").write_text(RED, encoding="utf-8")
    vexture.convert(folder / "red.svg").save(folder / "red.ktx2")
    for suffix in ("svg", "ktx2"):
        source, target = folder / f"red.{suffix}", folder / f"of-{suffix}.glb"
        arguments = [
            "gltf",
            folder / "room.glb",
            "--material",
            "Sign",
            "--drawing",
            source,
            *painted[4:],
            "-o",
            target,
        ]
        outcome = CliRunner().invoke(main, list(map(str, arguments)))
        assert outcome.exit_code == 0, outcome.output
    second = vexture.read_model(unlit(POSITION=0, NORMAL=1, TEXCOORD_1=2))
    second.with_drawing("Sign", folder / "angle.svg", mode="alpha", tex_coord=1, **TURNED).save(folder / "turned.glb")
    vexture.convert(folder / "angle.svg").save(folder / "angle.ktx2")
    for three in THREES:
        bundle(PAGE, folder / f"{three}.js", three)
        icon = '<!doctype html><link rel="icon" href="data:,"><body style="margin:0">'
        (folder / f"{three}.html").write_text(f'{icon}<script type="module" src="{three}.js"></script>')


@pytest.fixture(scope="module")
def folder(made_once: Callable[..., Path]) -> Path:
    return made_once("gltf", prepare)


@pytest.fixture(scope="module")
def address(chromium: Any, folder: Path) -> Iterator[str]:
    with serve_folder(folder) as url:
        yield url


@pytest.fixture(params=NEWEST)
def page(request: pytest.FixtureRequest, address: str, open_page: Callable[..., Any]) -> Any:
    return open_page(f"{address}/{request.param}.html", keep=True)


def draw(page: Any, file: str, **config: Any) -> np.ndarray:
    return decode(page.evaluate("([file, config]) => page.draw(file, config)", [file, config])["picture"])


def inked(coverage: np.ndarray) -> np.ndarray:
    """The ink on white: blending happens in sRGB."""
    rgb = np.array([INK >> 16, INK >> 8 & 255, INK & 255]) / 255.0
    return 1.0 - coverage[..., None] * (1.0 - rgb)


def test_a_model_of_the_command_shows_the_drawing(page: Any, folder: Path, screenshot: Callable[..., Path]) -> None:
    image = vexture.convert(folder / "logo.svg").render(512)
    expected = image[..., :3] + 1.0 - image[..., 3:]
    for file in ("painted.glb", "painted.gltf"):
        assert distance(draw(page, file), expected) <= HALF_STEP
    assert distance(draw(page, "painted.glb", clone=True), expected) <= HALF_STEP
    screenshot(page.locator("canvas"))


def test_a_drawing_of_one_colour_keeps_it_on_a_model(page: Any, folder: Path) -> None:
    texture = vexture.convert(folder / "red.svg")
    (root,) = texture.roots
    assert (root.is_map, root.paint and root.paint.hex) == (False, "#ff0000")
    coverage = texture.coverage(512)
    expected = 1.0 - coverage[..., None] * [0.0, 1.0, 1.0]
    for file in ("of-svg.glb", "of-ktx2.glb"):
        assert distance(draw(page, file), expected) <= HALF_STEP


def test_texture_coordinates_are_those_of_the_second_set_and_transformed(
    page: Any, folder: Path, screenshot: Callable[..., Path]
) -> None:
    (x, y), (sx, sy), angle = TURNED["offset"], TURNED["scale"], -math.radians(TURNED["rotation"])
    c, s = math.cos(angle), math.sin(angle)
    moved = np.array([[c * sx, s * sy, x], [-s * sx, c * sy, y], [0, 0, 1]])
    over = np.array([[1, 0, 0], [0, -1, 1]])  # y goes up in the unit square, v down in glTF
    view = over @ moved @ np.diag([1 / 512, 1 / 512, 1])
    coverage = vexture.convert(folder / "angle.svg").coverage(512, view)
    assert 0.1 < coverage.mean() < 0.9
    assert distance(draw(page, "turned.glb"), inked(coverage)) <= HALF_STEP
    screenshot(page.locator("canvas"))


def test_one_call_masks_a_model(page: Any, folder: Path) -> None:
    coverage = vexture.load(folder / "angle.ktx2").coverage(512)
    picture = draw(page, "room.glb", texture="angle.ktx2", options={"materials": "Sign"}, clone=True)
    assert distance(picture, inked(coverage)) <= HALF_STEP
