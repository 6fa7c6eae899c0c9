"""Conversions side by side: a slow one, or one that is ended, keeps no other waiting."""

import asyncio
from contextlib import closing

import pytest
from loops import run
from server import TOKEN, serving, square

from vexture.server.converter import Converter
from vexture.server.limits import Limits


def fan(lines):
    """A drawing of crossing strokes: 100 take half a second to convert, 1500 minutes."""
    path = "".join(f"M{997 * line // lines} 0L{7919 * line % 997} 999" for line in range(lines))
    return f'<svg viewBox="0 0 999 999"><path stroke="red" d="{path}"/></svg>'.encode()


def uploading(server, name, body):
    """Connection whose upload is on its way."""
    connection = server.connect()
    connection.request("PUT", f"/shapes/{name}", body, {"Authorization": f"Bearer {TOKEN}"})
    return connection


def check_others_are_converted(server, name, body, slow):
    """A slow upload is on its way while another shape is published again."""
    assert server.put(name, body)[0] in (200, 201)  # it converts now
    with closing(uploading(server, f"{name}/slow", slow)) as connection:
        assert [server.put(name, body)[0] for _ in range(2)] == [200, 200]
        connection.sock.setblocking(False)
        with pytest.raises(BlockingIOError):  # no answer yet
            connection.sock.recv(1)
    assert server.stop()[0] == 0  # and with it the conversion


@pytest.mark.slow
def test_a_slow_conversion_keeps_no_other_waiting(tmp_path):
    with serving(tmp_path / "shapes") as server:
        check_others_are_converted(server, "quick", square(), fan(1500))


@pytest.mark.slow
def test_of_uploads_of_one_name_the_last_stays(tmp_path):
    with serving(tmp_path / "shapes") as server:
        for connection in [uploading(server, name, fan(50)) for name in "xy"]:  # both processes start
            assert connection.getresponse().status == 201
            connection.close()
        with closing(uploading(server, "a", fan(100))) as first:
            last = server.put("a", square())[1]
            assert first.getresponse().status == 201
        assert server.manifest("a")["version"] == last["version"]


def test_a_conversion_that_is_ended_harms_no_other():
    async def both():
        converter = Converter(Limits())
        try:
            ended, other = (asyncio.create_task(converter.shape_of(fan(100), name)) for name in "ab")
            await asyncio.sleep(0)  # both are under way
            ended.cancel()
            return (await other).name
        finally:
            converter.close()

    assert run(both()) == "b"
