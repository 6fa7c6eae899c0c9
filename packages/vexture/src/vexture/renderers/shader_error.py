"""Error of the generator: it refuses what it does not know, and never guesses."""

from vexture.base.errors import VextureError


class ShaderError(VextureError):
    """A text is outside of the subset of GLSL that has a meaning in WGSL.

    Parameters
    ----------
    line : int
        Its number in the text, from 1.
    what : str
        What is there, and what may be.
    """

    def __init__(self, line: int, message: str) -> None:
        super().__init__(f"line {line}: {message}")
        self.line = line
