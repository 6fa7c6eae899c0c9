"""The section on the tree and its lists."""

import pytest

from vexture_evidence.report import structure
from vexture_evidence.report.section import Material, Section, Table

pytestmark = pytest.mark.slow  # test_report_is_whole makes these sections too


@pytest.fixture(scope="module")
def examples():
    """Three of the examples, as a report without sources has them."""
    material = Material([])
    material.shapes = tuple(map(material.example, ("simple-small", "duck", "ocean")))
    return material


def tables(section):
    return {item.name: item for item in section.items if isinstance(item, Table)}


def test_structure_counts_what_the_trees_hold(examples):
    section = structure.section(examples)
    assert isinstance(section, Section)
    rows = {row[0]: row[1:] for row in tables(section)["cells"].rows}
    assert [cell.value for cell in rows["thesis, printed"]] == [29, 56, 172, 65536, 0.26]
    tree = examples.main.way("direct").tree
    quads, curves = len(tree.kind), len(tree.curves)
    grid = 4 ** (1 + int(tree.quad_depth.max()))
    assert rows["direct"] == [quads, curves, 4 * quads + curves, grid, 100 * (4 * quads + curves) / grid]
    assert [item.name for item in section.items][-2:] == ["depths", "textures"]
