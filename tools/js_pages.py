"""Pages of the reference of the npm package, as Markdown, from what TypeDoc says."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Final

from js_model import MAIN
from js_types import Model, Writer, plain

CONSTRUCTOR, METHOD, ACCESSOR, REFERENCE = 512, 2048, 262144, 4194304
VARIABLE, FUNCTION, CLASS = 32, 64, 128
KINDS: Final = {VARIABLE: "function", FUNCTION: "function", CLASS: "class"}
"""Symbols of headings, as mkdocstrings names them; all else is a type."""

GROUPS: Final = {"class": "Classes", "function": "Functions", "attribute": "Constants", "type_alias": "Types"}
WIDTH: Final = 88
OPTIONS: Final = "MaskOptions"

FENCE: Final = re.compile(r"^(```.*?^```|(?:^ {4}.*\n?)+)", re.M | re.S)
CODE: Final = re.compile(r"(?<!`)`(\w+(?:\.\w+)?|vexture/\w+)`(?![`\]])")


def words(commented: Model, tag: str | None = None) -> str:
    """Return the text of a comment, or of one of its tags, as Markdown."""
    comment = commented.get("comment", {})
    parts = comment.get("summary", [])
    if tag:
        parts = [part for block in comment.get("blockTags", []) if block["tag"] == tag for part in block["content"]]
    text = "".join(part["text"] for part in parts).strip()
    pieces = FENCE.split(text)
    return "".join(piece if k % 2 else re.sub(r"(?<!\n)\n(?!\n) *", " ", piece) for k, piece in enumerate(pieces))


def signatures(one: Model) -> list[Model]:
    """Return the ways in which a function is called; none of what is no function."""
    what = one.get("type", {})
    declared = (what["types"][-1] if is_overridden(one) else what).get("declaration", {})
    found: list[Model] = one.get("signatures") or declared.get("signatures", [])
    return found


def is_overridden(one: Model) -> bool:
    """Whether a member is a function that a mixin puts over one of its base class; its words are lost to TypeDoc."""
    what = one.get("type", {})
    parts = what.get("types", []) if what.get("type") == "intersection" else []
    return bool(parts) and all("signatures" in part.get("declaration", {}) for part in parts)


def description_of(one: Model) -> str:
    """Return what is said of a member: of what reads it, of what sets it, of itself."""
    sources = [one, *signatures(one), one.get("getSignature", {}), one.get("setSignature", {})]
    return next((text for text in map(words, sources) if text), "")


def members(one: Model) -> list[Model]:
    """Return the members of a type, of one that is made of several those that it adds."""
    if "children" in one:
        return list(one["children"])
    what = one.get("type", {})
    parts = what.get("types", []) if what.get("type") == "intersection" else [what]
    return [
        child for part in parts if part.get("type") == "reflection" for child in part["declaration"].get("children", [])
    ]


def names(one: Model) -> str:
    """Return the name of an export as people use it."""
    return MAIN if one["name"] == "default" else str(one["name"])


def symbol(one: Model) -> str:
    """Return the kind of an export."""
    if one["kind"] == VARIABLE and not signatures(one):
        return "attribute"
    return KINDS.get(one["kind"], "type_alias")


def is_ours(node: Model) -> bool:
    """Whether a type is one of the package, and no parameter of a type."""
    target = node.get("target")
    is_own = target.get("packageName") == MAIN if isinstance(target, dict) else target == -1
    return is_own and node.get("package") == MAIN and not node.get("refersToTypeParameter")


def find_unlinked(model: dict[str, Model]) -> set[str]:
    """Names of the package's own types that something exported mentions, and no entry exports."""
    found: set[str] = set()

    def look(node: Any) -> None:
        if isinstance(node, list):
            for one in node:
                look(one)
        elif isinstance(node, dict):
            if node.get("type") == "reference" and is_ours(node):
                found.add(node["name"])
            for name, one in node.items():
                if name not in ("inheritedFrom", "overwrites", "extendedTypes"):
                    look(one)

    look(list(model.values()))
    return found - {one["name"] for module in model.values() for one in module["children"]}


@dataclass(frozen=True)
class Book:
    """All pages.

    Parameters
    ----------
    model : dict
        Entries' names, and TypeDoc's description of each.
    """

    model: dict[str, Model]
    _homes: dict[int, tuple[str, str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for entry, module in self.model.items():
            for one in module["children"]:
                if one["kind"] == REFERENCE:
                    continue
                self._homes[one["id"]] = (entry, one["name"])
                for child in members(one):
                    self._homes[child["id"]] = (entry, f"{one['name']}.{child['name']}")
        for module in self.model.values():
            for one in module["children"]:
                for child in members(one):
                    base = self._base(child)
                    if base:
                        self._homes[child["id"]] = base

    def page(self, entry: str) -> str:
        """Return the page of an entry."""
        module = self.model[entry]
        own = [one for one in module["children"] if one["kind"] != REFERENCE]
        parts = [f"# {entry}", self._add_links(description_of(module), entry, ""), *self._contents(own)]
        for kind in GROUPS:
            for one in own:
                if symbol(one) == kind:
                    parts += self._export(one, entry)
        parts += self._elsewhere(module, entry)
        return "\n\n".join(part for part in parts if part) + "\n"

    def overview(self) -> str:
        """Return a table of the entries, and what each exports."""
        rows = []
        for entry, module in self.model.items():
            found = [
                f"[`{names(one)}`]({self._address(one, '', '.md')})" for one in module["children"] if _is_code(one)
            ]
            text = self._add_links(description_of(module), "", "").replace("\n", " ")
            rows.append(f"| [`{entry}`]({_slug(entry)}.md) | {text} | {' '.join(found)} |")
        return "\n".join(["| entry | what it is for | classes and functions |", "|---|---|---|", *rows])

    def find_undescribed(self) -> Iterator[str]:
        """Find what has no sentence: entries, exports, members of classes and of types of options."""
        options = {anchor for _, anchor in self._homes.values() if anchor.startswith(f"{OPTIONS}.")}
        for entry, module in self.model.items():
            if not description_of(module):
                yield entry
            for one in module["children"]:
                if one["kind"] != REFERENCE and not description_of(one):
                    yield f"{entry} {one['name']}"
                # the sentence of a type that is made of others is of its members, too
                for child in members(one) if "children" in one else []:
                    as_option = one["kind"] == CLASS and f"{OPTIONS}.{child['name']}" in options
                    told = description_of(child) or as_option or is_overridden(child) or self._base(child)
                    if child["kind"] != CONSTRUCTOR and not told:
                        yield f"{entry} {one['name']}.{child['name']}"

    def _contents(self, exports: list[Model]) -> Iterator[str]:
        for kind, title in GROUPS.items():
            found = [f"[`{names(one)}`](#{one['name']})" for one in exports if symbol(one) == kind]
            if found:
                yield f"**{title}:** {', '.join(found)}\n{{ .js-contents }}"

    def _elsewhere(self, module: Model, entry: str) -> Iterator[str]:
        """List what the entry exports, too."""
        found = [one for one in module["children"] if one["kind"] == REFERENCE]
        if found:
            yield "## Exported here, too { .doc .doc-heading }"
            yield "\n".join(
                f"- [`{one['name']}`]({self._address(one, entry, '.md')}){{ #{one['name']} }}" for one in found
            )

    def _address(self, one: Model, entry: str, ending: str) -> str:
        home, anchor = self._homes[one["target"] if one["kind"] == REFERENCE else one["id"]]
        return f"#{anchor}" if home == entry else f"{_slug(home)}{ending}#{anchor}"

    def _writer(self, entry: str) -> Writer:
        def link(node: Model) -> str | None:
            home, anchor = self._home(node, entry)
            return None if not home else f"#{anchor}" if home == entry else f"{_slug(home)}.html#{anchor}"

        return Writer(link)

    def _home(self, node: Model, entry: str) -> tuple[str, str]:
        """Return where a type is described; one that a module names again is found by its name."""
        target = node.get("target")
        if isinstance(target, int) and target in self._homes:
            return self._homes[target]
        if not is_ours(node):
            return "", ""
        places = [home for home in self._homes.values() if home[1] == node["name"]]
        return next((home for home in places if home[0] == entry), places[0] if places else ("", ""))

    def _add_links(self, text: str, entry: str, within: str) -> str:
        """Return a text with links at the names of what is described elsewhere, of this entry first."""
        known = {anchor: home for home, anchor in reversed(self._homes.values())}
        known |= {anchor: home for home, anchor in self._homes.values() if home == entry}

        def replace(match: re.Match[str]) -> str:
            name = match[1]
            if name in self.model:
                return match[0] if name == entry else f"[{match[0]}]({_slug(name)}.md)"
            home = known.get(name)
            if home is None or name == within or name == "default":
                return match[0]
            return f"[{match[0]}]({'' if home == entry else _slug(home) + '.md'}#{name})"

        pieces = FENCE.split(text)
        return "".join(piece if k % 2 else CODE.sub(replace, piece) for k, piece in enumerate(pieces))

    def _export(self, one: Model, entry: str) -> Iterator[str]:
        """Write the section of an export."""
        kind, name = symbol(one), one["name"]
        yield heading(2, kind, names(one), name)
        said: Callable[[str], str] = lambda text: self._add_links(text, entry, name)  # noqa: E731
        if kind == "class":
            yield from self._class(one, entry, said)
            return
        if kind == "function":
            for way in signatures(one):
                yield self._signature(names(one), way, entry)
                yield said(words(way) or description_of(one))
                yield from self._call(way, entry, said)
            for child in one.get("children", []):
                yield from self._method(child, name, entry, said)
            return
        writer = self._writer(entry)
        if kind == "attribute":
            yield code(f"const {plain(name)}: {writer.type(one['type'])}")
        elif "type" in one and not (one["type"]["type"] == "reflection" and members(one)):
            yield code(f"type {plain(name)}{writer.generics(one)} = {writer.type(one['type'])}")
        yield said(description_of(one))
        yield from self._properties(members(one), name, entry, said)

    def _class(self, one: Model, entry: str, link_text: Callable[[str], str]) -> Iterator[str]:
        writer, name = self._writer(entry), one["name"]
        built = next((child for child in one["children"] if child["kind"] == CONSTRUCTOR), None)
        bases = [writer.type(base) for base in one.get("extendedTypes", []) if _is_known(base)]
        extends = f" extends {', '.join(bases)}" if bases else ""
        yield code(f"class {plain(name)}{writer.generics(one)}{extends}")
        yield link_text(description_of(one))
        own = [child for child in one["children"] if not self._base(child)]
        if built and built in own:
            (way, *_) = built["signatures"]
            yield self._signature(f"new {name}", way, entry)
            yield link_text(words(way))
            yield from self._call({**way, "type": {"type": "intrinsic", "name": "void"}}, entry, link_text)
        yield from self._properties(
            [child for child in own if not _is_method(child) and child != built], name, entry, link_text
        )
        inherited = [child for child in one["children"] if self._base(child) and child["kind"] != CONSTRUCTOR]
        if inherited:
            yield "**Inherited:** " + self._links(inherited, entry) + "\n{ .js-contents }"
        for child in own:
            if _is_method(child):
                yield from self._method(child, name, entry, link_text)

    def _base(self, child: Model) -> tuple[str, str] | None:
        """Return the entry and the place that describe a member of a base class; None if it is the class's own."""
        name = child.get("inheritedFrom", {}).get("name", "")
        places = (home for home in self._homes.values() if home[1] == name)
        return next(places, None)

    def _links(self, inherited: list[Model], entry: str) -> str:
        targets = [(child, self._homes[child["id"]]) for child in inherited]
        return ", ".join(
            f"[`{child['name']}`]({'' if home == entry else _slug(home) + '.md'}#{anchor})"
            for child, (home, anchor) in targets
        )

    def _method(self, child: Model, owner: str, entry: str, link_text: Callable[[str], str]) -> Iterator[str]:
        anchor = f"{owner}.{child['name']}"
        yield heading(3, "method", child["name"], anchor)
        for way in signatures(child):
            before = f"static {owner}." if child["flags"].get("isStatic") else ""
            yield self._signature(before + child["name"], way, entry)
            yield link_text(words(way) or description_of(child))
            yield from self._call(way, entry, link_text)

    def _signature(self, name: str, way: Model, entry: str) -> str:
        writer = self._writer(entry)
        returned = "" if name.startswith("new ") else f": {writer.type(way['type'])}"
        start = plain(name) + writer.generics(way)
        line = f"{start}({writer.parameters(way)}){returned}"
        if len(bare(line)) > WIDTH and way.get("parameters"):
            indented = ",\n  ".join(writer.parameters({"parameters": [one]}) for one in way["parameters"])
            line = f"{start}(\n  {indented},\n){returned}"
        return code(line)

    def _call(self, way: Model, entry: str, link_text: Callable[[str], str]) -> Iterator[str]:
        """Write what a function takes, returns and throws."""
        given = [one for one in way.get("parameters", []) if words(one) or "defaultValue" in one]
        if given:
            yield "**Parameters:**"
            yield "\n".join(self._item(one, "", entry, link_text) for one in given)
        if words(way, "@returns"):
            returned = words(way, "@returns")
            yield f"**Returns:** <code>{self._writer(entry).type(way['type'])}</code> – {link_text(returned)}"
        thrown = words(way, "@throws")
        if thrown:
            error = (
                "[`VextureError`](vexture.md#VextureError) " if entry != MAIN else "[`VextureError`](#VextureError) "
            )
            yield f"**Throws:** {error}{link_text(thrown)}"

    def _properties(self, found: list[Model], owner: str, entry: str, link_text: Callable[[str], str]) -> Iterator[str]:
        """List properties; those that are options of a mask are told there."""
        options = {anchor for _, anchor in self._homes.values() if anchor.startswith(f"{OPTIONS}.")}
        same = [one for one in found if not description_of(one) and f"{OPTIONS}.{one['name']}" in options]
        if same:
            (home,) = {home for home, anchor in self._homes.values() if anchor == OPTIONS}
            page = "" if home == entry else f"{_slug(home)}.md"
            links = ", ".join(f"[`{one['name']}`]({page}#{OPTIONS}.{one['name']})" for one in same)
            yield f"**Options as properties:** {links}\n{{ .js-contents }}"
        others = [one for one in found if one not in same]
        if others:
            yield "**Properties:**"
            yield "\n".join(self._item(one, f"{owner}.{one['name']}", entry, link_text) for one in others)

    def _item(self, one: Model, anchor: str, entry: str, link_text: Callable[[str], str]) -> str:
        """Write a parameter or a property as an item of a list."""
        what = one.get("type") or one.get("getSignature", {}).get("type")
        if what is None and signatures(one):
            what = {"type": "reflection", "declaration": {"signatures": signatures(one)}}
        notes = [f"<code>{self._writer(entry).type(what)}</code>"]
        default = one.get("defaultValue", "")
        if one["flags"].get("isReadonly") or ("getSignature" in one and "setSignature" not in one):
            notes.append("read-only")
        elif default and default not in ("{}", "...", "undefined") and not anchor:
            notes.append(f"default: <code>{plain(default)}</code>")
        elif one["flags"].get("isOptional") or default:
            notes.append("optional")
        place = f'<a id="{anchor}"></a>' if anchor else ""
        text = link_text(description_of(one))
        return f"- {place}**`{one['name']}`** ({', '.join(notes)})" + (f" – {text}" if text else "")


def heading(level: int, kind: str, name: str, anchor: str) -> str:
    """Return a heading that looks as those of Python do."""
    sign = f'<code class="doc-symbol doc-symbol-heading doc-symbol-{kind}"></code>'
    return f"{'#' * level} {sign} `{name}` {{ #{anchor} .doc .doc-heading }}"


def code(text: str) -> str:
    """Return a signature as a block."""
    return f'<div class="doc-signature highlight js-signature"><pre><code>{text}</code></pre></div>'


def bare(text: str) -> str:
    """Return a line of HTML as it is read, as far as its length goes."""
    return re.sub(r"&#?\w+;", "_", re.sub(r"<[^>]*>", "", text))


def _slug(entry: str) -> str:
    return entry.rpartition("/")[2]


def _is_code(one: Model) -> bool:
    return one["kind"] == REFERENCE or symbol(one) in ("class", "function")


def _is_method(one: Model) -> bool:
    return one["kind"] == METHOD or is_overridden(one)


def _is_known(base: Model) -> bool:
    """Whether a base class is anybody's to use, unlike those that only this package knows."""
    return base.get("target", -1) != -1
