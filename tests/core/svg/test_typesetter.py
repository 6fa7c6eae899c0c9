"""Setting texts: limits, and packages that are missing."""

import subprocess
import sys
from pathlib import Path

import pytest
from plainer_texts import HEBREW
from svg_texts import drawn

from vexture.base.deadline import within
from vexture.base.errors import LimitError, SourceError


def test_hostile_texts_end_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="texts have more than 200,000 characters; draw less text, or as outlines"):
        drawn(tmp_path, f"<text>{'a' * 150_000}{'<tspan/>' * 50_001}</text>")
    paths = "<text>" + "<textPath path='M0 0H9'>abcdefgh</textPath>" * 9_000 + "</text>"
    with within(0.2), pytest.raises(LimitError, match="converting takes longer than"):
        drawn(tmp_path, paths)
    far = drawn(tmp_path, '<text y="50" font-size="1e11">a</text><text y="50" letter-spacing="1e12">ab</text>')
    assert far.paths or far.notes


@pytest.mark.parametrize(
    ("package", "text", "needs"),
    [
        ("uharfbuzz", "Ship", "fonts need the package uharfbuzz"),
        ("bidi.algorithm", HEBREW, "text from right to left needs the package python-bidi"),
        ("bidi.algorithm", "Ship", ""),
    ],
)
def test_without_a_package_a_text_is_left_out(package: str, text: str, needs: str) -> None:
    program = f"""
import sys
sys.modules[{package!r}] = None
from vexture.svg.read import svg_drawing
drawing = svg_drawing('<svg viewBox="0 0 9 9"><text y="9">{text}</text></svg>'.encode(), "text.svg")
print(*drawing.notes, sep="; ")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    noted = f"<text>: {needs}; install it: pip install 'vexture[text]'; nothing in it is painted" if needs else ""
    assert done.stdout.strip() == noted
