"""Pages of the gallery: what gallery.toml says of an example, filled into the templates of gallery/pages."""

import gzip
import html
import json
import shlex
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from string import Template
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[1]
GALLERY: Final = ROOT / "gallery"

BUTTONS: Final = (
    '<button id="run" type="button">Run</button> <button id="reset" type="button" disabled>Reset</button> '
    '<button id="copy" type="button">Copy</button> <span>Ctrl+Enter runs, too</span>'
)


HELPERS: Final = '<p>Its controls are of <a href="../helpers.js">helpers.js</a>: copy it, too.</p>'


@dataclass(frozen=True, slots=True)
class Entry:
    """What the index shows.

    Parameters
    ----------
    name : str
        Of its folder.
    title, text, tags : str
        What the index says of it.
    libraries : tuple of str
        Scripts of gallery/libraries that it loads; of an example none if it is a page that stands by itself.
    """

    name: str
    title: str
    text: str
    tags: str
    libraries: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class OwnPage(Entry):
    """A page of its own, which stands before the examples; tools/make_NAME.py builds it."""


@dataclass(frozen=True, slots=True)
class Example(Entry):
    """An example of the gallery.

    Parameters
    ----------
    commands : tuple of str
        Lines that make its files, run in its folder as they are shown.
    files : tuple of str
        What its source loads.
    sources : tuple of str
        Keys of `gallery_data.SOURCES`: what the commands read.
    page : str
        A page that stands by itself, which one of the commands writes.
    picture : mapping
        Values of its controls, by their labels, in its picture in the index.
    """

    commands: tuple[str, ...] = ()
    sources: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    page: str = ""
    picture: Mapping[str, Any] = field(default_factory=dict)

    @property
    def path(self) -> Path:
        """The file that is shown beside it."""
        return next(iter(sorted((GALLERY / "examples").glob(f"{self.name}.*"))))

    @property
    def source(self) -> str:
        """Return its text."""
        return self.path.read_text(encoding="utf-8")


@dataclass(frozen=True, slots=True)
class Weight:
    """Bytes of files, and of what a server sends that compresses them by gzip."""

    plain: int = 0
    sent: int = 0

    @classmethod
    def of(cls, path: Path) -> "Weight":
        """Weigh a file."""
        content = path.read_bytes()
        return cls(len(content), min(len(content), len(gzip.compress(content, 9))))

    def __add__(self, other: "Weight") -> "Weight":
        return Weight(self.plain + other.plain, self.sent + other.sent)

    def __str__(self) -> str:
        return f"{spoken(self.plain)}, {spoken(self.sent)} compressed"


def spoken(size: int) -> str:
    """Say a number of bytes.

    Examples
    --------
    >>> spoken(998_000), spoken(1_258_256)
    ('998 kB', '1.26 MB')
    """
    return f"{size / 1e6:.2f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"


TABLE: Final = tomllib.loads((GALLERY / "gallery.toml").read_text(encoding="utf-8"))


def examples() -> list[Example]:
    """All examples, in the order of the index."""
    return [Example(**_with_tuples(one)) for one in TABLE["example"]]


def own_pages() -> list[OwnPage]:
    """Pages of their own, in the order of the index."""
    return [OwnPage(**_with_tuples(one)) for one in TABLE.get("page", ())]


def _with_tuples(entry: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in entry.items()}


def fill_template(template: str, **values: Any) -> str:
    """A template of gallery/pages with its places filled."""
    return Template((GALLERY / "pages" / template).read_text(encoding="utf-8")).substitute(values)


def write_page(folder: Path, example: Example, around: tuple[Entry, Entry], facts: str) -> None:
    """Write the page of an example; `facts` is what was measured of its files."""
    libraries = [folder / "lib" / f"{name}.js" for name in example.libraries]
    shared = [folder / name for name in ("gallery.css", "page.js")]
    shared += [folder / "frame.js"] if libraries else []
    shared += [folder / "jsx.js"] if example.path.suffix == ".jsx" else []
    own = [folder / example.name / name for name in (*example.files, *([example.page] if example.page else []))]
    sums = [sum(map(Weight.of, some), Weight()) for some in (libraries, own, shared)]
    total = sum(sums, Weight())
    parts = (("libraries", sums[0]), ("data", sums[1]), ("the page", sums[2]))
    named = ", ".join(f"{what} {spoken(weight.sent)}" for what, weight in parts if weight.plain)
    made = "".join(f"<p><code>{html.escape(line)}</code></p>" for line in example.commands)
    made = f"<p>The files are made by</p>{made}" if made else ""
    about = {
        "title": example.title,
        "source": example.source,
        "libraries": list(example.libraries) or None,
        "files": bool(example.files),
        "jsx": example.path.suffix == ".jsx",
    }
    before, after = around
    text = fill_template(
        "example.html",
        title=html.escape(example.title),
        text=html.escape(example.text),
        text_plain=html.escape(example.text),
        about=json.dumps(about).replace("<", "\\u003c"),
        before=before.name,
        before_title=html.escape(before.title),
        after=after.name,
        after_title=html.escape(after.title),
        frame=f'<iframe title="{html.escape(example.title)}" src="{example.page}"></iframe>' if example.page else "",
        file=f"example{example.path.suffix}",
        lines=len(example.source.splitlines()),
        buttons="" if example.page else BUTTONS,
        readonly=" readonly" if example.page else "",
        source=html.escape(example.source),
        made="" if example.page else f"{made}{HELPERS}",
        bytes=f"{html.escape(facts)} First load: {total} ({named}).".strip(),
    )
    (folder / example.name / "index.html").write_text(text, encoding="utf-8")


def write_index(folder: Path, entries: Sequence[Entry], credits: str) -> None:
    """Write the page of all pages and examples."""
    cards = []
    for entry in entries:
        title, text = html.escape(entry.title), html.escape(entry.text)
        picture = f'<img src="{entry.name}/thumbnail.jpg" alt="" width="640" height="400" loading="lazy">'
        card = f'<a class="card" href="{entry.name}/index.html">{picture}<h2>{title}</h2><p>{text}</p>'
        cards.append(f'{card}<p class="tags">{html.escape(entry.tags)}</p></a>')
    text = fill_template("index.html", cards="\n".join(cards), count=len(entries), credits=credits)
    (folder / "index.html").write_text(text, encoding="utf-8")


def command_line(line: str, folder: Path) -> list[str]:
    """Words of a command, patterns of files replaced by the files, as a shell does."""
    words = []
    for word in shlex.split(line):
        found = sorted(str(path.relative_to(folder)) for path in folder.glob(word)) if "*" in word else []
        words += found or [word]
    return words
