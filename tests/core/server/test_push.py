"""`vexture push`: addresses of shapes, and servers that do not answer."""

import socket

import pytest

from vexture.base.errors import DeviceError, LimitError, ParameterError
from vexture.server.push import push, target_of


@pytest.mark.parametrize(
    "url", ["ftp://a", "http://", "http://a:0", "http://a:99999", "http://[a", "http://a/\x1b[2J", "example.org", ""]
)
def test_what_is_no_address_of_a_server_is_named(url):
    with pytest.raises(ParameterError, match="is not the address of a server"):
        target_of(url, "duck")


@pytest.mark.parametrize("url", ["http://a", "http://a/", "http://a/shapes", "http://a/shapes/"])
def test_the_name_is_the_files_by_default(url):
    assert target_of(url, "Köln 1") == "http://a/shapes/K%C3%B6ln%201"


def test_a_name_in_the_address_is_checked():
    assert target_of("https://a:8/x/shapes/b%2Fc", "duck") == "https://a:8/x/shapes/b/c"
    with pytest.raises(LimitError):
        target_of("http://a/shapes/..%2Fb", "duck")


def test_a_server_that_is_not_there_is_one_line(tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        (tmp_path / "duck.svg").write_bytes(b"<svg/>")
        with pytest.raises(DeviceError, match=rf"^http://127\.0\.0\.1:{port}/shapes/duck: cannot be reached"):
            push(tmp_path / "duck.svg", f"http://127.0.0.1:{port}", "token")
    with pytest.raises(DeviceError, match=r"none\.svg: cannot be read \(No such file or directory\)"):
        push(tmp_path / "none.svg", "http://127.0.0.1", "token")
