"""The reference of the npm package: every export is in it, with a sentence, and its links lead somewhere."""

import json
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from guides import ROOT

sys.path.insert(0, str(ROOT / "tools"))

import js_model
import js_pages

WEB = ROOT / "web"
LACKING = js_model.missing(WEB)
ENTRIES = js_model.entries(WEB)

pytestmark = pytest.mark.skipif(LACKING is not None, reason=f"no reference of JavaScript: {LACKING}")
pytest.importorskip("mkdocs", reason="MkDocs is not installed (pip install '.[docs]')")

IMPORTED = """
const found = {};
for (const [name, source] of JSON.parse(process.argv[1])) found[name] = Object.keys(await import(source));
console.log(JSON.stringify(found));
"""


class Read(HTMLParser):
    """Names of a page's places, and all that it links to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        self.ids.add(str(values.get("id")))
        if tag == "a" and values.get("href"):
            self.links.append(str(values["href"]))


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[str, Read]:
    """Pages of all entries, by their names."""
    found = {}
    for entry in [*(entry.slug for entry in ENTRIES), "index"]:
        found[entry] = Read((site / "reference" / "javascript" / f"{entry}.html").read_text(encoding="utf-8"))
    return found


@pytest.fixture(scope="module")
def model() -> dict[str, js_pages.Model]:
    return js_model.model(WEB)


def test_every_export_of_every_entry_has_its_place(pages: dict[str, Read]) -> None:
    sources = json.dumps([(entry.slug, str(WEB / entry.source)) for entry in ENTRIES])
    command = ["node", "--input-type=module", "--eval", IMPORTED, sources]
    outcome = subprocess.run(command, cwd=WEB, capture_output=True, text=True, check=True)
    exported = json.loads(outcome.stdout)
    assert len(exported) == len(ENTRIES) > 5
    for entry, names in exported.items():
        assert names
        assert set(names) - pages[entry].ids == set(), entry
    typed = re.findall(
        r"@typedef \{import\([^)]*\)[^}]*\} (\w+)", (WEB / "src" / "index.js").read_text(encoding="utf-8")
    )
    assert len(typed) > 20
    assert set(typed) - pages["vexture"].ids == set()


def test_everything_public_has_a_sentence(model: dict[str, js_pages.Model]) -> None:
    assert list(js_pages.Book(model).find_undescribed()) == []


def test_every_type_that_is_named_is_described(model: dict[str, js_pages.Model]) -> None:
    assert js_pages.find_unlinked(model) == set()


def test_links_lead_to_places_that_are_there(site: Path, pages: dict[str, Read]) -> None:
    folder = site / "reference" / "javascript"
    for name, page in pages.items():
        for link in page.links:
            if re.match(r"\w+:", link):
                continue
            path, _, place = link.partition("#")
            target = (folder / path).resolve() if path else folder / f"{name}.html"
            assert target.is_file(), f"{name}: {link}"
            if place and target.parent == folder:
                assert place in pages[target.stem].ids, f"{name}: {link}"


def test_nothing_of_this_machine_is_on_the_pages(site: Path) -> None:
    for path in (site / "reference" / "javascript").glob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert str(ROOT) not in text
        assert "node_modules/@types" not in text
        assert "Defined in" not in text


def test_what_throws_throws_the_errors_of_the_package() -> None:
    for path in (WEB / "src").rglob("*.js"):
        if path.parent.name != "vite":
            assert set(re.findall(r"@throws \{(\w+)\}", path.read_text(encoding="utf-8"))) <= {"VextureError"}, path
