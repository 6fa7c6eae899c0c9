"""Conditionals in a text, resolved: WGSL has none, and a program is made for one choice of numbers."""

from collections.abc import Mapping
from typing import Final

from vexture.renderers.shader_error import ShaderError

WORDS: Final = ("#if ", "#elif ", "#else", "#endif")


def chosen(text: str, numbers: Mapping[str, float]) -> str:
    """Return a text without its conditionals: the lines that a choice of numbers leaves.

    Parameters
    ----------
    text : str
        Its conditions are ``NAME``, which is nonzero, or ``NAME == NUMBER``, whose right side may be a name as well.
    numbers : mapping of str to float

    Raises
    ------
    ShaderError
        If a condition names what is not among the numbers.
    """

    def value(word: str, line: int) -> float:
        try:
            return numbers[word] if word[0].isalpha() else float(word)
        except (KeyError, ValueError):
            raise ShaderError(line, f"{word} is not chosen; choose a number for it") from None

    kept: list[str] = []
    open_: list[tuple[bool, bool]] = []  # of each conditional: whether a branch was taken, and whether this one is
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith(WORDS):
            if all(is_here for _, is_here in open_):
                kept.append(line)
            continue
        word, *condition = line.split()
        if word == "#endif":
            open_.pop()
            continue
        was_taken = open_.pop()[0] if word != "#if" else False
        if word == "#else":
            holds = True
        else:
            found = value(condition[0], number)
            holds = found == value(condition[2], number) if condition[1:] else found != 0
        open_.append((was_taken or holds, holds and not was_taken))
    return "\n".join(kept) + "\n"
