"""HarfBuzz's own shaping tests, through the call of HarfBuzz that sets texts in pages.

    python packages/vexture-evidence/benchmarks/shaping.py --harfbuzz FOLDER [--list]

`FOLDER` is a checkout of https://github.com/harfbuzz/harfbuzz. Its tests are lines with a font, options of `hb-shape`,
characters, and the glyphs that come of them. `web/src/typeset` shapes the same characters in Node.js. A line is

- equal, if all glyphs are the same, with the same places and clusters, where the line has them,
- different otherwise; `--list` names those lines,
- not ours, if it needs something that texts do not have: a buffer's flag, a direction from bottom to top, a second font
  of a file. The table counts these by what they need.

Lines whose fonts are in the system, those of other shapers than HarfBuzz's own, and those that it is known to fail, are
left out. Pages have the build of the package harfbuzzjs, whose README says what it lacks (`HB_TINY`).
"""

import argparse
import json
import re
import subprocess
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import accumulate
from pathlib import Path
from typing import Any, Final, NamedTuple

import uharfbuzz

from report import table, write_json

SUITES: Final = ("in-house", "text-rendering-tests", "aots")
"""Folders below `test/shape/data`."""

TAKEN: Final = frozenset(
    (
        *(
            "ned",
            "no-glyph-names",
            "no-clusters",
            "no-positions",
            "no-advances",
            "show-flags",
            "show-extents",
            "verify",
        ),
        *("features", "direction", "language", "variations", "font-size", "unicodes-before", "unicodes-after"),
        *("remove-default-ignorables", "single-par", "unsafe-to-concat", "shaper", "font-funcs", "face-loader"),
    )
)
"""Options that change what is printed, or that texts have, too."""

GLYPH: Final = re.compile(
    r"(?P<name>[^=@+#<|]+)(?:=(?P<cluster>\d+))?(?:@(?P<x>-?\d+),(?P<y>-?\d+))?(?:\+(?P<over>-?\d+)(?:,(?P<up>-?\d+))?)?"
    r"(?:#[0-9A-Fa-f]+)?(?:<[^>]*>)?"
)

ROUNDED: Final = 1.0
"""Units by which a place may be off where a size is not the font's own, for each glyph before it: HarfBuzz rounds."""

IGNORABLE: Final = (
    *((code, code) for code in (0xAD, 0x34F, 0x61C, 0x115F, 0x1160, 0x17B4, 0x17B5, 0x3164, 0xFEFF, 0xFFA0)),
    *((0x180B, 0x180F), (0x200B, 0x200F), (0x202A, 0x202E), (0x2060, 0x206F), (0xFE00, 0xFE0F), (0xE0000, 0xE0FFF)),
)
"""Characters that show nothing, where a font has no glyph for them."""

NATIVE: Final = "ot"
"""HarfBuzz's own shaper, and its own functions of fonts."""


class Line(NamedTuple):
    """A line of a test."""

    file: str
    font: Path
    options: dict[str, str]
    characters: list[int]
    expected: str
    text: str


def characters_of(text: str) -> list[int]:
    """Code points of a list such as `U+0041,U+0042`.

    Examples
    --------
    >>> characters_of("U+0041,0042")
    [65, 66]
    """
    return [
        int(part.strip().removeprefix("<").removesuffix(">").removeprefix("U+"), 16)
        for part in text.split(",")
        if part.strip()
    ]


def options_of(text: str) -> dict[str, str]:
    """Options by their names.

    Examples
    --------
    >>> options_of("--ned --features=liga,-kern --font-size 10")
    {'ned': '', 'features': 'liga,-kern', 'font-size': '10'}
    """
    found: dict[str, str] = {}
    last = ""
    for word in text.split():
        if word.startswith("--"):
            last, _, value = word[2:].partition("=")
            found[last] = value.strip("\"'")
        elif last:
            found[last] = f"{found[last]} {word}".strip().strip("\"'")
    return found


def lines_of(path: Path) -> Iterator[Line]:
    """Lines of a file of tests."""
    allowed = True
    for row in path.read_text(encoding="utf-8").splitlines():
        text = row.strip()
        if text.startswith("@"):
            name, _, values = text[1:].partition("#")[0].partition("=")
            if not name.startswith("face"):
                allowed = (NATIVE in re.split(r"[,\s]+", values.strip())) is not name.endswith("-")
        if not text or text[0] in "#@/" or not allowed:
            continue
        font, options, characters, expected = text.split(";")
        found = options_of(options)
        if any(found.get(name, NATIVE) != NATIVE for name in ("shaper", "font-funcs", "face-loader")):
            continue
        yield Line(path.name, path.parent / font, found, characters_of(characters), expected, text)


@cache
def face_of(path: Path) -> uharfbuzz.Face:
    return uharfbuzz.Face(uharfbuzz.Blob.from_file_path(str(path)))


def need_of(line: Line, direction: str) -> str:
    """What a line needs that texts do not have; empty if they have all."""
    others = sorted(set(line.options) - TAKEN)
    if others:
        return " ".join(f"--{name}" for name in others)
    if direction not in ("ltr", "rtl", "ttb"):
        return f"direction {direction}"
    surrogates = any(0xD800 <= code < 0xE000 or code > 0x10FFFF for code in line.characters)
    return "characters that are none" if surrogates else ""


def direction_of(line: Line) -> str:
    """The direction of a line, as HarfBuzz guesses it."""
    chosen = line.options.get("direction", "")
    if chosen:
        return {"l": "ltr", "r": "rtl", "t": "ttb", "b": "btt"}[chosen[0].lower()]
    buffer = uharfbuzz.Buffer()
    buffer.add_codepoints(line.characters)
    if "script" in line.options:
        buffer.script = line.options["script"]
    buffer.guess_segment_properties()
    return str(buffer.direction)


def variations_of(text: str) -> dict[str, float]:
    parts = (part.partition("=") for part in text.replace(" ", "").split(",") if part)
    return {tag: float(value) for tag, _, value in parts}


def request_of(line: Line, direction: str) -> dict[str, Any]:
    """A line as `shaping.mjs` takes it."""
    text, before, after = (
        "".join(map(chr, codes))
        for codes in (
            line.characters,
            *(characters_of(line.options.get(f"unicodes-{side}", "")) for side in ("before", "after")),
        )
    )
    return {
        "font": str(line.font),
        "before": before,
        "text": text,
        "after": after,
        "direction": direction,
        "language": line.options.get("language", ""),
        "features": line.options.get("features", ""),
        "variations": variations_of(line.options.get("variations", "")),
    }


def glyph_of(face: uharfbuzz.Face, name: str) -> int:
    if found := re.fullmatch(r"gid(\d+)|(\d+)", name):
        return int(found[1] or found[2])
    return int(uharfbuzz.Font(face).glyph_from_string(name))


def is_equal(line: Line, answer: dict[str, Any]) -> bool:
    """Whether an answer has the expected glyphs, and what else the line says of them."""
    if line.expected == "*":
        return True
    face = face_of(line.font)
    parts = [found for part in line.expected[1:-1].split("|") if part and (found := GLYPH.fullmatch(part))]
    kept = [
        k
        for k in range(len(answer["glyphs"]))
        if "remove-default-ignorables" not in line.options or not is_hidden(line, answer, k)
    ]
    if [answer["glyphs"][k] for k in kept] != [glyph_of(face, part["name"]) for part in parts]:
        return False
    scale = float(line.options.get("font-size", answer["em"]) or answer["em"]) / answer["em"]
    along = list(accumulate((scale * answer["advances"][k] for k in kept), initial=0.0))
    up = answer["isUpright"]
    for n, (k, part) in enumerate(zip(kept, parts, strict=True)):
        if part["cluster"] is not None and int(part["cluster"]) != answer["clusters"][k]:
            return False
        if "no-positions" in line.options:
            continue
        start = along[n] if "ned" in line.options else 0.0
        x, y = scale * answer["dx"][k] + (0 if up else start), scale * answer["dy"][k] - (start if up else 0)
        step = 0.0 if "ned" in line.options or "no-advances" in line.options else scale * answer["advances"][k]
        over, raised = (0.0, -step) if up else (step, 0.0)
        wanted = [float(part[name] or 0) for name in ("x", "y", "over", "up")]
        most = ROUNDED * (n + 1) if scale != 1.0 else 0.0
        if any(abs(one - other) > most for one, other in zip((x, y, over, raised), wanted, strict=True)):
            return False
    return True


def is_hidden(line: Line, answer: dict[str, Any], k: int) -> bool:
    """Whether a glyph stands for a character that shows nothing, and which an option removes."""
    if not answer["blank"][k]:
        return False
    start = answer["clusters"][k]
    end = min((one for one in answer["clusters"] if one > start), default=len(line.characters))
    return any(code in range(first, last + 1) for code in line.characters[start:end] for first, last in IGNORABLE)


def shape(requests: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Answers of the module of pages."""
    script = Path(__file__).parent / "pages" / "shaping.mjs"
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "tests.json")
        source.write_text(json.dumps(requests), encoding="utf-8")
        outcome = subprocess.run(["node", str(script), str(source)], capture_output=True, text=True, check=True)
    found: dict[str, Any] = json.loads(outcome.stdout)
    return found


def known_failures(suite: Path) -> set[str]:
    """Files of tests that HarfBuzz itself fails."""
    path = suite / "DISABLED"
    rows = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {Path(row).name for row in rows if row.endswith(".tests")}


def outcome_of(line: Line, answer: dict[str, Any]) -> str:
    if "error" in answer:
        return "refused"
    return "equal" if is_equal(line, answer) else "different"


def found_of(answer: dict[str, Any]) -> str:
    """Glyphs of an answer, as a line has them."""
    columns = (answer[name] for name in ("glyphs", "clusters", "dx", "dy", "advances"))
    return "|".join(f"{glyph}={cluster}@{x},{y}+{step}" for glyph, cluster, x, y, step in zip(*columns, strict=True))


def judge(folder: Path) -> dict[str, Any]:
    """Counts of the suites of a checkout, and the lines that are different."""
    facts: dict[str, Any] = {"version": "", "counts": {}, "needs": Counter(), "files": Counter(), "different": []}
    for name in SUITES:
        suite = folder / "test" / "shape" / "data" / name
        paths = [path for path in sorted((suite / "tests").glob("*.tests")) if path.name not in known_failures(suite)]
        ours: list[tuple[Line, str]] = []
        counts: Counter[str] = Counter()
        for line in (line for path in paths for line in lines_of(path)):
            direction = direction_of(line)
            need = need_of(line, direction)
            if need:
                facts["needs"][need] += 1
                counts["not ours"] += 1
            else:
                ours.append((line, direction))
        shaped = shape([request_of(line, direction) for line, direction in ours])
        for (line, _), answer in zip(ours, shaped["answers"], strict=True):
            outcome = outcome_of(line, answer)
            counts[outcome] += 1
            if outcome != "equal":
                facts["files"][f"{name}/{line.file}"] += 1
                facts["different"].append(f"{name}/{line.file}: {line.text} {answer.get('error') or found_of(answer)}")
        facts["version"] = shaped["version"]
        facts["counts"][name] = dict(counts)
    return facts


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--harfbuzz", type=Path, required=True, help="checkout of HarfBuzz")
    parser.add_argument("--list", action="store_true", help="name the lines that are different")
    arguments = parser.parse_args()
    facts = judge(arguments.harfbuzz)
    names = ("equal", "different", "refused", "not ours")
    rows = [[suite, *(str(found.get(name, 0)) for name in names)] for suite, found in facts["counts"].items()]
    print(table(("tests", *names), rows))
    print("\n" + table(("needs", "lines"), [[need, str(count)] for need, count in sorted(facts["needs"].items())]))
    print("\n" + table(("different", "lines"), [[name, str(count)] for name, count in facts["files"].most_common()]))
    if arguments.list:
        print("", *facts["different"], sep="\n")
    print(f"\nHarfBuzz {facts['version']} in pages")
    print(write_json("shaping", facts))


if __name__ == "__main__":
    main()
