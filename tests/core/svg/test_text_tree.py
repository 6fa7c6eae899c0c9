"""The elements of a text, and which characters are whose."""

from pathlib import Path

import pytest
from svg_texts import drawn

from vexture.base.errors import LimitError


def test_a_text_has_one_name_unless_a_part_has_its_own(tmp_path: Path) -> None:
    body = '<text id="t" y="50">a<tspan fill="red">b</tspan><tspan id="s" stroke="blue">c</tspan>d</text>'
    assert [path.element for path in drawn(tmp_path, body).paths] == ["t", "t", "s", "s/stroke", "t"]


def test_a_part_of_a_text_can_be_selected(tmp_path: Path) -> None:
    body = '<text x="10" y="50" fill="red">one <tspan class="s" fill="blue">two</tspan></text>'
    whole, part = drawn(tmp_path, body), drawn(tmp_path, body, select=".s")
    assert [path.paint.hex for path in whole.paths] == ["#ff0000", "#0000ff"]
    assert [path.paint.hex for path in part.paths] == ["#0000ff"]
    assert (part.paths[0].contours[0] == whole.paths[1].contours[0]).all()
    with pytest.raises(LimitError, match="matches 1 element that paints nothing"):
        drawn(tmp_path, '<text><tspan class="s"> </tspan></text><path d="M0 0H9V9"/>', select=".s")
