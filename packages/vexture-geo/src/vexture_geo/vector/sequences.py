"""Sequences of features in JSON: each after a mark (RFC 8142), in a line of its own, or simply one after another."""

import json
import re
from typing import Any, Final

from vexture.base.content import BYTE_ORDER_MARK, RECORD
from vexture.base.errors import SourceError, shorten_text

SHOWN: Final = 80
"""Characters of an error in a message."""

WHOLE: Final = (b'"FeatureCollection"', b'"Topology"')
"""What one text of all features has once, and a sequence of features never."""

BETWEEN: Final = re.compile(r"[ \t\r\n]*,?[ \t\r\n]*")
"""What is between two features."""


def one_json(content: bytes) -> bytes:
    r"""A sequence of features in JSON (RFC 8142, or one after another) as one collection; other JSON as it is.

    A comma may be between two features, as it is where lines are those of a collection.

    Examples
    --------
    >>> one_json(b'{"type": "Feature"}\n{"type": "Feature"}\n')
    b'{"type":"FeatureCollection","features":[{"type": "Feature"},{"type": "Feature"}]}'
    """
    text = content.removeprefix(BYTE_ORDER_MARK).strip()
    if text.startswith(RECORD):
        features = [stripped for record in text.split(RECORD) if (stripped := record.strip())]
        for number, feature in enumerate(features, 1):
            _check_record(feature, number)
    else:
        first, _, rest = text.partition(b"\n")
        in_lines = first.rstrip().endswith(b"}") and rest.lstrip()[:1] == b"{"  # valid nowhere in one text
        if not in_lines and sum(map(text.count, WHOLE)) == 1:
            return content
        features = _one_after_another(text)
        if len(features) < 2:
            return content
    return b'{"type":"FeatureCollection","features":[' + b",".join(features) + b"]}"


def _one_after_another(content: bytes) -> list[bytes]:
    """Texts of features, between which are spaces or a comma; at most one of anything else."""
    try:
        text = content.decode()
    except UnicodeDecodeError as error:
        if content[:1] != b"{" or b"\0" in content[:4]:  # of UTF-16, or no JSON at all: who reads it says so
            return []
        raise SourceError(f"it is no UTF-8 text (byte {error.start}); save it as UTF-8") from None
    decode, features, at = json.JSONDecoder().raw_decode, list[bytes](), 0
    while at < len(text):
        number = len(features) + 1
        try:
            value, end = decode(text, at)
        except (ValueError, RecursionError) as error:
            if not features:  # it may be anything
                return []
            raise _no_json(error, number) from None
        features.append(text[at:end].encode())
        between = BETWEEN.match(text, end)
        at = between.end() if between else end
        if number == 1 and at == len(text):  # one text of any kind
            return features
        _check_feature(value, number)
    return features


def _check_record(record: bytes, number: int) -> None:
    """Refuse what is no feature: GDAL passes over it in silence."""
    try:
        value = json.loads(record)
    except (ValueError, RecursionError) as error:
        raise _no_json(error, number) from None
    _check_feature(value, number)


def _check_feature(value: Any, number: int) -> None:
    if not isinstance(value, dict) or value.get("type") != "Feature":
        raise SourceError(f"record {number} is no Feature; give one Feature in each line or record")


def _no_json(error: Exception, number: int) -> SourceError:
    return SourceError(f"record {number} is no JSON ({shorten_text(str(error), SHOWN)}); save it again")
