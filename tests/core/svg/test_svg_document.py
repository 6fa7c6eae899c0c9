"""The XML of an SVG: encodings, namespaces, entities and limits."""

import re
from pathlib import Path

import pytest

from vexture.base.errors import SourceError, printable
from vexture.svg.read import read_svg

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'


def message_of(path: Path | str) -> str:
    with pytest.raises(SourceError) as caught:
        read_svg(path)
    message = str(caught.value)
    assert message.startswith(f"{printable(str(path))}: ")
    assert "\n" not in message
    assert len(message) < len(str(path)) + 300
    return message


@pytest.mark.parametrize("where", ["on a path", "on the root", "in another namespace"])
def test_an_element_of_many_attributes_is_refused(tmp_path: Path, where: str) -> None:
    """Of 200,000 lxml looks for each by going through all, for minutes, and no limit of time is seen meanwhile."""
    many = " ".join(f'a{number}="1"' for number in range(200_000))
    body = {"on a path": f"<path {many}/>", "on the root": "", "in another namespace": f'<x:y xmlns:x="urn:x" {many}/>'}
    file = tmp_path / "a.svg"
    file.write_text(f"{HEAD[:-1]} {many if where == 'on the root' else ''}>{body[where]}</svg>")
    assert re.search(r"<(path|svg|y)> has 200,00\d attributes; the limit is 1,000; remove those that", message_of(file))


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    assert "No such file" in message_of(tmp_path / "missing.svg")
    assert "is a folder" in message_of(tmp_path).lower()
    assert "cannot be read" in message_of("null\0character.svg")


def test_an_external_entity_in_an_attribute_is_not_read(tmp_path: Path) -> None:
    secret, file = tmp_path / "secret.txt", tmp_path / "a.svg"
    secret.write_text("M0 0h9v9z")
    file.write_text(f'<!DOCTYPE svg [<!ENTITY x SYSTEM "{secret.as_uri()}">]>{HEAD}<path d="&x;"/></svg>')
    assert "Entity" in message_of(file)
