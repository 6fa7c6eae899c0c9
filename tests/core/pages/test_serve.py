"""`vexture serve` and `vexture push` as people and browsers use them: real processes, real sockets."""

import io
import itertools
import json
import signal
import subprocess
from contextlib import closing
from pathlib import Path
from urllib.parse import urljoin

import pytest
from described import check_description
from PIL import Image
from server import COMMAND, TOKEN, Server, Stream, serving, square

from needed import NEEDS_GEO
from vexture.server.limits import Limits
from vexture.texture.load import texture_from


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("serve") / "shapes"
    folder.mkdir()
    (folder / "by hand.svg").write_bytes(square(3))
    (folder / "broken.svg").write_bytes(b"<svg")
    with serving(folder, "--max-bytes", 100_000, "--rate", 1000) as running:
        yield running


def run(*arguments):
    return subprocess.run([*COMMAND, *map(str, arguments)], capture_output=True, text=True, check=False)


def error(content):
    line = json.loads(content)["error"]
    assert "\n" not in line
    return line


def test_a_published_shape_is_read_back(server):
    status, published = server.put("square", square())
    assert status == 201
    status, headers, content = server.ask("GET", "/shapes/square")
    assert (status, json.loads(content)) == (200, published)
    assert headers["ETag"] == f'"{published["version"]}"'
    assert headers["Cache-Control"] == "no-cache"
    assert published["facts"]["segments"] == 4
    texture, svg = published["texture"][2:], published["views"]["svg"][2:]
    status, headers, content = server.ask("GET", texture)
    assert content.startswith(b"\xabKTX 20\xbb")
    assert "immutable" in headers["Cache-Control"]
    assert headers["X-Content-Type-Options"] == "nosniff"
    status, headers, content = server.ask("GET", svg)
    assert content == square()
    assert "sandbox" in headers["Content-Security-Policy"]
    assert "square" in json.loads(server.ask("GET", "/shapes")[2])["shapes"]
    assert server.put("square", square())[0] == 200


def test_unchanged_shapes_are_not_sent_again(server):
    version = server.put("tagged", square())[1]["version"]
    for tag in (f'"{version}"', f'W/"{version}"', f'"other", "{version}"', "*"):
        status, headers, content = server.ask("GET", "/shapes/tagged", headers={"If-None-Match": tag})
        assert (status, content, headers["ETag"]) == (304, b"", f'"{version}"')
    assert server.ask("GET", "/shapes/tagged", headers={"If-None-Match": '"other"'})[0] == 200


def test_head_answers_as_get_without_content(server):
    server.put("head", square())
    for path in ("/shapes", "/shapes/head", server.manifest("head")["texture"][2:]):
        status, headers, _ = server.ask("GET", path)
        asked, bare, content = server.ask("HEAD", path)
        assert (asked, content) == (status, b"")
        assert bare["Content-Length"] == headers["Content-Length"]
    assert server.ask("HEAD", "/events")[0] == 200


def test_what_is_not_there_is_json(server):
    for path in ("/nothing", "/shapes/nothing", "/files/nothing.ktx2", "/files/..%2f..%2ftoken", "/shapes/../../token"):
        status, headers, content = server.ask("GET", path)
        assert (status, headers["Content-Type"]) == (404, "application/json")
        assert error(content)


def test_every_origin_may_read_and_none_may_write(server):
    origin = {"Origin": "https://example.org"}
    assert server.ask("GET", "/shapes", headers=origin)[1]["Access-Control-Allow-Origin"] == "*"
    for method, status in (("GET", 200), ("PUT", 400)):
        asked = {**origin, "Access-Control-Request-Method": method, "Access-Control-Request-Headers": "if-none-match"}
        assert server.ask("OPTIONS", "/shapes/square", headers=asked)[0] == status


@pytest.mark.usefixtures("page_is_built")
def test_it_describes_itself(server):
    check_description(server.url, "serve", Limits(max_bytes=100_000, rate=1000))


@pytest.mark.parametrize(("path", "methods"), [("/shapes/a", "GET, HEAD, PUT"), ("/events", "GET, HEAD")])
def test_other_methods_are_told_all_that_are_possible(server, path, methods):
    status, headers, content = server.ask("DELETE", path)
    assert (status, headers["Allow"], error(content)) == (405, methods, "DELETE is not possible here")


def test_no_address_stands_for_another(server):
    assert server.ask("GET", "/events/")[0] == 404  # and not elsewhere, as the client's Host says
    status, refused = server.put("line%0A", square())
    assert (status, refused["error"].split(":")[0]) == (400, "name 'line\\n'")
    assert server.ask("GET", "/shapes/line%0A")[0] == 404


def test_files_put_there_by_hand_are_served(server):
    assert server.wait_for("by%20hand")["facts"]["segments"] == 4


@NEEDS_GEO
def test_geojson_and_textures_are_published_too(server):
    ring = [[4, 52], [6, 52], [6, 53], [4, 53], [4, 52]]
    status, published = server.put("map", json.dumps({"type": "Polygon", "coordinates": [ring]}))
    assert (status, published["facts"]["segments"]) == (201, 4)
    texture = server.ask("GET", published["texture"][2:])[2]
    status, again = server.put("copy", texture)
    assert (status, again["texture"]) == (201, published["texture"])
    assert server.put("copy", texture[:-20])[0] == 422
    assert server.manifest("copy")["version"] == again["version"]


def test_drawings_in_colours_are_planar_maps(server):
    body = b'<svg viewBox="0 0 9 9"><path fill="red" d="M0 0h9v9z"/><path d="M0 0v9h9z" fill="blue"/></svg>'
    status, published = server.put("halves", body)
    assert (status, published["facts"]["layers"], published["facts"]["warnings"]) == (201, 1, [])
    texture = server.ask("GET", published["texture"][2:])[2]
    assert [root.is_map for root in texture_from(texture, "halves").roots] == [True]
    status, again = server.put("again", texture)
    assert (status, again["facts"]["layers"], again["facts"]["curves"]) == (201, 1, published["facts"]["curves"])


def test_pictures_are_traced_and_published(server):
    picture, file = Image.new("L", (64, 64), 255), io.BytesIO()
    picture.paste(0, (16, 16, 48, 48))
    picture.save(file, "PNG")
    status, published = server.put("scan", file.getvalue())
    assert (status, published["facts"]["layers"], published["views"]) == (201, 1, {})
    status, refused = server.put("scan", file.getvalue()[:60])
    assert (status, refused["error"].split(" (")[0]) == (422, "scan: is a damaged picture")


@pytest.mark.parametrize(
    "body", [b"", b" \n", b"hello", b"<html/>", b"{}", b"[[[[", b"\xabKTX 20\xbb\r\n\x1a\n", b"\0\xff"]
)
def test_a_bad_update_never_replaces_a_good_shape(server, body):
    good = server.put("good", square())[1]
    status, refused = server.put("good", body)
    assert status == 422
    assert "\n" not in refused["error"]
    after = server.manifest("good")
    assert {**after, "note": None} == good
    assert after["note"] == refused["error"]
    assert server.put("good", square())[1]["note"] is None


def test_without_the_right_token_nothing_is_written(server):
    before = server.ask("GET", "/shapes")[2]
    for given in (
        None,
        "",
        "Bearer",
        "Bearer ",
        f"Basic {TOKEN}",
        f"Bearer {TOKEN[:-1]}",
        f"Bearer {TOKEN}x",
        "Bearer é",
    ):
        headers = {} if given is None else {"Authorization": given}
        status, answered, content = server.ask("PUT", "/shapes/stranger", square(), headers)
        assert (status, bool(error(content))) == (401, True)
        assert answered["WWW-Authenticate"].startswith("Bearer")
    assert server.ask("GET", "/shapes")[2] == before


def test_large_uploads_are_refused(server):
    large = b" " * 100_001
    status, refused = server.put("large", large)
    assert (status, "100000 bytes" in refused["error"]) == (413, True)
    chunks = iter([large[:60_000], large[:60_000]])
    headers = {"Authorization": f"Bearer {TOKEN}"}
    assert server.ask("PUT", "/shapes/large", chunks, headers)[0] == 413  # no Content-Length says so before
    assert server.ask("GET", "/shapes/large")[0] == 404


def test_a_client_is_told_all_and_catches_up(server):
    first = server.put("told", square(1))[1]["version"]
    stream = Stream(server)
    kind, data = stream.next()
    assert (kind, data["versions"]["told"]) == ("hello", first)
    second = server.put("told", square(2))[1]["version"]
    events = itertools.islice(iter(stream.next, None), 1000)  # other tests' notes and drawings come before
    data = next(data for kind, data in events if (kind, data.get("name")) == ("shape", "told"))
    assert data == {"name": "told", "version": second}
    server.put("told", b"hello")
    kind, data = stream.next()
    assert (kind, data["name"]) == ("note", "told")
    stream.close()
    with closing(Stream(server)) as again:
        assert again.next()[1]["versions"]["told"] == second


def test_push_publishes_and_says_so_in_one_line(server, tmp_path):
    secret, drawing = tmp_path / "token", tmp_path / "Köln 1.svg"
    secret.write_text(TOKEN)
    drawing.write_bytes(square())
    result = run("push", drawing, server.url, "--token-file", secret)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.startswith(f"Köln 1: {server.url}shapes/K%C3%B6ln%201, ")
    assert server.manifest("K%C3%B6ln%201")["name"] == "Köln 1"
    assert run("push", drawing, f"{server.url}shapes/cologne", "--token-file", secret).returncode == 0
    assert server.manifest("cologne")["name"] == "cologne"
    secret.write_text(TOKEN + "x")
    wrong = run("push", drawing, server.url, "--token-file", secret)
    drawing.write_bytes(b"hello")
    for result, says in (
        (wrong, "the token is wrong"),
        (run("push", drawing, "http://127.0.0.1:1", "--token-file", secret), "cannot be reached"),
        (run("push", drawing, "ftp://127.0.0.1", "--token-file", secret), "is not the address of a server"),
        (run("push", tmp_path / "none.svg", server.url, "--token-file", secret), "cannot be read"),
        (run("push", drawing, server.url, "--token-file", tmp_path / "none"), "name the file that holds the token"),
    ):
        assert (result.returncode, result.stdout, result.stderr.count("\n")) == (1, "", 1)
        assert says in result.stderr


def test_what_cannot_start_says_why_in_one_line(server, tmp_path):
    short = tmp_path / "short"
    short.write_text("only-15-letters\n")
    (tmp_path / "file").touch()
    for arguments, says in (
        ((tmp_path / "new", "--port", server.port), f"port {server.port} on 127.0.0.1 cannot be used"),
        ((tmp_path / "new", "--port", 0, "--token-file", short), "the token has 15 characters"),
        ((tmp_path / "new", "--port", 70_000), "70000"),
        ((tmp_path / "file", "--port", 0), "choose another folder"),
        ((tmp_path / "new", "--port", 0, "--rate", 0), "--rate is 0"),
        ((tmp_path / "new", "--port", 0, "--rate", "nan"), "--rate is nan"),
    ):
        result = run("serve", *arguments)
        assert (result.returncode, result.stdout, result.stderr.count("\n")) == (1, "", 1)
        assert says in result.stderr
    assert not (tmp_path / "new").exists()


def test_one_server_has_a_folder(tmp_path):
    with serving(tmp_path / "shapes") as first:
        result = run("serve", tmp_path / "shapes", "--port", 0)
        assert (result.returncode, result.stderr.count("\n")) == (1, 1)
        assert "another server has this folder" in result.stderr
        assert first.ask("GET", "/shapes")[0] == 200


def test_a_folder_that_is_created_is_mentioned(tmp_path):
    with serving(tmp_path / "shapes") as server:
        said = server.process.stdout.readline()
        assert said == f"{tmp_path / 'shapes'}: there was no such folder, so it was created\n"
    with serving(tmp_path / "shapes") as server:
        assert server.ask("GET", "/shapes")[0] == 200
        assert server.stop() == (0, "", ""), "the folder is there"


@pytest.mark.slow
def test_it_says_what_it_reads_and_then_what_it_serves(tmp_path):
    folder = tmp_path / "shapes"
    folder.mkdir()
    (folder / "square.svg").write_bytes(square())
    with serving(folder) as server:
        assert server.said == f"serving {folder}, with 1 file to read, at {server.url}\n"
        assert server.process.stdout.readline() == f"{folder}: 1 shape\n"
        assert server.put("logo", square())[0] == 201
    with serving(folder) as server:
        assert server.said == f"serving 1 shape of {folder}, with 1 file to read, at {server.url}\n"
        assert server.process.stdout.readline() == f"{folder}: 2 shapes\n"


@pytest.mark.slow
def test_an_upload_is_kept_though_a_drawing_of_the_folder_holds_the_same_files(tmp_path):
    folder = tmp_path / "shapes"
    folder.mkdir()
    (folder / "square.svg").write_bytes(square())
    with serving(folder) as server:
        server.wait_for("square")
        assert server.put("logo", square())[0] == 201
        assert server.put("logo", square(4))[0] == 200
        assert server.put("logo", square())[0] == 200
    (folder / "square.svg").unlink()
    with serving(folder) as server:
        manifest = server.manifest("logo")
        for address in (manifest["texture"], *manifest["views"].values()):
            assert server.ask("GET", urljoin("/shapes/logo", address))[0] == 200, address


def test_a_server_that_stops_says_nothing_of_what_it_has_not_read(tmp_path):
    """It said that each file was not served, and "0 shapes"."""
    folder = tmp_path / "shapes"
    folder.mkdir()
    lines = "".join(f"M{997 * line // 1500} 0L{7919 * line % 997} 999" for line in range(1500))
    (folder / "slow.svg").write_text(f'<svg viewBox="0 0 999 999"><path stroke="red" d="{lines}"/></svg>')
    with serving(folder) as server:
        assert server.ask("GET", "/shapes")[0] == 200
        assert server.stop() == (0, "", "")


@pytest.mark.slow
def test_links_out_of_the_folder_are_not_followed(tmp_path):
    """A link showed any drawing, or data, of the machine to all who asked."""
    folder, other = tmp_path / "shapes", tmp_path / "other"
    for each in (folder / "below", other):
        each.mkdir(parents=True)
    (other / "secret.svg").write_bytes(square())
    (folder / "below" / "mine.svg").write_bytes(square(4))
    (folder / "out.svg").symlink_to(other / "secret.svg")
    (folder / "twice.svg").symlink_to(folder / "out.svg")
    (folder / "in.svg").symlink_to(Path("below") / "mine.svg")
    with serving(folder) as server:
        said = [server.process.stdout.readline() for _ in range(3)]
        assert said == [
            *(
                f"{name} is not served: it is a link that leads out of the folder; put the file itself there\n"
                for name in ("out.svg", "twice.svg")
            ),
            f"{folder}: 1 shape\n",
        ]
        assert json.loads(server.ask("GET", "/shapes")[2]) == {"shapes": ["in"]}


@pytest.mark.slow
def test_bounds_of_all_shapes(tmp_path):
    with serving(tmp_path / "shapes", "--max-shapes", 1, "--max-total", 50_000) as server:
        assert server.put("a", square())[0] == 201
        assert server.put("b", square(4))[0] == 507
        assert server.put("a", square(4))[0] == 200
        large = b'<svg viewBox="0 0 9 9"><path d="M1 1h7v7z"/><!--' + b"x" * 60_000 + b"--></svg>"
        assert server.put("a", large)[0] == 507
        assert server.manifest("a")["facts"]["segments"] == 4


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_stops_cleanly_while_clients_listen_and_drawings_are_converted(tmp_path, number):
    server = Server(tmp_path / "shapes")
    stream = Stream(server)
    assert stream.next() == ("hello", {"versions": {}})
    waiting = server.connect()
    waiting.putrequest("PUT", "/shapes/slow")
    waiting.putheader("Authorization", f"Bearer {TOKEN}")
    waiting.putheader("Content-Length", "1000")
    waiting.endheaders(b"<svg")  # the rest never comes
    server.process.send_signal(number)
    assert stream.next() is None
    _, errors = server.process.communicate(timeout=30)
    stream.close()
    waiting.close()
    assert (server.process.returncode, errors) == (0, "")
