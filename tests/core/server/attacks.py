"""What hostile or broken clients send, and how they are told so."""

import json

NO_REQUESTS = [
    (
        b"PUT /shapes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n"
        b"0\r\n\r\nGET /shapes HTTP/1.1\r\nHost: a\r\n\r\n",
        400,
    ),
    (b"GET /shapes HTTP/1.1\r\nHost: a\r\n" + b"X: %s\r\n" % (b"y" * 1000) * 200 + b"\r\n", 431),
    (b"GET /shapes HTTP/1.1\r\nHost: a\r\nX: " + b"y" * 30_000 + b"\r\n\r\n", 431),
    (b"GET /" + b"y" * 200_000, 431),
    (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(500_000), 400),
    (b"GET /shapes HTTP/1.1\r\n\r\n" + b"y" * 500_000, 400),
]
"""Bytes, and the status of the refusal; the first say the length of their body twice."""


def rest(peer):
    """All that comes until the server closes."""
    parts = []
    while part := peer.recv(2**16):
        parts.append(part)
    return b"".join(parts)


def refusal_status(answer):
    """Status of an answer that refuses in JSON, with the reason in one line."""
    head, _, body = answer.partition(b"\r\n\r\n")
    line = json.loads(body)["error"]
    assert "\n" not in line
    assert b"connection: close" in head.lower()
    return int(head.split()[1])
