"""Texts that the worker of web/src/typeset sets, next to HarfBuzz, fontTools and the rules of Unicode."""

import json
import subprocess
from pathlib import Path
from typing import Any

import fontpkg_noto_sans
import pytest
import uharfbuzz
from fontTools.feaLib.builder import addOpenTypeFeaturesFromString
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.basePen import BasePen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont
from test_kernels import built

from chromium import ROOT

matplotlib = pytest.importorskip("matplotlib")

SANS = next(Path(fontpkg_noto_sans.__file__).parent.glob("files/NotoSans[[]*.ttf"))
DEJAVU = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"

WORDS = {
    "Latin": "Waffle AVATAR fi ffl Zoe\u0308",
    "Greek": "Ὀδυσσεύς λόγος",
    "Cyrillic": "Съешь ещё булок",
    "Hebrew": "שָׁלוֹם עולם",
    "Arabic": "السلام عليكم لا إله",
    "Armenian": "Բարեւ ﬓ",
    "Georgian": "გამარჯობა",
    "Lao": "ສະບາຍດີ",
    "Nko": "ߒߞߏ ߞߊ߲",
    "Canadian_Aboriginal": "ᐃᓄᒃᑎᑐᑦ",
    "Tifinagh": "ⵜⵉⴼⵉⵏⴰⵖ",
}
"""Words that DejaVu Sans has, by their scripts."""

SANS_WORDS = {
    "Latin": "Waffle AVATAR Zoe\u0308 ȷ\u0301",
    "Devanagari": "हिन्दी क्षत्रिय र्क्ति",
    "Vietnamese": "Tiếng Việt",
    "Cyrillic": "Ёлка",
}
"""Words that Noto Sans has."""

Reply = dict[str, Any]


def typeset(folder: Path, fonts: list[Path], messages: list[dict[str, Any]]) -> list[Reply]:
    """The answers of the typesetter, in Node.js."""
    built("silhouettes")
    source = folder / "messages.json"
    source.write_text(json.dumps({"fonts": [str(path) for path in fonts], "messages": messages}), encoding="utf-8")
    script = ROOT / "tests" / "web" / "typesetting.mjs"
    outcome = subprocess.run(["node", str(script), str(source)], capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    found: list[Reply] = json.loads(outcome.stdout)
    return found


def set_texts(folder: Path, fonts: list[Path], *texts: dict[str, Any]) -> tuple[list[Reply], list[str]]:
    """The results of some texts, with all fonts unless they name some, and the keys of the shapes."""
    requests = [{"fonts": list(range(len(fonts))), **text} for text in texts]
    (reply,) = typeset(folder, fonts, [{"id": 1, "texts": requests}])
    assert "error" not in reply, reply
    return reply["results"], [shape["key"] for shape in reply["added"]["shapes"]]


class LowPen(BasePen):
    """Least coordinates of an outline's control points, as cubics: the base class raises the degree of others."""

    def __init__(self, glyphs: Any) -> None:
        super().__init__(glyphs)
        self.points: list[tuple[float, float]] = []

    def _moveTo(self, point: tuple[float, float]) -> None:  # noqa: N802 (fontTools' names)
        self.start = point

    def _lineTo(self, point: tuple[float, float]) -> None:  # noqa: N802
        self.points += [self._getCurrentPoint(), point]

    def _curveToOne(self, *points: tuple[float, float]) -> None:  # noqa: N802
        self.points += [self._getCurrentPoint(), *points]

    def low(self) -> tuple[float, float] | None:
        return (min(x for x, _ in self.points), min(y for _, y in self.points)) if self.points else None


class Oracle:
    """HarfBuzz's own shaping of a font."""

    def __init__(self, path: Path, variations: dict[str, float] | None = None) -> None:
        self.font = uharfbuzz.Font(uharfbuzz.Face(uharfbuzz.Blob.from_file_path(str(path))))
        self.em = self.font.face.upem
        if variations:
            self.font.set_variations(variations)
        file = TTFont(path)
        self.glyphs = file.getGlyphSet(location=variations or {})
        self.order = file.getGlyphOrder()

    def places(
        self,
        text: str,
        features: dict[str, int] | None = None,
        direction: str | None = None,
        language: str | None = None,
    ) -> list[tuple[int, int, float, float]]:
        """Glyph, UTF-16 cluster, left and bottom in ems of each glyph that shows something."""
        buffer = uharfbuzz.Buffer()
        buffer.add_utf8(text.encode())
        buffer.guess_segment_properties()
        if direction:
            buffer.direction = direction
        if language:
            buffer.language = language
        uharfbuzz.shape(self.font, buffer, features or {})
        found, x, y = [], 0, 0
        for info, place in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True):
            pen = LowPen(self.glyphs)
            self.glyphs[self.order[info.codepoint]].draw(pen)
            low = pen.low()
            if low:
                cluster = len(text.encode()[: info.cluster].decode().encode("utf-16-le")) // 2
                left = (x + place.x_offset + low[0]) / self.em
                found.append((info.codepoint, cluster, left, (y + place.y_offset + low[1]) / self.em))
            x += place.x_advance
            y += place.y_advance
        return found


def places_of(result: Reply, keys: list[str]) -> list[tuple[int, int, float, float]]:
    """Glyph, cluster, left, and bottom from the baseline of each glyph of a line."""
    (line,) = result["lines"]
    left, bottom = result["places"][0::3], result["places"][1::3]
    glyphs = [int(keys[shape].split(":")[2]) for shape in result["shapes"]]
    return [
        (glyph, cluster, x, y - line["baseline"])
        for glyph, cluster, x, y in zip(glyphs, result["clusters"], left, bottom, strict=True)
    ]


def assert_equal_places(
    found: list[tuple[int, int, float, float]], expected: list[tuple[int, int, float, float]]
) -> None:
    assert [one[:2] for one in found] == [one[:2] for one in expected]
    for one, other in zip(found, expected, strict=True):
        assert one[2:] == pytest.approx(other[2:], abs=2e-6)


@pytest.mark.parametrize(("path", "words"), [(DEJAVU, WORDS), (SANS, SANS_WORDS)], ids=["dejavu", "noto"])
def test_words_have_harfbuzz_s_glyphs_and_places(tmp_path: Path, path: Path, words: dict[str, str]) -> None:
    results, keys = set_texts(tmp_path, [path], *({"text": word} for word in words.values()))
    oracle = Oracle(path)
    for (script, word), result in zip(words.items(), results, strict=True):
        assert result["missing"] == [], script
        assert_equal_places(places_of(result, keys), oracle.places(word))


def test_features_language_and_weight_are_harfbuzz_s(tmp_path: Path) -> None:
    results, keys = set_texts(
        tmp_path,
        [SANS],
        {"text": "Office 1/2", "features": '"smcp" on, frac'},
        {"text": "бгдпт", "language": "sr"},
        {"text": "Weight", "weight": 700, "variations": {"wdth": 80}},
        {"text": "fi", "features": "liga=0"},
    )
    cases: list[tuple[str, dict[str, Any], dict[str, float]]] = [
        ("Office 1/2", {"features": {"smcp": 1, "frac": 1}}, {}),
        ("бгдпт", {"language": "sr"}, {}),
        ("Weight", {}, {"wght": 700, "wdth": 80}),
        ("fi", {"features": {"liga": 0}}, {}),
    ]
    for result, (text, options, variations) in zip(results, cases, strict=True):
        assert_equal_places(places_of(result, keys), Oracle(SANS, variations).places(text, **options))
    assert any("wdth=80,wght=700" in key for key in keys)


def upright_font(path: Path) -> Path:
    """A font of ideographs and a comma, which has another glyph and place in vertical text."""
    boxes = {
        "one": (100, 0, 900, 800),
        "two": (200, -50, 800, 850),
        "comma": (100, -50, 300, 200),
        "comma.vert": (700, 600, 900, 850),
    }
    builder = FontBuilder(1000, isTTF=True)
    order = [".notdef", "a", *boxes]
    builder.setupGlyphOrder(order)
    builder.setupCharacterMap({ord("a"): "a", ord("漢"): "one", ord("字"): "two", ord("、"): "comma"})
    glyphs = {".notdef": TTGlyphPen(None).glyph()}
    for name, (left, bottom, right, top) in {"a": (50, 0, 450, 500), **boxes}.items():
        pen = TTGlyphPen(None)
        pen.moveTo((left, bottom))
        for point in ((left, top), (right, top), (right, bottom)):
            pen.lineTo(point)
        pen.closePath()
        glyphs[name] = pen.glyph()
    builder.setupGlyf(glyphs)
    outlines = builder.font["glyf"]
    widths = {name: (500 if name == "a" else 1000, getattr(outlines[name], "xMin", 0)) for name in order}
    builder.setupHorizontalMetrics(widths)
    builder.setupHorizontalHeader(ascent=880, descent=-120)
    builder.setupVerticalMetrics({name: (1000, 880 - getattr(outlines[name], "yMax", 880)) for name in order})
    builder.setupVerticalHeader(ascent=500, descent=-500)
    builder.setupPost()
    addOpenTypeFeaturesFromString(builder.font, "feature vert { sub comma by comma.vert; } vert;")
    builder.save(path)
    return path


def test_ideographs_stand_and_latin_lies_in_vertical_text(tmp_path: Path) -> None:
    font = upright_font(tmp_path / "upright.ttf")
    style = {"writingMode": "vertical-rl", "lineHeight": 1.5}
    (result,), keys = set_texts(tmp_path, [font], {"text": "漢、字a", **style})
    (line,) = result["lines"]
    found = [
        (int(keys[shape].split(":")[2]), cluster, x - line["baseline"], y)
        for shape, cluster, x, y in zip(
            result["shapes"], result["clusters"], result["places"][0::3], result["places"][1::3], strict=True
        )
    ]
    assert_equal_places(found[:3], Oracle(font).places("漢、字", direction="ttb"))
    assert [glyph for glyph, *_ in found] == [2, 5, 3, 1]
    assert keys[-1] == "0::1:r"
    # the letter is 0.4 x 0.5 em, from 0.05 em after its start, about the middle of ascender and descender
    assert found[3][2:] == pytest.approx((-0.38, -3.45), abs=1e-6)
    assert result["blockBounds"] == pytest.approx([0, -3.5, 1.5, 0])
    assert result["carets"][:4] == pytest.approx([0, -1, 0, 1.5])


def test_texts_of_several_fonts_are_those_of_each(tmp_path: Path) -> None:
    (mixed, latin, arabic), keys = set_texts(
        tmp_path,
        [SANS, DEJAVU],
        {"text": "Zoe\u0308 السلام"},
        {"text": "Zoe\u0308 ", "fonts": [0]},
        {"text": "السلام", "fonts": [1]},
    )
    names = [keys[shape].split(":")[0] for shape in mixed["shapes"]]
    assert names == ["0"] * len(latin["shapes"]) + ["1"] * len(arabic["shapes"])
    space = latin["carets"][4 * 5]
    shifted = [x + space for x in arabic["places"][0::3]]
    assert mixed["places"][0::3] == pytest.approx(latin["places"][0::3] + shifted, abs=1e-5)
