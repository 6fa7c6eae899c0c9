"""What the page of conformance says of a drawing."""

import io
from pathlib import Path

import pytest
from PIL import Image

from conformance import case_facts, complete, figure, files_in, table_of
from judge import Case, Facts
from same_fonts import gather

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'
SQUARE = '<path d="M20 20h60v60h-60z" fill="#c03020"/>'
OTHER = '<path d="M10 10h60v60h-60z" fill="#c03020"/>'
WORD = '<text x="5" y="60" font-size="30" font-weight="bold" font-family="{}">Ships</text>'


def picture(side: int, left: int) -> bytes:
    image = Image.new("RGB", (side, side), "white")
    image.paste((192, 48, 32), (left, left, left + 6 * side // 10, left + 6 * side // 10))
    file = io.BytesIO()
    image.save(file, "PNG")
    return file.getvalue()


@pytest.fixture(scope="module")
def fonts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return gather(tmp_path_factory.mktemp("fonts"))


def facts_of(fonts: Path, body: str, same: bytes | None = None) -> Facts:
    case = Case("fixtures", "a.svg", SVG.format(body).encode(), same)
    facts: Facts = {}
    for part in case_facts(case, fonts):
        facts |= part
    facts = complete(case, facts)
    assert facts["outcome"] in figure(case, facts)
    return facts


@pytest.mark.parametrize(
    ("body", "same", "outcome"),
    [
        (SQUARE, None, "right"),
        (SQUARE, SVG.format(SQUARE).encode(), "right"),
        (SQUARE, SVG.format(OTHER).encode(), "silent"),
        (SQUARE + "<foreignObject/>", SVG.format(OTHER).encode(), "named"),
        (SQUARE, picture(200, 40), "right"),
        (SQUARE, picture(50, 10), "right"),
        (WORD.format("sans-serif"), None, "right"),
        (WORD.format("No Such Font"), None, "right"),
        (WORD.format("No Such Font"), SVG.format(WORD.format("DejaVu Serif")).encode(), "silent"),
        (SQUARE, picture(200, 0), "right"),
        ("<g", None, "refused"),
    ],
)
def test_outcomes(fonts: Path, body: str, same: bytes | None, outcome: str) -> None:
    assert facts_of(fonts, body, same)["outcome"] == outcome


def test_files_of_a_folder_are_judged_by_topic(tmp_path: Path) -> None:
    for name in ("masks/clip/a", "masks/b", "shapes/c"):
        file = (tmp_path / name).with_suffix(".svg")
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(SVG.format(SQUARE))
    files = list(files_in(tmp_path))
    assert [(topic, case.name) for topic, case in files] == [
        ("masks", "b.svg"),
        ("masks", "clip/a.svg"),
        ("shapes", "c.svg"),
    ]
    outcomes = ("right", "silent", "right")
    every = [(topic, case, {"outcome": outcome}) for (topic, case), outcome in zip(files, outcomes, strict=True)]
    assert [line.split(" | ")[:5] for line in table_of(every).splitlines()[2:]] == [
        ["| masks", "2", "1", "0", "1"],
        ["| shapes", "1", "1", "0", "0"],
        ["| all", "3", "2", "0", "1"],
    ]
