"""Pages of the gallery: what gallery.toml says of an example, filled into the templates of gallery/pages."""

import gzip
import html
import json
import shlex
import tomllib
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[1]
GALLERY: Final = ROOT / "gallery"

BUTTONS: Final = (
    '<button id="run" type="button">Run</button> <button id="reset" type="button" disabled>Reset</button> '
    '<button id="copy" type="button">Copy</button> <span>Ctrl+Enter runs, too</span>'
)


@dataclass(frozen=True, slots=True)
class Example:
    """An example of the gallery.

    Parameters
    ----------
    name : str
        Of its folder.
    title, text, tags : str
        What the index says of it.
    commands : tuple of str
        Lines that make its files, run in its folder as they are shown.
    files : tuple of str
        What its source loads.
    sources : tuple of str
        Keys of `gallery_data.SOURCES`: what the commands read.
    libraries : tuple of str
        Scripts of gallery/libraries; none for a page that stands by itself.
    page : str
        Such a page, which one of the commands writes.
    note : str
        More about it, shown below its source.
    """

    name: str
    title: str
    text: str
    tags: str
    commands: tuple[str, ...]
    sources: tuple[str, ...]
    files: tuple[str, ...] = ()
    libraries: tuple[str, ...] = ()
    page: str = ""
    note: str = ""

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


def examples() -> list[Example]:
    """All examples, in the order of the index."""
    table = tomllib.loads((GALLERY / "gallery.toml").read_text(encoding="utf-8"))
    lists = ("commands", "sources", "files", "libraries")
    return [
        Example(**{key: tuple(value) if key in lists else value for key, value in one.items()})
        for one in table["example"]
    ]


def fill_template(template: str, **values: Any) -> str:
    """A template of gallery/pages with its places filled."""
    return Template((GALLERY / "pages" / template).read_text(encoding="utf-8")).substitute(values)


def write_page(folder: Path, example: Example, around: tuple[Example, Example], facts: str) -> None:
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
        made=f"<p>The files are made by</p>{made}" if not example.page else "",
        bytes=f"{html.escape(facts)} First load: {total} ({named}).".strip(),
    )
    (folder / example.name / "index.html").write_text(text, encoding="utf-8")


def write_index(folder: Path, examples: list[Example], thumbnails: dict[str, str], credits: str) -> None:
    """Write the page of all examples; `thumbnails` are the files of their pictures."""
    cards = []
    for example in examples:
        title, text = html.escape(example.title), html.escape(example.text)
        picture = (
            f'<img src="{example.name}/{thumbnails[example.name]}" alt="" width="640" height="400" loading="lazy">'
        )
        card = f'<a class="card" href="{example.name}/index.html">{picture}<h2>{title}</h2><p>{text}</p>'
        cards.append(f'{card}<p class="tags">{html.escape(example.tags)}</p></a>')
    text = fill_template("index.html", cards="\n".join(cards), count=len(examples), credits=credits)
    (folder / "index.html").write_text(text, encoding="utf-8")


def command_line(line: str, folder: Path) -> list[str]:
    """Words of a command, patterns of files replaced by the files, as a shell does."""
    words = []
    for word in shlex.split(line):
        found = sorted(str(path.relative_to(folder)) for path in folder.glob(word)) if "*" in word else []
        words += found or [word]
    return words
