"""Drawings of a report have names that tell them apart."""

from pathlib import Path

from vexture_evidence.report.section import Material

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"


def test_files_of_one_name_are_told_apart(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "logo.svg").write_bytes((SHAPES / "duck.svg").read_bytes())
    names = [shape.name for shape in Material([tmp_path / "a" / "logo.svg", tmp_path / "b" / "logo.svg"]).shapes]
    assert names == [str(tmp_path / "a" / "logo.svg"), str(tmp_path / "b" / "logo.svg")]
