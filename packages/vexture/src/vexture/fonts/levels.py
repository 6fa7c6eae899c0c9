"""Directions and scripts of characters (Unicode Annexes 9, 24 and 50)."""

from bisect import bisect_right
from collections.abc import Sequence
from importlib import import_module
from itertools import pairwise
from typing import Any, Final

from vexture.base.errors import DeviceError

CURSIVE: Final = frozenset(
    {
        *("Adlm", "Arab", "Aran", "Mand", "Mani", "Mong", "Nkoo", "Phag", "Phlp", "Rohg", "Sogd", "Syrc"),
        *("Beng", "Deva", "Guru", "Modi", "Shrd", "Sylo", "Tirh"),
    }
)
"""Scripts with joined letters, between which no space is inserted (CSS Text 3, D)."""

COMMON: Final = frozenset({"Zyyy", "Zinh", "Zzzz"})
LATIN: Final = "Latn"

UPRIGHT: Final = (
    *((0xA7, 0xA7), (0xA9, 0xA9), (0xAE, 0xAE), (0xB1, 0xB1), (0xBC, 0xBE), (0xD7, 0xD7), (0xF7, 0xF7)),
    *((0x1100, 0x11FF), (0x1401, 0x167F), (0x18B0, 0x18FF), (0x2016, 0x2016), (0x2020, 0x2021), (0x2030, 0x2031)),
    *((0x203B, 0x203C), (0x2042, 0x2042), (0x2047, 0x2049), (0x2051, 0x2051), (0x20DD, 0x20E0), (0x2100, 0x2101)),
    *((0x2103, 0x2109), (0x210F, 0x210F), (0x2113, 0x2114), (0x2116, 0x2117), (0x211E, 0x2123), (0x2125, 0x2125)),
    *((0x2135, 0x213F), (0x2145, 0x214A), (0x214C, 0x214D), (0x214F, 0x218B), (0x221E, 0x221E), (0x2234, 0x2235)),
    *((0x2300, 0x2307), (0x230C, 0x231F), (0x2324, 0x2328), (0x232B, 0x232B), (0x237D, 0x239A), (0x23BE, 0x23CD)),
    *((0x23CF, 0x23CF), (0x23D1, 0x23DB), (0x23E2, 0x2422), (0x2424, 0x24FF), (0x25A0, 0x2619), (0x2620, 0x2767)),
    *((0x2776, 0x2793), (0x2B12, 0x2B2F), (0x2B50, 0x2B59), (0x2B97, 0x2B97), (0x2BB8, 0x2BFF), (0x2E50, 0x2E51)),
    *((0x2E80, 0xA4CF), (0xA960, 0xA97F), (0xAC00, 0xD7FF), (0xE000, 0xFAFF), (0xFE10, 0xFE1F), (0xFE30, 0xFE48)),
    *((0xFE50, 0xFE57), (0xFE5F, 0xFE62), (0xFE67, 0xFE6F), (0xFF01, 0xFF0C), (0xFF0E, 0xFF1B), (0xFF1F, 0xFF60)),
    *((0xFFE0, 0xFFE7), (0xFFF0, 0xFFF8), (0xFFFC, 0xFFFD), (0x10980, 0x1099F), (0x11580, 0x115FF)),
    *((0x11A00, 0x11AAF), (0x13000, 0x1345F), (0x14400, 0x1467F), (0x16FE0, 0x18AFF), (0x1B000, 0x1B12F)),
    *((0x1B170, 0x1B2FF), (0x1CF00, 0x1CFCF), (0x1D000, 0x1D1FF), (0x1D2E0, 0x1D37F), (0x1D800, 0x1DAAF)),
    *((0x1F000, 0x1F7FF), (0x1F900, 0x1FAFF), (0x20000, 0x3FFFD), (0xF0000, 0x10FFFD)),
)
"""First and last characters of ranges that are upright or transformed in vertical text (Unicode Annex 50)."""

STARTS: Final = [first for first, _ in UPRIGHT]

BRACKETS: Final = "()[]{}⁅⁆⁽⁾₍₎⌈⌉⌊⌋❨❩❪❫❬❭❮❯❰❱❲❳❴❵⟅⟆⟦⟧⟨⟩⟪⟫⟬⟭⟮⟯⦃⦄⦅⦆〈〉《》「」『』【】〔〕〖〗〘〙〚〛（）［］｛｝｟｠｢｣"
CLOSING: Final = dict(zip(BRACKETS[::2], BRACKETS[1::2], strict=True))
"""Closing bracket of each opening bracket (BidiBrackets.txt, without rare scripts)."""

DEEPEST_BRACKETS: Final = 63
"""Most open brackets; deeper ones are not paired (BD16)."""

STRONG: Final = {"L": "L", "R": "R", "EN": "R", "AN": "R"}
"""Direction that a character gives to brackets around it or next to it."""

EMBEDDING: Final = {"LRI": "LRE", "RLI": "RLE", "FSI": "LRE", "PDI": "PDF"}
"""Replacements of isolates, which python-bidi does not support."""


def is_upright(character: str) -> bool:
    """Return whether a character is upright in vertical text."""
    code = ord(character)
    at = bisect_right(STARTS, code) - 1
    return at >= 0 and code <= UPRIGHT[at][1]


def scripts(text: Sequence[str]) -> list[str]:
    """Return the script of each character; common characters take the script of their neighbours."""
    from fontTools.unicodedata import script

    found = [script(character) for character in text]
    known = [name for name in found if name not in COMMON]
    last = known[0] if known else LATIN
    for at, name in enumerate(found):
        if name in COMMON:
            found[at] = last
        last = found[at]
    return found


def levels(text: Sequence[str], base: int, controls: Sequence[tuple[int, str]]) -> list[int]:
    """Return the embedding level of each character; odd levels run from right to left (Unicode Annex 9).

    `controls` are formatting characters in order, each with the index of the character that follows it.
    """
    from fontTools.unicodedata import bidirectional

    kinds = [bidirectional(character) for character in text]
    if not (base or controls or {"R", "AL", "AN", "RLE", "RLO", "RLI"}.intersection(kinds)):
        return [0] * len(text)
    algorithm = bidirectional_algorithm()
    characters, at = [], 0
    for place, control in (*controls, (len(text), "")):
        characters += [entry(kinds[k], base, k) for k in range(at, place)]
        characters += [entry(bidirectional(control), base, -1)] if control else []
        at = place
    storage = algorithm.get_empty_storage()
    storage["base_level"], storage["base_dir"], storage["chars"] = base, "LR"[base], characters
    algorithm.explicit_embed_and_overrides(storage)
    algorithm.resolve_weak_types(storage)
    for run in storage["runs"]:
        pair_brackets(text, characters_of(storage, run), run["sor"])
    algorithm.resolve_neutral_types(storage, False)
    algorithm.resolve_implicit_levels(storage, False)
    found = [-1] * len(text)
    for character in storage["chars"]:
        if character["at"] >= 0:
            found[character["at"]] = character["level"]
    last = base
    for k, level in enumerate(found):  # formatting characters have the level of the character before
        last = found[k] = last if level < 0 else level
    end = len(text)
    while end and kinds[end - 1] in ("WS", "BN"):  # rule L1
        end -= 1
        found[end] = base
    return found


def bidirectional_algorithm() -> Any:
    """Return the module of python-bidi; raise a `DeviceError` if it is not installed."""
    try:
        return import_module("bidi.algorithm")
    except ImportError:
        raise DeviceError(
            "text from right to left needs the package python-bidi; install it: pip install 'vexture[text]'"
        ) from None


def characters_of(storage: dict[str, Any], run: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the characters of a run of one level, in python-bidi's data structure."""
    found: list[dict[str, Any]] = storage["chars"][run["start"] : run["start"] + run["length"]]
    return found


def pair_brackets(text: Sequence[str], run: list[dict[str, Any]], before: str) -> None:
    """Give paired brackets of a run the same direction (rule N0, which python-bidi lacks).

    `before` is the direction before the run.
    """
    strong = [STRONG.get(character["type"]) for character in run]
    for first, last in bracket_pairs(text, run):
        own = "LR"[run[first]["level"] % 2]
        inside = set(strong[first + 1 : last]) - {None}
        if not inside:
            continue
        context = next((strong[k] for k in range(first - 1, -1, -1) if strong[k] is not None), before)
        direction = own if own in inside or context == own else context
        for place in (first, last):
            run[place]["type"] = strong[place] = direction


def bracket_pairs(text: Sequence[str], run: list[dict[str, Any]]) -> list[tuple[int, int]]:
    """Return the indices of paired brackets in a run, sorted by the opening bracket (definition BD16)."""
    opened: list[tuple[str, int]] = []
    pairs = []
    for place, character in enumerate(run):
        if character["type"] != "ON" or character["at"] < 0:
            continue
        shown = text[character["at"]]
        if shown in CLOSING:
            if len(opened) == DEEPEST_BRACKETS:
                break
            opened.append((CLOSING[shown], place))
        closed = next((k for k in reversed(range(len(opened))) if opened[k][0] == shown), None)
        if closed is not None:
            pairs.append((opened[closed][1], place))
            del opened[closed:]
    return sorted(pairs)


def entry(kind: str, level: int, at: int) -> dict[str, object]:
    """Return a character in python-bidi's data structure."""
    kind = EMBEDDING.get(kind, kind) or "L"
    kind = "WS" if kind == "B" else kind
    return {"level": level, "type": kind, "orig": kind, "at": at}


def visual_order(embedding: Sequence[int]) -> list[int]:
    """Return the indices of a line's parts in visual order, given their levels (rule L2).

    Examples
    --------
    >>> visual_order([0, 1, 1, 2, 2, 0])
    [0, 3, 4, 2, 1, 5]
    """
    order = list(range(len(embedding)))
    odd = [level for level in embedding if level % 2]
    for level in range(max(embedding, default=0), min(odd, default=1) - 1, -1):
        edges = [k for k in range(len(order) + 1) if k in (0, len(order)) or _turns(embedding, order, k, level)]
        for first, last in pairwise(edges):
            if embedding[order[first]] >= level:
                order[first:last] = order[first:last][::-1]
    return order


def _turns(embedding: Sequence[int], order: list[int], at: int, level: int) -> bool:
    return (embedding[order[at - 1]] >= level) != (embedding[order[at]] >= level)
