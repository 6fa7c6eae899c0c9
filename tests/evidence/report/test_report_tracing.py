"""The section on tracing, where there is nothing to trace or no package for it."""

import pytest

from vexture.base.errors import DeviceError
from vexture_evidence.report import tracing
from vexture_evidence.report.section import Material

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="{}"/></svg>'


def material(tmp_path, path):
    (tmp_path / "drawing.svg").write_text(SVG.format(path))
    return Material([tmp_path / "drawing.svg"])


def test_a_full_square_has_no_outline_to_trace(tmp_path):
    found = tracing.section(material(tmp_path, "M0 0H10V10H0Z"))
    assert (found.anchor, found.items) == ("tracing", ())
    assert found.text[-1] == "drawing shows no outline to trace."


def test_without_its_package_the_section_says_so(tmp_path, monkeypatch):
    def lacking(*_):
        raise DeviceError("there is no tracer")

    monkeypatch.setattr(tracing, "_row", lacking)
    found = tracing.section(material(tmp_path, "M2 2H8V8H2Z"))
    assert found.items == ()
    assert found.text[-1] == "Not measured here: there is no tracer."


@pytest.mark.parametrize("side", [64, 128])
def test_a_traced_square_is_near_the_true_one(tmp_path, side):
    drawing = material(tmp_path, "M2 2H8V8H2Z").main.drawing
    row = tracing._row(drawing, tracing.coverage(drawing, (side, side), renderer="exact"))
    assert row[0] == str(side)
    assert row[3] >= 4
    assert 0.0 <= row[5] < 0.5  # pixels
    assert row[6] == pytest.approx(1000.0 * row[5] / side)
