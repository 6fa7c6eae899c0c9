"""Tokens of GLSL, with the comments that stand beside them."""

import re
from dataclasses import dataclass
from typing import Final

from vexture.renderers.shader import ShaderError

TOKEN: Final = re.compile(
    r"(?P<comment>//[^\n]*)|(?P<directive>^[ \t]*#[^\n]*)|(?P<space>[ \t\r]+)|(?P<line>\n)"
    r"|(?P<number>0[xX][0-9a-fA-F]+u?|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?u?)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign><<=|>>=|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\^\^|[-+*/%&|^]=|[-+*/%<>=!~&|^?:;,.(){}\[\]])",
    re.MULTILINE,
)


@dataclass(frozen=True, slots=True)
class Token:
    """A word of the text.

    Parameters
    ----------
    kind : str
        ``name``, ``number``, ``sign``, ``directive`` or ``end``.
    text : str
    line : int
        Its number, from 1.
    lead : tuple of str
        Comments on lines of their own before it; an empty text stands for empty lines.
    trail : str
        The comment behind it on its line.
    start : int
        Where it begins in the text.
    """

    kind: str
    text: str
    line: int
    lead: tuple[str, ...] = ()
    trail: str = ""
    start: int = 0


def tokens_of(text: str) -> list[Token]:
    """Return the tokens of a text and one for its end.

    Raises
    ------
    ShaderError
        Where a sign is not one of GLSL's.
    """
    behind = trails(text)
    tokens: list[Token] = []
    lead: list[str] = []
    line, at, is_fresh = 1, 0, True
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise ShaderError(line, f"{text[at : at + 20].splitlines()[0]!r} is no sign of GLSL")
        kind, start, at = match.lastgroup or "", at, match.end()
        if kind == "line":
            if is_fresh and (not lead or lead[-1]):
                lead.append("")
            line, is_fresh = line + 1, True
            continue
        if kind == "comment" and is_fresh:
            lead.append(match[0])
        elif kind not in ("space", "comment"):
            tokens.append(Token(kind, match[0].strip(), line, tuple(lead), behind.get(line, ""), start))
            lead = []
        is_fresh = is_fresh and kind == "space"
    tokens.append(Token("end", "", line, tuple(lead), "", len(text)))
    return tokens


def trails(text: str) -> dict[int, str]:
    """Comments behind code, by line."""
    found = {}
    for number, line in enumerate(text.splitlines(), 1):
        code, mark, comment = line.partition("//")
        if mark and code.strip():
            found[number] = mark + comment
    return found
