"""The life of a server: its socket."""

import socket

import pytest

from vexture.base.errors import DeviceError
from vexture.server.listen import bind, listen


def test_clients_are_refused_until_all_is_ready():
    with bind("127.0.0.1", 0) as taken, socket.socket() as client, socket.socket() as other:
        where = taken.getsockname()
        with pytest.raises(ConnectionRefusedError):
            client.connect(where)
        with bind(*where) as second:
            listen(taken)
            other.connect(where)
            with pytest.raises(DeviceError, match=f"port {where[1]} on 127.0.0.1 cannot be used") as refusal:
                listen(second)
        assert "\n" not in str(refusal.value)
