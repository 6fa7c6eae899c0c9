"""One run of a reader: what it answered, or what is wrong with it."""

import re
import traceback
import warnings
from pathlib import Path

from readers import FindingError, Target, check_line

from vexture.base.errors import EXPECTED, SourceWarning

VARYING = re.compile(r"[-+]?[0-9][0-9a-fx.e+-]*|'[^']*'|\"[^\"]*\"")
"""Parts of a message that quote the input: two messages that differ in these only are one behaviour."""

WORDS = 12
"""Of an answer, that tell it from others; after them, messages quote."""


def attempt(target: Target, data: bytes) -> str:
    """What a reader says about an input, without what it quotes; raises a `FindingError`."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", SourceWarning)
            return f"reads {mask_words(target.read(data))}"
    except EXPECTED as error:
        check_line(str(error))
        return f"{type(error).__name__} {mask_words(str(error))}"
    except FindingError:
        raise
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # a panic of Rust is no Exception
        raise FindingError(f"{signature(error)}\n{''.join(traceback.format_exception(error))}") from None


def mask_words(text: str) -> str:
    """The first words of a text without what varies with every input."""
    return " ".join(VARYING.sub("#", text).split()[:WORDS])


def signature(error: BaseException) -> str:
    """Type of an error and where it arose: in the library's code, and at all."""
    frames = traceback.extract_tb(error.__traceback__)
    ours = [frame for frame in frames if "vexture" in Path(frame.filename).parts] or frames
    return " < ".join(f"{Path(frame.filename).name}:{frame.name}" for frame in (ours[-1], frames[-1])) + (
        f" {type(error).__name__}: {' '.join(str(error).split())[:200]}"
    )


def kind_of_finding(finding: FindingError) -> str:
    """First line of a finding without numbers and quotations: one fault, however many inputs show it."""
    return mask_words(str(finding).partition("\n")[0])


def shrunk(target: Target, data: bytes, most: int = 400) -> bytes:
    """A shorter input that shows the same fault: parts are left out while it lasts, for at most so many attempts."""

    def fault(of: bytes) -> str | None:
        try:
            attempt(target, of)
        except FindingError as finding:
            return kind_of_finding(finding)
        return None

    wanted, step = fault(data), max(len(data) // 2, 1)
    while wanted and step and most > 0:
        at = 0
        while at < len(data) and most > 0:
            shorter, most = data[:at] + data[at + step :], most - 1
            if fault(shorter) == wanted:
                data = shorter
            else:
                at += step
        step //= 2
    return data
