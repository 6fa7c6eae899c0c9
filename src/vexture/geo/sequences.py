"""Sequences of features in JSON: a text for each, after a mark (RFC 8142) or in a line of its own."""

import json
from typing import Final

from vexture.content import BYTE_ORDER_MARK, RECORD
from vexture.errors import SourceError, shortened

__all__ = ["one_json"]

SHOWN: Final = 80
"""Characters of an error in a message."""


def one_json(content: bytes) -> bytes:
    r"""A sequence of features in JSON (RFC 8142, or one a line) as one collection; other JSON as it is.

    Examples
    --------
    >>> one_json(b'{"type": "Feature"}\n{"type": "Feature"}\n')
    b'{"type":"FeatureCollection","features":[{"type": "Feature"},{"type": "Feature"}]}'
    """
    text = content.removeprefix(BYTE_ORDER_MARK).strip()
    if text.startswith(RECORD):
        records = text.split(RECORD)
    else:
        first, _, rest = text.partition(b"\n")
        if not (first.rstrip().endswith(b"}") and rest.lstrip()[:1] == b"{"):  # valid nowhere in one text
            return content
        records = text.split(b"\n")
    features = [stripped for record in records if (stripped := record.strip())]
    for number, feature in enumerate(features, 1):
        _check_record(feature, number)
    return b'{"type":"FeatureCollection","features":[' + b",".join(features) + b"]}"


def _check_record(record: bytes, number: int) -> None:
    """Refuse what is no feature: GDAL passes over it in silence."""
    try:
        value = json.loads(record)
    except (ValueError, RecursionError) as error:
        raise SourceError(f"record {number} is no JSON ({shortened(str(error), SHOWN)}); save it again") from None
    if not isinstance(value, dict) or value.get("type") != "Feature":
        raise SourceError(f"record {number} is no Feature; give one Feature in each line or record")
