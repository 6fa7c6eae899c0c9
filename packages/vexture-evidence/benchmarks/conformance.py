"""Conformance to SVG: one-issue fixtures of this repository, and the tests of librsvg, including W3C's of SVG 1.1.

    python packages/vexture-evidence/benchmarks/conformance.py [--only TEXT] [--folder FOLDER]

Each is drawn from its texture, and compared on white with what resvg draws, four times as large and reduced. It is
right if fewer than `MOST_OFF` of the pixels are off by more than `FAR`, or if it is as near to librsvg's own picture.
Both draw texts with the same fonts (`same_fonts.py`).
All pictures, side by side, become one page; the table of `docs/reference/conformance.md` is written again. With
`--folder`, the files of that folder are judged instead, such as a checkout of another project's tests.
"""

import argparse
import base64
import html
import io
import os
import re
import runpy
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
import resvg
from numpy.typing import NDArray
from PIL import Image

import corpora
import vexture
from chromium import ROOT
from judge import FIRST, Case, Facts, enlarge
from report import RESULTS
from same_fonts import gather, only_these, options_of_resvg
from sweep import judge_cases, known_issues
from vexture.base.errors import VextureError
from vexture.base.notes import line_of
from vexture.conversion.reading import read_drawing

SIDE: Final = 200
"""Pixels across a compared picture."""

FINER: Final = 4
"""Pixels of resvg's picture across one of ours."""

FAR: Final = 40
"""Of 255, in a channel."""

MOST_OFF: Final = 0.005
"""Part of a picture's pixels that may be further off."""

THUMBNAIL: Final = 96
"""Pixels across a picture on the page."""

OUTCOMES: Final = ("right", "named", "silent", "refused", "unjudged")
"""Right; wrong, and a note says what differs; wrong without one; an error in one line; no reference draws it."""

FIXTURES: Final = ROOT / "tests" / "core" / "svg" / "fixtures"
OTHER_FONT: Final = re.compile(r"font '.*' drawn in ")
"""Begin of a note that excuses nothing here, as the references have the same other font."""

HOSTILE: Final = "bad"
"""The fixtures that every reader must refuse."""

TEXTS: Final = "text"

PAGE: Final = ROOT / "docs" / "reference" / "conformance.md"
TABLE: Final = re.compile(r"(?<=<!-- table -->\n).*(?=<!-- end of table -->)", re.DOTALL)
GALLERY: Final = RESULTS / "conformance.html"

STYLE: Final = """body { font: 14px/1.4 system-ui, sans-serif; margin: 24px; color: #1a1c20; background: #fff }
figure { display: inline-block; width: 216px; margin: 0 12px 16px 0; vertical-align: top; overflow-wrap: anywhere }
img { width: 96px; height: 96px; object-fit: contain; border: 1px solid #d6d7da; background: #fff }
figcaption { font-size: 12px } .silent { color: #b00020 } .named { color: #805000 } .right { color: #1b6e2e }"""

Pixels = NDArray[np.int16]


def share_off(ours: Pixels, reference: Pixels) -> float:
    """Part of the pixels, (height, width, 3), of which a channel is off by more than `FAR`.

    Examples
    --------
    >>> black, white = np.zeros((2, 2, 3), np.int16), np.full((2, 2, 3), 255, np.int16)
    >>> share_off(black, black), share_off(black, white)
    (0.0, 1.0)
    """
    return float((np.abs(ours - reference).max(axis=2) > FAR).mean())


def outcome_of(facts: Facts) -> str:
    """Outcome of a case, one of `OUTCOMES`.

    Examples
    --------
    >>> outcome_of({"off": 0.001, "notes": "left out: filter"}), outcome_of({"off": 0.1, "notes": "left out: filter"})
    ('right', 'named')
    """
    if "refused" in facts:
        return "refused"
    if "off" not in facts:
        return "unjudged"
    if facts["off"] >= MOST_OFF:
        return "named" if facts["notes"] else "silent"
    return "right"


def case_facts(case: Case, fonts: Path) -> Iterator[Facts]:
    """Judge a case, in a child process; `case.same` is a picture of librsvg, or a plainer SVG."""
    try:
        drawing = read_drawing(case.content, name=case.name, fonts=[fonts])
        losses = [note for note in drawing.notes if note.is_loss and not OTHER_FONT.match(note.message)]
        yield {"notes": line_of(case.name, losses)}
    except VextureError as error:
        yield {"refused": str(error)}
        return
    try:
        yield from comparison_facts(case, drawing, fonts)
    except Exception as error:  # of the references, which refuse what we read
        yield {"unjudged": str(error) or type(error).__name__}


def comparison_facts(case: Case, drawing: vexture.Drawing, fonts: Path) -> Iterator[Facts]:
    """Draw the pictures of a case, and compare them."""
    picture = case.same is not None and case.same.startswith(b"\x89PNG")
    source = case.content if picture or case.same is None else case.same
    text, size = enlarge(source, drawing, SIDE * FINER)
    sides = max(1, round(size[0] / FINER)), max(1, round(size[1] / FINER))
    ours = draw_on_white(drawing, sides)
    yield {"ours": data_url(ours)}
    if picture:
        yield from picture_facts(drawing, case.same or b"")
    tree = resvg.usvg.Tree.from_str(text.decode(), options_of_resvg(fonts))
    image = Image.open(io.BytesIO(bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0)))))
    theirs = on_white(image).resize(sides, Image.Resampling.BOX)
    off = share_off(ours, np.asarray(theirs, np.int16))
    yield {"resvg": off, "theirs": data_url(np.asarray(theirs, np.int16))}


def picture_facts(drawing: vexture.Drawing, content: bytes) -> Iterator[Facts]:
    """Compare with librsvg's own picture, which has another size."""
    image = on_white(Image.open(io.BytesIO(content)))
    scale = min(1.0, SIDE / max(image.size))
    image = image.resize(
        (max(1, round(image.width * scale)), max(1, round(image.height * scale))), Image.Resampling.BOX
    )
    theirs = np.asarray(image, np.int16)
    yield {"own_off": share_off(draw_on_white(drawing, image.size), theirs), "theirs": data_url(theirs)}


def draw_on_white(drawing: vexture.Drawing, sides: tuple[int, int]) -> Pixels:
    """Our picture on white, from the drawing's texture."""
    width, height = sides
    side = max(sides)
    to_unit = [[1 / side, 0.0, 0.5 - 0.5 * width / side], [0.0, -1 / side, 0.5 + 0.5 * height / side]]
    image = vexture.render(drawing, sides, to_unit)
    return np.rint(255.0 * (image[..., :3] + 1.0 - image[..., 3:])).astype(np.int16)


def on_white(image: Image.Image) -> Image.Image:
    """A picture without opacity."""
    rgba = image.convert("RGBA")
    return Image.alpha_composite(Image.new("RGBA", rgba.size, "white"), rgba).convert("RGB")


def data_url(pixels: Pixels) -> str:
    """Data URL of a small picture."""
    image = Image.fromarray(pixels.astype(np.uint8))
    image.thumbnail((THUMBNAIL, THUMBNAIL))
    file = io.BytesIO()
    image.save(file, "WEBP", quality=70)
    return "data:image/webp;base64," + base64.b64encode(file.getvalue()).decode()


def fixtures() -> Iterator[tuple[str, Case]]:
    """Our fixtures by topic, that of their folder."""
    plainer = load_plainer("plainer.py", "plainer")
    of_text = load_plainer("plainer_texts.py", "plainer_text")
    for path in sorted(FIXTURES.glob("*/*.svg")):
        topic = path.parent.name
        said = of_text(path.stem) if topic == TEXTS else plainer(f"{topic}/{path.stem}")
        if topic != HOSTILE:
            yield topic, Case("fixtures", path.name, path.read_bytes(), said and said.encode())


def load_plainer(file: str, name: str) -> Callable[[str], str | None]:
    """Load a function of the tests that rewrites a fixture as plainer SVG."""
    sys.path.append(str(FIXTURES.parent))  # one of them imports another
    function: Callable[[str], str | None] = runpy.run_path(str(FIXTURES.parent / file))[name]
    return function


def tests_of_librsvg() -> Iterator[tuple[str, Case]]:
    """Tests of librsvg by topic; those of the W3C by the chapter of SVG 1.1."""
    home = corpora.LIBRSVG_TESTS.home
    for path in corpora.LIBRSVG_TESTS.files("*.svg"):
        picture = path.with_name(f"{path.stem}-ref.png")
        is_w3c = path.parent.name == "svg1.1"
        folder = home / "svg1.1" if is_w3c else home
        topic = f"W3C {path.stem.partition('-')[0]}" if is_w3c else "librsvg"
        same = picture.read_bytes() if picture.is_file() else None
        if not path.stem.endswith("-ref"):
            yield (
                topic,
                Case("w3c" if is_w3c else "librsvg", path.relative_to(folder).as_posix(), path.read_bytes(), same),
            )


def files_in(folder: Path) -> Iterator[tuple[str, Case]]:
    """Files of a folder by topic, the folder in it that holds them."""
    for path in sorted(folder.glob("*/**/*.svg")):
        topic, _, name = path.relative_to(folder).as_posix().partition("/")
        yield topic, Case(folder.name, name, path.read_bytes())


def table_of(found_of: Sequence[tuple[str, Case, Facts]]) -> str:
    """Count the cases of each topic by outcome, as a table of Markdown."""
    topics = dict.fromkeys(topic for topic, _, _ in found_of)
    head = ("topic", "tests", *OUTCOMES)
    rows = []
    for topic in topics:
        counts = Counter(facts["outcome"] for one, _, facts in found_of if one == topic)
        rows.append([topic, counts.total(), *(counts[outcome] for outcome in OUTCOMES)])
    rows.append(["all", *(sum(column) for column in list(zip(*rows, strict=True))[1:])])
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in (head, ["---"] * len(head), *rows))


def write_results(found_of: Sequence[tuple[str, Case, Facts]]) -> None:
    """Write the table into the documentation, and the page of all pictures."""
    topics = dict.fromkeys(topic for topic, _, _ in found_of)
    PAGE.write_text(TABLE.sub(f"\n{table_of(found_of)}\n\n", PAGE.read_text()))
    RESULTS.mkdir(exist_ok=True)
    parts = [f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Conformance</title><style>{STYLE}</style>']
    parts.append("<h1>Conformance</h1><p>Of each pair, ours is on the left.</p>")
    for topic in topics:
        parts.append(f"<h2>{html.escape(topic)}</h2>")
        parts += [figure(case, facts) for one, case, facts in found_of if one == topic]
    GALLERY.write_text("\n".join([*parts, "</html>"]))


def figure(case: Case, facts: Facts) -> str:
    """Two pictures of a case, with their caption."""
    said = facts.get("refused") or facts.get("known") or facts.get("notes") or ""
    pictures = "".join(
        f'<img loading="lazy" alt="{name}" src="{facts[key]}">'
        for key, name in (("ours", "ours"), ("theirs", "reference"))
        if key in facts
    )
    outcome = facts["outcome"]
    off = f", {100 * facts['off']:.1f}% off" if "off" in facts else ""
    caption = f'<b class="{outcome}">{outcome}</b>{off}: {html.escape(case.name)}<br>{html.escape(said[:300])}'
    return f"<figure>{pictures}<figcaption>{caption}</figcaption></figure>"


def complete(case: Case, facts: Facts) -> Facts:
    """Add the outcome to facts, and the reason if it is known."""
    gaps = [facts[key] for key in ("resvg", "own_off") if key in facts]
    whole = facts | ({"off": min(gaps)} if gaps else {})
    known = known_issues().get((case.corpus, case.name))
    return whole | {"outcome": outcome_of(whole)} | ({} if known is None else {"known": known})


def main() -> None:
    parser = argparse.ArgumentParser(description="What of SVG is right.")
    parser.add_argument("--only", default="", help="cases of which the topic and name have this text; writes nothing")
    parser.add_argument("--folder", type=Path, help="the files in its folders, each a topic, instead; writes nothing")
    options = parser.parse_args()
    only, folder_of_files = options.only, options.folder
    sources: Iterable[tuple[str, Case]] = (
        files_in(folder_of_files) if folder_of_files else [*fixtures(), *tests_of_librsvg()]
    )
    chosen = [(topic, case) for topic, case in sources if only in f"{topic}/{case.name}"]
    with tempfile.TemporaryDirectory() as folder:
        os.environ["FONTCONFIG_FILE"] = str(only_these(Path(folder)))
        find = partial(case_facts, fonts=gather(Path(folder)))
        list(find(Case("", "first.svg", FIRST)))  # compiles the kernels, which the time of no case includes
        facts = judge_cases([case for _, case in chosen], find)
        every = [(topic, case, complete(case, one)) for (topic, case), one in zip(chosen, facts, strict=True)]
    for topic, case, one in every:
        if only or one["outcome"] == "silent" or (folder_of_files and one["outcome"] != "right"):
            print(
                f"{one['outcome']:9} {one.get('off', 1.0):.4f} {topic}/{case.name} {one.get('died', '')}",
                file=sys.stderr,
            )
    if not only:
        print(table_of(every))
        if not folder_of_files:
            write_results(every)


if __name__ == "__main__":
    main()
