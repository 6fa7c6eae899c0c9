"""The Vite plugin in projects of real Vite: builds, a development server, with and without the Python program."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

import vexture
from build_wasm import OUTPUT
from chromium import ROOT, WEB, serve_folder
from guides import free_port
from viewing import PATIENCE, until

FIXTURES = WEB / "test" / "fixtures"
VITE = WEB / "node_modules" / "vite" / "bin" / "vite.js"
HOSTILE = "a & b's $(touch evil) %41#é"
"""Name of a drawing, but for its suffix."""

CONFIG = "import vexture from 'vexture/vite';\nexport default {{ plugins: [vexture({options})] }};\n"
NODE = shutil.which("node") or "node"


class Project:
    """A project of Vite, whose own environment of Python has a converter: that of this checkout."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.calls = folder, folder / "calls"
        for name in ("vexture", "vite"):
            modules = folder / "node_modules"
            modules.mkdir(exist_ok=True, parents=True)
            (modules / name).symlink_to(WEB if name == "vexture" else WEB / "node_modules" / "vite")
        (folder / "package.json").write_text('{"type": "module"}', encoding="utf-8")
        (folder / "index.html").write_text('<script type="module" src="/main.js"></script>', encoding="utf-8")
        self.program(folder / ".venv" / "bin" / "vexture", "-m vexture")
        self.configure()

    def configure(self, options: str = "") -> None:
        (self.folder / "vite.config.js").write_text(CONFIG.format(options=options), encoding="utf-8")

    def program(self, path: Path, arguments: str) -> None:
        """Write a program that is this Python, and tells what it is asked for."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#!/bin/sh\necho "$@" >> "{self.calls}"\nexec "{sys.executable}" {arguments} "$@"\n')
        path.chmod(0o755)

    def imports(self, *names: str) -> None:
        lines = [f"import a{k} from {f'./{name}'!r};\nconsole.log(a{k});" for k, name in enumerate(names)]
        (self.folder / "main.js").write_text("\n".join(lines), encoding="utf-8")

    def conversions(self) -> int:
        """How many there were since the last question."""
        text = self.calls.read_text() if self.calls.exists() else ""
        self.calls.unlink(missing_ok=True)
        return len(re.findall(r"^.*convert .*--output", text, re.M))

    def build(self, **environment: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [NODE, VITE, "build", "--logLevel", "warn"],
            cwd=self.folder,
            env=os.environ | environment,
            capture_output=True,
            text=True,
        )

    def remove_python(self) -> dict[str, str]:
        """Leave npm alone; return the environment of the builds, in which no program is found."""
        shutil.rmtree(self.folder / ".venv")
        empty = self.folder / "no-programs"
        empty.mkdir()
        return {"PATH": str(empty)}

    def built(self, **environment: str) -> list[Path]:
        outcome = self.build(**environment)
        assert outcome.returncode == 0, outcome.stdout + outcome.stderr
        return sorted((self.folder / "dist" / "assets").glob("*.ktx2"))

    @contextmanager
    def served(self, **environment: str) -> Any:
        port = free_port()
        command = [NODE, VITE, "--port", str(port), "--strictPort", "--host", "127.0.0.1"]
        into: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with subprocess.Popen(command, cwd=self.folder, env=os.environ | environment, **into) as server:
            try:
                with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=PATIENCE) as client:
                    yield client
            finally:
                server.terminate()


def need_kernels() -> None:
    """Skip where the npm package has no kernels."""
    if not (OUTPUT / "silhouettes.wasm").is_file():
        pytest.skip("no kernels (make wasm)")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    if not VITE.is_file():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    return Project(tmp_path / "project")


def answered(client: httpx.Client, path: str) -> httpx.Response | None:
    try:
        return client.get(path)
    except httpx.TransportError:
        time.sleep(0.05)
        return None


@pytest.mark.slow
def test_a_build_has_the_textures_under_names_of_their_content(project: Project) -> None:
    shutil.copy(FIXTURES / "badge.svg", project.folder / f"{HOSTILE}.svg".replace("#", ""))
    shutil.copy(FIXTURES / "elements.svg", project.folder)
    name = f"{HOSTILE}.svg".replace("#", "")
    project.imports(f"{name}?vexture", "elements.svg?restyle&vexture")
    one, other = project.built()
    assert project.conversions() == 2
    script = next((project.folder / "dist" / "assets").glob("*.js")).read_text(encoding="utf-8")
    for path in (one, other):
        assert re.fullmatch(r"[\w.-]+-[\w-]{8}\.ktx2", path.name)
        assert f"/assets/{path.name}" in script
    assert vexture.load(one).roots[0].name == Path(name).stem
    assert vexture.load(other).roots[0].style is not None
    assert not list(project.folder.glob("evil*"))
    assert project.built() == [one, other]
    assert project.conversions() == 0, "the cache has them"
    project.imports(f"{name}?vexture", "elements.svg?restyle&precision=1e-3&vexture")
    assert other not in project.built()
    assert project.conversions() == 1, "of what has other options"


def test_the_server_shows_the_texture_and_every_save_of_the_drawing(project: Project, tmp_path: Path) -> None:
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports("logo.svg?vexture")

    def digest(client: httpx.Client) -> str | None:
        module = answered(client, "/logo.svg?import&vexture")
        found = module and re.search(r'from "(/[^"]+\.ktx2\?[^"]*)"', module.text)
        if not found:
            return None
        (address,) = re.findall(r'export default "([^"]+)"', client.get(found[1]).text)
        return sha256(client.get(address).content).hexdigest()

    shutil.rmtree(project.folder / ".venv")
    project.program(tmp_path / "bin" / "vexture", "-m vexture")
    with project.served(PATH=f"{tmp_path / 'bin'}:{os.environ['PATH']}") as client:
        badge = until(lambda: digest(client))
        assert (
            badge
            == sha256(next(project.folder.glob("node_modules/.cache/vexture/*/logo.ktx2")).read_bytes()).hexdigest()
        )
        shutil.copy(FIXTURES / "flag.svg", project.folder / "logo.svg")
        flag = until(lambda: found if (found := digest(client)) != badge else None)
        assert flag != badge
        assert project.conversions() == 2


DRAWN = """
import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';
import logo from './red.svg?vexture';

const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(16, 16);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xffffff);
const texture = await new VectorTextureLoader().loadAsync(logo);
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorMaterial({ texture })));
renderer.render(scene, new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1));
const gl = renderer.getContext();
window.colors = [[8, 8], [1, 1]].map(([x, y]) => {
  const pixel = new Uint8Array(4);
  gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return [...pixel];
});
"""
RED = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><path fill="red" d="M2 2h4v4h-4z"/></svg>"""


def test_a_drawing_of_one_colour_is_drawn_in_it(project: Project, open_page: Callable[..., Any]) -> None:
    (project.folder / "node_modules" / "three").symlink_to(WEB / "node_modules" / "three")
    (project.folder / "red.svg").write_text(RED, encoding="utf-8")
    (project.folder / "main.js").write_text(DRAWN, encoding="utf-8")
    page = '<!doctype html><link rel="icon" href="data:,"><body><script type="module" src="/main.js"></script>'
    (project.folder / "index.html").write_text(page, encoding="utf-8")
    (texture,) = project.built()
    (root,) = vexture.load(texture).roots
    assert (root.is_map, root.paint and root.paint.hex) == (False, "#ff0000")
    with serve_folder(project.folder / "dist") as address:
        shown = open_page(address)
        shown.wait_for_function("window.colors")
        assert shown.evaluate("colors") == [[255, 0, 0, 255], [255, 255, 255, 255]]


def test_each_build_tells_what_a_drawing_loses(project: Project) -> None:
    shapes = '<foreignObject width="4" height="4"/><path d="M5 5h2v2z" fill="red"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8">{shapes}</svg>'
    (project.folder / "logo.svg").write_text(svg, encoding="utf-8")
    project.imports("logo.svg?vexture")
    for conversions in (1, 0):
        outcome = project.build()
        assert "logo.svg: left out: <foreignObject>" in outcome.stderr
        assert "compiling" not in outcome.stderr
        assert project.conversions() == conversions


@pytest.mark.parametrize(
    ("query", "message"),
    [
        ("logo.svg?vexture&presision=1", "logo.svg: no option is named presision; there are silhouette, restyle"),
        ("logo.svg?vexture&precision=much", "logo.svg: Invalid value for '--precision'"),
    ],
)
def test_what_is_wrong_is_said(project: Project, query: str, message: str) -> None:
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports(query)
    outcome = project.build()
    assert outcome.returncode == 1
    assert message in outcome.stderr


def assert_same(file: Path, drawing: Path, **options: Any) -> None:
    """A texture has the texels, and so the picture, of Python's conversion."""
    texture, ours = vexture.load(file), vexture.convert(drawing, **options)
    texture.check()
    assert np.array_equal(texture.flat, ours.flat)
    for one, other in zip(texture.roots, ours.roots, strict=True):
        assert (one.name, one.quad, one.is_map, one.paint) == (other.name, other.quad, other.is_map, other.paint)
        assert np.array_equal(one.to_source, other.to_source)


def test_npm_alone_builds_the_textures_of_python(project: Project) -> None:
    need_kernels()
    environment = project.remove_python()
    drawing = Path(shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg"))
    project.imports("logo.svg?vexture", "logo.svg?vexture&silhouette&precision=1e-3&max-depth=12")
    files = project.built(**environment)
    assert len(files) == 2
    one, other = sorted(files, key=lambda file: not vexture.load(file).roots[0].is_map)
    assert_same(one, drawing)
    assert_same(other, drawing, split=None, precision=1e-3, max_depth=12)
    assert project.conversions() == 0
    assert project.built(**environment) == files, "the cache has them"


def test_npm_alone_has_the_choice_where_python_is_too(project: Project) -> None:
    need_kernels()
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports("logo.svg?vexture")
    project.configure("{ converter: false }")
    (file,) = project.built()
    assert vexture.load(file).roots[0].is_map
    assert not project.calls.exists(), "the program is not run"


def test_npm_alone_tells_what_a_drawing_loses(project: Project) -> None:
    need_kernels()
    environment = project.remove_python()
    blurred = '<rect width="4" height="4" filter="blur(1px)"/><path d="M5 5h2v2z" fill="red"/>'
    (project.folder / "logo.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8">{blurred}</svg>', encoding="utf-8"
    )
    project.imports("logo.svg?vexture")
    for _ in range(2):
        outcome = project.build(**environment)
        assert outcome.returncode == 0
        assert "logo.svg: left out: filter of blur" in outcome.stderr
    project.imports("logo.svg?vexture&strict")
    outcome = project.build(**environment)
    assert outcome.returncode == 1
    assert re.search("logo.svg: left out: filter of blur.*; leave out `strict`, or change the drawing", outcome.stderr)


@pytest.mark.parametrize(
    ("query", "message"),
    [
        ("select=.a", "logo.svg: select needs the Python program, which is not installed: pip install vexture"),
        ("trace-images", "logo.svg: traceImages needs the Python program, which is not installed: pip install vexture"),
        ("snap=0.1", "logo.svg: snap needs the Python program, which is not installed: pip install vexture"),
        ("presision=1", "logo.svg: no option is named presision; there are silhouette, restyle"),
        ("precision=much", 'logo.svg: `precision` "much" is no number in '),
        ("tolerance=", 'logo.svg: `tolerance` "" is no number from 0'),
    ],
)
def test_npm_alone_refuses_what_it_cannot_do(project: Project, query: str, message: str) -> None:
    need_kernels()
    environment = project.remove_python()
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports(f"logo.svg?vexture&{query}")
    outcome = project.build(**environment)
    assert outcome.returncode == 1
    assert message in outcome.stderr


def test_a_python_without_vexture_is_no_converter(project: Project, tmp_path: Path) -> None:
    need_kernels()
    project.remove_python()
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports("logo.svg?vexture")
    for name in ("python3", "python"):
        project.program(tmp_path / "bin" / name, "-I -S")  # it has no packages
    (file,) = project.built(PATH=f"{tmp_path / 'bin'}:/nowhere")
    assert vexture.load(file).roots[0].is_map
    assert len(project.calls.read_text().splitlines()) == 2, "both were tried"
    assert project.conversions() == 0


def test_a_chosen_converter_that_does_not_run_is_one_line(project: Project) -> None:
    shutil.copy(FIXTURES / "badge.svg", project.folder / "logo.svg")
    project.imports("logo.svg?vexture")
    project.configure("{ converter: 'vexturn' }")
    outcome = project.build()
    assert outcome.returncode == 1
    assert "the converter vexturn does not run; correct the option, or leave it out" in outcome.stderr


def test_a_converter_is_found_in_python(project: Project, tmp_path: Path) -> None:
    (project.folder / "logo.svg").write_text("nothing")
    shutil.rmtree(project.folder / ".venv")
    (project.folder / "vexture").mkdir()  # a module of this name in the project is not the converter
    project.program(tmp_path / "bin" / "python3", "")
    project.imports("logo.svg?vexture")
    outcome = project.build(
        PATH=f"{tmp_path / 'bin'}:/usr/bin:/bin", PYTHONPATH=str(ROOT / "packages" / "vexture" / "src")
    )
    assert "logo.svg: holds nothing that can be read" in outcome.stderr
    assert project.calls.read_text().splitlines()[0] == "-P -m vexture --version"
