"""The documentation as it is built: everything is in it, once, and nothing of it comes from the network."""

import inspect
import re
import shutil
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import click
import pytest

import vexture
from guides import ROOT, build_site
from vexture.cli.main import main

pytest.importorskip("mkdocs", reason="MkDocs is not installed (pip install '.[docs]')")

LOADING = {"audio", "embed", "iframe", "img", "link", "script", "source", "video"}


class Loaded(HTMLParser):
    """Addresses that a page loads, all that it links to, and the names of its places."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.ids: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        if values.get("id"):
            self.ids.append(str(values["id"]))
        if tag in LOADING:
            self.loads += [str(values[name]) for name in ("src", "href", "srcset", "data") if values.get(name)]


def pages(site: Path) -> dict[str, Loaded]:
    return {
        path.relative_to(site).as_posix(): Loaded(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")
    }


def test_every_public_name_is_documented_once(site: Path) -> None:
    met = Counter(name for page in pages(site).values() for name in set(page.ids))
    assert {name: met[f"vexture.{name}"] for name in vexture.__all__} == dict.fromkeys(vexture.__all__, 1)
    reference = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs" / "reference").glob("*.md"))
    described = re.findall(r"^::: ([\w.]+)", reference, re.M)
    assert len(described) == len(set(described))
    assert set(vexture.__all__) <= {name.rpartition(".")[2] for name in described}


def test_every_public_function_has_an_example() -> None:
    functions = [getattr(vexture, name) for name in vexture.__all__ if inspect.isfunction(getattr(vexture, name))]
    assert len(functions) > 10
    assert [function.__name__ for function in functions if ">>>" not in (function.__doc__ or "")] == []


def commands() -> dict[str, click.Command]:
    """All commands by name; each is imported for it."""
    context = click.Context(main)
    found = {name: main.get_command(context, name) for name in main.list_commands(context)}
    return {name: command for name, command in found.items() if command is not None}


def test_every_command_and_option_is_described(site: Path) -> None:
    text = (site / "reference" / "command-line.html").read_text(encoding="utf-8")
    assert {"convert", "render", "info", "view", "flood"} <= set(commands())
    for name, command in commands().items():
        assert f'id="vexture-{name}"' in text
        context = click.Context(command, info_name=name)
        for parameter in command.params:
            record = parameter.get_help_record(context) if isinstance(parameter, click.Option) else None
            if record is not None:
                assert f"<code>{record[0]}</code>" in text, f"{name} {record[0]}"
                assert re.sub(r"\[default: .*?\]", "", record[1]).strip(), f"{name} {record[0]} says not what it is"


def test_what_a_command_says_of_itself_is_text(site: Path) -> None:
    text = (site / "reference" / "command-line.html").read_text(encoding="utf-8")
    for name, command in commands().items():
        for paragraph in inspect.cleandoc(command.help or "").split("\n\n"):
            assert f"<p>{paragraph[:40]}" in text, name
    assert "<code>-h, --help</code>" in text


def test_figures_have_a_page_once_there_are_some(site: Path) -> None:
    folder = ROOT / "packages" / "vexture-evidence" / "src" / "vexture_evidence" / "figures"
    defined = [path for path in folder.glob("*.py") if re.search(r'\) -> "?Figure"?:$', path.read_text(), re.M)]
    page = site / "reference" / "figures.html"
    assert page.is_file() == bool(defined)
    for path in defined:
        assert f'id="vexture_evidence.figures.{path.stem}.' in page.read_text(encoding="utf-8")


def test_every_module_is_listed_with_what_it_is(site: Path) -> None:
    text = (site / "project" / "modules.html").read_text(encoding="utf-8")
    rows = re.findall(r"<td><code>([\w.]+)</code></td>\s*<td>(.*?)</td>", text, re.S)
    listed = Counter(name for name, said in rows if said.strip())
    there = [
        path
        for package in (ROOT / "packages").glob("*/src/vexture*")
        if package.suffix != ".egg-info"
        for path in package.rglob("*")
        if path.suffix in (".py", ".glsl") and path.name != "__init__.py"
    ]
    assert listed == Counter(path.name for path in there)


def test_nothing_comes_from_the_network(site: Path) -> None:
    for name, page in pages(site).items():
        assert [address for address in page.loads if re.match(r"(\w+:)?//", address)] == [], name
    for path in [*site.rglob("*.css"), site / "assets" / "iframe-worker.js"]:
        assert not re.search(r"(url\(|@import)\s*[\"']?(https?:)?//", path.read_text(encoding="utf-8")), path


def test_what_lies_elsewhere_is_a_page_with_its_links(site: Path) -> None:
    architecture = (site / "project" / "architecture.html").read_text(encoding="utf-8")
    assert 'href="../reference/format.html"' in architecture
    assert "B.10 Example" in (site / "reference" / "format.html").read_text(encoding="utf-8")
    benchmarks = (site / "project" / "benchmarks.html").read_text(encoding="utf-8")
    assert 'href="example-drawings.html"' in benchmarks
    assert (site / "files" / "examples" / "shapes" / "licenses" / "DejaVu.txt").is_file()


BREAKS = {
    "link": ("docs/index.md", "guides/from-python.md", "guides/from-ruby.md", "from-ruby.md"),
    "anchor": ("docs/reference/converting.md", "#speed-size-and-precision", "#speed", "#speed"),
    "reference": ("docs/reference/drawings.md", "[`vexture.convert`][]", "[x][vexture.konvert]", "vexture.konvert"),
    "object": ("docs/reference/converting.md", "::: vexture.atlas", "::: vexture.atlasses", "atlasses"),
    "home": ("ARCHITECTURE.md", "[FORMAT.md](FORMAT.md)", "[FORMAT.md](FORM.md)", "FORM.md"),
    "docstring": (
        "packages/vexture/src/vexture/conversion/pipeline.py",
        "    capacity : int, opt",
        "    capacities : int, opt",
        "capacities",
    ),
}
FATAL = ("object", "home")  # of which the build does not even come to its end


def built_broken(folder: Path, *cases: str) -> list[str]:
    """Warnings and errors of the build of a copy in which something is broken; it fails."""
    copied = folder / "copied"
    pages = ("web/README.md", "web/package.json", "examples/shapes", "examples/counties/README.md")
    for name in ("packages", "docs", "tools", *pages, "mkdocs.yml"):
        target = copied / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, target)
    for path in ROOT.glob("*.md"):
        shutil.copy(path, copied)
    for case in cases:
        name, good, bad, _ = BREAKS[case]
        text = (copied / name).read_text(encoding="utf-8")
        assert good in text
        (copied / name).write_text(text.replace(good, bad, 1), encoding="utf-8")
    outcome = build_site(copied, folder / "site")
    assert outcome.returncode != 0
    return re.findall(r"^(?:WARNING|ERROR|Aborted) .*", outcome.stderr + outcome.stdout, re.M)


@pytest.mark.slow
def test_each_warning_fails_the_build(tmp_path: Path) -> None:
    cases = [case for case in BREAKS if case not in FATAL]
    *complaints, last = built_broken(tmp_path, *cases)
    assert last == f"Aborted with {len(cases)} warnings in strict mode!"
    for case in cases:
        assert [BREAKS[case][-1] in complaint for complaint in complaints].count(True) == 1, case


@pytest.mark.slow
@pytest.mark.parametrize("case", FATAL)
def test_what_cannot_be_built_ends_the_build(case: str, tmp_path: Path) -> None:
    assert any(BREAKS[case][-1] in complaint for complaint in built_broken(tmp_path, case))
