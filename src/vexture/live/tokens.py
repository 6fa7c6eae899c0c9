"""The token that authorizes uploads."""

from pathlib import Path
from typing import Final

from vexture.errors import DeviceError, LimitError

__all__ = ["read_token"]

SHORTEST_TOKEN: Final = 16
LONGEST_TOKEN: Final = 4096


def read_token(path: Path) -> str:
    """Token of a file, without the white space around it."""
    try:
        with path.open("rb") as file:
            content = file.read(LONGEST_TOKEN + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise DeviceError(f"{path}: cannot be read ({reason}); name the file that holds the token") from None
    token = content.strip().decode("latin-1")
    if not SHORTEST_TOKEN <= len(token) <= LONGEST_TOKEN or not all("!" <= letter <= "~" for letter in token):
        raise LimitError(
            f"{path}: the token has {len(token)} characters; it must be {SHORTEST_TOKEN} to {LONGEST_TOKEN} of ASCII "
            "without spaces; make one with: openssl rand -hex 32"
        )
    return token
