"""Pages of the documentation whose text has its home elsewhere in the repository; MkDocs calls this as a hook.

FORMAT.md and its like stay where readers of the repository look for them. The command line is described by its own
help, each module by the first paragraph of its docstring, and the npm package by the types of its sources. All become
pages when the site is built, so nothing is written twice.
"""

import ast
import inspect
import logging
import posixpath
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import click
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

import js_model
from js_pages import Book

ROOT: Final = Path(__file__).parents[1]

HOMES: Final = {
    "ARCHITECTURE.md": "project/architecture.md",
    "CHANGELOG.md": "project/changelog.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "FORMAT.md": "reference/format.md",
    "HISTORY.md": "project/history.md",
    "SECURITY.md": "project/security.md",
    "packages/vexture-evidence/benchmarks/README.md": "project/benchmarks.md",
    "examples/counties/README.md": "project/counties.md",
    "examples/shapes/README.md": "project/example-drawings.md",
    "web/README.md": "reference/javascript.md",
}
"""Pages by the files that they are, both as paths from the root of the repository or of the documentation."""

COMMAND_LINE: Final = "reference/command-line.md"
CONFORMANCE: Final = "reference/conformance.md"
PICTURES: Final = "reference/conformance-pictures.html"
FIGURES: Final = "reference/figures.md"
MODULES: Final = "project/modules.md"

WEB: Final = ROOT / "web"
JAVASCRIPT: Final = "reference/javascript/{}.md"
OVERVIEW: Final = JAVASCRIPT.format("index")
ENTRIES: Final = "<!-- entries -->"
"""Where the page of all entries lists them."""

LEFT_OUT: Final = "This part of the reference is made where Node.js and npm are: `make docs`."
TO_ENTRY: Final = re.compile(r"(\]\((?:[./\w-]*/)?javascript/[\w-]+\.md)#[\w.]+(?=\))")
"""Link to a place of a page of an entry."""
TO_ENTRY_BESIDE: Final = re.compile(r"(\]\([\w-]+\.md)#[\w.]+(?=\))")
"""The same from the page of all entries."""

LOG: Final = logging.getLogger("mkdocs.hooks.javascript")

GALLERY: Final = ROOT / "packages" / "vexture-evidence" / "benchmarks" / "results" / "conformance.html"
"""Page of all pictures, if `make conformance` has made it."""

EVIDENCE: Final = ROOT / "packages" / "vexture-evidence" / "src" / "vexture_evidence"
PACKAGES: Final = (
    ROOT / "packages" / "vexture" / "src" / "vexture",
    ROOT / "packages" / "vexture-geo" / "src" / "vexture_geo",
    EVIDENCE,
)
"""Packages whose modules are listed."""

LINK: Final = re.compile(r"(?<=\]\()(?!\w+:|#)([^)#\s]+)")
FENCED: Final = re.compile(r"^(```.*?^```)$", re.M | re.S)


def on_config(config: Any) -> Any:
    """Add the page of figures to those of Python, if there are any, and a page for each entry of the npm package."""
    (reference,) = (entry["Reference"] for entry in config.nav if "Reference" in entry)
    (package,) = (entry["JavaScript"] for entry in reference if "JavaScript" in entry)
    package += [{entry.name: JAVASCRIPT.format(entry.slug)} for entry in js_model.entries(WEB)]
    if figures():
        (python,) = (entry["Python"] for entry in reference if "Python" in entry)
        python.append({"Figures": FIGURES})
    return config


def on_files(files: Files, *, config: Any) -> Files:
    """Add the pages, and the files that they link to."""
    attached: set[str] = set()
    for home, page in HOMES.items():
        text, linked = rewrite_links(home)
        attached |= linked
        files.append(File.generated(config, page, content=text))
    for path in sorted(attached):
        files.append(File.generated(config, f"files/{path}", abs_src_path=str(ROOT / path)))
    files.append(File.generated(config, COMMAND_LINE, content=command_line()))
    files.append(File.generated(config, MODULES, content=modules()))
    made = javascript()
    config.extra["entries"] = made.pop(OVERVIEW)
    for page, text in made.items():
        files.append(File.generated(config, page, content=text))
    if GALLERY.is_file():
        files.append(File.generated(config, PICTURES, abs_src_path=str(GALLERY)))
    if figures():
        files.append(File.generated(config, FIGURES, content=figures_page()))
    return files


def on_post_build(*, config: Any) -> None:
    """Bring the gallery, if it is built."""
    built = ROOT / "gallery" / "built"
    if (built / "index.html").is_file():
        shutil.copytree(built, Path(config.site_dir) / "gallery", dirs_exist_ok=True)


def on_page_markdown(markdown: str, *, page: Any, config: Any, **_: Any) -> str:
    """Link the page of all pictures, if it is there; list all entries; link no place of a page that is left out."""
    if page.file.src_uri == OVERVIEW:
        markdown = markdown.replace(ENTRIES, config.extra["entries"])
    if page.file.src_uri == CONFORMANCE and GALLERY.is_file():
        return markdown.replace(
            "## What is named", f"[The pictures]({posixpath.basename(PICTURES)})\n\n## What is named", 1
        )
    if js_model.missing(WEB) is None:
        return markdown
    beside = page.file.src_uri == OVERVIEW
    return (TO_ENTRY_BESIDE if beside else TO_ENTRY).sub(r"\1", markdown)


def javascript() -> dict[str, str]:
    """Pages of the entries of the npm package, and, by the name of the page of all entries, the list of them.

    Raises
    ------
    PluginError
        If TypeDoc cannot read the sources.
    """
    lacking = js_model.missing(WEB)
    if lacking:
        LOG.info("the reference of the JavaScript API is left out: %s", lacking)
        pages = {entry: f"# {entry.name}\n\n{LEFT_OUT}\n" for entry in js_model.entries(WEB)}
        listed = LEFT_OUT
    else:
        try:
            book = Book(js_model.model(WEB))
        except RuntimeError as error:
            raise PluginError(str(error)) from error
        pages = {entry: book.page(entry.name) for entry in js_model.entries(WEB)}
        listed = book.overview()
    written = {JAVASCRIPT.format(entry.slug): text for entry, text in pages.items()}
    return {OVERVIEW: listed, **written}


def rewrite_links(home: str) -> tuple[str, set[str]]:
    """Text of a file with its relative links as they are from its page, and the files that come with it.

    Links to files that are pages go to the pages; other files come with the site, below ``files/``.

    Raises
    ------
    PluginError
        If a link leads to a folder or to nothing.
    """
    attached: set[str] = set()

    def target(match: re.Match[str]) -> str:
        path = posixpath.normpath(posixpath.join(posixpath.dirname(home), match[1]))
        page = HOMES.get(path)
        if page is None:
            if path.startswith("docs/"):
                page = path.removeprefix("docs/")
            elif (ROOT / path).is_file():
                attached.add(path)
                page = f"files/{path}"
            else:
                raise PluginError(f"{home}: the link to {match[1]} leads to no file; correct it")
        return posixpath.relpath(page, posixpath.dirname(HOMES[home]))

    parts = FENCED.split((ROOT / home).read_text(encoding="utf-8"))
    return "".join(part if part.startswith("```") else LINK.sub(target, part) for part in parts), attached


def figures() -> list[str]:
    """Functions that make a figure, as ``module.function`` of `vexture_evidence.figures`."""
    found = []
    for path in sorted((EVIDENCE / "figures").glob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        found += [
            f"{path.stem}.{node.name}"
            for node in tree.body
            if isinstance(node, ast.FunctionDef)
            and node.returns is not None
            and ast.unparse(node.returns).strip("'\"") == "Figure"
            and not node.name.startswith("_")
        ]
    return found


def figures_page() -> str:
    """Page of all figures."""
    parts = [
        "# Figures",
        "Each function makes one figure of matplotlib from the library's own data, in a notebook or for a file: "
        "`figure.savefig(...)`. `vexture report` puts them on one page. They are part of the distribution "
        "`vexture-evidence` (`pip install ./packages/vexture-evidence` in a clone).",
        *(f"::: vexture_evidence.figures.{name}" for name in figures()),
    ]
    return "\n\n".join(parts) + "\n"


def modules() -> str:
    """Page of all modules and shader files, by folder, each with the first paragraph of its own text."""
    parts = [
        "# Modules",
        "What each module and shader file is, by its own text. [Architecture](architecture.md) says why.",
    ]
    for package in PACKAGES:
        folders = [package, *sorted(path for path in package.rglob("*") if path.is_dir())]
        for folder in folders:
            rows = [
                f"| `{path.name}` | {_describe_file(path)} |" for path in sorted(folder.iterdir()) if _is_listed(path)
            ]
            if not rows:
                continue
            parts.append(f"## {folder.relative_to(package.parent).as_posix()}/")
            if (folder / "__init__.py").is_file():
                parts.append(_describe_file(folder / "__init__.py"))
            parts.append("\n".join(["| module | what it is |", "|---|---|", *rows]))
    return "\n\n".join(parts) + "\n"


def _is_listed(path: Path) -> bool:
    return path.suffix in (".py", ".glsl") and path.name != "__init__.py"


def _describe_file(path: Path) -> str:
    """Return the first paragraph of a module's docstring, or of the comment that a shader file begins with."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        said = ast.get_docstring(ast.parse(text)) or ""
    else:
        comment = text.partition("// Exports:")[0]
        said = "\n".join(line.removeprefix("//").strip() for line in comment.splitlines())
    return " ".join(said.split("\n\n")[0].split()).replace("``", "`").replace("|", "\\|")


def command_line() -> str:
    """Page of all commands, by their own words."""
    from vexture.cli.main import main

    context = click.Context(main, info_name="vexture", **main.context_settings)
    parts = [
        "# Command line",
        "`vexture COMMAND --help` says the same in a terminal. Where a command cannot do what it was asked it says "
        "so in one line and its exit code is 1; arguments that it does not know end with exit code 2.",
    ]
    for name in main.list_commands(context):
        command = main.get_command(context, name)
        assert command is not None
        parts += _command(name, command, context)
    return "\n\n".join(parts) + "\n"


def _command(name: str, command: click.Command, above: click.Context) -> Iterator[str]:
    """Section of a command: what it does, how it is called, its options."""
    context = click.Context(command, info_name=name, parent=above)
    usage = " ".join(command.collect_usage_pieces(context))
    yield f"## vexture {name}"
    yield f"```text\n{context.command_path} {usage}\n```"
    for text in (command.help, command.epilog):
        yield from map(_paragraph, inspect.cleandoc(text or "").split("\n\n"))
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context) if isinstance(parameter, click.Option) else None
        if record is not None:
            names, text = record
            yield f"`{names}`\n:   {text}"


def _paragraph(text: str) -> str:
    """Return a paragraph of a command's help; one that begins with a backspace keeps its lines, as in a terminal."""
    unwrapped = text.removeprefix("\b\n")
    return text if unwrapped == text else f"```text\n{inspect.cleandoc(unwrapped)}\n```"
