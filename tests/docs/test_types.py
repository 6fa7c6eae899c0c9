"""What the README shows is typed: a strict checker has nothing to say about it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.slow  # of all that is imported; what is installed is checked as strictly by `make lint`

REVEALED = """import vexture
reveal_type(vexture.convert("a.svg"))
reveal_type(vexture.convert("a.svg", encoding="thesis"))
reveal_type(vexture.load("a.ktx2"))
vexture.coverage(vexture.load("a.ktx2"), 8, renderer="raytracer")
"""


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> str:
    """What mypy says of the README's program and of another one."""
    folder = tmp_path_factory.mktemp("types")
    (text,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S)
    (folder / "readme.py").write_text(text)
    (folder / "revealed.py").write_text(REVEALED)
    options = ["--strict", "--config-file", "", "--cache-dir", "cache"]
    command = [sys.executable, "-m", "mypy", *options, "readme.py", "revealed.py"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stdout


def test_the_readme_passes_a_strict_checker(told: str) -> None:
    assert "checked 2 source files" in told
    assert "readme.py" not in told


def test_types_depend_on_the_encoding(told: str) -> None:
    assert re.findall(r'Revealed type is "([\w.]+)"', told) == [
        "vexture.texture.texture.Texture",
        "vexture.texture.registry.EncodedTexture",
        "vexture.texture.texture.Texture",
    ]


def test_a_choice_that_there_is_not_is_an_error(told: str) -> None:
    assert "incompatible type \"Literal['raytracer']\"" in told
