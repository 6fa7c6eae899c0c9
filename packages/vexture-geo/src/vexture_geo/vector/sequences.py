"""Sequences of JSON features: each after a separator (RFC 8142), on its own line, or simply concatenated."""

import json
import re
from typing import Any, Final

from vexture.base.content import BYTE_ORDER_MARK, RECORD
from vexture.base.errors import SourceError, shorten_text

SHOWN: Final = 80
"""Most characters of an error in a message."""

WHOLE: Final = (b'"FeatureCollection"', b'"Topology"')
"""Texts that occur once in a single collection of all features, and never in a sequence."""

BETWEEN: Final = re.compile(r"[ \t\r\n]*,?[ \t\r\n]*")
"""Separator of two features."""


def one_json(content: bytes) -> bytes:
    r"""Join a sequence of JSON features (RFC 8142 or concatenated) into one collection; return other JSON unchanged.

    Features may be separated by commas, as in lines taken from a collection.

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
    """Split concatenated features, separated by spaces or commas; return at most one text of other JSON."""
    try:
        text = content.decode()
    except UnicodeDecodeError as error:
        if content[:1] != b"{" or b"\0" in content[:4]:  # UTF-16, or no JSON at all, which the reader reports
            return []
        raise SourceError(f"it is no UTF-8 text (byte {error.start}); save it as UTF-8") from None
    decode, features, at = json.JSONDecoder().raw_decode, list[bytes](), 0
    while at < len(text):
        number = len(features) + 1
        try:
            value, end = decode(text, at)
        except (ValueError, RecursionError) as error:
            if not features:  # it may be any format
                return []
            raise _no_json(error, number) from None
        features.append(text[at:end].encode())
        between = BETWEEN.match(text, end)
        at = between.end() if between else end
        if number == 1 and at == len(text):  # a single text of any kind
            return features
        _check_feature(value, number)
    return features


def _check_record(record: bytes, number: int) -> None:
    """Raise an error for a record that is no feature, because GDAL silently skips it."""
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
